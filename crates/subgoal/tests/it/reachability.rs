//! The graph is that of Hormazábal et al. 2017: its subgoals, its edges, and the distances that its levels
//! keep.

use std::{
    cmp::Reverse,
    collections::{BTreeSet, BinaryHeap},
};

use mediant_grid::{Corners, DiagonalGap, Grid, Rules, Vector, Vertex};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{
    Costs, Explicit, Visibility, describe, on_all_cores, random_grid, seeds, segment_is_legal, suite_grid,
    turn_is_legal,
};
use mediant_search::{Ends, Path, Planner};
use mediant_subgoal::{Hierarchy, SubgoalAStar};

use crate::common::{GAPS, HIERARCHIES, graph, k, levels, space};

fn vertices(grid: &Grid) -> impl Iterator<Item = Vertex> {
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    (0..=height).flat_map(move |y| (0..=width).map(move |x| Vertex::new(x, y)))
}

/// Whether a vertex is a corner of an obstacle that a path can pass along a diagonal.
fn is_subgoal(grid: &Grid, gap: DiagonalGap, at: Vertex) -> bool {
    let is_blocked = |(x, y): (i32, i32)| {
        let is_inside = (0..grid.width() as i32).contains(&x) && (0..grid.height() as i32).contains(&y);
        is_inside && grid.is_blocked(x, y)
    };
    let passes = |d: Vector| {
        let (before, after) = (at + Vector::new(-d.x, -d.y), at + d);
        let is_legal = |a, b| segment_is_legal(grid, Rules::Corner(gap), a, b);
        let may_turn = gap == DiagonalGap::Open || turn_is_legal(grid, Some(before), at, Some(after));
        is_legal(before, at) && is_legal(at, after) && may_turn
    };
    [(-1, -1), (0, -1), (-1, 0), (0, 0)].into_iter().any(|(x, y)| is_blocked((at.x + x, at.y + y)))
        && [Vector::new(1, 1), Vector::new(-1, 1)].into_iter().any(passes)
}

#[test]
fn subgoals_are_the_corners_that_a_diagonal_passes() {
    let mut count = 0;
    for seed in seeds(300) {
        let grid = suite_grid(seed).0;
        for gap in GAPS {
            let graph = graph(&space::<Corners>(&grid, gap), k(3), levels(1));
            let expected: Vec<Vertex> = vertices(&grid).filter(|&at| is_subgoal(&grid, gap, at)).collect();
            let found: Vec<Vertex> = graph.vertices().collect();
            assert_eq!(found, expected, "{}", describe(&grid, Rules::Corner(gap), found[0], found[0], seed));
            assert_eq!(graph.subgoals(), expected.len());
            count += expected.len();
        }
    }
    assert!(count > 10 * seeds(300).end as usize, "only {count} subgoals");
}

/// The two ends of an edge, the upper or left one first.
fn in_order((a, b): (Vertex, Vertex)) -> (Vertex, Vertex) {
    if (a.y, a.x) < (b.y, b.x) { (a, b) } else { (b, a) }
}

fn is_same(a: f64, b: f64) -> bool {
    a == b || a.max(b).is_finite() && (a - b).abs() <= 1e-9 * a.max(b)
}

/// The pairs of directly h_k-reachable subgoals (Definitions 1 and 2): h_k is the cost of an optimal path
/// between them, and no other subgoal is on one.
fn directly_reachable(graph: &Explicit, subgoals: &[Vertex], k: FiniteK) -> BTreeSet<(Vertex, Vertex)> {
    let costs: Vec<Costs<'_>> = subgoals.iter().map(|&at| graph.costs_from(at)).collect();
    let cost = |a: usize, b: usize| costs[a].to(subgoals[b]).unwrap_or(f64::INFINITY);
    let is_direct = |a: usize, b: usize| {
        let best = cost(a, b);
        let is_on = |c: usize| c != a && c != b && is_same(cost(a, c) + cost(c, b), best);
        is_same(best, mediant_moves::distance(subgoals[a].to(subgoals[b]), k))
            && !(0..subgoals.len()).any(is_on)
    };
    let pairs = (0..subgoals.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
    pairs.filter(|&(a, b)| is_direct(a, b)).map(|(a, b)| (subgoals[a], subgoals[b])).collect()
}

#[test]
fn edges_join_what_is_directly_reachable() {
    let check = |seed: u64| {
        let (grid, mut count) = (random_grid(seed).0, 0);
        let number = FiniteK::new(2 + seed as u32 % 5).expect("k is at least 2");
        for gap in GAPS {
            let subgoals: Vec<Vertex> = vertices(&grid).filter(|&at| is_subgoal(&grid, gap, at)).collect();
            let explicit = Explicit::new(&grid, Rules::Corner(gap), Some(number));
            let expected = directly_reachable(&explicit, &subgoals, number);
            let graph = graph(&space::<Corners>(&grid, gap), number.into(), levels(1));
            let found: Vec<_> = graph.edges().map(in_order).collect();
            let edges: BTreeSet<_> = found.iter().copied().collect();
            assert_eq!(
                edges.len(),
                found.len(),
                "an edge is visited twice: seed {seed}, {gap:?}, k = {number}"
            );
            if let Some(&(a, b)) = edges.symmetric_difference(&expected).next() {
                let fault = if edges.contains(&(a, b)) { "too much" } else { "missing" };
                panic!("{fault}, k = {number}: {}", describe(&grid, Rules::Corner(gap), a, b, seed));
            }
            count += edges.len();
        }
        count
    };
    let counts = on_all_cores(seeds(200), check);
    assert!(counts.iter().sum::<usize>() > 40 * counts.len(), "too few edges: {counts:?}");
}

/// The distances from one subgoal over edges of these lengths, through subgoals that `is_in` allows.
fn dijkstra(lengths: &[Vec<f64>], from: usize, is_in: impl Fn(usize) -> bool) -> Vec<f64> {
    let mut cost = vec![f64::INFINITY; lengths.len()];
    cost[from] = 0.0;
    let mut open = BinaryHeap::from([Reverse((0, from))]);
    while let Some(Reverse((_, at))) = open.pop() {
        for to in (0..lengths.len()).filter(|&to| is_in(to)) {
            let next = cost[at] + lengths[at][to];
            if next < cost[to] {
                cost[to] = next;
                // The bits of floats that are not negative are ordered as the floats.
                open.push(Reverse((next.to_bits(), to)));
            }
        }
    }
    cost
}

/// The subgoals, and for each two of them the length of the edge between them, or infinity.
fn lengths(grid: &Grid, gap: DiagonalGap, k: FiniteK) -> (Vec<Vertex>, Vec<Vec<f64>>) {
    let graph = graph(&space::<Corners>(grid, gap), k.into(), levels(1));
    let subgoals: Vec<Vertex> = graph.vertices().collect();
    let mut lengths = vec![vec![f64::INFINITY; subgoals.len()]; subgoals.len()];
    for (a, b) in graph.edges() {
        let [i, j] =
            [a, b].map(|end| subgoals.iter().position(|&at| at == end).expect("edges join subgoals"));
        lengths[i][j] = mediant_moves::distance(a.to(b), k);
        lengths[j][i] = lengths[i][j];
    }
    (subgoals, lengths)
}

#[test]
fn every_hierarchy_keeps_the_distances_of_the_edges() {
    let check = |seed: u64| {
        let (grid, gap) = (suite_grid(seed).0, GAPS[seed as usize % 2]);
        let number = FiniteK::new(2 + seed as u32 / 2 % 5).expect("k is at least 2");
        let space = space::<Corners>(&grid, gap);
        let (subgoals, lengths) = lengths(&grid, gap, number);
        let graphs = HIERARCHIES.map(|hierarchy| graph(&space, number.into(), hierarchy));
        let mut planners = graphs
            .each_ref()
            .map(|graph| SubgoalAStar::new(&space, graph).expect("the graph is for this space"));
        let mut count = 0;
        for (i, &start) in subgoals.iter().enumerate().step_by(1 + subgoals.len() / 8) {
            let costs = dijkstra(&lengths, i, |_| true);
            for (j, &goal) in subgoals.iter().enumerate().skip(i % 3).step_by(3) {
                for (planner, hierarchy) in planners.iter_mut().zip(HIERARCHIES) {
                    let answer = planner.solve(Ends::new(start, goal)).expect("both ends are free");
                    let cost = answer.path().map_or(f64::INFINITY, Path::cost);
                    assert!(
                        is_same(cost, costs[j]),
                        "{hierarchy:?}, k = {number}: {cost}, over the edges {}; {}",
                        costs[j],
                        describe(&grid, Rules::Corner(gap), start, goal, seed)
                    );
                }
                count += 1;
            }
        }
        count
    };
    let counts = on_all_cores(seeds(200), check);
    assert!(counts.iter().sum::<usize>() > 15 * counts.len(), "too few distances: {counts:?}");
}

/// Contracts a level of the reference graph: in order, each subgoal without which no distance between the
/// others grows, or only distances between subgoals that are h_k-reachable over it. `left` says which
/// subgoals are not contracted yet.
fn contract_level(subgoals: &[Vertex], lengths: &mut [Vec<f64>], left: &mut [bool], k: FiniteK) {
    for id in 0..subgoals.len() {
        let around: Vec<usize> =
            (0..subgoals.len()).filter(|&at| left[at] && lengths[id][at].is_finite()).collect();
        let mut needed = Vec::new();
        for (i, &p) in around.iter().enumerate() {
            let others = dijkstra(lengths, p, |at| at != id && left[at]);
            let is_longer = |&&q: &&usize| {
                let over = lengths[p][id] + lengths[id][q];
                over < others[q] && !is_same(over, others[q])
            };
            needed.extend(
                around[i + 1..].iter().filter(is_longer).map(|&q| (p, q, lengths[p][id] + lengths[id][q])),
            );
        }
        let is_reachable = |&(p, q, over): &(usize, usize, f64)| {
            is_same(over, mediant_moves::distance(subgoals[p].to(subgoals[q]), k))
        };
        if left[id] && needed.iter().all(is_reachable) {
            left[id] = false;
            for (p, q, over) in needed {
                lengths[p][q] = over;
                lengths[q][p] = over;
            }
        }
    }
}

#[test]
fn levels_leave_out_what_no_distance_needs() {
    let check = |seed: u64| {
        let (grid, gap) = (random_grid(seed).0, GAPS[seed as usize % 2]);
        let number = FiniteK::new(2 + seed as u32 / 2 % 5).expect("k is at least 2");
        let (subgoals, mut lengths) = lengths(&grid, gap, number);
        if subgoals.len() > 40 {
            return [0; 3];
        }
        let space = space::<Corners>(&grid, gap);
        let core = |hierarchy| graph(&space, number.into(), hierarchy).core();
        let mut left = vec![true; subgoals.len()];
        let mut cores = [0; 3];
        for (level, count) in (1..).zip(&mut cores) {
            *count = left.iter().filter(|left| **left).count();
            let case = || format!("level {level}, k = {number}, {gap:?}, seed {seed}");
            assert_eq!(core(levels(level)), *count, "{}", case());
            contract_level(&subgoals, &mut lengths, &mut left, number);
        }
        assert_eq!(core(levels(1000)), core(Hierarchy::AllLevels), "k = {number}, {gap:?}, seed {seed}");
        assert!(core(Hierarchy::AllLevels) <= cores[2]);
        cores
    };
    let cores = on_all_cores(seeds(200), check);
    let [first, second, third] = [0, 1, 2].map(|level| cores.iter().map(|cores| cores[level]).sum::<usize>());
    assert!(0 < third && third < second && second < first, "{first}, {second}, {third} subgoals");
}

/// Whether a shortest path at any angle that comes from `from` may bend at a convex corner: the obstacle must
/// lie beside its direction.
fn may_bend(grid: &Grid, from: Vertex, at: Vertex) -> bool {
    let d = from.to(at);
    let is_beside = |&(x, y): &(i32, i32)| d.x * x <= 0 && d.y * y >= 0 || d.x * x >= 0 && d.y * y <= 0;
    let is_blocked = |(x, y): (i32, i32)| grid.is_blocked(at.x + (x - 1) / 2, at.y + (y - 1) / 2);
    [(-1, -1), (1, -1), (-1, 1), (1, 1)].into_iter().filter(is_beside).any(is_blocked)
}

/// At any angle an edge is part of a taut path, and every such line from one corner to the next is an edge.
#[test]
fn edges_at_any_angle_are_tangents() {
    let mut count = [0; 2];
    for seed in seeds(200) {
        let (grid, gap) = (random_grid(seed).0, GAPS[seed as usize % 2]);
        let (space, visibility) = (space::<Corners>(&grid, gap), Visibility::new(&grid, gap));
        let edges: BTreeSet<_> = graph(&space, K::Any, levels(1)).edges().map(in_order).collect();
        let corners = visibility.corners();
        for (i, &a) in corners.iter().enumerate() {
            for &b in &corners[i + 1..] {
                let is_between = |&c: &Vertex| {
                    let (v, w) = (a.to(c), c.to(b));
                    c != a && c != b && v.det(w) == 0 && v.dot(w) > 0
                };
                let is_legal = segment_is_legal(&grid, Rules::Corner(gap), a, b);
                let is_tangent = is_legal && may_bend(&grid, a, b) && may_bend(&grid, b, a);
                // A tangent over a third corner is not needed, but allowed.
                let is_needed = is_tangent && !corners.iter().any(is_between);
                let case = || describe(&grid, Rules::Corner(gap), a, b, seed);
                let is_edge = edges.contains(&in_order((a, b)));
                assert!(is_edge || !is_needed, "missing: {}", case());
                assert!(!is_edge || is_tangent, "too much: {}", case());
                count[usize::from(is_needed)] += 1;
            }
        }
    }
    assert!(count.iter().all(|&count| count > 1000), "{count:?} pairs that need no edge, and that need one");
}
