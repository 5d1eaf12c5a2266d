//! Watching a search: counters and traces are observers. The observer that does nothing costs nothing.

use mediant_grid::Vertex;
use mediant_moves::Cost;

/// A search node at the time of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeEvent {
    /// Its vertex.
    pub at: Vertex,
    /// The vertex of its parent; `None` for the start.
    pub parent: Option<Vertex>,
    /// The cost of the best known path to it.
    pub g: Cost,
    /// That cost plus the estimate of the heuristic.
    pub f: Cost,
}

/// Is told what a search does. All methods default to no-ops.
///
/// Its type is known at compile time; where it must not be, `&mut dyn Observer` is an observer too:
///
/// ```
/// # use std::sync::Arc;
/// # use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph};
/// # use mediant_moves::FiniteK;
/// use mediant_search::{AStar, Counters, Ends, Hk, Observer, Planner};
///
/// # let map = AsciiMap::parse("...\n...\n")?;
/// # let graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::new(3)?, CornerRule::Never)?;
/// let mut counters = Counters::default();
/// let mut observer: &mut dyn Observer = &mut counters;
/// AStar::new(&graph, Hk).solve_observed(Ends::new((0, 0), (2, 1)), &mut observer)?;
/// assert_eq!(counters.expanded, 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Observer {
    /// A node was taken from the open list, and its successors are about to be generated.
    #[inline]
    fn expanded(&mut self, node: NodeEvent) {
        let _ = node;
    }

    /// A node entered the open list for the first time in this search. The start counts.
    #[inline]
    fn generated(&mut self, node: NodeEvent) {
        let _ = node;
    }

    /// A cheaper path to a node was found.
    #[inline]
    fn updated(&mut self, node: NodeEvent) {
        let _ = node;
    }

    /// The open list's heap swapped this many pairs while sifting an entry up or down ('Perc' of Rivera
    /// 2017).
    #[inline]
    fn percolated(&mut self, swaps: u32) {
        let _ = swaps;
    }

    /// Whether it is to be told of [swaps](Self::percolated) in the open list's heap: a search need not keep
    /// all open nodes in a heap otherwise. The answer is always the same.
    #[inline]
    fn counts_swaps(&self) -> bool {
        true
    }

    /// A hierarchical search left its plan, which led nowhere or only by a detour.
    #[inline]
    fn fell_back(&mut self) {}

    /// While a jump point search expanded a node, it looked at this many vertices in its jumps.
    #[inline]
    fn scanned(&mut self, vertices: u32) {
        let _ = vertices;
    }

    /// A path from the start to this vertex is known now, of cost `g`, and
    /// [`Planner::path_to`](crate::Planner::path_to) gives it. For most engines these are the expanded nodes.
    /// Told only by [`Planner::proceed`](crate::Planner::proceed).
    #[inline]
    fn reached(&mut self, at: Vertex, g: Cost) {
        let _ = (at, g);
    }

    /// Asked before each expansion but that of a goal: whether the search pauses here. `least` is the least f
    /// of the open nodes (with a heuristic that overestimates, the g of the best one). A search that is
    /// optimal finds no cheaper path any more. Asked only by
    /// [`Planner::proceed`](crate::Planner::proceed).
    #[inline]
    fn pauses(&mut self, least: Cost) -> bool {
        let _ = least;
        false
    }
}

/// The observer that does nothing.
impl Observer for () {
    #[inline]
    fn counts_swaps(&self) -> bool {
        false
    }
}

impl<O: Observer + ?Sized> Observer for &mut O {
    #[inline]
    fn expanded(&mut self, node: NodeEvent) {
        (**self).expanded(node);
    }

    #[inline]
    fn generated(&mut self, node: NodeEvent) {
        (**self).generated(node);
    }

    #[inline]
    fn updated(&mut self, node: NodeEvent) {
        (**self).updated(node);
    }

    #[inline]
    fn percolated(&mut self, swaps: u32) {
        (**self).percolated(swaps);
    }

    #[inline]
    fn scanned(&mut self, vertices: u32) {
        (**self).scanned(vertices);
    }

    #[inline]
    fn counts_swaps(&self) -> bool {
        (**self).counts_swaps()
    }

    #[inline]
    fn fell_back(&mut self) {
        (**self).fell_back();
    }

    #[inline]
    fn reached(&mut self, at: Vertex, g: Cost) {
        (**self).reached(at, g);
    }

    #[inline]
    fn pauses(&mut self, least: Cost) -> bool {
        (**self).pauses(least)
    }
}

/// The observer of a part of a search, or of a whole one: it is told the events, but not what is reached,
/// since what a part knows is a path of its own.
#[derive(Debug)]
pub struct Part<'o, O> {
    observer: &'o mut O,
    least: Option<Cost>,
}

impl<'o, O> Part<'o, O> {
    /// Of a part that runs to its end: the observer is not asked to pause.
    pub const fn new(observer: &'o mut O) -> Self {
        Self { observer, least: None }
    }

    /// Of a part that the observer may pause. Whatever the part knows, no path of the whole search is cheaper
    /// than `least`.
    pub const fn pausing(observer: &'o mut O, least: Cost) -> Self {
        Self { observer, least: Some(least) }
    }
}

impl<O: Observer> Observer for Part<'_, O> {
    #[inline]
    fn expanded(&mut self, node: NodeEvent) {
        self.observer.expanded(node);
    }

    #[inline]
    fn generated(&mut self, node: NodeEvent) {
        self.observer.generated(node);
    }

    #[inline]
    fn updated(&mut self, node: NodeEvent) {
        self.observer.updated(node);
    }

    #[inline]
    fn percolated(&mut self, swaps: u32) {
        self.observer.percolated(swaps);
    }

    #[inline]
    fn scanned(&mut self, vertices: u32) {
        self.observer.scanned(vertices);
    }

    #[inline]
    fn counts_swaps(&self) -> bool {
        self.observer.counts_swaps()
    }

    #[inline]
    fn fell_back(&mut self) {
        self.observer.fell_back();
    }

    #[inline]
    fn pauses(&mut self, _: Cost) -> bool {
        self.least.is_some_and(|least| self.observer.pauses(least))
    }
}

/// Counts the events that the tables of the papers report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Nodes taken from the open list and expanded; the goal, at which a search stops, is not counted.
    pub expanded: u64,
    /// Nodes that entered the open list for the first time.
    pub generated: u64,
    /// Cheaper paths found to known nodes.
    pub updated: u64,
    /// Swaps in the open list's heap.
    pub percolations: u64,
    /// Vertices that jump point searches looked at in their jumps.
    pub scanned: u64,
    /// How often hierarchical searches left their plan.
    pub fallbacks: u64,
}

impl Observer for Counters {
    #[inline]
    fn expanded(&mut self, _: NodeEvent) {
        self.expanded += 1;
    }

    #[inline]
    fn generated(&mut self, _: NodeEvent) {
        self.generated += 1;
    }

    #[inline]
    fn updated(&mut self, _: NodeEvent) {
        self.updated += 1;
    }

    #[inline]
    fn percolated(&mut self, swaps: u32) {
        self.percolations += u64::from(swaps);
    }

    #[inline]
    fn scanned(&mut self, vertices: u32) {
        self.scanned += u64::from(vertices);
    }

    #[inline]
    fn fell_back(&mut self) {
        self.fallbacks += 1;
    }
}
