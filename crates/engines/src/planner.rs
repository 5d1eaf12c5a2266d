//! Planners of any engine, in one type.

use std::{fmt, sync::Arc};

use mediant_grid::Grid;
use mediant_search::{
    Counters, Guarantee, Observer, Outcome, Planner, Query, QueryError, Smoothing, parts::HasFreeSpace,
};

use crate::{EngineError, Index, SearchSpace, Setup, SharedRules};

/// A planner whose type is erased: a query costs one dynamic call; the search in it is compiled for its types.
pub struct BoxedPlanner {
    planner: Box<dyn Erased + Send>,
    /// What smooths its paths.
    smooth: Option<Box<dyn Fn(Outcome) -> Outcome + Send>>,
    guarantee: Guarantee,
}

/// A planner behind a vtable. An observer costs a dynamic call an event, so that each search is compiled twice only: with
/// and without one.
trait Erased {
    fn solve(&mut self, query: Query) -> Result<Outcome, QueryError>;

    fn solve_observed(&mut self, query: Query, observer: &mut dyn Observer) -> Result<Outcome, QueryError>;
}

impl<P: Planner> Erased for P {
    fn solve(&mut self, query: Query) -> Result<Outcome, QueryError> {
        Planner::solve(self, query)
    }

    fn solve_observed(
        &mut self,
        query: Query,
        mut observer: &mut dyn Observer,
    ) -> Result<Outcome, QueryError> {
        Planner::solve_observed(self, query, &mut observer)
    }
}

impl BoxedPlanner {
    /// A planner on a map, with a search space and an index of its own.
    ///
    /// # Errors
    /// [`EngineError`] for a setup that does not exist.
    pub fn new(setup: Setup, grid: &Arc<Grid>, rules: &SharedRules) -> Result<Self, EngineError> {
        Index::new(setup, &SearchSpace::new(setup, grid)?, rules)?.planner()
    }

    pub(crate) fn of(planner: impl Planner + Send + 'static) -> Self {
        Self { guarantee: planner.guarantee(), planner: Box::new(planner), smooth: None }
    }

    /// Smooths the paths in a free space.
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
    /// [`QueryError`] for a query whose ends are blocked or outside the map, or at which the engine gives up.
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

impl fmt::Debug for BoxedPlanner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("BoxedPlanner").field("guarantee", &self.guarantee).finish_non_exhaustive()
    }
}
