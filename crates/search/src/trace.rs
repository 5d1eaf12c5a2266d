//! From the nodes of a finished search to the path that it found.

use mediant_grid::{GridGraph, Placement, Vector, Vertex, VertexId};
use mediant_moves::{Cost, decompose};

use crate::{nodes::NodeStore, parent::ParentPointer, path::Path};

/// The path that a search found. Allocates nothing but its waypoints.
pub(crate) fn trace_back<P: Placement, N: ParentPointer>(
    graph: &GridGraph<P>,
    nodes: &NodeStore<N>,
    goal: VertexId,
) -> Path {
    let mut legs = LegsBack::new(graph, nodes, goal);
    let count = turns(&mut legs).count();
    let mut waypoints = Vec::with_capacity(count + 1);
    // The legs end at the start.
    waypoints.push(legs.node.1);
    extend_back(graph, nodes, goal, &mut waypoints);
    Path::new(waypoints)
}

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
        if i64::from(d.x) * i64::from(v.y) != i64::from(d.y) * i64::from(v.x) {
            // Two legs in canonical order, the first by the odd move. The intermediate jump point between
            // them is no node.
            let [(first, times), _] = decompose(d, self.graph.k())?.canonical();
            let times = times as i32;
            self.pending = Some((from + Vector::new(first.x * times, first.y * times), first));
        }
        Some((at, v))
    }
}
