//! What a displacement costs where nothing is in the way.

use mediant_grid::Vector;
use mediant_moves::{Cost, CostTable, K, KError};
use mediant_search::segment_cost;

/// h_k, or for every direction the Euclidean length: a norm, in fixed point.
#[derive(Clone, Debug)]
pub(crate) enum Norm {
    GridGraph(CostTable),
    Euclidean,
}

impl Norm {
    pub(crate) fn new(k: K) -> Result<Self, KError> {
        Ok(match k {
            K::Finite(k) => Self::GridGraph(CostTable::new(k)?),
            K::Any => Self::Euclidean,
        })
    }

    #[inline]
    pub(crate) fn length(&self, v: Vector) -> Cost {
        match self {
            Self::GridGraph(costs) => costs.distance(v),
            Self::Euclidean => segment_cost(v),
        }
    }

    /// What the way costs at least, in less time.
    #[inline]
    pub(crate) fn estimate(&self, v: Vector) -> Cost {
        match self {
            Self::GridGraph(costs) => costs.distance(v),
            // On a map at most 2¹⁵ · √2 cells, so that what is cut off is more than the root's rounding.
            Self::Euclidean => Cost::from_bits((v.norm() * (1_u64 << Cost::FRACTION_BITS) as f64) as u64),
        }
    }

    /// The [length](Self::length), finer: of two ways that cost the same over N(k), the one that is shorter in truth weighs less. So the lightest ways
    /// are taut.
    pub(crate) fn weight(&self, v: Vector) -> u128 {
        match self {
            Self::GridGraph(costs) => {
                u128::from(costs.distance(v).to_bits()) << 64 | u128::from(segment_cost(v).to_bits())
            }
            Self::Euclidean => (v.norm() * 2_f64.powi(64)) as u128,
        }
    }
}
