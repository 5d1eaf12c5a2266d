//! The length of a displacement where no obstacle is in the way.

use mediant_grid::{Point, Vector, cost_table};
use mediant_moves::{Cost, CostTable, K, KError};

use crate::segment::segment_cost;

/// h_k, or the Euclidean length for k = ∞. Both are norms; values are in fixed point.
#[derive(Clone, Copy, Debug)]
pub enum Metric {
    /// h_k, by the table that the process keeps.
    Hk(&'static CostTable),
    /// The Euclidean length.
    Euclidean,
}

impl Metric {
    /// The metric of N(k).
    ///
    /// # Errors
    /// [`KError::TooLarge`] above [`CostTable::MAX_K`].
    pub fn new(k: K) -> Result<Self, KError> {
        Ok(match k {
            K::Finite(k) => Self::Hk(cost_table(k)?),
            K::Any => Self::Euclidean,
        })
    }

    /// The length of a displacement.
    #[must_use]
    #[inline]
    pub fn distance(self, v: Vector) -> Cost {
        match self {
            Self::Hk(costs) => costs.distance(v),
            Self::Euclidean => segment_cost(v),
        }
    }

    /// The length of the way between two points where no obstacle is in the way; of points that are no
    /// vertices the straight line, rounded down.
    #[must_use]
    pub fn between(self, from: Point, to: Point) -> Cost {
        match from.vertex().zip(to.vertex()) {
            Some((from, to)) => self.distance(from.to(to)),
            None => Cost::from_bits((from.distance(to) * (1_u64 << Cost::FRACTION_BITS) as f64) as u64),
        }
    }

    /// A lower bound on the cost of any path with this displacement, faster than
    /// [`distance`](Self::distance): the heuristic.
    #[must_use]
    #[inline]
    pub fn estimate(self, v: Vector) -> Cost {
        match self {
            Self::Hk(costs) => costs.distance(v),
            // A displacement has at most 2¹⁵ · √2 cells, so truncation takes off more than the root's
            // rounding can add.
            Self::Euclidean => {
                // Signed, as processors convert at once.
                Cost::from_bits((v.norm() * (1_u64 << Cost::FRACTION_BITS) as f64) as i64 as u64)
            }
        }
    }

    /// The pair (h_k, Euclidean length) as one number, ordered lexicographically; the Euclidean length alone
    /// for k = ∞, in more digits than [`distance`](Self::distance). Of two paths with the same cost over
    /// N(k), the shorter line is less. So lexicographically shortest paths are taut.
    #[must_use]
    pub fn lexicographic_length(self, v: Vector) -> u128 {
        match self {
            Self::Hk(costs) => {
                u128::from(costs.distance(v).to_bits()) << 64 | u128::from(segment_cost(v).to_bits())
            }
            Self::Euclidean => (v.norm() * 2_f64.powi(64)) as u128,
        }
    }
}
