//! A* over N(k) (Hart, Nilsson & Raphael 1968), for every k, both placements and all rules of motion.
//!
//! Rule variant: a vertex is expanded with all its legal moves, nothing is pruned. Without a heuristic it
//! is Dijkstra's algorithm.

use std::ops::Deref;

use mediant_grid::{Lattice, Place, Vertex, VertexId};
use mediant_moves::Cost;

use crate::{
    Arrival, BestFirst, Distances, Heuristic, Query, QueryError, Successor, Successors, Zero,
    distances::end_at_gaps,
};

/// A* on a lattice.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, CornerRule, Lattice};
/// use mediant_moves::K;
/// use mediant_search::{AStar, LatticeDistance, Planner, Query};
///
/// let map = AsciiMap::parse("
///     ....
///     .##.
///     ....
/// ")?;
/// let lattice = Lattice::<Centers>::new(Arc::new(map.grid), K::new(3)?, CornerRule::Never)?;
/// let mut planner = AStar::new(&lattice, LatticeDistance);
/// let outcome = planner.solve(Query::new((0, 1), (3, 1)))?;
/// assert_eq!(outcome.path().map(|path| path.cost()), Some(5.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `L` is how the planner holds its lattice: by reference, or, where both belong in one struct, by `Arc`. Its scratch memory takes 16
/// bytes a vertex.
pub type AStar<L, H> = BestFirst<L, H, AllMoves>;

/// Dijkstra's algorithm (1959): A* without a heuristic.
pub type Dijkstra<L> = AStar<L, Zero>;

impl<P: Place, L: Deref<Target = Lattice<P>>, H: Heuristic> AStar<L, H> {
    /// A planner with scratch memory for `lattice`.
    #[must_use]
    pub fn new(lattice: L, heuristic: H) -> Self {
        Self::with(lattice, heuristic, AllMoves)
    }
}

impl<P: Place, L: Deref<Target = Lattice<P>>> Dijkstra<L> {
    /// What it costs to come from `start` to every vertex.
    ///
    /// # Errors
    /// [`QueryError`] when the start is blocked or outside the map.
    pub fn distances(&mut self, start: Vertex) -> Result<Distances<Cost>, QueryError> {
        Query::new(start, start).check(&self.lattice)?;
        if let Some(id) = self.lattice.id(start) {
            self.search(id, None, &mut ());
        }
        let ids = (0..self.lattice.vertex_count() as u32).map(VertexId);
        let mut costs: Vec<Option<Cost>> = ids.map(|id| self.cost_to(id)).collect();
        let arrived_by = |id| self.arrived_by(id);
        end_at_gaps(&self.lattice, start, &mut costs, arrived_by, |cost, step| cost + step.cost);
        Ok(Distances::new(P::vertices(self.lattice.grid()).0, costs))
    }
}

/// All legal moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AllMoves;

impl<P: Place> Successors<P> for AllMoves {
    type Link = ();

    #[inline]
    fn for_each(
        &self,
        lattice: &Lattice<P>,
        node: Arrival,
        goal: Vertex,
        mut visit: impl FnMut(Successor),
    ) -> u32 {
        lattice.for_each_successor(node.at, node.by, goal, move |by| visit(node.step(lattice, by)));
        0
    }
}
