//! Queries: the ends of a path, and wishes beyond them.

mod end;
mod end_sets;
mod end_space;
mod ends;
mod error;
mod limits;
mod nearest;
mod path_costs;
mod point_ends;
mod search;
mod watch;

use std::fmt;

use mediant_grid::Point;

pub use self::{
    end::End,
    end_space::{CenterSpace, EndSpace},
    ends::Ends,
    error::QueryError,
    limits::{Limit, Limits, Stopped},
    path_costs::PathCosts,
    point_ends::PointEnds,
    search::Search,
};

/// A query: the start and the goal of a path, and wishes beyond them: several ends, a tolerance, what to do
/// where there is no way, limits.
///
/// Without wishes it costs nothing more than its [`Ends`]. They are a query, too, as are a pair and an array
/// of two vertices or points.
///
/// At any angle an end may be any point of the free space, such as (2.03, 0.5). It is rounded to a multiple
/// of 1/1024 of a cell, by at most 1/2048 along each axis; the path begins and ends with the rounded point.
///
/// ```
/// use mediant_search::{Limits, Query};
///
/// let one = Query::new((0, 0), (9, 9)).nearest().within(Limits::new().cost(20.0));
/// let several = Query::between([(0, 0), (3, 0)], [(9, 9), (9, 0)]).tolerance(2.0);
/// assert_eq!((one.starts().len(), several.goals().len()), (1, 2));
/// assert_eq!(several.to_string(), "(0, 0) or (3, 0) → (9, 9) or (9, 0)");
/// assert_eq!(Query::from([(0, 0), (9, 9)]).to_string(), "(0, 0) → (9, 9)");
/// assert_eq!(Query::new((0.5, 0.25), (9, 9)).to_string(), "(0.5, 0.25) → (9, 9)");
/// ```
#[derive(Clone, Debug)]
pub struct Query {
    ends: PointEnds,
    wishes: Option<Box<Wishes>>,
}

/// The wishes of a query beyond its ends, and its ends, since there may be several.
#[derive(Clone, Debug)]
pub(crate) struct Wishes {
    pub(crate) starts: Vec<Point>,
    pub(crate) goals: Vec<Point>,
    pub(crate) tolerance: f64,
    pub(crate) nearest: bool,
    pub(crate) snap: bool,
    pub(crate) limits: Limits,
}

impl From<Ends> for Query {
    #[inline]
    fn from(ends: Ends) -> Self {
        PointEnds::from(ends).into()
    }
}

impl From<PointEnds> for Query {
    #[inline]
    fn from(ends: PointEnds) -> Self {
        Self { ends, wishes: None }
    }
}

impl<S: Into<Point>, G: Into<Point>> From<(S, G)> for Query {
    fn from((start, goal): (S, G)) -> Self {
        Self::new(start, goal)
    }
}

impl<P: Into<Point>> From<[P; 2]> for Query {
    fn from([start, goal]: [P; 2]) -> Self {
        Self::new(start, goal)
    }
}

impl From<&Query> for Query {
    fn from(query: &Query) -> Self {
        query.clone()
    }
}

impl Ends {
    /// See [`Query::nearest`].
    #[must_use]
    pub fn nearest(self) -> Query {
        Query::from(self).nearest()
    }

    /// See [`Query::tolerance`].
    #[must_use]
    pub fn tolerance(self, cells: f64) -> Query {
        Query::from(self).tolerance(cells)
    }

    /// See [`Query::snap`].
    #[must_use]
    pub fn snap(self) -> Query {
        Query::from(self).snap()
    }

    /// See [`Query::within`].
    #[must_use]
    pub fn within(self, limits: impl Into<Limits>) -> Query {
        Query::from(self).within(limits)
    }
}

impl Query {
    /// The query for a path from `start` to `goal`.
    #[must_use]
    pub fn new(start: impl Into<Point>, goal: impl Into<Point>) -> Self {
        PointEnds::new(start, goal).into()
    }

    /// The shortest of the paths from any of the starts to any of the goals, on a cost surface the cheapest.
    /// Of paths of the same cost, the one whose goal comes first in the list, then the one whose start does.
    #[must_use]
    pub fn between<S: Into<Point>, G: Into<Point>>(
        starts: impl IntoIterator<Item = S>,
        goals: impl IntoIterator<Item = G>,
    ) -> Self {
        let starts: Vec<Point> = starts.into_iter().map(Into::into).collect();
        let goals: Vec<Point> = goals.into_iter().map(Into::into).collect();
        let first = |ends: &[Point]| ends.first().copied().unwrap_or(Point::from_parts(0, 0));
        let mut query = Self::new(first(&starts), first(&goals));
        let wishes = query.wishes_mut();
        (wishes.starts, wishes.goals) = (starts, goals);
        query
    }

    /// Where there is no way, the path to the reachable vertex nearest to the goal
    /// ([`Answer::Nearest`](crate::Answer::Nearest)): nearest by h_k, at k = ∞ by the straight line; of
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
    /// always the same by the same engine. The goal itself may be blocked then; if it lies between vertices
    /// and is free, the path may end there, too.
    #[must_use]
    pub fn tolerance(mut self, cells: f64) -> Self {
        self.wishes_mut().tolerance = cells;
        self
    }

    /// Moves each end that is blocked to the free vertex nearest to it: by h_k, at k = ∞ by the straight
    /// line; of several the first row by row. An end outside the map is first moved to the place on the map
    /// that is nearest along each axis: over N(k) a vertex; at any angle a point, between centers up to half
    /// a cell beyond the outermost of them. The answer's path tells where the ends are.
    #[must_use]
    pub fn snap(mut self) -> Self {
        self.wishes_mut().snap = true;
        self
    }

    /// Stops the search at these limits; see [`Answer::Stopped`](crate::Answer::Stopped).
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
    pub fn starts(&self) -> &[Point] {
        self.wishes.as_ref().map_or(std::slice::from_ref(&self.ends.start), |wishes| &wishes.starts)
    }

    /// The goals.
    #[must_use]
    pub fn goals(&self) -> &[Point] {
        self.wishes.as_ref().map_or(std::slice::from_ref(&self.ends.goal), |wishes| &wishes.goals)
    }

    /// Its two ends, if they are vertices and there are no wishes.
    #[must_use]
    #[inline]
    pub fn as_ends(&self) -> Option<Ends> {
        if self.wishes.is_some() { None } else { self.ends.vertices() }
    }

    /// Its two ends, if there are no wishes.
    #[must_use]
    #[inline]
    pub fn as_points(&self) -> Option<PointEnds> {
        if self.wishes.is_some() { None } else { Some(self.ends) }
    }

    fn wishes_mut(&mut self) -> &mut Wishes {
        let PointEnds { start, goal } = self.ends;
        self.wishes.get_or_insert_with(|| Box::new(Wishes::between(start, goal)))
    }

    pub(crate) fn into_wishes(self) -> Wishes {
        let PointEnds { start, goal } = self.ends;
        self.wishes.map_or_else(|| Wishes::between(start, goal), |wishes| *wishes)
    }
}

impl Wishes {
    fn between(start: Point, goal: Point) -> Self {
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

/// As `(0, 0) → (7, 0)`.
impl fmt::Display for Query {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let any_of = |ends: &[Point]| ends.iter().map(Point::to_string).collect::<Vec<_>>().join(" or ");
        f.pad(&format!("{} → {}", any_of(self.starts()), any_of(self.goals())))
    }
}
