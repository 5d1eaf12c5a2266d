//! One type for the planners of all engines.

use std::{fmt, sync::Arc};

use mediant_grid::Grid;
use mediant_search::{
    Counters, Guarantee, Observer, Outcome, Planner as Search, Query, QueryError, Smoothing,
    parts::HasFreeSpace,
};

use crate::{error::EngineError, index::Index, setup::Setup, shared_rules::SharedRules, space::Space};

/// A planner whose type is erased. A query costs one dynamic call; the search itself is compiled for its
/// types.
///
/// It holds the scratch memory of one thread. Planners for other threads are made of the same [`Index`].
pub struct Planner {
    planner: Box<dyn Erased + Send>,
    /// Smooths the path of an outcome; `None` for paths as they are found.
    smooth: Option<Box<dyn Fn(Outcome) -> Outcome + Send>>,
    guarantee: Guarantee,
}

/// A planner that can be `dyn`. Observers are `dyn` too, so that each search is compiled only twice: with
/// and without an observer. An observed search costs a dynamic call for each event.
trait Erased {
    /// [`Search::solve`].
    fn solve(&mut self, query: Query) -> Result<Outcome, QueryError>;

    /// [`Search::solve_observed`].
    fn solve_observed(&mut self, query: Query, observer: &mut dyn Observer) -> Result<Outcome, QueryError>;
}

impl<P: Search> Erased for P {
    fn solve(&mut self, query: Query) -> Result<Outcome, QueryError> {
        Search::solve(self, query)
    }

    fn solve_observed(
        &mut self,
        query: Query,
        mut observer: &mut dyn Observer,
    ) -> Result<Outcome, QueryError> {
        Search::solve_observed(self, query, &mut observer)
    }
}

impl Planner {
    /// A planner on a map, with a search space and an index of its own.
    ///
    /// # Errors
    /// [`EngineError`] for a setup whose parts do not fit together, or whose index cannot be made.
    pub fn new(setup: Setup, grid: &Arc<Grid>, rules: &SharedRules) -> Result<Self, EngineError> {
        Index::new(setup, &Space::new(setup, grid)?, rules)?.planner()
    }

    /// Erases the type of a planner, whose paths are returned as it finds them.
    pub(crate) fn of(planner: impl Search + Send + 'static) -> Self {
        Self { guarantee: planner.guarantee(), planner: Box::new(planner), smooth: None }
    }

    /// The same planner, with its paths smoothed in this free space.
    pub(crate) fn smoothed(
        self,
        space: Arc<impl HasFreeSpace + Send + Sync + 'static>,
        smoothing: Smoothing,
    ) -> Self {
        let smooth = move |outcome| match outcome {
            Outcome::Found(path) => Outcome::Found(smoothing.apply(space.free_space(), &path)),
            outcome => outcome,
        };
        Self { smooth: Some(Box::new(smooth)), guarantee: self.guarantee.smoothed(), ..self }
    }

    /// Answers a query.
    ///
    /// # Errors
    /// [`QueryError`] for an end that is blocked or outside the map, or where the engine gives up.
    pub fn solve(&mut self, query: Query) -> Result<Outcome, QueryError> {
        let outcome = self.planner.solve(query);
        self.finish(outcome)
    }

    /// Answers a query and reports the events of the search.
    ///
    /// # Errors
    /// Those of [`solve`](Self::solve).
    pub fn solve_observed(
        &mut self,
        query: Query,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, QueryError> {
        let outcome = self.planner.solve_observed(query, observer);
        self.finish(outcome)
    }

    /// Answers a query and counts the events of the search.
    ///
    /// # Errors
    /// Those of [`solve`](Self::solve).
    pub fn solve_counted(&mut self, query: Query) -> Result<(Outcome, Counters), QueryError> {
        let mut counters = Counters::default();
        let outcome = self.solve_observed(query, &mut counters)?;
        Ok((outcome, counters))
    }

    /// Smooths the path, if the planner smooths its paths.
    fn finish(&self, outcome: Result<Outcome, QueryError>) -> Result<Outcome, QueryError> {
        match &self.smooth {
            None => outcome,
            Some(smooth) => outcome.map(smooth),
        }
    }

    /// The guarantee of the paths.
    #[must_use]
    pub const fn guarantee(&self) -> Guarantee {
        self.guarantee
    }
}

impl fmt::Debug for Planner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Planner").field("guarantee", &self.guarantee).finish_non_exhaustive()
    }
}
