//! Levels of moves and the two moves that each one is the mediant of.

use crate::{FiniteK, Vector};

/// level(v): the smallest k with v ∈ N(k) (Kramm 2018, before Lemma 12), for a move of any quadrant; `None`
/// for a vector that is no move (gcd ≠ 1).
///
/// A mediant's level is 1 + the larger of its parents' levels (the paper prints a sum there). It equals 2
/// plus the sum of the continued fraction terms of |x| / |y|, which is how it is computed: in steps of
/// Euclid's algorithm.
///
/// ```
/// use mediant_moves::{level, Vector};
/// assert_eq!(level(Vector::new(-1, 0)), Some(2));
/// assert_eq!(level(Vector::new(7, 5)), Some(7));
/// assert_eq!(level(Vector::new(4, 2)), None);
/// ```
#[must_use]
pub const fn level(v: Vector) -> Option<u32> {
    if !v.is_move() {
        return None;
    }
    let (mut a, mut b) = v.abs();
    let mut level = 2;
    while b != 0 {
        // The last quotient (divisor 1, remainder 0) counts in full: it ends on an axis move, of level 2.
        level += a / b;
        (a, b) = (b, a % b);
    }
    Some(level)
}

/// The two adjacent moves v₁, v₂ with v = v₁ + v₂ that v is the mediant of (Kramm 2018, Algorithm 2, line 9),
/// v₁ nearer to the axis on which v's quadrant begins; `None` for axis moves and for vectors that are no
/// moves.
///
/// ```
/// use mediant_moves::{parents, Vector};
/// assert_eq!(parents(Vector::new(7, 5)), Some((Vector::new(4, 3), Vector::new(3, 2))));
/// assert_eq!(parents(Vector::new(1, 0)), None);
/// ```
#[must_use]
pub const fn parents(v: Vector) -> Option<(Vector, Vector)> {
    if v.x == i32::MIN || v.y == i32::MIN || !v.is_move() || v.x == 0 || v.y == 0 {
        return None;
    }
    let Some(turns) = v.quadrant() else { return None };
    let u = v.turned_by(4 - turns);
    // The continued fraction of u.x / u.y, taken back by one step at a time, ends on the two parents: they
    // are the pair that contains u just before the mediant that is u itself is inserted.
    let (mut low, mut high) = (Vector::new(0, 1), Vector::new(1, 0));
    let (mut x, mut y) = (u.x, u.y);
    while x != y {
        if x > y {
            let times = (x - 1) / y;
            low = Vector::new(low.x + times * high.x, low.y + times * high.y);
            x -= times * y;
        } else {
            let times = (y - 1) / x;
            high = Vector::new(high.x + times * low.x, high.y + times * low.y);
            y -= times * x;
        }
    }
    Some((low.turned_by(turns), high.turned_by(turns)))
}

/// Whether u and v are adjacent moves of N(k): different, and no move of N(k) lies between them (Kramm 2018,
/// 'The 2^k Neighborhood'). Equivalent: both in N(k), in one closed quadrant, |det(u, v)| = 1 (Proposition 4)
/// and u + v not in N(k).
///
/// ```
/// use mediant_moves::{adjacent, FiniteK, Vector};
/// let (u, v) = (Vector::new(0, 1), Vector::new(1, 1));
/// assert!(adjacent(u, v, FiniteK::new(3)?));
/// assert!(!adjacent(u, v, FiniteK::new(4)?)); // (1, 2) lies between them
/// # Ok::<(), mediant_moves::KError>(())
/// ```
#[must_use]
pub fn adjacent(u: Vector, v: Vector, k: FiniteK) -> bool {
    let same_quadrant = u.dot(v) >= 0;
    let (Some(level_u), Some(level_v)) = (level(u), level(v)) else { return false };
    let mediant_level = 1 + level_u.max(level_v);
    same_quadrant && u.det(v).abs() == 1 && level_u.max(level_v) <= k.get() && mediant_level > k.get()
}
