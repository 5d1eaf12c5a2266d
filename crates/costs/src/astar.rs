//! A* on a cost surface.

use std::sync::Arc;

use mediant_grid::{Identity, Mismatch, Vertex};
use mediant_search::{End, Ends, Guarantee, Observer, Path, Planner, QueryError, SearchStatus};

use crate::{
    best_first::{BestFirst, SearchGraph},
    graph::CostGraph,
    guide::Guide,
    landmarks::Landmarks,
    scan::{OfCosts, by_kind},
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
    search: BestFirst,
    starts: Vec<usize>,
    goal: Goal,
    guide: Guide,
    status: SearchStatus,
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
        let search = BestFirst::new(graph.states());
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
        BestFirst::bytes(graph.states())
    }

    /// Continues with another graph: that of a surface after an edit. The search that was begun last is
    /// forgotten, and so are landmarks of another graph. The scratch memory is kept if the graph has as many
    /// vertices.
    pub fn follow(&mut self, graph: Arc<CostGraph>) {
        self.guide.follow(&graph);
        self.search.fit(graph.states());
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
        let Self { graph, search, starts, goal, guide, .. } = self;
        let goal = *goal;
        guide.aim(goal.state);
        search.begin(&**graph, starts, |at, state| guide.bound(graph, (at, state), goal.at), observer);
    }

    /// Continues the search. `K` and `CENTER` are those of a scan.
    fn run<const K: u32, const CENTER: bool>(&mut self, observer: &mut impl Observer) -> SearchStatus {
        let Self { graph, search, goal, guide, .. } = self;
        let (graph, goal, guide): (&CostGraph, Goal, &Guide) = (graph, *goal, guide);
        let moves = OfCosts::<K, CENTER>::new(graph.scanner(), graph.map());
        search.run((graph, moves), goal.state, |at, state| guide.bound(graph, (at, state), goal.at), observer)
    }
}

impl SearchGraph for CostGraph {
    #[inline]
    fn vertex(&self, state: usize) -> Vertex {
        Self::vertex(self, state)
    }

    fn before(&self, at: Vertex, by: usize) -> (Vertex, usize) {
        let v = self.scanner().moves.all()[by].vector;
        let before = at + -v;
        let position = self.layout().position(before.x, before.y);
        (before, self.scanner().gaps.state(self.map().weights(), position, v))
    }

    #[inline]
    fn is_blocked(&self, state: usize) -> bool {
        self.is_center() && self.map().weights()[state] == 0
    }

    #[inline]
    fn ends_in(&self, at: Vertex, state: usize) -> bool {
        self.end(at) == Some(state)
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
        let (waypoints, cost) = self.search.path(&*self.graph, at, self.graph.end(at)?)?;
        Some(Path::with_cost(waypoints, self.graph.to_f64(cost)))
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Cheapest(self.graph.k())
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}
