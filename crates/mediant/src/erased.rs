//! Searches whose type is erased.

use std::any::Any;

use mediant_grid::{Identity, Point, Vertex};
use mediant_search::{
    Answer, Ends, Guarantee, Observer, Path, Planner as Search, PointEnds, QueryError, SearchStatus,
};

/// A search that can be `dyn`. Observers are `dyn` too, so that each search is compiled only twice: without
/// an observer, and in steps with one. An observed search costs dynamic calls for each event; at once it is
/// made by [`Dynamic`], of steps without a pause.
///
/// It is [`Any`], so that an index can tell whether a search is of the type that it makes.
pub(crate) trait Erased: Any {
    /// [`Search::solve`].
    fn solve(&mut self, query: Ends) -> Result<Answer, QueryError>;

    /// [`Search::seek`].
    fn seek(&mut self, query: Ends) -> Result<bool, QueryError>;

    /// [`Search::distance`].
    fn distance(&mut self, query: Ends) -> Result<Option<f64>, QueryError>;

    /// [`Search::begin`].
    fn begin(&mut self, query: Ends, observer: &mut dyn Observer) -> Result<SearchStatus, QueryError>;

    /// [`Search::begin_at`].
    fn begin_at(
        &mut self,
        ends: PointEnds,
        observer: &mut dyn Observer,
    ) -> Option<Result<SearchStatus, QueryError>>;

    /// [`Search::begin_from`].
    fn begin_from(
        &mut self,
        starts: &[Vertex],
        goal: Vertex,
        observer: &mut dyn Observer,
    ) -> Option<SearchStatus>;

    /// [`Search::proceed`].
    fn proceed(&mut self, observer: &mut dyn Observer) -> Result<SearchStatus, QueryError>;

    /// [`Search::path_to`].
    fn path_to(&mut self, at: Vertex) -> Option<Path>;

    /// [`Search::path_to_point`].
    fn path_to_point(&mut self, at: Point) -> Option<Path>;

    /// [`Search::bends_to`].
    fn bends_to(&mut self, at: Vertex) -> Option<Vec<Vertex>>;

    /// [`Search::guarantee`].
    fn guarantee(&self) -> Guarantee;

    /// [`Search::identity`].
    fn identity(&self) -> Identity;
}

impl<S: Search + Any> Erased for S {
    fn solve(&mut self, query: Ends) -> Result<Answer, QueryError> {
        Search::solve(self, query)
    }

    fn seek(&mut self, query: Ends) -> Result<bool, QueryError> {
        Search::seek(self, query, &mut ())
    }

    fn distance(&mut self, query: Ends) -> Result<Option<f64>, QueryError> {
        Search::distance(self, query)
    }

    fn begin(&mut self, query: Ends, mut observer: &mut dyn Observer) -> Result<SearchStatus, QueryError> {
        Search::begin(self, query, &mut observer)
    }

    fn begin_at(
        &mut self,
        ends: PointEnds,
        mut observer: &mut dyn Observer,
    ) -> Option<Result<SearchStatus, QueryError>> {
        Search::begin_at(self, ends, &mut observer)
    }

    fn begin_from(
        &mut self,
        starts: &[Vertex],
        goal: Vertex,
        mut observer: &mut dyn Observer,
    ) -> Option<SearchStatus> {
        Search::begin_from(self, starts, goal, &mut observer)
    }

    fn proceed(&mut self, mut observer: &mut dyn Observer) -> Result<SearchStatus, QueryError> {
        Search::proceed(self, &mut observer)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        Search::path_to(self, at)
    }

    fn path_to_point(&mut self, at: Point) -> Option<Path> {
        Search::path_to_point(self, at)
    }

    fn bends_to(&mut self, at: Vertex) -> Option<Vec<Vertex>> {
        Search::bends_to(self, at)
    }

    fn guarantee(&self) -> Guarantee {
        Search::guarantee(self)
    }

    fn identity(&self) -> Identity {
        Search::identity(self)
    }
}

/// A search of any type, as a search.
pub(crate) struct Dynamic<'s>(pub(crate) &'s mut (dyn Erased + Send));

impl Search for Dynamic<'_> {
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.0.begin(query, observer)
    }

    fn begin_at(
        &mut self,
        ends: PointEnds,
        observer: &mut impl Observer,
    ) -> Option<Result<SearchStatus, QueryError>> {
        self.0.begin_at(ends, observer)
    }

    fn begin_from(
        &mut self,
        starts: &[Vertex],
        goal: Vertex,
        observer: &mut impl Observer,
    ) -> Option<SearchStatus> {
        self.0.begin_from(starts, goal, observer)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.0.proceed(observer)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        self.0.path_to(at)
    }

    fn path_to_point(&mut self, at: Point) -> Option<Path> {
        self.0.path_to_point(at)
    }

    fn bends_to(&mut self, at: Vertex) -> Option<Vec<Vertex>> {
        self.0.bends_to(at)
    }

    fn guarantee(&self) -> Guarantee {
        self.0.guarantee()
    }

    fn identity(&self) -> Identity {
        self.0.identity()
    }
}
