//! The public items against naive definitions, at the limits of their ranges, and the properties of h_k that
//! need no oracle.

use std::collections::BTreeSet;

use crate::common::*;
use mediant_moves::{
    CostTable, FiniteK, K, KError, LinearSearch, Neighborhood, Quadrant, Vector, adjacent, bound_at_centers,
    bound_at_corners, containing, decompose, distance, distance_any_angle, level, parents,
    smallest_k_at_centers, smallest_k_at_corners,
};

fn quadrant(n: u32) -> Quadrant {
    Quadrant::new(k(n)).expect("at most 47")
}

fn neighborhood(n: u32) -> Neighborhood {
    Neighborhood::new(k(n)).expect("at most 47")
}

#[test]
fn k_says_what_it_refuses() {
    assert_eq!(FiniteK::new(0), Err(KError::TooSmall { k: 0 }));
    assert_eq!(FiniteK::new(1), Err(KError::TooSmall { k: 1 }));
    assert_eq!((FiniteK::new(2), FiniteK::new(3)), (Ok(FiniteK::N4), Ok(FiniteK::N8)));
    let too_large = |k, max| KError::TooLarge { k, max };
    assert_eq!(k(48).radius(), Err(too_large(48, 47)));
    assert_eq!(Quadrant::new(k(48)), Err(too_large(48, 47)));
    assert_eq!(Neighborhood::new(k(u32::MAX)), Err(too_large(u32::MAX.into(), 47)));
    assert_eq!(LinearSearch::new(k(25)).err(), Some(too_large(25, 24)));
    assert_eq!(CostTable::new(k(19)).err(), Some(too_large(19, 18)));
    assert_eq!((k(63).moves(), k(64).moves()), (Some(1 << 63), None));
    for (error, parts) in [(KError::TooSmall { k: 1 }, ["1", "2"]), (too_large(48, 47), ["48", "47"])] {
        let text = error.to_string();
        assert!(parts.iter().all(|part| text.contains(part)), "{text}");
    }
    assert_eq!(k(7).to_string(), "7");
}

/// Whatever integer is at hand is a k, or the error that says which it was.
#[test]
fn integers_of_all_widths_are_k() {
    fn check<T: Copy + TryInto<K, Error = KError> + TryInto<FiniteK, Error = KError>>(
        number: T,
        expected: Result<u32, KError>,
    ) {
        let finite: Result<FiniteK, KError> = number.try_into();
        assert_eq!(finite.map(FiniteK::get), expected);
        let any_k: Result<K, KError> = number.try_into();
        assert_eq!(any_k, expected.map(|number| K::Finite(k(number))));
    }
    check(5_u8, Ok(5));
    check(5_u16, Ok(5));
    check(5_u32, Ok(5));
    check(5_u64, Ok(5));
    check(5_usize, Ok(5));
    check(5_i8, Ok(5));
    check(5_i16, Ok(5));
    check(5, Ok(5));
    check(5_i64, Ok(5));
    check(5_isize, Ok(5));
    check(99, Ok(99));
    for (number, k) in [(1, 1), (0, 0), (-3, -3), (i32::MIN, i32::MIN.into())] {
        check(number, Err(KError::TooSmall { k }));
    }
    check(i64::MIN, Err(KError::TooSmall { k: i64::MIN }));
    check(u64::MAX, Err(KError::TooLarge { k: u64::MAX, max: u32::MAX }));
    check(i64::MAX, Err(KError::TooLarge { k: i64::MAX as u64, max: u32::MAX }));
    assert_eq!((K::new(5), K::new(1)), (Ok(K::N32), Err(KError::TooSmall { k: 1 })));
    let shown = format!("{:?}", K::try_from(-3));
    assert!(shown.contains("k = -3 is too small"), "{shown}");
}

/// 47 is the last k whose radius fits: Fib(46) does not.
#[test]
fn k_max_moves_is_the_limit_of_i32() {
    assert_eq!(FiniteK::MAX_MOVES.get(), 47);
    assert!(fibonacci(45) <= i64::from(i32::MAX) && fibonacci(46) > i64::from(i32::MAX));
}

#[test]
fn quadrant_moves_recurrence_is_the_insertion() {
    for n in 2..=18 {
        let naive = naive_quadrant(n);
        let mut moves = quadrant(n).iter();
        for (j, &expected) in naive.iter().enumerate() {
            let left = naive.len() - j;
            assert_eq!(moves.size_hint(), (left, Some(left)), "k = {n}");
            assert_eq!(moves.next().map(pair), Some(expected), "k = {n}, index {j}");
        }
        assert_eq!((moves.size_hint(), moves.next(), moves.next()), ((0, Some(0)), None, None), "k = {n}");
    }
    for (j, v) in (0..5_000).zip(quadrant(47)) {
        assert_eq!(quadrant(47).get(j), Some(v), "k = 47, index {j}");
    }
}

/// Also where the moves of a quadrant are more than a 32-bit `usize` can count.
#[test]
fn neighborhoods_list_their_moves_by_index() {
    for n in [2, 3, 8, 33, 34, 47] {
        let moves = neighborhood(n);
        let listed: Vec<Vector> = moves.iter().take(300).collect();
        let expected: Vec<Vector> = (0..300).map_while(|index| moves.get(index)).collect();
        assert_eq!(listed, expected, "k = {n}");
    }
}

#[test]
fn quadrant_index_and_move_are_inverse() {
    for n in 2..=12 {
        let naive = naive_quadrant(n);
        for v in square(20).chain(naive.iter().copied()) {
            let expected = naive.iter().position(|&m| m == v).map(|j| j as u64);
            assert_eq!(quadrant(n).index_of(vector(v)), expected, "k = {n}, {v:?}");
        }
        for (j, &v) in (0..).zip(&naive) {
            assert_eq!(quadrant(n).get(j).map(pair), Some(v), "k = {n}, index {j}");
        }
        assert_eq!(quadrant(n).last(), naive.len() as u64 - 1);
        assert_eq!((quadrant(n).get(naive.len() as u64), quadrant(n).get(u64::MAX)), (None, None));
        assert_eq!(quadrant(n).k(), k(n));
    }
}

#[test]
fn neighborhood_index_and_move_are_inverse() {
    for n in 2..=10 {
        let naive = naive_neighborhood(n);
        let moves: Vec<Vector> = neighborhood(n).iter().collect();
        for (j, &v) in (0..).zip(&moves) {
            assert_eq!(neighborhood(n).get(j), Some(v), "k = {n}, index {j}");
            assert_eq!(neighborhood(n).index_of(v), Some(j), "k = {n}, {v:?}");
            // One turn around the circle, always to the same side.
            assert!(v.det(moves[(j as usize + 1) % moves.len()]) < 0, "k = {n}, {v:?}");
        }
        assert_eq!((neighborhood(n).get(1 << n), neighborhood(n).get(u64::MAX)), (None, None));
        for d in square(20) {
            assert_eq!(neighborhood(n).contains(vector(d)), naive.contains(&d), "k = {n}, {d:?}");
        }
        assert_eq!((neighborhood(n).k(), neighborhood(n).quadrant()), (k(n), quadrant(n)));
    }
}

#[test]
fn neighborhood_at_the_limit_of_i32() {
    let mut random = Random::new();
    let (seed, whole) = (random.seed, neighborhood(47));
    for _ in 0..2_000 {
        let j = random.bits() % whole.len();
        let v = whole.get(j).expect("an index of the neighborhood");
        assert_eq!(whole.index_of(v), Some(j), "{v:?}, seed {seed}");
        let next = whole.get((j + 1) % whole.len()).expect("an index of the neighborhood");
        assert_eq!(v.det(next), -1, "{v:?}, seed {seed}");
        assert!(level(v).is_some_and(|l| l <= 47) && adjacent(v, next, k(47)), "{v:?}, seed {seed}");
    }
    for v in
        [Vector::new(i32::MIN, 1), Vector::new(1, i32::MIN), Vector::new(i32::MAX, i32::MAX), Vector::ZERO]
    {
        assert_eq!(whole.index_of(v), None, "{v:?}");
    }
}

#[test]
fn neighborhood_has_the_eight_symmetries_of_the_square() {
    for n in 2..=12 {
        let moves: BTreeSet<Pair> = neighborhood(n).iter().map(pair).collect();
        for &(x, y) in &moves {
            assert!(moves.contains(&(-x, y)) && moves.contains(&(y, x)), "k = {n}, ({x}, {y})");
        }
    }
}

#[test]
fn canonical_order_is_a_permutation_odd_first() {
    for n in 2..=14 {
        let order: Vec<u64> = quadrant(n).canonical_order().collect();
        let odd = order.iter().take_while(|&j| j % 2 == 1).count();
        assert!(order[odd..].iter().all(|j| j % 2 == 0), "k = {n}");
        assert!(order[..odd].is_sorted() && order[odd..].is_sorted(), "k = {n}");
        let mut sorted = order;
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..quadrant(n).len()), "k = {n}");
    }
}

/// Kramm's definition: no other move of N(k) is contained by the two. (By the letter two opposite moves,
/// which contain nothing but themselves, would be adjacent; they are not meant.)
#[test]
fn adjacent_moves_have_no_move_between_them() {
    for n in 2..=6 {
        let moves = naive_neighborhood(n);
        for &u in &moves {
            for &v in &moves {
                let whole = det(u, v);
                let contained = |m: Pair| det(m, v) * whole >= 0 && det(u, m) * whole >= 0;
                let expected = whole != 0 && moves.iter().all(|&m| m == u || m == v || !contained(m));
                assert_eq!(adjacent(vector(u), vector(v), k(n)), expected, "k = {n}, {u:?}, {v:?}");
            }
        }
        let radius = fibonacci(n - 2) + 1;
        for d in square(radius).filter(|d| !moves.contains(d)) {
            assert!(moves.iter().all(|&m| !adjacent(vector(d), vector(m), k(n))), "no move: k = {n}, {d:?}");
        }
    }
    let (most, zero) = (Vector::new(i32::MIN, i32::MIN), Vector::ZERO);
    assert!(!adjacent(most, most, k(9)) && !adjacent(zero, zero, k(2)));
}

#[test]
fn decompose_and_containing_in_every_quadrant() {
    for n in 2..=12 {
        let whole = neighborhood(n);
        for d in square(20) {
            let parts = decompose(vector(d), k(n)).expect("a small vector");
            let sum = add(times(parts.alpha.into(), pair(parts.v)), times(parts.beta.into(), pair(parts.w)));
            assert_eq!(sum, d, "k = {n}");
            assert_eq!(containing(vector(d), k(n)), Some((parts.v, parts.w)));
            let j = whole.index_of(parts.v).expect("a move");
            assert_eq!(whole.get((j + 1) % whole.len()), Some(parts.w), "next in order, k = {n}, {d:?}");
        }
        let zero = decompose(Vector::ZERO, k(n)).expect("the zero vector");
        assert_eq!((zero.alpha, zero.beta), (0, 0));
    }
    // A quadrant has the axis on which it begins.
    for (axis, turns) in [((0, 3), 0), ((3, 0), 1), ((0, -3), 2), ((-3, 0), 3)] {
        let parts = decompose(vector(axis), k(5)).expect("a small vector");
        assert_eq!((parts.v, parts.alpha, parts.beta), (Vector::new(0, 1).turned_by(turns), 3, 0));
    }
}

#[test]
fn decompose_at_the_limits() {
    let (min, max) = (i32::MIN, i32::MAX);
    for d in [Vector::new(min, 0), Vector::new(5, min), Vector::new(min, min)] {
        assert_eq!((decompose(d, k(5)), containing(d, k(5)), parents(d)), (None, None, None), "{d:?}");
    }
    let mut random = Random::new();
    let seed = random.seed;
    let corners = [(max, max), (-max, max), (max, 1), (1, -max), (max, 0), (0, -max), (max - 1, -max)];
    let drawn = (0..500).map(|_| random.vector(31)).collect::<Vec<_>>();
    for d in corners.into_iter().map(Vector::from).chain(drawn) {
        for n in 2..=47 {
            let parts = decompose(d, k(n)).expect("moves up to k = 47 fit");
            let sum =
                |v: i32, w: i32| i64::from(parts.alpha) * i64::from(v) + i64::from(parts.beta) * i64::from(w);
            let got = (sum(parts.v.x, parts.w.x), sum(parts.v.y, parts.w.y));
            assert_eq!(got, pair(d), "k = {n}, seed {seed}");
            assert!(adjacent(parts.v, parts.w, k(n)), "k = {n}, {d:?}, seed {seed}");
        }
    }
    // The move beside (1, 0) at k is (k − 2, 1).
    let beside = |n| decompose(Vector::new(5, 0), k(n)).map(|parts| parts.w);
    assert_eq!(beside(2 + i32::MAX.unsigned_abs()), Some(Vector::new(max, -1)));
    assert_eq!(beside(3 + i32::MAX.unsigned_abs()), None);
    assert_eq!(decompose(Vector::new(max, max - 1), k(u32::MAX)), None);
}

#[test]
fn parents_are_the_two_moves_whose_sum_was_inserted() {
    for n in 3..=12 {
        for two in naive_quadrant(n - 1).windows(2) {
            let sum = vector(add(two[0], two[1]));
            for turns in 0..4 {
                let expected = (vector(two[0]).turned_by(turns), vector(two[1]).turned_by(turns));
                assert_eq!(parents(sum.turned_by(turns)), Some(expected), "{sum:?}, {turns} turns");
            }
        }
    }
    for v in [(1, 0), (0, -1), (0, 0), (2, 4), (-6, 3), (0, 5)] {
        assert_eq!(parents(vector(v)), None, "{v:?}");
    }
    let mut random = Random::new();
    let seed = random.seed;
    let large = [(i32::MAX, 1), (-1, i32::MAX), (i32::MAX, i32::MAX - 1)].map(Vector::from);
    let drawn: Vec<Vector> = (0..3_000).map(|_| random.vector(31)).collect();
    for v in large.into_iter().chain(drawn).filter(|v| v.is_move() && v.x != 0 && v.y != 0) {
        let (a, b) = parents(v).expect("a move off the axes");
        let (Some(of_a), Some(of_b)) = (level(a), level(b)) else { panic!("{v:?}, seed {seed}") };
        assert_eq!((a + b, a.det(b)), (v, -1), "seed {seed}");
        assert_eq!(level(v), Some(1 + of_a.max(of_b)), "{v:?}, seed {seed}");
    }
}

#[test]
fn level_at_the_limits() {
    let max = i32::MAX;
    assert_eq!(level(Vector::new(max, 1)), Some(max.unsigned_abs() + 2));
    assert_eq!(level(Vector::new(i32::MIN, 1)), Some(max.unsigned_abs() + 3));
    assert_eq!(level(Vector::new(1_134_903_170, 1_836_311_903)), Some(47), "the largest move of N(47)");
    for v in [(0, 0), (2, 0), (i32::MIN, 0), (i32::MIN, i32::MIN), (6, -9)] {
        assert_eq!(level(Vector::from(v)), None, "{v:?}");
    }
}

#[test]
fn smallest_k_inverts_the_bound() {
    let mut last = f64::INFINITY;
    for n in 2..=1 << 20 {
        let bound = bound_at_corners(k(n));
        assert!(bound <= last && bound > 1.0, "Γ never rises, k = {n}");
        // From k = 95,861 on, several k share a bound in f64.
        if bound < last && (n < 3_000 || n % 509 == 0) {
            assert_eq!(smallest_k_at_corners(bound), Some(k(n)), "k = {n}");
            assert_eq!(smallest_k_at_corners(last.next_down()), Some(k(n)), "k = {n}");
        }
        last = bound;
    }
    assert_eq!(smallest_k_at_corners(bound_at_corners(k(1 << 20)).next_down()), None);
    assert!(smallest_k_at_corners(1.0 + 2f64.powi(-43)).is_some());
}

#[test]
fn smallest_k_at_any_ratio() {
    for ratio in [1.0, 1.0_f64.next_up(), 0.999, 0.0, -1.0, f64::NEG_INFINITY, f64::NAN] {
        assert_eq!((smallest_k_at_corners(ratio), smallest_k_at_centers(ratio)), (None, None), "{ratio}");
    }
    for ratio in [f64::INFINITY, 2.0] {
        assert_eq!((smallest_k_at_corners(ratio), smallest_k_at_centers(ratio)), (Some(k(2)), Some(k(2))));
    }
    let (four, more) = (bound_at_centers(k(2)), bound_at_centers(k(3)));
    assert_eq!(smallest_k_at_centers(four), Some(k(2)));
    assert_eq!(smallest_k_at_centers(four.next_down()), Some(k(3)));
    assert_eq!(smallest_k_at_centers(more), Some(k(3)));
    assert_eq!(smallest_k_at_centers(more.next_down()), None);
}

#[test]
fn vectors_turn_by_quadrants() {
    for d in square(6).filter(|&d| d != (0, 0)) {
        let v = vector(d);
        let turns = v.quadrant().expect("not the zero vector");
        let first = v.turned_by(4 - turns);
        assert!(first.x >= 0 && first.y > 0, "{d:?}");
        assert_eq!((first.turned_by(turns), v.turned().dot(v), v.turned_by(4)), (v, 0, v));
        assert_eq!(-v, v.turned_by(2));
    }
    assert_eq!(Vector::ZERO.quadrant(), None);
}

#[test]
fn vector_numbers_are_exact_at_the_limits() {
    let (min, max) = (i32::MIN, i32::MAX);
    let corner = Vector::new(min, min);
    assert_eq!((corner.norm_squared(), corner.dot(corner)), (1 << 63, 1 << 63));
    assert_eq!((corner.gcd(), corner.is_move(), Vector::ZERO.gcd()), (1 << 31, false, 0));
    assert_eq!(corner.norm(), 2f64.powi(31) * 2f64.sqrt());
    let (least, most) = (i128::from(min), i128::from(max));
    assert_eq!(Vector::new(min, max).det(Vector::new(max, min)), least * least - most * most);
    assert_eq!(Vector::new(min, max).dot(Vector::new(max, max)), least * most + most * most);
    for u in first_quadrant(8).filter(|&d| d != (0, 0)) {
        for v in first_quadrant(8).filter(|&d| d != (0, 0)) {
            let expected = u.0 * v.1 <= v.0 * u.1;
            assert_eq!(vector(u).precedes(vector(v)), expected, "{u:?}, {v:?}");
        }
    }
    for d in square(40) {
        assert_eq!(i64::from(vector(d).gcd()), gcd(d.0, d.1), "{d:?}");
        assert_eq!(vector(d).norm(), norm(d), "{d:?}");
    }
}

/// The table of the crate doc names every test of the files that it covers, and no other.
#[test]
fn crate_doc_table_names_the_tests() {
    let files = [
        ("rivera2017", include_str!("rivera2017.rs")),
        ("hormazabal2017", include_str!("hormazabal2017.rs")),
        ("kramm2018", include_str!("kramm2018.rs")),
        ("kramm2018_trees", include_str!("kramm2018_trees.rs")),
    ];
    let tests: BTreeSet<String> = files
        .iter()
        .flat_map(|(file, text)| {
            let bodies = text.split("#[test]\nfn ").skip(1);
            bodies.map(move |body| format!("{file}::{}", body.split('(').next().unwrap_or_default()))
        })
        .collect();
    let rows = include_str!("../../src/lib.rs").lines().filter(|line| line.starts_with("//! |"));
    let named: BTreeSet<String> =
        rows.flat_map(|row| row.split('`')).filter(|part| part.contains("::")).map(String::from).collect();
    assert_eq!(named, tests);
    assert!(tests.len() > 50, "{} tests", tests.len());
}

/// h_k is a norm with the symmetries of the square, it falls with k towards the Euclidean one, and meets it
/// at multiples of moves.
#[test]
fn h_is_a_norm() {
    let mut random = Random::new();
    let seed = random.seed;
    let slack = 1.0 + 16.0 * f64::EPSILON;
    for n in [2, 3, 4, 5, 7, 9, 10, 11, 14, 20, 47, 60] {
        let h = |v| distance(v, k(n));
        for _ in 0..400 {
            let (u, v) = (random.vector(25), random.vector(25));
            assert!(h(u + v) <= (h(u) + h(v)) * slack, "triangle: k = {n}, {u:?}, {v:?}, seed {seed}");
            let thrice = (h(v * 3) - 3.0 * h(v)).abs();
            assert!(thrice <= 3.0 * h(v) * (slack - 1.0), "scale: k = {n}, {v:?}, seed {seed}");
            for same in [-v, v.turned(), Vector::new(v.y, v.x), Vector::new(-v.x, v.y)] {
                assert_eq!(h(same), h(v), "symmetry: k = {n}, {v:?}, seed {seed}");
            }
            assert!(distance(v, k(n + 1)) <= h(v) * slack, "falls with k: k = {n}, {v:?}, seed {seed}");
            assert!(distance_any_angle(v) <= h(v) * slack, "above h_∞: k = {n}, {v:?}, seed {seed}");
        }
    }
    for n in 2..=12 {
        for d in first_quadrant(30).filter(|&d| d != (0, 0)) {
            let primitive = Vector::new((d.0 / gcd(d.0, d.1)) as i32, (d.1 / gcd(d.0, d.1)) as i32);
            let excess = distance(vector(d), k(n)) / distance_any_angle(vector(d)) - 1.0;
            assert_eq!(
                excess < 1e-12,
                quadrant(n).index_of(primitive).is_some(),
                "k = {n}, {d:?}: {excess:e}"
            );
        }
    }
}
