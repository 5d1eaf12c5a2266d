//! The arguments of `mediant moves`.

use clap::Args;
use mediant_moves::FiniteK;

use super::value::{parse_any_k, parse_ratio};

#[derive(Args, Debug)]
pub(crate) struct MovesArgs {
    /// The neighborhood: 2 to 47
    #[arg(long, allow_negative_numbers = true, value_parser = parse_any_k)]
    pub(crate) k: Option<FiniteK>,
    /// Find the smallest k whose paths are at most R times as long as any-angle paths, for instance 1.01
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = parse_ratio)]
    pub(crate) ratio: Option<f64>,
}
