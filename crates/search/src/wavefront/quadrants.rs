//! The nodes at closed gaps, where paths may pass them.
//!
//! A gap has two free quadrants, and a path that enters by one of them leaves by the same. So it is two
//! nodes: that of its lower quadrant has the number of the vertex, that of its upper quadrant has a number
//! beyond all vertices. (Each move to or from a gap lies in one of the two. On the line between two cells
//! beside the gap, one is free.)

use mediant_grid::{GridGraph, Placement, Step, Vertex, VertexId};

use crate::parent::ParentPointer;

/// Whether the search passes closed gaps: where they may save moves.
pub(super) fn passes_gaps<P: Placement>(graph: &GridGraph<P>) -> bool {
    graph.has_closed_gaps() && graph.k().get() >= 5
}

/// The number of nodes.
pub(super) fn node_count<P: Placement>(graph: &GridGraph<P>) -> usize {
    graph.vertex_count() << u32::from(passes_gaps(graph))
}

/// The vertex at which a node is, with its number.
pub(super) fn vertex_of<P: Placement>(graph: &GridGraph<P>, node: VertexId) -> (VertexId, Vertex) {
    let id = VertexId(node.0.checked_sub(graph.vertex_count() as u32).unwrap_or(node.0));
    (id, graph.vertex(id))
}

/// The node at the vertex (`id`, `at`) of a path that comes straight from `beside`, or goes there.
pub(super) fn node_at<P: Placement>(
    graph: &GridGraph<P>,
    (id, at): (VertexId, Vertex),
    beside: Vertex,
) -> VertexId {
    if !graph.is_closed_gap(at) || !passes_gaps(graph) {
        return id;
    }
    let v = at.to(beside);
    let is_lower = v.y > 0 || v.y == 0 && ends_at(graph, at) == (v.x > 0);
    if is_lower { id } else { VertexId(id.0 + graph.vertex_count() as u32) }
}

/// Whether a path may end at a gap: whether the vertex's own cell is free. It is that of the lower quadrant
/// then.
pub(super) fn ends_at<P: Placement>(graph: &GridGraph<P>, gap: Vertex) -> bool {
    graph.grid().is_free(gap.x, gap.y)
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
