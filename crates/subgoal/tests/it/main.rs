//! The tests of subgoal graphs from outside, in one program.

mod common;
mod exact;
mod identity;
mod index;
mod reachability;
mod shared;
mod snapshots;
mod theta;
