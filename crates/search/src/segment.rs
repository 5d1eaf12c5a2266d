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

/// The cost of a segment over N(k): of its move, taken once or several times in a row.
pub(crate) fn move_cost(v: Vector) -> Cost {
    let times = v.gcd().max(1);
    Cost::of_move(Vector::new(v.x / times as i32, v.y / times as i32)) * times
}

/// The cost of a segment at any angle by which paths are compared that are equally long, or nearly so: that
/// of √d, a times, where the length is a·√d and d has no square divisor.
///
/// The roots of such d are linearly independent over the rationals (Besicovitch 1940). So the lengths of two
/// paths are equal only if for each d they have the same sum of a, and then their costs are equal, too.
pub(crate) fn length_cost(v: Vector) -> Cost {
    let mut a = v.gcd().max(1);
    // A sum of two squares without common divisor: 4 does not divide it, and its odd prime divisors are 1
    // more than a multiple of 4.
    let (mut rest, mut d) = (v.norm_squared() / u64::from(a).pow(2), 1);
    if rest > 0 && rest % 2 == 0 {
        (d, rest) = (2, rest / 2);
    }
    for p in (5..).step_by(4).take_while(|p| p * p * p <= v.norm_squared()) {
        while rest % (p * p) == 0 {
            (a, rest) = (a * p as u32, rest / (p * p));
        }
        if rest % p == 0 {
            (d, rest) = (d * p, rest / p);
        }
        if p * p * p > rest {
            break;
        }
    }
    // The rest is odd and has two prime divisors at most.
    let root = rest.isqrt();
    if root * root == rest {
        a *= root as u32;
    } else {
        d *= rest;
    }
    // IEEE 754 rounds the root correctly: the same d gives the same cost.
    Cost::from_bits(((d as f64).sqrt() * (1_u64 << Cost::FRACTION_BITS) as f64 + 0.5) as u64) * a
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

    /// a and d of a·√d, by trial of all squares.
    fn parts(square: u64) -> (u64, u64) {
        let a = (1..=square.isqrt()).rev().find(|a| square.is_multiple_of(a * a)).unwrap_or(1);
        (a, square / (a * a))
    }

    #[test]
    fn equally_long_segments_cost_the_same() {
        let root = |d: u64| length_cost(Vector::new(1, 0)).to_f64() * (d as f64).sqrt();
        let mut of_root = std::collections::BTreeMap::new();
        let mut rng = Rng::new(1);
        let near = (-60..=60).flat_map(|x| (0..=60).map(move |y| Vector::new(x, y)));
        let far = (0..300).map(|_| Vector::new(rng.below(3_000) as i32, rng.below(3_000) as i32));
        let ends = [(32_768, 32_768), (7, 24), (24_000, 7_000), (17_303, 21_001)].map(Vector::from);
        for v in near.chain(far).chain(ends).filter(|v| v.norm_squared() > 0) {
            let ((a, d), cost) = (parts(v.norm_squared()), length_cost(v));
            let one = *of_root.entry(d).or_insert(cost.to_bits() / a);
            assert_eq!(cost.to_bits(), one * a, "{v:?} is {a} times the root of {d}");
            assert!((cost.to_f64() - a as f64 * root(d)).abs() <= v.norm() * 2_f64.powi(-32), "{v:?}");
        }
        assert_eq!(length_cost(Vector::new(0, 0)), Cost::ZERO);
        // Two corners of a path, and one: 5√2.
        let [bent, straight] = [[(1, 1), (4, 4)], [(1, 7), (0, 0)]];
        let sum = |parts: [(i32, i32); 2]| length_cost(parts[0].into()) + length_cost(parts[1].into());
        assert_eq!(sum(bent), sum(straight));
    }

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
