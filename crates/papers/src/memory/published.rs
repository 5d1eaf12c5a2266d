//! Time and memory of EHL, Euclidean hub labels (Du, Shen & Cheema 2023), and of EHL* (the same with regions
//! merged under a budget of memory).
//!
//! The authors' programs ran on 27 November 2026, one thread on a core of two of an AMD EPYC, on the maps on
//! which regions of one cell can be built in minutes; whole passes, warm, median of the passes, the path
//! made. Bytes are those of the labels in memory, without mesh, visibility polygons and hub labels of
//! vertices. On every instance their costs are ours.

use mediant_bench::Baseline;

/// A program on a map, on the machine and day of the measurement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) program: &'static str,
    pub(super) map: &'static str,
    /// Mean time of a query, in microseconds: of each 20th instance, and of whole scenario files.
    pub(super) micros: [f64; 2],
    /// The size of the index in 10⁶ bytes.
    pub(super) megabytes: f64,
    /// The seconds that it took to build, beside other work.
    pub(super) seconds: f64,
}

const fn point(
    program: &'static str,
    map: &'static str,
    micros: [f64; 2],
    megabytes: f64,
    seconds: f64,
) -> Point {
    Point { program, map, micros, megabytes, seconds }
}

/// The programs: the number is the side of a region in cells, or the share of EHL-1's labels.
pub(super) const PROGRAMS: [&str; 5] = ["EHL-1", "EHL-4", "EHL-16", "EHL* 20 %", "EHL* 5 %"];

pub(super) const POINTS: [Point; 45] = [
    point("EHL-1", "arena2", [0.439, 1.12], 94.9, 7.4),
    point("EHL-1", "brc202d", [0.768, 1.7], 230.0, 18.8),
    point("EHL-1", "orz900d", [2.41, 3.39], 537.0, 84.0),
    point("EHL-1", "lak303d", [0.637, 1.52], 109.0, 7.0),
    point("EHL-1", "hrt201n", [0.562, 1.1], 84.7, 5.5),
    point("EHL-1", "AR0011SR", [0.576, 1.87], 647.0, 91.9),
    point("EHL-1", "AR0205SR", [0.676, 2.19], 384.0, 30.8),
    point("EHL-1", "32room_000", [0.806, 2.85], 764.0, 26.1),
    point("EHL-1", "Berlin_0_256", [0.88, 3.13], 726.0, 118.0),
    point("EHL-4", "arena2", [0.628, 1.81], 16.4, 0.7),
    point("EHL-4", "brc202d", [1.2, 2.37], 44.6, 1.7),
    point("EHL-4", "orz900d", [3.16, 3.88], 99.6, 5.4),
    point("EHL-4", "lak303d", [1.2, 3.04], 24.5, 0.8),
    point("EHL-4", "hrt201n", [0.824, 1.92], 15.9, 0.6),
    point("EHL-4", "AR0011SR", [0.804, 2.63], 112.0, 6.6),
    point("EHL-4", "AR0205SR", [1.2, 3.47], 72.0, 2.3),
    point("EHL-4", "32room_000", [1.04, 2.67], 85.4, 7.2),
    point("EHL-4", "Berlin_0_256", [2.29, 7.24], 168.0, 8.1),
    point("EHL-16", "arena2", [1.61, 5.83], 3.57, 0.1),
    point("EHL-16", "brc202d", [5.4, 5.64], 9.77, 0.3),
    point("EHL-16", "orz900d", [5.5, 5.62], 22.7, 0.9),
    point("EHL-16", "lak303d", [3.05, 7.1], 5.51, 0.2),
    point("EHL-16", "hrt201n", [1.51, 3.29], 3.02, 0.1),
    point("EHL-16", "AR0011SR", [3.01, 7.28], 27.0, 0.8),
    point("EHL-16", "AR0205SR", [6.24, 9.02], 17.2, 0.4),
    point("EHL-16", "32room_000", [2.17, 4.67], 15.9, 1.0),
    point("EHL-16", "Berlin_0_256", [22.1, 27.2], 42.6, 1.2),
    point("EHL* 20 %", "arena2", [0.568, 1.32], 18.4, 10.3),
    point("EHL* 20 %", "brc202d", [1.27, 2.14], 44.1, 26.9),
    point("EHL* 20 %", "orz900d", [2.67, 3.48], 102.0, 102.0),
    point("EHL* 20 %", "lak303d", [0.942, 2.31], 20.7, 10.7),
    point("EHL* 20 %", "hrt201n", [0.673, 1.37], 16.3, 7.8),
    point("EHL* 20 %", "AR0011SR", [0.664, 2.71], 124.0, 128.0),
    point("EHL* 20 %", "AR0205SR", [0.847, 2.74], 73.2, 44.0),
    point("EHL* 20 %", "32room_000", [0.914, 2.33], 151.0, 66.3),
    point("EHL* 20 %", "Berlin_0_256", [1.32, 4.88], 138.0, 154.0),
    point("EHL* 5 %", "arena2", [0.863, 2.21], 4.63, 10.9),
    point("EHL* 5 %", "brc202d", [1.46, 2.95], 11.9, 25.8),
    point("EHL* 5 %", "orz900d", [3.43, 3.85], 30.1, 109.0),
    point("EHL* 5 %", "lak303d", [1.92, 4.74], 5.16, 10.7),
    point("EHL* 5 %", "hrt201n", [1.05, 2.15], 4.37, 8.0),
    point("EHL* 5 %", "AR0011SR", [0.974, 3.26], 30.9, 116.0),
    point("EHL* 5 %", "AR0205SR", [1.61, 4.25], 18.8, 46.2),
    point("EHL* 5 %", "32room_000", [1.02, 2.59], 37.2, 55.6),
    point("EHL* 5 %", "Berlin_0_256", [5.79, 11.3], 33.3, 169.0),
];

/// The times of the baselines within the hour on that machine, in microseconds: `pathfinding`, then
/// `grid_pathfinding`.
const YARDSTICKS: [(&str, f64, f64); 9] = [
    ("arena2", 1541.0, 108.7),
    ("brc202d", 3454.0, 457.9),
    ("orz900d", 11_390.0, 1394.0),
    ("lak303d", 986.2, 193.7),
    ("hrt201n", 1136.0, 160.9),
    ("AR0011SR", 3197.0, 311.3),
    ("AR0205SR", 1990.0, 254.6),
    ("32room_000", 9470.0, 404.0),
    ("Berlin_0_256", 1322.0, 253.7),
];

/// The time of a baseline on a map there, in microseconds.
pub(super) fn baseline(baseline: Baseline, map: &str) -> Option<f64> {
    let (_, first, second) = YARDSTICKS.into_iter().find(|(name, ..)| *name == map)?;
    Some(match baseline {
        Baseline::Pathfinding => first,
        Baseline::GridPathfinding => second,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_can_be_scaled() {
        for Point { program, map, .. } in POINTS {
            assert!(PROGRAMS.contains(&program), "{program}");
            assert!(Baseline::ALL.into_iter().all(|one| baseline(one, map).is_some()), "{map}");
        }
    }
}
