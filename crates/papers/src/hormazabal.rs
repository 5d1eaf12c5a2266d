//! Hormazábal, Díaz, Hernández & Baier 2017: subgoal graphs over N(k), and h_k by iteration.

mod branching;
mod distance;
mod planners;

pub(super) use branching::BRANCHING;
pub(super) use distance::DISTANCE;
pub(super) use planners::PLANNERS;

/// The paper's range of k, as far as the text tells it.
const KS: std::ops::RangeInclusive<u32> = 3..=9;
