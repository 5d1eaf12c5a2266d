//! Smoothing: makes a path shorter after the search. Its segments then run at any angle.
//!
//! At corners, k = 3, paths are 2.3 % longer than the any-angle optimum on average, after [`smooth`] 0.2 %,
//! after [`pull_taut`] 0.02 %. Except in noise this costs up to 2 % and 10 % of the time of A*
//! (`docs/measurements/search.md`).

mod linear;
mod taut;

use std::ops::Deref;

use mediant_grid::{FreeSpace, GridGraph, Identity, Mismatch, Placement, Vertex, names};

pub use self::{linear::smooth, taut::pull_taut};
use self::{linear::smooth_bends, taut::pull_bends};

use crate::{
    guarantee::Guarantee,
    observer::Observer,
    path::Path,
    planner::{Planner, SearchStatus},
    query::{Ends, QueryError},
};

/// How a path is smoothed.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{Centers, CornerRule, FreeSpace, Grid};
/// use mediant_search::{Path, Smoothing};
///
/// let space = FreeSpace::<Centers>::new(Arc::new(Grid::from_fn(6, 3, |_, _| false)?), CornerRule::Never);
/// // Over eight directions: straight, and then diagonally.
/// let path = Path::new(vec![(0, 0).into(), (3, 0).into(), (5, 2).into()]);
/// let taut = Smoothing::Taut.apply(&space, &path);
/// assert_eq!(taut.to_string(), "(0, 0) → (5, 2)");
/// assert!(taut.cost() < path.cost());
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Smoothing {
    /// By [`smooth`]: with a number of sight checks that is linear in the length of the path.
    Linear,
    /// By [`pull_taut`]: until no waypoint can be left out or moved.
    Taut,
}

names!(Smoothing: Linear => "linear", Taut => "taut");

impl Smoothing {
    /// Smooths a path. One with points that are no vertices stays as it is: it leads at any angle already.
    #[must_use]
    pub fn apply<P: Placement>(self, space: &FreeSpace<P>, path: &Path) -> Path {
        if path.waypoints().is_empty() {
            return path.clone();
        }
        Path::new(match self {
            Self::Linear => smooth(space, path.waypoints()),
            Self::Taut => pull_taut(space, path.waypoints()),
        })
    }

    /// Smooths a path that is known by its bends: see [`Planner::bends_to`], which may be relied on. They
    /// are all that linear smoothing considers, so it tests sight once or twice for each. Bends outside the
    /// map are left as they are.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace};
    /// use mediant_search::Smoothing;
    /// let map = AsciiMap::parse("
    ///     ......
    ///     ..#...
    ///     ......
    /// ")?;
    /// let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
    /// // Around the obstacle on the side where that is longer.
    /// let bends = [(2, 3), (2, 1), (5, 1)].map(Into::into);
    /// let path = Smoothing::Linear.apply_to_bends(&space, &bends);
    /// assert_eq!(path.to_string(), "(2, 3) → (5, 1)");
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    #[must_use]
    pub fn apply_to_bends<P: Placement>(self, space: &FreeSpace<P>, bends: &[Vertex]) -> Path {
        if bends.iter().any(|&at| space.id(at).is_none()) {
            return Path::new(bends.to_vec());
        }
        Path::new(match self {
            Self::Linear => smooth_bends(space, bends),
            Self::Taut => pull_bends(space, bends),
        })
    }
}

/// Owners of a free space: [`FreeSpace`] itself and [`GridGraph`].
pub trait HasFreeSpace {
    /// Its placement.
    type Placement: Placement;

    /// The free space.
    fn free_space(&self) -> &FreeSpace<Self::Placement>;

    /// The identity: of a grid graph with its k, of a free space with every k.
    fn identity(&self) -> Identity;
}

impl<P: Placement> HasFreeSpace for FreeSpace<P> {
    type Placement = P;

    fn free_space(&self) -> &Self {
        self
    }

    fn identity(&self) -> Identity {
        self.identity()
    }
}

impl<P: Placement> HasFreeSpace for GridGraph<P> {
    type Placement = P;

    fn free_space(&self) -> &FreeSpace<P> {
        self
    }

    fn identity(&self) -> Identity {
        self.identity()
    }
}

/// A planner whose paths are smoothed. Its [`guarantee`](Planner::guarantee) is [`Guarantee::AtMost`] if the
/// paths were optimal over N(k).
///
/// `S` is how the free space is held: by reference or `Arc`, as a [`FreeSpace`] or a [`GridGraph`].
/// Smoothing, unlike searching, allocates.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, GridGraph};
/// use mediant_moves::FiniteK;
/// use mediant_search::{AStar, Ends, Guarantee, Hk, Planner, Smoothed, Smoothing};
///
/// let map = AsciiMap::parse("
///     .....
///     ..#..
///     .....
/// ")?;
/// let (k, gap) = (FiniteK::new(3)?, DiagonalGap::Open);
/// let graph = Arc::new(GridGraph::<Corners>::new(Arc::new(map.grid), k, gap)?);
/// let search = AStar::new(Arc::clone(&graph), Hk);
/// let mut planner = Smoothed::new(search, graph, Some(Smoothing::Taut))?;
/// let answer = planner.solve(Ends::new((0, 0), (5, 3)))?;
/// let expected = [(0, 0), (2, 2), (5, 3)].map(Into::into);
/// assert_eq!(answer.path().map(|path| path.waypoints()), Some(&expected[..]));
/// assert_eq!(planner.guarantee(), Guarantee::AtMost(k));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Smoothed<S, E> {
    planner: E,
    space: S,
    smoothing: Option<Smoothing>,
}

impl<S, E> Smoothed<S, E>
where
    S: Deref<Target: HasFreeSpace>,
    E: Planner,
{
    /// Smooths the paths of `planner`; with `None` leaves them as they are.
    ///
    /// # Errors
    /// [`Mismatch`] for a planner of another map or of other rules than `space`, or, if that is a grid graph,
    /// of another k.
    pub fn new(planner: E, space: S, smoothing: Option<Smoothing>) -> Result<Self, Mismatch> {
        planner.identity().check("the planner", ("the space", space.identity()))?;
        Ok(Self { planner, space, smoothing })
    }
}

impl<S, E> Planner for Smoothed<S, E>
where
    S: Deref<Target: HasFreeSpace>,
    E: Planner,
{
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.planner.begin(query, observer)
    }

    fn begin_from(
        &mut self,
        starts: &[Vertex],
        goal: Vertex,
        observer: &mut impl Observer,
    ) -> Option<SearchStatus> {
        self.planner.begin_from(starts, goal, observer)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.planner.proceed(observer)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        let Some(smoothing) = self.smoothing else { return self.planner.path_to(at) };
        let space = self.space.free_space();
        if let Some(bends) = self.planner.bends_to(at) {
            return Some(smoothing.apply_to_bends(space, &bends));
        }
        Some(smoothing.apply(space, &self.planner.path_to(at)?))
    }

    fn distance(&mut self, query: Ends) -> Result<Option<f64>, QueryError> {
        match self.smoothing {
            Some(_) => Ok(self.solve(query)?.cost()),
            None => self.planner.distance(query),
        }
    }

    fn guarantee(&self) -> Guarantee {
        let guarantee = self.planner.guarantee();
        if self.smoothing.is_some() { guarantee.smoothed() } else { guarantee }
    }

    fn identity(&self) -> Identity {
        self.planner.identity()
    }
}
