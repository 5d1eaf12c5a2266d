//! Bounds on the length of a shortest path over N(k), relative to the shortest any-angle path.

use crate::{FiniteK, sqrt::sqrt};

/// Γ_k with vertices at cell corners: cost(k) ≤ Γ_k · cost(∞) between any two vertices of any grid (Kramm
/// 2018, Theorem 2; on an empty grid also with vertices at centers, Theorem 10). It falls as 1 + 1/(8k²), and
/// is tight.
///
/// The theorem assumes open gaps between diagonally touching obstacles. It also holds for closed ones. The
/// path of adjacent moves that replaces a legal segment stays in the cells that the segment enters (Lemmas 11
/// to 13). Of the two free cells at a gap the segment enters at most one; otherwise it would pass through the
/// gap or a blocked cell. So the path stays in one free quadrant there, too.
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
/// 3, Eq. 2). It is tight: more moves do not improve the worst case here.
///
/// The theorem compares with any-angle paths that may bend at cell corners. With the corner rules of
/// `mediant-grid` for the moves, `crates/search/tests/it/kramm2018.rs` tests:
/// - `One`, against corner paths with closed gaps: it is attained, but at k = 3 it fails. Where a path
///   follows walls on both sides in turn, moves between centers zigzag around it: one map gives (6√2 + 2) /
///   (7 + √2) ≈ 1.2461. Against paths that bend at centers it holds, since steps of N(3) follow every legal
///   line there.
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

/// √2: the bound at centers if no move may touch an obstacle. For every k ≥ 2, a shortest path over N(k) is
/// at most √2 times as long as the shortest any-angle path between centers that touches no obstacle either.
///
/// Proof: the cells that a legal segment touches form a chain of edge neighbors that advances in two
/// directions only. So axis moves can follow it, and |x| + |y| ≤ √2 · ‖(x, y)‖. For k = 3 the bound is tight:
/// beside a staircase of obstacles (n, n − 1) can be legal where no diagonal step is.
pub const BOUND_WITHOUT_CORNER_CUTTING: f64 = core::f64::consts::SQRT_2;

/// The smallest k whose [`bound_at_corners`] is at most `ratio`. `None` if that would be above k = 2²⁰, whose
/// bound exceeds 1 by about 2⁻⁴³.
///
/// ```
/// use mediant_moves::smallest_k_at_corners;
/// assert_eq!(smallest_k_at_corners(1.01).map(|k| k.get()), Some(6));
/// assert_eq!(smallest_k_at_corners(1.0), None);
/// ```
#[must_use]
pub fn smallest_k_at_corners(ratio: f64) -> Option<FiniteK> {
    let meets = |k: u32| FiniteK::new(k).is_ok_and(|k| bound_at_corners(k) <= ratio);
    // Up to here the rounded Γ never rises with k (a test checks each). Far beyond, its difference from 1 is
    // lost in rounding.
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

/// The smallest k whose [`bound_at_centers`] is at most `ratio`; `None` if `ratio` is below 3√2 − 3 ≈ 1.2426,
/// the bound for all larger k.
#[must_use]
pub fn smallest_k_at_centers(ratio: f64) -> Option<FiniteK> {
    [FiniteK::N4, FiniteK::N8].into_iter().find(|&k| bound_at_centers(k) <= ratio)
}
