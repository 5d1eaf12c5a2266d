//! The engines, and what is to be known of each.

use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, GridGraph, PlacementKind, Rules};
use mediant_hierarchy::{ClusterGraph, SegmentGraph};
use mediant_moves::{FiniteK, K};
use mediant_search::JumpTable;
use mediant_subgoal::SubgoalGraph;

use crate::{Variant, names::names};

/// Every engine that there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Engine {
    /// [`AStar`](mediant_search::AStar).
    #[default]
    AStar,
    /// [`Dijkstra`](mediant_search::Dijkstra).
    Dijkstra,
    /// [`Wavefront`](mediant_search::Wavefront).
    Wavefront,
    /// [`Canonical`](mediant_search::Canonical), and [`PaperCanonical`](mediant_search::PaperCanonical) as its variant.
    Canonical,
    /// [`Jps`](mediant_search::Jps).
    Jps,
    /// [`BlockJps`](mediant_search::BlockJps).
    JpsBlock,
    /// [`JpsPlus`](mediant_search::JpsPlus) on a [`JumpTable`].
    JpsPlus,
    /// [`ThetaStar`](mediant_search::ThetaStar).
    Theta,
    /// [`LazyThetaStar`](mediant_search::LazyThetaStar).
    LazyTheta,
    /// [`Anya`](mediant_search::Anya).
    Anya,
    /// [`SubgoalAStar`](mediant_subgoal::SubgoalAStar) on a [`SubgoalGraph`].
    Subgoal,
    /// [`SubgoalTheta`](mediant_subgoal::SubgoalTheta) on a [`SubgoalGraph`] of levels.
    SubgoalTheta,
    /// [`HpaStar`](mediant_hierarchy::HpaStar) on a [`ClusterGraph`].
    Hpa,
    /// [`ChpaStar`](mediant_hierarchy::ChpaStar) on a [`SegmentGraph`].
    Chpa,
}

names!(Engine:
    AStar => "astar",
    Dijkstra => "dijkstra",
    Wavefront => "wavefront",
    Canonical => "canonical",
    Jps => "jps",
    JpsBlock => "jps-block",
    JpsPlus => "jps-plus",
    Theta => "theta",
    LazyTheta => "lazy-theta",
    Anya => "anya",
    Subgoal => "subgoal",
    SubgoalTheta => "subgoal-theta",
    Hpa => "hpa",
    Chpa => "chpa",
);

/// What is to be known of an engine. On the placements that it takes it works under every rule of motion, but for
/// [`Engine::Subgoal`], [`Engine::Hpa`] and [`Engine::Chpa`] at centers ([`Setup::check`](crate::Setup::check)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct About {
    /// Where its vertices may be.
    pub placements: &'static [PlacementKind],
    /// The largest k of the neighborhoods that it searches, the smallest being 2; none for an engine that searches none.
    pub max_k: Option<u32>,
    /// Whether it searches every direction, k = ∞.
    pub any: bool,
    /// What it promises of its paths, for a table; `optimal(k)` with k = any is of all paths.
    pub guarantee: &'static str,
    /// Who published it.
    pub paper: &'static str,
    /// Whether it takes a heuristic.
    pub heuristic: bool,
    /// Whether a heuristic that overestimates does no harm but that its paths are longer.
    pub overestimates: bool,
    /// Its variants, the default first; none of an engine with one alone.
    pub variants: &'static [Variant],
    /// Whether its jumps may be bounded.
    pub jump_limit: bool,
    /// Whether it may keep the jump points that it otherwise passes by.
    pub intermediate: bool,
    /// Whether what it preprocesses may have levels.
    pub levels: bool,
    /// Whether it cuts the map into squares whose side may be chosen.
    pub side: bool,
    /// Whether the paths that it refines are straightened, unless that is left.
    pub straightens: bool,
    /// Whether it searches in two phases: among segments for a plan, whose checkpoints a second one visits.
    pub phases: bool,
    /// Whether it finds the distances to all vertices.
    pub distances: bool,
    /// The version of its index, if what it preprocesses can be saved.
    pub index: Option<u32>,
}

impl About {
    /// A search that takes a heuristic and no other option.
    const SEARCH: Self = Self {
        placements: &[PlacementKind::Center, PlacementKind::Corner],
        max_k: Some(GridGraph::<Centers>::MAX_K),
        any: false,
        guarantee: "optimal(k)",
        paper: "",
        heuristic: true,
        overestimates: false,
        variants: &[],
        jump_limit: false,
        intermediate: false,
        levels: false,
        side: false,
        straightens: false,
        phases: false,
        distances: false,
        index: None,
    };

    /// The k that is meant where none is said: 3, or ∞ of an engine that searches nothing else.
    #[must_use]
    pub const fn default_k(self) -> K {
        if self.max_k.is_some() { K::Finite(FiniteK::N8) } else { K::Any }
    }

    /// The rules that are meant where none are said: `never` at centers, or `open` where there are only corners, which is of an engine that
    /// takes nothing else, and of every direction.
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
    /// What is to be known of it.
    #[must_use]
    pub const fn about(self) -> About {
        let search = About::SEARCH;
        let jumps = About { intermediate: true, ..search };
        let theta = About { guarantee: "suboptimal", ..search };
        let index = Some(SubgoalGraph::<Corners>::VERSION);
        let subgoals = About { heuristic: false, levels: true, index, ..search };
        let squares = About {
            placements: &[PlacementKind::Center],
            max_k: Some(3),
            guarantee: "suboptimal",
            side: true,
            ..search
        };
        match self {
            Self::AStar => About { paper: "Hart 1968, Rivera 2017", overestimates: true, ..search },
            Self::Dijkstra => About { paper: "Dijkstra 1959", heuristic: false, distances: true, ..search },
            Self::Wavefront => About {
                guarantee: "optimal(2)",
                paper: "Hammoud 2023",
                heuristic: false,
                distances: true,
                ..search
            },
            Self::Canonical => {
                About { paper: "Rivera 2017", variants: &[Variant::Exact, Variant::Paper], ..search }
            }
            Self::Jps => About { paper: "Harabor 2011, Hammoud 2023", jump_limit: true, ..jumps },
            Self::JpsBlock => About { paper: "Harabor 2014", max_k: Some(3), jump_limit: true, ..jumps },
            Self::JpsPlus => {
                About { paper: "Harabor 2014", max_k: Some(JumpTable::MAX_K), index: Some(1), ..jumps }
            }
            Self::Theta => About { paper: "Daniel 2010", ..theta },
            Self::LazyTheta => About { paper: "Nash 2010", ..theta },
            Self::Anya => About {
                placements: &[PlacementKind::Corner],
                max_k: None,
                any: true,
                guarantee: "optimal(any)",
                paper: "Harabor 2016",
                heuristic: false,
                ..search
            },
            Self::Subgoal => About { any: true, paper: "Hormazábal 2017", ..subgoals },
            Self::SubgoalTheta => About {
                placements: &[PlacementKind::Corner],
                guarantee: "suboptimal",
                paper: "Uras 2015",
                ..subgoals
            },
            Self::Hpa => About {
                paper: "Botea 2004",
                heuristic: false,
                levels: true,
                straightens: true,
                index: Some(ClusterGraph::VERSION),
                ..squares
            },
            Self::Chpa => About {
                paper: "Teleiša 2023",
                overestimates: true,
                variants: &[Variant::Complete, Variant::Paper],
                phases: true,
                index: Some(SegmentGraph::VERSION),
                ..squares
            },
        }
    }
}
