//! Costs as an index stores them.

use mediant_moves::Cost;

/// The cost of a path within a cluster, as a fixed-point number on 32 bits: in units of 2⁻¹⁶ cells, rounded
/// up, so that h_k never exceeds it. A shortest path within a cluster of 256 × 256 cells is always shorter
/// than 2¹⁶ cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FixedCost(u32);

impl FixedCost {
    /// There is no path.
    pub(crate) const NONE: Self = Self(u32::MAX);
    pub(crate) const ZERO: Self = Self(0);
    const SHIFT: u32 = Cost::FRACTION_BITS - 16;

    pub(crate) fn new(cost: Option<Cost>) -> Self {
        let rounded = |cost: Cost| u32::try_from(cost.to_bits().div_ceil(1 << Self::SHIFT)).ok();
        cost.and_then(rounded).map_or(Self::NONE, Self)
    }

    #[inline]
    pub(crate) fn cost(self) -> Option<Cost> {
        (self != Self::NONE).then(|| Cost::from_bits(u64::from(self.0) << Self::SHIFT))
    }

    pub(crate) const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    pub(crate) const fn to_bits(self) -> u32 {
        self.0
    }

    /// The number of its units.
    #[inline]
    pub(crate) fn to_f64(self) -> f64 {
        f64::from(self.0)
    }

    /// That of so many units, a whole number; none for more than are counted.
    #[inline]
    pub(crate) fn from_f64(units: f64) -> Self {
        // The low bits of 2⁵² + n are those of n.
        Self((units.min(f64::from(u32::MAX)) + (1_u64 << 52) as f64).to_bits() as u32)
    }
}
