//! CHPA*: the map in segments.

mod checkpoints;
mod codec;
mod planner;
mod search;
mod segments;

pub use planner::{ChpaStar, FallbackPolicy};
pub use segments::SegmentGraph;
