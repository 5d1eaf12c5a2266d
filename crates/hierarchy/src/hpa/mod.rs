//! HPA*: the map in clusters.

mod build;
mod cluster_search;
mod clustering;
mod codec;
mod fixed_cost;
mod graph;
mod level;
mod planner;
mod search;
mod straighten;

pub use clustering::Clustering;
pub use graph::ClusterGraph;
pub use planner::HpaStar;
