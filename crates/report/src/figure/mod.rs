//! Figures as SVG text: charts, maps with paths, decomposition trees.
//!
//! **The key decision: we write the SVG ourselves and use no plotting library.** A figure is one file in the repository next to
//! the numbers that it shows. It follows the page's light or dark scheme, which takes a style sheet inside the file; a new run
//! that finds the same numbers writes the same bytes, so that a changed figure is a changed result; it carries no raster and no
//! font; and what the reproductions draw (points, lines, bounds, small maps, trees) takes a few hundred lines.
//!
//! Series differ in color (Okabe and Ito's eight, which color-blind readers tell apart), in marker and in dash.
//!
//! What is not here: interaction, error bars, surfaces.

mod axis;
mod canvas;
mod chart;
mod grid;
mod labels;
mod legend;
mod number;
mod plot;
mod style;
mod tree;

pub use axis::{Axis, Scale};
pub use chart::{Chart, Mark, Series};
pub use grid::GridDrawing;
pub use tree::TreeDrawing;
