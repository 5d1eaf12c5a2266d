//! The mathematics of the 2^k neighborhoods.
//!
//! N(2) is the 4-connected neighborhood, and N(k + 1) has, between each two adjacent moves of N(k), their sum: the
//! *mediant*. That one rule gives the 8-connected grid at k = 3, sixteen moves at k = 4, and every direction in the limit.
//!
//! **The key decision: nothing is enumerated that can be computed.** A quadrant is a level of the Stern–Brocot tree, so the
//! j-th move, the index of a move, the pair of moves around a vector and the distance h_k all come from walking k − 2
//! levels of mediants, in registers; a table is built only where a search wants to look costs up ([`CostTable`]).
//!
//! What is not here: obstacles. What a move sweeps on a map is the business of `mediant-grid`.
//!
//! The crate is `no_std` and has no dependency. Feature `std` (default) takes square roots in hardware; feature `alloc`
//! (default, implied by `std`) adds what needs a heap: [`CostTable`], [`DecompositionTree`], [`LinearSearch`].
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

mod bounds;
mod cost;
mod decomposition;
mod distance;
mod k;
mod level;
mod quadrant;
mod sqrt;
mod vector;

pub use bounds::{bound_at_centers, bound_at_corners, smallest_k_at_centers, smallest_k_at_corners};
pub use cost::Cost;
pub use decomposition::{Decomposition, containing, decompose};
pub use distance::{distance, distance_16, distance_32, distance_any_angle, manhattan, octile};
pub use k::{K, KError};
pub use level::{adjacent, level, parents};
pub use quadrant::{Neighborhood, Parity, Quadrant, QuadrantMoves};
pub use vector::Vector;

#[cfg(feature = "alloc")]
pub use cost::CostTable;
#[cfg(feature = "alloc")]
pub use decomposition::{DecompositionTree, TreeNode};
#[cfg(feature = "alloc")]
pub use distance::LinearSearch;
