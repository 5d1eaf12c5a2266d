//! The two ends of a path.

use std::fmt;

use mediant_grid::{FreeSpace, Placement, Point, Vertex, VertexId};

use super::{end::End, error::QueryError};

/// The start and the goal of a path: a [`Query`](crate::Query) without wishes.
///
/// ```
/// use mediant_search::Ends;
///
/// let ends = Ends::new((0, 0), (7, 0));
/// assert_eq!([Ends::from(((0, 0), (7, 0))), Ends::from([(0, 0), (7, 0)])], [ends; 2]);
/// assert_eq!(ends.to_string(), "(0, 0) → (7, 0)");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct Ends {
    /// The vertex where the path begins.
    pub start: Vertex,
    /// The vertex where it ends.
    pub goal: Vertex,
}

impl Ends {
    /// The ends of a path from `start` to `goal`.
    #[must_use]
    pub fn new(start: impl Into<Vertex>, goal: impl Into<Vertex>) -> Self {
        Self { start: start.into(), goal: goal.into() }
    }

    /// Checks that both ends are free vertices of the map.
    ///
    /// # Errors
    /// A [`QueryError`] for the first end that is not; the start is checked first.
    pub fn check<P: Placement>(self, space: &FreeSpace<P>) -> Result<(), QueryError> {
        End::Start.check(space, self.start)?;
        End::Goal.check(space, self.goal)
    }

    /// The ids of start and goal; `None` when there is no path. The connected components tell this in
    /// constant time, where a search would expand all vertices that it can reach.
    ///
    /// # Errors
    /// As for [`check`](Self::check).
    pub fn ids<P: Placement>(self, space: &FreeSpace<P>) -> Result<Option<(VertexId, VertexId)>, QueryError> {
        self.check(space)?;
        let ids = space.id(self.start).zip(space.id(self.goal));
        Ok(ids.filter(|_| space.connected(self.start, self.goal)))
    }
}

impl<S: Into<Vertex>, G: Into<Vertex>> From<(S, G)> for Ends {
    fn from((start, goal): (S, G)) -> Self {
        Self::new(start, goal)
    }
}

impl<V: Into<Vertex>> From<[V; 2]> for Ends {
    fn from([start, goal]: [V; 2]) -> Self {
        Self::new(start, goal)
    }
}

/// As `(0, 0) → (7, 0)`.
impl fmt::Display for Ends {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&format!("{} → {}", self.start, self.goal))
    }
}

impl End {
    /// Checks that a vertex can be this end of a path: that it is a free vertex of the map.
    ///
    /// # Errors
    /// [`QueryError::Outside`] or [`QueryError::Blocked`].
    pub fn check<P: Placement>(self, space: &FreeSpace<P>, at: Vertex) -> Result<(), QueryError> {
        let end = self;
        if space.id(at).is_none() {
            let (width, height) = P::vertices(space.grid());
            let last = Vertex::new(width as i32 - 1, height as i32 - 1);
            return Err(QueryError::Outside { end, at: at.into(), last });
        }
        if space.is_free(at) { Ok(()) } else { Err(end.blocked(space, at.into())) }
    }

    /// The error of an end that is not free.
    pub(crate) fn blocked<P: Placement>(self, space: &FreeSpace<P>, at: Point) -> QueryError {
        match space.grid().has_free_cells() {
            true => QueryError::Blocked { end: self, at },
            false => QueryError::NothingFree { end: self, at },
        }
    }
}
