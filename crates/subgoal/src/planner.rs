//! Answering queries on a subgoal graph.

use std::ops::Deref;

use mediant_grid::{FreeSpace, Placement, PlacementKind, Vertex};
use mediant_moves::{Cost, Decomposition, K, decompose};
use mediant_search::{
    Guarantee, HasFreeSpace, NodeEvent, Observer, Outcome, Path, Planner, Query, QueryError, SearchTree,
};

use crate::{
    SubgoalGraph, SubgoalPlacement,
    contract::NONE,
    graph::{ParentEdge, Step},
    placement::{BuildContext, EdgeKind, Edges},
    taut::Bend,
};

/// Sub-A*(k) of Hormazábal, Díaz, Hernández & Baier 2017: optimal paths over N(k), or at any angle, on a subgoal graph.
///
/// Where the way that is optimal on an empty grid is free, that is the path, and nothing is searched. Else start and goal are linked to subgoals, and two
/// A* searches go up the hierarchy, from the start, through the core, and from the goal; the one with the smaller f goes on, until both are at least what the best
/// meeting costs. Scratch memory: 64 bytes a subgoal.
///
/// **Ties** are decided by the open lists' order (f, h, the subgoal's number), between the two searches in favor of the start's, and between meetings by the first: the
/// same path and counts each time, on every platform. Events are those of both searches; of a subgoal that both come to, each tells.
#[derive(Debug)]
pub struct SubgoalAStar<T, G, P: SubgoalPlacement> {
    space: T,
    graph: G,
    scratch: P::Scratch,
    /// Up from the start, and up from the goal.
    sides: [SearchTree<ParentEdge>; 2],
    /// The links of the start and of the goal.
    links: [Vec<(u32, Cost)>; 2],
    ways: Vec<(u32, u32, u32)>,
    chain: Vec<(u32, u32, u32)>,
    waypoints: Vec<Vertex>,
}

impl<T, G, P> SubgoalAStar<T, G, P>
where
    P: SubgoalPlacement,
    T: Deref<Target: HasFreeSpace<Placement = P>>,
    G: Deref<Target = SubgoalGraph<P>>,
{
    /// A planner with scratch memory for `graph`, which must be that of `space`.
    #[must_use]
    pub fn new(space: T, graph: G) -> Self {
        let count = graph.subgoals();
        Self {
            space,
            graph,
            scratch: P::Scratch::default(),
            sides: [SearchTree::new(count), SearchTree::new(count)],
            links: [Vec::new(), Vec::new()],
            ways: Vec::new(),
            chain: Vec::new(),
            waypoints: Vec::new(),
        }
    }
}

impl<T, G, P> Planner for SubgoalAStar<T, G, P>
where
    P: SubgoalPlacement,
    T: Deref<Target: HasFreeSpace<Placement = P>>,
    G: Deref<Target = SubgoalGraph<P>>,
{
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        let space = self.space.free_space();
        if query.ends(space)?.is_none() {
            return Ok(Outcome::Unreachable);
        }
        let Query { start, goal } = query;
        if start == goal {
            return Ok(Outcome::Found(Path::new(vec![start])));
        }
        if let Some(path) = direct(space, self.graph.k, start, goal, &mut self.waypoints) {
            return Ok(Outcome::Found(path));
        }
        let Self { graph, scratch, links, .. } = self;
        for (at, links) in [start, goal].into_iter().zip(links) {
            graph.links_of(space, scratch, at, links);
        }
        let meeting = self.search([start, goal], observer);
        Ok(meeting.map_or(Outcome::Unreachable, |at| Outcome::Found(self.path(start, at, goal))))
    }

    fn guarantee(&self) -> Guarantee {
        match self.graph.k {
            K::Finite(k) => Guarantee::Optimal(k),
            K::Any => Guarantee::OptimalAnyAngle,
        }
    }
}

impl<P: SubgoalPlacement> SubgoalGraph<P> {
    /// Finds the links of a start or goal.
    pub(crate) fn links_of(
        &self,
        space: &FreeSpace<P>,
        scratch: &mut P::Scratch,
        at: Vertex,
        links: &mut Vec<(u32, Cost)>,
    ) {
        let Self { subgoals, norm, k, edges, .. } = self;
        links.clear();
        // A subgoal has its edges already, but only the taut ones where paths that begin or end there may take others.
        match subgoals.id(at).filter(|_| *edges == Edges::Direct) {
            Some(id) => links.push((id, Cost::ZERO)),
            None => {
                let map = BuildContext { space, subgoals, norm, k: *k, edges: *edges };
                P::links(map, scratch, at, EdgeKind::All, |id, cost| links.push((id, cost)));
            }
        }
    }
}

/// The path between two vertices where the way that is optimal on an empty grid is free.
fn direct<P: Placement>(
    space: &FreeSpace<P>,
    k: K,
    start: Vertex,
    goal: Vertex,
    waypoints: &mut Vec<Vertex>,
) -> Option<Path> {
    let straight = || leg(space, None, start, goal, None).then(|| Path::new(vec![start, goal]));
    let K::Finite(k) = k else { return straight() };
    let parts = decompose(start.to(goal), k)?;
    for elbow in elbows(start, parts) {
        if elbow == start || elbow == goal {
            return straight();
        }
        if bends_free(space, start, elbow, goal) {
            return Some(Path::new(vec![start, elbow, goal]));
        }
    }
    // At centers a line of sight may touch fewer cells than the moves along it.
    (P::KIND == PlacementKind::Corner && leg(space, None, start, goal, None)).then(|| {
        waypoints.clear();
        waypoints.push(start);
        along_line(waypoints, parts);
        Path::new(waypoints.clone())
    })
}

/// Whether the paths of an edge are free, in both directions.
pub(crate) fn is_free<P: Placement>(space: &FreeSpace<P>, k: K, from: Vertex, to: Vertex) -> bool {
    let parts = k.finite().and_then(|k| decompose(from.to(to), k));
    let elbows = parts.map_or([from; 2], |parts| elbows(from, parts));
    elbows.into_iter().all(|elbow| match () {
        () if elbow == from || elbow == to => leg(space, None, from, to, None),
        () => bends_free(space, from, elbow, to),
    })
}

fn bends_free<P: Placement>(space: &FreeSpace<P>, from: Vertex, elbow: Vertex, to: Vertex) -> bool {
    leg(space, None, from, elbow, Some(to)) && leg(space, Some(from), elbow, to, None)
}

fn leg<P: Placement>(
    space: &FreeSpace<P>,
    before: Option<Vertex>,
    from: Vertex,
    to: Vertex,
    after: Option<Vertex>,
) -> bool {
    space.may_turn(before, from, Some(to)) && space.may_turn(Some(from), to, after) && space.sees(from, to)
}

fn elbows(start: Vertex, parts: Decomposition) -> [Vertex; 2] {
    [(parts.v, parts.alpha), (parts.w, parts.beta)].map(|(v, times)| {
        let times = times as i32;
        start + mediant_grid::Vector::new(v.x * times, v.y * times)
    })
}

impl<T, G, P> SubgoalAStar<T, G, P>
where
    P: SubgoalPlacement,
    T: Deref<Target: HasFreeSpace<Placement = P>>,
    G: Deref<Target = SubgoalGraph<P>>,
{
    /// Finds the subgoal at which the shortest path over the graph goes down: two searches upward, from the start and from the goal, of which only
    /// the first goes through the core. Both are A*.
    fn search(&mut self, ends: [Vertex; 2], observer: &mut impl Observer) -> Option<u32> {
        let Self { space, graph, sides, links, .. } = self;
        let (graph, space) = (&**graph, space.free_space());
        let mut best = begin(graph, sides, links, ends, observer);
        loop {
            let [forward, backward] = [0, 1].map(|side| sides[side].least().unwrap_or(Cost::MAX));
            if forward.min(backward) >= best.0 {
                return best.1;
            }
            let side = usize::from(backward < forward);
            let (f, id, g, swaps) = sides[side].pop()?;
            observer.percolated(swaps);
            let at = graph.subgoals.vertex(id);
            let before =
                sides[side].parent(id).map_or(ends[side], |(parent, _)| graph.subgoals.vertex(parent));
            observer.expanded(NodeEvent { at, parent: Some(before), g, f });
            if side == 1 && graph.is_core(id) {
                continue;
            }
            let [forward, backward] = &mut *sides;
            let (this, other) = if side == 0 { (forward, backward) } else { (backward, forward) };
            let came = this.way(id).step.vector();
            let onward = came.and_then(|came| Some(Bend::of_shortest(space, graph.k, at)?.after(came)));
            for arc in graph.up(id) {
                if let Some((onward, goes)) = onward.zip(arc.first.vector())
                    && !onward.allows(goes)
                {
                    continue;
                }
                let g = g + Cost::from_bits(arc.cost);
                if this.cost(arc.to).is_some_and(|known| known <= g) {
                    continue;
                }
                let h = graph.norm.estimate(graph.subgoals.vertex(arc.to).to(ends[1 - side]));
                if g + h < best.0 {
                    let (is_first, swaps) =
                        this.reach(arc.to, g, h, id, ParentEdge { mid: arc.mid, step: arc.last });
                    observer.percolated(swaps);
                    let event =
                        NodeEvent { at: graph.subgoals.vertex(arc.to), parent: Some(at), g, f: g + h };
                    match is_first {
                        true => observer.generated(event),
                        false => observer.updated(event),
                    }
                    if let Some(rest) = other.cost(arc.to).filter(|&rest| g + rest < best.0) {
                        best = (g + rest, Some(arc.to));
                    }
                }
            }
        }
    }

    /// The path over a subgoal to which both searches came.
    fn path(&mut self, start: Vertex, meeting: u32, goal: Vertex) -> Path {
        let Self { space, graph, sides: [forward, backward], ways, chain, waypoints, .. } = self;
        let (space, graph) = (space.free_space(), &**graph);
        waypoints.clear();
        waypoints.push(start);
        let mut to = |at: Vertex| extend(waypoints, space, graph, at);
        chain.clear();
        let mut at = meeting;
        while let Some((parent, ParentEdge { mid, .. })) = forward.parent(at) {
            chain.push((parent, at, mid));
            at = parent;
        }
        to(graph.subgoals.vertex(at));
        while let Some(way) = chain.pop() {
            graph.unpack(way, ways, &mut to);
        }
        let mut at = meeting;
        while let Some((parent, ParentEdge { mid, .. })) = backward.parent(at) {
            graph.unpack((at, parent, mid), ways, &mut to);
            at = parent;
        }
        to(goal);
        Path::new(waypoints.clone())
    }
}

/// Puts the linked subgoals on both open lists. The best of those that are linked to both ends, and what it costs to go over it.
fn begin<P: SubgoalPlacement>(
    graph: &SubgoalGraph<P>,
    sides: &mut [SearchTree<ParentEdge>; 2],
    links: &[Vec<(u32, Cost)>; 2],
    ends: [Vertex; 2],
    observer: &mut impl Observer,
) -> (Cost, Option<u32>) {
    let mut best = (Cost::MAX, None);
    for (side, links) in links.iter().enumerate() {
        sides[side].start_search();
        for &(id, g) in links {
            let at = graph.subgoals.vertex(id);
            let h = graph.norm.estimate(at.to(ends[1 - side]));
            let (_, swaps) = sides[side].reach(
                id,
                g,
                h,
                NONE,
                ParentEdge { mid: NONE, step: Step::of(ends[side].to(at)) },
            );
            observer.percolated(swaps);
            observer.generated(NodeEvent { at, parent: Some(ends[side]), g, f: g + h });
            if let Some(rest) = (side == 1).then(|| sides[0].cost(id)).flatten() {
                best = best.min((g + rest, Some(id)));
            }
        }
    }
    best
}

/// Goes on to a vertex, along an edge or link.
fn extend<P: SubgoalPlacement>(
    waypoints: &mut Vec<Vertex>,
    space: &FreeSpace<P>,
    graph: &SubgoalGraph<P>,
    to: Vertex,
) {
    let Some(&from) = waypoints.last() else { return };
    if from == to {
        return;
    }
    let K::Finite(k) = graph.k else { return push(waypoints, to) };
    let Some(parts) = decompose(from.to(to), k) else { return };
    let [first, second] = elbows(from, parts);
    let elbow = match graph.edges {
        // All that is on an optimal path is free.
        Edges::Direct => Some(first),
        _ if first == from || first == to => Some(to),
        Edges::Taut => [first, second].into_iter().find(|&elbow| bends_free(space, from, elbow, to)),
    };
    if let Some(elbow) = elbow.filter(|&elbow| elbow != from) {
        push(waypoints, elbow);
    } else if elbow.is_none() {
        along_line(waypoints, parts);
    }
    if waypoints.last() != Some(&to) {
        push(waypoints, to);
    }
}

/// Follows a line of sight by the moves that sweep no more cells: the leaves of the decomposition tree (Kramm 2018, Lemma 13), which are the word of
/// Christoffel in v and w, so that the path keeps as close to the line as it can on one side.
fn along_line(waypoints: &mut Vec<Vertex>, parts: Decomposition) {
    let (alpha, beta) = (u64::from(parts.alpha), u64::from(parts.beta));
    let (mut a, mut b) = (0, 0);
    while let Some(&from) = waypoints.last().filter(|_| a + b < alpha + beta) {
        let is_below = (b + 1) * alpha <= a * beta;
        let step = if is_below { parts.w } else { parts.v };
        (a, b) = (a + u64::from(!is_below), b + u64::from(is_below));
        push(waypoints, from + step);
    }
}

/// Adds a waypoint, in the place of the last one if that is on a straight line.
pub(crate) fn push(waypoints: &mut Vec<Vertex>, to: Vertex) {
    if let [.., before, last] = waypoints[..] {
        let (v, w) = (before.to(last), last.to(to));
        if v.det(w) == 0 && v.dot(w) > 0 {
            waypoints.pop();
        }
    }
    waypoints.push(to);
}
