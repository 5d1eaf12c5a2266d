//! The names of the engines.

use mediant_grid::names;

/// An engine without its options.
///
/// A name is read as people write it: capitals, hyphens and underscores do not count, `+` is `plus`, and a
/// star may be there or not.
///
/// ```
/// use mediant::{Engine, options::ConfiguredEngine};
/// assert_eq!("jps-block".parse(), Ok(Engine::JpsBlock));
/// assert_eq!(["A*", "a-star", "astar"].map(|text| text.parse().ok()), [Some(Engine::AStar); 3]);
/// assert_eq!(["JPS+", "jps_plus"].map(|text| text.parse().ok()), [Some(Engine::JpsPlus); 2]);
/// assert_eq!(Engine::JpsPlus.to_string(), "jps-plus");
/// assert_eq!(ConfiguredEngine::from(Engine::Anya), ConfiguredEngine::Anya);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Engine {
    /// [`AStar`](mediant_search::AStar).
    #[default]
    AStar,
    /// [`Dijkstra`](mediant_search::Dijkstra).
    Dijkstra,
    /// [`Wavefront`](mediant_search::Wavefront).
    Wavefront,
    /// [`Canonical`](mediant_search::Canonical); [`PaperCanonical`](mediant_search::PaperCanonical) as its
    /// variant `paper`.
    Canonical,
    /// [`Jps`](mediant_search::Jps).
    Jps,
    /// [`BlockJps`](mediant_search::BlockJps).
    JpsBlock,
    /// [`JpsPlus`](mediant_search::JpsPlus) on a [`JumpTable`](mediant_search::JumpTable).
    JpsPlus,
    /// [`ThetaStar`](mediant_search::ThetaStar).
    Theta,
    /// [`LazyThetaStar`](mediant_search::LazyThetaStar).
    LazyTheta,
    /// [`Anya`](mediant_search::Anya).
    Anya,
    /// [`SubgoalAStar`](mediant_subgoal::SubgoalAStar) on a [`SubgoalGraph`](mediant_subgoal::SubgoalGraph).
    Subgoal,
    /// [`SubgoalTheta`](mediant_subgoal::SubgoalTheta) on a [`SubgoalGraph`](mediant_subgoal::SubgoalGraph)
    /// with levels.
    SubgoalTheta,
    /// [`HpaStar`](mediant_hierarchy::HpaStar) on a [`ClusterGraph`](mediant_hierarchy::ClusterGraph).
    Hpa,
    /// [`ChpaStar`](mediant_hierarchy::ChpaStar) on a [`SegmentGraph`](mediant_hierarchy::SegmentGraph).
    Chpa,
    /// [`CostAStar`](mediant_costs::CostAStar) on [`Landmarks`](mediant_costs::Landmarks), with the feature
    /// `costs`.
    Landmarks,
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
    Landmarks => "landmarks" | "alt",
);

impl Engine {
    /// Whether this build has it: landmarks with the feature `costs`, each other one with `all-engines`.
    #[must_use]
    pub const fn is_built(self) -> bool {
        match self {
            Self::AStar | Self::Dijkstra | Self::Canonical | Self::Jps | Self::JpsBlock | Self::Anya => true,
            Self::Landmarks => cfg!(feature = "costs"),
            _ => cfg!(feature = "all-engines"),
        }
    }

    /// The engines of this build that satisfy a condition: their names, separated by commas.
    pub(crate) fn names_where(condition: impl Fn(Self) -> bool) -> String {
        let found = Self::ALL.into_iter().filter(|&kind| kind.is_built() && condition(kind));
        found.map(Self::name).collect::<Vec<_>>().join(", ")
    }
}
