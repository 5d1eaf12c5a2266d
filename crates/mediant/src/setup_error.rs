//! Why a setup is refused.

use std::fmt;

use mediant_grid::{Grid, PlacementKind, Rules};
use mediant_moves::{FiniteK, K};

use crate::{engine::Engine, motion::Motion, option::Levels};

/// The error for a setup whose parts do not fit together. `{:?}` shows the text of the error, too.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// An option, or a value of it, that the engine does not take.
    #[error("{engine} takes no {option}: leave it out, or choose {others}")]
    Option {
        /// The engine.
        engine: Engine,
        /// The option's noun: `jump limit`.
        option: &'static str,
        /// The engines that take it.
        others: String,
    },
    /// Motion that no engine searches.
    #[error(
        "no engine searches {motion}: choose a k from 2 to {} (4 to {} neighbors), or any",
        Motion::MAX_K,
        2_u64.saturating_pow(Motion::MAX_K)
    )]
    Motion {
        /// The motion.
        motion: Motion,
    },
    /// A corner rule, for paths at any angle between centers.
    #[error(
        "at any angle paths between centers bend at corners of obstacles, where there is a rule for gaps and none \
         for corners: choose gap open or closed, or a finite k"
    )]
    AnyAngleWithCorners,
    /// A gap rule between centers, for paths over N(k).
    #[error("between centers gap is for k = any; for k = {k} there is corners: never, one or always")]
    GapBetweenCenters {
        /// The k.
        k: FiniteK,
    },
    /// A finite k that is larger than the engine takes.
    #[error("{engine} needs a k from 2 to {max}, found {}", with_neighbors(*k))]
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
        "at centers {engine} takes k = 2, or k = 3 with corners never, not k = {k} with {}: \
         choose one of these,{} or another engine",
        rules.to_string().trim_start_matches("center, "),
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
    /// An engine that this build lacks.
    #[error("{engine} is not in this build of the library: choose {}", Engine::names_where(|_| true))]
    NotBuilt {
        /// The engine.
        engine: Engine,
    },
    /// CHPA* as published, with a limit to detours: only the complete variant has one.
    #[error(
        "{engine} as published has no limit to detours: leave out the detour, or choose the variant complete"
    )]
    DetourAsPublished {
        /// The engine.
        engine: Engine,
    },
    /// Memory for hub labels, with levels that are no hub labels.
    #[error("memory is for hub labels, not for {}: leave out the one or the other", levels.in_words())]
    MemoryWithoutLabels {
        /// The levels.
        levels: Levels,
    },
    /// A number of landmarks that there cannot be.
    #[error("{count} landmarks: choose 1 to {max}")]
    Landmarks {
        /// The number.
        count: u32,
        /// The greatest.
        max: u32,
    },
    /// Options of another engine than that of the index.
    #[error("this index is of {known}: give options of {known}, or prepare {engine}")]
    OtherEngine {
        /// The engine of the options.
        engine: Engine,
        /// The engine of the index.
        known: Engine,
    },
    /// An index of another engine than that of the planner that is to follow to it.
    #[error(
        "this planner is of {known}, and cannot follow to an index of {engine}: make a planner of that index"
    )]
    OtherPlanner {
        /// The engine of the index.
        engine: Engine,
        /// The engine of the planner.
        known: Engine,
    },
    /// Another variant than that which the index was prepared for.
    #[error("this index is for another variant of {engine}: prepare the one that you want")]
    OtherVariant {
        /// The engine.
        engine: Engine,
    },
    /// A saved index, for a motion for which no engine has one.
    #[error(
        "no engine has an index for {motion}: choose k = 2 to 8, or placement corner, or name an engine that needs none"
    )]
    NoIndex {
        /// The motion.
        motion: Motion,
    },
    /// An engine that knows no costs of cells, in a space that has them.
    #[error("{engine} knows no costs of cells: on costs choose {others}")]
    Costs {
        /// The engine.
        engine: Engine,
        /// The engines that know costs.
        others: String,
    },
    /// An engine that does not walk over elevation.
    #[error("{engine} does not walk over elevation: choose astar or dijkstra")]
    Walking {
        /// The engine.
        engine: Engine,
    },
    /// A k over which no engine searches on costs of cells.
    #[error(
        "on costs of cells no engine searches k = {k}: choose a k from 2 to {max} (4 to {} neighbors), by {engines}",
        2_u64.saturating_pow(*max)
    )]
    CostsK {
        /// The k.
        k: K,
        /// The largest k.
        max: u32,
        /// The engines that search on such costs.
        engines: String,
    },
    /// Something that there is not on costs of cells.
    #[error("on costs of cells there is no {what}: {instead}")]
    WithCosts {
        /// The missing thing.
        what: &'static str,
        /// The way out.
        instead: &'static str,
    },
    /// Something that takes no map with so long a side.
    #[error(
        "{what} needs sides of at most {max} cells, up to which 32 bits hold its numbers, and the map has {} columns \
         and {} rows: {instead}",
        size.0, size.1, max = Grid::MAX_SIDE
    )]
    LongSide {
        /// The thing, such as an engine.
        what: &'static str,
        /// The width and the height of the map.
        size: (u32, u32),
        /// The way out.
        instead: &'static str,
    },
    /// An edit of costs in a space whose cells have none.
    #[error("the cells of this space have no costs: make a space of costs by `Map::costs`")]
    WithoutCosts,
    /// A saved index or all distances, for an engine that has none.
    #[error("{engine} has no {what}: choose {others}")]
    Without {
        /// The engine.
        engine: Engine,
        /// The missing part: `index`, or `distances to all vertices`.
        what: &'static str,
        /// The engines that have it.
        others: String,
    },
}

/// Whoever asked for neighbors finds them again.
fn with_neighbors(k: FiniteK) -> String {
    1_u64.checked_shl(k.get()).map_or_else(|| k.to_string(), |count| format!("{k} ({count} neighbors)"))
}

impl SetupError {
    /// The engines that search over elevation.
    pub(crate) const OVER_ELEVATION: [Engine; 2] = [Engine::AStar, Engine::Dijkstra];

    pub(crate) const TAUT_ON_COSTS: Self =
        Self::WithCosts { what: "taut smoothing", instead: "smooth linearly, which never costs more" };
    #[cfg(feature = "costs")]
    pub(crate) const HEURISTIC_ON_COSTS: Self =
        Self::WithCosts { what: "heuristic but hk and zero", instead: "leave it out" };
    pub(crate) const EXCEPTIONS_ON_COSTS: Self = Self::WithCosts {
        what: "query with exceptions",
        instead: "edit the costs, and let a planner follow",
    };
    pub(crate) const WIDEST_ON_COSTS: Self =
        Self::WithCosts { what: "widest path", instead: "raise the costs of cells near walls" };
    pub(crate) const INDEX_OVER_ELEVATION: Self = Self::WithCosts {
        what: "saved index over elevation",
        instead: "prepare it, which takes next to nothing",
    };
    pub(crate) const SMOOTHING_OVER_ELEVATION: Self =
        Self::WithCosts { what: "smoothing over elevation", instead: "take a greater k" };
    pub(crate) const EDITS_OVER_ELEVATION: Self =
        Self::WithCosts { what: "edit of elevations", instead: "make the map to walk on anew" };

    /// The error for an engine that knows no costs.
    pub(crate) fn on_costs(engine: Engine) -> Self {
        Self::Costs { engine, others: Engine::names_where(|kind| kind.capabilities().costs) }
    }

    #[cfg(feature = "costs")]
    /// The error for a k over which no engine searches on costs, or over elevation.
    pub(crate) fn k_on_costs(k: K, max: u32, is_walking: bool) -> Self {
        let is_known = |kind: Engine| match is_walking {
            true => Self::OVER_ELEVATION.contains(&kind),
            false => kind.capabilities().costs,
        };
        Self::CostsK { k, max, engines: Engine::names_where(is_known) }
    }

    /// The error for an engine whose index is not saved.
    pub(crate) fn without_index(engine: Engine) -> Self {
        let others = Engine::names_where(|kind| kind.capabilities().index.is_some());
        Self::Without { engine, what: "index", others }
    }

    /// The same where cells have costs.
    pub(crate) fn without_index_on_costs(engine: Engine) -> Self {
        let is_known = |kind: Engine| kind.capabilities().costs && kind.capabilities().index.is_some();
        Self::Without { engine, what: "index", others: Engine::names_where(is_known) }
    }

    #[cfg(feature = "publications")]
    /// The error for a heuristic that overestimates, and an engine that takes none.
    pub(crate) fn overestimates(engine: Engine) -> Self {
        let others = Engine::names_where(|kind| kind.capabilities().overestimates);
        Self::Option { engine, option: "heuristic that overestimates", others }
    }

    /// The error for a placement that the engine does not take.
    pub(crate) fn placement(engine: Engine, needed: PlacementKind, placement: PlacementKind) -> Self {
        let others = Engine::names_where(|kind| kind.capabilities().placements.contains(&placement));
        Self::Placement { engine, needed, placement, others }
    }

    /// The error for an engine that does not find the distances to all vertices.
    pub(crate) fn without_distances(engine: Engine) -> Self {
        let others = Engine::names_where(|kind| kind.capabilities().distances);
        Self::Without { engine, what: "distances to all vertices", others }
    }
}

impl fmt::Debug for SetupError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// The error for a text that is no [`Setup`](crate::Setup): the form that was expected, and what is wrong.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected ENGINE[:K[:RULE]][,OPTION…], found `{found}`: {wrong}")]
pub struct TextError {
    pub(crate) found: String,
    pub(crate) wrong: String,
}
