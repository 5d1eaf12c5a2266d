//! Beams: what a vertex sees on its way over the rows of a map, by words of cells and in exact arithmetic.
//!
//! [`Anya`](crate::Anya) follows them toward a goal, [`Fan`] to all sides.

mod bands;
mod fan;
mod interval;
mod strip;

pub use bands::Bands;
pub use fan::{Fan, Quadrants, Targets};
pub(crate) use interval::{End, Place, Ray, Side};
pub(crate) use strip::{Runs, Window, row_ahead};
