//! Levels of moves, and the two parents whose mediant a move is.

use crate::{FiniteK, Vector};

/// level(v): the smallest k with v ∈ N(k) (Kramm 2018, before Lemma 12), for a move of any quadrant; `None`
/// for a vector that is not a move (gcd ≠ 1).
///
/// The level of a mediant is 1 + the larger one of its parents' levels (misprinted as their sum). It is
/// computed by Euclid's algorithm, as 2 plus the sum of the terms of the continued fraction of |x| / |y|.
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

/// The two adjacent moves v₁, v₂ whose mediant is v = v₁ + v₂ (Kramm 2018, Algorithm 2, line 9). v₁ is nearer
/// to the axis on which the quadrant of v begins. `None` for axis moves and for vectors that are not moves.
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
    // Follow the pair of adjacent moves that contains u from level to level. Just before u itself is inserted
    // as their mediant, the two are its parents. Steps on the same side are taken together, as in the
    // continued fraction of u.x / u.y.
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

/// Whether u and v are adjacent moves of N(k): different moves with no move of N(k) between them (Kramm 2018,
/// 'The 2^k Neighborhood'). Equivalently, both are in N(k) and in one closed quadrant, |det(u, v)| = 1
/// (Proposition 4), and u + v is not in N(k).
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
