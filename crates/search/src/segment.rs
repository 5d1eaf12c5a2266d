//! The cost of straight segments.

use mediant_grid::Vector;
use mediant_moves::Cost;

/// The cost of a straight segment: [`Cost::of_move`], computed without an integer root, for segments as long
/// as maps can be (sides of at most 2¹⁵ cells).
#[must_use]
#[inline]
pub fn segment_cost(v: Vector) -> Cost {
    // IEEE 754 rounds the root correctly, to 53 bits. At most 49 of these are needed for the integer, so it
    // is off by 1 at most.
    let root = ((v.norm_squared() as f64).sqrt() * (1_u64 << Cost::FRACTION_BITS) as f64 + 0.5) as u64;
    debug_assert!(v.norm_squared() <= 1 << 32, "{v:?} is longer than any map");
    let above = !is_at_least(v, Cost::from_bits(root));
    let below = is_at_least(v, Cost::from_bits(root + 1));
    Cost::from_bits(root + u64::from(below) - u64::from(above))
}

/// Whether the [`segment_cost`] of a segment is at least `cost`, without any root.
#[inline]
pub(crate) fn is_at_least(v: Vector, cost: Cost) -> bool {
    // The nearest integer to √n is at least r when √n > r − ½, n > r² − r + ¼, which is no integer.
    let (square, r) = (u128::from(v.norm_squared()) << (2 * Cost::FRACTION_BITS), u128::from(cost.to_bits()));
    r == 0 || square > r * (r - 1)
}

#[cfg(test)]
mod tests {
    use mediant_oracle::Rng;

    use super::*;

    #[test]
    fn the_length_of_a_segment_is_the_cost_of_a_move() {
        let mut rng = Rng::new(0);
        let near = (0..300).flat_map(|x| (0..300).map(move |y| Vector::new(x, -y)));
        let far = (0..50_000).map(|_| Vector::new(rng.below(32_769) as i32, rng.below(32_769) as i32));
        let ends = [(32_768, 32_768), (-32_768, 32_767), (32_768, 0)].map(Vector::from);
        for v in near.chain(far).chain(ends) {
            let cost = Cost::of_move(v);
            assert_eq!(segment_cost(v), cost, "{v:?}");
            assert!(is_at_least(v, cost) && !is_at_least(v, Cost::from_bits(cost.to_bits() + 1)), "{v:?}");
        }
    }
}
