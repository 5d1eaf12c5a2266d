//! Canonical A*(k) (Rivera, Hernández & Baier 2017, 'Canonical Orderings for 2^k'): of all paths that differ only in the order of their
//! moves, and of all detours that a look at two moves reveals, a node passes on one.
//!
//! # The rule
//!
//! Rank the moves: even-indexed ones before odd-indexed ones, then by index. Of two different paths between the same vertices, the *earlier*
//! one is the cheaper one; of two that cost the same, the one whose last move has the lower rank, and if that is the same, the
//! one that is earlier without it. (Costs are integers, so 'the same' is well defined.)
//!
//! A node that was reached by move a, from vertex u, passes on move b **unless a legal path of displacement a + b leads
//! from u, that is earlier than a, b**. A path that is not better to a vertex which is already known replaces the known one only if it
//! costs the same and its last move has the lower rank; if the vertex is closed, it is then expanded again.
//!
//! # Why an optimal path always survives
//!
//! Let P be the earliest of all optimal paths from start to goal. 'Earlier' is a total order on the paths of one cost with the same
//! ends, and it compares from the end: so *every prefix of P is the earliest optimal path to its own end*, because an earlier one, put in
//! its place, would make P earlier.
//!
//! 1. No pair a, b of P is pruned: an earlier way around it, put in its place, would make a prefix of P cheaper or
//!    earlier.
//! 2. The last move of a prefix has the lowest rank among the last moves of *all* optimal paths to that vertex. So once the search has
//!    reached the vertex by the prefix, nothing replaces that; and if it was reached by another optimal path before, the prefix replaces
//!    it. No successor sets need to be united.
//! 3. By induction over P, each of its vertices is therefore, sooner or later, in the open list with its optimal cost and the move of
//!    P, and its expansion passes on P's next move. Until the goal is, some vertex of P is in the open list with f ≤ the optimal cost: so
//!    the goal is not taken from it at a greater one. ∎
//!
//! The proof leaves open *which* ways around are looked for: any choice is exact, and more ways prune more. Here they are the
//! single moves, the pairs, and the cheapest path on an empty grid in its plainest orders. On open ground, then, an odd move is followed by itself
//! and its two neighbors, an even move by itself alone: the uni- and bidimensional nodes of the paper, whose canonical paths take their odd
//! moves first. Everything else is a *turn*, and happens where an obstacle is in every way around.
//!
//! The paper instead keeps the jump points of the 8-neighborhood ([`PaperCanonical`]), which is complete but not optimal: with
//! (1, 1) blocked, k = 4, from (0, 0) to (3, 1), the optimal path turns at (1, 0), at which no arrival on the 8-neighborhood turns.
//!
//! # How it is looked up
//!
//! - k ≤ 3: a table over the pattern of cells around the vertex gives the successors of each incoming move (module `near`).
//! - 4 ≤ k ≤ 8: for each incoming move, a tree over its turns, tested with words of the map (module `tree`).
//!   From k = 7 on the tree only says whether there is a turn, and where there is one canonical A* takes all legal moves: that is
//!   faster than to find out which of them are turns, and just as exact.
//! - k ≥ 9: near corners nothing is pruned; trees would take hundreds of megabytes.
//!
//! For k ≥ 4 two bytes a vertex say how far the nearest obstacle is, and the nearest corner of one (module `clearance`): far from
//! corners, also along walls, there are no turns, and on open ground legality is not asked for either.
//!
//! # Closed gaps
//!
//! No path passes a gap, and one may only end there through one quadrant. Ways around ask for what keeps the vertices that they pass from
//! being gaps; a node whose predecessor is a gap (the start), or that is near a goal which is one, passes on everything. At
//! k = 2, where paths may pass gaps, nothing is pruned on a map with gaps.

mod alternatives;
mod cells;
mod clearance;
mod forced_cache;
mod forced_trees;
mod paper;
mod pattern_table;
#[cfg(test)]
mod tests;

use std::{ops::Deref, sync::Arc};

use mediant_grid::{Grid, GridGraph, Placement, Vertex};
use mediant_moves::{FiniteK, Neighborhood};

use crate::{BestFirst, ExpandedNode, Heuristic, Successor, Successors};

pub(crate) use alternatives::{MoveTable, Requirements, rank};
use clearance::{Clearance, VertexClearance};
use forced_cache::ForcedCache;
use forced_trees::ForcedTrees;
pub use paper::{PaperCanonical, PaperMoves};
use pattern_table::PatternTable;

/// The moves that follow move `a` on open ground, of `count` moves.
pub(crate) fn natural(a: usize, count: usize) -> impl Iterator<Item = usize> {
    let spread = a & 1;
    (count - spread..=count + spread).map(move |offset| (a + offset) % count)
}

/// Whether anything is pruned on a grid graph. If nothing is, ties need no rule; where paths may pass gaps they must not have one, since how
/// a path leaves a gap depends on how it came there.
#[inline]
pub(crate) fn prunes<P: Placement>(graph: &GridGraph<P>) -> bool {
    !graph.has_closed_gaps() || graph.k() != FiniteK::N4
}

/// The pruning rule of one placement, rule of motion and k, for any map. Immutable; share it.
#[derive(Clone, Debug)]
pub struct CanonicalRule<P: Placement> {
    k: FiniteK,
    rule: P::Rule,
    /// The largest coordinate of a move.
    radius: i32,
    /// The distance from corners at which turns end.
    corners: u32,
    lookup: ForcedLookup,
}

#[derive(Clone, Debug)]
enum ForcedLookup {
    Table(PatternTable),
    Trees(ForcedTrees),
    /// Near corners nothing is pruned.
    Unknown,
}

impl<P: Placement> CanonicalRule<P> {
    /// The largest k whose turns are tabulated.
    pub const MAX_TABULATED_K: u32 = 8;

    /// The rule for these, in time and memory that grow with 4^k: see [`bytes`](Self::memory_bytes).
    #[must_use]
    pub fn new(k: FiniteK, rule: P::Rule) -> Self {
        let radius = k.radius().unwrap_or(1 << 16).min(1 << 16);
        let lookup = match Neighborhood::new(k).ok().filter(|_| k.get() <= Self::MAX_TABULATED_K) {
            None => ForcedLookup::Unknown,
            Some(all) if k <= FiniteK::N8 => {
                ForcedLookup::Table(PatternTable::new(&MoveTable::<P>::new(rule, all)))
            }
            Some(all) => ForcedLookup::Trees(ForcedTrees::new(&MoveTable::<P>::new(rule, all))),
        };
        Self { k, rule, radius, corners: Clearance::needed_from_corners::<P>(radius), lookup }
    }

    /// Its size.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        match &self.lookup {
            ForcedLookup::Table(table) => table.memory_bytes(),
            ForcedLookup::Trees(trees) => trees.memory_bytes(),
            ForcedLookup::Unknown => 0,
        }
    }
}

/// The pruning rule on one map. Immutable; share it between planners.
#[derive(Debug)]
pub struct Pruning<P: Placement> {
    grid: Arc<Grid>,
    rule: Arc<CanonicalRule<P>>,
    clearance: Option<Clearance>,
    forced_cache: Option<ForcedCache>,
}

/// What a vertex allows to a path that arrives there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LocalRule {
    /// Whether there is any turn.
    pub(crate) forced: bool,
    /// Whether the incoming move may be repeated.
    pub(crate) ahead: bool,
    /// For how many steps of the incoming move this is known to hold.
    pub(crate) steps: u32,
    /// Whether the straight runs beside a slanted one may come to a jump point.
    pub(crate) beside: bool,
}

impl<P: Placement> Pruning<P> {
    /// The rule for a grid graph.
    #[must_use]
    pub fn new(graph: &GridGraph<P>) -> Self {
        Self::with_rule(graph, Arc::new(CanonicalRule::new(graph.k(), graph.rule())))
    }

    /// The same with a rule that other maps use as well; one for another k or rule of motion is not used.
    #[must_use]
    pub fn with_rule(graph: &GridGraph<P>, rule: Arc<CanonicalRule<P>>) -> Self {
        if (rule.k, rule.rule) != (graph.k(), graph.rule()) {
            return Self::new(graph);
        }
        let clearance = (graph.k() > FiniteK::N8).then(|| Clearance::new(graph));
        let has_trees = matches!(rule.lookup, ForcedLookup::Trees(_));
        let forced_cache = has_trees.then(|| ForcedCache::new(graph.vertex_count(), graph.k().get()));
        Self { grid: Arc::clone(graph.grid()), rule, clearance, forced_cache }
    }

    /// This, if it was made for the grid graph, or what is: what holds on one map must not be believed on another.
    #[must_use]
    pub(crate) fn matching(self: Arc<Self>, graph: &GridGraph<P>) -> Arc<Self> {
        let same_rule = (self.rule.k, self.rule.rule) == (graph.k(), graph.rule());
        if same_rule && Arc::ptr_eq(&self.grid, graph.grid()) {
            return self;
        }
        Arc::new(Self::with_rule(graph, Arc::clone(&self.rule)))
    }

    /// Its size.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let cache = self.forced_cache.as_ref().map_or(0, ForcedCache::memory_bytes);
        self.rule.memory_bytes() + self.clearance.as_ref().map_or(0, Clearance::memory_bytes) + cache
    }

    /// Whether a path that arrives at `at` by move `by` is subject to no pruning there, because of closed gaps.
    #[inline]
    pub(crate) fn is_exempt(&self, graph: &GridGraph<P>, at: Vertex, by: usize, goal: Vertex) -> bool {
        graph.has_closed_gaps() && self.is_exempt_from_gaps(graph, at, by, goal)
    }

    #[cold]
    fn is_exempt_from_gaps(&self, graph: &GridGraph<P>, at: Vertex, by: usize, goal: Vertex) -> bool {
        let to_goal = at.to(goal);
        !prunes(graph)
            || graph.is_closed_gap(at + -graph.step(by).vector())
            || graph.is_closed_gap(goal) && to_goal.x.abs().max(to_goal.y.abs()) <= self.rule.radius
    }

    /// Calls `take` with the successors of a path that arrived at `at` by move `by`.
    #[inline]
    pub(crate) fn for_each(
        &self,
        graph: &GridGraph<P>,
        node: &ExpandedNode,
        by: usize,
        mut take: impl FnMut(usize),
    ) {
        let at = node.at;
        match &self.rule.lookup {
            ForcedLookup::Table(table) => {
                let mut left = table.successors(by, pattern(graph, at));
                while left != 0 {
                    take(left.trailing_zeros() as usize);
                    left &= left - 1;
                }
            }
            ForcedLookup::Trees(trees) => {
                let around = self.around(node);
                let is_open = around.free >= trees.needed[by];
                for b in natural(by, graph.steps().len()) {
                    if is_open || trees.is_legal(b, graph.grid(), at) {
                        take(b);
                    }
                }
                if around.corner >= self.rule.corners {
                    return;
                }
                let known = self.known_forced(node, by);
                if known != Some(false) {
                    let mut any = false;
                    trees.for_each_forced(by, graph.grid(), at, |next| {
                        any = true;
                        take(next);
                        true
                    });
                    if known.is_none() {
                        self.record_forced(node, by, any);
                    }
                }
            }
            ForcedLookup::Unknown => {
                if self.around(node).corner < self.rule.corners {
                    return graph.for_each_legal_move(at, take);
                }
                for b in natural(by, graph.steps().len()) {
                    if graph.sees(at, at + graph.step(b).vector()) {
                        take(b);
                    }
                }
            }
        }
    }

    /// Whether a slanted run may come to a turn anywhere. (At k = 3 only where moves may cut corners.)
    #[inline]
    pub(crate) fn diagonals_may_force(&self) -> bool {
        match &self.rule.lookup {
            ForcedLookup::Table(table) => table.diagonals_may_force(),
            ForcedLookup::Trees(_) | ForcedLookup::Unknown => true,
        }
    }

    /// Whether turns are known everywhere; else all vertices near corners count as having some.
    #[inline]
    pub(crate) const fn knows_forced(&self) -> bool {
        self.clearance.is_none() || self.forced_cache.is_some()
    }

    /// Whether `turn` is ever a turn after move `by`; for k ≤ 3.
    pub(crate) fn may_be_forced(&self, by: usize, next: usize) -> bool {
        match &self.rule.lookup {
            ForcedLookup::Table(table) => (0..P::PATTERNS)
                .any(|pattern| table.forced(by, table.successors(by, pattern)) >> next & 1 == 1),
            ForcedLookup::Trees(_) | ForcedLookup::Unknown => true,
        }
    }

    /// Whether a path that comes by move `by` to a vertex with this pattern of cells finds a turn; for k ≤ 3.
    pub(crate) fn has_forced_at(&self, pattern: usize, by: usize) -> bool {
        match &self.rule.lookup {
            ForcedLookup::Table(table) => table.forced(by, table.successors(by, pattern)) != 0,
            ForcedLookup::Trees(_) | ForcedLookup::Unknown => true,
        }
    }

    /// Whether it takes longer to tell the turns from the other legal moves than to take all of these: from k = 7 on, wherever there is a
    /// turn. Canonical A* at k = 7 then takes 0.57 of the time on random512-10-0, 0.55 on 8room_000, 0.78 on brc202d and 1.0 on ArcticStation,
    /// at k = 8 0.4, 0.4, 0.46 and 0.7. At k = 6 it would be about even, at k = 5 a loss.
    #[inline]
    pub(crate) fn takes_all_moves(&self, graph: &GridGraph<P>, node: &ExpandedNode, by: usize) -> bool {
        let ForcedLookup::Trees(trees) = &self.rule.lookup else { return false };
        graph.k().get() >= 7
            && self.around(node).corner < self.rule.corners
            && self.has_forced(trees, graph, node, by)
    }

    /// Whether a path that arrives by move `by` at a vertex near a corner finds a turn there.
    #[inline]
    fn has_forced(&self, trees: &ForcedTrees, graph: &GridGraph<P>, node: &ExpandedNode, by: usize) -> bool {
        self.known_forced(node, by).unwrap_or_else(|| {
            let forced = !trees.for_each_forced(by, graph.grid(), node.at, |_| false);
            self.record_forced(node, by, forced);
            forced
        })
    }

    #[inline]
    fn known_forced(&self, node: &ExpandedNode, by: usize) -> Option<bool> {
        self.forced_cache.as_ref()?.get(node.id, by)
    }

    #[inline]
    fn record_forced(&self, node: &ExpandedNode, by: usize, forced: bool) {
        if let Some(cache) = &self.forced_cache {
            cache.record(node.id, by, forced);
        }
    }

    #[inline]
    fn around(&self, node: &ExpandedNode) -> VertexClearance {
        let nothing_known = VertexClearance { free: 0, corner: 0 };
        self.clearance.as_ref().map_or(nothing_known, |clearance| clearance.of(node.id))
    }

    /// What a vertex allows to a path that arrives there by move `by`.
    #[inline]
    pub(crate) fn local_rule(&self, graph: &GridGraph<P>, node: &ExpandedNode, by: usize) -> LocalRule {
        let all = LocalRule { forced: false, ahead: true, steps: 0, beside: true };
        let ForcedLookup::Table(table) = &self.rule.lookup else {
            let (around, needed) = (self.around(node), self.rule.corners);
            if around.corner < needed {
                return match &self.rule.lookup {
                    ForcedLookup::Trees(trees) => {
                        let forced = self.has_forced(trees, graph, node, by);
                        LocalRule { forced, ahead: trees.is_legal(by, graph.grid(), node.at), ..all }
                    }
                    _ => LocalRule { forced: true, ..all },
                };
            }
            // No move leads further than this.
            let Some(spare) = around.free.checked_sub(self.rule.radius as u32 + 1) else {
                return LocalRule { ahead: self.is_legal(graph, node, by), ..all };
            };
            return LocalRule { steps: open_steps(graph, by, spare.min(around.corner - needed)), ..all };
        };
        let set = table.successors(by, pattern(graph, node.at));
        LocalRule { forced: table.forced(by, set) != 0, ahead: set >> by & 1 == 1, ..all }
    }

    /// Whether a natural successor is legal.
    #[inline]
    pub(crate) fn is_legal(&self, graph: &GridGraph<P>, node: &ExpandedNode, index: usize) -> bool {
        match &self.rule.lookup {
            ForcedLookup::Table(table) => table.successors(index, pattern(graph, node.at)) >> index & 1 == 1,
            ForcedLookup::Trees(trees) => trees.is_legal(index, graph.grid(), node.at),
            ForcedLookup::Unknown => graph.sees(node.at, node.at + graph.step(index).vector()),
        }
    }
}

/// How many steps further a clearance that is `spare` above what is needed still suffices.
#[inline]
fn open_steps<P: Placement>(graph: &GridGraph<P>, by: usize, spare: u32) -> u32 {
    let v = graph.step(by).vector();
    spare / v.x.unsigned_abs().max(v.y.unsigned_abs())
}

/// The pattern of cells around a vertex of the map.
#[inline]
fn pattern<P: Placement>(graph: &GridGraph<P>, at: Vertex) -> usize {
    let rows = graph.grid().rows();
    P::pattern(rows.words(), rows.index(at.x, at.y), rows.bits_per_row())
}

/// Canonical A*: optimal over N(k), for every k, both placements and all rules of motion.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Canonical, Hk, Planner, Query};
///
/// let map = AsciiMap::parse("
///     ....
///     .#..
/// ")?;
/// let graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::new(4)?, CornerRule::Never)?;
/// let outcome = Canonical::new(&graph, Hk).solve(Query::new((0, 0), (3, 1)))?;
/// assert_eq!(outcome.path().map(|path| path.cost()), Some(1.0 + 5.0_f64.sqrt()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type Canonical<L, H, P> = BestFirst<L, H, CanonicalMoves<P>>;

/// Those moves that the rule leaves, and where it would take longer to find them out, all that are legal.
#[derive(Clone, Debug)]
pub struct CanonicalMoves<P: Placement> {
    pruning: Arc<Pruning<P>>,
}

impl<P: Placement, L: Deref<Target = GridGraph<P>>, H: Heuristic> Canonical<L, H, P> {
    /// A planner with scratch memory for `graph`, and its own [`Pruning`].
    #[must_use]
    pub fn new(graph: L, heuristic: H) -> Self {
        let pruning = Arc::new(Pruning::new(&*graph));
        Self::with_pruning(graph, pruning, heuristic)
    }

    /// A planner that shares its pruning rule with others. One that was made for another map, k or rule of motion is not used.
    #[must_use]
    pub fn with_pruning(graph: L, pruning: Arc<Pruning<P>>, heuristic: H) -> Self {
        let pruning = pruning.matching(&graph);
        Self::with(graph, heuristic, CanonicalMoves { pruning })
    }
}

impl<P: Placement> Successors<P> for CanonicalMoves<P> {
    type ParentPointer = ();

    #[inline]
    fn for_each(
        &self,
        graph: &GridGraph<P>,
        node: ExpandedNode,
        goal: Vertex,
        mut visit: impl FnMut(Successor),
    ) -> u32 {
        let is_pruned = |by: &usize| {
            !self.pruning.is_exempt(graph, node.at, *by, goal)
                && !self.pruning.takes_all_moves(graph, &node, *by)
        };
        match node.by.filter(is_pruned) {
            None => graph.for_each_successor(node.at, node.by, goal, |by| visit(node.step(graph, by))),
            Some(by) => self.pruning.for_each(graph, &node, by, |next| {
                if graph.may_step(node.at, node.by, next, goal) {
                    visit(node.step(graph, next));
                }
            }),
        }
        0
    }

    #[inline]
    fn prefers(&self, graph: &GridGraph<P>, new: usize, known: usize) -> bool {
        prunes(graph) && rank(new) < rank(known)
    }
}
