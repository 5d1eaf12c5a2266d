//! The names of the engines.

use crate::names::names;

/// The engines, without their options.
///
/// ```
/// use mediant_engines::{Engine, EngineKind};
/// assert_eq!("jps-block".parse(), Ok(EngineKind::JpsBlock));
/// assert_eq!(Engine::from(EngineKind::Anya), Engine::Anya);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum EngineKind {
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
    /// [`SubgoalTheta`](mediant_subgoal::SubgoalTheta) on a [`SubgoalGraph`](mediant_subgoal::SubgoalGraph) of levels.
    SubgoalTheta,
    /// [`HpaStar`](mediant_hierarchy::HpaStar) on a [`ClusterGraph`](mediant_hierarchy::ClusterGraph).
    Hpa,
    /// [`ChpaStar`](mediant_hierarchy::ChpaStar) on a [`SegmentGraph`](mediant_hierarchy::SegmentGraph).
    Chpa,
}

names!(EngineKind:
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

impl EngineKind {
    /// The names of the engines of which something holds, separated by commas.
    pub(crate) fn names_of(has: impl Fn(Self) -> bool) -> String {
        let names: Vec<&str> = Self::ALL.into_iter().filter(|&kind| has(kind)).map(Self::name).collect();
        names.join(", ")
    }
}
