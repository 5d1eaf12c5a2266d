//! The cost of a given path.

use mediant_grid::{Rules, Vertex};
use mediant_moves::FiniteK;

use super::{Integral, WeightedMap};
use crate::{Fault, validate::legal_steps};

/// The cost of a path: the sum of the costs of its moves. Two consecutive waypoints must be joined by
/// repetitions of one move of N(k), each of which is a move of its own; for k = `None` by one legal segment.
/// A path of one waypoint costs 0, and so does one of none.
///
/// # Errors
/// The first [`Fault`] of the moves. Whether the path is optimal is not checked.
///
/// # Panics
/// If the cost exceeds 64 bits.
pub fn weighted_path_cost(
    map: &WeightedMap,
    rules: Rules,
    k: Option<FiniteK>,
    waypoints: &[Vertex],
    move_cost: impl Fn(&Integral) -> u64,
) -> Result<u64, Fault> {
    let integrals = integrals(map, rules, k, waypoints)?;
    let add = |sum: u64, integral| sum.checked_add(move_cost(integral)).expect("costs fit in 64 bits");
    Ok(integrals.iter().fold(0, add))
}

/// The cost of a path as in [`weighted_path_cost`], where a move costs its integral times its length on the
/// map's cells, in floating point.
///
/// # Errors
/// The first [`Fault`] of the moves.
pub fn weighted_path_length(
    map: &WeightedMap,
    rules: Rules,
    k: Option<FiniteK>,
    waypoints: &[Vertex],
) -> Result<f64, Fault> {
    let integrals = integrals(map, rules, k, waypoints)?;
    Ok(integrals.iter().fold(0.0, |sum, integral| sum + integral.length(map.cell_size())))
}

fn integrals(
    map: &WeightedMap,
    rules: Rules,
    k: Option<FiniteK>,
    waypoints: &[Vertex],
) -> Result<Vec<Integral>, Fault> {
    let steps = legal_steps(map.grid(), rules, k, waypoints)?;
    let integral = |pair: &[Vertex]| {
        let integral = map.integral(rules.placement(), pair[0], pair[1]);
        integral.expect("a legal segment has a free cell everywhere")
    };
    Ok(steps.windows(2).map(integral).collect())
}
