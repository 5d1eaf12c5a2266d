//! Errors of building and reading subgoal graphs.

use mediant_grid::{Interrupted, Mismatch, Rules};
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
    /// There are no hub labels: the contraction hierarchy has a core.
    #[error(
        "this map has no hub labels: the contraction leaves a core of {core} of {subgoals} subgoals; prepare \
         the contraction hierarchy, or leave the choice to the map"
    )]
    Core {
        /// The subgoals of the core.
        core: usize,
        /// All subgoals.
        subgoals: usize,
    },
    /// Hub labels would take more memory than they may.
    #[error(
        "the hub labels take more than {most} bytes: allow more memory, or prepare a contraction hierarchy"
    )]
    Memory {
        /// The bytes that they may take.
        most: usize,
    },
    /// There are too many hub labels, or their costs are too large.
    #[error("the hub labels are more than their format can hold: prepare a contraction hierarchy")]
    Labels,
    /// The graph belongs to another map, placement, rule of motion or k.
    #[error(transparent)]
    Mismatch(#[from] Mismatch),
    /// The bytes are no subgoal graph of this map.
    #[error("these bytes are no subgoal graph of this map: {0}")]
    Bytes(&'static str),
    /// It was stopped before it was done.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}
