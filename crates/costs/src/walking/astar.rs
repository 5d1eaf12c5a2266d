//! A* over elevation.

use std::sync::Arc;

use mediant_grid::{Identity, Vertex};
use mediant_moves::Cost;
use mediant_search::{End, Ends, Guarantee, Observer, Path, Planner, QueryError, SearchStatus};

use super::{
    Heading,
    graph::{OfWalking, ROOMS, WalkingGraph},
    map::BLOCKED,
};
use crate::best_first::{BestFirst, SearchGraph};

/// A* over elevation (Hart, Nilsson & Raphael 1968). Its heuristic is h_k at the greatest speed, on the
/// slopes of the map, and with the least friction. Without it, it is Dijkstra's algorithm.
///
/// The cost of its paths, [`Path::cost`], is their time; [`Path::length`] is their length in cells. Observers
/// are told costs in units of the map ([`WalkingGraph::to_f64`]).
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
    search: BestFirst,
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
            search: BestFirst::new(graph.map().layout().len()),
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
        BestFirst::bytes(graph.map().layout().len())
    }

    /// The search graph.
    #[must_use]
    pub const fn graph(&self) -> &Arc<WalkingGraph> {
        &self.graph
    }

    fn begin_at(&mut self, observer: &mut impl Observer) {
        self.status = SearchStatus::Searching;
        let Self { graph, search, starts, goal, is_guided, .. } = self;
        search.begin(&**graph, starts, bound(graph, *goal, *is_guided), observer);
    }

    /// Continues the search.
    fn run<const N: usize>(&mut self, observer: &mut impl Observer) -> SearchStatus {
        let Self { graph, search, goal, is_guided, .. } = self;
        let Some(end) = graph.position(*goal) else { return SearchStatus::Unreachable };
        let moves = OfWalking::<N>::new(graph, Heading::FromSources);
        search.run((&**graph, moves), end, bound(graph, *goal, *is_guided), observer)
    }
}

/// The heuristic.
fn bound(graph: &WalkingGraph, goal: Vertex, is_guided: bool) -> impl Fn(Vertex, usize) -> Cost {
    move |at, _| if is_guided { graph.least_cost(at.to(goal)) } else { Cost::ZERO }
}

/// A vertex has one state, its position.
impl SearchGraph for WalkingGraph {
    #[inline]
    fn vertex(&self, state: usize) -> Vertex {
        Self::vertex(self, state)
    }

    fn before(&self, at: Vertex, by: usize) -> (Vertex, usize) {
        let before = at + -self.moves().all[by].vector;
        (before, self.map().layout().position(before.x, before.y))
    }

    #[inline]
    fn is_blocked(&self, state: usize) -> bool {
        self.map().heights()[state] == BLOCKED
    }

    #[inline]
    fn ends_in(&self, _: Vertex, _: usize) -> bool {
        true
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
        let (waypoints, cost) = self.search.path(&*self.graph, at, self.graph.position(at)?)?;
        Some(Path::with_cost(waypoints, self.graph.to_f64(cost)))
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Cheapest(self.graph.k())
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}
