//! The chores of the workspace, `cargo xtask --help`.
#![allow(clippy::print_stderr, reason = "a program talks to its user")]

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use xtask::{ci, compare, download, reproduce, tidy, verify};

/// The chores of the Mediant workspace
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Fetch the MovingAI benchmark sets into benchdata/cache, and verify them
    Download(download::Options),
    /// Compare our costs with the scenarios' optima, or with those of independent programs
    Verify(verify::Options),
    /// Time our engines beside other programs, on the same instances
    Compare(compare::Options),
    /// Measure the papers' tables and figures, and write them beside the published values to docs/results
    ReproduceTables(reproduce::Options),
    /// Check the rules of the project that the compiler does not know
    Tidy,
    /// Check all but the tests: format, lints, documentation, tidiness, the oldest supported Rust
    Ci,
}

fn main() -> ExitCode {
    let done = match Cli::parse().task {
        Task::Download(options) => download::run(&options),
        Task::Verify(options) => verify::run(&options),
        Task::Compare(options) => compare::run(&options).map_err(Into::into),
        Task::ReproduceTables(options) => reproduce::run(&options),
        Task::Tidy => tidy::run(),
        Task::Ci => ci::run(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
