//! Phase 1 of CHPA*: A* over segments.

use std::iter::successors;

use mediant_grid::{Centers, GridGraph, Vertex};
use mediant_moves::Cost;
use mediant_search::{Heuristic, NodeEvent, Observer, Query, parts::SearchTree};

use super::segments::SegmentGraph;

/// Finds a path over segments from the start's to the goal's and writes it to `path`. Costs and the heuristic
/// count in segments. Returns whether there is one.
pub(crate) fn search<H: Heuristic>(
    grid_graph: &GridGraph<Centers>,
    graph: &SegmentGraph,
    heuristic: H,
    tree: &mut SearchTree,
    query: Query,
    path: &mut Vec<u32>,
    observer: &mut impl Observer,
) -> bool {
    let (start, goal) = (graph.segment_at(query.start), graph.segment_at(query.goal));
    let goal_at = graph.position(goal);
    let estimate = |at: Vertex| heuristic.estimate(grid_graph, at.to(goal_at));
    let h = estimate(graph.position(start));
    tree.start_search();
    tree.set_path_and_open(start, Cost::ZERO, h, SearchTree::<()>::NONE, ());
    observer.generated(NodeEvent { at: graph.center(start), parent: None, g: Cost::ZERO, f: h });
    while let Some((f, id, g, swaps)) = tree.pop() {
        observer.percolated(swaps);
        if id == goal {
            path.clear();
            path.push(goal);
            path.extend(successors(tree.parent(id), |&(id, ())| tree.parent(id)).map(|(id, ())| id));
            path.reverse();
            return true;
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
            let h = estimate(graph.position(to));
            let (is_first, swaps) = tree.set_path_and_open(to, g, h, id, ());
            observer.percolated(swaps);
            let event = NodeEvent { at: graph.center(to), parent: Some(graph.center(id)), g, f: g + h };
            if is_first { observer.generated(event) } else { observer.updated(event) }
        });
    }
    false
}
