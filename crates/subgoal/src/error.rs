//! What there is no subgoal graph for.

use mediant_grid::Rules;
use mediant_moves::{K, KError};

/// A subgoal graph that cannot be made or read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SubgoalError {
    /// Subgoal graphs at centers are for small k, and for corners that are never cut.
    #[error(
        "no subgoal graph for k = {k} at centers under {rules}: k must be 2 or 3, and corners never cut at 3"
    )]
    Centers {
        /// What was asked for.
        k: K,
        /// The rules.
        rules: Rules,
    },
    /// A neighborhood that is too large.
    #[error(transparent)]
    K(#[from] KError),
    /// Bytes that are no subgoal graph of this map.
    #[error("these bytes are no subgoal graph of this map: {0}")]
    Bytes(&'static str),
}
