//! What an engine cannot be asked for.

use mediant_moves::KError;
use mediant_search::{JumpTableError, QueryError};

use crate::Engine;

/// A setup that does not exist.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// An option that means nothing to the engine.
    #[error("{engine} takes no {option}: leave it out, or choose {others}")]
    Option {
        /// The engine.
        engine: Engine,
        /// What the option is.
        option: &'static str,
        /// The engines that take it.
        others: String,
    },
    /// A neighborhood that the engine does not search.
    #[error("{engine} needs a k from 2 to {max}, found {k}")]
    K {
        /// The engine.
        engine: Engine,
        /// The largest k.
        max: u32,
        /// What was asked for.
        k: u32,
    },
    /// An index, or something that only some engines find, asked of another engine.
    #[error("{engine} has no {what}: choose {others}")]
    Without {
        /// The engine.
        engine: Engine,
        /// What it has not.
        what: &'static str,
        /// The engines that have it.
        others: String,
    },
}

/// A planner that could not be made, or not be asked.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// A setup that does not exist.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A neighborhood without a search graph.
    #[error(transparent)]
    K(#[from] KError),
    /// A jump table that is not that of the map.
    #[error(transparent)]
    JumpTable(#[from] JumpTableError),
    /// A query without an answer.
    #[error(transparent)]
    Query(#[from] QueryError),
}
