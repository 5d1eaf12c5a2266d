//! The visibility sweep against line of sight to every corner of an obstacle.

use std::sync::Arc;

use mediant_grid::{
    Corners, DiagonalGap, FreeSpace, Grid, Rules, Vertex,
    sight::{Quadrants, RowSummary, Targets, VisibilitySweep},
};
use mediant_oracle::{Rng, describe, noise, random_free_vertex, rooms, seeds, suite_grid};

/// Wide rooms with few obstacles, which a sweep crosses eight rows at a time, among the maps of the other
/// suites.
fn draw(seed: u64) -> Grid {
    let mut rng = Rng::new(seed);
    let mut side = || 10 + rng.below(90);
    let (width, height) = (side(), side());
    match seed % 4 {
        0 => suite_grid(seed).0,
        1 => rooms(&mut rng, width, height),
        2 => {
            let percent = rng.below(4);
            noise(&mut rng, width, height, percent)
        }
        _ => {
            let mut draw = |most: u32| rng.below(most) as i32;
            let blocks: Vec<_> =
                (0..1 + draw(12)).map(|_| (draw(width), draw(height), 1 + draw(20), 1 + draw(20))).collect();
            let blocked = |x: i32, y: i32| {
                blocks.iter().any(|&(a, b, w, h)| (a..a + w).contains(&x) && (b..b + h).contains(&y))
            };
            Grid::from_fn(width, height, |x, y| blocked(x as i32, y as i32)).expect("a small map")
        }
    }
}

/// Whether obstacles have a corner here: one cell around is blocked, or two that meet diagonally.
fn is_corner(grid: &Grid, at: Vertex) -> bool {
    let cells = [(-1, -1), (0, -1), (-1, 0), (0, 0)];
    let blocked = cells.iter().filter(|(dx, dy)| grid.is_blocked(at.x + dx, at.y + dy)).count();
    blocked == 1 || grid.is_gap(at)
}

/// Looks from some vertices. Returns the number of targets, and of those that are seen and found.
fn check(space: &FreeSpace<Corners>, seed: u64, rng: &mut Rng) -> [u64; 2] {
    let grid = space.grid();
    let summary = RowSummary::new(grid);
    let is_target = |at| is_corner(grid, at) && !space.is_closed_gap(at);
    let every = rng.below(3);
    let [same, opposite] = [0, 1].map(|_| space.vertex_set(|at| is_target(at) && rng.below(3) >= every));
    let rules = Rules::Corner(space.rule());
    let mut sweep = VisibilitySweep::default();
    let mut counts = [0, 0];
    for _ in 0..12 {
        let Some(from) = random_free_vertex(rng, grid, rules.placement()) else { break };
        let pick = [(1, 1), (1, -1), (-1, 1), (-1, -1)].into_iter().filter(|_| rng.below(4) > 0);
        let chosen: Vec<_> = pick.collect();
        let Some(quadrants) = chosen.iter().map(|&(x, y)| Quadrants::only(x, y)).reduce(Quadrants::union)
        else {
            continue;
        };
        if space.is_closed_gap(from) {
            continue;
        }
        let mut found = Vec::new();
        let targets = Targets { same: &same, opposite: &opposite };
        sweep.seen(space, &summary, targets, from, quadrants, |at| found.push(at));
        found.sort_by_key(|at| (at.y, at.x));
        let case = |at| describe(grid, rules, from, at, seed);
        assert!(found.windows(2).all(|two| two[0] != two[1]), "reported twice: {}", case(from));
        for y in 0..=grid.height() as i32 {
            for at in (0..=grid.width() as i32).map(|x| Vertex::new(x, y)) {
                let d = from.to(at);
                let is_marked = match d.x.signum() * d.y.signum() {
                    1 => same.get(at.x, at.y),
                    -1 => opposite.get(at.x, at.y),
                    _ => same.get(at.x, at.y) || opposite.get(at.x, at.y),
                };
                let is_asked = chosen.iter().any(|&(x, y)| d.x * x >= 0 && d.y * y >= 0);
                if !is_marked || !is_asked || at == from {
                    assert!(!found.contains(&at), "{at} is no target: {}", case(at));
                    continue;
                }
                let steps = d.gcd() as i32;
                let on_ray = |i| from + mediant_grid::Vector::new(d.x / steps * i, d.y / steps * i);
                let is_behind = (1..steps).any(|i| is_corner(grid, on_ray(i)));
                let (is_seen, is_found) = (space.sees(from, at), found.contains(&at));
                assert!(is_seen || !is_found, "{at} is not seen: {}", case(at));
                // Along the border of the given quadrants, only the cells on the inner side count.
                let is_border = d.x == 0 && chosen.iter().filter(|(_, y)| y * d.y > 0).count() < 2;
                assert!(is_found || !is_seen || is_behind || is_border, "{at} is not found: {}", case(at));
                counts[0] += 1;
                counts[1] += u64::from(is_found);
            }
        }
    }
    counts
}

#[test]
fn a_fan_finds_what_is_in_sight() {
    let mut counts = [0, 0];
    for seed in seeds(300) {
        let grid = Arc::new(draw(seed));
        for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
            let space = FreeSpace::<Corners>::new(Arc::clone(&grid), gap);
            let [targets, found] = check(&space, seed, &mut Rng::new(seed));
            counts[0] += targets;
            counts[1] += found;
        }
    }
    assert!(counts[0] > 400_000 && counts[1] > 40_000, "{counts:?}");
}

/// Compares the runs from some vertices with the lines of sight to all. Returns the number of vertices in
/// runs, and of those that are seen.
fn check_runs(space: &FreeSpace<Corners>, seed: u64, rng: &mut Rng) -> [u64; 2] {
    let grid = space.grid();
    let summary = RowSummary::new(grid);
    let marks = space.vertex_set(|at| is_corner(grid, at) && !space.is_closed_gap(at));
    let rules = Rules::Corner(space.rule());
    let (mut sweep, mut counts) = (VisibilitySweep::default(), [0, 0]);
    for _ in 0..8 {
        let Some(from) = random_free_vertex(rng, grid, rules.placement()) else { break };
        let (x, y) = [(1, 1), (1, -1), (-1, 1), (-1, -1)][rng.below(4) as usize];
        let quadrants = if rng.chance(30) { Quadrants::ALL } else { Quadrants::only(x, y) };
        if space.is_closed_gap(from) {
            continue;
        }
        let mut found = Vec::new();
        sweep.runs(space, &summary, &marks, from, quadrants, |line, first, last| {
            assert!(first <= last, "an empty run: {}", describe(grid, rules, from, from, seed));
            found.extend((first..=last).map(|x| Vertex::new(x, line)));
        });
        found.sort();
        found.dedup();
        assert!(!found.contains(&from), "it sees itself: {}", describe(grid, rules, from, from, seed));
        for line in 0..=grid.height() as i32 {
            for at in (0..=grid.width() as i32).map(|x| Vertex::new(x, line)).filter(|&at| at != from) {
                let d = from.to(at);
                let steps = d.gcd() as i32;
                let on_ray = |i| from + mediant_grid::Vector::new(d.x / steps * i, d.y / steps * i);
                let case = || describe(grid, rules, from, at, seed);
                let is_found = found.binary_search(&at).is_ok();
                // The last vertex of a run may be a gap that cannot be entered from here.
                let is_seen = space.is_free(at) && space.sees(from, at);
                assert!(is_seen || !is_found || space.is_closed_gap(at), "{at} is not seen: {}", case());
                let is_asked = quadrants == Quadrants::ALL || d.x * x >= 0 && d.y * y >= 0;
                assert!(is_asked || !is_found, "{at} is in another quadrant: {}", case());
                // Along the border of a quadrant the cells on its inner side count alone, and behind a corner
                // on the ray another one may be the end.
                let is_behind = (1..steps).any(|i| is_corner(grid, on_ray(i)));
                let is_border = d.x == 0 && quadrants != Quadrants::ALL;
                let may_be_missed = is_behind || is_border || space.is_closed_gap(at);
                assert!(is_found || !is_seen || !is_asked || may_be_missed, "{at} is not found: {}", case());
                counts[0] += u64::from(is_found);
                counts[1] += u64::from(is_seen);
            }
        }
    }
    counts
}

#[test]
fn runs_hold_what_is_in_sight() {
    let mut counts = [0, 0];
    for seed in seeds(60) {
        let grid = Arc::new(draw(seed));
        for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
            let space = FreeSpace::<Corners>::new(Arc::clone(&grid), gap);
            let [found, seen] = check_runs(&space, seed, &mut Rng::new(seed));
            counts[0] += found;
            counts[1] += seen;
        }
    }
    assert!(counts[0] > 80_000 && counts[1] > counts[0], "{counts:?}");
}
