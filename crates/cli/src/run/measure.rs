//! A query, counted and timed.

use std::{hint::black_box, time::Instant};

use mediant::{Answer, Planner, PointEnds, Query, errors::QueryError, search::Counters};

/// The answer of a planner, with counts and time.
pub(crate) struct Measured {
    pub(crate) answer: Result<Answer, QueryError>,
    pub(crate) counters: Counters,
    /// The best time of all repetitions; 0 for errors.
    pub(crate) nanos: u64,
}

impl Measured {
    /// Answers a query once with counters, which warms the planner, then `repeat` times by the clock,
    /// without counters. Each time the query is made anew, since its deadline begins then.
    pub(crate) fn new(planner: &mut Planner, query: impl Fn() -> Query, repeat: u32) -> Self {
        let mut counters = Counters::default();
        let answer = planner.find_observed(query(), &mut counters);
        let nanos = if answer.is_ok() { best(repeat, || planner.find(black_box(query()))) } else { 0 };
        Self { answer, counters, nanos }
    }

    /// [`new`](Self::new) for the length of a path without the path: also returns that, `None` if there is no
    /// path. The counts are those of the search for the path.
    pub(crate) fn distance(
        planner: &mut Planner,
        ends: PointEnds,
        repeat: u32,
    ) -> (Self, Result<Option<f64>, QueryError>) {
        let counted = Self::new(planner, || ends.into(), 0);
        let distance = planner.distance(ends);
        let nanos = if distance.is_ok() { best(repeat, || planner.distance(black_box(ends))) } else { 0 };
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
