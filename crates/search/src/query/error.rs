//! Errors of queries.

use std::fmt;

use mediant_grid::{Point, Vertex};

use super::end::End;

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
        /// The end of the query.
        at: Point,
        /// The map's last vertex.
        last: Vertex,
    },
    /// An end between vertices, for an engine whose paths start and end at vertices.
    #[error(
        "the {end} {at} lies between vertices: name a vertex, or ask for a path at any angle by an engine that \
         takes any point: Anya, or subgoals"
    )]
    Between {
        /// Which end.
        end: End,
        /// The end of the query.
        at: Point,
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
    /// A query without a start, or without a goal.
    #[error("the query has no {end}: name at least one")]
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
    /// Paths on a cost surface that are to be pulled taut.
    #[error("paths on costs of cells are not pulled taut: smooth them linearly, or not")]
    Smoothing,
    /// A step of a search that was never begun.
    #[error("no search was begun: begin one first")]
    NotBegun,
    /// An end is on a blocked cell (at corners: between four of them).
    #[error("the {end} {at} is blocked: choose a free vertex")]
    Blocked {
        /// Which end.
        end: End,
        /// The end of the query.
        at: Point,
    },
    /// An end is blocked, as all cells of the map are.
    #[error(
        "the {end} {at} is blocked, and no cell of the map is free: check which cells, characters or shades \
         count as free, and the size of the agent"
    )]
    NothingFree {
        /// Which end.
        end: End,
        /// The end of the query.
        at: Point,
    },
}

impl QueryError {
    /// The error of a search between corners in the coordinates of [`CenterSpace`](crate::CenterSpace).
    #[must_use]
    pub fn at_centers(self) -> Self {
        match self {
            Self::Outside { end, at, last } => {
                let last = Vertex::new(last.x.saturating_sub(1), last.y.saturating_sub(1));
                Self::Outside { end, at: at.at_centers(), last }
            }
            Self::Between { end, at } => Self::Between { end, at: at.at_centers() },
            Self::Blocked { end, at } => Self::Blocked { end, at: at.at_centers() },
            Self::NothingFree { end, at } => Self::NothingFree { end, at: at.at_centers() },
            other => other,
        }
    }
}

impl fmt::Debug for QueryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
