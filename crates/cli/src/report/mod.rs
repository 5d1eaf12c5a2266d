//! Who is told of a run, and how.

use std::io;

use crate::{
    record::{QueryRecord, RunRecord},
    summary::Summary,
};

mod jsonl;
mod table;

pub(crate) use jsonl::Jsonl;
pub(crate) use table::TableReport;

/// Hears of a run, its queries in order, and what they came to.
pub(crate) trait Report {
    fn begin(&mut self, run: RunRecord) -> io::Result<()>;
    fn query(&mut self, query: QueryRecord) -> io::Result<()>;
    fn end(&mut self, summary: &Summary) -> io::Result<()>;
}
