//! Two ends of a path that need not be vertices.

use std::fmt;

use mediant_grid::{Corners, FreeSpace, Placement, Point, Vertex, sight::Place};

use super::{end::End, ends::Ends, error::QueryError};

/// The start and the goal of a path at any angle: points of the free space, which need not be vertices.
///
/// ```
/// use mediant_search::{Ends, PointEnds};
///
/// let ends = PointEnds::new((0.5, 0.5), (7, 0));
/// assert_eq!((ends.vertices(), ends.to_string()), (None, "(0.5, 0.5) → (7, 0)".to_owned()));
/// assert_eq!(PointEnds::new((0.0, 0.0), (7, 0)).vertices(), Some(Ends::new((0, 0), (7, 0))));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct PointEnds {
    /// The point where the path begins.
    pub start: Point,
    /// The point where it ends.
    pub goal: Point,
}

impl PointEnds {
    /// The ends of a path from `start` to `goal`.
    #[must_use]
    pub fn new(start: impl Into<Point>, goal: impl Into<Point>) -> Self {
        Self { start: start.into(), goal: goal.into() }
    }

    /// The same as vertices, if both are.
    #[must_use]
    #[inline]
    pub fn vertices(self) -> Option<Ends> {
        Some(Ends::new(self.start.vertex()?, self.goal.vertex()?))
    }

    /// The ends between centers in the coordinates of a search between corners:
    /// [`CenterSpace`](crate::CenterSpace).
    #[must_use]
    pub fn at_corners(self) -> Self {
        Self::new(self.start.at_corners(), self.goal.at_corners())
    }

    /// The error of these ends where only vertices are ends.
    #[must_use]
    pub fn between(self) -> QueryError {
        let (end, at) = match self.start.vertex() {
            None => (End::Start, self.start),
            Some(_) => (End::Goal, self.goal),
        };
        QueryError::Between { end, at }
    }

    /// Checks that both ends are free points of the map.
    ///
    /// # Errors
    /// A [`QueryError`] for the first end that is not; the start is checked first.
    pub fn check(self, space: &FreeSpace<Corners>) -> Result<(), QueryError> {
        self.places(space).map(|_| ())
    }

    /// The ends in the parts that rays are counted in.
    #[doc(hidden)]
    pub fn places(self, space: &FreeSpace<Corners>) -> Result<[Place; 2], QueryError> {
        Ok([End::Start.place(space, self.start)?, End::Goal.place(space, self.goal)?])
    }
}

impl End {
    /// Checks that a point can be this end of a path at any angle: that it is free.
    ///
    /// # Errors
    /// [`QueryError::Outside`] or [`QueryError::Blocked`].
    pub fn check_point(self, space: &FreeSpace<Corners>, at: Point) -> Result<(), QueryError> {
        self.place(space, at).map(|_| ())
    }

    fn place(self, space: &FreeSpace<Corners>, at: Point) -> Result<Place, QueryError> {
        match space.place(at) {
            None => {
                let (width, height) = Corners::vertices(space.grid());
                let last = Vertex::new(width as i32 - 1, height as i32 - 1);
                Err(QueryError::Outside { end: self, at, last })
            }
            Some(place) if place.is_free(space.grid().rows()) => Ok(place),
            Some(_) => Err(self.blocked(space, at)),
        }
    }
}

impl From<Ends> for PointEnds {
    #[inline]
    fn from(Ends { start, goal, .. }: Ends) -> Self {
        Self::new(start, goal)
    }
}

impl<S: Into<Point>, G: Into<Point>> From<(S, G)> for PointEnds {
    fn from((start, goal): (S, G)) -> Self {
        Self::new(start, goal)
    }
}

impl<P: Into<Point>> From<[P; 2]> for PointEnds {
    fn from([start, goal]: [P; 2]) -> Self {
        Self::new(start, goal)
    }
}

/// As `(0.5, 0.5) → (7, 0)`.
impl fmt::Display for PointEnds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&format!("{} → {}", self.start, self.goal))
    }
}
