//! The chores of the workspace, `cargo xtask --help`.
#![allow(clippy::print_stderr, reason = "a program talks to its user")]

use std::{ffi::OsString, process::ExitCode};

use clap::{Args, Parser, Subcommand};
use xtask::{
    c, ci, describe, download, fuzz, gppc, mutants, package,
    program::{COMPARE, GUIDE, PROVE, REPRODUCE, SOAK, VERIFY},
    release, tidy, web,
};

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
    Verify(HandedOn),
    /// Ask every exact engine every public instance, and try laws that need no known cost
    Prove(HandedOn),
    /// Time our engines beside other programs, on the same instances
    Compare(HandedOn),
    /// Run all engines in one process for a long time, on maps that change, and compare them
    Soak(HandedOn),
    /// Measure the papers' tables and figures, and write them beside the published values to docs/results
    ReproduceTables(HandedOn),
    /// Draw the figures of the guide, and build it by mdBook
    Guide(HandedOn),
    /// Write what every language says of calls and engines, from the library's description of itself
    Describe,
    /// Check the rules of the project that the compiler does not know
    Tidy,
    /// Check all but the tests: format, lints, documentation, tidiness, the oldest supported Rust
    Ci,
    /// Package the published crates, and compile them in an empty folder from their packages alone
    Package,
    /// Make the files of all packages, install each in an empty folder, and run its first example
    Release(release::Options),
    /// Build the entries of the Grid-Based Path Planning Competition, as its kits take them
    Gppc(gppc::Options),
    /// Build the npm package and the page that shows it: target/web/package and target/web/page
    Web(web::Options),
    /// Fuzz what reads bytes and answers questions, by libFuzzer, and add up what ran
    Fuzz(fuzz::Options),
    /// Change the code in small ways, and see whether the tests notice
    Mutants(mutants::Options),
    /// Install the library for C: libmediant, mediant.h and mediant.hpp, for pkg-config and CMake
    C(c::Options),
}

/// Arguments that another program reads, `--help` among them.
#[derive(Args)]
#[command(disable_help_flag = true)]
struct HandedOn {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "OPTION")]
    arguments: Vec<OsString>,
}

fn main() -> ExitCode {
    let done = |()| ExitCode::SUCCESS;
    let outcome = match Cli::parse().task {
        Task::Download(options) => download::run(&options).map(done),
        Task::Verify(options) => VERIFY.run(&options.arguments),
        Task::Prove(options) => PROVE.run(&options.arguments),
        Task::Compare(options) => COMPARE.run(&options.arguments),
        Task::Soak(options) => SOAK.run(&options.arguments),
        Task::ReproduceTables(options) => REPRODUCE.run(&options.arguments),
        Task::Guide(options) => GUIDE.run(&options.arguments),
        Task::Describe => describe::run().map(done),
        Task::Tidy => tidy::run().map(done),
        Task::Ci => ci::run().map(done),
        Task::Package => package::run().map(done),
        Task::Release(options) => release::run(&options).map(done),
        Task::Gppc(options) => gppc::run(&options).map(done),
        Task::Web(options) => web::run(options).map(done),
        Task::Fuzz(options) => fuzz::run(&options).map(done),
        Task::Mutants(options) => mutants::run(&options).map(done),
        Task::C(options) => c::run(&options).map(done),
    };
    outcome.unwrap_or_else(|error| {
        eprintln!("error: {error}");
        ExitCode::FAILURE
    })
}
