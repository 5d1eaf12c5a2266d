//! How much longer than the any-angle optimum a path over N(k) can be.

use crate::{FiniteK, sqrt::sqrt};

/// Γ_k with vertices at cell corners: cost(k) ≤ Γ_k · cost(∞) between any two vertices of any grid (Kramm
/// 2018, Theorem 2; on an empty grid also with vertices at centers, Theorem 10). It falls as 1 + 1/(8k²), and
/// is tight.
///
/// The theorem is about open gaps between diagonally touching obstacles. It holds for closed ones too: the
/// path of adjacent moves that replaces a legal segment stays in the cells that the segment enters (Lemmas 11
/// to 13). Of the two free cells at a gap the segment enters at most one, or it would pass through the gap or
/// a blocked cell; so the path, too, stays in one free quadrant there.
///
/// ```
/// use mediant_moves::{bound_at_corners, FiniteK};
/// assert!((bound_at_corners(FiniteK::new(3)?) - 1.0824).abs() < 1e-4);
/// # Ok::<(), mediant_moves::KError>(())
/// ```
#[must_use]
pub fn bound_at_corners(k: FiniteK) -> f64 {
    // s − m = 1 / (s + m), which spares the subtraction of nearly equal numbers.
    let m = f64::from(k.depth());
    let s = sqrt(m * m + 1.0);
    sqrt(2.0 * s / (s + m))
}

/// Γ_k with vertices at cell centers: 6 / (2 + √2) for k = 2 and 3√2 − 3 for every k ≥ 3 (Kramm 2018, Theorem
/// 3, Eq. 2), tight: more moves do not help the worst case here.
///
/// The theorem compares with any-angle paths that may bend at cell corners. By test
/// (`crates/search/tests/kramm2018.rs`), with the corner rules of `mediant-grid` for the moves:
/// - `One`, against corner paths with closed gaps: it holds, and is attained.
/// - `Always`: it fails. An any-angle path may run straight through the gaps between diagonally touching
///   obstacles; k = 2 then has no bound at all, and one map gives 4√2 / (3 + √2) ≈ 1.2815 for every k from 3
///   to 8.
/// - `Never`: it fails. (2, 1) can be legal where (1, 1) is not, and then k = 3 takes three steps, 3/√5 ≈
///   1.342 times the straight line. There [`BOUND_WITHOUT_CORNER_CUTTING`] holds.
#[must_use]
pub fn bound_at_centers(k: FiniteK) -> f64 {
    let root = core::f64::consts::SQRT_2;
    if k == FiniteK::N4 { 6.0 / (2.0 + root) } else { 3.0 * root - 3.0 }
}

/// √2: at centers, where no move may touch an obstacle, no shortest path over N(k) exceeds the any-angle
/// optimum under the same rule by more, for every k ≥ 2. Those any-angle paths run between centers and touch
/// no obstacle either. The cells that a legal segment touches are then a chain of edge neighbors that only
/// goes on in two directions, so axis moves can follow it, and
/// |x| + |y| ≤ √2 · ‖(x, y)‖. For k = 3 it is tight: beside a
/// staircase of obstacles (n, n − 1) can be legal and no diagonal step.
pub const BOUND_WITHOUT_CORNER_CUTTING: f64 = core::f64::consts::SQRT_2;

/// The smallest k whose [`bound_at_corners`] is at most `ratio`; `None` unless `ratio` exceeds 1 by at least
/// 2⁻⁴³, which takes k = 2²⁰.
///
/// ```
/// use mediant_moves::smallest_k_at_corners;
/// assert_eq!(smallest_k_at_corners(1.01).map(|k| k.get()), Some(6));
/// assert_eq!(smallest_k_at_corners(1.0), None);
/// ```
#[must_use]
pub fn smallest_k_at_corners(ratio: f64) -> Option<FiniteK> {
    let meets = |k: u32| FiniteK::new(k).is_ok_and(|k| bound_at_corners(k) <= ratio);
    // Up to here the rounded Γ never rises with k (a test looks at each); much beyond, its distance from 1
    // drowns in rounding.
    const MAX: u32 = 1 << 20;
    if !meets(MAX) {
        return None;
    }
    let (mut low, mut high) = (2, MAX);
    while low < high {
        let middle = low + (high - low) / 2;
        if meets(middle) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    FiniteK::new(low).ok()
}

/// The smallest k whose [`bound_at_centers`] is at most `ratio`; `None` below 3√2 − 3 ≈ 1.2426, which no k
/// can promise.
#[must_use]
pub fn smallest_k_at_centers(ratio: f64) -> Option<FiniteK> {
    [FiniteK::N4, FiniteK::N8].into_iter().find(|&k| bound_at_centers(k) <= ratio)
}
