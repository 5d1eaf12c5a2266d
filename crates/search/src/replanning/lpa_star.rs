//! LPA*.

use std::ops::Deref;

use mediant_grid::{Change, GridGraph, Identity, Placement, Rectangle};
use mediant_moves::Cost;

use super::{
    costs::{Lengths, MoveCosts},
    search::Replanner,
};
use crate::{
    answer::Answer,
    guarantee::Guarantee,
    observer::Observer,
    path::Path,
    query::{Ends, QueryError},
};

/// Cells anywhere may change, and a new search takes as long as A*: so it begins anew early
/// (`docs/measurements/replanning.md`).
const NODES_A_CELL: usize = 256;

/// LPA* over N(k) (Lifelong Planning A*; Koenig, Likhachev & Furcy 2004): answers one query again and again
/// while the map changes, and searches only what a change alters.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, Change, CornerRule, FreeSpace, GridGraph};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Ends, LpaStar};
///
/// let map = AsciiMap::parse("
///     ....
///     .##.
///     ....
/// ")?;
/// let space = FreeSpace::<Centers>::new(Arc::new(map.grid), CornerRule::Never);
/// let graph = Arc::new(GridGraph::in_space(&space, FiniteK::N8)?);
/// let mut planner = LpaStar::new(graph, Ends::new((0, 1), (3, 1)));
/// assert_eq!(planner.path()?.cost(), Some(5.0));
///
/// let change = Change::new(Arc::clone(space.grid())).edit_cells([(1, 1, false), (2, 1, false)]);
/// planner.change(Arc::new(GridGraph::in_space(&space.after(&change), FiniteK::N8)?), &change);
/// assert_eq!(planner.path()?.cost(), Some(3.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `G` is how it holds its grid graph: by `Arc` where the map changes; `C` says what moves cost. Its scratch
/// memory is 24 bytes for each vertex that searches touch, by pages of the system.
#[derive(Clone, Debug)]
pub struct LpaStar<G, C = Lengths> {
    search: Replanner<G, C>,
    ends: Ends,
    cost: Option<Cost>,
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>> LpaStar<G> {
    /// A planner for a query. Nothing is searched yet.
    #[must_use]
    pub fn new(graph: G, ends: impl Into<Ends>) -> Self {
        Self::with_costs(graph, Lengths, ends)
    }
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>, C: MoveCosts<P>> LpaStar<G, C> {
    /// The same with costs of one's own.
    #[must_use]
    pub fn with_costs(graph: G, costs: C, ends: impl Into<Ends>) -> Self {
        Self { search: Replanner::new(graph, costs, NODES_A_CELL), ends: ends.into(), cost: None }
    }

    /// A shortest path on the map as it is now.
    ///
    /// # Errors
    /// [`QueryError`] when an end is blocked or outside the map. After a change it may be free.
    pub fn path(&mut self) -> Result<Answer, QueryError> {
        self.path_observed(&mut ())
    }

    /// The same, watched by an observer, which cannot pause the search. A vertex may be expanded twice: once
    /// as its distance ends to hold, once with the new one.
    ///
    /// # Errors
    /// As for [`path`](Self::path).
    pub fn path_observed(&mut self, observer: &mut impl Observer) -> Result<Answer, QueryError> {
        self.cost = None;
        let Some((start, goal)) = self.ends.ids(&self.search.graph)? else { return Ok(Answer::Unreachable) };
        self.cost = self.search.search(start, goal, observer);
        Ok(self.cost.map_or(Answer::Unreachable, |_| {
            let mut waypoints = self.search.trace();
            waypoints.reverse();
            Answer::Found(Path::new(waypoints))
        }))
    }

    /// The exact cost of the path that was found last; `None` where there was none, or the map has changed
    /// since.
    #[must_use]
    pub const fn cost(&self) -> Option<Cost> {
        self.cost
    }

    /// Continues on the map after a change, on its grid graph. If that is not the one after this change of
    /// the map of this planner, with the same rules and k, all is searched anew; so it is after large
    /// changes.
    pub fn change(&mut self, graph: G, change: &Change)
    where
        C: Clone,
    {
        self.cost = None;
        self.search.change(graph, change);
    }

    /// Continues with another grid graph and other costs. Outside of `cells` map and costs must be the same
    /// as before: a move costs the same if it sweeps none of them.
    pub fn change_costs(&mut self, graph: G, costs: C, cells: &[Rectangle]) {
        self.cost = None;
        self.search.change_costs(graph, costs, cells);
    }

    /// The grid graph.
    #[must_use]
    pub fn graph(&self) -> &GridGraph<P> {
        &self.search.graph
    }

    /// The start and the goal.
    #[must_use]
    pub const fn ends(&self) -> Ends {
        self.ends
    }

    /// The guarantee of the paths: they are optimal.
    #[must_use]
    pub fn guarantee(&self) -> Guarantee {
        Guarantee::Optimal(self.search.graph.k())
    }

    /// The identity of the answers: the map, the rules of motion and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        self.search.graph.identity()
    }

    /// The memory used beyond the grid graph, in bytes, where searches have touched all of it.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.search.memory_bytes()
    }
}
