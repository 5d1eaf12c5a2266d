//! Smoothing: what is made of a path after the search. Its segments then run at any angle.
//!
//! | mean length over the any-angle optimum, A* over N(3), 300 random maps | as found | [`smooth`] | [`pull_taut`] | (Theta*) |
//! |---|--:|--:|--:|--:|
//! | corners, gaps open | 2.27 % | 0.17 % | 0.02 % | 0.16 % |
//! | corners, gaps closed | 2.38 % | 0.15 % | 0.01 % | 0.14 % |
//! | centers, corners never cut | 2.10 % | 0.77 % | 0.48 % | 0.77 % |
//!
//! On the maps ArcticStation, arena2, 8room_000 and AR0011SR (corners, k = 3) [`smooth`] takes up to 2 % of the time of A*, [`pull_taut`] 4 to 10 %;
//! on random512-10-0, where A* expands three vertices a cell of the path, 20 % and 140 %.

mod linear;
mod taut;

use std::ops::Deref;

use mediant_grid::{FreeSpace, GridGraph, Placement};

pub use self::{linear::smooth, taut::pull_taut};

use crate::{Guarantee, Observer, Outcome, Path, Planner, Query, QueryError};

/// How a path is smoothed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Smoothing {
    /// By [`smooth`]: the number of sight checks is linear in the length of the path.
    Linear,
    /// By [`pull_taut`]: until no waypoint can be skipped or moved.
    Taut,
}

impl Smoothing {
    /// The path, smoothed.
    #[must_use]
    pub fn apply<P: Placement>(self, space: &FreeSpace<P>, path: &Path) -> Path {
        Path::new(match self {
            Self::Linear => smooth(space, path.waypoints()),
            Self::Taut => pull_taut(space, path.waypoints()),
        })
    }
}

/// What has a free space: a [`FreeSpace`] and a [`GridGraph`].
pub trait HasFreeSpace {
    /// Its placement.
    type Placement: Placement;

    /// The free space.
    fn free_space(&self) -> &FreeSpace<Self::Placement>;
}

impl<P: Placement> HasFreeSpace for FreeSpace<P> {
    type Placement = P;

    fn free_space(&self) -> &Self {
        self
    }
}

impl<P: Placement> HasFreeSpace for GridGraph<P> {
    type Placement = P;

    fn free_space(&self) -> &FreeSpace<P> {
        self
    }
}

/// A planner whose paths are smoothed. What [`Planner::guarantee`] promises is [`Guarantee::AtMost`] for paths that were optimal over N(k).
///
/// `L` is how the free space is held: by reference or `Arc`, as a [`FreeSpace`] or a [`GridGraph`]. Smoothing, unlike searching, allocates.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, GridGraph};
/// use mediant_moves::FiniteK;
/// use mediant_search::{AStar, Guarantee, Hk, Planner, Query, Smoothed, Smoothing};
///
/// let map = AsciiMap::parse("
///     .....
///     ..#..
///     .....
/// ")?;
/// let (k, gap) = (FiniteK::new(3)?, DiagonalGap::Open);
/// let graph = Arc::new(GridGraph::<Corners>::new(Arc::new(map.grid), k, gap)?);
/// let search = AStar::new(Arc::clone(&graph), Hk);
/// let mut planner = Smoothed::new(search, graph, Some(Smoothing::Taut));
/// let outcome = planner.solve(Query::new((0, 0), (5, 3)))?;
/// let expected = [(0, 0), (2, 2), (5, 3)].map(Into::into);
/// assert_eq!(outcome.path().map(|path| path.waypoints()), Some(&expected[..]));
/// assert_eq!(planner.guarantee(), Guarantee::AtMost(k));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Smoothed<L, E> {
    planner: E,
    space: L,
    smoothing: Option<Smoothing>,
}

impl<L, E> Smoothed<L, E>
where
    L: Deref<Target: HasFreeSpace>,
    E: Planner,
{
    /// Smooths the paths of `planner`; with `None`, passes them on as they are.
    #[must_use]
    pub const fn new(planner: E, space: L, smoothing: Option<Smoothing>) -> Self {
        Self { planner, space, smoothing }
    }
}

impl<L, E> Planner for Smoothed<L, E>
where
    L: Deref<Target: HasFreeSpace>,
    E: Planner,
{
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        let outcome = self.planner.solve_observed(query, observer)?;
        Ok(match (outcome, self.smoothing) {
            (Outcome::Found(path), Some(smoothing)) => {
                Outcome::Found(smoothing.apply(self.space.free_space(), &path))
            }
            (outcome, _) => outcome,
        })
    }

    fn guarantee(&self) -> Guarantee {
        let guarantee = self.planner.guarantee();
        if self.smoothing.is_some() { guarantee.smoothed() } else { guarantee }
    }
}
