//! The costs of moves.

use std::fmt::Debug;

use mediant_grid::{GridGraph, Placement, Vertex};
use mediant_moves::Cost;

/// The costs of the moves of a grid graph, for [`LpaStar`](crate::LpaStar) and
/// [`DStarLite`](crate::DStarLite).
///
/// A move costs the same in both directions, and at least its length ([`Step::cost`](mediant_grid::Step)): so
/// h_k stays a lower bound. Its cost depends on nothing but the move and the cells that it sweeps. A path
/// costs less than 2³⁰ cells.
pub trait MoveCosts<P: Placement>: Debug {
    /// Whether a move costs the same wherever it is legal, so that a change of the map changes no cost of a
    /// move that stays legal.
    const ARE_FIXED: bool = false;

    /// The cost of the legal move `index` at `from`; `None` if it may not be taken.
    fn cost(&self, graph: &GridGraph<P>, from: Vertex, index: usize) -> Option<Cost>;
}

/// The lengths of the moves: the costs of the grid graph itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lengths;

impl<P: Placement> MoveCosts<P> for Lengths {
    const ARE_FIXED: bool = true;

    #[inline]
    fn cost(&self, graph: &GridGraph<P>, _: Vertex, index: usize) -> Option<Cost> {
        Some(graph.step(index).cost)
    }
}
