//! The two forms of a report: a table, or JSON.

use std::io;

use mediant_search::Guarantee;

use super::{
    answer::{Answer, Run},
    summary::Summary,
};

mod jsonl;
mod table;

pub(crate) use jsonl::Jsonl;
pub(crate) use table::TableReport;

/// Hears of a run, its queries in order, and their summary.
pub(crate) trait Report {
    fn begin(&mut self, run: &Run<'_>) -> io::Result<()>;
    fn query(&mut self, answer: Answer) -> io::Result<()>;
    fn end(&mut self, summary: &Summary) -> io::Result<()>;
}

/// A guarantee in a word or two: `optimal(3)`, `at most optimal(3)`, `optimal(any)`, `suboptimal`.
fn guarantee_name(guarantee: Guarantee) -> String {
    match guarantee {
        Guarantee::Optimal(k) => format!("optimal({k})"),
        Guarantee::AtMost(k) => format!("at most optimal({k})"),
        Guarantee::OptimalAnyAngle => "optimal(any)".to_owned(),
        Guarantee::Suboptimal => "suboptimal".to_owned(),
    }
}
