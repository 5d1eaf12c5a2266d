//! The pruning rule on a map: the successors of a node, and which vertices have forced ones.

use std::sync::Arc;

use mediant_grid::{
    Change, Grid, GridGraph, Identity, Interrupt, Interrupted, Mismatch, Placement, Vertex, uninterrupted,
};
use mediant_moves::FiniteK;

use super::{
    clearance::{Clearance, VertexClearance},
    forced_cache::ForcedCache,
    forced_trees::ForcedTrees,
    order::natural,
    pattern_table::{PatternTable, pattern_at},
    rule::{CanonicalRule, ForcedLookup},
};
use crate::successors::ExpandedNode;

/// Whether anything is pruned on a grid graph. If nothing is, ties need no rule. Where paths may pass gaps
/// there must be none: how a path may leave a gap depends on how it came there.
#[inline]
pub(crate) fn prunes<P: Placement>(graph: &GridGraph<P>) -> bool {
    !graph.has_closed_gaps() || graph.k() != FiniteK::N4
}

/// The pruning rule on one map. Immutable; share it between planners.
#[derive(Debug)]
pub struct Pruning<P: Placement> {
    identity: Identity,
    pub(super) rule: Arc<CanonicalRule<P>>,
    clearance: Option<Clearance>,
    pub(super) forced_cache: Option<ForcedCache>,
}

/// The pruning rule at one vertex for one arriving move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LocalRule {
    /// Whether it has any forced successor, and so is a jump point.
    pub(crate) forced: bool,
    /// Whether the arriving move may be repeated.
    pub(crate) ahead: bool,
    /// For how many more steps of the arriving move this is known to hold.
    pub(crate) steps: u32,
}

impl<P: Placement> Pruning<P> {
    /// Prepares the rule for a grid graph.
    #[must_use]
    pub fn new(graph: &GridGraph<P>) -> Self {
        uninterrupted(|never| Self::interruptible(graph, never))
    }

    /// [`new`](Self::new), which an interrupt can stop.
    ///
    /// # Errors
    /// [`Interrupted`].
    pub fn interruptible(graph: &GridGraph<P>, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        let rule = CanonicalRule::interruptible(graph.k(), graph.rule(), interrupt)?;
        Self::prepare(graph, Arc::new(rule), interrupt)
    }

    /// The same with a rule that is shared with other maps.
    ///
    /// # Errors
    /// [`Mismatch`] for a rule of another k or rule of motion.
    pub fn with_rule(graph: &GridGraph<P>, rule: Arc<CanonicalRule<P>>) -> Result<Self, Mismatch> {
        uninterrupted(|never| Self::with_rule_interruptible(graph, rule, never))
    }

    /// [`with_rule`](Self::with_rule), which an interrupt can stop; it asks for each row of the map.
    ///
    /// # Errors
    /// [`Interrupted`]; within, those of [`with_rule`](Self::with_rule).
    pub fn with_rule_interruptible(
        graph: &GridGraph<P>,
        rule: Arc<CanonicalRule<P>>,
        interrupt: &Interrupt,
    ) -> Result<Result<Self, Mismatch>, Interrupted> {
        match rule.identity().check("the pruning rule", ("the grid graph", graph.identity())) {
            Ok(()) => Self::prepare(graph, rule, interrupt).map(Ok),
            Err(mismatch) => Ok(Err(mismatch)),
        }
    }

    /// Prepares a rule that is that of the grid graph.
    fn prepare(
        graph: &GridGraph<P>,
        rule: Arc<CanonicalRule<P>>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let is_long = graph.k() > FiniteK::N8;
        let clearance = is_long.then(|| Clearance::new::<P>(graph.grid(), interrupt)).transpose()?;
        let has_trees = matches!(rule.lookup, ForcedLookup::Trees(_));
        let cache = || ForcedCache::new(graph.vertex_count(), graph.k().get(), interrupt);
        let forced_cache = has_trees.then(cache).transpose()?;
        Ok(Self { identity: graph.identity(), rule, clearance, forced_cache })
    }

    /// The rule on the grid graph after a change of the map, by work that follows the change. It finds what a
    /// new one finds.
    ///
    /// Of what searches have found out, both keep and share what the change leaves as it is.
    ///
    /// # Errors
    /// [`Interrupted`]; within, [`Mismatch`] if the change is not from the map of this rule to that of the
    /// grid graph, or if that has other rules of motion or another k.
    pub fn repaired(
        &self,
        graph: &GridGraph<P>,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Result<Self, Mismatch>, Interrupted> {
        let on = |map: &Grid| Identity { map: Some(map.id()), ..self.identity };
        let fits =
            self.identity.check("the pruning rule", ("the map before the change", on(change.before())));
        let fits = fits.and_then(|()| {
            on(change.after()).check("the map after the change", ("the grid graph", graph.identity()))
        });
        if let Err(mismatch) = fits {
            return Ok(Err(mismatch));
        }
        let rule = Arc::clone(&self.rule);
        let clearance =
            self.clearance.as_ref().map(|known| known.after::<P>(change, interrupt)).transpose()?;
        let forced_cache = match (&self.forced_cache, &rule.lookup) {
            (Some(known), ForcedLookup::Trees(trees)) => {
                Some(known.after::<P>(change, trees.reach(), interrupt)?)
            }
            _ => None,
        };
        Ok(Ok(Self { identity: graph.identity(), rule, clearance, forced_cache }))
    }

    /// The identity of its grid graph: map, rules of motion and k.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.identity
    }

    /// Checks that it was made for a grid graph: what holds on one map may be wrong on another.
    pub(crate) fn check(&self, graph: &GridGraph<P>) -> Result<(), Mismatch> {
        self.identity.check("the pruning rule", ("the grid graph", graph.identity()))
    }

    /// The memory used, in bytes, with that of the shared rule.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let cache = self.forced_cache.as_ref().map_or(0, ForcedCache::memory_bytes);
        self.rule.memory_bytes() + self.clearance.as_ref().map_or(0, Clearance::memory_bytes) + cache
    }

    /// Whether nothing is pruned for a path that arrives at `at` by move `by`, because of closed gaps.
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

    /// Calls `take` with each move by which a path goes on that arrived at the node by move `by`.
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
                let mut left = table.successors(by, pattern_at(graph, at));
                while left != 0 {
                    take(left.trailing_zeros() as usize);
                    left &= left - 1;
                }
            }
            ForcedLookup::Trees(trees) => {
                let clearance = self.clearance_of(node);
                let is_open = clearance.free >= trees.needed[by];
                for b in natural(by, graph.steps().len()) {
                    if is_open || trees.is_legal(b, graph.grid(), at) {
                        take(b);
                    }
                }
                if clearance.corner >= self.rule.corner_distance {
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
                if self.clearance_of(node).corner < self.rule.corner_distance {
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

    /// The table of successors; for k ≤ 3.
    pub(crate) fn table(&self) -> Option<&PatternTable> {
        match &self.rule.lookup {
            ForcedLookup::Table(table) => Some(table),
            ForcedLookup::Trees(_) | ForcedLookup::Unknown => None,
        }
    }

    /// Whether a diagonal move has a forced successor anywhere. (At k = 3 only where moves may cut corners.)
    #[inline]
    pub(crate) fn diagonals_may_force(&self) -> bool {
        match &self.rule.lookup {
            ForcedLookup::Table(table) => table.diagonals_may_force(),
            ForcedLookup::Trees(_) | ForcedLookup::Unknown => true,
        }
    }

    /// Whether forced successors are known everywhere; if not, all vertices near corners count as having
    /// some.
    #[inline]
    pub(crate) const fn knows_forced(&self) -> bool {
        self.clearance.is_none() || self.forced_cache.is_some()
    }

    /// Whether a path that arrives by move `by` has a forced successor where the cells form `pattern`; for k
    /// ≤ 3.
    pub(crate) fn has_forced_at(&self, pattern: usize, by: usize) -> bool {
        match &self.rule.lookup {
            ForcedLookup::Table(table) => table.forced(by, table.successors(by, pattern)) != 0,
            ForcedLookup::Trees(_) | ForcedLookup::Unknown => true,
        }
    }

    /// Whether all legal moves are taken because it would cost more to find out which of them are forced:
    /// from k = 7 on, wherever there is a forced successor. Canonical A* then takes 0.55 to 1.0 of the time
    /// at k = 7; at k = 6 it would be about even (`docs/measurements/search.md`).
    ///
    /// Out of line it takes 2 % of the instructions of canonical A* at k = 3, where it says no at once.
    #[inline(always)]
    pub(crate) fn takes_all_moves(&self, graph: &GridGraph<P>, node: &ExpandedNode, by: usize) -> bool {
        let ForcedLookup::Trees(trees) = &self.rule.lookup else { return false };
        graph.k().get() >= 7
            && self.clearance_of(node).corner < self.rule.corner_distance
            && self.has_forced(trees, graph, node, by)
    }

    /// Whether a path that arrives by move `by` at a vertex near a corner has a forced successor there. Out
    /// of line it makes jumps at k = 4 take 3 % longer.
    #[inline(always)]
    fn has_forced(&self, trees: &ForcedTrees, graph: &GridGraph<P>, node: &ExpandedNode, by: usize) -> bool {
        if let Some(known) = self.known_forced(node, by) {
            return known;
        }
        let forced = !trees.for_each_forced(by, graph.grid(), node.at, |_| false);
        self.record_forced(node, by, forced);
        forced
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
    fn clearance_of(&self, node: &ExpandedNode) -> VertexClearance {
        let nothing_known = VertexClearance { free: 0, corner: 0 };
        self.clearance.as_ref().map_or(nothing_known, |clearance| clearance.of(node.id))
    }

    /// The rule at a vertex for arriving move `by`.
    #[inline]
    pub(crate) fn local_rule(&self, graph: &GridGraph<P>, node: &ExpandedNode, by: usize) -> LocalRule {
        let all = LocalRule { forced: false, ahead: true, steps: 0 };
        let ForcedLookup::Table(table) = &self.rule.lookup else {
            let (clearance, needed) = (self.clearance_of(node), self.rule.corner_distance);
            if clearance.corner < needed {
                return match &self.rule.lookup {
                    ForcedLookup::Trees(trees) => {
                        let forced = self.has_forced(trees, graph, node, by);
                        LocalRule { forced, ahead: trees.is_legal(by, graph.grid(), node.at), ..all }
                    }
                    _ => LocalRule { forced: true, ..all },
                };
            }
            // No move leads further than the radius.
            let Some(spare) = clearance.free.checked_sub(self.rule.radius as u32 + 1) else {
                return LocalRule { ahead: self.is_legal(graph, node, by), ..all };
            };
            return LocalRule { steps: open_steps(graph, by, spare.min(clearance.corner - needed)), ..all };
        };
        let set = table.successors(by, pattern_at(graph, node.at));
        LocalRule { forced: table.forced(by, set) != 0, ahead: set >> by & 1 == 1, ..all }
    }

    /// Whether the move `index`, a natural successor, is legal.
    #[inline]
    pub(crate) fn is_legal(&self, graph: &GridGraph<P>, node: &ExpandedNode, index: usize) -> bool {
        match &self.rule.lookup {
            ForcedLookup::Table(table) => {
                table.successors(index, pattern_at(graph, node.at)) >> index & 1 == 1
            }
            ForcedLookup::Trees(trees) => trees.is_legal(index, graph.grid(), node.at),
            ForcedLookup::Unknown => graph.sees(node.at, node.at + graph.step(index).vector()),
        }
    }
}

/// For how many steps a clearance that exceeds the needed one by `spare` still suffices.
#[inline]
fn open_steps<P: Placement>(graph: &GridGraph<P>, by: usize, spare: u32) -> u32 {
    let v = graph.step(by).vector();
    spare / v.x.unsigned_abs().max(v.y.unsigned_abs())
}
