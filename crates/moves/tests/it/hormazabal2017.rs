//! Hormazábal, Díaz, Hernández, Baier 2017, 'Fast and Almost Optimal Any-Angle Pathfinding Using the 2^k
//! Neighborhoods': each statement that can be executed without obstacles.

use crate::common::*;
use mediant_moves::{
    CostTable, FiniteK, LinearSearch, Quadrant, Vector, decompose, distance, distance_32, distance_any_angle,
};

/// x·l + y·r, after some rounds of Algorithm 2.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Factorization {
    x: i128,
    l: (i128, i128),
    y: i128,
    r: (i128, i128),
}

impl Factorization {
    fn start(d: Vector) -> Self {
        Self { x: i128::from(d.x).abs(), l: (1, 0), y: i128::from(d.y).abs(), r: (0, 1) }
    }

    /// The body of the loop, with `k ← k − 1` in every round (the paper prints it in the else branch).
    fn round(self) -> Self {
        let Self { x, l, y, r } = self;
        let sum = (l.0 + r.0, l.1 + r.1);
        if x > y { Self { x: x - y, r: sum, ..self } } else { Self { y: y - x, l: sum, ..self } }
    }

    fn after(d: Vector, rounds: u32) -> Self {
        (0..rounds).fold(Self::start(d), |state, _| state.round())
    }

    /// x‖l‖ + y‖r‖ (the paper prints x‖r‖ + y‖l‖).
    fn length(self) -> f64 {
        let norm = |(x, y): (i128, i128)| ((x * x + y * y) as f64).sqrt();
        self.x as f64 * norm(self.l) + self.y as f64 * norm(self.r)
    }
}

/// The paper begins Q_0 with (1, 0), Rivera 2017 with (0, 1); Eq. 1 holds either way around.
#[test]
fn equation_1_each_move_from_the_quadrant_before() {
    for m in 1..=14_u32 {
        let quadrant = |m: u32| Quadrant::new(k(m + 2)).expect("a small k");
        let (old, new) = (quadrant(m - 1), quadrant(m));
        for from_right in [false, true] {
            let at = |q: Quadrant, j: u64| {
                pair(q.get(if from_right { q.last() - j } else { j }).expect("an index of the quadrant"))
            };
            for j in 0..=new.last() {
                let expected =
                    if j % 2 == 0 { at(old, j / 2) } else { add(at(old, j / 2), at(old, j.div_ceil(2))) };
                assert_eq!(at(new, j), expected, "m = {m}, j = {j}");
            }
            assert_eq!(new.get(new.last() + 1), None, "j ends at 2^m, not at the 2^m + 1 of the paper");
        }
    }
}

#[test]
fn equation_2_two_consecutive_moves_make_up_the_vertex() {
    for n in 2..=14 {
        let quadrant = Quadrant::new(k(n)).expect("a small k");
        for d in first_quadrant(40).filter(|&(_, y)| y > 0) {
            let parts = decompose(vector(d), k(n)).expect("a small vector");
            let (u, v) = (quadrant.index_of(parts.v), quadrant.index_of(parts.w));
            assert_eq!(u.map(|j| j + 1), v, "consecutive, k = {n}, {d:?}");
            let sum = add(times(parts.alpha.into(), pair(parts.v)), times(parts.beta.into(), pair(parts.w)));
            assert_eq!(sum, d, "k = {n}");
        }
    }
}

#[test]
fn algorithm_1_the_distance_for_32_neighbors() {
    let moves = naive_quadrant(5);
    for d in square(64) {
        assert_close(distance_32(vector(d)), naive_distance(d, &moves), format!("h_5{d:?}"));
    }
}

/// The two invariants of Theorem 2's proof, and that the library's rounds are these.
#[test]
fn algorithm_2_keeps_its_invariants() {
    for n in 2..=14 {
        let quadrant = Quadrant::new(k(n)).expect("a small k");
        for d in first_quadrant(32).filter(|&(_, y)| y > 0) {
            let state = Factorization::after(vector(d), n - 2);
            let small = |v: (i128, i128)| Vector::new(v.0 as i32, v.1 as i32);
            let (l, r) = (small(state.l), small(state.r));
            assert_eq!(add(times(state.x as i64, pair(l)), times(state.y as i64, pair(r))), d, "k = {n}");
            assert!(state.x >= 0 && state.y >= 0);
            let index = |v| quadrant.index_of(v).expect("a move of the quadrant");
            assert_eq!(index(r) + 1, index(l), "consecutive, k = {n}, {d:?}");
            let parts = decompose(vector(d), k(n)).expect("a small vector");
            let got = (i128::from(parts.beta), parts.w, i128::from(parts.alpha), parts.v);
            assert_eq!(got, (state.x, l, state.y, r), "k = {n}, {d:?}");
        }
    }
}

#[test]
fn algorithm_2_as_printed_is_not_the_distance() {
    let d = Vector::new(10, 8);
    let state = Factorization::after(d, 1);
    let norm = |(x, y): (i128, i128)| ((x * x + y * y) as f64).sqrt();
    let printed = state.x as f64 * norm(state.r) + state.y as f64 * norm(state.l);
    assert!(printed < distance_any_angle(d), "x‖r‖ + y‖l‖ = {printed} is less than the straight line");
    // With `k ← k − 1` in the else branch alone, (10, 0) never leaves the loop: x > y for ever.
    assert_eq!(Factorization::after(Vector::new(10, 0), 1_000).y, 0);
}

#[test]
fn example_factorization_of_10_8() {
    let d = Vector::new(10, 8);
    let expected = [
        Factorization { x: 10, l: (1, 0), y: 8, r: (0, 1) },
        Factorization { x: 2, l: (1, 0), y: 8, r: (1, 1) },
        Factorization { x: 2, l: (2, 1), y: 6, r: (1, 1) },
    ];
    for (n, factors) in (2..).zip(expected) {
        assert_eq!(Factorization::after(d, n - 2), factors, "k = {n}");
        let parts = decompose(d, k(n)).expect("a small vector");
        assert_eq!((i128::from(parts.beta), i128::from(parts.alpha)), (factors.x, factors.y), "k = {n}");
        assert_close(distance(d, k(n)), factors.length(), format!("k = {n}"));
    }
}

/// Against the two-step method on naive moves, which Rivera's Corollary 1 compares with all paths.
#[test]
fn theorem_2_the_iterative_algorithm_is_the_distance() {
    for n in 2..=16 {
        let moves = naive_quadrant(n);
        for d in square(32) {
            let expected = naive_distance(d, &moves);
            assert_close(distance(vector(d), k(n)), expected, format!("h_{n}{d:?}"));
            assert_close(Factorization::after(vector(d), n - 2).length(), expected, format!("h_{n}{d:?}"));
        }
    }
}

fn assert_ulps(got: f64, expected: f64, what: impl std::fmt::Display) {
    assert!((got - expected).abs() <= 4.0 * f64::EPSILON * expected, "{what}: {got:e} is not {expected:e}");
}

/// Beyond the tables and beyond the moves that `i32` holds; at i32::MIN too.
#[test]
fn theorem_2_holds_for_any_k_and_any_displacement() {
    let mut random = Random::new();
    let seed = random.seed;
    let mut ds: Vec<Vector> = (0..1_500).map(|_| random.vector(31)).collect();
    let corners = [i32::MIN, i32::MIN + 1, -1, 0, 1, i32::MAX - 1, i32::MAX];
    ds.extend(corners.iter().flat_map(|&x| corners.map(|y| Vector::new(x, y))));
    for &d in &ds {
        let mut state = Factorization::start(d);
        for n in 2..=100 {
            assert_ulps(distance(d, k(n)), state.length(), format!("h_{n}({d:?}), seed {seed}"));
            state = state.round();
        }
        // Every move is in some neighborhood, of a k that fits: at most |x| + |y| + 2.
        assert_ulps(distance(d, k(u32::MAX)), d.norm(), format!("h at k = 2^32 − 1, {d:?}, seed {seed}"));
    }
}

#[test]
fn theorem_2_the_linear_search_finds_the_same_beyond_small_displacements() {
    let mut random = Random::new();
    let seed = random.seed;
    for n in 2..=14 {
        let linear = LinearSearch::new(k(n)).expect("a small k");
        let table = CostTable::new(k(n)).expect("a small k");
        for _ in 0..300 {
            let d = random.vector(31);
            let expected = Factorization::after(d, n - 2);
            assert_ulps(linear.distance(d), expected.length(), format!("h_{n}({d:?}), seed {seed}"));
            let error =
                (expected.x + expected.y) as f64 * 2f64.powi(-33) + 2.0 * f64::EPSILON * expected.length();
            let got = table.distance(d).to_f64();
            assert!((got - expected.length()).abs() <= error, "h_{n}({d:?}), seed {seed}");
        }
    }
    assert_eq!(distance(Vector::ZERO, FiniteK::MAX_MOVES), 0.0);
}
