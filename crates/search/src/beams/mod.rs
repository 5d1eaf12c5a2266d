//! Beams: what a vertex sees on its way over the rows of a map, by words of cells and in exact arithmetic.
//!
//! [`Anya`](crate::Anya) follows them toward a goal, [`VisibilitySweep`] to all sides.

mod interval;
mod row_summary;
mod strip;
mod sweep;

pub(crate) use interval::{Crossing, End, Ray, Side};
pub use row_summary::RowSummary;
pub(crate) use strip::{Runs, Window, row_ahead};
pub use sweep::{Quadrants, Targets, VisibilitySweep};
