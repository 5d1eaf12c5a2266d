//! A* on a cost surface.

use std::sync::Arc;

use mediant_grid::{Identity, Mismatch, Vertex, VertexId};
use mediant_moves::Cost;
use mediant_search::{
    End, Ends, Guarantee, NodeEvent, Observer, Path, Planner, QueryError, SearchStatus,
    parts::{Entry, Node, NodeStore, OpenList},
};

use crate::{
    graph::CostGraph,
    guide::Guide,
    landmarks::Landmarks,
    scan::{Visit, by_kind},
};

/// A* on a cost surface (Hart, Nilsson & Raphael 1968), for every k, both placements and all rules of motion.
/// Without its heuristic, h_k over cells of the least cost, it is Dijkstra's algorithm. With [`Landmarks`]
/// the heuristic is the greatest of h_k and of their bounds.
///
/// The cost of its paths, [`Path::cost`], is that on the surface; their length is [`Path::length`]. Observers
/// are told costs in units of the map ([`CostGraph::to_f64`]).
///
/// It finds out by searching whether an end can be reached.
///
/// ```
/// use std::sync::Arc;
/// use mediant_costs::{CostAStar, CostGraph, CostSurface};
/// use mediant_grid::{CornerRule, Rules};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Ends, Planner};
///
/// // A swamp with a road around it.
/// let swamp = |x, y| if (1..6).contains(&x) && y < 3 { 8.0 } else { 1.0 };
/// let map = Arc::new(CostSurface::from_fn(7, 4, |x, y| Some(swamp(x, y)))?);
/// let graph = Arc::new(CostGraph::new(map, Rules::Center(CornerRule::Never), FiniteK::N8)?);
/// let mut planner = CostAStar::new(Arc::clone(&graph));
/// let answer = planner.solve(Ends::new((0, 0), (6, 0)))?;
/// let path = answer.path().expect("all cells are free");
/// assert_eq!(path.to_string(), "(0, 0) → (0, 2) → (1, 3) → (5, 3) → (6, 2) → (6, 0)");
/// assert!((path.cost() - 8.0 - 8.0_f64.sqrt()).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Its scratch memory is 16 bytes for each vertex that searches touch, by pages of the system.
#[derive(Debug)]
pub struct CostAStar {
    graph: Arc<CostGraph>,
    search: Nodes,
    starts: Vec<usize>,
    goal: Goal,
    guide: Guide,
    status: SearchStatus,
}

/// The memory of a search.
#[derive(Debug)]
struct Nodes {
    nodes: NodeStore,
    open: OpenList,
}

/// The goal of a search.
#[derive(Clone, Copy, Debug)]
struct Goal {
    at: Vertex,
    state: usize,
}

impl CostAStar {
    /// A planner with scratch memory for a graph.
    #[must_use]
    pub fn new(graph: Arc<CostGraph>) -> Self {
        let search = Nodes { nodes: NodeStore::new(graph.states()), open: OpenList::default() };
        let goal = Goal { at: Vertex::default(), state: 0 };
        let status = SearchStatus::default();
        Self { graph, search, starts: Vec::new(), goal, guide: Guide::LeastCost, status }
    }

    /// Dijkstra's algorithm (1959). For the costs of all vertices, [`CostField`](crate::CostField) is much
    /// faster.
    #[must_use]
    pub fn dijkstra(graph: Arc<CostGraph>) -> Self {
        Self { guide: Guide::Zero, ..Self::new(graph) }
    }

    /// A planner that is guided by landmarks, too.
    ///
    /// # Errors
    /// [`Mismatch`] for the landmarks of another graph.
    pub fn with_landmarks(graph: Arc<CostGraph>, landmarks: Arc<Landmarks>) -> Result<Self, Mismatch> {
        let guide = Guide::by(landmarks, &graph)?;
        Ok(Self { guide, ..Self::new(graph) })
    }

    /// The bytes of scratch memory that a planner for a graph takes when it is made.
    #[must_use]
    pub fn scratch_bytes(graph: &CostGraph) -> usize {
        NodeStore::<()>::bytes(graph.states())
    }

    /// Continues with another graph: that of a surface after an edit. The search that was begun last is
    /// forgotten, and so are landmarks of another graph. The scratch memory is kept if the graph has as many
    /// vertices.
    pub fn follow(&mut self, graph: Arc<CostGraph>) {
        self.guide.follow(&graph);
        self.search.nodes.fit(graph.states());
        self.search.open.clear();
        self.starts.clear();
        self.status = SearchStatus::default();
        self.graph = graph;
    }

    /// [`follow`](Self::follow) with landmarks of the other graph, such as [`Landmarks::repaired`] ones.
    ///
    /// # Errors
    /// [`Mismatch`] for those of another one; then nothing has changed.
    pub fn follow_with(&mut self, graph: Arc<CostGraph>, landmarks: Arc<Landmarks>) -> Result<(), Mismatch> {
        self.guide = Guide::by(landmarks, &graph)?;
        self.follow(graph);
        Ok(())
    }

    /// The search graph.
    #[must_use]
    pub const fn graph(&self) -> &Arc<CostGraph> {
        &self.graph
    }

    fn begin_at(&mut self, observer: &mut impl Observer) {
        self.status = SearchStatus::Searching;
        let Self { graph, search: Nodes { nodes, open }, starts, goal, guide, .. } = self;
        guide.aim(goal.state);
        nodes.start_search();
        open.clear();
        for &start in &*starts {
            let (at, id) = (graph.vertex(start), id(start));
            let h = guide.bound(graph, (at, start), goal.at);
            nodes.set_path(id, Cost::ZERO, 0, ());
            observer.generated(NodeEvent { at, parent: None, g: Cost::ZERO, f: h });
            open.push(Entry::new(h, h, id), |id, slot| nodes.set_slot(id, slot));
        }
    }

    /// Expands nodes until the goal is the best open node, none is open, or the observer pauses. `K` and
    /// `CENTER` are those of a scan.
    fn run<const K: u32, const CENTER: bool>(&mut self, observer: &mut impl Observer) -> SearchStatus {
        let Self { graph, search, goal, guide, .. } = self;
        let (graph, goal, guide): (&CostGraph, Goal, &Guide) = (graph, *goal, guide);
        let (scanner, weights) = (graph.scanner(), graph.map().weights());
        let goal_id = id(goal.state);
        while search.open.get(0).is_none_or(|best| best.id() == goal_id || !observer.pauses(best.f())) {
            let Nodes { nodes, open } = &mut *search;
            let Some((entry, swaps)) = open.pop(|id, slot| nodes.set_slot(id, slot)) else {
                return SearchStatus::Unreachable;
            };
            observer.percolated(swaps);
            if entry.id() == goal_id {
                return SearchStatus::Found;
            }
            nodes.set_slot(entry.id(), Node::<()>::CLOSED);
            let Some(node) = nodes.get(entry.id()) else { continue };
            let state = entry.id().index();
            let at = graph.vertex(state);
            // Only a start costs nothing.
            let parent = (node.g != Cost::ZERO).then(|| graph.parent(at, node.arrived_by()).0);
            observer.expanded(NodeEvent { at, parent, g: node.g, f: entry.f() });
            if graph.end(at) == Some(state) {
                observer.reached(at, node.g);
            }
            let mut relaxing = Relaxing { graph, goal, guide, at, weights, nodes, open, observer };
            scanner.scan::<K, CENTER>(weights, (state, node.g.to_bits()), &mut relaxing);
        }
        SearchStatus::Searching
    }
}

fn id(state: usize) -> VertexId {
    VertexId(state as u32)
}

/// The successors of a node while they are found.
struct Relaxing<'s, O> {
    graph: &'s CostGraph,
    goal: Goal,
    guide: &'s Guide,
    /// The node.
    at: Vertex,
    weights: &'s [u32],
    nodes: &'s mut NodeStore,
    open: &'s mut OpenList,
    observer: &'s mut O,
}

impl<O: Observer> Visit for Relaxing<'_, O> {
    #[inline]
    fn known(&self, to: usize) -> u64 {
        match self.nodes.get(id(to)) {
            Some(node) => node.g.to_bits(),
            None if self.graph.is_center() && self.weights[to] == 0 => 0,
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
                let h = self.guide.bound(self.graph, (at, to), self.goal.at);
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

impl CostGraph {
    /// The vertex and the state before a vertex that was reached by the move with this index.
    fn parent(&self, at: Vertex, by: usize) -> (Vertex, usize) {
        let v = self.scanner().moves.all()[by].vector;
        let before = at + -v;
        let position = self.layout().position(before.x, before.y);
        (before, self.scanner().gaps.state(self.map().weights(), position, v))
    }
}

impl Planner for CostAStar {
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.status = SearchStatus::Unreachable;
        self.graph.check(End::Start, query.start)?;
        self.graph.check(End::Goal, query.goal)?;
        if self.begin_from(&[query.start], query.goal, observer).is_none() && query.start == query.goal {
            // At a closed gap that no path leaves: the path is the vertex alone.
            self.starts.clear();
            self.status = SearchStatus::Found;
        }
        Ok(self.status)
    }

    fn begin_from(
        &mut self,
        starts: &[Vertex],
        goal: Vertex,
        observer: &mut impl Observer,
    ) -> Option<SearchStatus> {
        self.goal.at = goal;
        self.goal.state = self.graph.end(goal)?;
        self.starts.clear();
        self.starts.extend(starts.iter().filter_map(|&start| self.graph.end(start)));
        self.starts.sort_unstable();
        self.starts.dedup();
        self.begin_at(observer);
        Some(self.status)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if self.status == SearchStatus::Searching {
            self.status = by_kind!(self.graph, [self.run](observer));
        }
        Ok(self.status)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        if self.status == SearchStatus::Unreachable {
            return None;
        }
        if self.starts.is_empty() {
            return (self.goal.at == at).then(|| Path::with_cost(vec![at], 0.0));
        }
        let mut state = self.graph.end(at)?;
        let mut node = self.search.nodes.get(id(state))?;
        let cost = self.graph.to_f64(node.g);
        let (mut waypoints, mut at, mut last) = (vec![at], at, None);
        while node.g != Cost::ZERO {
            let by = node.arrived_by();
            (at, state) = self.graph.parent(at, by);
            match waypoints.last_mut().filter(|_| last == Some(by)) {
                Some(end) => *end = at,
                None => waypoints.push(at),
            }
            last = Some(by);
            node = self.search.nodes.get(id(state))?;
        }
        waypoints.reverse();
        Some(Path::with_cost(waypoints, cost))
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Cheapest(self.graph.k())
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}
