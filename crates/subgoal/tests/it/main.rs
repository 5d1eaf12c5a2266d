//! The tests of subgoal graphs from outside, in one program.

mod common;
mod contraction;
mod earlier;
mod exact;
mod follow;
mod identity;
mod index;
mod interrupts;
mod labels;
mod points;
mod reachability;
mod shared;
mod smoothed;
mod snapshots;
mod theta;
