//! What both forms of a report have in common.

use std::io;

use mediant_search::{Guarantee, Smoothing};

use super::{
    answer::{Answer, Run},
    summary::Summary,
};

/// Reports a run: first the run, then its queries in order, last their summary.
pub(crate) trait Report {
    /// Reports what is run.
    fn begin(&mut self, run: &Run<'_>) -> io::Result<()>;

    /// Reports a query and its answer.
    fn query(&mut self, answer: Answer) -> io::Result<()>;

    /// Reports the summary.
    fn end(&mut self, summary: &Summary) -> io::Result<()>;
}

/// The name of a guarantee: `optimal(3)`, `at most optimal(3)`, `optimal(any)` or `suboptimal`.
pub(super) fn guarantee_name(guarantee: Guarantee) -> String {
    match guarantee {
        Guarantee::Optimal(k) => format!("optimal({k})"),
        Guarantee::AtMost(k) => format!("at most optimal({k})"),
        Guarantee::OptimalAnyAngle => "optimal(any)".to_owned(),
        Guarantee::Suboptimal => "suboptimal".to_owned(),
    }
}

/// The name of a smoothing, as `--smooth` takes it.
pub(super) const fn smoothing_name(smoothing: Smoothing) -> &'static str {
    match smoothing {
        Smoothing::Linear => "linear",
        Smoothing::Taut => "taut",
    }
}
