//! Least-cost paths on grids whose cells have a cost a unit of length, from their definitions.
//!
//! The cost of a straight segment is the integral of that cost along it. [`Shares`] says exactly how much of
//! the segment's length each cell has; a move's cost in integers is made from that by a closure of the
//! caller, so that no rule of rounding is repeated here.

mod integral;
mod map;
mod path;
mod random;
mod search;

pub use integral::{Integral, Piece, Shares};
pub use map::WeightedMap;
pub use path::{weighted_path_cost, weighted_path_length};
pub use random::random_weighted;
pub use search::{WeightedGraph, weighted_costs, weighted_lengths};
