//! Time and memory of EHL, Euclidean hub labels (Du, Shen & Cheema 2023), and of EHL* (the same with regions
//! merged under a budget of memory).
//!
//! The authors' programs ran on 22 November 2026 on the instances of this comparison, one thread, warm,
//! median of the passes, beside Mediant and the two baselines, on two virtual cores of an AMD EPYC
//! (`docs/measurements/compared.md`, 'What EHL pays'). Sizes and times of preparation were not noted on each
//! map.

use mediant_bench::Baseline;

/// A program on a map, on the machine and day of the measurement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) program: &'static str,
    pub(super) map: &'static str,
    /// Mean time of a query, in microseconds.
    pub(super) micros: f64,
    /// The size of the index in 10⁶ bytes.
    pub(super) megabytes: Option<f64>,
    /// The seconds that it took to build.
    pub(super) seconds: Option<f64>,
}

const fn point(
    program: &'static str,
    map: &'static str,
    micros: f64,
    megabytes: Option<f64>,
    seconds: Option<f64>,
) -> Point {
    Point { program, map, micros, megabytes, seconds }
}

/// The programs: the number is the side of a region in cells.
pub(super) const PROGRAMS: [&str; 4] = ["EHL-1", "EHL*", "EHL-4", "EHL-16"];

pub(super) const POINTS: [Point; 18] = [
    point("EHL-1", "arena2", 0.34, Some(77.0), Some(5.0)),
    point("EHL-1", "lak303d", 0.68, Some(87.0), None),
    point("EHL-1", "AR0011SR", 0.66, Some(518.0), Some(63.0)),
    point("EHL-1", "Berlin_0_256", 1.31, Some(571.0), Some(82.0)),
    point("EHL*", "arena2", 0.45, Some(22.0), Some(7.5)),
    point("EHL*", "arena2", 0.72, Some(11.0), Some(7.5)),
    point("EHL-4", "brc202d", 1.55, None, None),
    point("EHL-4", "hrt201n", 0.71, Some(14.0), Some(0.6)),
    point("EHL-4", "AR0205SR", 1.06, None, None),
    point("EHL-4", "AR0700SR", 4.11, None, None),
    point("EHL-4", "32room_000", 0.87, None, None),
    point("EHL-4", "Paris_1_512", 5.99, Some(824.0), Some(47.0)),
    point("EHL-16", "brc202d", 5.93, None, None),
    point("EHL-16", "hrt201n", 1.52, None, None),
    point("EHL-16", "AR0205SR", 6.58, None, None),
    point("EHL-16", "AR0700SR", 13.7, None, None),
    point("EHL-16", "32room_000", 3.96, None, None),
    point("EHL-16", "Paris_1_512", 23.6, None, None),
];

/// The times of the baselines on that machine, in microseconds: `pathfinding`, then `grid_pathfinding`.
const YARDSTICKS: [(&str, f64, f64); 10] = [
    ("arena2", 1558.0, 94.7),
    ("brc202d", 3522.0, 403.0),
    ("lak303d", 919.0, 166.0),
    ("hrt201n", 1098.0, 147.0),
    ("AR0011SR", 3357.0, 271.0),
    ("AR0205SR", 1836.0, 219.0),
    ("AR0700SR", 2254.0, 297.0),
    ("32room_000", 8419.0, 347.0),
    ("Berlin_0_256", 1242.0, 218.0),
    ("Paris_1_512", 5629.0, 1325.0),
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
