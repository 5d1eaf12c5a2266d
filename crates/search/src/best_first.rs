//! The search loop that all grid graph engines share.

use std::ops::Deref;

use mediant_grid::{GridGraph, Identity, Placement, Vertex, VertexId};
use mediant_moves::Cost;

use crate::{
    guarantee::Guarantee,
    heuristic::Heuristic,
    nodes::{Node, NodeStore},
    observer::{NodeEvent, Observer},
    open_front::OpenFront,
    open_list::{Entry, TOP},
    parent::ParentPointer,
    path::Path,
    planner::{Planner, SearchStatus},
    query::{Ends, QueryError},
    successors::{ExpandedNode, KnownPath, LookUp, Successor, Successors},
    trace_back::{extend_back, trace_back},
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
pub struct BestFirst<G, H, S, N: ParentPointer = ()> {
    pub(crate) graph: G,
    pub(crate) heuristic: H,
    pub(crate) successors: S,
    nodes: NodeStore<N>,
    open: OpenFront,
    starts: Vec<VertexId>,
    aim: Aim,
    status: SearchStatus,
}

/// Where a search leads, and how far.
#[derive(Clone, Copy, Debug)]
struct Aim {
    goal: VertexId,
    /// Vertices through which every path costs more are not expanded.
    limit: Cost,
    /// Whether it is the second search, without pruning.
    is_retry: bool,
}

impl Aim {
    const NONE: Self = Self { goal: VertexId(0), limit: Cost::MAX, is_retry: false };
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
    /// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph, Placement, Vertex, VertexId};
    /// use mediant_moves::FiniteK;
    /// use mediant_search::{
    ///     Ends, Guarantee, Hk, Planner,
    ///     parts::{AllMoves, BestFirst, ExpandedNode, KnownPath, Successor, Successors},
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
    ///         mut visit: impl FnMut(Successor) -> KnownPath,
    ///     ) -> u32 {
    ///         AllMoves.for_each(graph, node, goal, |next| {
    ///             if next.at.y >= node.at.y {
    ///                 visit(next)
    ///             } else {
    ///                 KnownPath::NONE
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
    /// assert!(planner.solve(Ends::new((0, 0), (3, 2)))?.path().is_some());
    /// assert!(planner.solve(Ends::new((3, 2), (0, 0)))?.path().is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_successors(graph: G, heuristic: H, successors: S) -> Self {
        let nodes = NodeStore::new(graph.vertex_count());
        let (open, starts) = (OpenFront::default(), Vec::new());
        let (aim, status) = (Aim::NONE, SearchStatus::default());
        Self { graph, heuristic, successors, nodes, open, starts, aim, status }
    }

    /// Continues with another grid graph, by successors that are those of it. The search that was begun last
    /// is forgotten. The scratch memory is kept if the grid graph has as many vertices.
    pub fn follow_with(&mut self, graph: G, successors: S) {
        self.successors = successors;
        self.follow_graph(graph);
    }

    /// Continues with another grid graph, whose successors are there.
    pub(crate) fn follow_graph(&mut self, graph: G) {
        self.end_retry();
        self.nodes.fit(graph.vertex_count());
        self.open.clear();
        self.starts.clear();
        (self.aim, self.status) = (Aim::NONE, SearchStatus::default());
        self.graph = graph;
    }

    /// Makes the starts the only nodes that are known.
    fn begin_at(&mut self, aim: Aim, observer: &mut impl Observer) {
        self.aim = aim;
        self.status = SearchStatus::Searching;
        let Self { graph, heuristic, successors, nodes, open, starts, .. } = self;
        let goal_at = graph.vertex(aim.goal);
        successors.begin(graph, goal_at);
        nodes.start_search();
        open.clear();
        for &start in &*starts {
            let at = graph.vertex(start);
            let h = heuristic.estimate(graph, at.to(goal_at));
            nodes.set_path(start, Cost::ZERO, 0, N::to(start));
            observer.generated(NodeEvent { at, parent: None, g: Cost::ZERO, f: h });
            open.heap.push(Entry::new(h, h, start), |id, slot| nodes.set_slot(id, slot));
        }
    }

    /// Makes a vertex the only start of the next search.
    fn set_start(&mut self, start: VertexId) {
        self.starts.clear();
        self.starts.push(start);
    }

    /// Turns the pruning on again, if it is off.
    fn end_retry(&mut self) {
        if std::mem::take(&mut self.aim.is_retry) {
            self.successors.end_unpruned_retry();
        }
    }

    /// Begins the search for a path that costs at most `limit`: vertices through which every path costs more
    /// are not expanded. [`proceed`](Planner::proceed) continues it.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    pub fn begin_within(
        &mut self,
        query: Ends,
        limit: Cost,
        observer: &mut impl Observer,
    ) -> Result<SearchStatus, QueryError> {
        self.end_retry();
        self.status = SearchStatus::Unreachable;
        if let Some((start, goal)) = query.ids(&self.graph)? {
            self.set_start(start);
            self.begin_at(Aim { goal, limit, is_retry: false }, observer);
        }
        Ok(self.status)
    }

    /// Expands nodes until the goal is the best open node, none is open, or the observer pauses.
    fn run(&mut self, observer: &mut impl Observer) -> SearchStatus {
        let Self { graph, heuristic, successors, nodes, open, aim, .. } = self;
        let (Aim { goal, limit, .. }, goal_at) = (*aim, graph.vertex(aim.goal));
        let (graph, successors): (&GridGraph<P>, &S) = (graph, successors);
        let (node, g) = (ExpandedNode { id: goal, at: goal_at, by: None }, Cost::ZERO);
        let mut search =
            Relaxing { graph, heuristic: *heuristic, successors, nodes, open, observer, goal_at, node, g };
        if search.keeps_heap() {
            search.open.gather(search.nodes);
        }
        loop {
            if let Some(best) = search.open.least()
                && best.id() != goal
                && search.observer.pauses(least::<H, N>(best, search.nodes))
            {
                return SearchStatus::Searching;
            }
            let Some(entry) = search.pop() else { return SearchStatus::Unreachable };
            let id = entry.id();
            if id == goal {
                return SearchStatus::Found;
            }
            let Some(node) = search.nodes.close(id) else { continue };
            let at = graph.vertex(id);
            if limit != Cost::MAX && node.g + graph.costs().distance(at.to(goal_at)) > limit {
                continue;
            }
            let by = arrival(graph, &node, entry, search.observer);
            let expanded = ExpandedNode { id, at, by };
            (search.node, search.g) = (expanded, node.g);
            // Another closure for what is looked up: it is called from one place, and compiled there.
            let known = successors.look_up(graph, expanded, goal_at, |next| search.relax(next));
            let mut visit = |next| search.relax(next);
            let scanned = match known {
                LookUp::Visited => 0,
                LookUp::Goal(goal) => {
                    visit(goal);
                    0
                }
                LookUp::Unknown => successors.for_each(graph, expanded, goal_at, visit),
            };
            search.observer.scanned(scanned);
        }
    }
}

/// A search while it expands nodes.
struct Relaxing<'s, P: Placement, H, S, N: ParentPointer, O> {
    graph: &'s GridGraph<P>,
    heuristic: H,
    successors: &'s S,
    nodes: &'s mut NodeStore<N>,
    open: &'s mut OpenFront,
    observer: &'s mut O,
    goal_at: Vertex,
    /// The node that is expanded, and the cost of the path to it.
    node: ExpandedNode,
    g: Cost,
}

impl<P, H, S, N, O> Relaxing<'_, P, H, S, N, O>
where
    P: Placement,
    H: Heuristic,
    S: Successors<P, ParentPointer = N>,
    N: ParentPointer,
    O: Observer,
{
    /// A* lowers many entries; jumps lower few.
    const TOP: usize = if N::IS_FOR_JUMPS { TOP } else { 0 };

    /// Whether all open nodes are in a heap.
    #[inline]
    fn keeps_heap(&self) -> bool {
        !N::IS_FOR_JUMPS || self.observer.counts_swaps()
    }

    /// Takes the best node from the open list.
    #[inline(always)]
    fn pop(&mut self) -> Option<Entry> {
        if !self.keeps_heap() {
            return self.open.pop(self.nodes);
        }
        let nodes = &mut *self.nodes;
        // With this in a function of its own, A* executes 4 % more instructions.
        let (entry, swaps) = self.open.heap.pop_loosely(Self::TOP, |id, slot| nodes.set_slot(id, slot))?;
        self.observer.percolated(swaps);
        Some(entry)
    }

    /// Makes a successor of the node known, or says which path to it is known.
    #[inline(always)]
    fn relax(&mut self, next: Successor) -> KnownPath {
        let keeps_heap = self.keeps_heap();
        let Self { graph, heuristic, successors, nodes, open, observer, goal_at, node, g } = self;
        let g = *g + next.cost;
        let event = |f| NodeEvent { at: next.at, parent: Some(node.at), g, f };
        let (place, known) = nodes.find(next.id);
        if let Some(known) = known {
            let is_closed = known.slot == Node::<N>::CLOSED;
            let reopens = H::ADMISSIBLE || S::DEPEND_ON_ARRIVAL || graph.has_closed_gaps();
            if !reopens && is_closed {
                return KnownPath::NONE;
            }
            let is_earlier =
                g < known.g || g == known.g && successors.prefers(graph, next.by, known.arrived_by());
            if !is_earlier {
                let parent = known.pointer.stored().filter(|_| known.arrived_by() == next.by);
                return KnownPath::new(g - known.g, parent);
            }
            if !is_closed {
                let gain = known.g - g;
                nodes.set_path_at((place, next.id), g, next.by, N::to(node.id));
                if !keeps_heap {
                    let f = open.decrease((next.id, known.slot), gain, nodes);
                    observer.updated(event(f.unwrap_or(g)));
                    return KnownPath::NONE;
                }
                let heap = &mut open.heap;
                let slot = heap.slot_of(Self::TOP, next.id, known.slot);
                observer.updated(event(heap.get(slot).map_or(g, |entry| entry.f() - gain)));
                observer.percolated(heap.decrease(slot, gain, |id, slot| nodes.set_slot(id, slot)));
                return KnownPath::NONE;
            }
        }
        let h = heuristic.estimate(graph, next.at.to(*goal_at));
        if known.is_some() {
            observer.updated(event(g + h));
        } else {
            observer.generated(event(g + h));
        }
        let (entry, path) = (Entry::new(g + h, h, next.id), (g, next.by, N::to(node.id)));
        let place = nodes.open_at((place, next.id), path);
        if !keeps_heap {
            open.push(entry, nodes);
            return KnownPath::NONE;
        }
        let (swaps, slot) = open.heap.push_loosely(Self::TOP, entry, |id, slot| nodes.set_slot(id, slot));
        nodes.set_slot_at(place, slot);
        observer.percolated(swaps);
        KnownPath::NONE
    }
}

/// By which move a node that is expanded was reached, after the observer was told of it.
#[inline]
fn arrival<P: Placement, N: ParentPointer>(
    graph: &GridGraph<P>,
    node: &Node<N>,
    entry: Entry,
    observer: &mut impl Observer,
) -> Option<usize> {
    let at = graph.vertex(entry.id());
    // Only a start costs nothing.
    let by = (node.g != Cost::ZERO).then(|| node.arrived_by());
    let step = by.and_then(|by| graph.steps().get(by));
    let parent = step.map(|step| node.pointer.parent(graph, step, entry.id(), at).1);
    observer.expanded(NodeEvent { at, parent, g: node.g, f: entry.f() });
    if !graph.is_closed_gap(at) {
        observer.reached(at, node.g);
    }
    by
}

/// The best open node's bound for an observer: its f, or its g where f is no bound.
fn least<H: Heuristic, N: ParentPointer>(best: Entry, nodes: &NodeStore<N>) -> Cost {
    if H::ADMISSIBLE { best.f() } else { nodes.get(best.id()).map_or(Cost::ZERO, |node| node.g) }
}

impl<G, H, S, N: ParentPointer> BestFirst<G, H, S, N> {
    /// Whether the search knows a path to a vertex.
    pub(crate) fn knows(&self, id: VertexId) -> bool {
        self.nodes.get(id).is_some()
    }

    /// After a search, adds the waypoints of the best known path to a goal, without its start.
    pub(crate) fn extend_back<P: Placement>(&self, goal: VertexId, waypoints: &mut Vec<Vertex>)
    where
        G: Deref<Target = GridGraph<P>>,
    {
        extend_back(&self.graph, &self.nodes, goal, waypoints);
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
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.begin_within(query, Cost::MAX, observer)
    }

    fn begin_from(
        &mut self,
        starts: &[Vertex],
        goal: Vertex,
        observer: &mut impl Observer,
    ) -> Option<SearchStatus> {
        self.end_retry();
        let goal = self.graph.id(goal)?;
        self.starts.clear();
        self.starts.extend(starts.iter().filter_map(|&start| self.graph.id(start)));
        self.starts.sort_unstable();
        self.starts.dedup();
        self.begin_at(Aim { goal, ..Aim::NONE }, observer);
        Some(self.status)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if self.status == SearchStatus::Searching {
            self.status = self.run(observer);
            let is_missed = self.status == SearchStatus::Unreachable && !self.aim.is_retry;
            if is_missed && self.successors.begin_unpruned_retry() {
                self.begin_at(Aim { is_retry: true, ..self.aim }, observer);
                self.status = self.run(observer);
            }
            if self.status != SearchStatus::Searching {
                self.end_retry();
            }
        }
        Ok(self.status)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        let has_begun = self.status != SearchStatus::Unreachable;
        let id = self.graph.id(at).filter(|&id| has_begun && self.knows(id))?;
        Some(trace_back(&self.graph, &self.nodes, id))
    }

    fn guarantee(&self) -> Guarantee {
        if H::ADMISSIBLE { self.successors.guarantee(&self.graph) } else { Guarantee::Suboptimal }
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}
