//! Validation of an any-angle path between points: its segments and its stated cost.

use std::{error::Error, fmt};

use mediant_grid::{DiagonalGap, Grid};

use super::{Parts, distance, point_is_free, segment_between_points_is_legal, turn_at_point_is_legal};
use crate::validate::is_close;

/// A fault of a path between points, and the index of the waypoint where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PointFault {
    /// The first waypoint is not the start, or there is none.
    Start,
    /// The last waypoint is not the goal.
    Goal,
    /// Start and goal are the same, but there are so many waypoints, not 1.
    Detour(usize),
    /// This waypoint is blocked or outside the map.
    NotFree(usize),
    /// This waypoint is the same as the one before.
    Still(usize),
    /// The segment to this waypoint from the one before breaks the rules of motion.
    Segment(usize),
    /// At this waypoint the path passes through a closed gap, or starts or ends in a forbidden quadrant of
    /// one.
    Turn(usize),
    /// The stated cost is not the length of the path.
    Cost {
        /// The cost that was stated.
        stated: f64,
        /// The length of the path.
        measured: f64,
    },
}

impl fmt::Display for PointFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Start => write!(f, "the path does not begin with the start"),
            Self::Goal => write!(f, "the path does not end with the goal"),
            Self::Detour(waypoints) => {
                write!(f, "start and goal are the same, but the path has {waypoints} waypoints, not 1")
            }
            Self::NotFree(index) => write!(f, "waypoint {index} is blocked or outside the map"),
            Self::Still(index) => write!(f, "waypoint {index} is the same as the one before"),
            Self::Segment(index) => write!(f, "the segment to waypoint {index} is not legal"),
            Self::Turn(index) => {
                write!(f, "waypoint {index} is a gap, and the path crosses it or uses a forbidden quadrant")
            }
            Self::Cost { stated, measured } => {
                write!(f, "the cost is given as {stated}, but the path measures {measured}")
            }
        }
    }
}

impl Error for PointFault {}

/// Checks that `waypoints` is a legal path from `start` to `goal` whose length is `cost`, in cells.
///
/// It may bend anywhere. If start and goal are the same, the path is this one waypoint, with cost 0. Whether
/// a shorter path exists is not checked.
///
/// # Errors
/// The first [`PointFault`] that is found.
pub fn validate_between_points(
    grid: &Grid,
    gap: DiagonalGap,
    start: Parts,
    goal: Parts,
    waypoints: &[Parts],
    cost: f64,
) -> Result<(), PointFault> {
    if waypoints.first() != Some(&start) {
        return Err(PointFault::Start);
    }
    if waypoints.last() != Some(&goal) {
        return Err(PointFault::Goal);
    }
    if start == goal && waypoints.len() > 1 {
        return Err(PointFault::Detour(waypoints.len()));
    }
    for (index, &at) in waypoints.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| waypoints[before]);
        let after = waypoints.get(index + 1).copied();
        if !point_is_free(grid, at) {
            return Err(PointFault::NotFree(index));
        }
        if before == Some(at) {
            return Err(PointFault::Still(index));
        }
        if before.is_some_and(|before| !segment_between_points_is_legal(grid, gap, before, at)) {
            return Err(PointFault::Segment(index));
        }
        if gap == DiagonalGap::Closed && !turn_at_point_is_legal(grid, before, at, after) {
            return Err(PointFault::Turn(index));
        }
    }
    let measured = waypoints.windows(2).fold(0.0, |sum, pair| sum + distance(pair[0], pair[1]));
    if is_close(cost, measured) { Ok(()) } else { Err(PointFault::Cost { stated: cost, measured }) }
}
