//! Bit-packed grid maps, and the rules of motion on them.
//!
//! A [`Grid`] says which cells are blocked; a [`FreeSpace`] is what a placement ([`Centers`] or [`Corners`])
//! and a rule of motion make of it: vertices, line of sight, components. With N(k) that is a [`GridGraph`],
//! the search graph.
//!
//! **The key decision: no edge is stored, and no cell is asked for alone.** Which moves are legal at a vertex
//! is found anew each time, from words of 64 cells: single steps by a table over the cells around the vertex,
//! longer moves by masks over the rows that they sweep, arranged as the tree of mediants so that one blocked
//! cell drops all moves beyond it. A map takes two bits a cell, its own and the transposed copy's; a grid
//! graph adds the components, four bytes a cell, and the masks.
//!
//! What a segment sweeps is written down once, in [`Placement::sweep`]; line of sight, the tables and the
//! masks all come from it.
//!
//! What is not here: files (`mediant-formats`) and searches (`mediant-search`).

mod ascii;
mod bits;
mod components;
mod footprint;
mod frame;
mod free_space;
mod grid;
mod grid_graph;
mod line_of_sight;
mod placement;
mod rules;
pub mod sight;
mod tree;
mod vertex;

pub use ascii::{AsciiMap, draw};
#[doc(hidden)]
pub use bits::{BitIndex, load};
pub use bits::{BitMatrix, BitRow};
pub use components::{Components, Connectivity};
#[doc(hidden)]
pub use footprint::{CellOffset, Footprint};
pub use free_space::FreeSpace;
pub use grid::{Grid, GridError, Rectangle};
pub use grid_graph::{GridGraph, MoveSet, Step};
pub use mediant_moves::Vector;
pub use placement::{Centers, Corners, Placement, SweptCells};
pub use rules::{CornerRule, DiagonalGap, PlacementKind, Rules};
pub use vertex::{Vertex, VertexId};
