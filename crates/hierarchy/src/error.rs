//! Why there is no index, or no planner on it.

use mediant_grid::{Interrupted, Mismatch, Rules};
use mediant_moves::{FiniteK, KError};

/// An index that cannot be made, repaired, read or used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HierarchyError {
    /// A k and rules without a hierarchy.
    #[error("no hierarchy for k = {k} under {rules}: k must be 2 or 3, and corners never cut at 3")]
    Moves {
        /// The k that was asked for.
        k: FiniteK,
        /// The rules that were asked for.
        rules: Rules,
    },
    /// Clusters or segments that are too small or too large.
    #[error("a cluster or segment of {found} × {found} cells: the side must be {min} to {max}")]
    Side {
        /// The side that was asked for, in cells.
        found: u32,
        /// The shortest.
        min: u32,
        /// The longest.
        max: u32,
    },
    /// No level, or too many.
    #[error(
        "{found} levels of clusters, the lowest of {side} × {side} cells: there must be at least one level, \
         and the clusters of the highest at most {max} cells long"
    )]
    Levels {
        /// The number of levels that was asked for.
        found: u32,
        /// The side of the lowest level's clusters, in cells.
        side: u32,
        /// The longest side of a cluster of any level, in cells.
        max: u32,
    },
    /// An index of another map, rule of motion or k.
    #[error(transparent)]
    Mismatch(#[from] Mismatch),
    /// An index with more nodes or segments than this machine can address.
    #[error(
        "an index of {count} nodes or segments is more than this machine can address: choose a longer side"
    )]
    TooLarge {
        /// The number of nodes or segments.
        count: u64,
    },
    /// A neighborhood that is too large.
    #[error(transparent)]
    K(#[from] KError),
    /// Bytes that are no index of this map.
    #[error("these bytes are no index of this map: {0}")]
    Bytes(&'static str),
    /// It was stopped before it was done.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}
