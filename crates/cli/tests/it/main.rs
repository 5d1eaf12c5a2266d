//! The program, run as a user would.

mod any_angle;
mod common;
mod errors;
mod hierarchy;
mod jsonl;
mod subgoal;
mod table;
mod trace;
mod wishes;
mod world;
