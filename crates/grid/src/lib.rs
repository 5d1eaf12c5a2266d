//! Bit-packed grid maps, and the rules of motion on them.
//!
//! A [`Grid`] says which cells are blocked. A placement of the vertices ([`Centers`] or [`Corners`]) and a
//! rule of motion turn it into a [`FreeSpace`]: vertices, line of sight, gaps, connected components. With a
//! neighborhood N(k), that becomes a [`GridGraph`], the search graph.
//!
//! **The key decision: no edge is stored, and cells are read 64 at a time.** The legal moves of a vertex are
//! found anew each time that a search expands it. Single steps come from a table over the cells around the
//! vertex. Longer moves come from masks over the rows of cells that they sweep; the masks are arranged as a
//! tree of mediants, in which one blocked cell excludes a whole cone of moves. So a map takes two bits a
//! cell, one of them in a transposed copy. A grid graph adds one byte a cell for the components, or two or
//! four where there are many, and the masks.
//!
//! [`Placement::sweep`] is the only definition of the cells that a segment sweeps. Line of sight, the table
//! and the masks are all derived from it.
//!
//! **Agents of a size** have maps of their own. [`Clearance`] measures once how far each cell is from the
//! nearest obstacle, and makes the map of a disc of any radius from it; [`Grid::for_square`] makes that of an
//! agent of n × n cells. Whatever searches a grid searches these too, and what the agent's paths are worth is
//! proven for each placement and rule. [`Clearance::widest`] finds paths that keep off walls.
//!
//! **One way to stop.** A call that can take longer than some milliseconds has a form that takes an
//! [`Interrupt`], here and in all crates above: a flag, a deadline, or both, asked at bounded intervals of
//! work. A stopped call returns [`Interrupted`], keeps no memory and leaves no thread at work. The plain form
//! is the same with [`Interrupt::NEVER`].
//!
//! Not here: files (`mediant-formats`) and searches (`mediant-search`).
//!
//! ```
//! use std::sync::Arc;
//! use mediant_grid::{Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Vector, Vertex};
//! use mediant_moves::FiniteK;
//!
//! // A wall with a door in row 3.
//! let grid = Arc::new(Grid::from_fn(8, 4, |x, y| x == 4 && y != 3)?);
//! let [west, east] = [(0, 0), (8, 0)].map(Vertex::from);
//!
//! let space = FreeSpace::<Corners>::new(Arc::clone(&grid), DiagonalGap::Open);
//! assert!(space.connected(west, east) && !space.sees(west, east));
//!
//! let graph = GridGraph::<Corners>::new(grid, FiniteK::N16, DiagonalGap::Open)?;
//! assert!(graph.is_legal(west, Vector::new(1, 2)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod ascii;
mod bits;
mod change;
mod clearance;
mod components;
mod footprint;
mod frame;
mod free_space;
mod grid;
mod grid_graph;
mod identity;
mod interrupt;
mod line_of_sight;
#[doc(hidden)]
pub mod names;
mod obstruction;
mod per_motion;
mod placement;
mod point;
mod points;
#[cfg(doctest)]
mod readme;
mod rectangle;
mod room;
mod rules;
#[cfg(feature = "serde")]
mod serialized;
pub mod sight;
mod tables;
#[cfg(feature = "parallel")]
#[doc(hidden)]
pub mod threads;
mod transpose;
mod tree;
mod versions;
mod vertex;

pub use ascii::{AsciiMap, draw};
#[doc(hidden)]
pub use bits::{BitIndex, MatrixEdit, load};
pub use bits::{BitMatrix, BitRow};
pub use change::Change;
pub use clearance::{Clearance, Fit, Outside, SizeError, Widest};
pub use components::{Components, Connectivity};
#[doc(hidden)]
pub use footprint::Footprint;
#[doc(hidden)]
pub use frame::CellOffset;
pub use free_space::FreeSpace;
pub use grid::{Grid, GridError};
pub use grid_graph::{GridGraph, MoveSet, Step};
pub use identity::{Identity, MapId, Mismatch};
#[doc(hidden)]
pub use interrupt::uninterrupted;
pub use interrupt::{Interrupt, Interrupted, StoppedBy};
pub use mediant_moves::Vector;
pub use obstruction::Obstruction;
#[doc(hidden)]
pub use per_motion::{PerMotion, cost_table};
pub use placement::{Centers, Corners, Placement, SweptCells};
pub use point::{Point, PointCoordinate};
pub use rectangle::Rectangle;
#[doc(hidden)]
pub use room::{has_room, room_for, room_in};
pub use rules::{CornerRule, DiagonalGap, PlacementKind, Rules};
#[doc(hidden)]
pub use transpose::transpose;
#[doc(hidden)]
pub use versions::{VersionEdit, Versioned};
pub use vertex::{Coordinate, Vertex, VertexId};
