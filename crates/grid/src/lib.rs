//! Bit-packed grid maps and the rules of motion on them. (Story: written with the last module.)

mod ascii;
mod bits;
mod grid;
mod rules;
mod vertex;

pub use ascii::{AsciiMap, draw};
pub use bits::{BitIndex, BitMatrix, load};
pub use grid::{Grid, GridError};
pub use mediant_moves::Vector;
pub use rules::{CornerRule, DiagonalGap, Placement, Rules};
pub use vertex::{Vertex, VertexId};
