//! The two nodes of a closed gap, for searches whose paths may pass one.
//!
//! A gap has two free quadrants, and a path that enters by one of them leaves by the same. So it is two
//! nodes: that of its lower quadrant has the number of the vertex, that of its upper quadrant has a number
//! beyond all vertices. (Each move to or from a gap lies in one of the two. On the line between two cells
//! beside the gap, one is free.)

use mediant_grid::{GridGraph, Placement, Vertex, VertexId};

/// The vertex at which a node is, with its number.
#[inline]
pub(crate) fn vertex_of<P: Placement>(graph: &GridGraph<P>, node: VertexId) -> (VertexId, Vertex) {
    let id = VertexId(node.0.checked_sub(graph.vertex_count() as u32).unwrap_or(node.0));
    (id, graph.vertex(id))
}

/// The node at the vertex (`id`, `at`) of a path that comes straight from `beside`, or goes there.
#[inline]
pub(crate) fn node_at<P: Placement>(
    graph: &GridGraph<P>,
    (id, at): (VertexId, Vertex),
    beside: Vertex,
) -> VertexId {
    if !graph.is_closed_gap(at) {
        return id;
    }
    let v = at.to(beside);
    let is_lower = v.y > 0 || v.y == 0 && ends_at(graph, at) == (v.x > 0);
    if is_lower { id } else { upper(graph, id) }
}

/// The node of the upper quadrant of a gap.
#[inline]
pub(crate) fn upper<P: Placement>(graph: &GridGraph<P>, gap: VertexId) -> VertexId {
    VertexId(gap.0 + graph.vertex_count() as u32)
}

/// Whether a path may end at a gap: whether the vertex's own cell is free. It is that of the lower quadrant
/// then.
pub(crate) fn ends_at<P: Placement>(graph: &GridGraph<P>, gap: Vertex) -> bool {
    graph.grid().is_free(gap.x, gap.y)
}
