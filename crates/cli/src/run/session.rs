//! Answering queries one after the other on one warm planner.

use std::{fs::File, io::BufWriter, path};

use mediant_engines::BoxedPlanner;
use mediant_grid::{Centers, Corners, Grid, Placement, PlacementKind, Vertex};
use mediant_search::{Outcome, Path, QueryError};

use super::{
    answer::{Answer, Found, Run},
    measure::Measured,
    queries::{Item, Queries},
    report::Report,
    summary::{Summary, Tally},
    trace::Tracer,
};
use crate::{failure::Failure, terminal::progress::Progress};

/// The queries of a run, and who is told of the answers.
pub(crate) struct Session<'s> {
    pub(crate) queries: &'s Queries,
    /// What finds the shortest any-angle paths to compare with.
    pub(crate) any_angle: Option<BoxedPlanner>,
    pub(crate) report: &'s mut dyn Report,
    pub(crate) progress: Progress,
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

impl Session<'_> {
    /// Answers all queries.
    pub(crate) fn answer_all(
        mut self,
        planner: &mut BoxedPlanner,
        run: &Run<'_>,
    ) -> Result<Finished, Failure> {
        self.report.begin(run)?;
        let mut tally = Tally::default();
        let (mut first_error, mut path) = (None, Vec::new());
        for item in self.queries.iter() {
            let answer = self.answer(planner, run, item)?;
            tally.add(&answer);
            if let Err(error) = &answer.found {
                first_error.get_or_insert_with(|| (item.index, error.clone()));
            }
            path.clear();
            path.extend(answer.path().into_iter().flat_map(|found| found.path.waypoints()));
            self.report.query(answer)?;
            self.progress.tick();
        }
        self.progress.clear();
        let summary = tally.finish();
        self.report.end(&summary)?;
        Ok(Finished { summary, first_error, path })
    }

    fn answer(&mut self, planner: &mut BoxedPlanner, run: &Run<'_>, item: Item) -> Result<Answer, Failure> {
        let (grid, rules) = (&*run.map.grid, run.setup.rules);
        let Measured { outcome, counters, nanos } = Measured::new(planner, item.query, run.repeat);
        if let Some(TraceFile { path, out }) = self.trace.take() {
            let tracer = Tracer::new(out, grid, rules.placement());
            tracer
                .and_then(|tracer| tracer.run(planner, item.query, &outcome))
                .map_err(Failure::writing(path))?;
        }
        // A query that is an error to one planner is to both.
        let any_angle = self.any_angle.as_mut().and_then(|planner| planner.solve(item.query).ok());
        let any_angle = any_angle.and_then(|outcome| outcome.path().map(Path::cost));
        let found = match outcome {
            Ok(Outcome::Found(path)) => Ok(Some(Found::new(path, run.guarantee, rules, any_angle))),
            Ok(Outcome::Unreachable) => Ok(None),
            Err(error) => Err(explain(error, grid, rules.placement())),
        };
        Ok(Answer { item, found, counters, nanos })
    }
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
