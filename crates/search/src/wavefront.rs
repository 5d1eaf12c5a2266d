//! The wavefront algorithm: breadth-first search, one move a step (the 'Wave-front' among the classical
//! algorithms of Hammoud & Lupin 2023, there on 4 and 8 neighbors; here for every k, both placements and all
//! rules of motion).
//!
//! Rule variant: a vertex is expanded with all its legal moves, nothing is pruned, and the search ends as
//! soon as the goal is reached. No path has fewer moves. With four neighbors it is a shortest path; for
//! larger k moves differ in length, and it may be longer. (Where gaps are closed and k > 2, only paths that
//! touch no gap but at their ends are considered, as in all engines. A shortest path never needs to touch
//! one; a path of fewest moves may, from k = 5 on.)
//!
//! Ties: the vertices of a layer are expanded in the order in which they were reached, their moves in the
//! order of [`GridGraph::for_each_legal_move`], and the first move that reaches a vertex is kept.
//!
//! Layers as bits, 64 vertices a word operation, were tried and left out: they need a second implementation
//! of the rules of motion and save half of the time (`docs/measurements/search.md`).

use std::ops::Deref;

use mediant_grid::{GridGraph, Identity, Placement, Vertex, VertexId};
use mediant_moves::{Cost, FiniteK};

use crate::{
    distances::{Distances, end_at_gaps},
    nodes::NodeStore,
    observer::{NodeEvent, Observer},
    outcome::{Guarantee, Outcome},
    planner::Planner,
    query::{Query, QueryError},
    trace::trace_back,
};

/// The wavefront algorithm on a grid graph.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph, Vertex};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Planner, Query, Wavefront};
///
/// let map = AsciiMap::parse("
///     ....
///     .##.
///     ....
/// ")?;
/// let graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::new(2)?, CornerRule::Never)?;
/// let mut planner = Wavefront::new(&graph);
/// let outcome = planner.solve(Query::new((0, 1), (3, 1)))?;
/// assert_eq!(outcome.path().map(|path| path.cost()), Some(5.0));
/// let moves = planner.distances(Vertex::new(0, 1))?;
/// assert_eq!((moves.get(Vertex::new(3, 1)), moves.get(Vertex::new(1, 1))), (Some(5), None));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `G` is how the planner holds its grid graph: by reference, or, where both belong in one struct, by `Arc`.
#[derive(Clone, Debug)]
pub struct Wavefront<G> {
    graph: G,
    nodes: NodeStore,
    /// The vertices that were reached, in the order in which they were.
    reached: Vec<VertexId>,
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>> Wavefront<G> {
    /// A planner with scratch memory for `graph`: 16 bytes a vertex, and up to 4 more for each that a search
    /// reaches.
    #[must_use]
    pub fn new(graph: G) -> Self {
        let nodes = NodeStore::new(graph.vertex_count());
        Self { graph, nodes, reached: Vec::new() }
    }

    /// The least number of moves from `start` to every vertex.
    ///
    /// # Errors
    /// [`QueryError`] when the start is blocked or outside the map.
    pub fn distances(&mut self, start: Vertex) -> Result<Distances<u32>, QueryError> {
        Query::new(start, start).check(&self.graph)?;
        let mut moves = vec![None; self.graph.vertex_count()];
        if let Some(id) = self.graph.id(start) {
            self.search(id, None, &mut ());
            moves[id.index()] = Some(0);
        }
        let Self { graph, nodes, reached } = self;
        let arrived_by = |id| nodes.get(id).map_or(0, |node| node.arrived_by());
        for &id in reached.iter().skip(1) {
            let from = graph.step(arrived_by(id)).source(id);
            moves[id.index()] = moves[from.index()].map(|moves| moves + 1);
        }
        end_at_gaps(graph, start, &mut moves, arrived_by, |moves, _| moves + 1);
        Ok(Distances::new(P::vertices(graph.grid()).0, moves))
    }

    /// Reaches vertices layer by layer, until the goal is reached or no vertex is left. Returns whether the
    /// goal was reached.
    fn search(&mut self, start: VertexId, goal: Option<VertexId>, observer: &mut impl Observer) -> bool {
        let Self { graph, nodes, reached } = self;
        let graph: &GridGraph<P> = graph;
        // No move leads to a vertex outside the map.
        let goal_at = goal.map_or(Vertex::new(-1, -1), |goal| graph.vertex(goal));
        nodes.start_search();
        reached.clear();
        nodes.set_path(start, Cost::ZERO, 0, ());
        reached.push(start);
        let event = |at, parent, g| NodeEvent { at, parent, g, f: g };
        observer.generated(event(graph.vertex(start), None, Cost::ZERO));
        let mut found = goal == Some(start);
        let mut next = 0;
        while let Some(&id) = reached.get(next).filter(|_| !found) {
            next += 1;
            let Some(&node) = nodes.get(id) else { continue };
            let at = graph.vertex(id);
            let arrived_by = (id != start).then(|| node.arrived_by());
            let parent = arrived_by.map(|index| at + -graph.step(index).vector());
            observer.expanded(event(at, parent, node.g));
            graph.for_each_successor(at, arrived_by, goal_at, |index| {
                let step = graph.step(index);
                let to = step.target(id);
                if found || nodes.get(to).is_some() {
                    return;
                }
                let g = node.g + step.cost;
                nodes.set_path(to, g, index, ());
                reached.push(to);
                observer.generated(event(at + step.vector(), Some(at), g));
                found = goal == Some(to);
            });
        }
        found
    }
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>> Planner for Wavefront<G> {
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        let Some((start, goal)) = query.ends(&self.graph)? else { return Ok(Outcome::Unreachable) };
        if !self.search(start, Some(goal), observer) {
            return Ok(Outcome::Unreachable);
        }
        Ok(Outcome::Found(trace_back(&self.graph, &self.nodes, start, goal)))
    }

    fn guarantee(&self) -> Guarantee {
        let k = self.graph.k();
        if k == FiniteK::N4 { Guarantee::Optimal(k) } else { Guarantee::Suboptimal }
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}
