//! HPA*: the map in clusters.

mod bits;
mod build;
mod cluster_search;
mod clustering;
mod codec;
mod fixed_cost;
mod graph;
mod join;
mod level;
mod lowest;
mod planner;
mod search;
mod straighten;

/// The stage that an interrupted call names.
const DURING: &str = "joining clusters";

pub use clustering::Clustering;
pub use graph::ClusterGraph;
pub use planner::HpaStar;
