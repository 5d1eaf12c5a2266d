//! The distance h_k, the length of a shortest path over N(k) on an empty grid, computed in three ways; and
//! h_∞.
//!
//! All functions take a displacement of any quadrant and return a length in cells. They agree up to rounding.
//! Use [`distance`] for any k (Hormazábal 2017), a closed form if k is known when the program is written, and
//! [`crate::CostTable::distance`] inside a search.

use core::hint::select_unpredictable;

use crate::{
    FiniteK, Quadrant, Vector,
    decomposition::factorize,
    sector::{MAX_SECTORS, factors_of_sectors, sector},
    sqrt::{integer_sqrt, sqrt},
};

/// h_k(d) for any k and any d, by the iterative algorithm of Hormazábal 2017 (Algorithm 2, whose misprints
/// Kramm 2018, Algorithm 1, corrects). The result is exact to a few units in the last place.
///
/// Up to k = 10 the lengths of the moves are constants, and no branch depends on d: up to k = 6 all moves of
/// an octant are compared with d at once, and h_k is linear in the sector found; from k = 7 the rounds of
/// Algorithm 2 are unrolled. Above k = 10, consecutive rounds on the same side are taken together, which
/// makes about as many steps as Euclid's algorithm takes on d, whatever k is.
///
/// On random displacements it takes about a quarter to a third of the time of [`LinearSearch`], for k = 5, 6,
/// 7; `docs/measurements/moves.md` has the figures. It is always inlined, since a call costs more than h_5
/// itself.
///
/// ```
/// use mediant_moves::{distance, FiniteK, Vector};
/// // (7, 9) = 5·(1, 1) + 2·(1, 2) over the 16-neighborhood (Kramm 2018)
/// let h = distance(Vector::new(7, 9), FiniteK::new(4)?);
/// assert_eq!(h, 5.0 * 2f64.sqrt() + 2.0 * 5f64.sqrt());
/// # Ok::<(), mediant_moves::KError>(())
/// ```
#[must_use]
#[inline(always)]
pub fn distance(d: Vector, k: FiniteK) -> f64 {
    match k.get() {
        2 => manhattan(d),
        3 => by_sector::<1>(d),
        4 => by_sector::<2>(d),
        5 => by_sector::<4>(d),
        6 => by_sector::<MAX_SECTORS>(d),
        7 => by_rounds::<5>(d),
        8 => by_rounds::<6>(d),
        9 => by_rounds::<7>(d),
        10 => by_rounds::<ROUNDS>(d),
        _ => distance_at_large_k(d, k.depth()),
    }
}

/// h_k(d) for N = 2^(k − 3) sectors an octant.
#[inline(always)]
fn by_sector<const N: usize>(d: Vector) -> f64 {
    let (x, y) = sorted(d);
    let (factors_x, factors_y) = const { &factors_of_sectors::<N>() };
    let j = sector::<N>(x, y);
    factors_x[j] * f64::from(x) + factors_y[j] * f64::from(y)
}

/// h_k(d) for k − 2 = N ≤ [`ROUNDS`] rounds, which the compiler unrolls.
#[inline(always)]
fn by_rounds<const N: u32>(d: Vector) -> f64 {
    let (mut x, mut y) = sorted(d);
    // The first round always falls to this side. Instead of the two moves, the index of the pair is kept.
    y -= x;
    let mut index = 0;
    for _ in 1..N {
        let beyond = x > y;
        index = 2 * index + usize::from(beyond);
        (x, y) = select_unpredictable(beyond, (x.wrapping_sub(y), y), (x, y.wrapping_sub(x)));
    }
    let stride = 1 << (ROUNDS - N);
    f64::from(y) * LENGTHS[index * stride] + f64::from(x) * LENGTHS[(index + 1) * stride]
}

/// The largest number of rounds for which the lengths of all moves are constants: that of k = 10.
const ROUNDS: u32 = 8;

/// The lengths of the moves of Q(8) from (0, 1) to (1, 1). Every 2^(8 − i)-th of them belongs to Q(i).
static LENGTHS: [f64; (1 << (ROUNDS - 1)) + 1] = {
    let Ok(k) = FiniteK::new(ROUNDS + 2) else { panic!("a constant k") };
    let Ok(quadrant) = Quadrant::new(k) else { panic!("a constant k") };
    let mut lengths = [0.0; (1 << (ROUNDS - 1)) + 1];
    let mut i = 0;
    while i < lengths.len() {
        let Some(v) = quadrant.get(i as u64) else { panic!("an octant is part of the quadrant") };
        lengths[i] = integer_sqrt(v.norm_squared() as f64);
        i += 1;
    }
    lengths
};

/// h_k(d) in about as many steps as Euclid's algorithm takes on d, or fewer.
#[inline(never)]
fn distance_at_large_k(d: Vector, rounds: u32) -> f64 {
    let (x, y) = sorted(d);
    let parts = factorize(x, y, rounds);
    let norm = |(x, y): (u64, u64)| {
        let (x, y) = (x as f64, y as f64);
        sqrt(x * x + y * y)
    };
    f64::from(parts.times_low) * norm(parts.low) + f64::from(parts.times_high) * norm(parts.high)
}

/// h_∞(d): the Euclidean distance, which h_k approaches from above.
#[must_use]
#[inline]
pub fn distance_any_angle(d: Vector) -> f64 {
    d.norm()
}

/// h_2(d), the Manhattan distance.
#[must_use]
#[inline]
pub fn manhattan(d: Vector) -> f64 {
    let (x, y) = d.abs();
    f64::from(x) + f64::from(y)
}

const SQRT_2: f64 = core::f64::consts::SQRT_2;
const SQRT_5: f64 = 2.236_067_977_499_79;
const SQRT_10: f64 = 3.162_277_660_168_379_5;
const SQRT_13: f64 = 3.605_551_275_463_989;

/// |x| and |y|, the smaller one first.
#[inline]
fn sorted(d: Vector) -> (u32, u32) {
    let (x, y) = d.abs();
    (x.min(y), x.max(y))
}

/// [`sorted`] as `f64`.
#[inline]
fn sorted_f64(d: Vector) -> (f64, f64) {
    let (x, y) = sorted(d);
    (f64::from(x), f64::from(y))
}

/// h_3(d), the octile distance, in closed form (Rivera 2017, Algorithm 1, h₈).
#[must_use]
#[inline]
pub fn octile(d: Vector) -> f64 {
    let (x, y) = sorted_f64(d);
    (y - x) + SQRT_2 * x
}

/// h_4(d) in closed form (Rivera 2017, Algorithm 1, h₁₆).
#[must_use]
#[inline]
pub fn distance_16(d: Vector) -> f64 {
    let (x, y) = sorted_f64(d);
    if 2.0 * x < y { (y - 2.0 * x) + SQRT_5 * x } else { SQRT_5 * (y - x) + SQRT_2 * (2.0 * x - y) }
}

/// h_5(d) in closed form (Rivera 2017, Algorithm 1, h₃₂; Hormazábal 2017, Algorithm 1).
#[must_use]
#[inline]
pub fn distance_32(d: Vector) -> f64 {
    let (x, y) = sorted_f64(d);
    if 3.0 * x < y {
        (y - 3.0 * x) + SQRT_10 * x
    } else if 2.0 * x < y {
        SQRT_10 * (y - 2.0 * x) + SQRT_5 * (3.0 * x - y)
    } else if 3.0 * x < 2.0 * y {
        SQRT_5 * (2.0 * y - 3.0 * x) + SQRT_13 * (2.0 * x - y)
    } else {
        SQRT_13 * (y - x) + SQRT_2 * (3.0 * x - 2.0 * y)
    }
}

/// h_k by a linear search over the moves of Q(k − 2) (Rivera 2017, 'The 2^k-Tile Heuristic', steps 1 and 2):
/// find the two moves that contain d, then solve for their factors (Eq. 14).
///
/// It stores the moves of one octant with their lengths, since the quadrant is symmetric. Its time grows with
/// 2^k. It is here because the papers compare with it; [`distance`] is faster.
#[cfg(feature = "alloc")]
#[derive(Clone, Debug)]
pub struct LinearSearch {
    octant: alloc::vec::Vec<(Vector, f64)>,
}

#[cfg(feature = "alloc")]
impl LinearSearch {
    /// The moves of Q(k − 2) from (0, 1) to (1, 1), or to (1, 0) at k = 2.
    ///
    /// # Errors
    /// [`KError::TooLarge`](crate::KError::TooLarge) above k = 24, whose table would take more than 64 MiB.
    pub fn new(k: FiniteK) -> Result<Self, crate::KError> {
        const MAX: u32 = 24;
        if k.get() > MAX {
            return Err(crate::KError::TooLarge { k: k.get().into(), max: MAX });
        }
        let octant = crate::Quadrant::new(k)?.iter().filter(|v| v.x <= v.y || k.get() == 2);
        Ok(Self { octant: octant.map(|v| (v, v.norm())).collect() })
    }

    /// h_k(d).
    #[must_use]
    pub fn distance(&self, d: Vector) -> f64 {
        let (x, y) = d.abs();
        let (x, y) = (i64::from(x.min(y)), i64::from(x.max(y)));
        let det = |v: Vector| x * i64::from(v.y) - y * i64::from(v.x);
        let mut pairs = self.octant.iter().zip(&self.octant[1..]);
        // The first pair whose second move is at or beyond d. There is one: the last move, (1, 1) or (1, 0),
        // always is.
        let Some((&(u, norm_u), &(v, norm_v))) = pairs.find(|&(_, &(v, _))| det(v) <= 0) else { return 0.0 };
        (-det(v)) as f64 * norm_u + det(u) as f64 * norm_v
    }
}
