//! A task without a clock: just its costs.

use std::sync::Arc;

use mediant_grid::{Centers, Corners, Grid, Lattice, Place, Rules};
use mediant_moves::KError;
use mediant_search::{AStar, LatticeDistance, Planner, Query, QueryError};

use crate::{Engine, Task};

impl Task {
    /// Calls `each` with the cost of every query, in their order: `None` where there is no path, an error where an end of
    /// the query is blocked or outside the map.
    ///
    /// # Errors
    /// [`KError`] when k is out of the engine's range.
    pub fn solve_all(
        self,
        grid: &Arc<Grid>,
        queries: impl IntoIterator<Item = Query>,
        each: impl FnMut(Result<Option<f64>, QueryError>),
    ) -> Result<(), KError> {
        match self.rules {
            Rules::Center(rule) => {
                self.solve_on(&Lattice::<Centers>::new(Arc::clone(grid), self.k, rule)?, queries, each);
            }
            Rules::Corner(gap) => {
                self.solve_on(&Lattice::<Corners>::new(Arc::clone(grid), self.k, gap)?, queries, each);
            }
        }
        Ok(())
    }

    fn solve_on<P: Place>(
        self,
        lattice: &Lattice<P>,
        queries: impl IntoIterator<Item = Query>,
        mut each: impl FnMut(Result<Option<f64>, QueryError>),
    ) {
        let mut planner = match self.engine {
            Engine::AStar => AStar::new(lattice, LatticeDistance),
        };
        for query in queries {
            each(planner.solve(query).map(|outcome| outcome.path().map(mediant_search::Path::cost)));
        }
    }
}
