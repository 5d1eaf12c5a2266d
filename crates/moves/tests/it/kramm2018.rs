//! Kramm, Rivera, Hernández, Baier 2018, 'A Suboptimality Bound for 2^k Grid Path Planning': each statement
//! that can be executed without obstacles, but for the decomposition (Lemmas 11–13), which has a file of its
//! own.

use crate::common::*;
use mediant_moves::{
    FiniteK, Neighborhood, Quadrant, Vector, bound_at_centers, bound_at_corners, decompose, distance, level,
    octile,
};

/// A little more than 1, for what two computations in `f64` may differ by.
const ROUNDING: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Γ_k as Theorems 2 and 10 print it.
fn gamma(n: u32) -> f64 {
    let m = f64::from(n) - 2.0;
    let s = (m * m + 1.0).sqrt();
    (2.0 * s * (s - m)).sqrt()
}

/// The moves of the first quadrant that are adjacent, by the naive definition.
fn adjacent_pairs(n: u32) -> Vec<(Pair, Pair)> {
    naive_quadrant(n).windows(2).map(|two| (two[0], two[1])).collect()
}

/// The angle from the first to the second direction, from their angles with the X axis.
fn angle(u: Pair, v: Pair) -> f64 {
    let to_x_axis = |(x, y): Pair| (y as f64).atan2(x as f64);
    (to_x_axis(u) - to_x_axis(v)).abs()
}

#[test]
fn equation_1_the_determinant() {
    let mut random = Random::new();
    let seed = random.seed;
    for _ in 0..5_000 {
        let (u, v) = (random.vector(15), random.vector(15));
        assert_eq!(u.det(v), i128::from(det(pair(u), pair(v))), "{u:?}, {v:?}, seed {seed}");
        let sine = (f64::from(v.y).atan2(f64::from(v.x)) - f64::from(u.y).atan2(f64::from(u.x))).sin();
        let whole = u.norm() * v.norm();
        assert!((u.det(v) as f64 - whole * sine).abs() <= 1e-14 * whole, "{u:?}, {v:?}, seed {seed}");
    }
    let (big, small) = (Vector::new(i32::MIN, i32::MAX), Vector::new(i32::MAX, i32::MIN));
    let (min, max) = (i128::from(i32::MIN), i128::from(i32::MAX));
    assert_eq!(big.det(small), min * min - max * max);
}

#[test]
fn theorem_1_the_distance_by_the_adjacent_moves_that_contain_the_vertex() {
    for n in 2..=14 {
        let moves = naive_quadrant(n);
        for d in square(24) {
            let parts = decompose(vector(d), k(n)).expect("a small vector");
            let sum = add(times(parts.alpha.into(), pair(parts.v)), times(parts.beta.into(), pair(parts.w)));
            assert_eq!(sum, d, "contained, k = {n}");
            assert_close(parts.length(), naive_distance(d, &moves), format!("k = {n}, {d:?}"));
        }
    }
}

/// The paper calls the neighborhood that holds (7, 9) the 512-neighborhood; the 256-neighborhood, k = 8,
/// already does.
#[test]
fn example_factorization_of_7_9() {
    let expected: [[(u32, Pair); 2]; 8] = [
        [(9, (0, 1)), (7, (1, 0))],
        [(2, (0, 1)), (7, (1, 1))],
        [(2, (1, 2)), (5, (1, 1))],
        [(2, (2, 3)), (3, (1, 1))],
        [(2, (3, 4)), (1, (1, 1))],
        [(1, (3, 4)), (1, (4, 5))],
        [(0, (3, 4)), (1, (7, 9))],
        [(0, (10, 13)), (1, (7, 9))],
    ];
    for (n, factors) in (2..).zip(expected) {
        let parts = decompose(Vector::new(7, 9), k(n)).expect("a small vector");
        assert_eq!([(parts.alpha, pair(parts.v)), (parts.beta, pair(parts.w))], factors, "k = {n}");
    }
    assert_eq!(level(Vector::new(7, 9)), Some(8));
}

#[test]
fn proposition_4_adjacent_moves_have_determinant_1() {
    for n in 2..=14 {
        assert!(adjacent_pairs(n).iter().all(|&(u, v)| det(u, v) == -1), "k = {n}");
        let whole: Vec<Vector> = Neighborhood::new(k(n)).expect("a small k").iter().collect();
        for (i, u) in whole.iter().enumerate() {
            assert_eq!(u.det(whole[(i + 1) % whole.len()]), -1, "k = {n}, {u:?}");
        }
    }
}

#[test]
fn proposition_5_the_sine_between_adjacent_moves() {
    for n in 2..=14 {
        for (u, v) in adjacent_pairs(n) {
            let (sine, expected) = (angle(u, v).sin(), 1.0 / (norm(u) * norm(v)));
            assert!((sine - expected).abs() <= 4.0 * f64::EPSILON, "k = {n}, {u:?}, {v:?}");
        }
    }
}

#[test]
fn proposition_6_no_move_is_shorter_than_1() {
    for n in 2..=16 {
        assert!(Quadrant::new(k(n)).expect("a small k").iter().all(|v| v.norm() >= 1.0), "k = {n}");
    }
}

/// The proof says that the larger factor falls in each round until the smaller one is 0; the exception is the
/// last of them, from two equal factors (here 1 and 1) to 1 and 0.
#[test]
fn proposition_7_relative_primes_are_a_move_of_some_neighborhood() {
    for d in first_quadrant(70).filter(|&(p, q)| gcd(p, q) == 1) {
        let r = level(vector(d)).expect("relative primes");
        if r <= FiniteK::MAX_MOVES.get() {
            assert!(Quadrant::new(k(r)).expect("at most 47").index_of(vector(d)).is_some(), "{d:?}, k = {r}");
        }
        let mut largest = u32::MAX;
        for n in 2..r + 3 {
            let parts = decompose(vector(d), k(n)).expect("a small vector");
            let (low, high) = (parts.alpha.min(parts.beta), parts.alpha.max(parts.beta));
            assert!(high < largest || n >= r, "the larger factor falls: {d:?}, k = {n}");
            assert_eq!(low == high, n + 1 == r, "{d:?}, k = {n}");
            assert_eq!(low == 0, n >= r, "{d:?}, k = {n}");
            if n >= r {
                let stable = if parts.alpha == 1 { parts.v } else { parts.w };
                assert_eq!((high, pair(stable)), (1, d), "k = {n}");
            }
            largest = high;
        }
    }
}

/// Eq. 3, with m = q / p (the text says p / q), for v that comes after w in our order, so that det(v, w) = 1.
fn ratio(m: f64, v: Pair, w: Pair) -> f64 {
    let [vx, vy, wx, wy] = [v.0, v.1, w.0, w.1].map(|c| c as f64);
    ((wy - m * wx) * norm(v) + (m * vx - vy) * norm(w)) / (m * m + 1.0).sqrt()
}

#[test]
fn equations_3_to_5_the_direction_of_the_largest_ratio() {
    for n in 2..=14 {
        for (w, v) in adjacent_pairs(n) {
            let [vx, vy, wx, wy] = [v.0, v.1, w.0, w.1].map(|c| c as f64);
            let best = (vx * norm(w) - wx * norm(v)) / (wy * norm(v) - vy * norm(w));
            let cosine = dot(v, w) as f64 / (norm(v) * norm(w));
            let by_4 = 2f64.sqrt() * norm(v) * norm(w) * (1.0 - cosine).sqrt();
            let by_5 = 2.0 * (angle(v, w) / 2.0).sin() / angle(v, w).sin();
            // Both the differences in Eq. 3 and that in Eq. 4 cancel digits, the more the smaller the angle.
            let magnified = norm(v) * norm(w);
            let (of_3, of_4) = (8.0 * f64::EPSILON * magnified, 8.0 * f64::EPSILON * magnified.powi(2));
            assert!((ratio(best, v, w) - by_5).abs() <= of_3, "m⁺, k = {n}, {v:?}, {w:?}");
            assert!((by_4 - by_5).abs() <= of_4, "Eq. 4 and 5, k = {n}, {v:?}, {w:?}");
            // Directions between v and w, as a·v + (64 − a)·w.
            for a in 1..=64 {
                let (p, q) = add(times(a, v), times(64 - a, w));
                let m = q as f64 / p as f64;
                assert!(ratio(m, v, w) <= by_5 + of_3, "k = {n}, {v:?}, {w:?}, m = {m}");
                let by_distance = distance(vector((p, q)), k(n)) / norm((p, q));
                assert!((ratio(m, v, w) - by_distance).abs() <= of_3, "Eq. 3, k = {n}, ({p}, {q})");
            }
        }
    }
}

#[test]
fn lemma_8_the_bound_between_two_moves() {
    for n in 2..=14 {
        for (v, w) in adjacent_pairs(n) {
            let alpha = angle(v, w);
            let bound = 2.0 * (alpha / 2.0).sin() / alpha.sin();
            for (a, b) in first_quadrant(6).filter(|&d| d != (0, 0)) {
                let u = add(times(a, v), times(b, w));
                assert!(distance(vector(u), k(n)) / norm(u) <= bound * ROUNDING, "k = {n}, {u:?}");
            }
        }
    }
}

/// In integers: the tangent of the angle between two moves is |det| over their scalar product.
#[test]
fn lemma_9_the_first_angle_is_the_largest() {
    for n in 2..=16 {
        let moves = naive_quadrant(n);
        let (first, second) = (moves[0], moves[1]);
        assert_eq!(second, (1, i64::from(n) - 2), "the second move (Theorem 10)");
        for odd in moves.iter().skip(1).step_by(2) {
            assert!(dot(second, second) <= dot(*odd, *odd), "R1, k = {n}, {odd:?}");
        }
        for two in moves.windows(2) {
            let (u, v) = (two[0], two[1]);
            let larger = det(first, second).abs() * dot(u, v) >= det(u, v).abs() * dot(first, second);
            assert!(larger, "R2, k = {n}, {u:?}, {v:?}");
        }
    }
}

#[test]
fn theorem_10_no_vertex_of_an_empty_grid_exceeds_the_bound() {
    let mut random = Random::new();
    let seed = random.seed;
    let far: Vec<Vector> = (0..3_000).map(|_| random.vector(31)).filter(|&d| d != Vector::ZERO).collect();
    for n in 2..=14 {
        let bound = bound_at_corners(k(n));
        for d in first_quadrant(150).filter(|&d| d != (0, 0)) {
            let ratio = distance(vector(d), k(n)) / norm(d);
            assert!((1.0 / ROUNDING..=bound * ROUNDING).contains(&ratio), "k = {n}, {d:?}: {ratio}");
        }
        for &d in &far {
            let ratio = distance(d, k(n)) / d.norm();
            assert!((1.0 / ROUNDING..=bound * ROUNDING).contains(&ratio), "k = {n}, {d:?}, seed {seed}");
        }
    }
}

#[test]
fn theorem_2_the_values_of_the_bound() {
    for n in 2..=200 {
        // As printed, s − (k − 2) loses digits as k² grows.
        let tolerance = f64::EPSILON * f64::from(n).powi(2);
        assert!((bound_at_corners(k(n)) - gamma(n)).abs() <= tolerance, "k = {n}");
    }
    assert_close(bound_at_corners(k(2)), 2f64.sqrt(), "4-connected");
    assert_close(bound_at_corners(k(3)), (4.0 - 2.0 * 2f64.sqrt()).sqrt(), "8-connected");
    assert!((bound_at_corners(k(3)) - 1.0824).abs() < 5e-5, "as the introduction rounds it");
}

/// 1 + 1/(8k²) + O(1/k³): the factor of 1/k³ tends to ½.
#[test]
fn theorem_2_the_bound_falls_quadratically() {
    for n in [10_u32, 100, 1_000, 10_000] {
        let cubed = f64::from(n).powi(3);
        let rest = bound_at_corners(k(n)) - 1.0 - 1.0 / (8.0 * f64::from(n).powi(2));
        // The subtraction of 1 leaves ε / 2, which k³ magnifies.
        let tolerance = 5.0 / f64::from(n) + cubed * f64::EPSILON;
        assert!((rest * cubed - 0.5).abs() <= tolerance, "k = {n}: {}", rest * cubed);
    }
}

/// The goal must lie on the bisector of (0, 1) and (1, k − 2): (n, ⌊n(s + (k − 2))⌋). The paper's formula has
/// lost a parenthesis, and as ⌊n·s + (k − 2)⌋ it misses the bound from k = 3 on. Its count of moves (0, 1)
/// lacks the factor k − 2.
#[test]
fn theorem_2_the_bound_is_tight() {
    const N: i32 = 10_000_000;
    for n in 2..=14 {
        let m = f64::from(n) - 2.0;
        let s = (m * m + 1.0).sqrt();
        let ratio = |y: f64| {
            let goal = Vector::new(N, y.floor() as i32);
            distance(goal, k(n)) / goal.norm()
        };
        let bound = bound_at_corners(k(n));
        let on_bisector = ratio(f64::from(N) * (s + m));
        assert!((bound - 1e-12..=bound * ROUNDING).contains(&on_bisector), "k = {n}: {on_bisector}");
        let off_bisector = ratio(f64::from(N) * s + m);
        assert_eq!(bound - off_bisector > 1e-5, n > 2, "k = {n}: {off_bisector}");

        let goal = Vector::new(N, (f64::from(N) * (s + m)).floor() as i32);
        let parts = decompose(goal, k(n)).expect("fits");
        let slow = Vector::new(1, n as i32 - 2);
        assert_eq!((parts.v, parts.w, parts.beta), (Vector::new(0, 1), slow, N as u32), "k = {n}");
        assert_eq!(i64::from(parts.alpha), i64::from(goal.y) - i64::from(N) * i64::from(slow.y), "k = {n}");
    }
}

/// Eq. 2 and its two values; more moves do not help at centers.
#[test]
fn theorem_3_the_values_of_the_bound_at_centers() {
    assert_close(bound_at_centers(k(2)), 6.0 / (2.0 + 2f64.sqrt()), "4-connected");
    assert!((bound_at_centers(k(2)) - 1.7573).abs() < 6e-5, "as the introduction cuts it");
    for n in 3..=100 {
        assert_close(bound_at_centers(k(n)), 3.0 * (2f64.sqrt() - 1.0), n);
    }
    for n in 2..=100 {
        assert!(bound_at_centers(k(n)) > bound_at_corners(k(n)), "obstacles cost more at centers, k = {n}");
    }
}

/// The step of Theorem 3's induction, on an empty grid: a path over N(k − 1) is one over N(k).
#[test]
fn theorem_3_more_moves_never_lengthen_a_path() {
    for d in first_quadrant(60) {
        assert!(octile(vector(d)) <= distance(vector(d), k(2)));
        for n in 3..=20 {
            let (less, more) = (distance(vector(d), k(n - 1)), distance(vector(d), k(n)));
            assert!(more <= less * ROUNDING, "k = {n}, {d:?}");
        }
    }
}
