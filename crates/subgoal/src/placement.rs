//! Which subgoals a vertex is joined to.

use mediant_grid::{BitMatrix, FreeSpace, Placement, Vector, Vertex};
use mediant_moves::{Cost, K};

use crate::{Hierarchy, SubgoalError, norm::Norm, subgoals::Subgoals};

/// A placement on which there are subgoal graphs.
pub trait SubgoalPlacement: Placement {
    /// What [`SubgoalPlacement::links`] works with.
    #[doc(hidden)]
    type Scratch: Default + Send;

    /// Whether there are subgoal graphs of this free space for these directions.
    #[doc(hidden)]
    fn check(space: &FreeSpace<Self>, k: K) -> Result<(), SubgoalError>;

    /// What makes finding links fast.
    #[doc(hidden)]
    type Prepared: Prepared;

    /// The vertices that are subgoals, a bit for each vertex in a frame of zeros, and what makes finding links fast.
    #[doc(hidden)]
    fn prepare(space: &FreeSpace<Self>) -> (BitMatrix, Self::Prepared);

    /// Which edges a graph has.
    #[doc(hidden)]
    fn edges(k: K, hierarchy: Hierarchy) -> Edges;

    /// Tells the subgoals that a vertex is joined to, and what the ways there cost.
    #[doc(hidden)]
    fn links(
        map: BuildContext<'_, Self>,
        scratch: &mut Self::Scratch,
        from: Vertex,
        which: EdgeKind,
        tell: impl FnMut(u32, Cost),
    );
}

/// What follows from a map and makes finding links fast.
#[doc(hidden)]
pub trait Prepared: Clone + std::fmt::Debug + Send + Sync {
    /// The memory that it takes.
    fn memory_bytes(&self) -> usize;
}

/// Which edges a graph has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub enum Edges {
    /// Between subgoals that are directly h_k-reachable from one another.
    Direct,
    /// Between subgoals that see one another along a line that a taut path can take at both of them.
    Taut,
}

/// Which links of a vertex are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub enum EdgeKind {
    /// Those of a subgoal to the subgoals below it, or to the right on its own line: each edge of the graph from one of its ends.
    Edges,
    /// Those of a start or goal.
    All,
}

impl EdgeKind {
    /// Whether a link by this displacement is told.
    #[inline]
    pub(crate) const fn holds(self, to: Vector) -> bool {
        matches!(self, Self::All) || to.y > 0 || to.y == 0 && to.x > 0
    }
}

/// What links are found on.
#[derive(Debug)]
#[doc(hidden)]
pub struct BuildContext<'m, P: SubgoalPlacement> {
    pub(crate) space: &'m FreeSpace<P>,
    pub(crate) subgoals: &'m Subgoals<P::Prepared>,
    pub(crate) norm: &'m Norm,
    pub(crate) k: K,
    pub(crate) edges: Edges,
}

impl<P: SubgoalPlacement> Clone for BuildContext<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P: SubgoalPlacement> Copy for BuildContext<'_, P> {}
