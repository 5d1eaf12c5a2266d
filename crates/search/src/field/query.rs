//! Queries of fields, and their errors.

use mediant_grid::{FreeSpace, Interrupted, Mismatch, Placement, Vertex, VertexId};
use mediant_moves::Cost;

use crate::{
    limit::{at_most, greatest_cost},
    query::{Ends, QueryError},
};

/// The sources of a field, and its limit.
///
/// ```
/// use mediant_search::FieldQuery;
/// let sources = [(0, 0), (7, 3)].map(Into::into);
/// let range = FieldQuery::new(&sources).within(6.0);
/// assert_eq!(range.limit, 6.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct FieldQuery<'q> {
    /// The vertices at distance 0. If there is none, the field is empty.
    pub sources: &'q [Vertex],
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
        Self { sources, limit: f64::INFINITY, until: &[] }
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

    /// Checks sources, targets and limit. Returns the ids of the sources.
    pub(super) fn check<P: Placement>(&self, space: &FreeSpace<P>) -> Result<Vec<VertexId>, FieldError> {
        if self.limit.is_nan() || self.limit < 0.0 {
            return Err(FieldError::Limit { limit: self.limit });
        }
        self.sources.iter().try_for_each(|&at| Ends::new(at, at).check(space))?;
        if let Some(&first) = self.sources.first() {
            self.until.iter().try_for_each(|&at| Ends::new(first, at).check(space))?;
        }
        Ok(self.sources.iter().filter_map(|&at| space.id(at)).collect())
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

/// A query that a field keeps, to be asked again after a change of the map.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    sources: Box<[Vertex]>,
    limit: f64,
    until: Box<[Vertex]>,
}

impl From<FieldQuery<'_>> for Asked {
    fn from(query: FieldQuery<'_>) -> Self {
        Self { sources: query.sources.into(), limit: query.limit, until: query.until.into() }
    }
}

impl Asked {
    pub(super) fn query(&self) -> FieldQuery<'_> {
        FieldQuery { sources: &self.sources, limit: self.limit, until: &self.until }
    }
}

/// The reason why a [`FieldQuery`] cannot be answered.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FieldError {
    /// A source (called the start) or a vertex at which the field is to end (the goal) is blocked or outside
    /// the map.
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
