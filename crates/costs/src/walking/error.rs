//! Errors of walking over elevation.

use mediant_grid::Interrupted;

use crate::error::{CostFieldError, CostsError};

/// The reason why there is no map to walk on, no search graph of it, or no field.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WalkingError {
    /// The size of the map or of its cells, or k.
    #[error(transparent)]
    Costs(#[from] CostsError),
    /// The ends or the limit of a field, or two fields that do not belong together.
    #[error(transparent)]
    Field(#[from] CostFieldError),
    /// Another number of elevations or frictions than cells.
    #[error("there are {found} {what} for {expected} cells: give one for each cell, row by row")]
    Count {
        /// `elevations` or `frictions`.
        what: &'static str,
        /// Their number.
        found: usize,
        /// The number of cells.
        expected: u64,
    },
    /// An elevation that is infinite or not a number.
    #[error(
        "the elevation of cell ({x}, {y}) is {elevation}: it must be a number; a cell without one is marked as \
         blocked"
    )]
    Elevation {
        /// The column.
        x: u32,
        /// The row.
        y: u32,
        /// The elevation.
        elevation: f64,
    },
    /// A friction that is neither 0 nor from 10⁻¹²⁰ to 10¹²⁰.
    #[error("the friction of cell ({x}, {y}) is {friction}: it must be 0, or from 1e-120 to 1e120")]
    Friction {
        /// The column.
        x: u32,
        /// The row.
        y: u32,
        /// The friction.
        friction: f64,
    },
    /// A table without a slope, or whose slopes are not numbers in increasing order.
    #[error("a pace by slopes needs one slope or more, in increasing order")]
    Table,
    /// A pace that is no positive number on a slope of the map.
    #[error(
        "the slopes of the map are up to {steepest}, and a time of a unit of length between is {time}: it must be a \
         positive number, from 1e-120 to 1e120"
    )]
    Pace {
        /// The steepest slope.
        steepest: f64,
        /// The time.
        time: f64,
    },
    /// Times between which the integers of paths do not fit.
    #[error(
        "a unit of length takes from {least} to {greatest} on slopes up to {steepest}: too far apart for exact sums \
         on a map of this size; limit the pace on steep slopes by a table, lower the friction, or mark the steepest \
         or dearest cells as blocked"
    )]
    Range {
        /// The least time, friction included.
        least: f64,
        /// The greatest.
        greatest: f64,
        /// The steepest slope.
        steepest: f64,
    },
    /// Vertices at the corners of cells.
    #[error("elevations are those of the centers of cells: choose centers, not corners, to walk over them")]
    Corners,
    /// Two fields with the same heading, of which a corridor needs one each.
    #[error("a corridor joins a field from its sources and a field to its sources")]
    Heading,
}

impl From<Interrupted> for WalkingError {
    fn from(interrupted: Interrupted) -> Self {
        Self::Costs(interrupted.into())
    }
}
