//! The search loop of A* on cost surfaces and over elevation.

use mediant_grid::{Vertex, VertexId};
use mediant_moves::Cost;
use mediant_search::{
    NodeEvent, Observer, SearchStatus,
    parts::{Entry, Node, NodeStore, OpenList},
};

use crate::scan::{Scanning, Visit};

/// A search graph, as the loop sees it. Its states are numbers.
pub(crate) trait SearchGraph {
    /// The vertex of a state.
    fn vertex(&self, state: usize) -> Vertex;

    /// The vertex and the state before a vertex that was reached by the move with this index.
    fn before(&self, at: Vertex, by: usize) -> (Vertex, usize);

    /// Whether no path leads to a state, whatever the moves.
    fn is_blocked(&self, state: usize) -> bool;

    /// Whether a path that ends at a vertex may do so in this state of it.
    fn ends_in(&self, at: Vertex, state: usize) -> bool;
}

/// The memory of a search: 16 bytes for each state that it touches, and the open list.
#[derive(Debug)]
pub(crate) struct BestFirst {
    nodes: NodeStore,
    open: OpenList,
}

impl BestFirst {
    pub(crate) fn new(states: usize) -> Self {
        Self { nodes: NodeStore::new(states), open: OpenList::default() }
    }

    /// The bytes that it takes when it is made.
    pub(crate) const fn bytes(states: usize) -> usize {
        NodeStore::<()>::bytes(states)
    }

    /// Forgets everything, for a graph of so many states.
    pub(crate) fn fit(&mut self, states: usize) {
        self.nodes.fit(states);
        self.open.clear();
    }

    /// Makes the starts the only nodes that are known. `bound` is the heuristic of a vertex and its state.
    pub(crate) fn begin(
        &mut self,
        graph: &impl SearchGraph,
        starts: &[usize],
        bound: impl Fn(Vertex, usize) -> Cost,
        observer: &mut impl Observer,
    ) {
        let Self { nodes, open } = self;
        nodes.start_search();
        open.clear();
        for &start in starts {
            let (at, id) = (graph.vertex(start), id(start));
            let h = bound(at, start);
            nodes.set_path(id, Cost::ZERO, 0, ());
            observer.generated(NodeEvent { at, parent: None, g: Cost::ZERO, f: h });
            open.push(Entry::new(h, h, id), |id, slot| nodes.set_slot(id, slot));
        }
    }

    /// Expands nodes until the goal is the best open node, none is open, or the observer pauses.
    pub(crate) fn run(
        &mut self,
        (graph, moves): (&impl SearchGraph, impl Scanning),
        goal: usize,
        bound: impl Fn(Vertex, usize) -> Cost,
        observer: &mut impl Observer,
    ) -> SearchStatus {
        let Self { nodes, open } = self;
        let goal = id(goal);
        while open.get(0).is_none_or(|best| best.id() == goal || !observer.pauses(best.f())) {
            let Some((entry, swaps)) = open.pop(|id, slot| nodes.set_slot(id, slot)) else {
                return SearchStatus::Unreachable;
            };
            observer.percolated(swaps);
            if entry.id() == goal {
                return SearchStatus::Found;
            }
            nodes.set_slot(entry.id(), Node::<()>::CLOSED);
            let Some(node) = nodes.get(entry.id()) else { continue };
            let state = entry.id().index();
            let at = graph.vertex(state);
            // Only a start costs nothing.
            let parent = (node.g != Cost::ZERO).then(|| graph.before(at, node.arrived_by()).0);
            observer.expanded(NodeEvent { at, parent, g: node.g, f: entry.f() });
            if graph.ends_in(at, state) {
                observer.reached(at, node.g);
            }
            let mut relaxing = Relaxing { graph, bound: &bound, at, nodes, open, observer };
            moves.scan((state, node.g.to_bits()), &mut relaxing);
        }
        SearchStatus::Searching
    }

    /// The waypoints of the best path known to a state of a vertex, and its cost.
    pub(crate) fn path(
        &self,
        graph: &impl SearchGraph,
        mut at: Vertex,
        mut state: usize,
    ) -> Option<(Vec<Vertex>, Cost)> {
        let mut node = self.nodes.get(id(state))?;
        let (mut waypoints, cost, mut last) = (vec![at], node.g, None);
        while node.g != Cost::ZERO {
            let by = node.arrived_by();
            (at, state) = graph.before(at, by);
            match waypoints.last_mut().filter(|_| last == Some(by)) {
                Some(end) => *end = at,
                None => waypoints.push(at),
            }
            last = Some(by);
            node = self.nodes.get(id(state))?;
        }
        waypoints.reverse();
        Some((waypoints, cost))
    }
}

const fn id(state: usize) -> VertexId {
    VertexId(state as u32)
}

/// The successors of a node while they are found.
struct Relaxing<'s, G, B, O> {
    graph: &'s G,
    bound: &'s B,
    /// The node.
    at: Vertex,
    nodes: &'s mut NodeStore,
    open: &'s mut OpenList,
    observer: &'s mut O,
}

impl<G: SearchGraph, B: Fn(Vertex, usize) -> Cost, O: Observer> Visit for Relaxing<'_, G, B, O> {
    #[inline]
    fn known(&self, to: usize) -> u64 {
        match self.nodes.get(id(to)) {
            Some(node) => node.g.to_bits(),
            None if self.graph.is_blocked(to) => 0,
            None => u64::MAX,
        }
    }

    fn relax(&mut self, by: usize, to: usize, cost: u64) {
        let (to_id, g) = (id(to), Cost::from_bits(cost));
        let at = self.graph.vertex(to);
        let known = self.nodes.get(to_id);
        self.nodes.set_path(to_id, g, by, ());
        let Self { nodes, open, .. } = self;
        let moved = |id, slot| nodes.set_slot(id, slot);
        let event = |f| NodeEvent { at, parent: Some(self.at), g, f };
        let (f, swaps) = match known {
            Some(known) if known.slot != Node::<()>::CLOSED => {
                let gain = known.g - g;
                let f = open.get(known.slot).map_or(g, |entry| entry.f() - gain);
                (f, open.decrease(known.slot, gain, moved))
            }
            // A closed node is reopened: the heuristic is consistent, so this does not happen.
            _ => {
                let h = (self.bound)(at, to);
                (g + h, open.push(Entry::new(g + h, h, to_id), moved))
            }
        };
        match known {
            Some(_) => self.observer.updated(event(f)),
            None => self.observer.generated(event(f)),
        }
        self.observer.percolated(swaps);
    }
}
