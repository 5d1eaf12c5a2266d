//! The nodes at closed gaps, where paths may pass them.

use mediant_grid::{GridGraph, Placement, Step, Vertex, VertexId};

use crate::{
    gap_nodes::{self, vertex_of},
    parent::ParentPointer,
};

/// Whether the search passes closed gaps: where they may save moves.
pub(super) fn passes_gaps<P: Placement>(graph: &GridGraph<P>) -> bool {
    graph.has_closed_gaps() && graph.k().get() >= 5
}

/// The number of nodes.
pub(super) fn node_count<P: Placement>(graph: &GridGraph<P>) -> usize {
    graph.vertex_count() << u32::from(passes_gaps(graph))
}

/// The node at the vertex (`id`, `at`) of a path that comes straight from `beside`, or goes there.
pub(super) fn node_at<P: Placement>(
    graph: &GridGraph<P>,
    (id, at): (VertexId, Vertex),
    beside: Vertex,
) -> VertexId {
    if passes_gaps(graph) { gap_nodes::node_at(graph, (id, at), beside) } else { id }
}

/// The parent of a node is one move away.
#[derive(Clone, Copy, Debug)]
pub(super) struct Back;

impl ParentPointer for Back {
    type Words = [u32; 4];
    const UNKNOWN: [u32; 4] = [0; 4];

    #[inline]
    fn read(_: &[u32; 4]) -> Self {
        Self
    }

    #[inline]
    fn write(self, _: &mut [u32; 4]) {}

    #[inline]
    fn to(_: VertexId) -> Self {
        Self
    }

    #[inline]
    fn parent<P: Placement>(
        self,
        graph: &GridGraph<P>,
        step: &Step,
        id: VertexId,
        at: Vertex,
    ) -> (VertexId, Vertex) {
        let from = at + -step.vector();
        let (id, _) = vertex_of(graph, id);
        (node_at(graph, (step.source(id), from), at), from)
    }
}
