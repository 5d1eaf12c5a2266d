//! `cargo xtask guide`.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program talks to its user")]

use std::process::ExitCode;

use clap::Parser;
use mediant_guide::{GuideError, book};
use mediant_sets::root;

/// Draw the figures of the guide, and build it as a book in target/guide/book
#[derive(Parser)]
#[command(name = "cargo xtask guide", bin_name = "cargo xtask guide")]
struct Cli {
    /// Draw the figures alone
    #[arg(long)]
    figures: bool,
    /// The address of the repository's files, to which links lead that leave the book; without it those here
    #[arg(long, value_name = "URL")]
    files_at: Option<String>,
}

fn main() -> ExitCode {
    match run(&Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(cli: &Cli) -> Result<(), GuideError> {
    book::draw(&root(), false)?;
    if !cli.figures {
        let here = || format!("file://{}", root().display());
        let book = book::build(&root(), &cli.files_at.clone().unwrap_or_else(here))?;
        println!("The guide: {}", book.join("index.html").display());
    }
    Ok(())
}
