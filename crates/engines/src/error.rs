//! What an engine cannot be asked for.

use mediant_grid::{PlacementKind, Rules};
use mediant_hierarchy::HierarchyError;
use mediant_moves::{FiniteK, K, KError};
use mediant_search::{JumpTableError, QueryError};
use mediant_subgoal::SubgoalError;

use crate::{EngineKind, Levels};

/// A setup that does not exist.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// An option that means nothing to the engine.
    #[error("{engine} takes no {option}: leave it out, or choose {others}")]
    Option {
        /// The engine.
        engine: EngineKind,
        /// What the option is.
        option: &'static str,
        /// The engines that take it.
        others: String,
    },
    /// A neighborhood that the engine does not search, as it searches smaller ones.
    #[error("{engine} needs a k from 2 to {max}, found {k}")]
    K {
        /// The engine.
        engine: EngineKind,
        /// The largest k.
        max: u32,
        /// What was asked for.
        k: FiniteK,
    },
    /// Every direction, asked of an engine that searches neighborhoods.
    #[error("{engine} needs a k from 2 to {max}; for any choose {others}")]
    NeedsFiniteK {
        /// The engine.
        engine: EngineKind,
        /// The largest k.
        max: u32,
        /// The engines that search every direction.
        others: String,
    },
    /// A neighborhood, asked of an engine that searches every direction.
    #[error("{engine} searches every direction, not those of k = {k}: leave k out, or say any")]
    NeedsAny {
        /// The engine.
        engine: EngineKind,
        /// What was asked for.
        k: FiniteK,
    },
    /// A placement that the engine does not take.
    #[error("{engine} needs placement {needed}; for {placement} choose {others}")]
    Placement {
        /// The engine.
        engine: EngineKind,
        /// What it takes.
        needed: PlacementKind,
        /// What was asked for.
        placement: PlacementKind,
        /// The engines that take that.
        others: String,
    },
    /// Centers, asked of an engine that takes them for small k alone.
    #[error(
        "at centers {engine} needs k = 2, or k = 3 under corners never, found k = {k} under {rules}: \
         choose one of these,{} or another engine",
        if engine.capabilities().placements.contains(&PlacementKind::Corner) { " placement corner," } else { "" }
    )]
    Centers {
        /// The engine.
        engine: EngineKind,
        /// The k that was asked for.
        k: K,
        /// The rules.
        rules: Rules,
    },
    /// Two options of which one has no meaning beside the other.
    #[error("{engine} as published knows no detours: leave out the detour, or the variant paper")]
    DetourAsPublished {
        /// The engine.
        engine: EngineKind,
    },
    /// An index, or something that only some engines find, asked of another engine.
    #[error("{engine} has no {what}: choose {others}")]
    Without {
        /// The engine.
        engine: EngineKind,
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
    /// A search space for another k or other rules.
    #[error("needs the search space of k = {} under {}, found that of k = {} under {}", expected.0, expected.1, found.0, found.1)]
    Space {
        /// What the setup asks for.
        expected: (K, Rules),
        /// What there is.
        found: (K, Rules),
    },
    /// A jump table that is not that of the map.
    #[error(transparent)]
    JumpTable(#[from] JumpTableError),
    /// A subgoal graph that cannot be made, or an index that is not that of the map.
    #[error(transparent)]
    Subgoal(#[from] SubgoalError),
    /// A graph of clusters or segments that cannot be made, or an index that is not that of the map.
    #[error(transparent)]
    Hierarchy(#[from] HierarchyError),
    /// An index with other levels than the setup has.
    #[error(
        "needs an index with {}, found one with {}; choose the levels that it has, or build it again",
        expected.in_words(),
        found.in_words()
    )]
    Levels {
        /// What the setup asks for.
        expected: Levels,
        /// What the index has.
        found: Levels,
    },
    /// An index of clusters or segments of another size than the setup has.
    #[error(
        "needs an index whose clusters or segments have {expected} × {expected} cells, found one with {found} × {found}; \
         choose the side that it has, or build it again"
    )]
    Side {
        /// What the setup asks for, in cells.
        expected: u32,
        /// What the index has.
        found: u32,
    },
    /// A query without an answer.
    #[error(transparent)]
    Query(#[from] QueryError),
}
