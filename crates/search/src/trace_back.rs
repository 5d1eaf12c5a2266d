//! From the nodes of a finished search to the path that it found.

use mediant_grid::{GridGraph, Placement, Vertex, VertexId};
use mediant_moves::Cost;

use crate::{nodes::NodeStore, parent::ParentPointer, path::Path};

/// The path that a search found. Allocates nothing but its waypoints.
pub(crate) fn trace_back<P: Placement, N: ParentPointer>(
    graph: &GridGraph<P>,
    nodes: &NodeStore<N>,
    goal: VertexId,
) -> Path {
    let (mut few, mut count) = ([Vertex::default(); FEW], 0);
    let start = for_each_turn_back(graph, nodes, goal, |turn| {
        // From the last one on.
        if let Some(place) = few.get_mut(FEW.wrapping_sub(count + 1)) {
            *place = turn;
        }
        count += 1;
    });
    let mut waypoints = Vec::with_capacity(count + 1);
    waypoints.push(start);
    match FEW.checked_sub(count) {
        Some(first) => waypoints.extend_from_slice(&few[first..]),
        None => extend_back(graph, nodes, goal, &mut waypoints),
    }
    Path::new(waypoints)
}

/// As many waypoints as most paths have. Longer paths are gone through twice.
const FEW: usize = 32;

/// Adds the waypoints of the path that a search found, without its start. Waypoints stand where the direction
/// changes.
pub(crate) fn extend_back<P: Placement, N: ParentPointer>(
    graph: &GridGraph<P>,
    nodes: &NodeStore<N>,
    goal: VertexId,
    waypoints: &mut Vec<Vertex>,
) {
    let first = waypoints.len();
    for_each_turn_back(graph, nodes, goal, |turn| waypoints.push(turn));
    waypoints[first..].reverse();
}

/// Calls `visit` with the goal, and back from there with each waypoint where the direction changes. Returns
/// the start.
#[inline]
fn for_each_turn_back<P: Placement, N: ParentPointer>(
    graph: &GridGraph<P>,
    nodes: &NodeStore<N>,
    goal: VertexId,
    mut visit: impl FnMut(Vertex),
) -> Vertex {
    let (mut id, mut at, mut next) = (goal, graph.vertex(goal), None);
    // Only a start costs nothing: no move does.
    while let Some(node) = nodes.get(id).filter(|node| node.g != Cost::ZERO) {
        let index = node.arrived_by();
        let step = graph.step(index);
        if next != Some(index) {
            visit(at);
        }
        next = Some(index);
        let (parent, from) = node.pointer.parent(graph, step, id, at);
        let (v, d) = (step.vector(), from.to(at));
        let across = i64::from(v.x) * i64::from(d.y) - i64::from(v.y) * i64::from(d.x);
        if across != 0 {
            // Two legs in canonical order, the first by the odd move beside this even one. The intermediate
            // jump point between them is no node. Adjacent moves span a parallelogram of area 1: this is
            // Cramer's rule without its denominator.
            let last = graph.steps().len() - 1;
            let first = if across > 0 { index.wrapping_sub(1) } else { index + 1 } & last;
            visit(from + graph.step(first).vector() * across.unsigned_abs() as i32);
            next = Some(first);
        }
        (id, at) = (parent, from);
    }
    at
}
