//! The pruning rule without a map: what can be prepared for a placement, a rule of motion and k.

use mediant_grid::{Identity, Interrupt, Interrupted, Placement, uninterrupted};
use mediant_moves::{FiniteK, Neighborhood};

use super::{
    alternatives::MoveTable, clearance::Clearance, forced_trees::ForcedTrees, pattern_table::PatternTable,
};

/// The pruning rule of one placement, rule of motion and k, for any map. Immutable; share it.
#[derive(Clone, Debug)]
pub struct CanonicalRule<P: Placement> {
    pub(super) k: FiniteK,
    pub(super) rule: P::Rule,
    /// The largest coordinate of a move.
    pub(super) radius: i32,
    /// The distance to the nearest corner of an obstacle from which on a vertex has no forced successors.
    pub(super) corner_distance: u32,
    pub(super) lookup: ForcedLookup,
}

/// How forced successors are found.
#[derive(Clone, Debug)]
pub(super) enum ForcedLookup {
    /// For k ≤ 3.
    Table(PatternTable),
    /// Up to [`CanonicalRule::MAX_TABULATED_K`].
    Trees(ForcedTrees),
    /// They are not known: near corners nothing is pruned.
    Unknown,
}

impl<P: Placement> CanonicalRule<P> {
    /// The largest k whose forced successors are tabulated.
    pub const MAX_TABULATED_K: u32 = 8;

    /// Computes the rule, in time and memory that grow with 4^k: see [`memory_bytes`](Self::memory_bytes).
    #[must_use]
    pub fn new(k: FiniteK, rule: P::Rule) -> Self {
        uninterrupted(|never| Self::interruptible(k, rule, never))
    }

    /// [`new`](Self::new), which an interrupt can stop; it asks for each pair of moves.
    ///
    /// # Errors
    /// [`Interrupted`].
    pub fn interruptible(k: FiniteK, rule: P::Rule, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        let radius = k.radius().unwrap_or(1 << 16).min(1 << 16);
        let lookup = match Neighborhood::new(k).ok().filter(|_| k.get() <= Self::MAX_TABULATED_K) {
            None => ForcedLookup::Unknown,
            Some(all) if k <= FiniteK::N8 => {
                ForcedLookup::Table(PatternTable::new(&MoveTable::<P>::new(rule, all)))
            }
            Some(all) => ForcedLookup::Trees(ForcedTrees::new(&MoveTable::<P>::new(rule, all), interrupt)?),
        };
        let corner_distance = Clearance::needed_from_corners::<P>(radius);
        Ok(Self { k, rule, radius, corner_distance, lookup })
    }

    /// The identity: its rules of motion and k, and every map.
    #[must_use]
    pub fn identity(&self) -> Identity {
        Identity { map: None, rules: P::rules(self.rule), k: Some(self.k.into()) }
    }

    /// The memory used, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        match &self.lookup {
            ForcedLookup::Table(table) => table.memory_bytes(),
            ForcedLookup::Trees(trees) => trees.memory_bytes(),
            ForcedLookup::Unknown => 0,
        }
    }
}
