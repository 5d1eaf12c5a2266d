//! The contract of every engine.

use crate::{Guarantee, Observer, Outcome, Query, QueryError};

/// Answers queries, one after the other, on scratch memory that it keeps: make one for each thread.
///
/// The map and whatever was preprocessed from it are shared and immutable; a planner borrows them. Once it is warm, a
/// query allocates nothing but the path that it returns. The same query always gives the same path and the same counts.
pub trait Planner {
    /// Answers a query and tells the observer what it does.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError>;

    /// What is promised of the paths.
    fn guarantee(&self) -> Guarantee;

    /// Answers a query.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    fn solve(&mut self, query: Query) -> Result<Outcome, QueryError> {
        self.solve_observed(query, &mut ())
    }
}
