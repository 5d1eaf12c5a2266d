//! What a placement of the vertices decides: which vertices are subgoals, and which edges join them.

use mediant_grid::{BitMatrix, FreeSpace, Placement, Vector, Vertex};
use mediant_moves::{Cost, K};
use mediant_search::parts::Metric;

use crate::{error::SubgoalError, hierarchy::Hierarchy, subgoals::Subgoals};

/// A placement that has subgoal graphs: [`Corners`](mediant_grid::Corners) has them for every k,
/// [`Centers`](mediant_grid::Centers) for k = 2 and 3.
///
/// Sealed: it cannot be implemented for other types.
pub trait SubgoalPlacement: EdgeFinder {}

/// Finds subgoals and edges. Public as [`SubgoalPlacement`] builds on it, but it cannot be named outside of
/// this crate.
pub trait EdgeFinder: Placement {
    /// Scratch memory of [`edges_from`](Self::edges_from).
    type Scratch: Default + Send;

    /// What follows from the map alone and makes finding edges fast.
    type Tables: EdgeTables;

    /// Whether this free space has subgoal graphs for this k.
    fn check(space: &FreeSpace<Self>, k: K) -> Result<(), SubgoalError>;

    /// The subgoals, a bit for each vertex in a frame of zeros, and the tables.
    fn prepare(space: &FreeSpace<Self>) -> (BitMatrix, Self::Tables);

    /// Which subgoals an edge joins.
    fn edge_criterion(k: K, hierarchy: Hierarchy) -> EdgeCriterion;

    /// Calls `visit` with the subgoal that each edge of a vertex leads to, and its cost.
    fn edges_from(
        context: BuildContext<'_, Self>,
        scratch: &mut Self::Scratch,
        from: Vertex,
        kind: EdgeKind,
        visit: impl FnMut(u32, Cost),
    );
}

/// What follows from a map alone and makes finding edges fast.
pub trait EdgeTables: Clone + std::fmt::Debug + Send + Sync {
    /// The memory used, in bytes.
    fn memory_bytes(&self) -> usize;
}

/// Which subgoals an edge joins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeCriterion {
    /// Subgoals that are directly h_k-reachable from one another: h_k is the cost of an optimal path, and no
    /// third subgoal is on one.
    Direct,
    /// Subgoals that see one another along a line that a taut path can follow at both of them.
    Taut,
}

/// Which edges of a vertex are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeKind {
    /// Edges of the graph, each from one of its ends: those of a subgoal to subgoals with larger numbers,
    /// which lie below it, or to the right in its own row.
    Graph,
    /// The edges that join the start or goal of a query to the graph: all of them.
    Query,
}

impl EdgeKind {
    /// Whether an edge with this displacement is wanted.
    #[inline]
    pub(crate) const fn includes(self, to: Vector) -> bool {
        matches!(self, Self::Query) || to.y > 0 || to.y == 0 && to.x > 0
    }
}

/// What finding edges depends on.
#[derive(Debug)]
pub struct BuildContext<'m, P: EdgeFinder> {
    pub(crate) space: &'m FreeSpace<P>,
    pub(crate) subgoals: &'m Subgoals,
    pub(crate) tables: &'m P::Tables,
    pub(crate) metric: &'m Metric,
    pub(crate) k: K,
    pub(crate) criterion: EdgeCriterion,
}

impl<P: EdgeFinder> Clone for BuildContext<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P: EdgeFinder> Copy for BuildContext<'_, P> {}
