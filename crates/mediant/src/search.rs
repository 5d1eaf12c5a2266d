//! Searches watched and counted, progress, and rarer answers.

pub use mediant_search::{Counters, End, NodeEvent, Observer, Turn};
pub use mediant_subgoal::{Progress, Stage};

#[cfg(feature = "trace")]
pub use crate::trace::Tracer;
pub use crate::{
    agent::WidestPath, exceptions::ExceptedAnswer, field::Fields, motion::IntoK, planners::BatchProgress,
};
