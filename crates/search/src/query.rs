//! Queries, and what can be wrong with them.

use std::fmt;

use mediant_grid::{FreeSpace, Placement, Vertex, VertexId};

/// The start and the goal of a path. More may come that can be asked.
///
/// A pair or an array of two vertices is a query, too, where a call takes a [`Request`](crate::Request).
///
/// ```
/// use mediant_search::Query;
///
/// let query = Query::new((0, 0), (7, 0));
/// assert_eq!([Query::from(((0, 0), (7, 0))), Query::from([(0, 0), (7, 0)])], [query; 2]);
/// assert_eq!(query.to_string(), "(0, 0) → (7, 0)");
/// // Where there is no way, the nearest vertex to which there is one.
/// let request = query.nearest();
/// assert_eq!(request.goals(), [(7, 0).into()]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct Query {
    /// The vertex where the path begins.
    pub start: Vertex,
    /// The vertex where it ends.
    pub goal: Vertex,
}

impl Query {
    /// The query for a path from `start` to `goal`.
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
    pub fn ends<P: Placement>(
        self,
        space: &FreeSpace<P>,
    ) -> Result<Option<(VertexId, VertexId)>, QueryError> {
        self.check(space)?;
        let ends = space.id(self.start).zip(space.id(self.goal));
        Ok(ends.filter(|_| space.connected(self.start, self.goal)))
    }
}

impl<S: Into<Vertex>, G: Into<Vertex>> From<(S, G)> for Query {
    fn from((start, goal): (S, G)) -> Self {
        Self::new(start, goal)
    }
}

impl<V: Into<Vertex>> From<[V; 2]> for Query {
    fn from([start, goal]: [V; 2]) -> Self {
        Self::new(start, goal)
    }
}

/// As `(0, 0) → (7, 0)`.
impl fmt::Display for Query {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&format!("{} → {}", self.start, self.goal))
    }
}

/// One of the two ends of a query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum End {
    /// Its start.
    Start,
    /// Its goal.
    Goal,
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
            return Err(QueryError::Outside { end, at, last });
        }
        if space.is_free(at) { Ok(()) } else { Err(end.blocked(space, at)) }
    }

    /// The error of an end that is not free.
    pub(crate) fn blocked<P: Placement>(self, space: &FreeSpace<P>, at: Vertex) -> QueryError {
        match space.grid().has_free_cells() {
            true => QueryError::Blocked { end: self, at },
            false => QueryError::NothingFree { end: self, at },
        }
    }
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Start => "start",
            Self::Goal => "goal",
        })
    }
}

/// An invalid query, or a planner that failed. `{:?}` shows the text of the error, too, since that is what a
/// program prints that ends with it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, thiserror::Error)]
#[non_exhaustive]
pub enum QueryError {
    /// An end lies outside the map.
    #[error("the {end} {at} is outside the map, whose vertices run from (0, 0) to {last}")]
    Outside {
        /// Which end.
        end: End,
        /// The vertex of the query.
        at: Vertex,
        /// The map's last vertex.
        last: Vertex,
    },
    /// The planner found no path although there is one.
    #[error("no path was found, though there is one: {why}")]
    GaveUp {
        /// Why the planner may fail.
        why: &'static str,
    },
    /// Goals that were prepared for another map, other rules or another k.
    #[error("the goals are not those of this map, its rules and this k: prepare them for it")]
    OtherGoals,
    /// A request without a start, or without a goal.
    #[error("the request has no {end}: name at least one")]
    NoEnd {
        /// Which end.
        end: End,
    },
    /// A tolerance that is negative, or no number.
    #[error("the tolerance must be a number of cells, 0 or more")]
    Tolerance,
    /// A limit on the cost that is negative, or no number.
    #[error("the limit on the cost must be a number of cells, 0 or more")]
    CostLimit,
    /// A step of a search that was never begun.
    #[error("no search was begun: begin one first")]
    NotBegun,
    /// An end is on a blocked cell (at corners: between four of them).
    #[error("the {end} {at} is blocked: choose a free vertex")]
    Blocked {
        /// Which end.
        end: End,
        /// The vertex of the query.
        at: Vertex,
    },
    /// An end is blocked, as all cells of the map are.
    #[error(
        "the {end} {at} is blocked, and no cell of the map is free: check which cells, characters or shades \
         count as free, and the size of the agent"
    )]
    NothingFree {
        /// Which end.
        end: End,
        /// The vertex of the query.
        at: Vertex,
    },
}

impl fmt::Debug for QueryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
