//! Heuristics that are chosen at run time.

use mediant_grid::{GridGraph, Placement, Vector};
use mediant_moves::Cost;
use mediant_search::{Euclidean, Heuristic, Hk, Zero};

/// One of the heuristics that never overestimate. h_k, which is the default of every engine, has searches compiled for it; the
/// others share those for this type, at the cost of a branch an estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Admissible {
    Hk,
    Euclidean,
    Zero,
}

impl Heuristic for Admissible {
    #[inline]
    fn estimate<P: Placement>(self, graph: &GridGraph<P>, to_goal: Vector) -> Cost {
        match self {
            Self::Hk => Hk.estimate(graph, to_goal),
            Self::Euclidean => Euclidean.estimate(graph, to_goal),
            Self::Zero => Zero.estimate(graph, to_goal),
        }
    }
}
