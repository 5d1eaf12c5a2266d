//! Optimal costs: known ones, and what must hold on random maps.

use std::collections::{BTreeMap, VecDeque};

use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Grid, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{
    Case, Explicit, describe, is_gap, neighborhood, seeds, segment_is_legal, turn_is_legal, validate,
};

const OPEN: Rules = Rules::Corner(DiagonalGap::Open);
const CLOSED: Rules = Rules::Corner(DiagonalGap::Closed);

fn k(k: u32) -> Option<FiniteK> {
    Some(FiniteK::new(k).expect("k in a test"))
}

/// Checks the cost from `s` to `g` on a drawing, both ways; under corner placement these are the upper left
/// corners of the marked cells.
fn check(drawing: &str, rules: Rules, k: Option<FiniteK>, expected: Option<f64>) {
    let map = AsciiMap::parse(drawing).expect("a drawing in a test");
    let (s, g) = map.mark('s').zip(map.mark('g')).expect("both are marked");
    check_between(&map.grid, rules, k, (s, g), expected);
}

fn check_between(
    grid: &Grid,
    rules: Rules,
    k: Option<FiniteK>,
    (s, g): (Vertex, Vertex),
    expected: Option<f64>,
) {
    let graph = Explicit::new(grid, rules, k);
    for (a, b) in [(s, g), (g, s)] {
        let found = graph.costs_from(a).to(b);
        assert!(
            is_same(found, expected),
            "{found:?}, not {expected:?}; k = {k:?}; {}",
            describe(grid, rules, a, b, 0)
        );
    }
}

fn is_same(a: Option<f64>, b: Option<f64>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * b,
        (None, None) => true,
        _ => false,
    }
}

#[test]
fn known_costs_at_centers() {
    let never = Rules::Center(CornerRule::Never);
    let root = f64::sqrt;
    let wall = "s#g\n.#.\n...";
    check(wall, never, k(2), Some(6.0));
    check(wall, never, k(3), Some(6.0));
    check(wall, Rules::Center(CornerRule::One), k(3), Some(2.0 + 2.0 * root(2.0)));
    check("s#g", never, k(3), None);
    check("s#\n#g", never, k(3), None);
    check("s#\n#g", Rules::Center(CornerRule::Always), k(3), Some(root(2.0)));
    // (2, 1) is not legal at the start but one step later.
    check("s...\n.#.g\n....", never, k(4), Some(1.0 + root(5.0)));
    check("s....\n....g", never, k(3), Some(3.0 + root(2.0)));
    check("s....\n....g", never, k(5), Some(1.0 + root(10.0)));
    check("s....\n....g", never, k(6), Some(root(17.0)));
    check("s....\n....g", never, None, Some(root(17.0)));
}

#[test]
fn known_costs_at_corners() {
    let root = f64::sqrt;
    // Around one blocked cell: along its edges, and straight past its corners.
    check("s..\n.#.\n..g", OPEN, k(2), Some(4.0));
    check("s..\n.#.\n..g", OPEN, k(3), Some(2.0 + root(2.0)));
    check("s...\n.##.\n.##.\n...g", OPEN, k(4), Some(3.0 + root(5.0)));
    check("s...\n.##.\n.##.\n...g", OPEN, None, Some(2.0 + root(10.0)));
    check("s.#g", OPEN, k(2), None);
    // Through the gap at (1, 1), from (2, 0) to (0, 2), or around by nothing.
    let gap = AsciiMap::parse("#.\n.#").unwrap().grid;
    let ends = (Vertex::new(2, 0), Vertex::new(0, 2));
    check_between(&gap, OPEN, k(3), ends, Some(2.0 * root(2.0)));
    check_between(&gap, CLOSED, k(3), ends, None);
}

#[test]
fn closed_gaps_are_left_and_entered_through_the_own_quadrant() {
    // The gap at (1, 1) has its own cell on the lower right; from (0, 0) it is reached only on the other
    // side.
    let own_free = AsciiMap::parse(".#\n#.").unwrap().grid;
    let at = |x, y| Vertex::new(x, y);
    check_between(&own_free, CLOSED, k(2), (at(1, 1), at(2, 2)), Some(2.0));
    check_between(&own_free, CLOSED, k(3), (at(1, 1), at(0, 0)), None);
    check_between(&own_free, OPEN, k(2), (at(1, 1), at(0, 0)), Some(2.0));
    // With its own cell blocked, the gap is an end that leads nowhere but to itself.
    let own_blocked = AsciiMap::parse("#.\n.#").unwrap().grid;
    check_between(&own_blocked, CLOSED, k(3), (at(1, 1), at(0, 1)), None);
    check_between(&own_blocked, CLOSED, k(3), (at(1, 1), at(1, 1)), Some(0.0));
    // The way to the own quadrant may lead around: from (1, 1) out to the right and back to its other side.
    let around = AsciiMap::parse(".#.\n#..\n...").unwrap().grid;
    check_between(&around, CLOSED, k(2), (at(1, 1), at(0, 0)), None);
    check_between(&around, CLOSED, k(2), (at(1, 1), at(1, 2)), Some(1.0));
}

/// In a cell with two gaps across, the 4-connected path from one of its other corners to the opposite
/// one must touch a gap.
#[test]
fn four_connected_paths_may_have_to_touch_a_closed_gap() {
    let grid = AsciiMap::parse("##.\n#.#\n.##").unwrap().grid;
    let ends = (Vertex::new(1, 1), Vertex::new(2, 2));
    check_between(&grid, CLOSED, k(2), ends, Some(2.0));
    check_between(&grid, CLOSED, k(3), ends, Some(f64::sqrt(2.0)));
}

#[test]
fn blocked_and_outside_vertices_have_no_cost() {
    let grid = AsciiMap::parse(".#").unwrap().grid;
    let graph = Explicit::new(&grid, Rules::Center(CornerRule::Never), k(3));
    let (free, blocked, outside) = (Vertex::new(0, 0), Vertex::new(1, 0), Vertex::new(-1, i32::MAX));
    assert_eq!(graph.costs_from(free).to(free), Some(0.0));
    for bad in [blocked, outside] {
        assert_eq!(graph.costs_from(free).to(bad), None);
        assert_eq!(graph.costs_from(bad).to(free), None);
        assert_eq!(graph.costs_from(bad).to(bad), None);
        assert_eq!(graph.costs_from(bad).path_to(bad), None);
    }
    assert_eq!(graph.free_vertices().collect::<Vec<_>>(), [free]);
}

/// Every path is legal and as long as its cost says; more moves make no path longer; a goal in sight is
/// straight ahead, and no path is shorter than a straight line.
#[test]
fn costs_agree_with_paths_with_each_other_and_with_sight() {
    let (mut found, mut in_sight) = (0, 0);
    for seed in seeds(200) {
        for rules in Rules::ALL {
            let Some(case) = Case::random(seed, rules) else { continue };
            let d = case.start.to(case.goal);
            let straight = f64::from(d.x).hypot(f64::from(d.y));
            let mut previous: Option<Option<f64>> = None;
            for k in [k(2), k(3), k(4), k(6), None] {
                let graph = Explicit::new(&case.grid, rules, k);
                let costs = graph.costs_from(case.start);
                let cost = costs.to(case.goal);
                assert_eq!(cost.is_some(), costs.path_to(case.goal).is_some(), "k = {k:?}; {case}");
                assert!(is_same(graph.costs_from(case.goal).to(case.start), cost), "back; k = {k:?}; {case}");
                if let Some((path, cost)) = costs.path_to(case.goal).zip(cost) {
                    let outcome = validate(&case.grid, rules, k, case.start, case.goal, &path, cost);
                    assert_eq!(outcome, Ok(()), "k = {k:?}, {path:?}; {case}");
                    assert!(cost >= straight * (1.0 - 1e-9), "shorter than straight; k = {k:?}; {case}");
                    found += 1;
                }
                let limit = previous.flatten().unwrap_or(f64::INFINITY);
                assert!(cost.unwrap_or(f64::INFINITY) <= limit * (1.0 + 1e-9), "k = {k:?} is longer; {case}");
                previous = Some(cost);
            }
            let closed_end =
                rules == CLOSED && [case.start, case.goal].iter().any(|&at| is_gap(&case.grid, at));
            if segment_is_legal(&case.grid, rules, case.start, case.goal) && !closed_end {
                assert!(is_same(previous.flatten(), Some(straight)), "in sight, not straight; {case}");
                in_sight += 1;
            }
        }
    }
    assert!(found > 2500 && in_sight > 400, "{found} paths, {in_sight} goals in sight");
}

/// The optimal cost under closed gaps from a search over pairs of consecutive vertices, with
/// [`turn_is_legal`] between each two steps: no states of quadrants, and no order by cost.
fn cost_by_pairs(grid: &Grid, k: Option<FiniteK>, start: Vertex, goal: Vertex) -> Option<f64> {
    let mut cost: BTreeMap<(Option<Vertex>, Vertex), f64> = BTreeMap::from([((None, start), 0.0)]);
    let mut changed: VecDeque<_> = cost.keys().copied().collect();
    let moves = neighborhood(k, grid.width(), grid.height());
    while let Some((before, at)) = changed.pop_front() {
        let sum = cost[&(before, at)];
        for &d in &moves {
            let after = at + d;
            if !segment_is_legal(grid, CLOSED, at, after) || !turn_is_legal(grid, before, at, Some(after)) {
                continue;
            }
            let next = sum + f64::from(d.x).hypot(f64::from(d.y));
            let entry = cost.entry((Some(at), after)).or_insert(f64::INFINITY);
            if next < *entry - 1e-12 {
                *entry = next;
                changed.push_back((Some(at), after));
            }
        }
    }
    let ends = cost.iter().filter(|((before, at), _)| *at == goal && turn_is_legal(grid, *before, *at, None));
    ends.map(|(_, &cost)| cost).min_by(f64::total_cmp)
}

#[test]
fn closed_costs_agree_with_a_search_over_pairs_of_vertices() {
    let (mut compared, mut unreachable) = (0, 0);
    for seed in 0..1500 {
        let Some(case) = Case::random(seed, CLOSED) else { continue };
        let corners = gap_corners(&case.grid);
        if corners.is_empty() || case.grid.width() * case.grid.height() > 20 {
            continue;
        }
        for k in [k(2), k(3), k(4)] {
            let graph = Explicit::new(&case.grid, CLOSED, k);
            for (start, goal) in [(case.start, case.goal), (case.start, corners[0]), (corners[0], case.goal)]
            {
                let expected = cost_by_pairs(&case.grid, k, start, goal);
                let found = graph.costs_from(start).to(goal);
                let context = describe(&case.grid, CLOSED, start, goal, seed);
                assert!(is_same(found, expected), "{found:?}, not {expected:?}; k = {k:?}; {context}");
                compared += 1;
                unreachable += u32::from(expected.is_none());
            }
        }
    }
    let enough = compared > 400 && unreachable > 100;
    assert!(enough, "{compared} compared, {unreachable} unreachable");
}

fn gap_corners(grid: &Grid) -> Vec<Vertex> {
    let (w, h) = (grid.width() as i32, grid.height() as i32);
    let all = (0..=h).flat_map(|y| (0..=w).map(move |x| Vertex::new(x, y)));
    all.filter(|&at| is_gap(grid, at)).collect()
}

/// From k = 3 on, an optimal path under closed gaps touches no gap but with its ends: at one it would
/// turn by 90° or more within a free cell, and a shorter way leads through that cell.
#[test]
fn optimal_paths_need_no_closed_gap_from_k_3_on() {
    let mut with_gaps = 0;
    for seed in 0..1500 {
        let Some(case) = Case::random(seed, CLOSED) else { continue };
        if gap_corners(&case.grid).is_empty() || case.grid.width() * case.grid.height() > 200 {
            continue;
        }
        with_gaps += 1;
        for k in [k(3), k(4), k(5), None] {
            let graph = Explicit::new(&case.grid, CLOSED, k);
            let costs = graph.costs_from(case.start);
            for goal in graph.free_vertices() {
                let path = costs.path_to(goal).unwrap_or_default();
                let inner = path.get(1..path.len().saturating_sub(1)).unwrap_or_default();
                let touched = inner.iter().find(|&&at| is_gap(&case.grid, at));
                let context = describe(&case.grid, CLOSED, case.start, goal, seed);
                assert_eq!(touched, None, "k = {k:?}; {context}");
            }
        }
    }
    assert!(with_gaps > 300, "{with_gaps} maps with gaps");
}
