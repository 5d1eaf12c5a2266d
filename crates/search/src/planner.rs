//! The contract of every engine.

use mediant_grid::{Identity, Point, Vertex};

use crate::{
    answer::Answer,
    guarantee::Guarantee,
    observer::{Observer, Part},
    path::Path,
    query::{Ends, PointEnds, QueryError},
};

/// Answers queries, one after another, on scratch memory of its own: make one for each thread.
///
/// The map and whatever was preprocessed from it are immutable, and shared between planners. A warm planner
/// allocates nothing but the path that it returns. The same query always gives the same path and the same
/// counts.
///
/// **A search in steps.** [`begin`](Self::begin) begins the search for an answer, [`proceed`](Self::proceed)
/// continues it until it is finished or its observer [pauses](Observer::pauses) it, and
/// [`path_to`](Self::path_to) gives paths to what it has reached. [`solve`](Self::solve) is these three
/// without a pause. The events of a search are the same however often it is paused. A planner that looks its
/// answers up, as hub labels do, has them once it has begun, and tells no events.
pub trait Planner {
    /// Begins the search for an answer, and forgets the last one. Without a search it already knows that
    /// there is no path, or finds one that is plain to see.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError>;

    /// Begins the search for a path between two points that need not be vertices, as [`begin`](Self::begin)
    /// does between vertices. `None` by a planner whose paths start and end at vertices: nothing was begun
    /// then.
    fn begin_at(
        &mut self,
        ends: PointEnds,
        observer: &mut impl Observer,
    ) -> Option<Result<SearchStatus, QueryError>> {
        let _ = (ends, observer);
        None
    }

    /// Begins the search for the shortest of the paths from several starts to a goal, which all have a way to
    /// it. `None` by a planner that searches from one start only: nothing was begun then.
    fn begin_from(
        &mut self,
        starts: &[Vertex],
        goal: Vertex,
        observer: &mut impl Observer,
    ) -> Option<SearchStatus> {
        let _ = (starts, goal, observer);
        None
    }

    /// Continues the search until it is finished or the observer pauses it. A search that is finished, or was
    /// never begun, stays as it is.
    ///
    /// # Errors
    /// [`QueryError::GaveUp`] by a planner that may fail.
    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError>;

    /// The best path that the search has found to a vertex: to the goal, once its status is
    /// [`Found`](SearchStatus::Found), and to each vertex that an observer was told to be
    /// [reached](Observer::reached). `None` for others, and where there is no way. A planner that needs the
    /// memory of its search to make the path that it has found may know no other paths then.
    fn path_to(&mut self, at: Vertex) -> Option<Path>;

    /// [`path_to`](Self::path_to) for a point: the goal of a search that was [begun](Self::begin_at) between
    /// points.
    fn path_to_point(&mut self, at: Point) -> Option<Path> {
        self.path_to(at.vertex()?)
    }

    /// The bends of [that path](Self::path_to), from the start to the vertex, if the planner knows them
    /// without making the path: the vertices between which it follows lines of sight. Joined by straight
    /// segments they are a legal path at any angle, which is not longer. `None` by a planner that knows none;
    /// then smoothing looks for them.
    ///
    /// The path that they make is one of the same cost over N(k), but not always the one that
    /// [`path_to`](Self::path_to) returns.
    fn bends_to(&mut self, at: Vertex) -> Option<Vec<Vertex>> {
        let _ = at;
        None
    }

    /// The guarantee of the paths.
    fn guarantee(&self) -> Guarantee;

    /// The identity of the answers: the map, the rules of motion and k.
    fn identity(&self) -> Identity;

    /// Answers a query, watched by an observer, which cannot pause the search.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    fn solve_observed(&mut self, query: Ends, observer: &mut impl Observer) -> Result<Answer, QueryError> {
        let path = if self.seek(query, observer)? { self.path_to(query.goal) } else { None };
        Ok(path.map_or(Answer::Unreachable, Answer::Found))
    }

    /// Begins the search for an answer and finishes it, watched by an observer, which cannot pause it.
    /// Returns whether there is a path: then [`path_to`](Self::path_to) and [`bends_to`](Self::bends_to)
    /// give it.
    ///
    /// # Errors
    /// As for [`solve_observed`](Self::solve_observed).
    fn seek(&mut self, query: Ends, observer: &mut impl Observer) -> Result<bool, QueryError> {
        let mut observer = Part::new(observer);
        let status = match self.begin(query, &mut observer)? {
            SearchStatus::Searching => self.proceed(&mut observer)?,
            status => status,
        };
        Ok(status == SearchStatus::Found)
    }

    /// Answers a query between two points; `None` by a planner whose paths start and end at vertices, unless
    /// both are.
    fn solve_at(&mut self, ends: PointEnds) -> Option<Result<Answer, QueryError>> {
        if let Some(ends) = ends.vertices() {
            return Some(self.solve(ends));
        }
        let mut none = ();
        let observer = &mut Part::new(&mut none);
        let status = match self.begin_at(ends, observer)? {
            Ok(SearchStatus::Searching) => self.proceed(observer),
            begun => begun,
        };
        Some(status.map(|status| {
            let path = (status == SearchStatus::Found).then(|| self.path_to_point(ends.goal)).flatten();
            path.map_or(Answer::Unreachable, Answer::Found)
        }))
    }

    /// Answers a query.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    fn solve(&mut self, query: Ends) -> Result<Answer, QueryError> {
        self.solve_observed(query, &mut ())
    }

    /// The length of the path that [`solve`](Self::solve) would find, in cells, as [`Guarantee::length`]
    /// tells it; `None` if there is none. A planner that knows it without the path saves the path. At any
    /// angle the length may then differ from that of the path by a factor of 1 + 2⁻³¹ (see
    /// [`Cost`](mediant_moves::Cost)).
    ///
    /// # Errors
    /// As for [`solve`](Self::solve).
    fn distance(&mut self, query: Ends) -> Result<Option<f64>, QueryError> {
        let answer = self.solve(query)?;
        Ok(answer.path().map(|path| self.guarantee().length(path)))
    }
}

/// How far a search has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SearchStatus {
    /// It has no answer yet.
    Searching,
    /// It has found the path to the goal.
    Found,
    /// It has found that there is no path. A search that was never begun has this status, too.
    #[default]
    Unreachable,
}
