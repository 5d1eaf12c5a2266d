//! Validation of a path: its moves and its stated cost.

use std::{error::Error, fmt};

use mediant_grid::{DiagonalGap, Grid, Rules, Vertex};
use mediant_moves::{FiniteK, Vector};

use crate::{
    legality::{Footprint, segment_is_legal, turn_is_legal, vertex_is_free},
    neighborhood,
};

/// The largest relative difference between a stated cost and the length of the path.
const TOLERANCE: f64 = 1e-9;

/// Whether a stated cost is the measured length of a path, but for rounding.
pub(crate) fn is_close(stated: f64, measured: f64) -> bool {
    (stated - measured).abs() <= TOLERANCE * measured
}

/// A fault of a path, and its place.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// There is no waypoint at all.
    Empty {
        /// The start.
        start: Vertex,
        /// The goal.
        goal: Vertex,
    },
    /// The first waypoint is not the start.
    Start {
        /// The start.
        expected: Vertex,
        /// The first waypoint.
        found: Vertex,
    },
    /// The last waypoint is not the goal.
    Goal {
        /// The goal.
        expected: Vertex,
        /// The last waypoint.
        found: Vertex,
    },
    /// Start and goal are the same, but there is more than one waypoint.
    Detour {
        /// Start and goal.
        at: Vertex,
        /// The number of waypoints.
        waypoints: usize,
    },
    /// A waypoint is blocked or outside the map.
    NotFree {
        /// The index of the waypoint, from 0.
        index: usize,
        /// The waypoint.
        at: Vertex,
    },
    /// Two consecutive waypoints are the same.
    Still {
        /// The index of the second one, from 0.
        index: usize,
        /// The waypoint.
        at: Vertex,
    },
    /// Two consecutive waypoints are not joined by a repeated move of N(k).
    NotAMove {
        /// The first waypoint.
        from: Vertex,
        /// The second waypoint.
        to: Vertex,
        /// The neighborhood.
        k: FiniteK,
    },
    /// A move or segment breaks the rules of motion.
    Segment {
        /// Where it begins.
        from: Vertex,
        /// Where it ends.
        to: Vertex,
        /// The rules.
        rules: Rules,
    },
    /// The path passes through a closed gap, or starts or ends in a forbidden quadrant of one.
    Turn {
        /// The vertex before the gap, `None` at the start.
        before: Option<Vertex>,
        /// The gap.
        at: Vertex,
        /// The vertex after the gap, `None` at the goal.
        after: Option<Vertex>,
    },
    /// The stated cost is not the length of the path.
    Cost {
        /// The cost that was stated.
        stated: f64,
        /// The length of the path.
        measured: f64,
        /// The start.
        start: Vertex,
        /// The goal.
        goal: Vertex,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |at: &Option<Vertex>, end: &str| at.map_or_else(|| end.to_owned(), |at| at.to_string());
        match self {
            Self::Empty { start, goal } => write!(f, "the path from {start} to {goal} has no waypoint"),
            Self::Start { expected, found } => write!(f, "the path starts at {found}, not at {expected}"),
            Self::Goal { expected, found } => write!(f, "the path ends at {found}, not at {expected}"),
            Self::Detour { at, waypoints } => {
                write!(f, "start and goal are both {at}, but the path has {waypoints} waypoints, not 1")
            }
            Self::NotFree { index, at } => {
                write!(f, "waypoint {index}, {at}, is blocked or outside the map")
            }
            Self::Still { index, at } => write!(f, "waypoint {index}, {at}, is the same as the one before"),
            Self::NotAMove { from, to, k } => {
                write!(f, "no move of N({k}), repeated, leads from {from} to {to}")
            }
            Self::Segment { from, to, rules } => {
                write!(f, "the segment from {from} to {to} is not legal ({rules})")
            }
            Self::Turn { before, at, after } => write!(
                f,
                "the path crosses the gap {at} or uses a quadrant of it that it may not: {} → {at} → {}",
                name(before, "start"),
                name(after, "goal")
            ),
            Self::Cost { stated, measured, start, goal } => {
                write!(
                    f,
                    "the cost from {start} to {goal} is given as {stated}, but the path measures {measured}"
                )
            }
        }
    }
}

impl Error for Fault {}

/// Checks that `waypoints` is a legal path from `start` to `goal` whose length is `cost`, in cells.
///
/// With k, two consecutive waypoints must be joined by repetitions of one move of N(k), each of them legal;
/// for k = `None`, by one legal segment. If start and goal are the same, the path is this one waypoint, with
/// cost 0. Whether a shorter path exists is not checked.
///
/// # Errors
/// The first [`Fault`] that is found.
pub fn validate(
    grid: &Grid,
    rules: Rules,
    k: Option<FiniteK>,
    start: Vertex,
    goal: Vertex,
    waypoints: &[Vertex],
    cost: f64,
) -> Result<(), Fault> {
    check_ends(start, goal, waypoints)?;
    legal_steps(grid, rules, k, waypoints)?;
    let measured = waypoints.windows(2).fold(0.0, |sum, pair| sum + length(pair[0].to(pair[1])));
    if is_close(cost, measured) { Ok(()) } else { Err(Fault::Cost { stated: cost, measured, start, goal }) }
}

/// All vertices of a path, with one vertex a move of N(k), or, for k = `None`, the waypoints; the first fault
/// of its moves otherwise.
pub(crate) fn legal_steps(
    grid: &Grid,
    rules: Rules,
    k: Option<FiniteK>,
    waypoints: &[Vertex],
) -> Result<Vec<Vertex>, Fault> {
    let blocked = |at: &Vertex| !vertex_is_free(grid, rules.placement(), *at);
    if let Some(index) = waypoints.iter().position(blocked) {
        return Err(Fault::NotFree { index, at: waypoints[index] });
    }
    let moves = k.map(|k| (k, neighborhood(Some(k), grid.width(), grid.height())));
    let mut path: Vec<Vertex> = waypoints.first().copied().into_iter().collect();
    for (pair, index) in waypoints.windows(2).zip(1..) {
        let (from, to) = (pair[0], pair[1]);
        if from == to {
            return Err(Fault::Still { index, at: to });
        }
        match &moves {
            Some((k, moves)) => check_repeated_move(grid, rules, (*k, moves), (from, to), &mut path)?,
            None if segment_is_legal(grid, rules, from, to) => path.push(to),
            None => return Err(Fault::Segment { from, to, rules }),
        }
    }
    if rules == Rules::Corner(DiagonalGap::Closed) {
        check_turns(grid, &path)?;
    }
    Ok(path)
}

fn check_ends(start: Vertex, goal: Vertex, waypoints: &[Vertex]) -> Result<(), Fault> {
    let (Some(&first), Some(&last)) = (waypoints.first(), waypoints.last()) else {
        return Err(Fault::Empty { start, goal });
    };
    if first != start {
        return Err(Fault::Start { expected: start, found: first });
    }
    if last != goal {
        return Err(Fault::Goal { expected: goal, found: last });
    }
    if start == goal && waypoints.len() > 1 {
        return Err(Fault::Detour { at: start, waypoints: waypoints.len() });
    }
    Ok(())
}

/// Appends every vertex after `from` up to `to`.
fn check_repeated_move(
    grid: &Grid,
    rules: Rules,
    (k, moves): (FiniteK, &[Vector]),
    (from, to): (Vertex, Vertex),
    path: &mut Vec<Vertex>,
) -> Result<(), Fault> {
    let total = from.to(to);
    let mut divisors = (1..=total.x.abs().max(total.y.abs())).rev();
    let times = divisors.find(|n| total.x % n == 0 && total.y % n == 0).unwrap_or(1);
    let step = Vector::new(total.x / times, total.y / times);
    if moves.binary_search(&step).is_err() {
        return Err(Fault::NotAMove { from, to, k });
    }
    let footprint = Footprint::new(rules.placement(), step);
    let mut at = from;
    for _ in 0..times {
        if !footprint.is_legal(grid, rules, at) {
            return Err(Fault::Segment { from: at, to: at + step, rules });
        }
        at = at + step;
        path.push(at);
    }
    Ok(())
}

fn check_turns(grid: &Grid, path: &[Vertex]) -> Result<(), Fault> {
    for (i, &at) in path.iter().enumerate() {
        let before = i.checked_sub(1).map(|i| path[i]);
        let after = path.get(i + 1).copied();
        if !turn_is_legal(grid, before, at, after) {
            return Err(Fault::Turn { before, at, after });
        }
    }
    Ok(())
}

fn length(d: Vector) -> f64 {
    f64::from(d.x).hypot(f64::from(d.y))
}
