//! What each engine can do.

use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, GridGraph, PlacementKind, Rules};
use mediant_hierarchy::{ClusterGraph, SegmentGraph};
use mediant_moves::K;
use mediant_search::JumpTable;
use mediant_subgoal::SubgoalGraph;

use crate::{engine::Engine, option::Variant, setup_error::SetupError};

/// What an engine can do, whatever its options.
///
/// An engine works under every rule of motion of the placements that it takes, with one exception: subgoal
/// graphs and hierarchies at centers ([`Setup::check`](crate::Setup::check)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capabilities {
    /// The placements that it takes.
    pub placements: &'static [PlacementKind],
    /// The largest finite k that it takes; the smallest is 2.
    pub max_k: u32,
    /// Whether it takes k = ∞.
    pub any: bool,
    /// The k that it searches over where none is chosen: 3, but ∞ for Anya.
    pub default_k: K,
    /// Whether it searches the grid graph, rather than the free space alone.
    pub grid_graph: bool,
    /// Its guarantee, for a table. `optimal(k)` at k = ∞ means that no legal path is shorter.
    pub guarantee: &'static str,
    /// Its paper: first author and year.
    pub paper: &'static str,
    /// Whether it takes a heuristic that overestimates. Its paths may then be longer; nothing else goes
    /// wrong.
    pub overestimates: bool,
    /// Its variants, the default first; empty for an engine that has only one.
    pub variants: &'static [Variant],
    /// Whether it finds the distances from one vertex to all others.
    pub distances: bool,
    /// The version of its saved index; `None` for an engine whose index is not saved.
    pub index: Option<u32>,
}

impl Capabilities {
    /// A search that is optimal over N(k) and has no saved index.
    const SEARCH: Self = Self {
        placements: &[PlacementKind::Center, PlacementKind::Corner],
        max_k: GridGraph::<Centers>::MAX_K,
        any: false,
        default_k: K::N8,
        grid_graph: true,
        guarantee: "optimal(k)",
        paper: "",
        overestimates: false,
        variants: &[],
        distances: false,
        index: None,
    };

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

impl Engine {
    /// The version of its saved index.
    ///
    /// # Errors
    /// [`SetupError::Without`] for an engine whose index is not saved.
    pub fn index_version(self) -> Result<u32, SetupError> {
        self.capabilities().index.ok_or_else(|| SetupError::without_index(self))
    }

    /// What the engine can do.
    #[must_use]
    pub const fn capabilities(self) -> Capabilities {
        let search = Capabilities::SEARCH;
        let theta = Capabilities { guarantee: "suboptimal", ..search };
        let subgoals =
            Capabilities { grid_graph: false, index: Some(SubgoalGraph::<Corners>::VERSION), ..search };
        let hierarchy = Capabilities {
            placements: &[PlacementKind::Center],
            max_k: 3,
            guarantee: "suboptimal",
            ..search
        };
        match self {
            Self::AStar => Capabilities { paper: "Hart 1968, Rivera 2017", overestimates: true, ..search },
            Self::Dijkstra => Capabilities { paper: "Dijkstra 1959", distances: true, ..search },
            Self::Wavefront => {
                Capabilities { guarantee: "optimal(2)", paper: "Hammoud 2023", distances: true, ..search }
            }
            Self::Canonical => {
                Capabilities { paper: "Rivera 2017", variants: &[Variant::Exact, Variant::Paper], ..search }
            }
            Self::Jps => Capabilities { paper: "Harabor 2011, Hammoud 2023", ..search },
            Self::JpsBlock => Capabilities { paper: "Harabor 2014", max_k: 3, ..search },
            Self::JpsPlus => Capabilities {
                paper: "Harabor 2014",
                max_k: JumpTable::MAX_K,
                index: Some(JumpTable::VERSION),
                ..search
            },
            Self::Theta => Capabilities { paper: "Daniel 2010", ..theta },
            Self::LazyTheta => Capabilities { paper: "Nash 2010", ..theta },
            Self::Anya => Capabilities {
                placements: &[PlacementKind::Corner],
                any: true,
                default_k: K::Any,
                grid_graph: false,
                paper: "Harabor 2016",
                ..search
            },
            Self::Subgoal => Capabilities { any: true, paper: "Hormazábal 2017", ..subgoals },
            Self::SubgoalTheta => Capabilities {
                placements: &[PlacementKind::Corner],
                guarantee: "suboptimal",
                paper: "Uras 2015",
                ..subgoals
            },
            Self::Hpa => {
                Capabilities { paper: "Botea 2004", index: Some(ClusterGraph::VERSION), ..hierarchy }
            }
            Self::Chpa => Capabilities {
                paper: "Teleiša 2023",
                overestimates: true,
                variants: &[Variant::Complete, Variant::Paper],
                index: Some(SegmentGraph::VERSION),
                ..hierarchy
            },
        }
    }
}
