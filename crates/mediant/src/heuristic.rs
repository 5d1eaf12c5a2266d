//! The heuristics that never overestimate, as one type.

use mediant_grid::{GridGraph, Placement, Vector};
use mediant_moves::Cost;
use mediant_search::{Euclidean, Heuristic, Hk, Zero};

/// One of the heuristics that never overestimate, chosen at run time: every engine but A* is compiled for
/// this type alone. Its branch for each estimate takes at most 0.4 % of the instructions of a query
/// (canonical A*, k = 3). Compiling those engines for h_k as well makes the release build of this crate a
/// fifth longer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Admissible {
    /// The cost on an empty grid.
    Hk,
    /// The straight-line distance.
    Euclidean,
    /// 0 everywhere.
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
