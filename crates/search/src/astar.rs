//! A* over N(k) (Hart, Nilsson & Raphael 1968), for every k, both placements and all rules of motion.
//!
//! Rule variant: a vertex is expanded with all its legal moves; nothing is pruned. Without a heuristic this
//! is Dijkstra's algorithm.

use std::ops::Deref;

use mediant_grid::{GridGraph, Placement, Vertex};
use mediant_moves::Cost;

use crate::{
    best_first::BestFirst,
    heuristic::{Heuristic, Zero},
    observer::{Observer, Part},
    path::Path,
    planner::{Planner, SearchStatus},
    query::{Ends, QueryError},
    successors::{ExpandedNode, KnownPath, Successor, Successors},
};

/// A* on a grid graph.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph};
/// use mediant_moves::FiniteK;
/// use mediant_search::{AStar, Ends, Hk, Planner};
///
/// let map = AsciiMap::parse("
///     ....
///     .##.
///     ....
/// ")?;
/// let graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::new(3)?, CornerRule::Never)?;
/// let mut planner = AStar::new(&graph, Hk);
/// let answer = planner.solve(Ends::new((0, 1), (3, 1)))?;
/// assert_eq!(answer.path().map(|path| path.cost()), Some(5.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `G` is how the planner holds its grid graph: by reference, or, where both belong in one struct, by `Arc`.
/// Its scratch memory is 16 bytes for each vertex that searches touch, by pages of the system.
pub type AStar<G, H> = BestFirst<G, H, AllMoves>;

/// Dijkstra's algorithm (1959): A* without a heuristic. For the distances of all vertices,
/// [`Fields`](crate::Fields) are much faster.
pub type Dijkstra<G> = AStar<G, Zero>;

impl<P: Placement, G: Deref<Target = GridGraph<P>>, H: Heuristic> AStar<G, H> {
    /// A planner with scratch memory for `graph`.
    #[must_use]
    pub fn new(graph: G, heuristic: H) -> Self {
        Self::with_successors(graph, heuristic, AllMoves)
    }

    /// Continues with another grid graph: that of a map after an edit. The search that was begun last is
    /// forgotten. The scratch memory is kept if the grid graph has as many vertices.
    pub fn follow(&mut self, graph: G) {
        self.follow_graph(graph);
    }

    /// Extends a path from its last waypoint to `goal`, if that costs at most `limit`; vertices through which
    /// every path costs more are not expanded. Returns whether there is such a path (with an inadmissible
    /// heuristic one may be missed). If not, or if `path` is empty, it is left as it is.
    ///
    /// # Errors
    /// [`QueryError`] when the last waypoint or the goal is blocked or outside the map.
    pub fn extend(
        &mut self,
        path: &mut Vec<Vertex>,
        goal: Vertex,
        limit: Cost,
        observer: &mut impl Observer,
    ) -> Result<bool, QueryError> {
        let Some(&start) = path.last() else { return Ok(false) };
        let mut observer = Part::new(observer);
        // h_k of a single move is its cost, so that no path beyond the limit reaches the goal.
        self.begin_within(Ends::new(start, goal), limit, &mut observer)?;
        let found = self.proceed(&mut observer)? == SearchStatus::Found;
        if found {
            self.extend_to(path, goal);
        }
        Ok(found)
    }

    /// After a search from its last waypoint, extends a path to a vertex that the search has reached.
    pub fn extend_to(&self, path: &mut Vec<Vertex>, to: Vertex) {
        if let Some(to) = self.graph.id(to).filter(|&to| !path.is_empty() && self.knows(to)) {
            self.extend_back(to, path);
        }
    }

    /// Finds a path that costs at most `limit`, as [`extend`](Self::extend) does.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    pub fn solve_within(
        &mut self,
        query: Ends,
        limit: Cost,
        observer: &mut impl Observer,
    ) -> Result<Option<Path>, QueryError> {
        query.check(&self.graph)?;
        let mut path = vec![query.start];
        Ok(self.extend(&mut path, query.goal, limit, observer)?.then(|| Path::new(path)))
    }
}

/// All legal moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AllMoves;

impl<P: Placement> Successors<P> for AllMoves {
    type ParentPointer = ();

    const DEPEND_ON_ARRIVAL: bool = false;

    #[inline]
    fn for_each(
        &self,
        graph: &GridGraph<P>,
        node: ExpandedNode,
        goal: Vertex,
        mut visit: impl FnMut(Successor) -> KnownPath,
    ) -> u32 {
        graph.for_each_successor(node.at, node.by, goal, move |by| {
            visit(node.step(graph, by));
        });
        0
    }
}
