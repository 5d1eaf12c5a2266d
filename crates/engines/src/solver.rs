//! Planners of any type in one list.

use std::{fmt, sync::Arc};

use mediant_grid::Grid;
use mediant_search::{Counters, Guarantee, Outcome, Planner, Query, QueryError};

use crate::{EngineError, Ground, Prebuilt, Preprocessing, Setup, Visit, with_planner, with_planner_on};

/// A planner whose type is forgotten: a query costs one dynamic call, in which the search is compiled for its types as ever.
pub struct Solver {
    planner: Box<dyn Solve + Send>,
    guarantee: Guarantee,
    preprocessing: Preprocessing,
}

trait Solve {
    fn solve(&mut self, query: Query) -> Result<Outcome, QueryError>;

    fn solve_counted(&mut self, query: Query, counters: &mut Counters) -> Result<Outcome, QueryError>;
}

impl<P: Planner> Solve for P {
    fn solve(&mut self, query: Query) -> Result<Outcome, QueryError> {
        Planner::solve(self, query)
    }

    fn solve_counted(&mut self, query: Query, counters: &mut Counters) -> Result<Outcome, QueryError> {
        self.solve_observed(query, counters)
    }
}

/// The visitor that forgets the type.
struct Forget;

impl Visit for Forget {
    type Output = Solver;

    fn visit<P: Planner + Send + 'static>(self, planner: P, preprocessing: Preprocessing) -> Solver {
        let guarantee = planner.guarantee();
        Solver { planner: Box::new(planner), guarantee, preprocessing }
    }
}

impl Solver {
    /// A solver on a map.
    ///
    /// # Errors
    /// Those of [`with_planner`].
    pub fn new(setup: Setup, grid: &Arc<Grid>, prebuilt: Prebuilt) -> Result<Self, EngineError> {
        with_planner(setup, grid, prebuilt, Forget)
    }

    /// A solver on a ground that others may use too.
    ///
    /// # Errors
    /// Those of [`with_planner_on`].
    pub fn on(setup: Setup, ground: &Ground, prebuilt: Prebuilt) -> Result<Self, EngineError> {
        with_planner_on(setup, ground, prebuilt, Forget)
    }

    /// Answers a query.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    pub fn solve(&mut self, query: Query) -> Result<Outcome, QueryError> {
        self.planner.solve(query)
    }

    /// Answers a query and counts what the search does.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    pub fn solve_counted(&mut self, query: Query) -> Result<(Outcome, Counters), QueryError> {
        let mut counters = Counters::default();
        let outcome = self.planner.solve_counted(query, &mut counters)?;
        Ok((outcome, counters))
    }

    /// What is promised of the paths.
    #[must_use]
    pub const fn guarantee(&self) -> Guarantee {
        self.guarantee
    }

    /// What was made before the first query.
    #[must_use]
    pub const fn preprocessing(&self) -> Preprocessing {
        self.preprocessing
    }
}

impl fmt::Debug for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Solver").field("guarantee", &self.guarantee).finish_non_exhaustive()
    }
}
