//! `--format jsonl`: a JSON object a line.

use std::io::{self, Write};

use serde::Serialize;

use super::Report;
use crate::{
    record::{QueryRecord, RunRecord},
    screen::Screen,
    summary::Summary,
};

/// Writes each record as it comes.
pub(crate) struct Jsonl<'s>(pub(crate) &'s mut Screen);

impl Jsonl<'_> {
    fn line(&mut self, record: &impl Serialize) -> io::Result<()> {
        serde_json::to_writer(&mut *self.0, record)?;
        self.0.write_all(b"\n")
    }
}

impl Report for Jsonl<'_> {
    fn begin(&mut self, run: RunRecord) -> io::Result<()> {
        self.line(&run)
    }

    fn query(&mut self, query: QueryRecord) -> io::Result<()> {
        self.line(&query)
    }

    fn end(&mut self, summary: &Summary) -> io::Result<()> {
        self.line(summary)
    }
}
