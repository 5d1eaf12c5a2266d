//! How an agent moves.

use std::fmt;

use mediant_grid::{Centers, CornerRule, DiagonalGap, GridGraph, PlacementKind, Rules};
use mediant_moves::K;

use crate::setup_error::SetupError;

/// How an agent moves: where the vertices of its paths are, by which rule, and in which directions (k).
///
/// ```
/// use mediant::{CornerRule, K, Motion};
///
/// // Eight directions between the centers of cells, without cutting corners: the rule of most benchmarks.
/// let walker = Motion::centers(K::N8);
/// // Any direction between the corners of cells.
/// let drone = Motion::corners(K::ANY);
/// // Sixteen directions; a corner may be cut if one of the two cells beside it is free.
/// let soldier = Motion::new(K::N16, CornerRule::One);
/// assert_eq!(soldier.to_string(), "center, corners one, k = 4");
/// # assert_ne!(walker, drone);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub struct Motion {
    /// The neighborhood: 2^k directions, or all of them. k = 3 has 8 moves, k = 8 has 256:
    /// [`K::from_neighbors`] takes the number of moves.
    pub k: K,
    /// The placement of the vertices, and its rule of motion.
    pub rules: Rules,
}

impl Motion {
    /// The largest finite k that an engine searches over.
    pub const MAX_K: u32 = GridGraph::<Centers>::MAX_K;

    /// N(k) under a [`CornerRule`] (vertices at centers), a [`DiagonalGap`] (vertices at corners), or either
    /// of them as [`Rules`].
    #[must_use]
    pub fn new(k: impl Into<K>, rules: impl Into<Rules>) -> Self {
        Self { k: k.into(), rules: rules.into() }
    }

    /// N(k) between the centers of cells; corners are never cut.
    #[must_use]
    pub fn centers(k: impl Into<K>) -> Self {
        Self::new(k, CornerRule::default())
    }

    /// N(k) between the corners of cells; paths may pass where two blocked cells touch diagonally.
    #[must_use]
    pub fn corners(k: impl Into<K>) -> Self {
        Self::new(k, DiagonalGap::default())
    }
}

impl Motion {
    /// Checks that an engine searches it: at a k that is not too large, and at any angle only between corners.
    pub(crate) fn check(self) -> Result<(), SetupError> {
        let is_searched = match self.k {
            K::Finite(k) => k.get() <= Self::MAX_K,
            K::Any => self.rules.placement() == PlacementKind::Corner,
        };
        if is_searched { Ok(()) } else { Err(SetupError::Motion { motion: self }) }
    }
}

impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&format!("{}, k = {}", self.rules, self.k))
    }
}
