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
    point("EHL-1", "arena2", [0.441, 1.05], 94.9, 7.4),
    point("EHL-1", "brc202d", [1.2, 2.26], 230.0, 18.8),
    point("EHL-1", "orz900d", [2.5, 4.27], 537.0, 84.0),
    point("EHL-1", "lak303d", [0.602, 1.49], 109.0, 7.0),
    point("EHL-1", "hrt201n", [0.539, 1.32], 84.7, 5.5),
    point("EHL-1", "AR0011SR", [0.578, 2.04], 647.0, 91.9),
    point("EHL-1", "AR0205SR", [1.1, 2.55], 384.0, 30.8),
    point("EHL-1", "32room_000", [0.777, 2.84], 764.0, 26.1),
    point("EHL-1", "Berlin_0_256", [0.873, 6.83], 726.0, 118.0),
    point("EHL-4", "arena2", [0.626, 1.75], 16.4, 0.7),
    point("EHL-4", "brc202d", [1.64, 2.72], 44.6, 1.7),
    point("EHL-4", "orz900d", [3.4, 4.26], 99.6, 5.4),
    point("EHL-4", "lak303d", [1.32, 3.35], 24.5, 0.8),
    point("EHL-4", "hrt201n", [0.802, 1.82], 15.9, 0.6),
    point("EHL-4", "AR0011SR", [1.49, 3.42], 112.0, 6.6),
    point("EHL-4", "AR0205SR", [1.08, 3.98], 72.0, 2.3),
    point("EHL-4", "32room_000", [1.0, 2.62], 85.4, 7.2),
    point("EHL-4", "Berlin_0_256", [2.02, 8.56], 168.0, 8.1),
    point("EHL-16", "arena2", [2.62, 5.87], 3.57, 0.1),
    point("EHL-16", "brc202d", [5.89, 6.01], 9.77, 0.3),
    point("EHL-16", "orz900d", [6.18, 5.69], 22.7, 0.9),
    point("EHL-16", "lak303d", [3.13, 7.36], 5.51, 0.2),
    point("EHL-16", "hrt201n", [1.58, 3.33], 3.02, 0.1),
    point("EHL-16", "AR0011SR", [6.77, 7.63], 27.0, 0.8),
    point("EHL-16", "AR0205SR", [6.29, 9.88], 17.2, 0.4),
    point("EHL-16", "32room_000", [2.11, 5.06], 15.9, 1.0),
    point("EHL-16", "Berlin_0_256", [21.9, 42.2], 42.6, 1.2),
    point("EHL* 20 %", "arena2", [0.499, 1.36], 18.4, 10.3),
    point("EHL* 20 %", "brc202d", [0.836, 2.48], 44.1, 26.9),
    point("EHL* 20 %", "orz900d", [2.69, 3.79], 102.0, 102.0),
    point("EHL* 20 %", "lak303d", [0.905, 2.48], 20.7, 10.7),
    point("EHL* 20 %", "hrt201n", [0.716, 1.44], 16.3, 7.8),
    point("EHL* 20 %", "AR0011SR", [0.955, 3.08], 124.0, 128.0),
    point("EHL* 20 %", "AR0205SR", [0.819, 7.26], 73.2, 44.0),
    point("EHL* 20 %", "32room_000", [0.872, 3.67], 151.0, 66.3),
    point("EHL* 20 %", "Berlin_0_256", [1.52, 9.86], 138.0, 154.0),
    point("EHL* 5 %", "arena2", [0.891, 2.28], 4.63, 10.9),
    point("EHL* 5 %", "brc202d", [1.8, 4.22], 11.9, 25.8),
    point("EHL* 5 %", "orz900d", [3.43, 4.05], 30.1, 109.0),
    point("EHL* 5 %", "lak303d", [2.55, 4.87], 5.16, 10.7),
    point("EHL* 5 %", "hrt201n", [1.06, 2.13], 4.37, 8.0),
    point("EHL* 5 %", "AR0011SR", [1.15, 6.88], 30.9, 116.0),
    point("EHL* 5 %", "AR0205SR", [1.62, 5.45], 18.8, 46.2),
    point("EHL* 5 %", "32room_000", [1.72, 3.21], 37.2, 55.6),
    point("EHL* 5 %", "Berlin_0_256", [5.75, 12.8], 33.3, 169.0),
];

/// The times of the baselines on that machine, in microseconds: `pathfinding`, then `grid_pathfinding`.
const YARDSTICKS: [(&str, f64, f64); 9] = [
    ("arena2", 1558.0, 94.7),
    ("brc202d", 3522.0, 403.0),
    ("orz900d", 1.0, 1.0),
    ("lak303d", 919.0, 166.0),
    ("hrt201n", 1098.0, 147.0),
    ("AR0011SR", 3357.0, 271.0),
    ("AR0205SR", 1836.0, 219.0),
    ("32room_000", 8419.0, 347.0),
    ("Berlin_0_256", 1242.0, 218.0),
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
