//! Estimates of the cost to the goal: lower bounds, and one that is none.

use mediant_grid::{GridGraph, Placement, Vector};
use mediant_moves::Cost;

/// An estimate of what a path over N(k) costs, in the grid graph's fixed-point costs, from the displacement to the goal alone.
pub trait Heuristic: Copy {
    /// Whether it is a lower bound, so that A* with it is optimal.
    const ADMISSIBLE: bool = true;

    /// The estimate for a displacement.
    fn estimate<P: Placement>(self, graph: &GridGraph<P>, to_goal: Vector) -> Cost;
}

/// h_k, the cost on an empty grid (Rivera 2017, 'The 2^k-Tile Heuristic'): the best bound that knows no obstacle, and
/// consistent.
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
/// Rounded so that it stays a lower bound: a move's cost may be 2⁻³³ below its length, so the distance is shortened by 2⁻³²
/// of itself, and cut off. What consistency is lost by that last bit, A* makes good by reopening nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Euclidean;

impl Heuristic for Euclidean {
    #[inline]
    fn estimate<P: Placement>(self, _: &GridGraph<P>, to_goal: Vector) -> Cost {
        const ONE: f64 = (1_u64 << Cost::FRACTION_BITS) as f64;
        // Exact up to the root, which IEEE 754 rounds alike everywhere; the product loses at most one part in 2⁵².
        Cost::from_bits((to_goal.norm() * (ONE - 1.0)) as u64)
    }
}

/// The square of the straight-line distance, in cells: no lower bound but where it is at most 1, so that paths are no longer optimal.
///
/// The farther from the goal, the more it outweighs the cost of the path, and the more the search runs straight ahead (SED of Teleiša &
/// Čalnerytė 2023, Section 2.3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SquaredEuclidean;

impl Heuristic for SquaredEuclidean {
    const ADMISSIBLE: bool = false;

    #[inline]
    fn estimate<P: Placement>(self, _: &GridGraph<P>, to_goal: Vector) -> Cost {
        // On the largest map 2³¹ cells, to which a path adds less than 2³¹: their sum does not overflow.
        Cost::from_bits(to_goal.norm_squared() << Cost::FRACTION_BITS)
    }
}

/// No bound: A* becomes Dijkstra's algorithm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Zero;

impl Heuristic for Zero {
    #[inline]
    fn estimate<P: Placement>(self, _: &GridGraph<P>, _: Vector) -> Cost {
        Cost::ZERO
    }
}
