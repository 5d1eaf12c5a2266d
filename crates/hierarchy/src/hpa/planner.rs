//! Answering queries on a [`ClusterGraph`].

use std::ops::{Deref, DerefMut};

use mediant_grid::{Centers, GridGraph, Rectangle, Vertex};
use mediant_moves::Cost;
use mediant_search::{Guarantee, Observer, Outcome, Path, Planner, Query, QueryError, SearchTree};

use super::{
    graph::{ClusterGraph, window_of},
    level::{Bounds, Length, Level, Node},
    search::{End, Goal, search},
};
use crate::{
    HierarchyError, check,
    straighten::{Straighten, free, waypoints},
    window::{Local, MAX_SIDE, insert},
};

/// HPA* (Botea, Müller & Schaeffer 2004, 'Near Optimal Hierarchical Path-Finding'), with one or more levels.
///
/// A query goes through what the paper has as Sections 3.3 to 3.5: start and goal are *inserted*, by what it costs from them to the nodes of their clusters; A* finds a way through
/// the highest level on which they lie in different clusters; it is *refined* level by level, down to cells; and *smoothed* ([`with_straightening`](Self::with_straightening)).
/// Where the paper's smoothing joins vertices on one straight line, this one joins them by what is shortest over N(k) on an empty grid, so that paths stay paths over N(k).
///
/// `L` and `G` are how the planner holds the grid graph and its index: by reference or `Arc`; a planner that holds its index in a `Box` can [repair](Self::repair) it.
///
/// **Ties** are decided by the open lists' order (f, h, the number of node or cell); the same path and counts each time, on every platform. Events are those of all searches, on
/// every level and within clusters; percolations those of the former. Scratch memory: 24 bytes for each number that a node may have (20 a cluster of 10 × 10 cells).
#[derive(Clone, Debug)]
pub struct HpaStar<L, G> {
    grid_graph: L,
    graph: G,
    straightens: bool,
    labels: SearchTree,
    local: Local,
    /// What it costs from the start, and to the goal, from each node of its cluster, level by level.
    rows: [Vec<Vec<Length>>; 2],
    /// The way through the graph: where it goes, and the nodes there.
    chain: Vec<Stop>,
    finer: Vec<Stop>,
    cells: Vec<Vertex>,
    straighten: Straighten,
}

/// A place on the way through a level.
#[derive(Clone, Copy, Debug)]
struct Stop {
    at: Vertex,
    /// The node, or what stands for the start or the goal.
    id: u32,
}

impl<L, G> HpaStar<L, G>
where
    L: Deref<Target = GridGraph<Centers>>,
    G: Deref<Target = ClusterGraph>,
{
    /// A planner with scratch memory for `graph`, which must be the index of `grid_graph`.
    ///
    /// # Errors
    /// [`HierarchyError`] when it is that of a map of another size or of other moves. That it is of this very map is not checked: with the index of another one a planner may give
    /// up ([`QueryError::GaveUp`]), but its paths are legal.
    pub fn new(grid_graph: L, graph: G) -> Result<Self, HierarchyError> {
        check::grid_graph(graph.k, graph.size, &grid_graph)?;
        let nodes = graph.levels.iter().map(|level| level.nodes.len()).max().unwrap_or(0);
        let rows = vec![Vec::new(); graph.levels.len()];
        Ok(Self {
            straightens: true,
            labels: SearchTree::new(nodes + 2),
            local: Local::new(graph.k),
            rows: [rows.clone(), rows],
            chain: Vec::new(),
            finer: Vec::new(),
            cells: Vec::new(),
            straighten: Straighten::default(),
            grid_graph,
            graph,
        })
    }

    /// Whether paths are smoothed, as they are without this; else they are as refinement leaves them.
    #[must_use]
    pub fn with_straightening(self, straightens: bool) -> Self {
        Self { straightens, ..self }
    }
}

impl<L, G> HpaStar<L, G>
where
    L: Deref<Target = GridGraph<Centers>>,
    G: DerefMut<Target = ClusterGraph>,
{
    /// Goes on on a changed map: `grid_graph` differs from the one before only in the cells of a rectangle. Repairs the index, and keeps the scratch memory.
    ///
    /// # Errors
    /// [`HierarchyError`] for a grid graph of another size or other moves; nothing is changed then.
    pub fn repair(&mut self, grid_graph: L, changed: Rectangle) -> Result<(), HierarchyError> {
        check::grid_graph(self.graph.k, self.graph.size, &grid_graph)?;
        self.graph.repair(grid_graph.grid(), changed)?;
        self.grid_graph = grid_graph;
        Ok(())
    }
}

const STALE: QueryError =
    QueryError::GaveUp { why: "the index is not that of the map; repair it or make it anew" };

impl<L, G> Planner for HpaStar<L, G>
where
    L: Deref<Target = GridGraph<Centers>>,
    G: Deref<Target = ClusterGraph>,
{
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        if query.ends(&self.grid_graph)?.is_none() {
            return Ok(Outcome::Unreachable);
        }
        let Query { start, goal } = query;
        if start == goal {
            return Ok(Outcome::Found(Path::new(vec![start])));
        }
        // The furthest that smoothing can reach, looked at first.
        if self.straightens
            && let Some(elbow) = free(&self.grid_graph, start, goal)
        {
            let mut path = Vec::with_capacity(3);
            waypoints(&[start, elbow, goal], &mut path);
            return Ok(Outcome::Found(Path::new(path)));
        }
        let apart = |level: &Level| level.cluster_at(start) != level.cluster_at(goal);
        let top = self.graph.levels.iter().rposition(apart).unwrap_or(0);
        let direct = self.insert(query, top, observer);
        self.search(query, top, direct, observer).ok_or(STALE)?;
        for number in (0..top).rev() {
            self.refine(number, observer).ok_or(STALE)?;
        }
        self.walk(observer).ok_or(STALE)?;
        let path = if self.straightens {
            self.straighten.path(&self.grid_graph, &self.cells)
        } else {
            let mut path = Vec::with_capacity(self.cells.len());
            waypoints(&self.cells, &mut path);
            path
        };
        Ok(Outcome::Found(Path::new(path)))
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Suboptimal
    }
}

impl<L, G> HpaStar<L, G>
where
    L: Deref<Target = GridGraph<Centers>>,
    G: Deref<Target = ClusterGraph>,
{
    /// Finds what it costs from start and goal to the nodes of their clusters, on the levels up to `top`, and from the one to the other within a cluster of the lowest.
    fn insert(&mut self, query: Query, top: usize, observer: &mut impl Observer) -> Length {
        let direct = self.insert_lowest(0, query.start, Some(query.goal), observer);
        self.insert_lowest(1, query.goal, None, observer);
        let Self { grid_graph, graph, labels, rows, .. } = self;
        for number in 1..=top {
            let (below, level) = (&graph.levels[number - 1], &graph.levels[number]);
            for (rows, at) in rows.iter_mut().zip([query.start, query.goal]) {
                let (lower, upper) = rows.split_at_mut(number);
                let cluster = level.cluster_at(at);
                let bounds = level.bounds(cluster, grid_graph.grid());
                let end = End { cluster: below.cluster_at(at), row: &lower[number - 1] };
                search(below, bounds, labels, |_| Cost::ZERO, end, None, observer);
                let lengths = level.nodes_of(cluster).iter().map(|node| Length::of(labels.cost(node.below)));
                upper[0].clear();
                upper[0].extend(lengths);
            }
        }
        direct
    }

    /// Finds what it costs from an end to the nodes of its cluster on the lowest level, and to `other` if that is there too.
    fn insert_lowest(
        &mut self,
        side: usize,
        at: Vertex,
        other: Option<Vertex>,
        observer: &mut impl Observer,
    ) -> Length {
        let Self { grid_graph, graph, local, rows, .. } = self;
        let level = &graph.levels[0];
        let cluster = level.cluster_at(at);
        let bounds = level.bounds(cluster, grid_graph.grid());
        let other = other.filter(|&other| bounds.contains(other));
        let ends = level.nodes_of(cluster).iter().map(Node::at).chain(other);
        let row = &mut rows[side][0];
        row.clear();
        // Where nothing is in the way to any of them, there is nothing to search.
        let clear = |to: Vertex| free(grid_graph, at, to).map(|_| graph.costs.distance(at.to(to)));
        row.extend(ends.clone().map_while(clear).map(|cost| Length::of(Some(cost))));
        if row.len() < ends.clone().count() {
            let window = window_of(grid_graph.grid(), bounds);
            let cells = ends.map(|end| window.cell(end));
            let mut targets = [0; MAX_SIDE as usize];
            cells.clone().for_each(|cell| insert(&mut targets, cell));
            local.spread(&graph.costs, &window, window.cell(at), &targets, observer);
            row.clear();
            row.extend(cells.map(|cell| Length::of(local.cost(cell))));
        }
        other.and_then(|_| row.pop()).unwrap_or(Length::NONE)
    }

    /// Finds the way through the graph on level `top`.
    fn search(
        &mut self,
        query: Query,
        top: usize,
        direct: Length,
        observer: &mut impl Observer,
    ) -> Option<()> {
        let Self { graph, labels, rows, chain, .. } = self;
        let Query { start, goal } = query;
        let level = &graph.levels[top];
        let end = |side: usize, at: Vertex| End { cluster: level.cluster_at(at), row: &rows[side][top] };
        let to = Goal { end: end(1, goal), direct };
        let estimate = |at: Vertex| graph.costs.distance(at.to(goal));
        chain.clear();
        chain.push(Stop { at: start, id: level.start_id() });
        search(level, Bounds::ALL, labels, estimate, end(0, start), Some(to), observer)
            .then(|| trace(level, labels, goal, chain))
    }

    /// Replaces the way through a level by one through the level below it, `number`.
    fn refine(&mut self, number: usize, observer: &mut impl Observer) -> Option<()> {
        let Self { grid_graph, graph, labels, rows, chain, finer, .. } = self;
        let (below, level) = (&graph.levels[number], &graph.levels[number + 1]);
        // Where a stop is on the level below: what it costs from there to the nodes of its cluster, and which of these it is, if it is one.
        let end = |stop: Stop| {
            let cluster = below.cluster_at(stop.at);
            let node = (stop.id < level.start_id()).then(|| level.node(stop.id).below);
            let row = match node {
                Some(id) => below.row(id),
                None => &rows[usize::from(stop.id == level.goal_id())][number],
            };
            (End { cluster, row }, node.map(|id| (id - below.first(cluster)) as usize))
        };
        let finer_stop = |stop: Stop| match stop.id {
            id if id == level.start_id() => Stop { id: below.start_id(), ..stop },
            id if id == level.goal_id() => Stop { id: below.goal_id(), ..stop },
            id => Stop { id: level.node(id).below, ..stop },
        };
        finer.clear();
        finer.extend(chain.first().map(|&stop| finer_stop(stop)));
        for stops in chain.windows(2) {
            let [from, to] = [stops[0], stops[1]];
            let cluster = level.cluster_at(from.at);
            if cluster == level.cluster_at(to.at) {
                let ((start, start_node), (goal, goal_node)) = (end(from), end(to));
                // One of the two is a node, and what is known of the other holds both ways.
                let direct = match (start.cluster == goal.cluster, start_node, goal_node) {
                    (true, _, Some(node)) => start.row[node],
                    (true, Some(node), None) => goal.row[node],
                    _ => Length::NONE,
                };
                let bounds = level.bounds(cluster, grid_graph.grid());
                let estimate = |at: Vertex| graph.costs.distance(at.to(to.at));
                let goal = Goal { end: goal, direct };
                if !search(below, bounds, labels, estimate, start, Some(goal), observer) {
                    return None;
                }
                trace(below, labels, to.at, finer);
                finer.pop();
            }
            finer.push(finer_stop(to));
        }
        std::mem::swap(chain, finer);
        Some(())
    }

    /// Walks the way through the lowest level: straight where that is free, else cell by cell.
    fn walk(&mut self, observer: &mut impl Observer) -> Option<()> {
        let Self { grid_graph, graph, local, chain, cells, .. } = self;
        let (level, grid) = (&graph.levels[0], grid_graph.grid());
        cells.clear();
        cells.extend(chain.first().map(|stop| stop.at));
        for legs in chain.windows(2) {
            let [from, to] = [legs[0].at, legs[1].at];
            let cluster = level.cluster_at(from);
            if !grid_graph.is_free(to) {
                return None;
            }
            if cluster != level.cluster_at(to) {
                cells.push(to);
                continue;
            }
            if let Some(elbow) = free(grid_graph, from, to) {
                cells.extend([elbow, to]);
                continue;
            }
            // From the end, so that the parents lead there.
            let window = window_of(grid, level.bounds(cluster, grid));
            let [first, last] = [from, to].map(|at| window.cell(at));
            if !local.path(&graph.costs, &window, last, first, observer) {
                return None;
            }
            let mut cell = first;
            while cell != last {
                cell = local.parent(cell);
                cells.push(window.vertex(cell));
            }
        }
        Some(())
    }
}

/// Adds the stops after the start of the last search, up to its goal.
fn trace(level: &Level, labels: &SearchTree, goal: Vertex, stops: &mut Vec<Stop>) {
    let first = stops.len();
    stops.push(Stop { at: goal, id: level.goal_id() });
    let mut id = level.goal_id();
    while let Some((parent, ())) = labels.parent(id).filter(|&(parent, ())| parent != level.start_id()) {
        stops.push(Stop { at: level.node(parent).at(), id: parent });
        id = parent;
    }
    stops[first..].reverse();
}
