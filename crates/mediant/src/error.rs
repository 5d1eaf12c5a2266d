//! Why a setup is refused, and why a planner cannot be made.

use mediant_grid::{Mismatch, PlacementKind, Rules};
use mediant_hierarchy::HierarchyError;
use mediant_moves::{FiniteK, K, KError};
use mediant_search::{JumpError, QueryError};
use mediant_subgoal::SubgoalError;

use crate::{engine::Engine, option::Levels};

/// The error for a setup whose parts do not fit together.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// An option, or a value of it, that the engine does not take.
    #[error("{engine} takes no {option}: leave it out, or choose {others}")]
    Option {
        /// The engine.
        engine: Engine,
        /// What the error calls it.
        option: &'static str,
        /// The engines that take it.
        others: String,
    },
    /// A finite k that is larger than the engine takes.
    #[error("{engine} needs a k from 2 to {max}, found {k}")]
    K {
        /// The engine.
        engine: Engine,
        /// The largest k that it takes.
        max: u32,
        /// The k of the setup.
        k: FiniteK,
    },
    /// k = ∞, for an engine that takes only finite k.
    #[error("{engine} needs a k from 2 to {max}; for any choose {others}")]
    NeedsFiniteK {
        /// The engine.
        engine: Engine,
        /// The largest k that it takes.
        max: u32,
        /// The engines that take k = ∞.
        others: String,
    },
    /// A finite k, for an engine that takes only k = ∞.
    #[error("{engine} searches every direction, not those of k = {k}: leave k out, or say any")]
    NeedsAny {
        /// The engine.
        engine: Engine,
        /// The k of the setup.
        k: FiniteK,
    },
    /// A placement that the engine does not take.
    #[error("{engine} needs placement {needed}; for {placement} choose {others}")]
    Placement {
        /// The engine.
        engine: Engine,
        /// The placement that it takes.
        needed: PlacementKind,
        /// The placement of the setup.
        placement: PlacementKind,
        /// The engines that take the placement of the setup.
        others: String,
    },
    /// Vertices at centers, for an engine that takes them only for small k.
    #[error(
        "at centers {engine} needs k = 2, or k = 3 under corners never, found k = {k} under {rules}: \
         choose one of these,{} or another engine",
        if engine.capabilities().placements.contains(&PlacementKind::Corner) { " placement corner," } else { "" }
    )]
    Centers {
        /// The engine.
        engine: Engine,
        /// The k of the setup.
        k: K,
        /// The rules of the setup.
        rules: Rules,
    },
    /// CHPA* as published, with a limit to detours: only the complete variant has one.
    #[error(
        "{engine} as published has no limit to detours: leave out the detour, or choose the variant complete"
    )]
    DetourAsPublished {
        /// The engine.
        engine: Engine,
    },
    /// A saved index or all distances, for an engine that has none.
    #[error("{engine} has no {what}: choose {others}")]
    Without {
        /// The engine.
        engine: Engine,
        /// What it does not have.
        what: &'static str,
        /// The engines that have it.
        others: String,
    },
}

impl SetupError {
    /// The error for an engine whose index is not saved.
    pub(crate) fn without_index(engine: Engine) -> Self {
        let others = Engine::names_where(|kind| kind.capabilities().index.is_some());
        Self::Without { engine, what: "index", others }
    }

    /// The error for an engine that does not find the distances to all vertices.
    pub(crate) fn without_distances(engine: Engine) -> Self {
        let others = Engine::names_where(|kind| kind.capabilities().distances);
        Self::Without { engine, what: "distances to all vertices", others }
    }
}

/// The error for a planner, an index or distances that cannot be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// A setup whose parts do not fit together.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A k that grid graphs do not take.
    #[error(transparent)]
    K(#[from] KError),
    /// A search space for another k or other rules than those of the setup.
    #[error(
        "needs the search space of k = {} under {}, found that of k = {} under {}",
        expected.0, expected.1, found.0, found.1
    )]
    Space {
        /// The k and the rules of the setup.
        expected: (K, Rules),
        /// The k and the rules of the search space.
        found: (K, Rules),
    },
    /// Two parts that do not belong together.
    #[error(transparent)]
    Mismatch(#[from] Mismatch),
    /// A jump table that cannot be made, or bytes that are not a jump table of this map.
    #[error(transparent)]
    JumpTable(#[from] JumpError),
    /// A subgoal graph that cannot be made, or bytes that are not a subgoal graph of this map.
    #[error(transparent)]
    Subgoal(#[from] SubgoalError),
    /// A graph of clusters or segments that cannot be made, or bytes that are no such graph of this map.
    #[error(transparent)]
    Hierarchy(#[from] HierarchyError),
    /// A saved index with other levels than the setup names.
    #[error(
        "needs an index with {}, found one with {}; choose the levels that it has, or build it again",
        expected.in_words(),
        found.in_words()
    )]
    Levels {
        /// The levels of the setup.
        expected: Levels,
        /// The levels of the index.
        found: Levels,
    },
    /// A saved index of clusters or segments of another size than the setup names.
    #[error(
        "needs an index whose clusters or segments have {expected} × {expected} cells, found one with \
         {found} × {found}; choose the side that it has, or build it again"
    )]
    Side {
        /// The side of the setup, in cells.
        expected: u32,
        /// The side of the index, in cells.
        found: u32,
    },
    /// An invalid query, or one at which the engine gave up.
    #[error(transparent)]
    Query(#[from] QueryError),
}
