//! `--format jsonl`: a JSON object a line.

use std::{
    io::{self, Write},
    time::{Duration, Instant},
};

use serde::Serialize;

use super::Report;
use crate::{
    record::{QueryRecord, RunRecord},
    screen::Screen,
    summary::Summary,
};

/// Writes each record as it comes, and seldom keeps it back: an interrupted run loses the query at hand and less than a
/// second's work.
pub(crate) struct Jsonl<'s> {
    screen: &'s mut Screen,
    /// How long a line may wait for others.
    patience: Duration,
    flushed: Instant,
}

impl<'s> Jsonl<'s> {
    /// `watched` is whether somebody looks on, for whom no line waits.
    pub(crate) fn new(screen: &'s mut Screen, watched: bool) -> Self {
        let patience = if watched { Duration::ZERO } else { Duration::from_secs(1) };
        Self { screen, patience, flushed: Instant::now() }
    }

    fn line(&mut self, record: &impl Serialize) -> io::Result<()> {
        serde_json::to_writer(&mut *self.screen, record)?;
        self.screen.write_all(b"\n")
    }

    fn flush(&mut self) -> io::Result<()> {
        self.screen.flush()?;
        self.flushed = Instant::now();
        Ok(())
    }
}

impl Report for Jsonl<'_> {
    fn begin(&mut self, run: RunRecord) -> io::Result<()> {
        self.line(&run)?;
        self.flush()
    }

    fn query(&mut self, query: QueryRecord) -> io::Result<()> {
        self.line(&query)?;
        if self.flushed.elapsed() >= self.patience { self.flush() } else { Ok(()) }
    }

    fn end(&mut self, summary: &Summary) -> io::Result<()> {
        self.line(summary)
    }
}
