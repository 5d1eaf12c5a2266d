//! Answers queries one after the other on one warm planner.

use mediant::{Outcome, Path, Planner, Query, Vertex};

use super::{
    answer::{Found, QueryOutcome, QueryRecord, RunHead, Unanswered, ends},
    measure::Measured,
    queries::{Item, Queries},
    report::Report,
    searchers::{Searcher, Searchers},
    summary::{Summary, Tally},
    trace::TraceFile,
};
use crate::{failure::Failure, terminal::progress::Progress};

/// The queries of a run, and where their answers go.
pub(crate) struct Session<'s> {
    pub(crate) queries: &'s Queries,
    pub(crate) report: &'s mut dyn Report,
    pub(crate) progress: Progress,
    /// Where the trace of the first query goes.
    pub(crate) trace: Option<TraceFile<'s>>,
}

/// The results of a session.
pub(crate) struct Finished {
    pub(crate) summary: Summary,
    /// The first query that could not be answered, if any: its index, and why.
    pub(crate) first_error: Option<(usize, String)>,
    /// The path of the last query, for a picture; empty if there is none.
    pub(crate) path: Vec<Vertex>,
}

impl Session<'_> {
    /// Answers all queries and reports the answers.
    pub(crate) fn answer_all(
        mut self,
        searchers: &mut Searchers,
        run: &RunHead<'_>,
    ) -> Result<Finished, Failure> {
        self.report.begin(run)?;
        let mut tally = Tally::new(&run.query.wishes);
        let (mut first_error, mut path) = (None, Vec::new());
        for item in self.queries.iter() {
            let answer = self.answer(searchers.of(item.query.start), run, item)?;
            tally.add(&answer);
            if let Err(error) = &answer.outcome {
                first_error.get_or_insert_with(|| (item.index, error.to_string()));
            }
            path.clear();
            path.extend(answer.path().into_iter().flat_map(Path::waypoints));
            self.report.query(answer)?;
            self.progress.tick();
        }
        self.progress.clear();
        let summary = tally.finish();
        self.report.end(&summary)?;
        Ok(Finished { summary, first_error, path })
    }

    /// Answers one query.
    fn answer(
        &mut self,
        searcher: &mut Searcher,
        run: &RunHead<'_>,
        item: Item,
    ) -> Result<QueryRecord, Failure> {
        let Searcher { map, planner, any_angle, .. } = searcher;
        let (grid, rules) = (&*map.grid, run.setup.rules());
        let request = || run.query.request(item.query);
        if run.query.distance {
            let (Measured { counters, nanos, .. }, length) =
                Measured::distance(planner, item.query, run.repeat);
            let outcome = match length {
                Ok(Some(cost)) => {
                    let Query { start, goal, .. } = item.query;
                    let (straight, any_angle) = (start.distance(goal), shortest(any_angle, (start, goal)));
                    let found = Found::measured(cost, straight, run.guarantee, rules, any_angle);
                    Ok(QueryOutcome::Found(found))
                }
                Ok(None) => Ok(QueryOutcome::Unreachable),
                Err(error) => Err(Unanswered::new(error, map, rules.placement())),
            };
            return Ok(QueryRecord { item, request: request(), searched_by: None, outcome, counters, nanos });
        }
        let exceptions = run.query.exceptions();
        let mut other = match &exceptions {
            Some(exceptions) => planner.except(&request(), exceptions)?,
            None => None,
        };
        let searched_by = other.as_ref().map(|planner| planner.index().searched_by());
        let planner = other.as_mut().unwrap_or(planner);
        let Measured { outcome, counters, nanos } = Measured::new(planner, request, run.repeat);
        if let Some(trace) = self.trace.take() {
            trace.write((grid, rules.placement()), planner, (item.query, request()), &outcome)?;
        }
        let outcome = match outcome {
            Ok(Outcome::Found(path)) => {
                let any_angle = ends(&path).and_then(|ends| shortest(any_angle, ends));
                Ok(QueryOutcome::Found(Found::new(path, run.guarantee, rules, any_angle)))
            }
            Ok(Outcome::Nearest(path)) => Ok(QueryOutcome::Nearest(path)),
            Ok(Outcome::Stopped(stopped)) => Ok(QueryOutcome::Stopped(stopped)),
            Ok(_) => Ok(QueryOutcome::Unreachable),
            Err(error) => Err(Unanswered::new(error, map, rules.placement())),
        };
        Ok(QueryRecord { item, request: request(), searched_by, outcome, counters, nanos })
    }
}

/// The length of the shortest any-angle path between the ends of a path, with `--reference`.
fn shortest(any_angle: &mut Option<Planner>, (start, goal): (Vertex, Vertex)) -> Option<f64> {
    any_angle.as_mut()?.find(Query::new(start, goal)).ok()?.cost()
}
