//! The geometry of sight: what a straight segment crosses, and what a vertex sees, by words of cells and in exact arithmetic.
//!
//! [`line_of_sight`] tests one segment. A [`VisibilitySweep`] finds all that a vertex sees. The rest are its parts, from which
//! any-angle searches are made as well: a [`Ray`] bounds an interval of a grid line, a [`Crossing`] is where it meets that line, and
//! a [`Cover`] is the set of cells that a polygon meets.

mod cover;
mod interval;
mod line;
mod row_summary;
mod strip;
mod sweep;

pub use cover::Cover;
pub use interval::{Crossing, IntervalEnd, Ray, Side};
pub(crate) use line::Frame;
pub use line::{line_of_sight, line_of_sight_under};
pub use row_summary::RowSummary;
pub use strip::{Runs, Window, row_ahead};
pub use sweep::{Quadrants, Targets, VisibilitySweep};
