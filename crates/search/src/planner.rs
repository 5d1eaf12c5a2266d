//! The contract of every engine.

use mediant_grid::Identity;

use crate::{
    observer::Observer,
    outcome::{Guarantee, Outcome},
    query::{Query, QueryError},
};

/// Answers queries, one after another, on scratch memory of its own: make one for each thread.
///
/// The map and whatever was preprocessed from it are immutable, and shared between planners. A warm planner
/// allocates nothing but the path that it returns. The same query always gives the same path and the same
/// counts.
pub trait Planner {
    /// Answers a query, watched by an observer.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError>;

    /// What is guaranteed of the paths.
    fn guarantee(&self) -> Guarantee;

    /// What the answers are for: the map, the rules of motion and k.
    fn identity(&self) -> Identity;

    /// Answers a query.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    fn solve(&mut self, query: Query) -> Result<Outcome, QueryError> {
        self.solve_observed(query, &mut ())
    }
}
