//! Searches whose type is erased.

use mediant_search::{Guarantee, Observer, Outcome, Planner as Search, Query, QueryError};

/// A search that can be `dyn`. Observers are `dyn` too, so that each search is compiled only twice: with and
/// without an observer. An observed search costs a dynamic call for each event.
pub(crate) trait Erased {
    /// [`Search::solve`].
    fn solve(&mut self, query: Query) -> Result<Outcome, QueryError>;

    /// [`Search::solve_observed`].
    fn solve_observed(&mut self, query: Query, observer: &mut dyn Observer) -> Result<Outcome, QueryError>;

    /// [`Search::guarantee`].
    fn guarantee(&self) -> Guarantee;
}

impl<S: Search> Erased for S {
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

    fn guarantee(&self) -> Guarantee {
        Search::guarantee(self)
    }
}
