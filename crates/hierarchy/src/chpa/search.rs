//! Phase 1 of CHPA*: A* over segments.

use std::iter::successors;

use mediant_grid::{Centers, GridGraph};
use mediant_moves::Cost;
use mediant_search::{Ends, Heuristic, NodeEvent, Observer, SearchStatus, parts::SearchTree};

use super::segments::SegmentGraph;

/// The search over segments. Costs and the heuristic count in segments.
pub(crate) struct SegmentSearch<'s, H, O> {
    pub(crate) grid_graph: &'s GridGraph<Centers>,
    pub(crate) graph: &'s SegmentGraph,
    pub(crate) heuristic: H,
    pub(crate) tree: &'s mut SearchTree,
    pub(crate) query: Ends,
    pub(crate) observer: &'s mut O,
}

impl<H: Heuristic, O: Observer> SegmentSearch<'_, H, O> {
    /// Makes the start's segment the only one that is known.
    pub(crate) fn begin(&mut self) {
        let start = self.graph.segment_at(self.query.start);
        let goal_at = self.graph.position(self.graph.segment_at(self.query.goal));
        let h = self.heuristic.estimate(self.grid_graph, self.graph.position(start).to(goal_at));
        self.tree.start_search();
        self.tree.set_path_and_open(start, Cost::ZERO, h, SearchTree::<()>::NONE, ());
        let at = self.graph.center(start);
        self.observer.generated(NodeEvent { at, parent: None, g: Cost::ZERO, f: h });
    }

    /// Expands segments until the goal's is the best open one, none is open, or the observer pauses.
    pub(crate) fn run(&mut self) -> SearchStatus {
        let Self { grid_graph, graph, heuristic, tree, observer, .. } = self;
        let goal = graph.segment_at(self.query.goal);
        let goal_at = graph.position(goal);
        loop {
            // Costs in segments say nothing of the cost of a path.
            if tree.best().is_some_and(|(_, id)| id != goal) && observer.pauses(Cost::ZERO) {
                return SearchStatus::Searching;
            }
            let Some((f, id, g, swaps)) = tree.pop() else { return SearchStatus::Unreachable };
            observer.percolated(swaps);
            if id == goal {
                return SearchStatus::Found;
            }
            let parent = tree.parent(id).map(|(parent, ())| graph.center(parent));
            observer.expanded(NodeEvent { at: graph.center(id), parent, g, f });
            graph.for_each_neighbor(id, |to, d| {
                let g = g + grid_graph.costs().distance(d);
                // An inadmissible heuristic does not reopen closed segments.
                let stays_closed = !H::ADMISSIBLE && tree.is_closed(to);
                if stays_closed || tree.cost(to).is_some_and(|known| known <= g) {
                    return;
                }
                let h = heuristic.estimate(grid_graph, graph.position(to).to(goal_at));
                let (is_first, swaps) = tree.set_path_and_open(to, g, h, id, ());
                observer.percolated(swaps);
                let event = NodeEvent { at: graph.center(to), parent: Some(graph.center(id)), g, f: g + h };
                if is_first { observer.generated(event) } else { observer.updated(event) }
            });
        }
    }

    /// Writes the path over segments that was found.
    pub(crate) fn path(&self, path: &mut Vec<u32>) {
        let goal = self.graph.segment_at(self.query.goal);
        let tree = &*self.tree;
        path.clear();
        path.push(goal);
        path.extend(successors(tree.parent(goal), |&(id, ())| tree.parent(id)).map(|(id, ())| id));
        path.reverse();
    }
}
