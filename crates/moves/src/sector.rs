//! h_k for small k, where an octant has few sectors: the vector is compared with all moves of the octant at
//! once, and h_k is linear in the sector found.

use crate::{FiniteK, Quadrant, Vector};

/// The largest k for which [`sector`] is faster than Hormazábal 2017, Algorithm 2. At k = 7 it takes twice as
/// long.
pub(crate) const MAX_K: u32 = 6;

/// The number of sectors of an octant at [`MAX_K`].
pub(crate) const MAX_SECTORS: usize = 1 << (MAX_K - 3);

/// The first moves of Q(k − 2) for N = 2^(k − 3): sector j of the octant from (0, 1) to (1, 1) lies between
/// the moves j and j + 1.
pub(crate) const fn moves<const N: usize>() -> [Vector; N] {
    let Ok(k) = FiniteK::new(N.ilog2() + 3) else { panic!("a constant k") };
    let Ok(quadrant) = Quadrant::new(k) else { panic!("a constant k") };
    let mut moves = [Vector::ZERO; N];
    let mut j = 0;
    while j < N {
        let Some(v) = quadrant.get(j as u64) else { panic!("an octant is part of the quadrant") };
        moves[j] = v;
        j += 1;
    }
    moves
}

/// The sector of (x, y), 0 ≤ x ≤ y: the number of moves, not counting the first, that come before it. No
/// branch depends on x and y.
#[inline(always)]
pub(crate) fn sector<const N: usize>(x: u32, y: u32) -> usize {
    let moves = const { moves::<N>() };
    let beyond = |v: Vector| u64::from(x) * v.y as u64 > u64::from(y) * v.x as u64;
    // The remainder has no effect, but shows the compiler that the index is in bounds.
    moves[1..].iter().map(|&v| usize::from(beyond(v))).sum::<usize>() % N
}

/// The factors of x and y in the length of (x, y) = (y·w.x − x·w.y)·v + (x·v.y − y·v.x)·w, for adjacent moves
/// v, w of these lengths.
pub(crate) const fn factors((v, norm_v): (Vector, i128), (w, norm_w): (Vector, i128)) -> [i128; 2] {
    [norm_w * v.y as i128 - norm_v * w.y as i128, norm_v * w.x as i128 - norm_w * v.x as i128]
}

/// The [`factors`] of x and those of y in each sector, for lengths in cells. They are in separate arrays,
/// because otherwise the compiler pairs them in vector registers, together with the comparisons before, which
/// takes 1.2–1.4 times as long.
pub(crate) const fn factors_of_sectors<const N: usize>() -> ([f64; N], [f64; N]) {
    // The factors are small differences of the lengths, which therefore need more digits than `f64` has.
    const FRACTION_BITS: u32 = 60;
    const fn with_norm(v: Vector) -> (Vector, i128) {
        (v, ((v.norm_squared() as u128) << (2 * FRACTION_BITS)).isqrt() as i128)
    }
    let (moves, one) = (moves::<N>(), (1_u64 << FRACTION_BITS) as f64);
    let (mut factors_x, mut factors_y) = ([0.0; N], [0.0; N]);
    let mut j = 0;
    while j < N {
        let next = if j + 1 < N { moves[j + 1] } else { Vector::new(1, 1) };
        let [x, y] = factors(with_norm(moves[j]), with_norm(next));
        (factors_x[j], factors_y[j]) = (x as f64 / one, y as f64 / one);
        j += 1;
    }
    (factors_x, factors_y)
}
