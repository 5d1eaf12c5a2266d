//! The rule of all limits on a length.
//!
//! **A length exactly at a limit is within it.** A limit is often a length that was found before, and a
//! length is rounded: over N(k) as a sum of [`Cost`]s, which is off by at most 2⁻³³ of itself, and as a sum
//! of roots in `f64`, which is off by far less. So each limit is taken as longer by 2⁻³¹ of itself, which is
//! room for the rounding of both lengths that are compared. Points may be nearer to each other than vertices:
//! below a cell 2⁻³¹ of a length is less than the unit of costs, and the limit is longer by two units: each
//! segment of such a path may be rounded by half of one.

use mediant_moves::Cost;

/// The part of itself by which a limit is longer.
const ROOM: f64 = 1.0 / (1_u64 << 31) as f64;

/// A limit in cells, with room for rounding.
pub(crate) const fn with_room(cells: f64) -> f64 {
    cells * (1.0 + ROOM)
}

/// The unit of costs that are lengths in cells.
pub(crate) const UNIT: f64 = 1.0 / (1_u64 << Cost::FRACTION_BITS) as f64;

/// The greatest cost within a limit in cells. A limit that is too large, or infinite, becomes the greatest
/// cost.
pub(crate) const fn greatest_cost(cells: f64) -> Cost {
    greatest_cost_in(cells, UNIT)
}

/// The same for costs in another unit, a power of two.
pub(crate) const fn greatest_cost_in(limit: f64, unit: f64) -> Cost {
    // A quotient by a power of two is exact, and the casts saturate.
    let (exact, with_room) = ((limit / unit) as u64, (with_room(limit) / unit) as u64);
    let next = exact.saturating_add(2);
    Cost::from_bits(if with_room > next { with_room } else { next })
}

/// A cost that was found, as a limit.
pub(crate) const fn at_most(cost: Cost) -> Cost {
    let room = cost.to_bits() >> 31;
    Cost::from_bits(cost.to_bits().saturating_add(if room > 2 { room } else { 2 }))
}
