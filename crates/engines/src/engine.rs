//! The engines, and what is to be known of each.

use mediant_grid::{Centers, Lattice};

use mediant_search::JumpTable;

use crate::names::names;

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
}

names!(Engine:
    AStar => "astar",
    Dijkstra => "dijkstra",
    Wavefront => "wavefront",
    Canonical => "canonical",
    Jps => "jps",
    JpsBlock => "jps-block",
    JpsPlus => "jps-plus",
);

/// What is to be known of an engine. Every engine works on both placements, under every rule of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct About {
    /// The largest k; the smallest is 2.
    pub max_k: u32,
    /// What it promises of its paths, for a table.
    pub guarantee: &'static str,
    /// Who published it.
    pub paper: &'static str,
    /// Whether it takes a heuristic; without one, it has none.
    pub heuristic: bool,
    /// Whether there is a variant as published beside the exact one.
    pub variant: bool,
    /// Whether its jumps may be bounded.
    pub jump_limit: bool,
    /// Whether it may keep the jump points that it otherwise passes by.
    pub intermediate: bool,
    /// Whether it finds the distances to all vertices.
    pub distances: bool,
    /// The version of its index, if what it preprocesses can be saved.
    pub index: Option<u32>,
}

impl About {
    /// A search that takes a heuristic and no other option.
    const SEARCH: Self = Self {
        max_k: Lattice::<Centers>::MAX_K,
        guarantee: "optimal(k)",
        paper: "",
        heuristic: true,
        variant: false,
        jump_limit: false,
        intermediate: false,
        distances: false,
        index: None,
    };
}

impl Engine {
    /// What is to be known of it.
    #[must_use]
    pub const fn about(self) -> About {
        let search = About::SEARCH;
        let jumps = About { intermediate: true, ..search };
        match self {
            Self::AStar => About { paper: "Hart 1968, Rivera 2017", ..search },
            Self::Dijkstra => About { paper: "Dijkstra 1959", heuristic: false, distances: true, ..search },
            Self::Wavefront => About {
                guarantee: "optimal(2)",
                paper: "Hammoud 2023",
                heuristic: false,
                distances: true,
                ..search
            },
            Self::Canonical => About { paper: "Rivera 2017", variant: true, ..search },
            Self::Jps => About { paper: "Harabor 2011, Hammoud 2023", jump_limit: true, ..jumps },
            Self::JpsBlock => About { paper: "Harabor 2014", max_k: 3, jump_limit: true, ..jumps },
            Self::JpsPlus => {
                About { paper: "Harabor 2014", max_k: JumpTable::MAX_K, index: Some(1), ..jumps }
            }
        }
    }
}
