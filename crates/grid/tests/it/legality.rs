//! Legal moves, lines of sight and components against brute force, on seeded random maps.

use std::sync::Arc;

use mediant_grid::{
    Centers, Components, Connectivity, CornerRule, Corners, Grid, GridGraph, Placement, Rules, Vector,
    Vertex, sight::line_of_sight_under,
};
use mediant_moves::{FiniteK, Neighborhood};
use mediant_oracle::{Explicit, segment_is_legal, suite_grid, vertex_is_free};

fn seeds() -> std::ops::Range<u64> {
    mediant_oracle::seeds(60)
}

fn is_wide(grid: &Grid) -> bool {
    grid.width().max(grid.height()) >= 60
}

fn vertices(grid: &Grid) -> impl Iterator<Item = Vertex> + use<> {
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    (-1..=height + 1).flat_map(move |y| (-1..=width + 1).map(move |x| Vertex::new(x, y)))
}

fn describe(grid: &Grid, rules: Rules, from: Vertex, to: Vertex, seed: u64) -> String {
    mediant_oracle::describe(grid, rules, from, to, seed)
}

fn check_moves<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, k: FiniteK, seed: u64) -> usize {
    let graph = GridGraph::<P>::new(Arc::clone(grid), k, rule).expect("k is in range");
    let moves: Vec<Vector> = Neighborhood::new(k).expect("k is in range").iter().collect();
    let mut legal = 0;
    for at in vertices(grid) {
        let set = graph.legal_moves(at);
        assert_eq!(set.iter().count(), set.len());
        for (index, &v) in moves.iter().enumerate() {
            let expected = segment_is_legal(grid, graph.rules(), at, at + v);
            let message =
                || format!("k = {k}, move {v:?}: {}", describe(grid, graph.rules(), at, at + v, seed));
            assert_eq!(set.contains(index), expected, "legal_moves, {}", message());
            assert_eq!(graph.is_legal(at, v), expected, "is_legal, {}", message());
            assert_eq!(graph.step(index).vector(), v);
            legal += usize::from(expected);
        }
    }
    legal
}

#[test]
fn legal_moves_are_those_of_brute_force() {
    let mut legal = 0;
    for seed in seeds() {
        let grid = Arc::new(suite_grid(seed).0);
        // The moves of N(k) are among those of N(k + 1): few k suffice, and the large ones cost brute force
        // dearly.
        let ks: &[u32] = match () {
            () if is_wide(&grid) => &[3, 5],
            () if seed % 8 == 0 => &[2, 3, 8],
            () => &[2, 3, 4, 6],
        };
        for k in ks.iter().map(|&k| FiniteK::new(k).expect("k is at least 2")) {
            for rules in Rules::ALL {
                legal += match rules {
                    Rules::Center(corners) => check_moves::<Centers>(&grid, corners, k, seed),
                    Rules::Corner(gap) | Rules::CenterGap(gap) => check_moves::<Corners>(&grid, gap, k, seed),
                };
            }
        }
    }
    assert!(legal > 100_000, "only {legal} legal moves were seen");
}

/// A few blocked cells on a map wider than a word both ways, each second one with a diagonal neighbor:
/// corners to cut, gaps to slip through.
fn sparse_grid(seed: u64) -> Grid {
    let (width, height) = (150, 140);
    let mut rng = mediant_oracle::Rng::new(seed);
    let mut blocked = std::collections::HashSet::new();
    for _ in 0..60 {
        let (x, y) = (rng.below(width - 1), 1 + rng.below(height - 2));
        blocked.insert((x, y));
        if rng.chance(50) {
            blocked.insert(if rng.chance(50) { (x + 1, y + 1) } else { (x + 1, y - 1) });
        }
    }
    Grid::from_fn(width, height, |x, y| blocked.contains(&(x, y))).expect("a valid size")
}

/// The number of legal moves among those of N(k) at a few vertices.
fn check_long_moves<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, k: FiniteK, seed: u64) -> usize {
    let graph = GridGraph::<P>::new(Arc::clone(grid), k, rule).expect("k is in range");
    let rules = graph.rules();
    let mut legal = 0;
    for at in [(0, 0), (75, 70), (149, 139), (3, 120), (140, 2)].map(Vertex::from) {
        let set = graph.legal_moves(at);
        for (index, v) in Neighborhood::new(k).expect("k is in range").iter().enumerate() {
            let case = || format!("seed {seed}, k {k}, {rules}, {v:?} at {at}");
            let expected = line_of_sight_under(grid, rules, at, at + v);
            assert_eq!(set.contains(index), expected, "{}", case());
            // Each move in one of the seeds and at one of the vertices at least.
            if (index as u64 + seed + at.x as u64).is_multiple_of(17) {
                assert_eq!(expected, segment_is_legal(grid, rules, at, at + v), "{}", case());
            }
        }
        legal += set.len();
    }
    legal
}

#[test]
fn long_moves_of_large_k_are_legal_as_brute_force_says() {
    let mut legal = Rules::ALL.map(|_| 0);
    for seed in 0..3 {
        let grid = Arc::new(sparse_grid(seed));
        for k in [10, 12].map(|k| FiniteK::new(k).expect("k is at least 2")) {
            for (rules, legal) in Rules::ALL.into_iter().zip(&mut legal) {
                *legal += match rules {
                    Rules::Center(corners) => check_long_moves::<Centers>(&grid, corners, k, seed),
                    Rules::Corner(gap) | Rules::CenterGap(gap) => {
                        check_long_moves::<Corners>(&grid, gap, k, seed)
                    }
                };
            }
        }
    }
    // The rules of centers differ on these maps. The gap rules cannot: no move has a vertex between its ends.
    let [never, one, always, open, closed] = legal;
    assert!(never < one && one < always && open == closed && open > 10_000, "{legal:?}");
}

/// Each move of N(12) that passes through a corner point, at its middle, past one or two blocked cells there.
#[test]
fn the_corner_rules_hold_in_the_middle_of_long_moves() {
    let k = FiniteK::new(12).expect("k is at least 2");
    // The corner point is (100, 100). A falling move touches the cells to its upper right and lower left, a
    // rising one the others.
    for (falling, cells) in [(true, [(100, 99), (99, 100)]), (false, [(99, 99), (100, 100)])] {
        for blocked in [&cells[..1], &cells[1..], &cells[..]] {
            let grid = Grid::from_fn(200, 200, |x, y| blocked.contains(&(x, y))).expect("a valid size");
            let grid = Arc::new(grid);
            for rule in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
                let graph = GridGraph::<Centers>::new(Arc::clone(&grid), k, rule).expect("k is in range");
                let expected = match rule {
                    CornerRule::Never => false,
                    CornerRule::One => blocked.len() == 1,
                    CornerRule::Always => true,
                };
                let mut moves = 0;
                for (index, v) in graph.steps().iter().map(|step| step.vector()).enumerate() {
                    if v.x % 2 != 0 && v.y % 2 != 0 && ((v.x > 0) == (v.y > 0)) == falling {
                        let at = Vertex::new((199 - v.x) / 2, (199 - v.y) / 2);
                        let found = graph.legal_moves(at).contains(index);
                        assert_eq!(found, expected, "{rule:?}, {v:?} past {blocked:?}");
                        moves += 1;
                    }
                }
                assert!(moves > 600, "only {moves} moves");
            }
        }
    }
}

#[test]
fn line_of_sight_is_that_of_brute_force() {
    let mut seen = [0, 0];
    for seed in seeds() {
        let grid = suite_grid(seed).0;
        let all: Vec<Vertex> = vertices(&grid).collect();
        // Every vertex with a seventh of the others, shifted so that all pairs come up over the seeds; fewer
        // on wide maps.
        let step = if is_wide(&grid) { 61 } else { 7 };
        for rules in Rules::ALL {
            for (i, &from) in all.iter().enumerate() {
                for &to in all.iter().skip((i + seed as usize) % step).step_by(step) {
                    let expected = segment_is_legal(&grid, rules, from, to);
                    let found = line_of_sight_under(&grid, rules, from, to);
                    assert_eq!(found, expected, "{}", describe(&grid, rules, from, to, seed));
                    assert_eq!(found, line_of_sight_under(&grid, rules, to, from), "not symmetric");
                    seen[usize::from(found)] += 1;
                }
            }
        }
    }
    assert!(seen.iter().all(|&count| count > 20_000), "too few cases: {seen:?}");
}

#[test]
fn components_tell_whether_there_is_any_path() {
    let mut told = [0, 0];
    for seed in seeds() {
        let grid = Arc::new(suite_grid(seed).0);
        for rules in Rules::ALL {
            for k in [2, 3, 5].map(|k| FiniteK::new(k).expect("k is at least 2")) {
                let connected: Box<dyn Fn(Vertex, Vertex) -> bool> = match rules {
                    Rules::Center(corners) => {
                        let graph =
                            GridGraph::<Centers>::new(Arc::clone(&grid), k, corners).expect("k is in range");
                        Box::new(move |a, b| graph.connected(a, b))
                    }
                    Rules::Corner(gap) | Rules::CenterGap(gap) => {
                        let graph =
                            GridGraph::<Corners>::new(Arc::clone(&grid), k, gap).expect("k is in range");
                        Box::new(move |a, b| graph.connected(a, b))
                    }
                };
                let graph = Explicit::new(&grid, rules, Some(k));
                let step = (grid.width() * grid.height() / 40 + 1) as usize;
                for start in graph.free_vertices().step_by(step) {
                    let costs = graph.costs_from(start);
                    for goal in vertices(&grid) {
                        let expected = costs.to(goal).is_some();
                        let message = || format!("k = {k}: {}", describe(&grid, rules, start, goal, seed));
                        assert_eq!(connected(start, goal), expected, "{}", message());
                        told[usize::from(expected)] += 1;
                    }
                }
            }
        }
    }
    assert!(told.iter().all(|&count| count > 20_000), "too few cases: {told:?}");
}

/// The components by flooding, numbered row by row.
pub(crate) fn flood(grid: &Grid, connectivity: Connectivity) -> std::collections::HashMap<Vertex, u32> {
    let mut labels = std::collections::HashMap::new();
    let mut count = 0;
    let is_free = |at: Vertex| grid.is_free(at.x, at.y);
    for first in vertices(grid).filter(|&at| is_free(at)) {
        if labels.contains_key(&first) {
            continue;
        }
        let mut open = vec![first];
        while let Some(at) = open.pop() {
            if labels.insert(at, count).is_some() {
                continue;
            }
            let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| Vector::new(dx, dy)));
            let near = around.filter(|d| connectivity == Connectivity::Eight || d.x == 0 || d.y == 0);
            open.extend(near.map(|d| at + d).filter(|&at| is_free(at) && !labels.contains_key(&at)));
        }
        count += 1;
    }
    labels
}

/// Free cells apart from each other: as many runs as a word has room for.
#[test]
fn components_are_numbered_however_many_there_are() {
    for (columns, rows) in [(255, 1), (256, 1), (257, 1), (255, 257), (256, 256), (257, 256)] {
        let grid =
            Grid::from_fn(2 * columns, 2 * rows, |x, y| x % 2 == 1 || y % 2 == 1).expect("a valid size");
        let components = Components::new(&Arc::new(grid), Connectivity::Four);
        assert_eq!(components.count(), columns * rows);
        let mut numbers = std::collections::HashSet::new();
        for (x, y) in (0..2 * rows).flat_map(|y| (0..2 * columns).map(move |x| (x, y))) {
            let found = components.of(Vertex::new(x as i32, y as i32));
            let is_free = x % 2 == 0 && y % 2 == 0;
            assert_eq!(found.is_some(), is_free, "{columns} × {rows}, ({x}, {y})");
            numbers.extend(found);
        }
        assert_eq!(numbers.len() as u32, columns * rows);
    }
}

/// Runs of free cells that end at, begin at and go over the boundaries of words.
#[test]
fn components_of_wide_maps_are_those_of_flooding() {
    for seed in 0..60 {
        let mut rng = mediant_oracle::Rng::new(seed);
        let (width, height, percent) = (62 + rng.below(140), 1 + rng.below(4), 10 + rng.below(50));
        let grid = Arc::new(mediant_oracle::noise(&mut rng, width, height, percent));
        for connectivity in [Connectivity::Four, Connectivity::Eight] {
            let (components, labels) = (Components::new(&grid, connectivity), flood(&grid, connectivity));
            same_partition(&components, &labels, &format!("seed {seed}, {connectivity:?}"));
        }
    }
}

/// Checks that two cells have the same number by one exactly if they have by the other.
pub(crate) fn same_partition(
    components: &Components,
    labels: &std::collections::HashMap<Vertex, u32>,
    message: &str,
) {
    let mut number_of = std::collections::HashMap::new();
    for (&at, &label) in labels {
        let found = components.of(at);
        assert!(found.is_some(), "{message}, cell {at}");
        assert_eq!(*number_of.entry(label).or_insert(found), found, "{message}, cell {at}");
    }
    let numbers: std::collections::HashSet<_> = number_of.values().collect();
    assert_eq!(numbers.len(), number_of.len(), "{message}: components are joined that are not");
    assert_eq!(components.count() as usize, number_of.len(), "{message}");
}

#[test]
fn free_vertices_are_those_of_brute_force_however_far_outside() {
    for seed in seeds() {
        let grid = suite_grid(seed).0;
        let far =
            [i32::MIN, -1, 0, 1, i32::MAX].map(|x| [i32::MIN, -1, 0, 1, i32::MAX].map(|y| Vertex::new(x, y)));
        for at in vertices(&grid).chain(far.into_iter().flatten()) {
            let inner = at.x.abs_diff(0) < 1000 && at.y.abs_diff(0) < 1000;
            for rules in Rules::ALL {
                let free = match rules {
                    Rules::Center(_) => Centers::is_free(&grid, at),
                    Rules::Corner(_) | Rules::CenterGap(_) => Corners::is_free(&grid, at),
                };
                assert_eq!(free, inner && vertex_is_free(&grid, rules.placement(), at), "{at} under {rules}");
                assert!(!line_of_sight_under(&grid, rules, at, Vertex::new(i32::MAX, i32::MIN)));
            }
        }
    }
}
