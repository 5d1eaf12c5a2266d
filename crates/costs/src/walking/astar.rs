//! A* over elevation.

use std::sync::Arc;

use mediant_grid::{Identity, Vertex, VertexId};
use mediant_moves::Cost;
use mediant_search::{
    End, Ends, Guarantee, NodeEvent, Observer, Path, Planner, QueryError, SearchStatus,
    parts::{Entry, Node, NodeStore, OpenList},
};

use super::{
    Heading,
    graph::{OfWalking, ROOMS, WalkingGraph},
    map::BLOCKED,
};
use crate::scan::{Scanning, Visit};

/// A* over elevation (Hart, Nilsson & Raphael 1968). Its heuristic is h_k at the greatest speed, on the
/// slopes of the map, and with the least friction. Without it, it is Dijkstra's algorithm.
///
/// The cost of its paths is [`WalkingGraph::path_cost`]; [`Path::cost`] is their length.
///
/// ```
/// use std::sync::Arc;
/// use mediant_costs::{Pace, WalkingAStar, WalkingGraph, WalkingMap};
/// use mediant_grid::{CornerRule, Interrupt, Rules};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Ends, Planner};
///
/// // A ridge with a gap at the bottom.
/// let ridge = |x, y| Some(if x == 3 && y < 3 { 50.0 } else { 0.0 });
/// let map = Arc::new(WalkingMap::new((7, 4), (10.0, 10.0), &Pace::Tobler, &Interrupt::NEVER, ridge)?);
/// let graph = Arc::new(WalkingGraph::new(map, Rules::Center(CornerRule::Never), FiniteK::N8)?);
/// let answer = WalkingAStar::new(graph).solve(Ends::new((0, 0), (6, 0)))?;
/// let path = answer.path().expect("all cells are free");
/// assert!(path.vertices().any(|at| (at.x, at.y) == (3, 3)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct WalkingAStar {
    graph: Arc<WalkingGraph>,
    nodes: NodeStore,
    open: OpenList,
    starts: Vec<usize>,
    goal: Vertex,
    is_guided: bool,
    status: SearchStatus,
}

impl WalkingAStar {
    /// A planner with scratch memory for a graph.
    #[must_use]
    pub fn new(graph: Arc<WalkingGraph>) -> Self {
        Self {
            nodes: NodeStore::new(graph.map().layout().len()),
            open: OpenList::default(),
            starts: Vec::new(),
            goal: Vertex::default(),
            is_guided: true,
            status: SearchStatus::default(),
            graph,
        }
    }

    /// Dijkstra's algorithm (1959). For the costs of all vertices, [`WalkingField`](super::WalkingField) is
    /// much faster.
    #[must_use]
    pub fn dijkstra(graph: Arc<WalkingGraph>) -> Self {
        Self { is_guided: false, ..Self::new(graph) }
    }

    /// The bytes of scratch memory that a planner for a graph takes when it is made.
    #[must_use]
    pub fn scratch_bytes(graph: &WalkingGraph) -> usize {
        NodeStore::<()>::bytes(graph.map().layout().len())
    }

    /// The search graph.
    #[must_use]
    pub const fn graph(&self) -> &Arc<WalkingGraph> {
        &self.graph
    }

    fn begin_at(&mut self, observer: &mut impl Observer) {
        self.status = SearchStatus::Searching;
        self.nodes.start_search();
        self.open.clear();
        let Self { graph, nodes, open, goal, is_guided, .. } = self;
        for &start in &self.starts {
            let (at, id) = (graph.vertex(start), id(start));
            let h = if *is_guided { graph.least_cost(at.to(*goal)) } else { Cost::ZERO };
            nodes.set_path(id, Cost::ZERO, 0, ());
            observer.generated(NodeEvent { at, parent: None, g: Cost::ZERO, f: h });
            open.push(Entry::new(h, h, id), |id, slot| nodes.set_slot(id, slot));
        }
    }

    /// Expands nodes until the goal is the best open node, none is open, or the observer pauses.
    fn run<const N: usize>(&mut self, observer: &mut impl Observer) -> SearchStatus {
        let Self { graph, nodes, open, goal, is_guided, .. } = self;
        let (graph, goal, is_guided): (&WalkingGraph, Vertex, bool) = (graph, *goal, *is_guided);
        let Some(goal_id) = graph.position(goal).map(id) else { return SearchStatus::Unreachable };
        while open.get(0).is_none_or(|best| best.id() == goal_id || !observer.pauses(best.f())) {
            let Some((entry, swaps)) = open.pop(|id, slot| nodes.set_slot(id, slot)) else {
                return SearchStatus::Unreachable;
            };
            observer.percolated(swaps);
            if entry.id() == goal_id {
                return SearchStatus::Found;
            }
            nodes.set_slot(entry.id(), Node::<()>::CLOSED);
            let Some(node) = nodes.get(entry.id()) else { continue };
            let at = graph.vertex(entry.id().index());
            // Only a start costs nothing.
            let parent = (node.g != Cost::ZERO).then(|| parent(graph, at, node.arrived_by()));
            observer.expanded(NodeEvent { at, parent, g: node.g, f: entry.f() });
            observer.reached(at, node.g);
            let mut relaxing = Relaxing { graph, goal, is_guided, at, nodes, open, observer };
            OfWalking::<N>::new(graph, Heading::FromSources)
                .scan((entry.id().index(), node.g.to_bits()), &mut relaxing);
        }
        SearchStatus::Searching
    }
}

fn id(at: usize) -> VertexId {
    VertexId(at as u32)
}

/// The vertex before one that was reached by the move with this index.
fn parent(graph: &WalkingGraph, at: Vertex, by: usize) -> Vertex {
    at + -graph.moves().all[by].vector
}

/// The successors of a node while they are found.
struct Relaxing<'s, O> {
    graph: &'s WalkingGraph,
    goal: Vertex,
    is_guided: bool,
    /// The node.
    at: Vertex,
    nodes: &'s mut NodeStore,
    open: &'s mut OpenList,
    observer: &'s mut O,
}

impl<O: Observer> Visit for Relaxing<'_, O> {
    #[inline]
    fn known(&self, to: usize) -> u64 {
        match self.nodes.get(id(to)) {
            Some(node) => node.g.to_bits(),
            None if self.graph.map().heights()[to] == BLOCKED => 0,
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
                let h = if self.is_guided { self.graph.least_cost(at.to(self.goal)) } else { Cost::ZERO };
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

impl Planner for WalkingAStar {
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.status = SearchStatus::Unreachable;
        self.graph.check(End::Start, query.start)?;
        self.graph.check(End::Goal, query.goal)?;
        self.begin_from(&[query.start], query.goal, observer);
        Ok(self.status)
    }

    fn begin_from(
        &mut self,
        starts: &[Vertex],
        goal: Vertex,
        observer: &mut impl Observer,
    ) -> Option<SearchStatus> {
        self.goal = goal;
        self.starts.clear();
        self.starts.extend(starts.iter().filter_map(|&start| self.graph.position(start)));
        self.starts.sort_unstable();
        self.starts.dedup();
        self.begin_at(observer);
        Some(self.status)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if self.status == SearchStatus::Searching {
            self.status = match self.graph.k().get() {
                0..=5 => self.run::<{ ROOMS[0] }>(observer),
                _ => self.run::<{ ROOMS[1] }>(observer),
            };
        }
        Ok(self.status)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        if self.status == SearchStatus::Unreachable {
            return None;
        }
        let mut node = self.nodes.get(id(self.graph.position(at)?))?;
        let (mut waypoints, mut at, mut last) = (vec![at], at, None);
        while node.g != Cost::ZERO {
            let by = node.arrived_by();
            at = parent(&self.graph, at, by);
            match waypoints.last_mut().filter(|_| last == Some(by)) {
                Some(end) => *end = at,
                None => waypoints.push(at),
            }
            last = Some(by);
            node = self.nodes.get(id(self.graph.position(at)?))?;
        }
        waypoints.reverse();
        Some(Path::new(waypoints))
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Optimal(self.graph.k())
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}
