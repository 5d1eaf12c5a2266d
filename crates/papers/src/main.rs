//! `cargo xtask reproduce-tables`.
#![allow(clippy::print_stderr, reason = "a program talks to its user")]

use std::process::ExitCode;

use clap::Parser;
use mediant_papers::{Options, run};

/// Measure the papers' tables and figures, and write them beside the published values to docs/results
#[derive(Parser)]
#[command(name = "cargo xtask reproduce-tables", bin_name = "cargo xtask reproduce-tables")]
struct Cli {
    #[command(flatten)]
    options: Options,
}

fn main() -> ExitCode {
    match run(&Cli::parse().options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
