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
    point("EHL-1", "arena2", [0.434, 0.974], 94.9, 7.4),
    point("EHL-1", "brc202d", [0.744, 1.9], 230.0, 18.8),
    point("EHL-1", "orz900d", [2.37, 3.46], 537.0, 84.0),
    point("EHL-1", "lak303d", [0.617, 2.22], 109.0, 7.0),
    point("EHL-1", "hrt201n", [0.752, 1.27], 84.7, 5.5),
    point("EHL-1", "AR0011SR", [0.573, 2.01], 647.0, 91.9),
    point("EHL-1", "AR0205SR", [0.651, 2.45], 384.0, 30.8),
    point("EHL-1", "32room_000", [0.79, 2.82], 764.0, 26.1),
    point("EHL-1", "Berlin_0_256", [1.23, 3.4], 726.0, 118.0),
    point("EHL-4", "arena2", [0.635, 1.75], 16.4, 0.7),
    point("EHL-4", "brc202d", [1.06, 2.63], 44.6, 1.7),
    point("EHL-4", "orz900d", [3.16, 4.05], 99.6, 5.4),
    point("EHL-4", "lak303d", [1.15, 3.43], 24.5, 0.8),
    point("EHL-4", "hrt201n", [1.04, 2.05], 15.9, 0.6),
    point("EHL-4", "AR0011SR", [0.858, 2.94], 112.0, 6.6),
    point("EHL-4", "AR0205SR", [1.24, 3.44], 72.0, 2.3),
    point("EHL-4", "32room_000", [1.02, 2.89], 85.4, 7.2),
    point("EHL-4", "Berlin_0_256", [2.17, 7.12], 168.0, 8.1),
    point("EHL-16", "arena2", [1.67, 5.86], 3.57, 0.1),
    point("EHL-16", "brc202d", [5.27, 6.26], 9.77, 0.3),
    point("EHL-16", "orz900d", [5.87, 6.19], 22.7, 0.9),
    point("EHL-16", "lak303d", [3.38, 7.59], 5.51, 0.2),
    point("EHL-16", "hrt201n", [1.55, 3.86], 3.02, 0.1),
    point("EHL-16", "AR0011SR", [2.62, 7.05], 27.0, 0.8),
    point("EHL-16", "AR0205SR", [5.97, 8.98], 17.2, 0.4),
    point("EHL-16", "32room_000", [2.21, 4.81], 15.9, 1.0),
    point("EHL-16", "Berlin_0_256", [24.1, 28.0], 42.6, 1.2),
    point("EHL* 20 %", "arena2", [0.523, 1.27], 18.4, 10.3),
    point("EHL* 20 %", "brc202d", [0.844, 2.53], 44.1, 26.9),
    point("EHL* 20 %", "orz900d", [3.42, 3.67], 102.0, 102.0),
    point("EHL* 20 %", "lak303d", [0.901, 2.66], 20.7, 10.7),
    point("EHL* 20 %", "hrt201n", [0.636, 2.07], 16.3, 7.8),
    point("EHL* 20 %", "AR0011SR", [0.668, 2.59], 124.0, 128.0),
    point("EHL* 20 %", "AR0205SR", [0.853, 2.81], 73.2, 44.0),
    point("EHL* 20 %", "32room_000", [0.911, 2.88], 151.0, 66.3),
    point("EHL* 20 %", "Berlin_0_256", [1.94, 4.91], 138.0, 154.0),
    point("EHL* 5 %", "arena2", [0.868, 2.34], 4.63, 10.9),
    point("EHL* 5 %", "brc202d", [1.5, 3.29], 11.9, 25.8),
    point("EHL* 5 %", "orz900d", [3.45, 3.91], 30.1, 109.0),
    point("EHL* 5 %", "lak303d", [1.98, 4.95], 5.16, 10.7),
    point("EHL* 5 %", "hrt201n", [1.05, 2.64], 4.37, 8.0),
    point("EHL* 5 %", "AR0011SR", [1.06, 3.35], 30.9, 116.0),
    point("EHL* 5 %", "AR0205SR", [1.76, 5.16], 18.8, 46.2),
    point("EHL* 5 %", "32room_000", [0.972, 2.86], 37.2, 55.6),
    point("EHL* 5 %", "Berlin_0_256", [5.94, 11.8], 33.3, 169.0),
];

/// The times of the baselines within the hour on that machine, in microseconds: `pathfinding`, then
/// `grid_pathfinding`.
const YARDSTICKS: [(&str, f64, f64); 9] = [
    ("arena2", 1563.0, 107.8),
    ("brc202d", 3553.0, 462.9),
    ("orz900d", 12_570.0, 1434.0),
    ("lak303d", 1040.0, 205.5),
    ("hrt201n", 1170.0, 164.4),
    ("AR0011SR", 3472.0, 335.1),
    ("AR0205SR", 2070.0, 269.9),
    ("32room_000", 10_700.0, 417.1),
    ("Berlin_0_256", 1365.0, 253.6),
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
