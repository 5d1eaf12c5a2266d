//! The program's readers of paths, pairs and timelines, for a fuzzing target.
//!
//! **The key decision: the sources of `crates/cli` are compiled again, as modules of this package.** That
//! package is a program, and no other program links it.

// Its commands are not called here.
#![allow(dead_code, unused_imports, reason = "the program has more than its readers")]

#[path = "../../../cli/src/args/mod.rs"]
mod args;
#[path = "../../../cli/src/builtin.rs"]
mod builtin;
#[path = "../../../cli/src/check/mod.rs"]
mod check;
#[path = "../../../cli/src/commands/mod.rs"]
mod commands;
#[path = "../../../cli/src/draw/mod.rs"]
mod draw;
#[path = "../../../cli/src/edit.rs"]
mod edit;
#[path = "../../../cli/src/failure.rs"]
mod failure;
#[path = "../../../cli/src/map/mod.rs"]
mod map;
mod readers;
#[path = "../../../cli/src/run/mod.rs"]
mod run;
#[path = "../../../cli/src/terminal/mod.rs"]
mod terminal;
#[path = "../../../cli/src/write/mod.rs"]
mod write;

pub use readers::read;
