//! Theta* and Lazy Theta*: the planner.

use std::{marker::PhantomData, ops::Deref, sync::Arc};

use mediant_grid::{CornerRule, GridGraph, Identity, Placement, Rules, Vertex, VertexId};
use mediant_moves::FiniteK;

use super::{
    search::{Parents, ThetaSearch},
    sight_cache::SightCache,
    sight_check::{Eager, Lazy, SightCheck},
};
use crate::{
    guarantee::Guarantee,
    heuristic::Heuristic,
    line_path::push_waypoint,
    nodes::{Node, NodeStore},
    observer::Observer,
    open_list::OpenList,
    path::Path,
    planner::{Planner, SearchStatus},
    query::{Ends, QueryError},
};

/// Theta*: A* in which the parent of a node is the parent of the node that generates it, if that sees it.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, GridGraph};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Ends, Hk, Planner, ThetaStar};
///
/// let map = AsciiMap::parse("
///     ......
///     ...#..
///     ...#..
///     ......
/// ")?;
/// let graph = GridGraph::<Corners>::new(Arc::new(map.grid), FiniteK::new(3)?, DiagonalGap::Open)?;
/// let answer = ThetaStar::new(&graph, Hk).solve(Ends::new((0, 1), (6, 2)))?;
/// let expected = [(0, 1), (4, 1), (6, 2)].map(Into::into);
/// assert_eq!(answer.path().map(|path| path.waypoints()), Some(&expected[..]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type ThetaStar<G, H> = Theta<G, H, Eager>;

/// Lazy Theta*: Theta* that assumes a line of sight until the node is expanded. If the node then does not see
/// its parent, its parent becomes the closed neighbor through which the path is cheapest. The node is
/// expanded all the same, at that higher cost.
pub type LazyThetaStar<G, H> = Theta<G, H, Lazy>;

/// The planner that [`ThetaStar`] and [`LazyThetaStar`] share; `S` says when lines of sight are checked.
///
/// `G` is how the planner holds its grid graph: by reference, or, where both belong in one struct, by `Arc`.
/// Its scratch memory is half a byte a vertex, and 24 bytes for each that searches touch. The cost of a
/// segment is that of a move of its displacement, [`Cost::of_move`](mediant_moves::Cost::of_move).
///
/// Segments connect the same vertices as N(3). N(2) connects fewer where corners are always cut: segments
/// then lead between two blocked cells that meet diagonally. So a query whose ends N(2) does not connect is
/// searched over N(3), on a graph that is made when it is first needed.
#[derive(Clone, Debug)]
pub struct Theta<G: Deref, H, S>
where
    G::Target: Sized,
{
    graph: G,
    /// The graph of N(3), once it was needed, and whether it is searched.
    wider: Option<Arc<G::Target>>,
    is_wider: bool,
    heuristic: H,
    nodes: NodeStore<Parents>,
    open: OpenList,
    sight: SightCache,
    ends: [VertexId; 2],
    status: SearchStatus,
    check: PhantomData<S>,
}

impl<P: Placement, S> Theta<&GridGraph<P>, (), S> {
    /// The scratch memory that a planner for this graph takes when it is made, in bytes.
    #[must_use]
    pub fn scratch_bytes(graph: &GridGraph<P>) -> usize {
        NodeStore::<Parents>::bytes(graph.vertex_count()).saturating_add(SightCache::bytes::<P>(graph))
    }
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>, H: Heuristic, S: SightCheck> Theta<G, H, S> {
    /// A planner with scratch memory for `graph`.
    #[must_use]
    pub fn new(graph: G, heuristic: H) -> Self {
        let nodes = NodeStore::new(graph.vertex_count());
        let sight = SightCache::new::<P>(&graph);
        let (open, ends, status) = (OpenList::default(), [VertexId(0); 2], SearchStatus::default());
        let (wider, is_wider) = (None, false);
        Self { graph, wider, is_wider, heuristic, nodes, open, sight, ends, status, check: PhantomData }
    }

    /// Continues with another grid graph. The search that was begun last is forgotten, and so is what is
    /// remembered of lines of sight. The scratch memory is kept if the map has the same size.
    pub fn follow(&mut self, graph: G) {
        self.nodes.fit(graph.vertex_count());
        self.sight.follow::<P>(&graph);
        self.open.clear();
        (self.ends, self.status) = ([VertexId(0); 2], SearchStatus::default());
        (self.wider, self.is_wider) = (None, false);
        self.graph = graph;
    }

    /// The graph of N(3), if segments connect more than N(k).
    fn wider(&mut self) -> Option<&GridGraph<P>> {
        let graph: &GridGraph<P> = &self.graph;
        if graph.k() != FiniteK::N4 || graph.rules() != Rules::Center(CornerRule::Always) {
            return None;
        }
        if self.wider.is_none() {
            let wider = GridGraph::new(Arc::clone(graph.grid()), FiniteK::N8, graph.rule());
            self.wider = wider.ok().map(Arc::new);
        }
        self.wider.as_deref()
    }

    /// The search, with its memory.
    fn search<'s, O: Observer>(&'s mut self, observer: &'s mut O) -> ThetaSearch<'s, P, H, S, O> {
        let Self { graph, heuristic, nodes, open, sight, ends: [start, goal], check, .. } = self;
        let wider = self.wider.as_deref().filter(|_| self.is_wider);
        let (graph, heuristic, check) = (wider.unwrap_or(graph), *heuristic, *check);
        let (start, goal, goal_at) = (*start, *goal, graph.vertex(*goal));
        ThetaSearch { graph, heuristic, nodes, open, sight, observer, start, goal, goal_at, check }
    }
}

impl<P, G, H, S> Planner for Theta<G, H, S>
where
    P: Placement,
    G: Deref<Target = GridGraph<P>>,
    H: Heuristic,
    S: SightCheck,
{
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.status = SearchStatus::Unreachable;
        let mut ends = query.ids(&self.graph)?;
        self.is_wider = false;
        if ends.is_none()
            && let Some(wider) = self.wider()
        {
            ends = query.ids(wider)?;
            self.is_wider = true;
        }
        if let Some((start, goal)) = ends {
            self.ends = [start, goal];
            self.search(observer).begin();
            self.status = SearchStatus::Searching;
        }
        Ok(self.status)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if self.status == SearchStatus::Searching {
            self.status = self.search(observer).run();
        }
        Ok(self.status)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        let id = self.graph.id(at).filter(|_| self.status != SearchStatus::Unreachable)?;
        let is_closed = self.nodes.get(id)?.slot == Node::<Parents>::CLOSED;
        // The parent of an open node may be a guess.
        is_closed.then(|| self.path(self.ends[0], id))
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Suboptimal
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>, H, S> Theta<G, H, S> {
    /// The path that a search found, without waypoints on a straight line between their neighbors.
    fn path(&self, start: VertexId, goal: VertexId) -> Path {
        let up = |&id: &VertexId| self.nodes.get(id).filter(|_| id != start).map(|node| node.pointer.parent);
        let mut waypoints: Vec<Vertex> = Vec::with_capacity(std::iter::successors(Some(goal), up).count());
        for id in std::iter::successors(Some(goal), up) {
            push_waypoint(&mut waypoints, self.graph.vertex(id));
        }
        waypoints.reverse();
        Path::new(waypoints)
    }
}
