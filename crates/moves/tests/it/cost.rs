//! Fixed-point costs: their error, exactness and consistency, in integers throughout.

use crate::common::*;
use mediant_moves::{Cost, CostTable, FiniteK, Neighborhood, Quadrant, Vector};

fn table(n: u32) -> CostTable {
    CostTable::new(k(n)).expect("at most 18")
}

/// |c − ‖v‖·2³²| ≤ ½ exactly when (c − ½)² ≤ s ≤ (c + ½)² with s = ‖v‖²·2⁶⁴; s is an integer, so the ¼ rounds away.
fn assert_nearest(v: Vector, what: impl std::fmt::Display) {
    let c = u128::from(Cost::of_move(v).to_bits());
    let s = u128::from(v.norm_squared()) << 64;
    assert!(c == 0 && s == 0 || c * (c - 1) < s && s <= c * (c + 1), "{v:?} costs {c}; {what}");
}

#[test]
fn cost_of_a_move_is_the_nearest_multiple() {
    assert_eq!(Cost::MAX_MOVE_ERROR, 2f64.powi(-33));
    for n in 2..=16 {
        for v in Quadrant::new(k(n)).expect("a small k") {
            assert_nearest(v, format!("k = {n}"));
        }
    }
    let mut random = Random::new();
    let seed = random.seed;
    for _ in 0..5_000 {
        assert_nearest(random.vector(31), format!("seed {seed}"));
    }
    let limits = [i32::MIN, i32::MAX, 1 - i32::MAX, 1, 0];
    for v in limits.iter().flat_map(|&x| limits.map(|y| Vector::new(x, y))) {
        assert_nearest(v, "at the limits");
    }
}

#[test]
fn cost_of_an_axis_move_is_exact() {
    for v in [(0, 1), (1, 0), (0, -1), (-1, 0)] {
        assert_eq!(Cost::of_move(Vector::from(v)), Cost::from_bits(1 << Cost::FRACTION_BITS));
    }
    for n in [0, 7, i32::MAX] {
        assert_eq!(Cost::of_move(Vector::new(0, -n)).to_bits(), (n as u64) << 32);
    }
}

#[test]
fn cost_grows_with_length() {
    let mut moves: Vec<Vector> = square(60).map(vector).collect();
    moves.sort_by_key(|v| v.norm_squared());
    for two in moves.windows(2) {
        let (a, b) = (Cost::of_move(two[0]), Cost::of_move(two[1]));
        assert_eq!(a.cmp(&b), two[0].norm_squared().cmp(&two[1].norm_squared()), "{two:?}");
    }
}

#[test]
fn cost_arithmetic_is_that_of_its_bits() {
    let (a, b) = (Cost::of_move(Vector::new(1, 1)), Cost::of_move(Vector::new(1, 2)));
    assert_eq!((a + b).to_bits(), a.to_bits() + b.to_bits());
    assert_eq!((a + b - a, a * 3, a - a), (b, a + a + a, Cost::ZERO));
    let mut sum = a;
    sum += b;
    assert_eq!(sum, b + a);
    assert!(Cost::ZERO < a && a < b && b < Cost::MAX && Cost::default() == Cost::ZERO);
    assert!((a.to_f64() - 2f64.sqrt()).abs() <= Cost::MAX_MOVE_ERROR);
    assert_eq!(Cost::from_bits(3 << 31).to_string(), "1.5");
    assert_eq!(format!("{:.2}", Cost::from_bits(3 << 31)), "1.50");
}

#[test]
fn cost_table_holds_the_costs_of_the_quadrant() {
    for n in 2..=CostTable::MAX_K {
        let (table, quadrant) = (table(n), Quadrant::new(k(n)).expect("a small k"));
        for (j, v) in quadrant.iter().enumerate() {
            assert_eq!(table.get(j), Some(Cost::of_move(v)), "k = {n}, index {j}");
        }
        assert_eq!((table.get(quadrant.len() as usize), table.get(usize::MAX)), (None, None));
    }
}

/// Dijkstra with the same integer costs: `f64` sums of integers below 2⁵³ are exact.
#[test]
fn cost_table_distance_is_exactly_the_cheapest_path() {
    for n in 2..=14 {
        let cost = |m: Pair| Cost::of_move(vector(m)).to_bits() as f64;
        let graph = EmptyGrid::new(&naive_neighborhood(n), 28, 2f64.powi(32), cost);
        for d in square(14) {
            let (got, expected) = (table(n).distance(vector(d)).to_bits(), graph.cost(d));
            assert_eq!(got as f64, expected, "k = {n}, {d:?}");
        }
    }
}

#[test]
fn cost_table_distance_is_consistent() {
    let mut random = Random::new();
    let seed = random.seed;
    for n in 2..=10 {
        let table = table(n);
        let moves: Vec<(Vector, Cost)> =
            Neighborhood::new(k(n)).expect("a small k").iter().map(|m| (m, Cost::of_move(m))).collect();
        let near = square(4).map(vector);
        let far: Vec<Vector> = (0..300).map(|_| random.vector(20)).collect();
        for d in near.chain(far) {
            let h = table.distance(d);
            for &(m, cost) in &moves {
                assert!(h <= cost + table.distance(d - m), "k = {n}, {d:?}, {m:?}, seed {seed}");
            }
        }
        for &(m, cost) in &moves {
            assert_eq!(table.distance(m), cost, "k = {n}, {m:?}");
        }
    }
}

#[test]
fn cost_table_distance_at_the_limits() {
    let max = i32::MAX;
    for n in 2..=CostTable::MAX_K {
        let table = table(n);
        assert_eq!(table.distance(Vector::ZERO), Cost::ZERO);
        assert_eq!(table.distance(Vector::new(0, -max)).to_bits(), u64::from(max.unsigned_abs()) << 32);
        let diagonal = Cost::of_move(Vector::new(1, 1));
        let expected = if n == 2 { Cost::from_bits(1 << 33) } else { diagonal } * max.unsigned_abs();
        assert_eq!(table.distance(Vector::new(-max, max)), expected, "k = {n}");
    }
}

/// c(a) + c(c) − m·c(b) for every move b of the first quadrant but (1, 0), and its neighbors a and c, where
/// m·b = a + c: by how much a detour over the neighbors costs more.
fn detours(n: u32) -> Vec<i128> {
    let quadrant = Quadrant::new(k(n)).expect("a small k");
    let moves: Vec<Vector> = quadrant.iter().collect();
    let costs: Vec<i128> = moves.iter().map(|&v| Cost::of_move(v).to_bits().into()).collect();
    (0..moves.len() - 1)
        .map(|j| {
            // The neighbor before (0, 1) is the mirror image of the one after it.
            let (after, mirrored) = (moves[j + 1], Vector::new(-moves[1].x, moves[1].y));
            let (before, cost_before) =
                if j == 0 { (mirrored, costs[1]) } else { (moves[j - 1], costs[j - 1]) };
            let m = (before + after).y / moves[j].y;
            assert_eq!(moves[j] * m, before + after, "k = {n}, index {j}");
            cost_before + costs[j + 1] - i128::from(m) * costs[j]
        })
        .collect()
}

/// A function that is linear between neighboring moves and bends nowhere inwards is a norm, so that h_k in
/// rounded costs is the cheapest path and consistent.
#[test]
fn cost_table_max_k_is_the_last_that_keeps_the_costs_convex() {
    assert_eq!(CostTable::MAX_K, 18);
    for n in 2..=18 {
        assert!(detours(n).iter().all(|&excess| excess > 0), "k = {n}");
    }
    assert!(detours(19).iter().any(|&excess| excess < 0), "k = 19 bends inwards");
    assert!(CostTable::new(k(19)).is_err() && CostTable::new(FiniteK::MAX_MOVES).is_err());
}

/// h_k of eighths against an eighth of h_k: a norm is homogeneous.
#[test]
fn distances_of_displacements_that_are_not_whole() {
    let mut random = Random::new();
    let seed = random.seed;
    for n in 2..=18 {
        let table = table(n);
        for _ in 0..2_000 {
            let v = random.vector(19);
            let exact = table.distance(v).to_f64() / 8.0;
            let found = table.distance_f64(f64::from(v.x) / 8.0, f64::from(v.y) / 8.0);
            assert!(
                (found - exact).abs() <= 2f64.powi(-34),
                "k = {n}, {v:?}: {found}, not {exact}; seed {seed}"
            );
        }
    }
}
