//! One query, counted and timed.

use std::{hint::black_box, time::Instant};

use mediant_engines::BoxedPlanner;
use mediant_search::{Counters, Outcome, Query, QueryError};

/// The answer of a planner, and its expense.
pub(crate) struct Measured {
    pub(crate) outcome: Result<Outcome, QueryError>,
    pub(crate) counters: Counters,
    /// The best time.
    pub(crate) nanos: u64,
}

impl Measured {
    /// Solves a query once, to count and to warm up, then `repeat` times against the clock, without counters.
    pub(crate) fn new(planner: &mut BoxedPlanner, query: Query, repeat: u32) -> Self {
        let mut counters = Counters::default();
        let outcome = planner.solve_observed(query, &mut counters);
        let timed = |_| {
            let begin = Instant::now();
            let outcome = black_box(planner.solve(black_box(query)));
            let time = begin.elapsed();
            // The path is dropped after the clock has stopped.
            drop(outcome);
            time.as_nanos() as u64
        };
        let nanos = if outcome.is_ok() { (0..repeat).map(timed).min().unwrap_or(0) } else { 0 };
        Self { outcome, counters, nanos }
    }
}
