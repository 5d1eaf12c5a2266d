//! Weighted maps: integrals, least costs by hand, and what must hold on random maps.

use std::collections::{BTreeMap, BTreeSet};

use mediant_grid::{CornerRule, DiagonalGap, Grid, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, Vector};
use mediant_oracle::{
    Explicit, Fault, Integral, Rng, Shares, WeightedGraph, WeightedMap, maps_of_nine_cells, neighborhood,
    random_free_vertex, random_vertex, random_weighted, seeds, segment_is_legal, turn_is_legal,
    weighted_costs, weighted_lengths, weighted_path_cost, weighted_path_length,
};

const OPEN: Rules = Rules::Corner(DiagonalGap::Open);
const CLOSED: Rules = Rules::Corner(DiagonalGap::Closed);
const PLACEMENTS: [PlacementKind; 2] = [PlacementKind::Center, PlacementKind::Corner];

fn k(k: u32) -> Option<FiniteK> {
    Some(FiniteK::new(k).expect("k in a test"))
}

fn at(x: i32, y: i32) -> Vertex {
    Vertex::new(x, y)
}

/// An integer cost for tests: the integral in units of 2⁻¹⁰, rounded up, so that no move is free.
fn rounded(integral: &Integral, cell_size: (f64, f64)) -> u64 {
    (integral.length(cell_size) * 1024.0).ceil() as u64
}

fn is_same(a: Option<f64>, b: Option<f64>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * b,
        (None, None) => true,
        _ => false,
    }
}

/// The weighted length from one vertex to another, which is the same both ways.
#[track_caller]
fn check(map: &WeightedMap, rules: Rules, k: Option<FiniteK>, ends: [Vertex; 2], expected: Option<f64>) {
    let graph = WeightedGraph::new(map, rules, k);
    for [a, b] in [ends, [ends[1], ends[0]]] {
        let found = graph.lengths(&[a])[graph.index(b).expect("a vertex of the map")];
        assert!(is_same(found, expected), "{found:?}, not {expected:?}: {a} to {b}, {rules}, {k:?}, {map}");
    }
}

#[test]
fn shares_sum_to_the_whole_and_are_the_same_backwards() {
    for placement in PLACEMENTS {
        let mut both = vec![Vector::new(12, 8), Vector::new(-5, 0), Vector::new(0, 7), Vector::new(9, -9)];
        both.extend(neighborhood(k(8), u32::MAX, u32::MAX));
        assert!(both.len() > 256);
        for d in both {
            let shares = Shares::new(placement, d);
            let factor = if placement == PlacementKind::Center { 2 } else { 1 };
            let [x, y] = [d.x, d.y].map(|n| u128::from(n.unsigned_abs().max(1)));
            assert_eq!(shares.denominator(), factor * x * y, "{d:?}");
            let sum: u128 = shares.pieces().iter().map(|piece| piece.numerator).sum();
            assert_eq!(sum, shares.denominator(), "{placement:?}, {d:?}");
            let sorted = |shares: &Shares, by: Vector| -> BTreeSet<_> {
                let cells = |cells: &[Vector]| cells.iter().map(|&cell| cell + by).collect::<BTreeSet<_>>();
                shares.pieces().iter().map(|piece| (cells(&piece.cells), piece.numerator)).collect()
            };
            let back = Shares::new(placement, Vector::new(-d.x, -d.y));
            assert_eq!(sorted(&shares, Vector::new(0, 0)), sorted(&back, d), "{placement:?}, {d:?}");
        }
    }
}

/// Points along the segment, each in the cell that holds it, know nothing of clipping.
#[test]
fn integrals_are_the_sums_over_points() {
    let points = 4096;
    for seed in 0..100 {
        let mut rng = Rng::new(seed);
        let grid = Grid::from_fn(9, 7, |_, _| false).expect("a valid size");
        let map = WeightedMap::from_fn(grid, |_, _| 1 + rng.below(100));
        for placement in PLACEMENTS {
            let mut vertex = || random_vertex(&mut rng, map.grid(), placement);
            let (a, b) = (vertex(), vertex());
            let d = a.to(b);
            if placement == PlacementKind::Corner && (d.x == 0 || d.y == 0) || a == b {
                continue;
            }
            let half = if placement == PlacementKind::Center { 0.5 } else { 0.0 };
            let point = |i: u32| {
                let t = (f64::from(i) + 0.5) / f64::from(points);
                let cell = |from: i32, by: i32| (f64::from(from) + half + f64::from(by) * t).floor() as i32;
                map.weight(cell(a.x, d.x), cell(a.y, d.y)).map_or(0.0, f64::from)
            };
            let expected = (0..points).map(point).sum::<f64>() / f64::from(points);
            let found = map.integral(placement, a, b).expect("all cells are free").mean();
            // At each of up to 16 grid lines one point may be in the wrong one of two cells.
            let slack = 16.0 * 100.0 / f64::from(points);
            assert!((found - expected).abs() < slack, "{found}, not {expected}: {a} to {b}, seed {seed}");
        }
    }
}

#[test]
fn known_costs_at_centers() {
    let root = f64::sqrt;
    let map = WeightedMap::parse("1 2\n4 8\n16 32");
    let never = Rules::Center(CornerRule::Never);
    check(&map, never, k(2), [at(0, 0), at(1, 0)], Some(1.5));
    check(&map, never, k(3), [at(0, 0), at(1, 1)], Some(root(2.0) * 4.5));
    check(&map, never, k(3), [at(1, 0), at(1, 1)], Some(5.0));
    check(&map, never, k(4), [at(0, 0), at(1, 2)], Some(root(5.0) * 45.0 / 4.0));
    check(&map, never, k(4), [at(0, 0), at(0, 2)], Some(2.5 + 10.0));
    // Around a mountain.
    let map = WeightedMap::parse("1 9 1\n1 9 1\n1 1 1");
    check(&map, never, k(2), [at(0, 0), at(2, 0)], Some(6.0));
    check(&map, never, k(3), [at(0, 1), at(2, 1)], Some(root(8.0)));
    check(&map, never, k(2), [at(0, 0), at(1, 1)], Some(1.0 + 5.0));
    let map = WeightedMap::parse("1 #\n# 3");
    check(&map, never, k(3), [at(0, 0), at(1, 1)], None);
    check(&map, Rules::Center(CornerRule::Always), k(3), [at(0, 0), at(1, 1)], Some(root(8.0)));
    // A blocked cell along the way forbids a move.
    let map = WeightedMap::parse("1 3\n# 5\n9 7");
    check(&map, Rules::Center(CornerRule::Always), k(4), [at(0, 0), at(1, 2)], Some(3.0 * root(2.0) + 6.0));
}

#[test]
fn known_costs_at_corners() {
    let root = f64::sqrt;
    let map = WeightedMap::parse("1 2\n4 8\n16 32");
    // Along a grid line with the cheaper cell, along the rim with the only one.
    check(&map, OPEN, k(2), [at(1, 0), at(1, 1)], Some(1.0));
    check(&map, OPEN, k(2), [at(2, 1), at(2, 3)], Some(40.0));
    check(&map, OPEN, k(3), [at(0, 0), at(1, 1)], Some(root(2.0)));
    check(&map, OPEN, k(4), [at(0, 0), at(2, 1)], Some(1.5 * root(5.0)));
    // Two sides of a cell with cheaper neighbors are less than its diagonal.
    check(&map, OPEN, k(4), [at(0, 1), at(1, 3)], Some(1.0 + 4.0 + 16.0));
    // The cell on the one side is blocked, then that on the other side.
    let map = WeightedMap::parse("7 #\n# 5");
    check(&map, OPEN, k(2), [at(1, 0), at(1, 2)], Some(12.0));
    check(&map, OPEN, k(3), [at(0, 0), at(2, 2)], Some(root(2.0) * 12.0));
    check(&map, CLOSED, k(2), [at(1, 0), at(1, 2)], None);
    check(&map, CLOSED, k(3), [at(0, 0), at(2, 2)], None);
    // It may be touched from one quadrant.
    check(&map, CLOSED, k(2), [at(1, 0), at(0, 1)], Some(14.0));
    check(&map, CLOSED, k(2), [at(2, 1), at(1, 2)], Some(10.0));
    // A path ends there in the quadrant of its own cell.
    check(&map, CLOSED, k(2), [at(1, 1), at(1, 2)], Some(5.0));
    check(&map, CLOSED, k(2), [at(1, 1), at(1, 0)], None);
}

#[test]
fn known_costs_on_cells_that_are_no_squares() {
    let root = f64::sqrt;
    let map = WeightedMap::parse("1 2\n4 8\n16 32").with_cell_size(3.0, 4.0);
    let always = Rules::Center(CornerRule::Always);
    check(&map, always, k(2), [at(0, 0), at(1, 0)], Some(4.5));
    check(&map, always, k(2), [at(0, 0), at(0, 1)], Some(10.0));
    check(&map, always, k(3), [at(0, 0), at(1, 1)], Some(22.5));
    check(&map, always, k(4), [at(0, 0), at(1, 2)], Some(root(73.0) * 45.0 / 4.0));
    check(&map, OPEN, k(2), [at(1, 0), at(1, 1)], Some(4.0));
    check(&map, OPEN, k(3), [at(0, 1), at(1, 2)], Some(3.0 + 16.0));
}

/// Calls `test` with random maps, rules and k, and a description.
fn on_random_maps(default: u64, mut test: impl FnMut(&WeightedMap, Rules, u32, &mut Rng, &str)) {
    for seed in seeds(default) {
        let (map, kind) = random_weighted(seed);
        if map.grid().width() * map.grid().height() > 300 && seed % 4 != 3 {
            continue;
        }
        for rules in Rules::ALL {
            let mut rng = Rng::new(seed);
            let k = 2 + rng.below(4);
            test(&map, rules, k, &mut rng, &format!("seed {seed}, {kind}, {rules}, k = {k}\n{map}"));
        }
    }
}

#[test]
fn equal_weights_are_a_factor_of_lengths() {
    let mut reached = 0;
    on_random_maps(120, |map, rules, number, rng, context| {
        let factor = 1 + rng.below(9);
        let map = map.map_weights(|_| factor).with_cell_size(1.0, 1.0);
        let Some(start) = random_free_vertex(rng, map.grid(), rules.placement()) else { return };
        let (explicit, graph) =
            (Explicit::new(map.grid(), rules, k(number)), WeightedGraph::new(&map, rules, k(number)));
        let (costs, found) = (explicit.costs_from(start), graph.lengths(&[start]));
        assert!(found.iter().any(Option::is_some), "{context}");
        for goal in graph.free_vertices() {
            let found = found[graph.index(goal).expect("a vertex")];
            let expected = costs.to(goal).map(|length| length * f64::from(factor));
            assert!(is_same(found, expected), "{found:?}, not {expected:?}: {start} to {goal}, {context}");
            reached += u32::from(found.is_some());
            if let Some(path) = costs.path_to(goal) {
                let length = weighted_path_length(&map, rules, k(number), &path).expect(context);
                assert!(is_same(Some(length), expected), "{start} to {goal}, {context}");
            }
        }
    });
    assert!(reached > 5000, "{reached}");
}

#[test]
fn costs_are_the_same_both_ways_and_scale() {
    let mut reached = 0;
    on_random_maps(120, |map, rules, number, rng, context| {
        let graph = WeightedGraph::new(map, rules, k(number));
        let mut free = || random_free_vertex(rng, map.grid(), rules.placement());
        let Some((a, b)) = free().zip(free()) else { return };
        let index = |at| graph.index(at).expect("a vertex");
        let (there, back) = (graph.lengths(&[a]), graph.lengths(&[b]));
        assert!(is_same(there[index(b)], back[index(a)]), "{a} to {b}, {context}");
        let cost = |integral: &Integral| rounded(integral, map.cell_size());
        assert_eq!(
            graph.costs(&[a], cost)[index(b)],
            graph.costs(&[b], cost)[index(a)],
            "{a} to {b}, {context}"
        );
        // Exact: a mean of weights times 4 is a mean of four times the weights, and a factor of 2 rounds
        // nothing.
        let (cut, four) = (map.map_weights(|w| (w / 8).max(1)), map.map_weights(|w| (w / 8).max(1) * 4));
        let (cut, four) =
            (weighted_lengths(&cut, rules, k(number), &[a]), weighted_lengths(&four, rules, k(number), &[a]));
        for (cut, four) in cut.iter().zip(&four) {
            assert_eq!(cut.map(|length| 4.0 * length), *four, "{context}");
            reached += u32::from(cut.is_some());
        }
    });
    assert!(reached > 5000, "{reached}");
}

/// No edge leads to less than was found, and every cost is that of an edge from a vertex nearer by: costs are
/// a fixed point, which for positive moves is the only one. Without gaps, states are vertices.
#[test]
fn costs_are_the_fixed_point_over_legal_moves() {
    let mut tight = 0;
    on_random_maps(40, |map, rules, number, rng, context| {
        if rules == CLOSED || map.weights().len() > 150 {
            return;
        }
        let placement = rules.placement();
        let Some(start) = random_free_vertex(rng, map.grid(), placement) else { return };
        let graph = WeightedGraph::new(map, rules, k(number));
        let cost = |integral: &Integral| rounded(integral, map.cell_size());
        let found = graph.costs(&[start], cost);
        let of = |at| graph.index(at).and_then(|index| found[index]);
        let moves = neighborhood(k(number), map.grid().width(), map.grid().height());
        for to in graph.free_vertices().filter(|&to| to != start) {
            let from =
                moves.iter().map(|&d| to + d).filter(|&from| segment_is_legal(map.grid(), rules, from, to));
            let through = |from| Some(of(from)? + cost(&map.integral(placement, from, to).expect(context)));
            let expected = from.filter_map(through).min();
            assert_eq!(of(to), expected, "{start} to {to}, {context}");
            tight += u32::from(expected.is_some());
        }
    });
    assert!(tight > 1000, "{tight}");
}

/// The costs from a vertex by a search whose states are a vertex and the one before it, so that turns at gaps
/// are judged as they occur.
fn costs_by_turns(
    map: &WeightedMap,
    rules: Rules,
    k: Option<FiniteK>,
    start: Vertex,
) -> BTreeMap<(i32, i32), u64> {
    let (grid, placement) = (map.grid(), rules.placement());
    let moves = neighborhood(k, grid.width() + 1, grid.height() + 1);
    let may_turn = |before, at, after| rules != CLOSED || turn_is_legal(grid, before, at, after);
    let (mut costs, mut done) = (BTreeMap::new(), BTreeSet::new());
    let mut open = BTreeSet::from([(0, (start.x, start.y), None::<(i32, i32)>)]);
    while let Some((cost, xy, before)) = open.pop_first() {
        if !done.insert((xy, before)) {
            continue;
        }
        let (from, before) = (Vertex::from(xy), before.map(Vertex::from));
        if may_turn(before, from, None) {
            costs.entry(xy).or_insert(cost);
        }
        for to in moves.iter().map(|&d| from + d) {
            if may_turn(before, from, Some(to)) && segment_is_legal(grid, rules, from, to) {
                let integral = map.integral(placement, from, to).expect("a legal move");
                open.insert((cost + rounded(&integral, map.cell_size()), (to.x, to.y), Some(xy)));
            }
        }
    }
    costs
}

#[test]
fn gaps_are_left_as_they_may_be() {
    let (mut closed, mut open) = (0, 0);
    for (cells, grid) in maps_of_nine_cells(7) {
        let mut rng = Rng::new(cells);
        let map = WeightedMap::from_fn(grid, |_, _| 1 + rng.below(9));
        for (rules, number) in [(CLOSED, 2), (CLOSED, 3), (CLOSED, 4), (OPEN, 3)] {
            let Some(start) = random_free_vertex(&mut rng, map.grid(), PlacementKind::Corner) else {
                continue;
            };
            let expected = costs_by_turns(&map, rules, k(number), start);
            let graph = WeightedGraph::new(&map, rules, k(number));
            let found = graph.costs(&[start], |integral| rounded(integral, (1.0, 1.0)));
            for to in graph.free_vertices() {
                let (found, expected) =
                    (found[graph.index(to).expect("a vertex")], expected.get(&(to.x, to.y)));
                assert_eq!(
                    found.as_ref(),
                    expected,
                    "{start} to {to}, {rules}, k = {number}, map {cells}: {map}"
                );
                *if rules == CLOSED { &mut closed } else { &mut open } += u32::from(found.is_none());
            }
        }
    }
    assert!(closed > 100, "{closed} not reached with closed gaps, {open} with open ones");
}

#[test]
fn the_nearest_source_is_the_least_of_those_equally_near() {
    let mut ties = 0;
    on_random_maps(60, |map, rules, number, rng, context| {
        let graph = WeightedGraph::new(map, rules, k(number));
        let mut sources: Vec<Vertex> =
            (0..4).filter_map(|_| random_free_vertex(rng, map.grid(), rules.placement())).collect();
        // Blocked, perhaps, or twice there, or outside.
        sources.extend([random_vertex(rng, map.grid(), rules.placement()), at(-1, 0)]);
        sources.extend(sources.first().copied());
        let cost = |integral: &Integral| rounded(integral, map.cell_size());
        let alone: Vec<_> = sources.iter().map(|&source| graph.costs(&[source], cost)).collect();
        for (v, found) in graph.nearest(&sources, cost).into_iter().enumerate() {
            let each = alone.iter().zip(0..).filter_map(|(costs, index)| Some((costs[v]?, index)));
            let least = each.clone().min();
            assert_eq!(found, least, "vertex {v} from {sources:?}, {context}");
            let distinct: BTreeSet<Vertex> = each
                .filter(|&(cost, _)| Some(cost) == least.map(|(cost, _)| cost))
                .map(|(_, index)| sources[index])
                .collect();
            ties += u32::from(distinct.len() > 1);
        }
        assert_eq!(
            graph.costs(&sources, cost),
            weighted_costs(map, rules, k(number), &sources, cost),
            "{context}"
        );
    });
    assert!(ties > 50, "{ties}");
}

#[test]
fn costs_of_paths() {
    let map = WeightedMap::parse("1 2 3\n4 # 5\n6 7 8").with_cell_size(1.0, 2.0);
    let rules = Rules::Center(CornerRule::One);
    let numerators = |integral: &Integral| integral.numerator as u64;
    let cost = |number: Option<u32>, path: &[(i32, i32)]| {
        let path: Vec<Vertex> = path.iter().map(|&at| at.into()).collect();
        weighted_path_cost(&map, rules, number.and_then(k), &path, numerators)
    };
    assert_eq!(cost(Some(3), &[]), Ok(0));
    assert_eq!(cost(Some(3), &[(0, 0)]), Ok(0));
    // Two moves, with denominator 2, or one segment, with denominator 4.
    assert_eq!(cost(Some(2), &[(0, 0), (2, 0)]), Ok(3 + 5));
    assert_eq!(cost(None, &[(0, 0), (2, 0)]), Ok(1 + 2 * 2 + 3));
    assert_eq!(cost(Some(3), &[(0, 1), (1, 0), (2, 1), (2, 2)]), Ok(6 + 7 + 13));
    assert!(matches!(cost(Some(3), &[(0, 0), (2, 2)]), Err(Fault::Segment { .. })));
    assert!(matches!(cost(Some(3), &[(0, 0), (1, 2)]), Err(Fault::NotAMove { .. })));
    assert!(matches!(cost(Some(3), &[(0, 0), (1, 1)]), Err(Fault::NotFree { .. })));
    let path = [at(0, 1), at(1, 0), at(1, 0)];
    assert!(matches!(weighted_path_length(&map, rules, k(3), &path), Err(Fault::Still { .. })));
    assert_eq!(weighted_path_length(&map, rules, k(3), &path[..2]), Ok(3.0 * 5.0_f64.sqrt()));
    let gap = WeightedMap::parse("7 #\n# 5");
    let through = [at(0, 0), at(2, 2)];
    assert!(matches!(weighted_path_cost(&gap, CLOSED, k(3), &through, numerators), Err(Fault::Turn { .. })));
    assert_eq!(weighted_path_cost(&gap, OPEN, k(3), &through, numerators), Ok(12));
}

#[test]
fn every_kind_of_weights_occurs() {
    let (mut kinds, mut sizes, mut wide) = (BTreeSet::new(), BTreeSet::new(), 0);
    for seed in 0..400 {
        let (map, kind) = random_weighted(seed);
        assert_eq!((map.clone(), kind.clone()), random_weighted(seed), "seed {seed}");
        let weights = kind.rsplit_once(" by ").and_then(|(_, end)| end.split_once(", ")).expect(&kind).1;
        kinds.insert(weights.chars().filter(|c| !c.is_ascii_digit()).collect::<String>());
        let (x, y) = map.cell_size();
        sizes.insert(format!("{x}, {y}"));
        wide += u32::from(map.weights().iter().any(|&weight| weight > 1 << 30));
        // The text is a drawing of the same map, but for what blocked cells weigh.
        let text = map.to_string();
        let drawn = WeightedMap::parse(text.split_once('\n').expect("a first line").1);
        assert_eq!(drawn.grid(), map.grid(), "seed {seed}");
        for (x, y) in
            (0..map.grid().height() as i32).flat_map(|y| (0..map.grid().width() as i32).map(move |x| (x, y)))
        {
            assert_eq!(drawn.weight(x, y), map.weight(x, y), "seed {seed}");
        }
    }
    assert_eq!((kinds.len(), sizes.len(), wide > 3), (7, 6, true), "{kinds:?}, {sizes:?}, {wide}");
}
