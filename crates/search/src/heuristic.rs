//! Heuristics: estimates of the cost to the goal.

use mediant_grid::{GridGraph, Placement, Vector};
use mediant_moves::Cost;

/// An estimate of the cost of a path over N(k) from the displacement to the goal alone, in the grid graph's
/// fixed-point costs.
pub trait Heuristic: Copy {
    /// Whether it never exceeds the cost of a path, so that A* with it is optimal.
    const ADMISSIBLE: bool = true;

    /// The estimate for a displacement.
    fn estimate<P: Placement>(self, graph: &GridGraph<P>, to_goal: Vector) -> Cost;
}

/// h_k, the cost of a path over N(k) on an empty grid (Rivera 2017, 'The 2^k-Tile Heuristic'): consistent,
/// and the best lower bound that does not depend on obstacles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hk;

impl Heuristic for Hk {
    #[inline]
    fn estimate<P: Placement>(self, graph: &GridGraph<P>, to_goal: Vector) -> Cost {
        graph.costs().distance(to_goal)
    }
}

/// The straight-line distance.
///
/// Rounded so that it stays a lower bound: the cost of a move may be 2⁻³³ less than its length, so the
/// distance is shortened by 2⁻³² of itself and rounded down. In the last bit it may be inconsistent; A*
/// reopens nodes where that matters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Euclidean;

impl Heuristic for Euclidean {
    #[inline]
    fn estimate<P: Placement>(self, _: &GridGraph<P>, to_goal: Vector) -> Cost {
        const ONE: f64 = (1_u64 << Cost::FRACTION_BITS) as f64;
        // Everything is exact up to the root, which IEEE 754 rounds alike everywhere; the product loses at
        // most one part in 2⁵².
        Cost::from_bits((to_goal.norm() * (ONE - 1.0)) as u64)
    }
}

/// The square of the straight-line distance in cells (SED of Teleiša & Čalnerytė 2023, Section 2.3). It is
/// inadmissible, except where it is at most 1, so paths are not optimal.
///
/// The farther from the goal, the more it outweighs the cost of the path, and the more the search runs
/// straight ahead.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SquaredEuclidean;

impl Heuristic for SquaredEuclidean {
    const ADMISSIBLE: bool = false;

    #[inline]
    fn estimate<P: Placement>(self, _: &GridGraph<P>, to_goal: Vector) -> Cost {
        // At most 2³¹ cells on the largest map; a path costs less than 2³¹ cells, so their sum does not
        // overflow.
        Cost::from_bits(to_goal.norm_squared() << Cost::FRACTION_BITS)
    }
}

/// Always 0: A* becomes Dijkstra's algorithm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Zero;

impl Heuristic for Zero {
    #[inline]
    fn estimate<P: Placement>(self, _: &GridGraph<P>, _: Vector) -> Cost {
        Cost::ZERO
    }
}
