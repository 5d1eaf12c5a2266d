//! HPA*: the map in clusters.

mod codec;
mod graph;
mod level;
mod planner;
mod search;

pub use graph::{ClusterGraph, Clustering};
pub use planner::HpaStar;
