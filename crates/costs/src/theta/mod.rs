//! Theta* and Lazy Theta* on a cost surface, and smoothing.

mod smooth;

use std::sync::Arc;

use mediant_grid::{Identity, Mismatch, Vertex, VertexId};
use mediant_moves::Cost;
use mediant_search::{
    End, Ends, Guarantee, NodeEvent, Observer, Path, Planner, QueryError, SearchStatus,
    parts::{Entry, Node, NodeStore, OpenList},
};

pub use self::smooth::smooth;
use crate::{
    graph::{CostGraph, primitive},
    guide::Guide,
    landmarks::Landmarks,
    scan::Visit,
};

/// Theta* (Nash, Daniel, Koenig & Felner 2007) on a cost surface: A* in which the parent of a node may be the
/// parent of the node that generates it, if the straight segment from there is legal. The segment costs the
/// integral along it ([`CostGraph::line_cost`]).
///
/// Where costs differ a straight segment can be dearer than the way around. So the parent is skipped only
/// where that is not dearer than the way over it. Therefore **no path costs more than the least cost over
/// N(k)**: when a node is generated, its cost is at most that of its generator and of the move; and the
/// heuristic is consistent over N(k). Take an optimal path over N(k) to a node s that is about to be
/// expanded, and its first node m that is not closed. The node before m was closed at no more than its
/// optimal cost, so m has no more either; and f(s) ≤ f(m) then implies the same of s. Nothing is known of how
/// near paths come to the least cost at any angle.
///
/// [`lazy`](Self::lazy) walks a segment only for nodes that are expanded, and until then has the cost of the
/// way over the parent. (Lazy Theta* of Nash, Koenig & Tovey 2010 takes the segment for granted until then.
/// But what it costs is not known before it is walked.) It saves most walks, the promise holds as well, and
/// paths are a little dearer.
///
/// Closed nodes stay closed, as in the papers. A path is found whenever N(k) has one.
/// [`Path::cost`] is the cost of its paths on the surface, [`Path::length`] their length.
///
/// ```
/// use std::sync::Arc;
/// use mediant_costs::{CostGraph, CostSurface, CostTheta};
/// use mediant_grid::{CornerRule, Rules};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Ends, Planner};
///
/// // Meadow, and a swamp from row 4 on.
/// let map = Arc::new(CostSurface::from_fn(12, 8, |_, y| Some(if y < 4 { 1.0 } else { 5.0 }))?);
/// let graph = Arc::new(CostGraph::new(map, Rules::Center(CornerRule::Never), FiniteK::N8)?);
/// let mut planner = CostTheta::new(Arc::clone(&graph));
/// let answer = planner.solve(Ends::new((0, 0), (11, 5)))?;
/// let path = answer.path().expect("all cells are free");
/// assert_eq!(path.to_string(), "(0, 0) → (10, 3) → (11, 5)");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Its scratch memory is 24 bytes for each vertex that searches touch.
#[derive(Debug)]
pub struct CostTheta {
    graph: Arc<CostGraph>,
    /// The pointer of each leads to the state of its parent; that of the start to itself.
    nodes: NodeStore<VertexId>,
    open: OpenList,
    start: usize,
    goal: usize,
    /// The path is this vertex alone.
    alone: Option<Vertex>,
    guide: Guide,
    is_lazy: bool,
    status: SearchStatus,
}

impl CostTheta {
    /// Theta*, with scratch memory for a graph.
    #[must_use]
    pub fn new(graph: Arc<CostGraph>) -> Self {
        let nodes = NodeStore::new(graph.states());
        let status = SearchStatus::default();
        let (open, guide) = (OpenList::default(), Guide::LeastCost);
        Self { graph, nodes, open, start: 0, goal: 0, alone: None, guide, is_lazy: false, status }
    }

    /// Lazy Theta*.
    #[must_use]
    pub fn lazy(graph: Arc<CostGraph>) -> Self {
        Self { is_lazy: true, ..Self::new(graph) }
    }

    /// The same without its heuristic.
    #[must_use]
    pub fn unguided(self) -> Self {
        Self { guide: Guide::Zero, ..self }
    }

    /// The same, guided by landmarks, too. Their bounds are those over N(k).
    ///
    /// # Errors
    /// [`Mismatch`] for the landmarks of another graph.
    pub fn guided_by(self, landmarks: Arc<Landmarks>) -> Result<Self, Mismatch> {
        Ok(Self { guide: Guide::by(landmarks, &self.graph)?, ..self })
    }

    /// The bytes of scratch memory that a planner for a graph takes when it is made.
    #[must_use]
    pub fn scratch_bytes(graph: &CostGraph) -> usize {
        NodeStore::<VertexId>::bytes(graph.states())
    }

    /// Continues with another graph: that of a surface after an edit. The search that was begun last is
    /// forgotten, and so are landmarks of another graph.
    pub fn follow(&mut self, graph: Arc<CostGraph>) {
        self.guide.follow(&graph);
        self.nodes.fit(graph.states());
        self.open.clear();
        self.status = SearchStatus::default();
        self.graph = graph;
    }

    /// [`follow`](Self::follow) with landmarks of the other graph.
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
        let Self { graph, nodes, open, start, goal, guide, .. } = self;
        guide.aim(*goal);
        nodes.start_search();
        open.clear();
        let (at, id) = (graph.vertex(*start), id(*start));
        let h = guide.bound(graph, (at, *start), graph.vertex(*goal));
        nodes.set_path(id, Cost::ZERO, 0, id);
        observer.generated(NodeEvent { at, parent: None, g: Cost::ZERO, f: h });
        open.push(Entry::new(h, h, id), |id, slot| nodes.set_slot(id, slot));
        self.status = SearchStatus::Searching;
    }

    /// Expands nodes until the goal is the best open node, none is open, or the observer pauses.
    fn run(&mut self, observer: &mut impl Observer) -> SearchStatus {
        let Self { graph, nodes, open, goal, guide, is_lazy, .. } = self;
        let (graph, guide, is_lazy): (&CostGraph, &Guide, bool) = (graph, guide, *is_lazy);
        let weights = graph.map().weights();
        let goal_id = id(*goal);
        while open.get(0).is_none_or(|best| best.id() == goal_id || !observer.pauses(best.f())) {
            let Some((entry, swaps)) = open.pop(|id, slot| nodes.set_slot(id, slot)) else {
                return SearchStatus::Unreachable;
            };
            observer.percolated(swaps);
            let Some(mut node) = nodes.get(entry.id()) else { continue };
            let state = entry.id().index();
            let mut f = entry.f();
            if is_lazy && let Some((g, parent)) = straighter(graph, nodes, state, node) {
                nodes.set_path(entry.id(), g, node.arrived_by(), parent);
                f = f - (node.g - g);
                (node.g, node.pointer) = (g, parent);
            }
            nodes.set_slot(entry.id(), Node::<VertexId>::CLOSED);
            if entry.id() == goal_id {
                return SearchStatus::Found;
            }
            let at = graph.vertex(state);
            let parent = node.pointer.index();
            let parent_at = (parent != state).then(|| graph.vertex(parent));
            observer.expanded(NodeEvent { at, parent: parent_at, g: node.g, f });
            if graph.end(at) == Some(state) {
                observer.reached(at, node.g);
            }
            // The start has no parent to be seen from, and neither has a node of a lazy search before it is
            // expanded.
            let above = if is_lazy || parent == state { None } else { nodes.get(node.pointer) };
            let above = above.map(|above| (parent, above.g));
            let goal_at = graph.vertex(*goal);
            let mut relaxing =
                Relaxing { graph, guide, goal_at, here: (state, at), above, weights, nodes, open, observer };
            graph.scan((state, node.g.to_bits()), &mut relaxing);
        }
        SearchStatus::Searching
    }
}

fn id(state: usize) -> VertexId {
    VertexId(state as u32)
}

/// The cost of a node and its parent, if the straight segment from the parent's parent is not dearer than the
/// way over the parent.
fn straighter(
    graph: &CostGraph,
    nodes: &NodeStore<VertexId>,
    state: usize,
    node: Node<VertexId>,
) -> Option<(Cost, VertexId)> {
    let parent = nodes.get(node.pointer)?;
    let above = parent.pointer;
    // The start is its own parent.
    if node.pointer.index() == state || above == node.pointer {
        return None;
    }
    let from = nodes.get(above)?.g;
    let limit = (node.g - from).to_bits();
    let line = graph.line_between(above.index(), state, limit).filter(|&line| line <= limit)?;
    Some((from + Cost::from_bits(line), above))
}

/// The successors of a node while they are found.
struct Relaxing<'s, O> {
    graph: &'s CostGraph,
    guide: &'s Guide,
    goal_at: Vertex,
    here: (usize, Vertex),
    /// The state from which straight segments begin, and its cost.
    above: Option<(usize, Cost)>,
    weights: &'s [u32],
    nodes: &'s mut NodeStore<VertexId>,
    open: &'s mut OpenList,
    observer: &'s mut O,
}

impl<O: Observer> Visit for Relaxing<'_, O> {
    /// A straight segment may beat what a move does not. So all nodes are asked about that are not closed.
    #[inline]
    fn known(&self, to: usize) -> u64 {
        match self.nodes.get(id(to)) {
            Some(node) if node.slot == Node::<VertexId>::CLOSED => 0,
            Some(node) if self.above.is_none() => node.g.to_bits(),
            None if self.graph.is_center() && self.weights[to] == 0 => 0,
            _ => u64::MAX,
        }
    }

    fn relax(&mut self, by: usize, to: usize, cost: u64) {
        let known = self.nodes.get(id(to));
        // A path must be as cheap as the move, and cheaper than the one known.
        let most = known.map_or(u64::MAX, |known| known.g.to_bits() - 1);
        let mut best = (cost, self.here.0);
        if let Some((above, g)) = self.above
            && let Some(limit) = most.min(cost).checked_sub(g.to_bits())
            && let Some(line) = self.graph.line_between(above, to, limit).filter(|&line| line <= limit)
        {
            best = (g.to_bits() + line, above);
        }
        let (g, parent) = (Cost::from_bits(best.0), best.1);
        if g.to_bits() > most {
            return;
        }
        let (at, to_id) = (self.graph.vertex(to), id(to));
        self.nodes.set_path(to_id, g, by, id(parent));
        let parent_at = if parent == self.here.0 { self.here.1 } else { self.graph.vertex(parent) };
        let event = |f| NodeEvent { at, parent: Some(parent_at), g, f };
        let Self { nodes, open, .. } = self;
        let moved = |id, slot| nodes.set_slot(id, slot);
        let swaps = if let Some(known) = known {
            let gain = known.g - g;
            let f = open.get(known.slot).map_or(g, |entry| entry.f() - gain);
            self.observer.updated(event(f));
            open.decrease(known.slot, gain, moved)
        } else {
            let h = self.guide.bound(self.graph, (at, to), self.goal_at);
            self.observer.generated(event(g + h));
            open.push(Entry::new(g + h, h, to_id), moved)
        };
        self.observer.percolated(swaps);
    }
}

impl Planner for CostTheta {
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.status = SearchStatus::Unreachable;
        self.graph.check(End::Start, query.start)?;
        self.graph.check(End::Goal, query.goal)?;
        self.alone = (query.start == query.goal).then_some(query.start);
        if self.alone.is_some() {
            self.status = SearchStatus::Found;
        } else if let Some((start, goal)) = self.graph.end(query.start).zip(self.graph.end(query.goal)) {
            (self.start, self.goal) = (start, goal);
            self.begin_at(observer);
        }
        Ok(self.status)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if self.status == SearchStatus::Searching {
            self.status = self.run(observer);
        }
        Ok(self.status)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        if self.status == SearchStatus::Unreachable {
            return None;
        }
        if let Some(alone) = self.alone {
            return (alone == at).then(|| Path::with_cost(vec![at], 0.0));
        }
        let mut state = self.graph.end(at)?;
        let mut node = self.nodes.get(id(state))?;
        let (mut waypoints, cost) = (vec![at], self.graph.to_f64(node.g));
        while node.pointer.index() != state {
            state = node.pointer.index();
            push(&self.graph, &mut waypoints, self.graph.vertex(state));
            node = self.nodes.get(node.pointer)?;
        }
        waypoints.reverse();
        Some(Path::with_cost(waypoints, cost))
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::AtMostCheapest(self.graph.k())
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}

/// Adds a waypoint, if it is another one than the last. The one before is left out if it lies on a straight
/// line between its neighbors and the cost stays exactly the same: if the same move of N(k) is repeated.
fn push(graph: &CostGraph, waypoints: &mut Vec<Vertex>, at: Vertex) {
    if waypoints.last() == Some(&at) {
        return;
    }
    if let [.., before, last] = waypoints[..] {
        let v = primitive(last.to(at)).0;
        if v == primitive(before.to(last)).0 && graph.known_move(v).is_some() {
            waypoints.pop();
        }
    }
    waypoints.push(at);
}
