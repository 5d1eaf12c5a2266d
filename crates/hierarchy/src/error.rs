//! What there is no hierarchy for.

use mediant_grid::Rules;
use mediant_moves::{FiniteK, KError};

/// An index that cannot be made, repaired or read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HierarchyError {
    /// Moves that the hierarchies are not made for.
    #[error(
        "no hierarchy for k = {k} at centers under {rules}: k must be 2 or 3, and corners never cut at 3"
    )]
    Moves {
        /// What was asked for.
        k: FiniteK,
        /// The rules.
        rules: Rules,
    },
    /// Clusters or segments that are too small or too large.
    #[error("a cluster or segment of {found} × {found} cells: the side must be {min} to {max}")]
    Side {
        /// What was asked for.
        found: u32,
        /// The smallest.
        min: u32,
        /// The largest.
        max: u32,
    },
    /// No level, or more than fit.
    #[error(
        "{found} levels of clusters, the lowest of {side} × {side} cells: there must be one, and the clusters of the highest \
         at most {max} cells long",
        max = crate::Clustering::MAX_SIDE
    )]
    Levels {
        /// What was asked for.
        found: u32,
        /// The side of the lowest level's clusters.
        side: u32,
    },
    /// A map of another size.
    #[error(
        "this index is of a map of {} × {} cells, not {} × {}: repair it with the map that changed",
        expected.0, expected.1, found.0, found.1
    )]
    Size {
        /// Width and height of the index's map.
        expected: (u32, u32),
        /// Those of the other one.
        found: (u32, u32),
    },
    /// An index for other moves.
    #[error(
        "this index is for k = {expected}, not {found}: make it for the moves that the planner is to take"
    )]
    OtherK {
        /// The index's k.
        expected: FiniteK,
        /// The grid graph's.
        found: FiniteK,
    },
    /// A neighborhood that is too large.
    #[error(transparent)]
    K(#[from] KError),
    /// Bytes that are no index of this map.
    #[error("these bytes are no index of this map: {0}")]
    Bytes(&'static str),
}
