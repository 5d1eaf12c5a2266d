//! CHPA*: the map in segments.

mod codec;
mod planner;
mod segments;

pub use planner::{ChpaStar, FallbackPolicy};
pub use segments::SegmentGraph;
