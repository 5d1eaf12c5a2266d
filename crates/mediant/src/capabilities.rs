//! Capabilities of the engines: placements, k, guarantee, distances, saved index.

use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, GridGraph, PlacementKind, Rules};
use mediant_hierarchy::{ClusterGraph, SegmentGraph};
use mediant_moves::K;
use mediant_search::JumpTable;
use mediant_subgoal::SubgoalGraph;

#[cfg(feature = "publications")]
use crate::option::Variant;
use crate::{engine::Engine, setup_error::SetupError};

/// The capabilities of an engine, whatever its options.
///
/// An engine works under every rule of motion of the placements that it takes, with one exception: subgoal
/// graphs and hierarchies at centers ([`Setup::check`](crate::Setup::check)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capabilities {
    /// Its name in print: `Block-based JPS`.
    pub title: &'static str,
    /// Its working, in a sentence.
    pub how: &'static str,
    /// The placements that it takes. At any angle an engine at corners leads from center to center, too
    /// ([`Motion::centers`](crate::Motion::centers)).
    pub placements: &'static [PlacementKind],
    /// The largest finite k that it takes; the smallest is 2.
    pub max_k: u32,
    /// Whether it takes k = ∞.
    pub any: bool,
    /// The k that it searches over where none is chosen: 3, but ∞ for Anya.
    pub default_k: K,
    /// Whether it searches the grid graph, rather than the free space alone.
    pub grid_graph: bool,
    /// Its guarantee, with its default options.
    pub guarantee: Promise,
    /// The guarantee in words, with what was measured where there is none.
    pub promise: &'static str,
    /// Its paper: first author and year.
    pub paper: &'static str,
    /// Its papers, with all authors; `ours` for what is in none.
    pub papers: &'static str,
    /// Whether its paths leave N(k): they turn at any angle.
    pub any_angle: bool,
    /// Whether its paths between centers are only over k = 2, and over k = 3 where corners are never cut.
    pub few_k_at_centers: bool,
    /// Whether it takes a heuristic that overestimates. Its paths may then be longer; nothing else goes
    /// wrong.
    #[cfg(feature = "publications")]
    pub overestimates: bool,
    /// Its variants, the default first; empty for an engine that has only one.
    #[cfg(feature = "publications")]
    pub variants: &'static [Variant],
    /// Whether it finds the distances from one vertex to all others.
    pub distances: bool,
    /// Whether it knows [costs of cells](crate::Map::costs).
    pub costs: bool,
    /// The version of its saved index; `None` for an engine whose index is not saved.
    pub index: Option<u32>,
}

/// The promise of an engine for its paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Promise {
    /// No path over N(k) is shorter; at k = ∞ no legal path at all.
    Optimal,
    /// No path has fewer moves. At k = 2 that is a shortest path.
    FewestMoves,
    /// Nothing: paths may be longer than the shortest.
    Suboptimal,
}

impl Promise {
    /// For a table: `optimal(k)`, `optimal(2)`, `suboptimal`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal(k)",
            Self::FewestMoves => "optimal(2)",
            Self::Suboptimal => "suboptimal",
        }
    }
}

impl Capabilities {
    /// The default rules: `never` at centers; `open` at corners for an engine that takes only corners, and
    /// for k = ∞.
    #[must_use]
    pub fn default_rules(self, k: K) -> Rules {
        if self.placements.contains(&PlacementKind::Center) && k != K::Any {
            Rules::Center(CornerRule::default())
        } else {
            Rules::Corner(DiagonalGap::default())
        }
    }
}

/// A search that is optimal over N(k) and has no saved index.
const SEARCH: Capabilities = Capabilities {
    title: "",
    how: "",
    placements: &[PlacementKind::Center, PlacementKind::Corner],
    max_k: GridGraph::<Centers>::MAX_K,
    any: false,
    default_k: K::N8,
    grid_graph: true,
    guarantee: Promise::Optimal,
    promise: "optimal over N(k)",
    paper: "",
    papers: "",
    any_angle: false,
    few_k_at_centers: false,
    #[cfg(feature = "publications")]
    overestimates: false,
    #[cfg(feature = "publications")]
    variants: &[],
    distances: false,
    costs: false,
    index: None,
};

/// A search whose paths may be longer than the shortest.
const THETA: Capabilities =
    Capabilities { guarantee: Promise::Suboptimal, promise: "none", any_angle: true, ..SEARCH };

/// Such a search that knows costs.
const THETA_ON_COSTS: Capabilities =
    Capabilities { promise: "none; with costs none over N(k) is cheaper", costs: true, ..THETA };

/// A search on prepared subgoals.
const SUBGOALS: Capabilities = Capabilities {
    grid_graph: false,
    few_k_at_centers: true,
    index: Some(SubgoalGraph::<Corners>::VERSION),
    ..SEARCH
};

/// The largest k of searches on costs of cells, and the version of the landmarks' format: known here without
/// the feature `costs`, too.
const MAX_K_ON_COSTS: u32 = 8;
const LANDMARKS_VERSION: u32 = 1;
#[cfg(feature = "costs")]
const _: () = assert!(
    MAX_K_ON_COSTS == mediant_costs::CostGraph::MAX_K
        && LANDMARKS_VERSION == mediant_costs::Landmarks::VERSION
);

/// A search on prepared clusters or segments.
const HIERARCHY: Capabilities = Capabilities {
    placements: &[PlacementKind::Center],
    max_k: 3,
    guarantee: Promise::Suboptimal,
    few_k_at_centers: true,
    ..SEARCH
};

/// The engines, a row each, in the order of [`Engine::ALL`].
const TABLE: [Capabilities; Engine::ALL.len()] = [
    Capabilities {
        title: "A*",
        how: "Expands the vertex with the least cost so far plus distance over N(k) to the goal.",
        paper: "Hart 1968, Rivera 2017",
        papers: "Hart, Nilsson & Raphael 1968; Rivera, Hernández & Baier 2017",
        #[cfg(feature = "publications")]
        overestimates: true,
        costs: true,
        ..SEARCH
    },
    Capabilities {
        title: "Dijkstra",
        how: "Expands the vertices in the order of their cost, in all directions alike.",
        promise: "optimal over N(k); distances to all vertices",
        paper: "Dijkstra 1959",
        papers: "Dijkstra 1959",
        distances: true,
        costs: true,
        ..SEARCH
    },
    Capabilities {
        title: "Wavefront",
        how: "Spreads ring by ring, and counts moves rather than length.",
        guarantee: Promise::FewestMoves,
        promise: "fewest moves; distances to all vertices",
        paper: "Hammoud 2023",
        papers: "Hammoud & Lupin 2023",
        distances: true,
        ..SEARCH
    },
    Capabilities {
        title: "Canonical A*",
        how: "A* that follows one of the paths that differ only in the order of their moves.",
        paper: "Rivera 2017",
        papers: "Rivera, Hernández & Baier 2017",
        #[cfg(feature = "publications")]
        variants: &[Variant::Exact, Variant::Paper],
        ..SEARCH
    },
    Capabilities {
        title: "JPS",
        how: "Jumps over the vertices at which no shortest path turns.",
        paper: "Harabor 2011, Hammoud 2023",
        papers: "Harabor & Grastien 2011; for k ≥ 4 ours",
        ..SEARCH
    },
    Capabilities {
        title: "Block-based JPS",
        how: "JPS that looks at 64 vertices at once, by operations on a word.",
        paper: "Harabor 2014",
        papers: "Harabor & Grastien 2014",
        max_k: 3,
        ..SEARCH
    },
    Capabilities {
        title: "JPS+",
        how: "JPS with the jump points of every vertex prepared in lists.",
        paper: "Harabor 2014",
        papers: "Harabor & Grastien 2014",
        max_k: JumpTable::MAX_K,
        index: Some(JumpTable::VERSION),
        ..SEARCH
    },
    Capabilities {
        title: "Theta*",
        how: "A* in which the parent may be any vertex that is seen: paths at any angle.",
        paper: "Daniel 2010",
        papers: "Daniel, Nash, Koenig & Felner 2010",
        ..THETA_ON_COSTS
    },
    Capabilities {
        title: "Lazy Theta*",
        how: "Theta* that tests whether a vertex is seen only when it expands it.",
        paper: "Nash 2010",
        papers: "Nash, Koenig & Tovey 2010",
        ..THETA_ON_COSTS
    },
    Capabilities {
        title: "Anya",
        how: "Searches intervals of grid lines that a root sees: exact over N(k) and at every angle.",
        placements: &[PlacementKind::Corner],
        any: true,
        default_k: K::Any,
        grid_graph: false,
        promise: "optimal over N(k), or of all paths",
        paper: "Harabor 2016",
        papers: "Harabor, Grastien, Öz & Aksakalli 2016; over N(k) ours",
        ..SEARCH
    },
    Capabilities {
        title: "Subgoal graph",
        how: "Joins two prepared labels, lists of corners at which shortest paths turn, without a \
                  search. Where labels would take too much memory, it searches a prepared graph.",
        any: true,
        promise: "optimal over N(k), or of all paths",
        paper: "Hormazábal 2017",
        papers: "Uras, Koenig & Hernández 2013; Hormazábal, Díaz, Hernández & Baier 2017; Uras & \
                     Koenig 2018",
        ..SUBGOALS
    },
    Capabilities {
        title: "Sub-Theta*",
        how: "Theta* over a prepared subgoal graph.",
        placements: &[PlacementKind::Corner],
        guarantee: Promise::Suboptimal,
        promise: "none",
        any_angle: true,
        paper: "Uras 2015",
        papers: "Uras & Koenig 2015",
        ..SUBGOALS
    },
    Capabilities {
        title: "HPA*",
        how: "Plans over prepared clusters of the map, then refines the plan down to cells.",
        promise: "none; 0.1 to 0.5 % above the optimum by the set, in noise 1.1 %",
        paper: "Botea 2004",
        papers: "Botea, Müller & Schaeffer 2004",
        index: Some(ClusterGraph::VERSION),
        ..HIERARCHY
    },
    Capabilities {
        title: "CHPA*",
        how: "Plans checkpoints over prepared segments of the map, then searches from one to the next.",
        promise: "none; 1 to 31 % above the optimum by the set",
        paper: "Teleiša 2023",
        papers: "Teleiša & Čalnerytė 2023",
        #[cfg(feature = "publications")]
        overestimates: true,
        #[cfg(feature = "publications")]
        variants: &[Variant::Complete, Variant::Paper],
        index: Some(SegmentGraph::VERSION),
        ..HIERARCHY
    },
    Capabilities {
        title: "Landmarks (ALT)",
        how: "A* guided by the prepared distances of all vertices from a few landmarks; made for costs of cells.",
        paper: "Goldberg 2005",
        papers: "Goldberg & Harrelson 2005",
        max_k: MAX_K_ON_COSTS,
        grid_graph: false,
        costs: true,
        index: Some(LANDMARKS_VERSION),
        ..SEARCH
    },
];

impl Engine {
    /// The version of its saved index.
    ///
    /// # Errors
    /// [`SetupError::Without`] for an engine whose index is not saved.
    pub fn index_version(self) -> Result<u32, SetupError> {
        self.capabilities().index.ok_or_else(|| SetupError::without_index(self))
    }

    /// Its row in the table of engines.
    #[must_use]
    pub const fn capabilities(self) -> Capabilities {
        TABLE[self as usize]
    }
}
