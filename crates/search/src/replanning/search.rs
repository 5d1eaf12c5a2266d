//! The search of both: from a root to a target, as far as the target needs it, again and again.

use std::ops::Deref;

use mediant_grid::{GridGraph, Placement, Vertex, VertexId};
use mediant_moves::Cost;

use super::{
    costs::MoveCosts,
    nodes::{Node, Nodes},
    reach::Reach,
};
use crate::{
    gap_nodes::{node_at, vertex_of},
    observer::{NodeEvent, Observer},
    open_list::{Entry, OpenList},
};

/// A search that can be continued after its map has changed or its target has moved.
#[derive(Clone, Debug)]
pub(super) struct Replanner<G, C> {
    pub(super) graph: G,
    pub(super) costs: C,
    pub(super) state: State,
    /// From where moves sweep a cell: found at the first change.
    pub(super) reach: Option<Reach>,
    /// Of many changed cells, one for so many known nodes at most: beyond that all is searched anew.
    pub(super) nodes_a_cell: usize,
}

/// All that the search knows.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub(super) nodes: Nodes,
    pub(super) open: OpenList,
    /// The node at distance 0; `None` before the first search.
    pub(super) root: Option<VertexId>,
    target: VertexId,
    target_at: Vertex,
    /// How far the target has moved, by h_k: what keys have more than those of a new search. (k_m of the
    /// paper.)
    pub(super) moved: Cost,
    /// Nodes whose rhs is to be found anew.
    pub(super) stale: Vec<VertexId>,
}

/// As far as a target may move before all is searched anew: 2³⁰ cells, so that no key overflows.
pub(super) const MOST_MOVED: Cost = Cost::from_bits(1 << (Cost::FRACTION_BITS + 30));

impl<P, G, C> Replanner<G, C>
where
    P: Placement,
    G: Deref<Target = GridGraph<P>>,
    C: MoveCosts<P>,
{
    pub(super) fn new(graph: G, costs: C, nodes_a_cell: usize) -> Self {
        let state = State {
            nodes: Nodes::new(node_count(&*graph)),
            open: OpenList::default(),
            root: None,
            target: VertexId(0),
            target_at: Vertex::default(),
            moved: Cost::ZERO,
            stale: Vec::new(),
        };
        Self { graph, costs, state, reach: None, nodes_a_cell }
    }

    /// Continues with another grid graph and forgets all of this one.
    pub(super) fn set_graph(&mut self, graph: G, costs: C) {
        if graph.k() != self.graph.k() || graph.rule() != self.graph.rule() {
            self.reach = None;
        }
        if node_count(&*graph) != self.state.nodes.len() {
            self.state.nodes = Nodes::new(node_count(&*graph));
        }
        self.state.root = None;
        (self.graph, self.costs) = (graph, costs);
    }

    /// Searches from the root to the target. Returns the cost of a shortest path.
    pub(super) fn search(
        &mut self,
        root: VertexId,
        target: VertexId,
        observer: &mut impl Observer,
    ) -> Option<Cost> {
        let Self { graph, costs, state, .. } = self;
        let graph: &GridGraph<P> = graph;
        if state.root == Some(root) && state.moved < MOST_MOVED {
            let target_at = graph.vertex(target);
            state.moved += graph.costs().distance(state.target_at.to(target_at));
            (state.target, state.target_at) = (target, target_at);
        } else {
            state.begin(graph, root, target, observer);
        }
        state.run(graph, costs, observer);
        Some(state.nodes.get(target).rhs).filter(|&cost| cost != Cost::MAX)
    }

    /// After a search that found a path, its waypoints, from the target to the root.
    pub(super) fn trace(&self) -> Vec<Vertex> {
        let State { nodes, root, target, target_at, .. } = &self.state;
        let (mut node, mut last) = (*target, None);
        let mut waypoints = vec![*target_at];
        while Some(node) != *root {
            let rest = nodes.get(node).rhs;
            let mut best: Option<((Cost, bool, usize), Edge)> = None;
            for_each_edge(&self.graph, &self.costs, node, |edge| {
                // The distance falls with each move.
                if let Some(g) = nodes.get(edge.to).settled().filter(|&g| g < rest) {
                    let order = (g + edge.cost, last != Some(edge.index), edge.index);
                    if best.is_none_or(|(known, _)| order < known) {
                        best = Some((order, edge));
                    }
                }
            });
            let Some((_, Edge { to, at, index, .. })) = best else { break };
            match waypoints.last_mut().filter(|_| last == Some(index)) {
                Some(end) => *end = at,
                None => waypoints.push(at),
            }
            (node, last) = (to, Some(index));
        }
        debug_assert_eq!(Some(node), *root, "the path ends before the root: {waypoints:?}");
        waypoints
    }

    /// The memory used beyond the grid graph, in bytes, where all of it was touched.
    pub(super) fn memory_bytes(&self) -> usize {
        let reach = self.reach.as_ref().map_or(0, Reach::memory_bytes);
        self.state.nodes.len() * size_of::<[u64; 3]>() + self.state.open.len() * size_of::<Entry>() + reach
    }
}

/// The number of nodes: with those of gaps, where these are closed.
fn node_count<P: Placement>(graph: &GridGraph<P>) -> usize {
    graph.vertex_count() << u32::from(P::closes_gaps(graph.rule()))
}

/// A move that a path may take from a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// The node to which it leads.
    pub(super) to: VertexId,
    /// The vertex there.
    pub(super) at: Vertex,
    pub(super) index: usize,
    pub(super) cost: Cost,
}

/// Calls `visit` with each move that a path may take from a node.
#[inline]
pub(super) fn for_each_edge<P: Placement, C: MoveCosts<P>>(
    graph: &GridGraph<P>,
    costs: &C,
    node: VertexId,
    mut visit: impl FnMut(Edge),
) {
    let (id, at) = vertex_of(graph, node);
    // The upper node of what is no gap any more has no moves.
    if !graph.is_free(at) || node != id && !graph.is_closed_gap(at) {
        return;
    }
    let has_gaps = graph.has_closed_gaps();
    graph.for_each_legal_move(at, |index| {
        let step = graph.step(index);
        let (mut to, to_at) = (step.target(id), at + step.vector());
        if has_gaps {
            if node_at(graph, (id, at), to_at) != node {
                return;
            }
            to = node_at(graph, (to, to_at), at);
        }
        if let Some(cost) = costs.cost(graph, at, index) {
            visit(Edge { to, at: to_at, index, cost });
        }
    });
}

/// The index of the move back. Moves are ordered by angle.
#[inline]
pub(super) fn opposite<P: Placement>(graph: &GridGraph<P>, index: usize) -> usize {
    let count = graph.steps().len();
    let back = (index + count / 2) & (count - 1);
    debug_assert_eq!(graph.step(back).vector(), -graph.step(index).vector(), "the move back");
    back
}

impl State {
    /// Forgets all, and makes the root the only node that is known.
    fn begin<P: Placement>(
        &mut self,
        graph: &GridGraph<P>,
        root: VertexId,
        target: VertexId,
        observer: &mut impl Observer,
    ) {
        self.nodes.forget();
        self.open.clear();
        (self.root, self.target, self.target_at) = (Some(root), target, graph.vertex(target));
        self.moved = Cost::ZERO;
        self.lower(graph, (root, graph.vertex(root)), (Cost::ZERO, 0), observer);
    }

    /// The entry of a node in the open list; of one with no distance, one that no other is behind.
    #[inline]
    fn entry<P: Placement>(
        &self,
        graph: &GridGraph<P>,
        (id, at): (VertexId, Vertex),
        Node { g, rhs, .. }: Node,
    ) -> Entry {
        let least = g.min(rhs);
        if least == Cost::MAX {
            return Entry::keyed(Cost::MAX, Cost::MAX, id);
        }
        let h = graph.costs().distance(at.to(self.target_at));
        Entry::keyed(least + h + self.moved, least, id)
    }

    /// Settles nodes, until the target is settled or next, and no node before it is left.
    fn run<P: Placement, C: MoveCosts<P>>(
        &mut self,
        graph: &GridGraph<P>,
        costs: &C,
        observer: &mut impl Observer,
    ) {
        while let Some(top) = self.open.get(0) {
            let target = self.nodes.get(self.target);
            let is_next = top.key() >= self.entry(graph, (self.target, self.target_at), target).key();
            if is_next && target.rhs <= target.g {
                return;
            }
            let id = top.id();
            let ((_, at), node) = (vertex_of(graph, id), self.nodes.get(id));
            let entry = self.entry(graph, (id, at), node);
            if top.key() < entry.key() {
                // The target has moved since.
                let Self { nodes, open, .. } = self;
                observer.percolated(open.replace(0, entry, |id, slot| nodes.set_slot(id, slot)));
                continue;
            }
            let (g, f) = (node.g.min(node.rhs), top.f() - self.moved);
            observer.expanded(NodeEvent { at, parent: None, g, f });
            if node.g > node.rhs {
                self.put(graph, (id, at), Node { g, ..node }, observer);
                for_each_edge(graph, costs, id, |edge| {
                    self.lower(graph, (edge.to, edge.at), (g + edge.cost, edge.index), observer);
                });
            } else {
                // It is farther than it was: so may those be whose rhs came by it.
                self.put(graph, (id, at), Node { g: Cost::MAX, ..node }, observer);
                for_each_edge(graph, costs, id, |edge| self.mark_if_by(edge.to, edge.index));
                self.renew(graph, costs, observer);
            }
        }
    }

    /// Marks a node if its rhs comes by this move.
    #[inline]
    pub(super) fn mark_if_by(&mut self, id: VertexId, index: usize) {
        let node = self.nodes.get(id);
        if node.by == index && node.rhs != Cost::MAX && self.root != Some(id) {
            self.stale.push(id);
        }
    }

    /// Finds the rhs of all marked nodes anew. None is lower than it was: where moves became legal or
    /// cheaper, it has been [lowered](Self::lower) before.
    pub(super) fn renew<P: Placement, C: MoveCosts<P>>(
        &mut self,
        graph: &GridGraph<P>,
        costs: &C,
        observer: &mut impl Observer,
    ) {
        while let Some(id) = self.stale.pop() {
            let node = self.nodes.get(id);
            let (mut rhs, mut by) = (Cost::MAX, 0);
            for_each_edge(graph, costs, id, |edge| {
                if rhs == node.rhs {
                    return;
                }
                let found = self.nodes.get(edge.to).settled().map(|g| g + edge.cost);
                if let Some(found) = found.filter(|&found| found < rhs) {
                    (rhs, by) = (found, opposite(graph, edge.index));
                }
            });
            let (_, at) = vertex_of(graph, id);
            let node = Node { rhs, by, ..node };
            self.put(graph, (id, at), node, observer);
        }
    }

    /// Lowers the rhs of a node, if it is higher, to a cost that comes by a move to it.
    #[inline]
    pub(super) fn lower<P: Placement>(
        &mut self,
        graph: &GridGraph<P>,
        (id, at): (VertexId, Vertex),
        (rhs, by): (Cost, usize),
        observer: &mut impl Observer,
    ) {
        let node = self.nodes.get(id);
        if rhs >= node.rhs {
            return;
        }
        let f = rhs + graph.costs().distance(at.to(self.target_at));
        let event = NodeEvent { at, parent: None, g: rhs, f };
        if self.nodes.is_known(id) {
            observer.updated(event);
        } else {
            observer.generated(event);
        }
        self.put(graph, (id, at), Node { rhs, by, ..node }, observer);
    }

    /// Stores a node, and puts it into the open list where its two values differ, else takes it out.
    #[inline]
    fn put<P: Placement>(
        &mut self,
        graph: &GridGraph<P>,
        (id, at): (VertexId, Vertex),
        mut node: Node,
        observer: &mut impl Observer,
    ) {
        let (entry, slot) = (self.entry(graph, (id, at), node), node.slot);
        let is_settled = node.g == node.rhs;
        if is_settled {
            node.slot = Node::CLOSED;
        }
        let Self { nodes, open, .. } = self;
        nodes.set(id, node);
        let moved = |id, slot| nodes.set_slot(id, slot);
        observer.percolated(match (is_settled, slot == Node::CLOSED) {
            (true, true) => 0,
            (true, false) => open.remove(slot, moved),
            (false, true) => open.push(entry, moved),
            (false, false) => open.replace(slot, entry, moved),
        });
    }
}
