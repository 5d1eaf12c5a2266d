//! How a node knows its parent.

use std::fmt::Debug;

use mediant_grid::{GridGraph, Placement, Step, Vertex, VertexId};

/// How a node knows its parent. Engines that take one move at a time need to store nothing, `()`: the parent
/// is found by the move.
pub trait ParentPointer: Copy + Debug {
    /// That of a node that was never reached.
    const NONE: Self;

    /// The pointer to a parent.
    fn to(parent: VertexId) -> Self;

    /// The parent of the node (`id`, `at`), which was reached by the move `step`.
    fn parent<P: Placement>(
        self,
        graph: &GridGraph<P>,
        step: &Step,
        id: VertexId,
        at: Vertex,
    ) -> (VertexId, Vertex);
}

/// The parent is one move away.
impl ParentPointer for () {
    const NONE: Self = ();

    #[inline]
    fn to(_: VertexId) -> Self {}

    #[inline]
    fn parent<P: Placement>(
        self,
        _: &GridGraph<P>,
        step: &Step,
        id: VertexId,
        at: Vertex,
    ) -> (VertexId, Vertex) {
        (step.source(id), at + -step.vector())
    }
}

/// The parent itself.
impl ParentPointer for VertexId {
    const NONE: Self = Self(0);

    #[inline]
    fn to(parent: VertexId) -> Self {
        parent
    }

    #[inline]
    fn parent<P: Placement>(
        self,
        graph: &GridGraph<P>,
        _: &Step,
        _: VertexId,
        _: Vertex,
    ) -> (VertexId, Vertex) {
        (self, graph.vertex(self))
    }
}
