//! Queries of fields, and their errors.

use std::fmt;

use mediant_grid::{
    Corners, FreeSpace, Interrupted, Mismatch, Placement, Point, Vertex, VertexId, sight::Place,
};
use mediant_moves::Cost;

use crate::{
    limit::{at_most, greatest_cost},
    query::{End, PointEnds, QueryError},
};

/// The sources of a field, and its limit.
///
/// ```
/// use mediant_search::FieldQuery;
/// let sources = [(0, 0), (7, 3)].map(Into::into);
/// let range = FieldQuery::new(&sources).within(6.0);
/// assert_eq!(range.limit, 6.0);
/// let points = [(0.5, 0.25), (7.0, 3.0)].map(Into::into);
/// assert!(FieldQuery::from_points(&points).all_sources().eq(points));
/// ```
#[derive(Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FieldQuery<'q> {
    /// The vertices at distance 0. If there is no source, the field is empty.
    pub sources: &'q [Vertex],
    /// More sources. At any angle they may lie between vertices.
    pub points: &'q [Point],
    /// The greatest distance in the field, in cells: it holds exactly the vertices that are as near or
    /// nearer, where distances that differ by a factor of at most 1 + 2⁻³¹ count as the same. So the
    /// distance of a vertex as a limit reaches that vertex. Infinity is no limit.
    pub limit: f64,
    /// If not empty, the field ends at the farthest of these vertices: it holds exactly the vertices that are
    /// as near as that one, or nearer, in the same sense. If there is no path to one of them, it ends
    /// nowhere.
    pub until: &'q [Vertex],
}

impl<'q> FieldQuery<'q> {
    /// All that can be reached from the sources.
    #[must_use]
    pub const fn new(sources: &'q [Vertex]) -> Self {
        Self { sources, points: &[], limit: f64::INFINITY, until: &[] }
    }

    /// All that can be reached from sources at points.
    #[must_use]
    pub const fn from_points(points: &'q [Point]) -> Self {
        Self { points, ..Self::new(&[]) }
    }

    /// The same within a distance, in cells: a movement range. It includes what is exactly so far: see
    /// [`limit`](Self::limit).
    #[must_use]
    pub const fn within(self, limit: f64) -> Self {
        Self { limit, ..self }
    }

    /// The same up to the farthest of these vertices.
    #[must_use]
    pub const fn until(self, until: &'q [Vertex]) -> Self {
        Self { until, ..self }
    }

    /// All sources: the vertices, then the points.
    pub fn all_sources(&self) -> impl DoubleEndedIterator<Item = Point> + use<'q> {
        self.sources.iter().map(Point::from).chain(self.points.iter().copied())
    }

    /// Checks sources, targets and limit where all sources have to be vertices. Returns their ids.
    pub(super) fn check<P: Placement>(&self, space: &FreeSpace<P>) -> Result<Vec<VertexId>, FieldError> {
        let checked = |at: Point| {
            let vertex = at.vertex().ok_or(QueryError::Between { end: End::Start, at })?;
            End::Start.check(space, vertex).map(|()| vertex)
        };
        let vertices = self.check_with(space, checked)?;
        Ok(vertices.into_iter().filter_map(|at| space.id(at)).collect())
    }

    /// Checks sources, targets and limit at any angle.
    pub(super) fn check_points(&self, space: &FreeSpace<Corners>) -> Result<Sources, FieldError> {
        let checked = |at| PointEnds::new(at, at).places(space).map(|[at, _]| at);
        let places = self.check_with(space, checked)?;
        let vertices = places.iter().filter_map(|at| space.id(at.vertex()?)).collect();
        let between = places.into_iter().filter(|at| at.vertex().is_none()).collect();
        Ok(Sources { vertices, between })
    }

    fn check_with<P: Placement, T>(
        &self,
        space: &FreeSpace<P>,
        checked: impl Fn(Point) -> Result<T, QueryError>,
    ) -> Result<Vec<T>, FieldError> {
        if self.limit.is_nan() || self.limit < 0.0 {
            return Err(FieldError::Limit { limit: self.limit });
        }
        let sources: Vec<T> = self.all_sources().map(checked).collect::<Result<_, _>>()?;
        if !sources.is_empty() {
            self.until.iter().try_for_each(|&at| End::Goal.check(space, at))?;
        }
        Ok(sources)
    }

    /// The limit in fixed point.
    pub(super) fn fixed_limit(&self) -> Cost {
        // The greatest cost stands for 'no path'.
        greatest_cost(self.limit).min(Cost::from_bits(Cost::MAX.to_bits() - 1))
    }

    /// The greatest distance in a field that holds these: the limit, or less where it ends at the farthest of
    /// some vertices.
    pub(super) fn reach<P: Placement>(&self, space: &FreeSpace<P>, costs: &[Cost]) -> Cost {
        let until = self.until.iter().filter_map(|&at| costs.get(space.id(at)?.index()));
        until.max().map_or(self.fixed_limit(), |&farthest| self.fixed_limit().min(at_most(farthest)))
    }
}

/// The points of a query are shown if there are some.
impl fmt::Debug for FieldQuery<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("FieldQuery");
        shown.field("sources", &self.sources);
        if !self.points.is_empty() {
            shown.field("points", &self.points);
        }
        shown.field("limit", &self.limit).field("until", &self.until).finish()
    }
}

/// The sources of a field at any angle.
pub(super) struct Sources {
    pub(super) vertices: Vec<VertexId>,
    /// The sources that are no vertices.
    pub(super) between: Vec<Place>,
}

/// A query that a field keeps, to be asked again after a change of the map.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    sources: Box<[Vertex]>,
    points: Box<[Point]>,
    limit: f64,
    until: Box<[Vertex]>,
}

impl From<FieldQuery<'_>> for Asked {
    fn from(query: FieldQuery<'_>) -> Self {
        let FieldQuery { sources, points, limit, until } = query;
        Self { sources: sources.into(), points: points.into(), limit, until: until.into() }
    }
}

impl Asked {
    /// The same with all sources as vertices, which they are.
    pub(super) fn of_vertices(query: FieldQuery<'_>) -> Self {
        let sources = query.all_sources().filter_map(Point::vertex).collect();
        Self { sources, points: Box::default(), limit: query.limit, until: query.until.into() }
    }

    pub(super) fn query(&self) -> FieldQuery<'_> {
        let Self { sources, points, limit, until } = self;
        FieldQuery { sources, points, limit: *limit, until }
    }
}

/// The reason why a [`FieldQuery`] cannot be answered.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FieldError {
    /// A source (called the start) or a vertex at which the field is to end (the goal) is blocked or outside
    /// the map; or a source lies between vertices where paths have to start at vertices.
    #[error(transparent)]
    Query(#[from] QueryError),
    /// The limit is negative or not a number.
    #[error("the limit of a field is {limit}: choose a distance in cells from 0 on, or infinity")]
    Limit {
        /// The limit.
        limit: f64,
    },
    /// A field, a change and a map that do not belong together.
    #[error(transparent)]
    Mismatch(#[from] Mismatch),
    /// It was stopped before it was done.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}
