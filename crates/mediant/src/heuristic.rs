//! The heuristics that never overestimate, as one type.

use mediant_grid::{GridGraph, Placement, Vector};
use mediant_moves::Cost;
use mediant_search::{Euclidean, Heuristic, Hk, Zero};

use crate::{engine::Engine, option::HeuristicName, setup_error::SetupError};

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

impl Admissible {
    /// The heuristic of this name, or by default h_k.
    ///
    /// # Errors
    /// [`SetupError::Option`] for one that overestimates.
    #[cfg_attr(
        not(feature = "publications"),
        expect(clippy::unnecessary_wraps, unused_variables, reason = "no heuristic overestimates")
    )]
    pub(crate) fn new(engine: Engine, name: Option<HeuristicName>) -> Result<Self, SetupError> {
        match name.unwrap_or_default() {
            HeuristicName::Hk => Ok(Self::Hk),
            HeuristicName::Euclidean => Ok(Self::Euclidean),
            HeuristicName::Zero => Ok(Self::Zero),
            #[cfg(feature = "publications")]
            HeuristicName::SquaredEuclidean => Err(SetupError::overestimates(engine)),
        }
    }
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
