//! The data of a report: the head of a run, and a record for each query.

use std::{fmt, time::Duration};

use mediant::{
    Choice, Engine, ErrorCode, Guarantee, Path, PlacementKind, Point, Query, Rules, Setup, Stopped,
    errors::QueryError,
    options::{EngineOption, OptionValue},
    search::Counters,
};

use super::{queries::Item, query_error::explain, timeline::Edit};
use crate::{args::QueryArgs, map::NamedMap};

/// The head of a run: the map, the setup, and the time and memory of its preparation.
pub(crate) struct RunHead<'r> {
    pub(crate) map: &'r NamedMap,
    /// The scenario's file name.
    pub(crate) scenario: Option<&'r str>,
    /// The number of queries.
    pub(crate) queries: usize,
    /// The number of edits; `None` on a map that does not change.
    pub(crate) edits: Option<usize>,
    pub(crate) query: &'r QueryArgs,
    pub(crate) setup: Setup,
    /// The choice of `auto`; `None` for an engine that was named.
    pub(crate) choice: Option<Choice>,
    /// The engine that searches: the setup's, or another one where subgoals would be slow.
    pub(crate) searched_by: Engine,
    /// All options of the catalog, each with its value if the engine has one.
    pub(crate) options: Vec<(&'static EngineOption, Option<OptionValue>)>,
    pub(crate) guarantee: Guarantee,
    /// The engine of `--reference`, which finds the shortest any-angle paths to compare with.
    pub(crate) reference: Option<Engine>,
    /// The number of times that each query is timed.
    pub(crate) repeat: u32,
    /// Whether each query is answered on the ground of its start.
    pub(crate) grounds: bool,
    /// The time to prepare the search space, and to prepare or load the index.
    pub(crate) preparation: Duration,
    /// The memory of the search space and the index, beyond the map.
    pub(crate) memory_bytes: u64,
}

/// An edit with its time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EditRecord<'r> {
    pub(crate) edit: &'r Edit,
    /// The number of cells that it altered.
    pub(crate) cells: u64,
    /// The time of the change that it ends: of the map, the search space, the index and the planner. 0 if
    /// more edits belong to it, and for the map that the run begins with.
    pub(crate) nanos: u64,
}

/// A query with its answer.
#[derive(Clone, Debug)]
pub(crate) struct QueryRecord {
    pub(crate) item: Item,
    /// The query, with all ends, wishes and limits.
    pub(crate) query: Query,
    /// The engine that answered, where it need not be the run's: cells count otherwise for the query, or the
    /// index is not finished after an edit.
    pub(crate) searched_by: Option<Engine>,
    /// The answer, or why the query cannot be answered.
    pub(crate) answer: Result<QueryAnswer, Unanswered>,
    pub(crate) counters: Counters,
    /// The time of the query alone on a warm planner, the best of all repetitions; 0 for errors.
    pub(crate) nanos: u64,
}

/// Why a query cannot be answered.
#[derive(Clone, Debug)]
pub(crate) struct Unanswered {
    /// In words.
    pub(crate) text: String,
    /// The library's code.
    pub(crate) code: ErrorCode,
}

impl Unanswered {
    /// The error of a query on a map.
    pub(crate) fn new(error: QueryError, map: &NamedMap, placement: PlacementKind) -> Self {
        Self { code: mediant::Error::from(error).code(), text: explain(error, map, placement) }
    }
}

impl fmt::Display for Unanswered {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// The outcome of a query that could be answered.
#[derive(Clone, Debug)]
pub(crate) enum QueryAnswer {
    Found(Found),
    /// There is no path; this one leads to the nearest vertex that can be reached.
    Nearest(Path),
    Unreachable,
    Stopped(Stopped),
}

/// A path, and what is known of the shortest any-angle path between its ends under the same rules.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    /// `None` if only its length was asked for.
    pub(crate) path: Option<Path>,
    /// Its length, in cells; where cells have costs its cost.
    pub(crate) cost: f64,
    /// The certificate: no any-angle path is shorter than this, by the engine's guarantee and by the straight
    /// line.
    /// `None` on costs, where there is none.
    pub(crate) lower_bound: Option<f64>,
    /// The length of the shortest any-angle path, with `--reference`.
    pub(crate) any_angle: Option<f64>,
}

impl QueryRecord {
    /// The path that was asked for, if it was found.
    pub(crate) const fn found(&self) -> Option<&Found> {
        match &self.answer {
            Ok(QueryAnswer::Found(found)) => Some(found),
            _ => None,
        }
    }

    /// The outcome in a word, for scripts.
    pub(crate) const fn status(&self) -> &'static str {
        match &self.answer {
            Ok(QueryAnswer::Found(_)) => "found",
            Ok(QueryAnswer::Nearest(_)) => "nearest",
            Ok(QueryAnswer::Unreachable) => "unreachable",
            Ok(QueryAnswer::Stopped(_)) => "stopped",
            Err(_) => "error",
        }
    }

    /// The path, if there is one: that of a stopped search is the best so far.
    pub(crate) const fn path(&self) -> Option<&Path> {
        match &self.answer {
            Ok(QueryAnswer::Found(found)) => found.path.as_ref(),
            Ok(QueryAnswer::Nearest(path)) => Some(path),
            Ok(QueryAnswer::Stopped(stopped)) => Some(&stopped.best),
            Ok(QueryAnswer::Unreachable) | Err(_) => None,
        }
    }

    /// The length of the path, if there is one.
    pub(crate) fn cost(&self) -> Option<f64> {
        self.found().map(|found| found.cost).or_else(|| self.path().map(Path::cost))
    }

    /// The start and the goal: of a path that was found its ends, else those of the query.
    pub(crate) fn ends(&self) -> (Point, Point) {
        let found = self.found().and_then(|found| ends(found.path.as_ref()?));
        found.unwrap_or((self.item.ends.start, self.item.ends.goal))
    }
}

impl Found {
    /// Adds the certificate, which follows from the path and the guarantee of its engine.
    pub(crate) fn new(path: Path, (guarantee, rules): (Guarantee, Rules), any_angle: Option<f64>) -> Self {
        let straight = ends(&path).map_or(0.0, |(start, goal)| start.distance(goal));
        let measured = Self::measured(path.cost(), straight, (guarantee, rules), any_angle);
        Self { path: Some(path), ..measured }
    }

    /// A path of which only the length is known, and the straight line between its ends.
    pub(crate) fn measured(
        cost: f64,
        straight: f64,
        (guarantee, rules): (Guarantee, Rules),
        any_angle: Option<f64>,
    ) -> Self {
        // The rounded sum of a straight path's parts may be less than the straight line.
        let lower_bound = guarantee.lower_bound(rules, cost, straight).min(cost);
        Self { path: None, cost, lower_bound: Some(lower_bound), any_angle }
    }

    /// The same path on costs, where nothing is known of paths at any angle.
    pub(crate) fn on_costs(self) -> Self {
        Self { lower_bound: None, ..self }
    }

    /// The path is at most this many times as long as the shortest any-angle path; at least 1.
    pub(crate) fn bound(&self) -> Option<f64> {
        self.lower_bound.map(|least| ratio(self.cost, least))
    }

    /// The path is this many times as long as the shortest any-angle path.
    pub(crate) fn ratio(&self) -> Option<f64> {
        self.any_angle.map(|best| ratio(self.cost, best))
    }
}

/// The ends of a path.
pub(crate) fn ends(path: &Path) -> Option<(Point, Point)> {
    path.start().zip(path.goal())
}

/// The ratio of two lengths; 1 if both are 0.
fn ratio(cost: f64, other: f64) -> f64 {
    if cost == other { 1.0 } else { cost / other }
}
