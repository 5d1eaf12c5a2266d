//! The search loop that all grid graph engines share.

use std::ops::Deref;

use mediant_grid::{GridGraph, Identity, Placement, Vertex, VertexId};
use mediant_moves::Cost;

use crate::{
    heuristic::Heuristic,
    nodes::{Node, NodeStore},
    observer::{NodeEvent, Observer},
    open_list::{Entry, OpenList},
    outcome::{Guarantee, Outcome},
    parent::ParentPointer,
    planner::Planner,
    query::{Query, QueryError},
    successors::{ExpandedNode, Successor, Successors},
    trace::{extend_back, trace_back},
};

/// Best-first search on a grid graph: takes the node of least f = g + h from the open list until that is the
/// goal.
///
/// `S` says what the [`Successors`] of a node are. A cheaper path to a closed node reopens it. So a search
/// with all legal moves is optimal with every admissible heuristic, consistent or not. Inadmissible
/// heuristics do not reopen nodes, which would be costly and would guarantee nothing, except where successors
/// depend on the arriving move: there a path might be missed.
///
/// `G` is how the planner holds its grid graph: by reference, or, where both belong in one struct, by `Arc`.
/// `N` is the [`ParentPointer`] of a node.
#[derive(Clone, Debug)]
pub struct BestFirst<G, H, S, N = ()> {
    pub(crate) graph: G,
    pub(crate) heuristic: H,
    pub(crate) successors: S,
    nodes: NodeStore<N>,
    open: OpenList,
}

impl<P, G, H, S, N> BestFirst<G, H, S, N>
where
    P: Placement,
    G: Deref<Target = GridGraph<P>>,
    H: Heuristic,
    S: Successors<P, ParentPointer = N>,
    N: ParentPointer,
{
    /// A planner with scratch memory for `graph`, which expands nodes by successors of your own.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph, Placement, Vertex};
    /// use mediant_moves::FiniteK;
    /// use mediant_search::{
    ///     Guarantee, Hk, Planner, Query,
    ///     parts::{AllMoves, BestFirst, ExpandedNode, Successor, Successors},
    /// };
    ///
    /// /// All legal moves that do not lead upwards.
    /// #[derive(Debug)]
    /// struct Downhill;
    ///
    /// impl<P: Placement> Successors<P> for Downhill {
    ///     type ParentPointer = ();
    ///
    ///     fn for_each(
    ///         &self,
    ///         graph: &GridGraph<P>,
    ///         node: ExpandedNode,
    ///         goal: Vertex,
    ///         mut visit: impl FnMut(Successor),
    ///     ) -> u32 {
    ///         AllMoves.for_each(graph, node, goal, |next| {
    ///             if next.at.y >= node.at.y {
    ///                 visit(next);
    ///             }
    ///         })
    ///     }
    ///
    ///     fn guarantee(&self, _: &GridGraph<P>) -> Guarantee {
    ///         Guarantee::Suboptimal
    ///     }
    /// }
    ///
    /// let map = AsciiMap::parse("
    ///     .....
    ///     .##..
    ///     ....#
    /// ")?;
    /// let graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::new(3)?, CornerRule::Never)?;
    /// let mut planner = BestFirst::with_successors(&graph, Hk, Downhill);
    /// assert!(planner.solve(Query::new((0, 0), (3, 2)))?.path().is_some());
    /// assert!(planner.solve(Query::new((3, 2), (0, 0)))?.path().is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_successors(graph: G, heuristic: H, successors: S) -> Self {
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

    /// Expands nodes until the goal is the best open node, or, without a goal, until none is open. Returns
    /// whether the goal was found. A node is not expanded when every path through it costs more than `limit`.
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
            // The closure owns what it needs: following one reference less for each successor saves a tenth
            // of the time of A*.
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

impl<G, H, S, N: ParentPointer> BestFirst<G, H, S, N> {
    /// After a search, adds the waypoints of the best known path to a goal, without its start.
    pub(crate) fn extend_back<P: Placement>(
        &self,
        start: VertexId,
        goal: VertexId,
        waypoints: &mut Vec<Vertex>,
    ) where
        G: Deref<Target = GridGraph<P>>,
    {
        extend_back(&self.graph, &self.nodes, start, goal, waypoints);
    }

    /// After a search, the cost of the best known path to a vertex.
    pub(crate) fn cost_to(&self, id: VertexId) -> Option<Cost> {
        self.nodes.get(id).map(|node| node.g)
    }

    /// The move by which that path arrives.
    pub(crate) fn arrived_by(&self, id: VertexId) -> usize {
        self.nodes.get(id).map_or(0, Node::arrived_by)
    }
}

impl<P, G, H, S, N> Planner for BestFirst<G, H, S, N>
where
    P: Placement,
    G: Deref<Target = GridGraph<P>>,
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
        Ok(Outcome::Found(trace_back(&self.graph, &self.nodes, start, goal)))
    }

    fn guarantee(&self) -> Guarantee {
        if H::ADMISSIBLE { self.successors.guarantee(&self.graph) } else { Guarantee::Suboptimal }
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}
