//! Answering queries one after the other on one warm planner.

use std::{
    fs::File,
    hint::black_box,
    io::BufWriter,
    path,
    time::{Duration, Instant},
};

use mediant_engines::{Preprocessing, Solver, Visit};
use mediant_grid::{Centers, Corners, Grid, Placement, PlacementKind, Rules, Vertex};
use mediant_search::{Counters, Guarantee, Outcome, Path, Planner, Query, QueryError};

use crate::{
    engines::guarantee_name,
    failure::Failure,
    progress::Progress,
    queries::{Item, Queries},
    record::{QueryRecord, RunRecord, Status},
    report::Report,
    summary::{Summary, Tally},
    trace::Tracer,
};

/// The queries of a run, and who is told of the answers.
pub(crate) struct Session<'s> {
    pub(crate) queries: &'s Queries,
    pub(crate) grid: &'s Grid,
    pub(crate) rules: Rules,
    /// What finds the shortest any-angle paths to compare with.
    pub(crate) any_angle: Option<Solver>,
    /// All but what only the planner knows.
    pub(crate) run: RunRecord,
    pub(crate) report: &'s mut dyn Report,
    pub(crate) progress: Progress,
    /// What reading a saved index took.
    pub(crate) load_time: Duration,
    /// Where the search of the first query is to be written down.
    pub(crate) trace: Option<TraceFile<'s>>,
}

/// A file for a trace.
pub(crate) struct TraceFile<'s> {
    pub(crate) path: &'s path::Path,
    pub(crate) out: BufWriter<File>,
}

/// How a session ended.
pub(crate) struct Finished {
    pub(crate) summary: Summary,
    /// The first query that was an error, if any: its index and what is wrong.
    pub(crate) first_error: Option<(usize, String)>,
    /// The last path found, for a picture.
    pub(crate) path: Vec<Vertex>,
}

impl Visit for Session<'_> {
    type Output = Result<Finished, Failure>;

    fn visit<P: Planner>(self, mut planner: P, preprocessing: Preprocessing) -> Result<Finished, Failure> {
        let Self { queries, grid, rules, mut any_angle, mut run, report, mut progress, load_time, mut trace } =
            self;
        let (repeat, guarantee, placement) = (run.repeat, planner.guarantee(), rules.placement());
        run.guarantee = guarantee_name(guarantee);
        run.preprocess_ns = (load_time + preprocessing.time).as_nanos() as u64;
        run.index_bytes = preprocessing.index_bytes;
        run.levels = preprocessing.hierarchy;
        run.side = preprocessing.side;
        report.begin(run)?;
        let mut tally = Tally::default();
        let (mut first_error, mut path) = (None, Vec::new());
        for item in queries.iter() {
            let answer = Answer::new(&mut planner, item.query, repeat);
            if let Some(TraceFile { path, out }) = trace.take() {
                let tracer = Tracer::new(out, grid, placement);
                tracer
                    .and_then(|tracer| tracer.run(&mut planner, item.query, &answer.outcome))
                    .map_err(Failure::writing(path))?;
            }
            let mut record = answer.into_record(item, |error| explain(error, grid, placement));
            certify(&mut record, guarantee, rules);
            if let Some(solver) = &mut any_angle {
                compare(&mut record, solver.solve(item.query));
            }
            tally.add(&record);
            if let Some(error) = record.error.as_ref().filter(|_| first_error.is_none()) {
                first_error = Some((record.index, error.clone()));
            }
            path.clear();
            path.extend(record.path.iter().map(|&[x, y]| Vertex::new(x, y)));
            report.query(record)?;
            progress.tick();
        }
        progress.clear();
        let summary = tally.finish();
        report.end(&summary)?;
        Ok(Finished { summary, first_error, path })
    }
}

/// What a planner answers, and at what expense.
pub(crate) struct Answer {
    pub(crate) outcome: Result<Outcome, QueryError>,
    pub(crate) counters: Counters,
    /// The best time.
    pub(crate) nanos: u64,
}

impl Answer {
    /// Solves a query once, to count and to warm up, then `repeat` times against the clock, without counters.
    pub(crate) fn new<P: Planner>(planner: &mut P, query: Query, repeat: u32) -> Self {
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

    fn into_record(self, item: Item, explain: impl FnOnce(QueryError) -> String) -> QueryRecord {
        let Query { start, goal } = item.query;
        let (status, path, error) = match self.outcome {
            Ok(Outcome::Found(path)) => (Status::Found, Some(path), None),
            Ok(Outcome::Unreachable) => (Status::Unreachable, None, None),
            Err(error) => (Status::Error, None, Some(explain(error))),
        };
        let waypoints = path.as_ref().map_or(&[][..], Path::waypoints);
        QueryRecord {
            index: item.index,
            start: [start.x, start.y],
            goal: [goal.x, goal.y],
            status,
            cost: path.as_ref().map(Path::cost),
            path: waypoints.iter().map(|at| [at.x, at.y]).collect(),
            smoothness: path.as_ref().map(Path::smoothness),
            reference: item.reference,
            lower_bound: None,
            bound: None,
            any_angle: None,
            ratio: None,
            expanded: self.counters.expanded,
            generated: self.counters.generated,
            percolations: self.counters.percolations,
            updated: self.counters.updated,
            scanned: self.counters.scanned,
            fallbacks: self.counters.fallbacks,
            nanos: self.nanos,
            error,
        }
    }
}

/// Writes down what is certain of the shortest any-angle path without one.
fn certify(record: &mut QueryRecord, guarantee: Guarantee, rules: Rules) {
    let Some(cost) = record.cost else { return };
    let [start, goal] = [record.start, record.goal].map(|[x, y]| Vertex::new(x, y));
    // A sum of lengths may round below the straight line that they make up.
    let lower_bound = guarantee.lower_bound(rules, cost, start.distance(goal)).min(cost);
    record.lower_bound = Some(lower_bound);
    record.bound = Some(times(cost, lower_bound));
}

/// Writes down how the path compares with the shortest any-angle path. A query that is an error to one is to both.
fn compare(record: &mut QueryRecord, any_angle: Result<Outcome, QueryError>) {
    record.any_angle = any_angle.ok().and_then(|outcome| outcome.path().map(Path::cost));
    record.ratio = record.cost.zip(record.any_angle).map(|(cost, best)| times(cost, best));
}

/// How many times as long; once where both are nothing.
fn times(cost: f64, other: f64) -> f64 {
    if cost == other { 1.0 } else { cost / other }
}

/// A query error with, for a blocked end, a free vertex nearby.
pub(crate) fn explain(error: QueryError, grid: &Grid, placement: PlacementKind) -> String {
    match error {
        QueryError::Blocked { at, .. } => match nearest_free(grid, placement, at) {
            Some(free) => format!("{error}; the nearest one is {free}"),
            None => error.to_string(),
        },
        _ => error.to_string(),
    }
}

/// The free vertex nearest to `at`, the first in row-major order of those that tie; `None` if there is none nearby.
fn nearest_free(grid: &Grid, placement: PlacementKind, at: Vertex) -> Option<Vertex> {
    const REACH: i32 = 64;
    let is_free = |v| match placement {
        PlacementKind::Center => Centers::is_free(grid, v),
        PlacementKind::Corner => Corners::is_free(grid, v),
    };
    let around =
        (-REACH..=REACH).flat_map(|dy| (-REACH..=REACH).map(move |dx| Vertex::new(at.x + dx, at.y + dy)));
    around.filter(|&v| is_free(v)).min_by_key(|&v| at.to(v).norm_squared())
}
