//! From the nodes of a finished search to the path that it found.

use mediant_grid::{GridGraph, Placement, Vector, Vertex, VertexId};
use mediant_moves::Cost;

use crate::{nodes::NodeStore, parent::ParentPointer, path::Path};

/// The path that a search found. Allocates nothing but its waypoints.
pub(crate) fn trace_back<P: Placement, N: ParentPointer>(
    graph: &GridGraph<P>,
    nodes: &NodeStore<N>,
    goal: VertexId,
) -> Path {
    let mut legs = LegsBack::new(graph, nodes, goal);
    let (mut few, mut count) = ([Vertex::default(); FEW], 0);
    for end in turns(&mut legs) {
        // From the last one on.
        if let Some(place) = FEW.checked_sub(count + 1) {
            few[place] = end;
        }
        count += 1;
    }
    let mut waypoints = Vec::with_capacity(count + 1);
    // The legs end at the start.
    waypoints.push(legs.node.1);
    match FEW.checked_sub(count) {
        Some(first) => waypoints.extend_from_slice(&few[first..]),
        None => extend_back(graph, nodes, goal, &mut waypoints),
    }
    Path::new(waypoints)
}

/// As many waypoints as most paths have. Longer paths are gone through twice.
const FEW: usize = 16;

/// Adds the waypoints of the path that a search found, without its start. Waypoints stand where the direction
/// changes.
pub(crate) fn extend_back<P: Placement, N: ParentPointer>(
    graph: &GridGraph<P>,
    nodes: &NodeStore<N>,
    goal: VertexId,
    waypoints: &mut Vec<Vertex>,
) {
    let first = waypoints.len();
    waypoints.extend(turns(LegsBack::new(graph, nodes, goal)));
    waypoints[first..].reverse();
}

/// The straight legs of a path, from the goal back to the start: where each ends, and its move.
struct LegsBack<'s, P: Placement, N: ParentPointer> {
    graph: &'s GridGraph<P>,
    nodes: &'s NodeStore<N>,
    node: (VertexId, Vertex),
    /// The first of two legs between a node and its parent, when the second has been returned.
    pending: Option<(Vertex, Vector)>,
}

impl<'s, P: Placement, N: ParentPointer> LegsBack<'s, P, N> {
    fn new(graph: &'s GridGraph<P>, nodes: &'s NodeStore<N>, goal: VertexId) -> Self {
        Self { graph, nodes, node: (goal, graph.vertex(goal)), pending: None }
    }
}

/// The ends of those legs after which the direction changes, the goal included.
fn turns(legs: impl Iterator<Item = (Vertex, Vector)>) -> impl Iterator<Item = Vertex> {
    let mut last = None;
    legs.filter(move |&(_, v)| last.replace(v) != Some(v)).map(|(end, _)| end)
}

impl<P: Placement, N: ParentPointer> Iterator for LegsBack<'_, P, N> {
    type Item = (Vertex, Vector);

    fn next(&mut self) -> Option<Self::Item> {
        if let Some(leg) = self.pending.take() {
            return Some(leg);
        }
        let (id, at) = self.node;
        // Only a start costs nothing: no move does.
        let node = self.nodes.get(id).filter(|node| node.g != Cost::ZERO)?;
        let step = self.graph.step(node.arrived_by());
        self.node = node.pointer.parent(self.graph, step, id, at);
        let (from, v) = (self.node.1, step.vector());
        let d = from.to(at);
        let across = i64::from(v.x) * i64::from(d.y) - i64::from(v.y) * i64::from(d.x);
        if across != 0 {
            // Two legs in canonical order, the first by the odd move beside this even one. The intermediate
            // jump point between them is no node. Adjacent moves span a parallelogram of area 1: this is
            // Cramer's rule without its denominator.
            let last = self.graph.steps().len() - 1;
            let beside = if across > 0 { node.arrived_by().wrapping_sub(1) } else { node.arrived_by() + 1 };
            let first = self.graph.step(beside & last).vector();
            self.pending = Some((from + first * across.unsigned_abs() as i32, first));
        }
        Some((at, v))
    }
}
