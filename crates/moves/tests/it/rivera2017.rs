//! Rivera, Hernández, Baier 2017, 'Grid Pathfinding on the 2^k Neighborhoods': each statement that can be
//! executed.
//!
//! The paper's 𝒩^i is `naive_quadrant(i + 2)`.

use std::collections::BTreeSet;

use crate::common::*;
use mediant_moves::{
    CostTable, FiniteK, LinearSearch, Neighborhood, Parity, Quadrant, Vector, decompose, distance,
    distance_16, distance_32, manhattan, octile,
};

fn quadrant(n: u32) -> Quadrant {
    Quadrant::new(k(n)).expect("a small k")
}

fn get(n: u32, index: u64) -> Pair {
    pair(quadrant(n).get(index).expect("an index of the quadrant"))
}

#[test]
fn equations_1_and_2_old_moves_at_even_indices_and_sums_at_odd_ones() {
    for n in 2..=14 {
        let a = naive_quadrant(n);
        for j in 0..a.len() {
            assert_eq!(get(n + 1, 2 * j as u64), a[j], "b_2j, k = {}, j = {j}", n + 1);
            if j + 1 < a.len() {
                assert_eq!(
                    get(n + 1, 2 * j as u64 + 1),
                    add(a[j], a[j + 1]),
                    "b_2j+1, k = {}, j = {j}",
                    n + 1
                );
            }
        }
        let all: Vec<Pair> = quadrant(n).iter().map(pair).collect();
        assert_eq!(all, a, "k = {n}");
    }
}

#[test]
fn equations_3_to_5_the_first_three_quadrants() {
    let moves = |n| quadrant(n).iter().map(pair).collect::<Vec<_>>();
    assert_eq!(moves(2), [(0, 1), (1, 0)]);
    assert_eq!(moves(3), [(0, 1), (1, 1), (1, 0)]);
    assert_eq!(moves(4), [(0, 1), (1, 2), (1, 1), (2, 1), (1, 0)]);
}

#[test]
fn equation_6_all_signs_of_the_quadrant() {
    for n in 2..=14 {
        let moves: BTreeSet<Pair> = Neighborhood::new(k(n)).expect("a small k").iter().map(pair).collect();
        assert_eq!(moves, naive_neighborhood(n), "k = {n}");
    }
    assert_eq!(
        naive_neighborhood(2),
        BTreeSet::from([(0, 1), (1, 0), (0, -1), (-1, 0)]),
        "the 4-neighborhood"
    );
    let eight: BTreeSet<Pair> = square(1).filter(|&d| d != (0, 0)).collect();
    assert_eq!(naive_neighborhood(3), eight, "the 8-neighborhood");
}

#[test]
fn proposition_1_no_two_moves_are_parallel() {
    for n in 2..=14 {
        // Two vectors of a quadrant are parallel exactly when they are multiples of the same vector of gcd 1.
        let directions: BTreeSet<Pair> = quadrant(n)
            .iter()
            .map(|v| {
                let (x, y) = pair(v);
                (x / gcd(x, y), y / gcd(x, y))
            })
            .collect();
        assert_eq!(directions.len() as u64, quadrant(n).len(), "k = {n}");
    }
}

#[test]
fn proposition_2_the_neighborhood_has_2_to_the_k_moves() {
    for n in 2..=16 {
        let i = n - 2;
        assert_eq!(quadrant(n).len(), (1 << i) + 1, "the proof misprints |N^i| as 2^(i+1)");
        assert_eq!(quadrant(n).iter().count() as u64, quadrant(n).len());
        assert_eq!(quadrant(n + 1).len(), 2 * quadrant(n).len() - 1, "the recurrence of the proof");
        let whole = Neighborhood::new(k(n)).expect("a small k");
        assert_eq!(whole.iter().count() as u64, 1 << n, "k = {n}");
        assert_eq!((whole.len(), k(n).moves()), (1 << n, Some(1 << n)));
    }
    for n in 17..=47 {
        assert_eq!(Neighborhood::new(k(n)).expect("at most 47").len(), 1 << n);
        assert_eq!(4 * (quadrant(n).len() - 2) + 4, 1 << n, "the count of the proof");
    }
}

#[test]
fn theorem_1_radius_is_fibonacci() {
    for n in 2..=20 {
        let largest = naive_quadrant(n).iter().map(|&(x, y)| x.max(y)).max();
        assert_eq!(largest, Some(fibonacci(n - 2)), "k = {n}");
        assert_eq!(k(n).radius().map(i64::from), Ok(fibonacci(n - 2)), "k = {n}");
    }
    for n in 21..=47 {
        assert_eq!(k(n).radius().map(i64::from), Ok(fibonacci(n - 2)), "k = {n}");
    }
}

#[test]
fn equations_7_and_8_an_odd_move_from_the_two_quadrants_before() {
    for n in 4..=14 {
        for index in (1..quadrant(n).last()).step_by(2) {
            let (below, above) = ((index - 1) / 2, index.div_ceil(2));
            let expected = if above % 2 == 0 {
                add(get(n - 1, below), get(n - 2, above / 2))
            } else {
                add(get(n - 1, above), get(n - 2, below / 2))
            };
            assert_eq!(get(n, index), expected, "k = {n}, index {index}");
        }
    }
}

#[test]
fn lemma_1_no_coordinate_exceeds_fibonacci() {
    for n in 2..=18 {
        for v in quadrant(n) {
            assert!(i64::from(v.x.max(v.y)) <= fibonacci(n - 2), "k = {n}, {v:?}");
        }
    }
}

/// With Eq. 9 and 10, which are Eq. 7 and 8 at these indices.
#[test]
fn lemma_2_the_index_that_attains_fibonacci() {
    let mut f = vec![0_i64];
    for i in 1..=45 {
        f.push(2 * f[i - 1] + if i % 2 == 1 { 1 } else { -1 });
    }
    for i in 0..=45_u32 {
        let at = |i: u32| get(i + 2, f[i as usize] as u64);
        assert_eq!(at(i).1, fibonacci(i), "i = {i}");
        assert!(i == 0 || f[i as usize] % 2 == 1, "F_i is odd, i = {i}");
        if i >= 2 {
            assert_eq!(at(i), add(at(i - 1), at(i - 2)), "Eq. 10, i = {i}");
        }
    }
}

/// The linear program has two equations, so some optimum uses two moves: look at all pairs of them (Eq. 11
/// and 12).
#[test]
fn theorem_2_the_two_moves_around_a_vertex_are_the_linear_optimum() {
    for n in 2..=14 {
        let moves = naive_quadrant(n);
        let ds: Vec<Pair> = if n <= 8 {
            first_quadrant(12).filter(|&d| d != (0, 0)).collect()
        } else {
            vec![(1, 0), (5, 12), (40, 3), (233, 377), (610, 609)]
        };
        for d in ds {
            let mut optimum = f64::INFINITY;
            for (i, &u) in moves.iter().enumerate() {
                for &v in &moves[i + 1..] {
                    let (alpha, beta, whole) = (det(d, v) as f64, det(u, d) as f64, det(u, v) as f64);
                    let (alpha, beta) = (alpha / whole, beta / whole);
                    if alpha >= 0.0 && beta >= 0.0 {
                        optimum = optimum.min(alpha * norm(u) + beta * norm(v));
                    }
                }
            }
            assert_close(distance(vector(d), k(n)), optimum, format!("Eq. 13, h_{n}{d:?}"));
        }
    }
}

#[test]
fn theorem_3_the_linear_optimum_is_integral() {
    for n in 2..=14 {
        let moves = naive_quadrant(n);
        for d in first_quadrant(40) {
            let j = naive_sector(d, &moves);
            let (alpha, beta) = solve(d, moves[j], moves[j + 1]).expect("integral factors");
            assert!(alpha >= 0 && beta >= 0, "k = {n}, {d:?}");
            let parts = decompose(vector(d), k(n)).expect("a small vector");
            let got = add(times(parts.alpha.into(), pair(parts.v)), times(parts.beta.into(), pair(parts.w)));
            assert_eq!(got, d, "Eq. 14, k = {n}");
            assert_close(parts.length(), alpha as f64 * norm(moves[j]) + beta as f64 * norm(moves[j + 1]), n);
        }
    }
}

/// The induction step of Theorem 3: the move that k + 1 inserts splits into the two around it.
#[test]
fn equations_17_and_18_the_factors_one_level_back() {
    for n in 2..=14 {
        for d in first_quadrant(40).filter(|&(x, y)| x > 0 && y > 0) {
            let new = decompose(vector(d), k(n + 1)).expect("a small vector");
            let old = decompose(vector(d), k(n)).expect("a small vector");
            // The move shared by both is the old one, and takes the factor of the new one as well.
            let expected = match Quadrant::parity(quadrant(n + 1).index_of(new.v).expect("a move")) {
                Parity::Odd => (new.alpha, new.alpha + new.beta),
                Parity::Even => (new.alpha + new.beta, new.beta),
            };
            assert_eq!((old.alpha, old.beta), expected, "k = {n}, {d:?}");
        }
    }
}

#[test]
fn corollary_1_no_path_on_an_empty_grid_is_shorter() {
    for n in 2..=14 {
        let graph = EmptyGrid::new(&naive_neighborhood(n), 32, 1.0, norm);
        for d in square(16) {
            let (got, expected) = (distance(vector(d), k(n)), graph.cost(d));
            assert!((got - expected).abs() < 1e-11, "h_{n}{d:?} = {got}, not {expected}");
        }
    }
}

#[test]
fn algorithm_1_the_closed_forms() {
    let quadrants: Vec<Vec<Pair>> = (2..=5).map(naive_quadrant).collect();
    let mut random = Random::new();
    let seed = random.seed;
    let drawn: Vec<Pair> = (0..2_000).map(|_| pair(random.vector(20))).collect();
    for d in square(40).chain(first_quadrant(250)).chain(drawn) {
        let forms = [manhattan, octile, distance_16, distance_32];
        for (i, form) in forms.iter().enumerate() {
            let expected = naive_distance(d, &quadrants[i]);
            assert_close(form(vector(d)), expected, format!("h_{}{d:?}, seed {seed}", i + 2));
        }
    }
    // Moves cost their lengths to the bit: no constant is off.
    assert_eq!(octile(Vector::new(1, 1)), 2f64.sqrt());
    assert_eq!(distance_16(Vector::new(1, 2)), 5f64.sqrt());
    assert_eq!(distance_32(Vector::new(1, 3)), 10f64.sqrt());
    assert_eq!(distance_32(Vector::new(2, 3)), 13f64.sqrt());
    assert_close(octile(Vector::new(3, 5)), 2.0 + 3.0 * 2f64.sqrt(), "h8(3, 5)");
    assert_close(distance_16(Vector::new(1, 3)), 1.0 + 5f64.sqrt(), "h16(1, 3)");
    assert_close(distance_32(Vector::new(3, 5)), 5f64.sqrt() + 13f64.sqrt(), "h32(3, 5)");
}

#[test]
fn the_heuristic_three_ways() {
    for n in 2..=14 {
        let moves = naive_quadrant(n);
        let linear = LinearSearch::new(k(n)).expect("a small k");
        let table = CostTable::new(k(n)).expect("a small k");
        for d in square(24) {
            let expected = naive_distance(d, &moves);
            assert_close(distance(vector(d), k(n)), expected, format!("iterative h_{n}{d:?}"));
            assert_close(linear.distance(vector(d)), expected, format!("linear h_{n}{d:?}"));
            // At most 48 moves, each off by at most 2⁻³³.
            let fixed = table.distance(vector(d)).to_f64();
            assert!((fixed - expected).abs() <= 48.0 * 2f64.powi(-33), "fixed-point h_{n}{d:?}");
        }
    }
}

/// The number of shortest ways to add moves up to d.
fn count_paths(d: Pair, moves: &BTreeSet<Pair>, left: f64) -> u64 {
    if d == (0, 0) {
        return 1;
    }
    let mut count = 0;
    for &m in moves {
        let rest = sub(d, m);
        if norm(m) + norm(rest) <= left + 1e-9 {
            count += count_paths(rest, moves, left - norm(m));
        }
    }
    count
}

#[test]
fn optimal_paths_are_fewer_for_larger_k() {
    let count = |d: Pair, n| count_paths(d, &naive_neighborhood(n), distance(vector(d), k(n)));
    assert_eq!(count((4, 2), 2), 15);
    assert_eq!(count((4, 2), 3), 6);
    for n in 4..=14 {
        assert_eq!(count((4, 2), n), 1, "k = {n}");
    }
    let binomial = |n: u64, k: u64| (1..=k).fold(1, |b, i| b * (n - k + i) / i);
    for n in 2..=6 {
        for d in first_quadrant(4) {
            let parts = decompose(vector(d), k(n)).expect("a small vector");
            let (alpha, beta) = (u64::from(parts.alpha), u64::from(parts.beta));
            assert_eq!(count(d, n), binomial(alpha + beta, alpha), "k = {n}, {d:?}");
        }
    }
}

#[test]
fn canonical_paths_take_the_odd_move_first() {
    for n in 2..=14 {
        let whole = Neighborhood::new(k(n)).expect("a small k");
        for d in square(16) {
            let parts = decompose(vector(d), k(n)).expect("a small vector");
            let [first, second] = parts.canonical();
            let index = |v| whole.index_of(v).expect("a move");
            assert_eq!(Quadrant::parity(index(first.0)), Parity::Odd, "k = {n}, {d:?}");
            assert_eq!(Quadrant::parity(index(second.0)), Parity::Even, "k = {n}, {d:?}");
            let sum = add(times(first.1.into(), pair(first.0)), times(second.1.into(), pair(second.0)));
            assert_eq!(sum, d, "k = {n}");
        }
    }
    let diagonal = decompose(Vector::new(5, 2), FiniteK::N8).map(|parts| parts.canonical()[0]);
    assert_eq!(diagonal, Some((Vector::new(1, 1), 2)), "(1, 1) before (1, 0) on the 8-neighborhood");
}

/// The parity of a move is the same whether its quadrant is a reflection (the paper's) or a quarter turn
/// (ours).
#[test]
fn canonical_parity_is_that_of_the_first_quadrant() {
    for n in 2..=12 {
        let whole = Neighborhood::new(k(n)).expect("a small k");
        for (index, v) in (0..).zip(whole.iter()) {
            let reflected = Vector::new(v.x.abs(), v.y.abs());
            let of_paper = quadrant(n).index_of(reflected).expect("a move");
            assert_eq!(Quadrant::parity(index), Quadrant::parity(of_paper), "k = {n}, {v:?}");
        }
    }
}

/// A bidimensional node was reached by odd moves alone; it also turns, once, to a neighboring even move.
#[test]
fn canonical_successors_generate_each_cell_once_and_at_optimal_cost() {
    const REACH: i64 = 24;
    for n in 2..=14 {
        let whole: Vec<Pair> = Neighborhood::new(k(n)).expect("a small k").iter().map(pair).collect();
        let moves = naive_quadrant(n);
        let mut visits = vec![0; (2 * REACH as usize + 1).pow(2)];
        let mut open: Vec<(Pair, usize, f64)> = (0..whole.len()).map(|i| ((0, 0), i, 0.0)).collect();
        while let Some((from, index, cost)) = open.pop() {
            let (at, cost) = (add(from, whole[index]), cost + norm(whole[index]));
            if at.0.abs() > REACH || at.1.abs() > REACH {
                continue;
            }
            visits[((at.0 + REACH) * (2 * REACH + 1) + at.1 + REACH) as usize] += 1;
            assert!((cost - naive_distance(at, &moves)).abs() < 1e-9, "k = {n}, {at:?}");
            open.push((at, index, cost));
            if index % 2 == 1 {
                open.extend([(at, index - 1, cost), (at, (index + 1) % whole.len(), cost)]);
            }
        }
        let origin = visits.len() / 2;
        assert!(visits.iter().enumerate().all(|(i, &v)| v == i32::from(i != origin)), "k = {n}");
    }
}
