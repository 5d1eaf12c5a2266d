//! A* on one level of the abstract graph.

use mediant_grid::Vertex;
use mediant_moves::Cost;
use mediant_search::{
    NodeEvent, Observer, SearchStatus,
    parts::{Part, SearchTree},
};

use super::{
    fixed_cost::FixedCost,
    level::{Bounds, Cluster, Level, Node},
};

/// The start or the goal of a search: its cluster, and the costs between it and each node of that cluster.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Endpoint<'c> {
    pub(crate) cluster: u32,
    pub(crate) costs: &'c [FixedCost],
}

/// The goal of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal<'c> {
    pub(crate) endpoint: Endpoint<'c>,
    /// The cost from the start to it within their cluster; none if they are in different ones.
    pub(crate) direct: FixedCost,
}

impl Level {
    /// The number of the start of a search, which need not be a node.
    pub(crate) fn start_id(&self) -> u32 {
        self.node_numbers()
    }

    /// The number of its goal.
    pub(crate) fn goal_id(&self) -> u32 {
        self.node_numbers() + 1
    }
}

/// Finds shortest paths through the abstract graph over nodes within `bounds`: to the goal, or to all nodes
/// if there is none. Returns whether the goal was reached.
///
/// One edge leads from a node to each other node of its cluster, so that no path needs two such edges in a
/// row. The open list therefore holds only nodes entered from another cluster. The expansion of such a node
/// gives the other nodes of its cluster their costs, and crosses the border from each of them at once.
pub(crate) fn search(
    level: &Level,
    bounds: Bounds,
    tree: &mut SearchTree,
    estimate: impl Fn(Vertex) -> Cost,
    start: Endpoint<'_>,
    goal: Option<Goal<'_>>,
    observer: &mut impl Observer,
) -> bool {
    let mut search = HpaSearch { level, bounds, tree, estimate, observer: &mut Part::new(observer) };
    search.begin(start, goal);
    search.run(goal) == SearchStatus::Found
}

/// A search on the nodes of one level, within bounds.
pub(crate) struct HpaSearch<'s, E, O> {
    pub(crate) level: &'s Level,
    pub(crate) bounds: Bounds,
    pub(crate) tree: &'s mut SearchTree,
    pub(crate) estimate: E,
    pub(crate) observer: &'s mut O,
}

impl<E: Fn(Vertex) -> Cost, O: Observer> HpaSearch<'_, E, O> {
    /// Forgets the last search, and generates the nodes around the start's cluster.
    pub(crate) fn begin(&mut self, start: Endpoint<'_>, goal: Option<Goal<'_>>) {
        let level = self.level;
        self.tree.start_search();
        self.tree.set_path(level.start_id(), Cost::ZERO, SearchTree::<()>::NONE, ());
        self.cross_cluster(level.start_id(), (level.cluster(start.cluster), start.costs), Cost::ZERO);
        if let Some(cost) = goal.and_then(|goal| goal.direct.cost()) {
            self.tree.set_path_and_open(level.goal_id(), cost, Cost::ZERO, level.start_id(), ());
        }
    }

    /// Expands nodes until the goal is the best open node, none is open, or the observer pauses.
    pub(crate) fn run(&mut self, goal: Option<Goal<'_>>) -> SearchStatus {
        let level = self.level;
        loop {
            if let Some((f, _)) = self.tree.best().filter(|&(_, id)| id != level.goal_id())
                && self.observer.pauses(f)
            {
                return SearchStatus::Searching;
            }
            let Some((f, id, g, swaps)) = self.tree.pop() else { return SearchStatus::Unreachable };
            self.observer.percolated(swaps);
            if id == level.goal_id() {
                return SearchStatus::Found;
            }
            let node = level.node(id);
            let parent = self.tree.parent(id).map(|(parent, ())| level.node(parent).at());
            self.observer.expanded(NodeEvent { at: node.at(), parent, g, f });
            self.observer.reached(node.at(), g);
            let cluster = level.cluster(node.cluster);
            self.cross_cluster(id, (cluster, cluster.costs_from(id)), g);
            self.cross_border(id, node, g);
            if let Some(Goal { endpoint, .. }) = goal.filter(|goal| goal.endpoint.cluster == node.cluster) {
                let index = (id - cluster.first) as usize;
                if let Some(rest) = endpoint.costs[index].cost()
                    && self.tree.cost(level.goal_id()).is_none_or(|known| g + rest < known)
                {
                    let (goal, cost) = (level.goal_id(), g + rest);
                    let (_, swaps) = self.tree.set_path_and_open(goal, cost, Cost::ZERO, id, ());
                    self.observer.percolated(swaps);
                }
            }
        }
    }

    /// Gives the other nodes of a node's cluster their costs, and crosses the border from each that became
    /// cheaper.
    #[inline]
    fn cross_cluster(&mut self, id: u32, (cluster, costs): (&Cluster, &[FixedCost]), g: Cost) {
        for ((node, cost), other) in self.level.nodes_in(cluster).iter().zip(costs).zip(cluster.first..) {
            let Some(cost) = cost.cost() else { continue };
            let g = g + cost;
            if self.tree.cost(other).is_none_or(|known| g < known) {
                self.tree.set_path(other, g, id, ());
                self.cross_border(other, node, g);
            }
        }
    }

    /// Generates the nodes across the border from a node.
    #[inline]
    fn cross_border(&mut self, id: u32, from: &Node, g: Cost) {
        const STEP: Cost = Cost::from_bits(1 << Cost::FRACTION_BITS);
        let g = g + STEP;
        for other in from.across() {
            if self.tree.cost(other).is_none_or(|known| g < known) {
                self.enter(other, id, from.at(), g);
            }
        }
    }

    /// Gives a node within the bounds a cheaper path, and opens it.
    ///
    /// Most steps across a border make nothing cheaper. They are found out where they are taken, without what
    /// a call of this sets up.
    #[inline(never)]
    fn enter(&mut self, id: u32, parent: u32, from: Vertex, g: Cost) {
        let at = self.level.node(id).at();
        if !self.bounds.contains(at) {
            return;
        }
        let h = (self.estimate)(at);
        let (is_first, swaps) = self.tree.set_path_and_open(id, g, h, parent, ());
        self.observer.percolated(swaps);
        let event = NodeEvent { at, parent: Some(from), g, f: g + h };
        if is_first {
            self.observer.generated(event);
        } else {
            self.observer.updated(event);
        }
    }
}
