//! Kramm 2018, 'Suboptimality Bound for Grids with Obstacles': which cells a move enters, levels and
//! decomposition trees.

use std::collections::{BTreeMap, BTreeSet};

use crate::common::*;
use mediant_moves::{DecompositionTree, Neighborhood, Vector, adjacent, distance, level, parents};

/// A fraction with positive denominator.
type Fraction = (i64, i64);

fn less(a: Fraction, b: Fraction) -> bool {
    a.0 * b.1 < b.0 * a.1
}

/// For which λ the coordinate p + λd lies strictly between c and c + 1: an open interval, none for d = 0 (p
/// is an integer).
fn between(p: i64, d: i64, c: i64) -> Option<(Fraction, Fraction)> {
    match d {
        0 => None,
        1.. => Some(((c - p, d), (c + 1 - p, d))),
        _ => Some(((p - c - 1, -d), (p - c, -d))),
    }
}

/// Whether the segment from p to p + m meets the open interior of the cell whose corner nearest to −∞ is c:
/// clip it against both strips of the cell.
fn enters(p: Pair, m: Pair, c: Pair) -> bool {
    let (Some(x), Some(y)) = (between(p.0, m.0, c.0), between(p.1, m.1, c.1)) else { return false };
    let lowest = [x.0, y.0, (0, 1)].into_iter().reduce(|a, b| if less(a, b) { b } else { a });
    let highest = [x.1, y.1, (1, 1)].into_iter().reduce(|a, b| if less(b, a) { b } else { a });
    less(lowest.expect("three"), highest.expect("three"))
}

/// All cells whose interior the segment meets.
fn cells(p: Pair, m: Pair) -> BTreeSet<Pair> {
    let end = add(p, m);
    let (x, y) = (p.0.min(end.0)..p.0.max(end.0), p.1.min(end.1)..p.1.max(end.1));
    x.flat_map(|i| y.clone().map(move |j| (i, j))).filter(|&c| enters(p, m, c)).collect()
}

/// Asserts that following the steps from (0, 0) enters no cell but those given, and runs along no edge that
/// has none of them on either side (such an edge could lie between two blocked cells).
fn assert_stays_in(allowed: &BTreeSet<Pair>, steps: &[Pair], what: &str) {
    let mut at = (0, 0);
    for &step in steps {
        assert!(cells(at, step).is_subset(allowed), "{what}: from {at:?} by {step:?}");
        let far = add(at, step);
        // The two cells beside a unit edge meet in its upper end.
        let (x, y) = (at.0.max(far.0), at.1.max(far.1));
        let beside = match (step.0.abs(), step.1.abs()) {
            (1, 0) => Some([(x - 1, y - 1), (x - 1, y)]),
            (0, 1) => Some([(x - 1, y - 1), (x, y - 1)]),
            _ => None,
        };
        if let Some(beside) = beside {
            assert!(beside.iter().any(|c| allowed.contains(c)), "{what}: edge from {at:?} by {step:?}");
        }
        at = far;
    }
}

#[test]
fn the_cells_that_a_move_enters() {
    assert_eq!(cells((0, 0), (2, 1)), BTreeSet::from([(0, 0), (1, 0)]));
    assert_eq!(cells((0, 0), (-1, 2)), BTreeSet::from([(-1, 0), (-1, 1)]));
    assert_eq!(cells((5, 5), (3, 0)), BTreeSet::new());
    // A move enters |x| + |y| − 1 cells: one, and one more at each grid line that it crosses.
    for n in 2..=8 {
        for m in naive_neighborhood(n).into_iter().filter(|&(x, y)| x != 0 && y != 0) {
            assert_eq!(cells((0, 0), m).len() as i64, m.0.abs() + m.1.abs() - 1, "{m:?}");
        }
    }
}

#[test]
fn lemma_11_two_adjacent_moves_enter_only_cells_of_their_sum() {
    for n in 2..=14 {
        // Around the whole circle, or up to (1, 1): the rest of the quadrant is its mirror image.
        let moves: Vec<Pair> = if n <= 6 {
            let circle = Neighborhood::new(k(n)).expect("a small k");
            circle.iter().chain([Vector::new(0, 1)]).map(pair).collect()
        } else {
            naive_quadrant(n).into_iter().filter(|(x, y)| x <= y).collect()
        };
        for two in moves.windows(2) {
            let (u, v) = (two[0], two[1]);
            let allowed = cells((0, 0), add(u, v));
            assert_stays_in(&allowed, &[u, v], &format!("k = {n}"));
            assert_stays_in(&allowed, &[v, u], &format!("k = {n}"));
        }
    }
}

/// The level of each first-quadrant move up to k = 14, by looking where it first appears.
fn naive_levels() -> BTreeMap<Pair, u32> {
    let mut levels = BTreeMap::new();
    for n in 2..=14 {
        for v in naive_quadrant(n) {
            levels.entry(v).or_insert(n);
        }
    }
    levels
}

#[test]
fn level_is_the_first_k_that_has_the_move() {
    for ((x, y), n) in naive_levels() {
        for v in [(x, y), (-x, y), (x, -y), (-x, -y)] {
            assert_eq!(level(vector(v)), Some(n), "{v:?}");
        }
    }
}

/// The paper prints the sum of the children's levels.
#[test]
fn level_is_1_more_than_the_larger_of_the_parents() {
    let levels = naive_levels();
    for (&v, &n) in levels.iter().filter(|&(_, &n)| n > 2) {
        let (first, second) = parents(vector(v)).expect("not on an axis");
        assert_eq!(n, 1 + levels[&pair(first)].max(levels[&pair(second)]), "{v:?}");
        assert!(adjacent(first, second, k(n - 1)), "{v:?}");
    }
    assert_ne!(level(Vector::new(7, 5)), Some(1 + levels[&(4, 3)] + levels[&(3, 2)]), "the printed sum");
}

#[test]
fn of_two_adjacent_moves_one_is_new_and_one_is_old() {
    let levels = naive_levels();
    for n in 3..=14 {
        for two in naive_quadrant(n).windows(2) {
            let (a, b) = (levels[&two[0]], levels[&two[1]]);
            assert!(a.max(b) == n && a.min(b) < n, "k = {n}, {two:?}");
        }
    }
}

/// The two adjacent moves that each first-quadrant move off the axes is the sum of, up to k = 14.
fn naive_splits() -> BTreeMap<Pair, [Pair; 2]> {
    let two = |n| {
        naive_quadrant(n).windows(2).map(|two| (add(two[0], two[1]), [two[0], two[1]])).collect::<Vec<_>>()
    };
    (2..14).flat_map(two).collect()
}

/// Algorithm 2 as printed, but for the leaves alone, left to right: level by level, each leaf of the level
/// becomes the two adjacent moves of the level before whose sum it is. The leaves of the trees of all levels,
/// from the move's down to 2.
fn naive_leaves(
    v: Pair,
    levels: &BTreeMap<Pair, u32>,
    splits: &BTreeMap<Pair, [Pair; 2]>,
) -> Vec<(u32, Vec<Pair>)> {
    let mut all = vec![(levels[&v], vec![v])];
    for l in (3..=levels[&v]).rev() {
        let leaves = &all[all.len() - 1].1;
        let split = |w: &Pair| if levels[w] == l { splits[w].to_vec() } else { vec![*w] };
        all.push((l - 1, leaves.iter().flat_map(split).collect()));
    }
    all
}

fn leaves(v: Pair, n: u32) -> Vec<Pair> {
    DecompositionTree::new(vector(v), k(n)).expect("a move of level k or more").leaves().map(pair).collect()
}

#[test]
fn algorithm_2_the_decomposition_tree() {
    let (levels, splits) = (naive_levels(), naive_splits());
    for (&v, &l) in &levels {
        for (n, expected) in naive_leaves(v, &levels, &splits) {
            assert_eq!(leaves(v, n), expected, "{v:?}, level {n}");
            let tree = DecompositionTree::new(vector(v), k(n)).expect("a move of level k or more");
            assert_eq!(pair(tree.nodes()[0].label), v);
            assert!(tree.nodes().len() as i64 <= 2 * (v.0 + v.1), "{v:?}, level {n}");
            for node in tree.nodes() {
                let Some((left, right)) = node.children else { continue };
                let [left, right] = [left, right].map(|i| tree.nodes()[i as usize].label);
                assert_eq!(left + right, node.label);
                let above = level(node.label).expect("a move") - 1;
                assert!(adjacent(left, right, k(above)), "{:?}", node.label);
            }
        }
        assert_eq!(DecompositionTree::new(vector(v), k(l + 1)), None, "failure: {v:?} has level {l}");
    }
    assert_eq!(DecompositionTree::new(Vector::new(4, 2), k(2)), None, "no move");
    assert_eq!(DecompositionTree::new(Vector::ZERO, k(2)), None, "no move");
}

#[test]
fn lemma_12_at_most_two_adjacent_moves_label_the_leaves() {
    let levels = naive_levels();
    for (&(x, y), &l) in &levels {
        for n in 2..=l {
            let labels: BTreeSet<Pair> = leaves((x, -y), n).into_iter().collect();
            let labels: Vec<Vector> = labels.into_iter().map(vector).collect();
            match labels[..] {
                [only] => assert!(level(only) <= Some(n), "({x}, −{y}), level {n}"),
                [u, v] => assert!(adjacent(u, v, k(n)), "({x}, −{y}), level {n}: {u:?}, {v:?}"),
                _ => panic!("({x}, −{y}), level {n}: {labels:?}"),
            }
        }
    }
}

#[test]
fn lemma_13_the_leaves_are_an_optimal_path_within_the_cells_of_the_move() {
    let primes = square(20).filter(|&(p, q)| gcd(p, q) == 1);
    for v in primes.chain([(34, 21), (-21, 34), (29, -12), (-31, -7), (19, 30)]) {
        let allowed = cells((0, 0), v);
        // An axis move enters no cell, and is its own path.
        let axis = v.0 == 0 || v.1 == 0;
        for n in 2..=level(vector(v)).expect("relative primes") {
            let steps = leaves(v, n);
            assert_eq!(steps.iter().copied().reduce(add), Some(v), "level {n}");
            let path: Vec<Pair> =
                DecompositionTree::new(vector(v), k(n)).expect("a move").path().map(pair).collect();
            assert_eq!((path[0], path.last(), path.len()), ((0, 0), Some(&v), steps.len() + 1));
            assert!(path.windows(2).zip(&steps).all(|(two, &step)| add(two[0], step) == two[1]));
            if !axis {
                assert_stays_in(&allowed, &steps, &format!("{v:?}, level {n}"));
            }
            let length: f64 = steps.iter().map(|&m| norm(m)).sum();
            let expected = distance(vector(v), k(n));
            assert!(
                (length - expected).abs() <= 1e-13 * expected,
                "{v:?}, level {n}: {length}, not {expected}"
            );
        }
    }
}

#[test]
fn figure_5_the_trees_of_7_5() {
    assert_eq!(leaves((7, 5), 7), [(7, 5)]);
    assert_eq!(leaves((7, 5), 6), [(4, 3), (3, 2)]);
    assert_eq!(leaves((7, 5), 5), [(1, 1), (3, 2), (3, 2)]);
    assert_eq!(leaves((7, 5), 4), [(1, 1), (1, 1), (2, 1), (1, 1), (2, 1)]);
}
