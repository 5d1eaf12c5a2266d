//! The arguments of `mediant moves`.

use clap::Args;
use mediant::FiniteK;

use super::value::{parse_any_k, parse_any_neighbors, parse_ratio};

#[derive(Args, Debug)]
pub(crate) struct MovesArgs {
    /// The neighborhood, of 2^k moves: k = 3 has 8, k = 8 has 256. From 2 to 47
    #[arg(long, allow_negative_numbers = true, value_parser = parse_any_k)]
    k: Option<FiniteK>,
    /// The neighborhood by its number of moves, instead of --k: 4, 8, 16, …
    #[arg(long, value_name = "N", conflicts_with = "k")]
    #[arg(allow_negative_numbers = true, value_parser = parse_any_neighbors)]
    neighbors: Option<FiniteK>,
    /// Find the smallest k whose paths are at most R times as long as any-angle paths, for instance 1.01
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = parse_ratio)]
    pub(crate) ratio: Option<f64>,
}

impl MovesArgs {
    /// The k that was given, in one way or the other.
    pub(crate) fn k(&self) -> Option<FiniteK> {
        self.k.or(self.neighbors)
    }
}
