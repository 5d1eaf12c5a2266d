//! A query, counted and timed.

use std::{hint::black_box, time::Instant};

use mediant::{Outcome, Planner, Query, Request, errors::QueryError, search::Counters};

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
        let nanos = if outcome.is_ok() { best(repeat, || planner.find(black_box(request()))) } else { 0 };
        Self { outcome, counters, nanos }
    }

    /// [`new`](Self::new) for the length of a path without the path: also returns that, `None` if there is no
    /// path. The counts are those of the search for the path.
    pub(crate) fn distance(
        planner: &mut Planner,
        query: Query,
        repeat: u32,
    ) -> (Self, Result<Option<f64>, QueryError>) {
        let counted = Self::new(planner, || query.into(), 0);
        let distance = planner.distance(query);
        let nanos = if distance.is_ok() { best(repeat, || planner.distance(black_box(query))) } else { 0 };
        (Self { nanos, ..counted }, distance)
    }
}

/// The best time of some runs.
fn best<T>(repeat: u32, mut run: impl FnMut() -> T) -> u64 {
    let timed = |_| {
        let begin = Instant::now();
        let answer = black_box(run());
        let time = begin.elapsed();
        // The answer is freed after the clock has stopped.
        drop(answer);
        time.as_nanos() as u64
    };
    (0..repeat).map(timed).min().unwrap_or(0)
}
