//! Subgoals and edges by placement of the vertices.

use mediant_grid::{BitMatrix, FreeSpace, Interrupt, Interrupted, Placement, Vector, Vertex};
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
    /// Whether subgoals, and what each vertex sees of them, are the same for every k.
    const SHARES_SIGHT: bool;

    /// From how many sides paths come to a subgoal and bend there: 1 if all are alike.
    const SIDES: u32;

    /// Scratch memory of [`edges_from`](Self::edges_from).
    type Scratch: Default + Send;

    /// Tables of a map for finding edges.
    type Tables: EdgeTables;

    /// Checks that this free space has subgoal graphs for this k.
    fn check(space: &FreeSpace<Self>, k: K) -> Result<(), SubgoalError>;

    /// The subgoals, a bit for each vertex in a frame of zeros.
    fn subgoals(space: &FreeSpace<Self>, interrupt: &Interrupt) -> Result<BitMatrix, Interrupted>;

    /// The tables of a map for finding edges.
    fn tables(
        space: &FreeSpace<Self>,
        subgoals: &BitMatrix,
        interrupt: &Interrupt,
    ) -> Result<Self::Tables, Interrupted>;

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

    /// How paths bend that leave a subgoal.
    type Departures: Copy;

    /// Whether the edges that leave a side of a subgoal are sorted such that those that a path may take come
    /// first.
    const SORTED: bool;

    /// How paths bend at a side of a subgoal, in at most four bits.
    fn bend_bits(space: &FreeSpace<Self>, at: Vertex, side: u32) -> u32;

    /// The directions in which a path may leave a side of a subgoal at which it arrived along an edge.
    fn departures(k: K, bits: u32, arrival: Vector) -> Self::Departures;

    /// The class of an edge by its direction, in four bits, for [`allows`](Self::allows).
    fn class(edge: Vector) -> u32;

    /// Whether a path may leave along an edge of a class.
    fn allows(departures: Self::Departures, edge: impl Fn() -> Vector, class: u32) -> bool;

    /// A summary of the sorted edges of a side, for [`leads_on`](Self::leads_on).
    fn summary(bits: u32, edges: impl Iterator<Item = Vector>) -> u32;

    /// Whether a path that arrives along an edge may leave along any of those with this summary.
    fn leads_on(k: K, bits: u32, arrival: Vector, summary: u32) -> bool;

    /// The side from which paths come that leave a subgoal along an edge, and the edge's place among those of
    /// this side.
    fn side(space: &FreeSpace<Self>, at: Vertex, edge: Vector) -> (u32, f64);

    /// Calls `visit` with the vertices of which the edges of a query lead to a subgoal. Runs may share
    /// vertices; those from which another edge leads to the same side of the subgoal may be missing.
    ///
    /// Where points in the middle of cells can be the ends of queries, it calls `cells` with runs of cells:
    /// all are among them from whose inside an edge leads to the subgoal, but from none of whose vertices on
    /// the same side.
    fn runs_to(
        context: BuildContext<'_, Self>,
        scratch: &mut Self::Scratch,
        subgoal: Vertex,
        visit: impl FnMut(VertexRun),
        cells: impl FnMut(CellRun),
    );
}

/// A run of vertices along a row or a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VertexRun {
    /// The vertex with the least coordinates.
    pub(crate) first: Vertex,
    /// The number of vertices.
    pub(crate) length: i32,
    /// Whether it is part of a column.
    pub(crate) is_column: bool,
    /// At corners, whether it lies to the right of the subgoal, or on its vertical on the side of the
    /// quadrant that taut paths pass to the right.
    pub(crate) is_right: bool,
}

/// A run of cells along a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellRun {
    /// The row.
    pub(crate) row: i32,
    /// The first column.
    pub(crate) first: i32,
    /// The column after the last.
    pub(crate) end: i32,
    /// Whether it lies to the right of the subgoal.
    pub(crate) is_right: bool,
}

/// Tables of a map for finding edges.
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

/// The free space, subgoals and tables for finding edges.
#[derive(Debug)]
pub struct BuildContext<'m, P: EdgeFinder> {
    pub(crate) space: &'m FreeSpace<P>,
    pub(crate) subgoals: &'m Subgoals,
    pub(crate) tables: &'m P::Tables,
    pub(crate) metric: Metric,
    pub(crate) k: K,
    pub(crate) criterion: EdgeCriterion,
}

impl<P: EdgeFinder> Clone for BuildContext<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P: EdgeFinder> Copy for BuildContext<'_, P> {}
