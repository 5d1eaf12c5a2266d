//! The wavefront algorithm: breadth-first search, one move a step (the 'Wave-front' among the classical
//! algorithms of Hammoud & Lupin 2023, there on 4 and 8 neighbors; here for every k, both placements and all
//! rules of motion).
//!
//! Rule variant: a vertex is expanded with all its legal moves, nothing is pruned, and the search ends as
//! soon as the goal is reached. No legal path over N(k) has fewer moves. With four neighbors it is a shortest
//! path; for larger k moves differ in length, and it may be longer.
//!
//! **Closed gaps.** A shortest path need not touch one but with its ends (for k > 2), so the other engines
//! enter none. Up to k = 4 this is true of the fewest moves, too: of the moves u and v by which a path passes
//! a gap within the quadrant of a free cell, both lie in the closed cone of that cell, and their sum is a
//! move, or two moves, over other corners of cells that they sweep (k = 3: along or across the cell; k = 4:
//! also along its two neighbors). From k = 5 on it is false: the sum may need three moves. There the search
//! enters gaps, and has a node for each of the two free quadrants of a gap (module `gap_nodes`).
//!
//! Ties: the vertices of a layer are expanded in the order in which they were reached, their moves in the
//! order of [`GridGraph::for_each_legal_move`], and the first move that reaches a vertex is kept.
//!
//! Layers as bits, 64 vertices a word operation, were tried and left out: they need a second implementation
//! of the rules of motion and save half of the time (`docs/measurements/search.md`).

mod quadrants;

use std::ops::Deref;

use mediant_grid::{
    GridGraph, Identity, Interrupt, Interrupted, Placement, Vertex, VertexId, room_for, uninterrupted,
};
use mediant_moves::{Cost, FiniteK};

use self::quadrants::{Back, node_at, node_count, passes_gaps};
use crate::{
    distances::{Distances, end_at_gaps},
    gap_nodes::{ends_at, vertex_of},
    guarantee::Guarantee,
    nodes::NodeStore,
    observer::{NodeEvent, Observer},
    parent::ParentPointer,
    path::Path,
    planner::{Planner, SearchStatus},
    query::{Ends, QueryError},
    trace_back::trace_back,
};

/// The wavefront algorithm on a grid graph.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph, Vertex};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Ends, Planner, Wavefront};
///
/// let map = AsciiMap::parse("
///     ....
///     .##.
///     ....
/// ")?;
/// let graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::new(2)?, CornerRule::Never)?;
/// let mut planner = Wavefront::new(&graph);
/// let answer = planner.solve(Ends::new((0, 1), (3, 1)))?;
/// assert_eq!(answer.path().map(|path| path.cost()), Some(5.0));
/// let moves = planner.distances(Vertex::new(0, 1))?;
/// assert_eq!((moves.get(Vertex::new(3, 1)), moves.get(Vertex::new(1, 1))), (Some(5), None));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `G` is how the planner holds its grid graph: by reference, or, where both belong in one struct, by `Arc`.
#[derive(Clone, Debug)]
pub struct Wavefront<G> {
    graph: G,
    nodes: NodeStore<Back>,
    /// The nodes that were reached, in the order in which they were.
    reached: Vec<VertexId>,
    /// How many of these were expanded.
    expanded: usize,
    /// `None` for a search that finds the distances of all vertices.
    goal: Option<VertexId>,
    status: SearchStatus,
}

impl Wavefront<()> {
    /// The scratch memory that a planner for this graph takes when it is made, in bytes.
    #[must_use]
    pub fn scratch_bytes<P: Placement>(graph: &GridGraph<P>) -> usize {
        NodeStore::<Back>::bytes(node_count(graph))
    }
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>> Wavefront<G> {
    /// A planner with scratch memory for `graph`: 16 to 20 bytes for each vertex that searches
    /// reach, by pages of the system.
    #[must_use]
    pub fn new(graph: G) -> Self {
        let nodes = NodeStore::new(node_count(&*graph));
        let (goal, status) = (None, SearchStatus::default());
        Self { graph, nodes, reached: Vec::new(), expanded: 0, goal, status }
    }

    /// Continues with another grid graph. The search that was begun last is forgotten. The scratch memory is
    /// kept if the grid graph has as many vertices.
    pub fn follow(&mut self, graph: G) {
        self.nodes.fit(node_count(&*graph));
        self.reached.clear();
        (self.expanded, self.goal, self.status) = (0, None, SearchStatus::default());
        self.graph = graph;
    }

    /// The least number of moves from `start` to every vertex.
    ///
    /// # Errors
    /// [`QueryError`] when the start is blocked or outside the map.
    pub fn distances(&mut self, start: Vertex) -> Result<Distances<u32>, QueryError> {
        uninterrupted(|never| self.distances_interruptible(start, never))
    }

    /// [`distances`](Self::distances), which an interrupt can stop.
    ///
    /// # Errors
    /// [`Interrupted`]; within, those of [`distances`](Self::distances).
    pub fn distances_interruptible(
        &mut self,
        start: Vertex,
        interrupt: &Interrupt,
    ) -> Result<Result<Distances<u32>, QueryError>, Interrupted> {
        if let Err(error) = Ends::new(start, start).check(&self.graph) {
            return Ok(Err(error));
        }
        let count = node_count(&*self.graph);
        room_for::<Option<u32>>(count, "filling memory")?;
        let mut moves = vec![None; count];
        if let Some(id) = self.graph.id(start) {
            self.begin_at(id, None, &mut ());
            let mut stops = Stops { interrupt, expansions: 0, stopped: Ok(()) };
            self.run(&mut stops);
            stops.stopped?;
            moves[id.index()] = Some(0);
        }
        let Self { graph, nodes, reached, .. } = self;
        let graph: &GridGraph<P> = graph;
        let arrived_by = |id| nodes.get(id).map_or(0, |node| node.arrived_by());
        for &id in reached.iter().skip(1) {
            let (_, at) = vertex_of(graph, id);
            let (from, _) = Back.parent(graph, graph.step(arrived_by(id)), id, at);
            moves[id.index()] = moves[from.index()].map(|moves| moves + 1);
        }
        moves.truncate(graph.vertex_count());
        if passes_gaps(graph) {
            // A path ends at a gap in the quadrant of the vertex's own cell: that of its first node, if free.
            for (moves, id) in moves.iter_mut().zip(0..) {
                let at = graph.vertex(VertexId(id));
                *moves = moves.filter(|_| at == start || !graph.is_closed_gap(at) || ends_at(graph, at));
            }
        } else {
            end_at_gaps(graph, start, &mut moves, arrived_by, |moves, _| moves + 1);
        }
        Ok(Ok(Distances::new(P::vertices(graph.grid()).0, moves)))
    }

    /// Makes the start the only vertex that is reached.
    fn begin_at(&mut self, start: VertexId, goal: Option<VertexId>, observer: &mut impl Observer) {
        let Self { graph, nodes, reached, .. } = self;
        nodes.start_search();
        reached.clear();
        nodes.set_path(start, Cost::ZERO, 0, Back);
        reached.push(start);
        let at = graph.vertex(start);
        observer.generated(NodeEvent { at, parent: None, g: Cost::ZERO, f: Cost::ZERO });
        (self.expanded, self.goal) = (0, goal);
        self.status = if goal == Some(start) { SearchStatus::Found } else { SearchStatus::Searching };
    }

    /// Reaches vertices layer by layer, until the goal is reached, no vertex is left, or the observer pauses.
    fn run(&mut self, observer: &mut impl Observer) {
        let Self { graph, nodes, reached, expanded, goal, status } = self;
        let graph: &GridGraph<P> = graph;
        // No move leads to a vertex outside the map.
        let goal_at = goal.map_or(Vertex::new(-1, -1), |goal| graph.vertex(goal));
        let mut found = *status == SearchStatus::Found;
        while !found {
            let Some(&id) = reached.get(*expanded) else {
                *status = SearchStatus::Unreachable;
                return;
            };
            let Some(node) = nodes.get(id) else { return };
            if observer.pauses(node.g) {
                return;
            }
            let (at_id, at) = vertex_of(graph, id);
            // The start is the node that was reached first.
            let arrived_by = (*expanded > 0).then(|| node.arrived_by());
            *expanded += 1;
            let parent = arrived_by.map(|index| at + -graph.step(index).vector());
            observer.expanded(NodeEvent { at, parent, g: node.g, f: node.g });
            if !graph.is_closed_gap(at) {
                observer.reached(at, node.g);
            }
            let mut reach = |index| {
                let step = graph.step(index);
                let to_at = at + step.vector();
                let to = node_at(graph, (step.target(at_id), to_at), at);
                if found || nodes.get(to).is_some() {
                    return;
                }
                let g = node.g + step.cost;
                nodes.set_path(to, g, index, Back);
                reached.push(to);
                observer.generated(NodeEvent { at: to_at, parent: Some(at), g, f: g });
                found = *goal == Some(to);
            };
            if passes_gaps(graph) {
                graph.for_each_legal_move(at, |index| {
                    if graph.may_turn(parent, at, Some(at + graph.step(index).vector())) {
                        reach(index);
                    }
                });
            } else {
                graph.for_each_successor(at, arrived_by, goal_at, reach);
            }
        }
        *status = SearchStatus::Found;
    }
}

/// Pauses where an interrupt stops the search.
struct Stops<'i> {
    interrupt: &'i Interrupt,
    expansions: usize,
    stopped: Result<(), Interrupted>,
}

impl Observer for Stops<'_> {
    fn pauses(&mut self, _: Cost) -> bool {
        self.stopped = self.interrupt.check_every(64, self.expansions, "counting moves");
        self.expansions += 1;
        self.stopped.is_err()
    }
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>> Planner for Wavefront<G> {
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.status = SearchStatus::Unreachable;
        if let Some((start, goal)) = query.ids(&self.graph)? {
            self.begin_at(start, Some(goal), observer);
        }
        Ok(self.status)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if self.status == SearchStatus::Searching {
            self.run(observer);
        }
        Ok(self.status)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        let has_begun = self.goal.is_some() && self.status != SearchStatus::Unreachable;
        let id = self.graph.id(at).filter(|&id| has_begun && self.nodes.get(id).is_some())?;
        // At other gaps it may have passed, but no path ends there.
        if self.goal != Some(id) && self.graph.is_closed_gap(at) && !ends_at(&*self.graph, at) {
            return None;
        }
        Some(trace_back(&self.graph, &self.nodes, id))
    }

    fn guarantee(&self) -> Guarantee {
        let k = self.graph.k();
        if k == FiniteK::N4 { Guarantee::Optimal(k) } else { Guarantee::Suboptimal }
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}
