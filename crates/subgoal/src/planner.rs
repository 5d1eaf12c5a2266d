//! Optimal paths on a subgoal graph.

use std::ops::Deref;

use mediant_grid::{FreeSpace, Identity, Mismatch, Point, Vertex, sight::Place};
use mediant_moves::{Cost, K};
use mediant_search::{
    Ends, Guarantee, NodeEvent, Observer, Path, Planner, PointEnds, QueryError, SearchStatus,
    parts::{HasFreeSpace, Metric, SearchTree, leg_is_free},
};

use crate::{
    arc::{NONE, PackedArc, ParentEdge, Step},
    bends::BendRule,
    corners::PointSight,
    edge_path::{direct_path, extend, sees_between},
    graph::SubgoalGraph,
    placement::{EdgeCriterion, SubgoalPlacement},
};

/// An end of a query.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum QueryEnd {
    Vertex(Vertex),
    /// At any angle, a place that is no vertex.
    Between(Place),
}

impl QueryEnd {
    fn new(at: Place) -> Self {
        at.vertex().map_or(Self::Between(at), Self::Vertex)
    }

    /// The vertex, or the nearest one above and to the left: what observers are told.
    const fn floor(self) -> Vertex {
        match self {
            Self::Vertex(at) => at,
            Self::Between(at) => at.floor(),
        }
    }

    fn point(self) -> Point {
        match self {
            Self::Vertex(at) => at.into(),
            Self::Between(at) => at.into(),
        }
    }

    /// A lower bound on the cost of a path from a vertex to here; between places it is the cost of a free
    /// line.
    #[inline]
    fn estimate(self, metric: Metric, from: Vertex) -> Cost {
        match self {
            Self::Vertex(at) => metric.estimate(from.to(at)),
            Self::Between(at) => {
                Cost::from_bits(metric.estimate(Place::of(from).to(at)).to_bits() >> Place::PLACES)
            }
        }
    }
}

/// Sub-A*(k) of Hormazábal, Díaz, Hernández & Baier 2017: optimal paths over N(k), or at any angle, on a
/// subgoal graph.
///
/// If an optimal path of the empty grid is free, it is the answer, without a search. Otherwise start and goal
/// are joined to subgoals by edges, and two A* searches go up the hierarchy: one from the start, which also
/// goes through the core, and one from the goal. The one with the smaller f continues, until neither has an f
/// below the cost of the best path found, over a subgoal that both have reached. Scratch memory: 64 bytes a
/// subgoal.
///
/// `S` and `I` are how the planner holds the free space and its subgoal graph: by reference or by `Arc`.
///
/// **Ties.** The open lists order nodes by f, h and the subgoal's number. Between the two searches the one
/// from the start goes first, and of equally good meeting points the first found is kept. So the path and the
/// counts are the same each time and on every platform. An observer is told the events of both searches; a
/// subgoal that both reach has events of each.
#[derive(Debug)]
pub struct SubgoalAStar<S, I, P: SubgoalPlacement> {
    space: S,
    graph: I,
    scratch: P::Scratch,
    /// The searches from the start and from the goal.
    searches: [SearchTree<ParentEdge>; 2],
    /// The edges that join the start and the goal to subgoals.
    query_edges: [Vec<(u32, Cost)>; 2],
    /// Scratch memory for unpacking shortcuts.
    pending: Vec<PackedArc>,
    /// Scratch memory: the arcs from the meeting point back to the start.
    arcs: Vec<PackedArc>,
    waypoints: Vec<Vertex>,
    query: Option<[QueryEnd; 2]>,
    /// Sight of ends that are no vertices.
    sight: Option<PointSight>,
    status: SearchStatus,
    /// Whether `waypoints` are a path that was found without a search.
    is_direct: bool,
    /// The cost of the best path found, and the subgoal at which the searches meet on it.
    best: (Cost, Option<u32>),
}

impl<P: SubgoalPlacement> SubgoalAStar<(), (), P> {
    /// The scratch memory that a planner on this graph takes when it is made, in bytes.
    #[must_use]
    pub fn scratch_bytes(graph: &SubgoalGraph<P>) -> usize {
        SearchTree::<ParentEdge>::bytes(graph.subgoals()).saturating_mul(2)
    }
}

impl<S, I, P> SubgoalAStar<S, I, P>
where
    P: SubgoalPlacement,
    S: Deref<Target: HasFreeSpace<Placement = P>>,
    I: Deref<Target = SubgoalGraph<P>>,
{
    /// A planner with scratch memory for `graph`, which must be that of `space`.
    ///
    /// # Errors
    /// [`Mismatch`] for the graph of another map or other rules than those of `space`, or, if that is a grid
    /// graph, of another k.
    pub fn new(space: S, graph: I) -> Result<Self, Mismatch> {
        graph.check(&*space)?;
        let count = graph.subgoals();
        Ok(Self {
            space,
            graph,
            scratch: P::Scratch::default(),
            searches: [SearchTree::new(count), SearchTree::new(count)],
            query_edges: [Vec::new(), Vec::new()],
            pending: Vec::new(),
            arcs: Vec::new(),
            waypoints: Vec::new(),
            query: None,
            sight: None,
            status: SearchStatus::default(),
            is_direct: false,
            best: (Cost::MAX, None),
        })
    }

    /// Continues in another space, on its subgoal graph. The search that was begun last is forgotten. The
    /// scratch memory is kept if it has room for the subgoals.
    ///
    /// # Errors
    /// As for [`new`](Self::new). Nothing is changed then.
    pub fn follow(&mut self, space: S, graph: I) -> Result<(), Mismatch> {
        graph.check(&*space)?;
        self.searches.iter_mut().for_each(|search| search.fit(graph.subgoals()));
        (self.query, self.sight) = (None, None);
        (self.status, self.is_direct) = (SearchStatus::default(), false);
        self.best = (Cost::MAX, None);
        (self.space, self.graph) = (space, graph);
        Ok(())
    }
}

impl<S, I, P> Planner for SubgoalAStar<S, I, P>
where
    P: SubgoalPlacement,
    S: Deref<Target: HasFreeSpace<Placement = P>>,
    I: Deref<Target = SubgoalGraph<P>>,
{
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        (self.query, self.status) = (None, SearchStatus::Unreachable);
        let space = self.space.free_space();
        if query.ids(space)?.is_none() {
            return Ok(self.status);
        }
        let Ends { start, goal, .. } = query;
        let ends = [start, goal];
        self.query = Some(ends.map(QueryEnd::Vertex));
        self.is_direct = if start == goal {
            self.waypoints.clear();
            self.waypoints.push(start);
            true
        } else {
            direct_path(space, self.graph.k, start, goal, &mut self.waypoints)
        };
        if self.is_direct {
            self.status = SearchStatus::Found;
            return Ok(self.status);
        }
        let Self { graph, scratch, query_edges, searches, .. } = self;
        for (at, edges) in ends.into_iter().zip(&mut *query_edges) {
            graph.query_edges(space, scratch, at, edges);
        }
        self.best = begin(graph, searches, query_edges, ends.map(QueryEnd::Vertex), observer);
        self.status = SearchStatus::Searching;
        Ok(self.status)
    }

    fn begin_at(
        &mut self,
        ends: PointEnds,
        observer: &mut impl Observer,
    ) -> Option<Result<SearchStatus, QueryError>> {
        let Self { space, graph, sight, query_edges, searches, .. } = self;
        let space = P::at_corners(space.free_space()).filter(|_| graph.k == K::Any)?;
        (self.query, self.status) = (None, SearchStatus::Unreachable);
        let places = match ends.places(space) {
            Ok(places) => places,
            Err(error) => return Some(Err(error)),
        };
        if !space.points_connected(ends.start, ends.goal) {
            return Some(Ok(self.status));
        }
        let query = places.map(QueryEnd::new);
        self.query = Some(query);
        self.is_direct = sees_between(space, ends, places);
        if self.is_direct {
            self.status = SearchStatus::Found;
            return Some(Ok(self.status));
        }
        let sight = sight.get_or_insert_with(|| PointSight::new(space, graph.subgoals.marks()));
        for ((place, end), edges) in places.into_iter().zip(query).zip(&mut *query_edges) {
            edges.clear();
            sight.seen_from(space, place, |at| {
                let id = graph.subgoals.id(at);
                edges.extend(id.map(|id| (id, end.estimate(graph.metric, at))));
            });
        }
        self.best = begin(graph, searches, query_edges, query, observer);
        self.status = SearchStatus::Searching;
        Some(Ok(self.status))
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if let (Some(query), SearchStatus::Searching) = (self.query, self.status) {
            self.status = self.search(query, observer);
        }
        Ok(self.status)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        self.path_to_point(at.into())
    }

    fn path_to_point(&mut self, at: Point) -> Option<Path> {
        let [start, goal] = self.query?;
        let (from, to) = (start.point(), goal.point());
        if from.vertex().is_some() && to.vertex().is_some() {
            return self.vertices_to(at.vertex()?, self.graph.k).map(Path::new);
        }
        if at == from {
            return Some(Path::through([from]));
        }
        if at == to && self.is_direct {
            return Some(Path::through([from, to]));
        }
        let mut points = vec![from];
        match self.best.1.filter(|_| at == to && !self.is_direct) {
            Some(meeting) => {
                self.visit(meeting, true, |_, at| points.push(at.into()));
                points.push(to);
            }
            None => {
                let id = self.graph.subgoals.id(at.vertex()?).filter(|_| !self.is_direct)?;
                self.searches[0].cost(id)?;
                self.visit(id, false, |_, at| points.push(at.into()));
            }
        }
        Some(Path::straightened(points))
    }

    /// Between subgoals along taut edges the path follows lines of sight. Where it is one of the empty grid,
    /// start and goal need not see each other; then it has no subgoals.
    fn bends_to(&mut self, at: Vertex) -> Option<Vec<Vertex>> {
        let query = self.query.filter(|_| self.graph.criterion == EdgeCriterion::Taut)?;
        let [QueryEnd::Vertex(start), QueryEnd::Vertex(goal)] = query else { return None };
        if at == goal && at != start && self.is_direct {
            let space = self.space.free_space();
            return leg_is_free(space, None, start, goal, None).then(|| vec![start, goal]);
        }
        self.vertices_to(at, K::Any)
    }

    fn guarantee(&self) -> Guarantee {
        match self.graph.k {
            K::Finite(k) => Guarantee::Optimal(k),
            K::Any => Guarantee::OptimalAnyAngle,
        }
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}

impl<S, I, P> SubgoalAStar<S, I, P>
where
    P: SubgoalPlacement,
    S: Deref<Target: HasFreeSpace<Placement = P>>,
    I: Deref<Target = SubgoalGraph<P>>,
{
    /// Finds the subgoal at which the searches from the start and from the goal meet on a shortest path, or
    /// pauses.
    fn search(&mut self, ends: [QueryEnd; 2], observer: &mut impl Observer) -> SearchStatus {
        let Self { space, graph, searches, best: result, .. } = self;
        let (graph, space) = (&**graph, space.free_space());
        let mut best = *result;
        let status = loop {
            let [forward, backward] = [0, 1].map(|side| searches[side].least_f().unwrap_or(Cost::MAX));
            let least = forward.min(backward);
            if least >= best.0 {
                break if best.1.is_some() { SearchStatus::Found } else { SearchStatus::Unreachable };
            }
            // Each search has expanded all its nodes of a lesser f, so no path is cheaper.
            if observer.pauses(least) {
                break SearchStatus::Searching;
            }
            let side = usize::from(backward < forward);
            let Some((f, id, g, swaps)) = searches[side].pop() else { break SearchStatus::Unreachable };
            observer.percolated(swaps);
            let at = graph.subgoals.vertex(id);
            let before = searches[side]
                .parent(id)
                .map_or(ends[side].floor(), |(parent, _)| graph.subgoals.vertex(parent));
            observer.expanded(NodeEvent { at, parent: Some(before), g, f });
            if side == 0 && !space.is_closed_gap(at) {
                observer.reached(at, g);
            }
            if side == 1 && graph.is_core(id) {
                continue;
            }
            let [forward, backward] = &mut *searches;
            let (this, other) = if side == 0 { (forward, backward) } else { (backward, forward) };
            let arrival = this.parent_edge(id).last.vector();
            let departures = arrival.and_then(|v| Some(BendRule::of_shortest(space, graph.k, at)?.after(v)));
            for arc in graph.up(id) {
                if let Some((departures, first)) = departures.zip(arc.first.vector())
                    && !departures.allows(first)
                {
                    continue;
                }
                let g = g + Cost::from_bits(arc.cost);
                if this.cost(arc.to).is_some_and(|known| known <= g) {
                    continue;
                }
                let h = ends[1 - side].estimate(graph.metric, graph.subgoals.vertex(arc.to));
                if g + h < best.0 {
                    let edge = ParentEdge { middle: arc.middle, last: arc.last };
                    let (is_first, swaps) = this.set_path_and_open(arc.to, g, h, id, edge);
                    observer.percolated(swaps);
                    let event =
                        NodeEvent { at: graph.subgoals.vertex(arc.to), parent: Some(at), g, f: g + h };
                    match is_first {
                        true => observer.generated(event),
                        false => observer.updated(event),
                    }
                    if let Some(rest) = other.cost(arc.to).filter(|&rest| g + rest < best.0) {
                        best = (g + rest, Some(arc.to));
                        if let QueryEnd::Vertex(goal) = ends[1] {
                            observer.reached(goal, best.0);
                        }
                    }
                }
            }
        };
        *result = best;
        status
    }

    /// The best path found to a vertex, over N(k) or by straight segments along the edges.
    fn vertices_to(&mut self, at: Vertex, k: K) -> Option<Vec<Vertex>> {
        let [QueryEnd::Vertex(start), QueryEnd::Vertex(goal)] = self.query? else { return None };
        if at == goal && self.is_direct {
            return Some(self.waypoints.clone());
        }
        if at == start {
            return Some(vec![start]);
        }
        match self.best.1.filter(|_| at == goal && !self.is_direct) {
            Some(meeting) => Some(self.path(start, meeting, Some(goal), k)),
            None => {
                let id = self.graph.subgoals.id(at).filter(|_| !self.is_direct)?;
                self.searches[0].cost(id)?;
                Some(self.path(start, id, None, k))
            }
        }
    }

    /// The path to a subgoal, and on to the goal if the searches meet there.
    fn path(&mut self, start: Vertex, meeting: u32, goal: Option<Vertex>, k: K) -> Vec<Vertex> {
        let mut waypoints = std::mem::take(&mut self.waypoints);
        waypoints.clear();
        waypoints.push(start);
        self.visit(meeting, goal.is_some(), |(space, graph), at| {
            extend(&mut waypoints, space, (k, graph.criterion), at);
        });
        if let Some(goal) = goal {
            extend(&mut waypoints, self.space.free_space(), (k, self.graph.criterion), goal);
        }
        self.waypoints = waypoints;
        self.waypoints.clone()
    }

    /// Visits the subgoals of the path to a subgoal, and those on to the goal if the searches meet there.
    fn visit(
        &mut self,
        meeting: u32,
        is_meeting: bool,
        mut visit: impl FnMut((&FreeSpace<P>, &SubgoalGraph<P>), Vertex),
    ) {
        let Self { space, graph, searches: [forward, backward], pending, arcs, .. } = self;
        let (space, graph) = (space.free_space(), &**graph);
        let mut to = |at: Vertex| visit((space, graph), at);
        arcs.clear();
        let mut at = meeting;
        while let Some((parent, ParentEdge { middle, .. })) = forward.parent(at) {
            arcs.push(PackedArc { from: parent, to: at, middle });
            at = parent;
        }
        to(graph.subgoals.vertex(at));
        while let Some(arc) = arcs.pop() {
            graph.unpack(arc, pending, &mut to);
        }
        let mut at = meeting;
        while let Some((parent, ParentEdge { middle, .. })) = backward.parent(at).filter(|_| is_meeting) {
            graph.unpack(PackedArc { from: at, to: parent, middle }, pending, &mut to);
            at = parent;
        }
    }
}

/// Puts the subgoals that start and goal are joined to on the open lists. Returns the best of those that are
/// joined to both, with the cost of the path over it.
fn begin<P: SubgoalPlacement>(
    graph: &SubgoalGraph<P>,
    searches: &mut [SearchTree<ParentEdge>; 2],
    query_edges: &[Vec<(u32, Cost)>; 2],
    ends: [QueryEnd; 2],
    observer: &mut impl Observer,
) -> (Cost, Option<u32>) {
    let mut best = (Cost::MAX, None);
    for (side, edges) in query_edges.iter().enumerate() {
        searches[side].start_search();
        for &(id, g) in edges {
            let at = graph.subgoals.vertex(id);
            let h = ends[1 - side].estimate(graph.metric, at);
            // From between vertices a path may go on in any way: one that is not taut is no shortest one.
            let last = match ends[side] {
                QueryEnd::Vertex(end) => Step::of(end.to(at)),
                QueryEnd::Between(_) => Step::default(),
            };
            let edge = ParentEdge { middle: NONE, last };
            let (_, swaps) = searches[side].set_path_and_open(id, g, h, NONE, edge);
            observer.percolated(swaps);
            observer.generated(NodeEvent { at, parent: Some(ends[side].floor()), g, f: g + h });
            if let Some(rest) = (side == 1).then(|| searches[0].cost(id)).flatten() {
                best = best.min((g + rest, Some(id)));
            }
        }
    }
    best
}
