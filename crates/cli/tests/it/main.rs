//! The program, run as a user would.

mod any_angle;
mod auto;
mod calls;
mod changing;
mod changing_costs;
mod check;
mod common;
mod convert;
mod costs;
mod edits;
mod errors;
mod grounds;
mod guide;
mod hierarchy;
mod jsonl;
mod many;
mod outputs;
mod pairs;
mod reach;
mod subgoal;
mod table;
mod trace;
mod walking;
mod wishes;
mod words;
mod world;
