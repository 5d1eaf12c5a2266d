//! A query, counted and timed.

use std::{hint::black_box, time::Instant};

use mediant::Planner;
use mediant_search::{Counters, Outcome, QueryError, Request};

/// The answer of a planner, with counts and time.
pub(crate) struct Measured {
    pub(crate) outcome: Result<Outcome, QueryError>,
    pub(crate) counters: Counters,
    /// The best time of all repetitions; 0 for errors.
    pub(crate) nanos: u64,
}

impl Measured {
    /// Answers a request once with counters, which warms the planner, then `repeat` times by the clock,
    /// without counters. Each time the request is made anew, since its deadline begins then.
    pub(crate) fn new(planner: &mut Planner, request: impl Fn() -> Request, repeat: u32) -> Self {
        let mut counters = Counters::default();
        let outcome = planner.find_observed(request(), &mut counters);
        let timed = |_| {
            let begin = Instant::now();
            let outcome = black_box(planner.find(black_box(request())));
            let time = begin.elapsed();
            // The path is freed after the clock has stopped.
            drop(outcome);
            time.as_nanos() as u64
        };
        let nanos = if outcome.is_ok() { (0..repeat).map(timed).min().unwrap_or(0) } else { 0 };
        Self { outcome, counters, nanos }
    }
}
