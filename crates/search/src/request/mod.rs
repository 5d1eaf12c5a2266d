//! Requests: queries with several ends, a tolerance, limits.

mod ends;
mod limits;
mod nearest;
mod search;
mod watch;

use mediant_grid::Vertex;

pub use self::{
    limits::{Limit, Limits, Stopped},
    search::Search,
};
use crate::query::Query;

/// A query with wishes: more than one start or goal, a tolerance, what to do where there is no way, limits.
///
/// ```
/// use mediant_search::{Limits, Query, Request};
///
/// let one = Query::new((0, 0), (9, 9)).nearest().within(Limits::new().cost(20.0));
/// let several = Request::between([(0, 0), (3, 0)], [(9, 9), (9, 0)]).tolerance(2.0);
/// assert_eq!((one.starts().len(), several.goals().len()), (1, 2));
/// ```
///
/// A plain [`Query`] is a request, too, and costs nothing more than itself. So are a pair and an array of two
/// vertices.
#[derive(Clone, Debug)]
pub struct Request {
    query: Query,
    wishes: Option<Box<Wishes>>,
}

/// The wishes of a request beyond its query.
#[derive(Clone, Debug)]
pub(crate) struct Wishes {
    pub(crate) starts: Vec<Vertex>,
    pub(crate) goals: Vec<Vertex>,
    pub(crate) tolerance: f64,
    pub(crate) nearest: bool,
    pub(crate) snap: bool,
    pub(crate) limits: Limits,
}

impl From<Query> for Request {
    #[inline]
    fn from(query: Query) -> Self {
        Self { query, wishes: None }
    }
}

impl<S: Into<Vertex>, G: Into<Vertex>> From<(S, G)> for Request {
    fn from(ends: (S, G)) -> Self {
        Query::from(ends).into()
    }
}

impl<V: Into<Vertex>> From<[V; 2]> for Request {
    fn from(ends: [V; 2]) -> Self {
        Query::from(ends).into()
    }
}

impl Query {
    /// If there is no way: the path to the reachable vertex nearest to the goal. See [`Request::nearest`].
    #[must_use]
    pub fn nearest(self) -> Request {
        Request::from(self).nearest()
    }

    /// A goal that is reached within a distance of it. See [`Request::tolerance`].
    #[must_use]
    pub fn tolerance(self, cells: f64) -> Request {
        Request::from(self).tolerance(cells)
    }

    /// Moves blocked ends to the nearest free vertex. See [`Request::snap`].
    #[must_use]
    pub fn snap(self) -> Request {
        Request::from(self).snap()
    }

    /// Sets limits. See [`Request::within`].
    #[must_use]
    pub fn within(self, limits: impl Into<Limits>) -> Request {
        Request::from(self).within(limits)
    }
}

impl Request {
    /// The shortest of the paths from any of the starts to any of the goals. Of paths of the same cost, the
    /// one whose goal comes first in the list, then the one whose start does.
    #[must_use]
    pub fn between<S: Into<Vertex>, G: Into<Vertex>>(
        starts: impl IntoIterator<Item = S>,
        goals: impl IntoIterator<Item = G>,
    ) -> Self {
        let starts: Vec<Vertex> = starts.into_iter().map(Into::into).collect();
        let goals: Vec<Vertex> = goals.into_iter().map(Into::into).collect();
        let first = |ends: &[Vertex]| ends.first().copied().unwrap_or(Vertex::new(0, 0));
        let query = Query::new(first(&starts), first(&goals));
        let mut request = Self::from(query);
        let wishes = request.wishes_mut();
        (wishes.starts, wishes.goals) = (starts, goals);
        request
    }

    /// Where there is no way, the path to the reachable vertex nearest to the goal
    /// ([`Outcome::Nearest`](crate::Outcome::Nearest)): nearest by h_k, at k = ∞ by the straight line; of
    /// several such vertices the one with the shortest path; then the one that comes first row by row. A
    /// blocked goal has no way to it.
    ///
    /// The reachable vertices are known from the connected components, so nothing is exhausted: the vertices
    /// around the goal are looked at, row by row, as far as the nearest one, and there is one search for each
    /// vertex that is equally near and may have the shortest path.
    #[must_use]
    pub fn nearest(mut self) -> Self {
        self.wishes_mut().nearest = true;
        self
    }

    /// The path may end at any free vertex whose straight-line distance to the goal is at most this many
    /// cells, those at exactly this distance included: the shortest of these paths; of several one of them,
    /// always the same by the same engine. The goal itself may be blocked then.
    #[must_use]
    pub fn tolerance(mut self, cells: f64) -> Self {
        self.wishes_mut().tolerance = cells;
        self
    }

    /// Moves each end that is blocked to the free vertex nearest to it: by h_k, at k = ∞ by the straight
    /// line; of several the first row by row. An end outside the map is first moved to the vertex of the
    /// map's rectangle that is nearest along each axis. The answer's path tells where the ends are.
    #[must_use]
    pub fn snap(mut self) -> Self {
        self.wishes_mut().snap = true;
        self
    }

    /// Stops the search at these limits; see [`Outcome::Stopped`](crate::Outcome::Stopped).
    #[must_use]
    pub fn within(mut self, limits: impl Into<Limits>) -> Self {
        self.wishes_mut().limits = limits.into();
        self
    }

    /// The limits of the search.
    #[must_use]
    pub fn limits(&self) -> Limits {
        self.wishes.as_ref().map_or_else(Limits::new, |wishes| wishes.limits.clone())
    }

    /// The starts.
    #[must_use]
    pub fn starts(&self) -> &[Vertex] {
        self.wishes.as_ref().map_or(std::slice::from_ref(&self.query.start), |wishes| &wishes.starts)
    }

    /// The goals.
    #[must_use]
    pub fn goals(&self) -> &[Vertex] {
        self.wishes.as_ref().map_or(std::slice::from_ref(&self.query.goal), |wishes| &wishes.goals)
    }

    /// The query, if nothing more is asked.
    #[must_use]
    #[inline]
    pub const fn as_query(&self) -> Option<Query> {
        if self.wishes.is_some() { None } else { Some(self.query) }
    }

    fn wishes_mut(&mut self) -> &mut Wishes {
        let Query { start, goal } = self.query;
        self.wishes.get_or_insert_with(|| Box::new(Wishes::between(start, goal)))
    }

    pub(crate) fn into_wishes(self) -> Wishes {
        let Query { start, goal } = self.query;
        self.wishes.map_or_else(|| Wishes::between(start, goal), |wishes| *wishes)
    }
}

impl Wishes {
    fn between(start: Vertex, goal: Vertex) -> Self {
        Self {
            starts: vec![start],
            goals: vec![goal],
            tolerance: 0.0,
            nearest: false,
            snap: false,
            limits: Limits::new(),
        }
    }
}
