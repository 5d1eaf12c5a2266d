//! The reproduction of the five papers: their tables and figures, measured by the engines of this workspace,
//! and drawn beside the published values.
//!
//! **The key decision: measuring and drawing are two steps.** An `Experiment` measures into a
//! [`Record`](mediant_report::Record), which is written as JSON and is all that its pages and figures are
//! drawn from. So pages are drawn again without measuring (`--render`), a test holds the committed pages
//! against the committed records, and a later run is compared number by number (`--check`).
//!
//! A module for each paper holds its experiments; what compares the engines beyond the papers is in
//! `engines`, `growth`, `families`, `hierarchies`, `compared`, `memory` and `central64`. Modules called
//! `pages` draw, from records alone. To add an experiment: a module with an `Experiment`, and its line in
//! `catalog`.
//!
//! Not here: the timing of queries (`mediant-bench`), records, tables and charts (`mediant-report`), and the
//! source of the maps (`mediant-sets`).
#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "the library of one program, which talks to its user"
)]

mod catalog;
mod centers;
mod central64;
mod check;
mod compared;
mod context;
mod engines;
mod error;
mod experiment;
mod explained;
mod families;
mod growth;
mod hammoud;
mod hierarchies;
mod hormazabal;
mod kramm;
mod maps;
mod memory;
mod pages;
mod plain;
mod records;
mod reproduce;
mod rivera;
mod setups;
mod side_by_side;
mod teleisa;
#[cfg(test)]
mod tests;
mod wrap;

pub use error::Error;
pub use reproduce::{Options, run, run_in};
