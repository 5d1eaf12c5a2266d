//! The chores of the workspace: what `cargo xtask` does.
//!
//! **The key decision: chores are Rust, and thin.** No shell script, so that they run on every system that
//! Rust runs on; and no engine, so that `cargo xtask tidy` compiles none. `download`, `tidy`, `package`,
//! `release`, `web`, `c`, `gppc`, `fuzz`, `mutants` and `ci` are modules here; the rules of `tidy` are an
//! ordinary test as well. `verify`, `prove`, `soak`, `compare` and `reproduce-tables` run engines: they are
//! programs of `mediant-bench` and `mediant-papers`, to which [`program`] hands all arguments on.
//!
//! A further chore is a variant of `Task` in `main.rs` and the line that calls it; if it runs an engine, it
//! is a program of the crate that it belongs to.
#![allow(clippy::print_stdout, reason = "a program talks to its user")]

pub mod c;
pub mod ci;
pub mod describe;
pub mod download;
mod error;
pub mod fuzz;
pub mod gppc;
pub mod mutants;
pub mod package;
pub mod program;
pub mod project;
pub mod release;
pub mod tidy;
mod tree;
pub mod web;

pub use error::Error;
pub use tree::Tree;
