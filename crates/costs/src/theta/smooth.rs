//! Smoothing that never raises the cost.

use mediant_grid::Vertex;
use mediant_moves::Cost;
use mediant_search::Path;

use super::push;
use crate::graph::CostGraph;

/// The most waypoints that a segment replaces at once. Further ones go in the next pass.
const SPAN: usize = 24;
/// The most passes.
const PASSES: usize = 6;

/// Makes a path straighter where that does not raise its cost: leaves waypoints out, so that segments run at
/// any angle. Of the ways over some of the waypoints of the path, a limited number ahead of each, it takes
/// one of the least cost, and of those one of the fewest segments. It does so again until nothing changes, a
/// few times at most.
///
/// Returns the path and its [`segments_cost`](CostGraph::segments_cost), which is not above that of the path
/// given; `None` for a path with a segment that is not legal. Its time follows the length of the path.
///
/// ```
/// use std::sync::Arc;
/// use mediant_costs::{CostAStar, CostGraph, CostSurface, smooth};
/// use mediant_grid::{CornerRule, Rules};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Ends, Planner};
///
/// let map = Arc::new(CostSurface::from_fn(12, 8, |_, y| Some(if y < 4 { 1.0 } else { 5.0 }))?);
/// let graph = Arc::new(CostGraph::new(map, Rules::Center(CornerRule::Never), FiniteK::N8)?);
/// let answer = CostAStar::new(Arc::clone(&graph)).solve(Ends::new((0, 0), (11, 2)))?;
/// let path = answer.path().expect("all cells are free");
/// let (smoothed, cost) = smooth(&graph, path).expect("its moves are legal");
/// assert_eq!(smoothed.to_string(), "(0, 0) → (11, 2)");
/// assert!(graph.path_cost(path).is_some_and(|before| cost < before));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn smooth(graph: &CostGraph, path: &Path) -> Option<(Path, Cost)> {
    let mut states = states(graph, path.waypoints())?;
    let mut cost = straightened(graph, &states)?.1;
    for _ in 0..PASSES {
        let (shorter, least) = straightened(graph, &states)?;
        let is_done = shorter.len() == states.len();
        (states, cost) = (shorter, least);
        if is_done {
            break;
        }
    }
    let mut waypoints: Vec<Vertex> = Vec::with_capacity(states.len());
    states.iter().for_each(|&state| push(graph, &mut waypoints, graph.vertex(state)));
    let cost = Cost::from_bits(cost);
    Some((Path::with_cost(waypoints, graph.to_f64(cost)), cost))
}

/// The states of the waypoints of a path. At a closed gap it is that of the quadrant from which the path
/// comes.
fn states(graph: &CostGraph, waypoints: &[Vertex]) -> Option<Vec<usize>> {
    let position = |at| graph.position(at).filter(|_| graph.is_free(at));
    let (gaps, weights) = (&graph.scanner().gaps, graph.map().weights());
    let mut states: Vec<usize> = Vec::with_capacity(waypoints.len());
    for (number, &at) in waypoints.iter().enumerate() {
        let before = number.checked_sub(1).map(|before| waypoints[before]);
        let state = match before {
            Some(before) if before == at => continue,
            Some(before) => gaps.state(weights, position(at)?, at.to(before)),
            None => graph
                .end(at)
                .filter(|_| graph.is_free(at))
                .or((waypoints.len() == 1).then_some(position(at)?))?,
        };
        states.push(state);
    }
    Some(states)
}

/// The cheapest way over some of these states, with the fewest segments, and its cost. `None` if two states
/// in a row are not joined by a legal segment.
fn straightened(graph: &CostGraph, states: &[usize]) -> Option<(Vec<usize>, u64)> {
    // Of each state the cost, the number of segments, and the place of the state before.
    let mut best = vec![(0_u64, 0_usize, 0_usize)];
    for to in 1..states.len() {
        let before = best[to - 1];
        let step = graph.line_between(states[to - 1], states[to], u64::MAX)?;
        let mut least = (before.0 + step, before.1 + 1, to - 1);
        for from in (to.saturating_sub(SPAN)..to - 1).rev() {
            let (cost, segments, _) = best[from];
            let Some(limit) = least.0.checked_sub(cost) else { continue };
            if let Some(line) = graph.line_between(states[from], states[to], limit) {
                least = least.min((cost + line, segments + 1, from));
            }
        }
        best.push(least);
    }
    let mut kept: Vec<usize> = Vec::new();
    let mut at = states.len().checked_sub(1);
    while let Some(place) = at {
        kept.push(states[place]);
        at = (place > 0).then(|| best[place].2);
    }
    kept.reverse();
    Some((kept, best.last()?.0))
}
