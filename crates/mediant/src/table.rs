//! Tables of distances, many to many.

use std::sync::OnceLock;

use mediant_grid::{Interrupted, Point};
use mediant_search::{Answer, End, Limits, PointEnds, Query};

use crate::{
    error::Error,
    index::Index,
    planner::Planner,
    planners::{Planners, in_order},
};

/// The lengths of the paths from several starts to several goals.
///
/// ```
/// use mediant::{Engine, K, Map, Motion};
///
/// let space = Map::from_fn(9, 9, |x, y| x == 4 && y != 8)?.space(Motion::centers(K::N8))?;
/// let table = space.prepare(Engine::Subgoal)?.table([(0, 0), (8, 0)], [(8, 0), (3, 0), (5, 1)])?;
/// assert_eq!(table.row(0)[1], 3.0);
/// assert_eq!(table.get(1, 0), Some(0.0));
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    goals: usize,
    values: Vec<f64>,
}

impl Table {
    /// The length of the path from the start with this number to the goal with that one, in cells: infinite
    /// if there is no path. `None` for numbers that no end has.
    #[must_use]
    pub fn get(&self, start: usize, goal: usize) -> Option<f64> {
        self.row(start).get(goal).copied()
    }

    /// The lengths of the paths from a start to all goals. Empty for a number that no start has.
    #[must_use]
    pub fn row(&self, start: usize) -> &[f64] {
        let row = start.checked_mul(self.goals).and_then(|first| self.values.get(first..first + self.goals));
        row.unwrap_or(&[])
    }

    /// All lengths, a row for each start.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }
}

impl Index {
    /// The lengths of the paths from each start to each goal, as the engine's planners find them: a query for
    /// each pair, or, with hub labels, far less ([`goals`](Self::goals)). With the feature `parallel` on all
    /// cores.
    ///
    /// # Errors
    /// [`Error::Query`] for the first end that is blocked or outside the map, and where the engine gives up.
    pub fn table<S: Into<Point>, G: Into<Point>>(
        &self,
        starts: impl IntoIterator<Item = S>,
        goals: impl IntoIterator<Item = G>,
    ) -> Result<Table, Error> {
        self.within(Limits::new()).table(starts, goals)
    }

    /// Of the limits only the deadline and the flag count.
    pub(crate) fn table_of(
        &self,
        starts: &[Point],
        goals: &[Point],
        limits: &Limits,
    ) -> Result<Table, Error> {
        let stop = Stop { limits, stopped: OnceLock::new() };
        for (end, ends) in [(End::Start, starts), (End::Goal, goals)] {
            ends.iter().try_for_each(|&at| self.space().check_end(end, at))?;
        }
        let columns = goals.len();
        if self.labels().is_some() && self.setup().smoothing.is_none() {
            let interrupt = limits.interrupt();
            let goals = self.goals_of(goals.to_vec(), interrupt)?;
            let planners = Planners::new(self.clone());
            let row = |row: usize| {
                stop.check()?;
                let distances =
                    planners.try_with(|planner| planner.distances_of(starts[row], &goals, interrupt));
                distances.or_else(|error| {
                    // So that the others know it.
                    stop.check()?;
                    Err(error)
                })
            };
            let rows: Result<Vec<Vec<f64>>, Error> = in_order(starts.len(), row).into_iter().collect();
            return Ok(Table { goals: columns, values: rows?.concat() });
        }
        let planners = Planners::new(self.clone());
        let count = starts.len() * columns;
        let chunk = |chunk: usize| {
            let first = chunk * Planners::CHUNK;
            planners.try_with(|planner| {
                let numbers = first..count.min(first + Planners::CHUNK);
                let ends = |index: usize| PointEnds::new(starts[index / columns], goals[index % columns]);
                numbers.map(|index| stop.length(planner, ends(index))).collect()
            })
        };
        let chunks: Result<Vec<Vec<f64>>, Error> =
            in_order(count.div_ceil(Planners::CHUNK), chunk).into_iter().collect();
        Ok(Table { goals: columns, values: chunks?.concat() })
    }
}

/// The stage that an interrupted call names.
const DURING: &str = "filling a table";

/// The limits of a table: once they have stopped one thread, the others ask no more.
struct Stop<'l> {
    limits: &'l Limits,
    stopped: OnceLock<Interrupted>,
}

impl Stop<'_> {
    fn check(&self) -> Result<(), Interrupted> {
        match self.stopped.get() {
            Some(&stopped) => Err(stopped),
            None => {
                self.limits.interrupt().check(DURING).inspect_err(|&stopped| _ = self.stopped.set(stopped))
            }
        }
    }

    /// The length of the path of a query, infinite where there is none.
    fn length(&self, planner: &mut Planner, ends: PointEnds) -> Result<f64, Error> {
        self.check()?;
        let query = match self.limits.interrupt().is_never() {
            true => Query::from(ends),
            false => Query::from(ends).within(self.limits.interrupt().clone()),
        };
        match planner.find(query)? {
            Answer::Stopped(stopped) => {
                // So that the others know it.
                self.check()?;
                Err(Error::Stopped { by: stopped.by, during: DURING })
            }
            answer => {
                let guarantee = planner.guarantee();
                Ok(answer.path().map_or(f64::INFINITY, |path| guarantee.length(path)))
            }
        }
    }
}
