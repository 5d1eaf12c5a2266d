//! Answers queries one after the other on one warm planner.

use mediant::{Answer, Path, Planner, Point, PointEnds, Query};

use super::{
    answer::{EditRecord, Found, QueryAnswer, QueryRecord, RunHead, Unanswered, ends},
    measure::Measured,
    queries::{Item, Queries},
    report::Report,
    searchers::{Searcher, Searchers},
    summary::{Summary, Tally},
    timeline::{Edit, Timeline, altered},
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
    pub(crate) path: Vec<Point>,
}

impl Session<'_> {
    /// Answers all queries, follows the edits between them, and reports both.
    pub(crate) fn answer_all(
        mut self,
        searchers: &mut Searchers,
        run: &RunHead<'_>,
    ) -> Result<Finished, Failure> {
        self.report.begin(run)?;
        let mut tally = Tally::new(&run.query.wishes);
        let (mut first_error, mut path) = (None, Vec::new());
        let mut changes = Timeline::changes(self.queries.edits()).peekable();
        for (number, item) in self.queries.iter().enumerate() {
            while let Some(change) = changes.next_if(|change| change[0].after <= number) {
                self.change(searchers, change, &mut tally)?;
            }
            let record = self.answer(searchers.of(item.ends.start), run, item)?;
            tally.add(&record);
            if let Err(error) = &record.answer {
                first_error.get_or_insert_with(|| (item.index, error.to_string()));
            }
            path.clear();
            path.extend(record.path().into_iter().flat_map(Path::points));
            self.report.query(record)?;
            self.progress.tick();
        }
        for change in changes {
            self.change(searchers, change, &mut tally)?;
        }
        self.progress.clear();
        let summary = tally.finish();
        self.report.end(&summary)?;
        Ok(Finished { summary, first_error, path })
    }

    /// Follows one change of the map.
    fn change(
        &mut self,
        searchers: &mut Searchers,
        change: &[Edit],
        tally: &mut Tally,
    ) -> Result<(), Failure> {
        let altered = altered(change, &searchers.first().map);
        let is_there_already = change.iter().any(|edit| edit.initial);
        let nanos = if is_there_already { 0 } else { searchers.follow(change)?.as_nanos() as u64 };
        if !is_there_already {
            tally.add_change(change.len(), altered.iter().sum(), nanos);
        }
        for (edit, cells) in change.iter().zip(altered) {
            let nanos = if edit.more { 0 } else { nanos };
            self.report.edit(&EditRecord { edit, cells, nanos })?;
        }
        Ok(())
    }

    /// Answers one query.
    fn answer(
        &mut self,
        searcher: &mut Searcher,
        run: &RunHead<'_>,
        item: Item,
    ) -> Result<QueryRecord, Failure> {
        let Searcher { map, planner, any_angle, .. } = searcher;
        let (grid, rules, has_costs) = (&*map.grid, run.setup.rules(), map.has_costs());
        let query = || run.query.between(item.ends);
        if run.query.distance {
            let (Measured { counters, nanos, .. }, length) =
                Measured::distance(planner, item.ends, run.repeat);
            let answer = match length {
                Ok(Some(cost)) => {
                    let PointEnds { start, goal, .. } = item.ends;
                    let (straight, any_angle) = (start.distance(goal), shortest(any_angle, (start, goal)));
                    let found = Found::measured(cost, straight, (run.guarantee, rules), any_angle);
                    Ok(QueryAnswer::Found(if has_costs { found.on_costs() } else { found }))
                }
                Ok(None) => Ok(QueryAnswer::Unreachable),
                Err(error) => Err(Unanswered::new(error, map, rules.placement())),
            };
            return Ok(QueryRecord { item, query: query(), searched_by: None, answer, counters, nanos });
        }
        let exceptions = run.query.exceptions();
        let mut other = match &exceptions {
            Some(exceptions) => planner.except(&query(), exceptions)?,
            None => None,
        };
        let is_other = other.is_some();
        let planner = other.as_mut().unwrap_or(planner);
        let Measured { answer, counters, nanos } = Measured::new(planner, query, run.repeat);
        let may_differ = is_other || !planner.index().is_finished();
        let searched_by = may_differ.then(|| planner.searched_by());
        if let Some(trace) = self.trace.take() {
            trace.write((grid, rules), planner, (item.ends, query()), &answer)?;
        }
        let answer = match answer {
            Ok(Answer::Found(path)) => {
                let any_angle = ends(&path).and_then(|ends| shortest(any_angle, ends));
                let found = Found::new(path, (run.guarantee, rules), any_angle);
                Ok(QueryAnswer::Found(if has_costs { found.on_costs() } else { found }))
            }
            Ok(Answer::Nearest(path)) => Ok(QueryAnswer::Nearest(path)),
            Ok(Answer::Stopped(stopped)) => Ok(QueryAnswer::Stopped(stopped)),
            Ok(_) => Ok(QueryAnswer::Unreachable),
            Err(error) => Err(Unanswered::new(error, map, rules.placement())),
        };
        Ok(QueryRecord { item, query: query(), searched_by, answer, counters, nanos })
    }
}

/// The length of the shortest any-angle path between the ends of a path, with `--reference`.
fn shortest(any_angle: &mut Option<Planner>, (start, goal): (Point, Point)) -> Option<f64> {
    any_angle.as_mut()?.find(Query::new(start, goal)).ok()?.cost()
}
