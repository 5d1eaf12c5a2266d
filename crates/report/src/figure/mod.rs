//! Figures as SVG text: charts, maps with paths, neighborhoods, decomposition trees.
//!
//! **The key decision: we write the SVG ourselves and use no plotting library.** A figure is one file in the
//! repository, next to the numbers that it shows, and must be fit for that. It follows the page's light or
//! dark scheme, by a style sheet inside the file. The same numbers give the same bytes, so that a changed
//! figure is a changed result. It has no raster image and no font. The figures of the reproductions (points,
//! lines, bounds, small maps, trees) need no more than this module.
//!
//! Series differ in color (the eight of Okabe and Ito, which color-blind readers can tell apart), in marker
//! and in dash.
//!
//! Not here: interaction, error bars, surfaces.

mod axis;
mod canvas;
mod chart;
mod geometry;
mod grid;
mod labels;
mod legend;
mod neighborhood;
mod number;
mod plot;
mod series;
mod sheet;
mod span;
mod style;
mod text;
mod ticks;
mod tree;
mod turn;

pub use axis::{Axis, Scale};
pub use chart::Chart;
pub use grid::GridDrawing;
pub use neighborhood::NeighborhoodDrawing;
pub use series::{Mark, Series};
pub use tree::TreeDrawing;
