//! Sight in integers: whether a segment is free, and all that a vertex sees.
//!
//! [`line_of_sight`] tests one segment, [`segment_cells`] lists the cells that it meets. A
//! [`VisibilitySweep`] finds everything that a vertex sees among the vertices of a set.
//!
//! All of it counts in parts of a cell, 1/1024: so what sees need not be a vertex. [`point_cells`] lists the
//! cells of a segment between such points.
//!
//! The module also has the parts of both that the searches of this workspace are made of; they are hidden
//! from the documentation, because their arguments must fit together in ways that only their callers ensure.

mod interval;
mod piece;
mod place;
mod point_cells;
mod polygon;
mod row_summary;
mod runs;
mod segment_cells;
mod sweep;
mod targets;
mod visitor;

pub use crate::line_of_sight::{line_of_sight, line_of_sight_under};
#[doc(hidden)]
pub use interval::{Crossing, IntervalEnd, Ray, Side};
#[doc(hidden)]
pub use place::Place;
pub use point_cells::point_cells;
#[doc(hidden)]
pub use polygon::PolygonCells;
pub use row_summary::RowSummary;
#[doc(hidden)]
pub use runs::{Runs, Window, row_ahead};
pub use segment_cells::{SegmentCells, segment_cells};
pub use sweep::VisibilitySweep;
pub use targets::{Quadrants, Targets};
