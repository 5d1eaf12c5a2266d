//! The sources of a field, as they are given.

use mediant_grid::{Point, Vertex};
use mediant_search::FieldQuery;
#[cfg(any(feature = "costs", feature = "walking"))]
use mediant_search::{End, QueryError};

/// Sources in the order in which they were given.
pub(crate) enum Sources {
    Vertices(Vec<Vertex>),
    /// Of which some lie between vertices.
    Points(Vec<Point>),
}

impl Sources {
    pub(crate) fn of<P: Into<Point>>(sources: impl IntoIterator<Item = P>) -> Self {
        let points: Vec<Point> = sources.into_iter().map(Into::into).collect();
        match points.iter().map(|at| at.vertex()).collect() {
            Some(vertices) => Self::Vertices(vertices),
            None => Self::Points(points),
        }
    }

    /// All that can be reached from them.
    pub(crate) const fn query(&self) -> FieldQuery<'_> {
        match self {
            Self::Vertices(sources) => FieldQuery::new(sources.as_slice()),
            Self::Points(sources) => FieldQuery::from_points(sources.as_slice()),
        }
    }
}

/// The sources of a query where they have to be vertices.
#[cfg(any(feature = "costs", feature = "walking"))]
pub(super) fn vertices<'q>(query: &FieldQuery<'q>) -> Result<&'q [Vertex], QueryError> {
    let between = query.points.iter().find(|at| at.vertex().is_none());
    between.map_or(Ok(query.sources), |&at| Err(QueryError::Between { end: End::Start, at }))
}
