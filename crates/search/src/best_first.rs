//! The search loop that all grid graph engines share.

use std::ops::Deref;

use mediant_grid::{GridGraph, Placement, Vertex, VertexId};
use mediant_moves::Cost;

use crate::{
    Entry, ExpandedNode, Guarantee, Heuristic, Node, NodeEvent, NodeStore, Observer, OpenList, Outcome,
    ParentPointer, Path, Planner, Query, QueryError, Successor, Successors, path::extend_back,
};

/// Best-first search on a grid graph: takes the node of least f = g + h from the open list until that is the goal.
///
/// What a node's successors are is `S`'s to say. A cheaper path to a closed node reopens it, so a search with all successors is
/// optimal with every heuristic that never overestimates, consistent or not. With one that does overestimate it would cost much and promise nothing: then closed nodes stay
/// closed, unless how a node was reached decides where it leads, so that a path might be missed.
///
/// `L` is how the planner holds its grid graph: by reference, or, where both belong in one struct, by `Arc`. `N` is what a node keeps of its
/// parent.
#[derive(Clone, Debug)]
pub struct BestFirst<L, H, S, N = ()> {
    pub(crate) graph: L,
    pub(crate) heuristic: H,
    pub(crate) successors: S,
    nodes: NodeStore<N>,
    open: OpenList,
}

impl<P, L, H, S, N> BestFirst<L, H, S, N>
where
    P: Placement,
    L: Deref<Target = GridGraph<P>>,
    H: Heuristic,
    S: Successors<P, ParentPointer = N>,
    N: ParentPointer,
{
    /// A planner with scratch memory for `graph`.
    pub(crate) fn with(graph: L, heuristic: H, successors: S) -> Self {
        let nodes = NodeStore::new(graph.vertex_count());
        Self { graph, heuristic, successors, nodes, open: OpenList::default() }
    }

    /// Makes the start the only node that is known.
    fn begin(&mut self, start: VertexId, goal_at: Vertex, observer: &mut impl Observer) {
        let Self { graph, heuristic, nodes, open, .. } = self;
        let at = graph.vertex(start);
        let h = heuristic.estimate(graph, at.to(goal_at));
        nodes.start_search();
        open.clear();
        nodes.set_path(start, Cost::ZERO, 0, N::to(start));
        observer.generated(NodeEvent { at, parent: None, g: Cost::ZERO, f: h });
        open.push(Entry::new(h, h, start), |id, slot| nodes.set_slot(id, slot));
    }

    /// Expands nodes until the goal is the best of them, or, without a goal, until there is none left. Whether it was found. Nodes through which no
    /// path costs at most `limit` are not expanded.
    pub(crate) fn search(
        &mut self,
        start: VertexId,
        goal: Option<VertexId>,
        limit: Cost,
        observer: &mut impl Observer,
    ) -> bool {
        // No move leads to a vertex outside the map.
        let goal_at = goal.map_or(Vertex::new(-1, -1), |goal| self.graph.vertex(goal));
        self.begin(start, goal_at, observer);
        let Self { graph, heuristic, successors, nodes, open } = self;
        let (graph, heuristic, successors): (&GridGraph<P>, &H, &S) = (graph, heuristic, successors);
        let reopens = H::ADMISSIBLE || S::DEPEND_ON_ARRIVAL || graph.has_closed_gaps();

        while let Some((entry, swaps)) = open.pop(|id, slot| nodes.set_slot(id, slot)) {
            observer.percolated(swaps);
            let id = entry.id();
            if Some(id) == goal {
                return true;
            }
            nodes.set_slot(id, Node::<N>::CLOSED);
            let Some(&node) = nodes.get(id) else { continue };
            let at = graph.vertex(id);
            if limit != Cost::MAX && node.g + graph.costs().distance(at.to(goal_at)) > limit {
                continue;
            }
            let by = (id != start).then(|| node.arrived_by());
            let parent = by.map(|by| node.pointer.parent(graph, graph.step(by), id, at).1);
            observer.expanded(NodeEvent { at, parent, g: node.g, f: entry.f() });

            let (nodes, open, watcher) = (&mut *nodes, &mut *open, &mut *observer);
            // It owns what it needs: a reference less to follow for each successor is a tenth of the time of A*.
            let relax = move |next: Successor| {
                let g = node.g + next.cost;
                let event = |f| NodeEvent { at: next.at, parent: Some(at), g, f };
                let estimate = || heuristic.estimate(graph, next.at.to(goal_at));
                match nodes.get(next.id) {
                    Some(known) if !reopens && known.slot == Node::<N>::CLOSED => {}
                    Some(known)
                        if known.g < g
                            || known.g == g && !successors.prefers(graph, next.by, known.arrived_by()) => {}
                    Some(&known) => {
                        let gain = known.g - g;
                        nodes.set_path(next.id, g, next.by, N::to(id));
                        let (f, swaps) = if known.slot == Node::<N>::CLOSED {
                            let h = estimate();
                            let entry = Entry::new(g + h, h, next.id);
                            (g + h, open.push(entry, |id, slot| nodes.set_slot(id, slot)))
                        } else {
                            let f = open.get(known.slot).map_or(g, |entry| entry.f() - gain);
                            (f, open.decrease(known.slot, gain, |id, slot| nodes.set_slot(id, slot)))
                        };
                        watcher.updated(event(f));
                        watcher.percolated(swaps);
                    }
                    None => {
                        let h = estimate();
                        nodes.set_path(next.id, g, next.by, N::to(id));
                        watcher.generated(event(g + h));
                        let entry = Entry::new(g + h, h, next.id);
                        watcher.percolated(open.push(entry, |id, slot| nodes.set_slot(id, slot)));
                    }
                }
            };
            let scanned = successors.for_each(graph, ExpandedNode { id, at, by }, goal_at, relax);
            observer.scanned(scanned);
        }
        false
    }
}

impl<L, H, S, N: ParentPointer> BestFirst<L, H, S, N> {
    /// Adds the best known path to a goal after a search, but for its start.
    pub(crate) fn extend_back<P: Placement>(
        &self,
        start: VertexId,
        goal: VertexId,
        waypoints: &mut Vec<Vertex>,
    ) where
        L: Deref<Target = GridGraph<P>>,
    {
        extend_back(&self.graph, &self.nodes, start, goal, waypoints);
    }

    /// The cost of the best known path to a vertex after a search.
    pub(crate) fn cost_to(&self, id: VertexId) -> Option<Cost> {
        self.nodes.get(id).map(|node| node.g)
    }

    /// The move by which that path arrives.
    pub(crate) fn arrived_by(&self, id: VertexId) -> usize {
        self.nodes.get(id).map_or(0, Node::arrived_by)
    }
}

impl<P, L, H, S, N> Planner for BestFirst<L, H, S, N>
where
    P: Placement,
    L: Deref<Target = GridGraph<P>>,
    H: Heuristic,
    S: Successors<P, ParentPointer = N>,
    N: ParentPointer,
{
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        let Some((start, goal)) = query.ends(&self.graph)? else { return Ok(Outcome::Unreachable) };
        let mut found = self.search(start, Some(goal), Cost::MAX, observer);
        if !found && self.successors.begin_unpruned_retry() {
            found = self.search(start, Some(goal), Cost::MAX, observer);
            self.successors.end_unpruned_retry();
        }
        if !found {
            return Ok(Outcome::Unreachable);
        }
        Ok(Outcome::Found(Path::trace_back(&self.graph, &self.nodes, start, goal)))
    }

    fn guarantee(&self) -> Guarantee {
        if H::ADMISSIBLE { self.successors.guarantee(&self.graph) } else { Guarantee::Suboptimal }
    }
}
