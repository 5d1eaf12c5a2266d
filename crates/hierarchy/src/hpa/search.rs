//! A* on one level of the abstract graph.

use mediant_grid::Vertex;
use mediant_moves::Cost;
use mediant_search::{NodeEvent, Observer, SearchTree};

use super::level::{Bounds, Length, Level};

/// The start or the goal of a search: what it costs from there to each node of its cluster, and back.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End<'r> {
    pub(crate) cluster: u32,
    pub(crate) row: &'r [Length],
}

/// The goal, and what it costs from the start to it without leaving their cluster, if they share one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal<'r> {
    pub(crate) end: End<'r>,
    pub(crate) direct: Length,
}

impl Level {
    /// What stands for the start of a search in the place of a node.
    pub(crate) const fn start_id(&self) -> u32 {
        self.nodes.len() as u32
    }

    /// What stands for its goal.
    pub(crate) const fn goal_id(&self) -> u32 {
        self.nodes.len() as u32 + 1
    }
}

/// Finds shortest ways through the abstract graph, over nodes within `bounds`: to the goal, or without one to all of them. Whether the goal was found.
///
/// Within a cluster one step leads to wherever it can lead. So a node is expanded only when it was entered from another cluster, and what one can come to within
/// its cluster is left at once, by the transitions that are there.
pub(crate) fn search(
    level: &Level,
    bounds: Bounds,
    labels: &mut SearchTree,
    estimate: impl Fn(Vertex) -> Cost,
    start: End<'_>,
    goal: Option<Goal<'_>>,
    observer: &mut impl Observer,
) -> bool {
    labels.start_search();
    let mut search = Search { level, bounds, labels, estimate, observer };
    search.labels.note(level.start_id(), Cost::ZERO, SearchTree::<()>::NONE, ());
    search.cross(level.start_id(), start, Cost::ZERO);
    if let Some(cost) = goal.and_then(|goal| goal.direct.cost()) {
        search.labels.reach(level.goal_id(), cost, Cost::ZERO, level.start_id(), ());
    }
    while let Some((f, id, g, swaps)) = search.labels.pop() {
        search.observer.percolated(swaps);
        if id == level.goal_id() {
            return true;
        }
        let node = level.node(id);
        let parent = search.labels.parent(id).map(|(parent, ())| level.node(parent).at());
        search.observer.expanded(NodeEvent { at: node.at(), parent, g, f });
        search.cross(id, End { cluster: node.cluster, row: level.row(id) }, g);
        search.leave(id, node.at(), g);
        if let Some(Goal { end, .. }) = goal.filter(|goal| goal.end.cluster == node.cluster) {
            let local = (id - level.first(node.cluster)) as usize;
            if let Some(rest) = end.row[local].cost()
                && search.labels.cost(level.goal_id()).is_none_or(|known| g + rest < known)
            {
                let (_, swaps) = search.labels.reach(level.goal_id(), g + rest, Cost::ZERO, id, ());
                search.observer.percolated(swaps);
            }
        }
    }
    false
}

struct Search<'s, E, O> {
    level: &'s Level,
    bounds: Bounds,
    labels: &'s mut SearchTree,
    estimate: E,
    observer: &'s mut O,
}

impl<E: Fn(Vertex) -> Cost, O: Observer> Search<'_, E, O> {
    /// Goes from a node to the others of its cluster, and on from there.
    #[inline]
    fn cross(&mut self, id: u32, from: End<'_>, g: Cost) {
        let level = self.level;
        for ((node, length), other) in
            level.nodes_of(from.cluster).iter().zip(from.row).zip(level.first(from.cluster)..)
        {
            let Some(cost) = length.cost() else { continue };
            let g = g + cost;
            if self.labels.cost(other).is_none_or(|known| g < known) {
                self.labels.note(other, g, id, ());
                self.leave(other, node.at(), g);
            }
        }
    }

    /// Goes from a node to those across the border.
    #[inline]
    fn leave(&mut self, id: u32, from: Vertex, g: Cost) {
        const STEP: Cost = Cost::from_bits(1 << Cost::FRACTION_BITS);
        let level = self.level;
        for other in level.node(id).across() {
            let at = level.node(other).at();
            let g = g + STEP;
            if !self.bounds.contains(at) || self.labels.cost(other).is_some_and(|known| known <= g) {
                continue;
            }
            let h = (self.estimate)(at);
            let (is_first, swaps) = self.labels.reach(other, g, h, id, ());
            self.observer.percolated(swaps);
            let event = NodeEvent { at, parent: Some(from), g, f: g + h };
            if is_first {
                self.observer.generated(event);
            } else {
                self.observer.updated(event);
            }
        }
    }
}
