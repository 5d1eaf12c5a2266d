//! The chores of the workspace: what `cargo xtask` does.
//!
//! **The key decision: chores are Rust, and tested as such.** No shell script, so that they run on every system that Rust
//! runs on; and the rules of `tidy` are an ordinary test as well.
//!
//! A further chore is a module here, a variant of `Task` in `main.rs`, and the line that calls it.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program talks to its user")]

mod archive;
pub mod ci;
pub mod compare;
pub mod download;
mod error;
mod fetch;
pub mod manifest;
pub mod project;
pub mod reproduce;
pub mod tidy;
pub mod verify;

pub use error::Error;
pub use fetch::Source;
