//! Errors of building and reading subgoal graphs.

use mediant_grid::{Mismatch, Rules};
use mediant_moves::{K, KError};

/// A subgoal graph that cannot be built or read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SubgoalError {
    /// At centers there are subgoal graphs for k = 2, and for k = 3 if corners are never cut.
    #[error("no subgoal graph for k = {k} under {rules}: k must be 2 or 3, and corners never cut at 3")]
    Centers {
        /// The k that was asked for.
        k: K,
        /// The rules of the free space.
        rules: Rules,
    },
    /// The neighborhood is too large.
    #[error(transparent)]
    K(#[from] KError),
    /// The graph has more arcs than 32-bit numbers can count.
    #[error("the subgoal graph has {count} arcs, and must have at most {most}: choose a smaller map")]
    Arcs {
        /// The number of arcs.
        count: usize,
        /// The most that a graph can have.
        most: u32,
    },
    /// The graph belongs to another map, placement, rule of motion or k.
    #[error(transparent)]
    Mismatch(#[from] Mismatch),
    /// The bytes are no subgoal graph of this map.
    #[error("these bytes are no subgoal graph of this map: {0}")]
    Bytes(&'static str),
}
