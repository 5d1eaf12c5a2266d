//! Which disc is the largest: for which a cell is free, and for which there is a path.

use std::{convert::Infallible, sync::Arc};

use mediant_grid::{
    Centers, Clearance, CornerRule, Corners, DiagonalGap, Fit, FreeSpace, Grid, Outside, Placement, Rules,
    Vertex,
};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Explicit, Rng, random_free_vertex, seeds, suite_grid};

use crate::clearance::{KINDS, draw};

#[test]
fn a_cell_is_free_up_to_its_largest_disc_and_no_further() {
    for seed in seeds(60) {
        let (grid, kind) = suite_grid(seed);
        let shared = Arc::new(grid.clone());
        for (fit, outside) in KINDS {
            let clearance = Clearance::new(Arc::clone(&shared), fit, outside);
            let cells =
                || (0..grid.height() as i32).flat_map(|y| (0..grid.width() as i32).map(move |x| (x, y)));
            let largest: Vec<_> = cells().map(|cell| clearance.largest_disc(cell.into())).collect();
            let mut expected: Vec<f64> = largest.iter().flatten().copied().collect();
            expected.sort_by(f64::total_cmp);
            expected.dedup();
            assert_eq!(clearance.radii(), expected, "{fit:?}, {outside:?}, {kind}, seed {seed}");
            for level in expected.into_iter().filter(|level| level.is_finite()) {
                for radius in [level, level.next_up()] {
                    let map = clearance.for_disc(radius).expect("a radius");
                    for ((x, y), largest) in cells().zip(&largest) {
                        let free = largest.is_some_and(|largest| largest >= radius);
                        assert_eq!(
                            map.is_free(x, y),
                            free,
                            "{fit:?}, {outside:?}, ({x}, {y}) at {radius}, seed {seed}"
                        );
                    }
                }
            }
            for outside in [(-1, 0), (0, grid.height() as i32), (i32::MIN, i32::MAX)] {
                assert_eq!(clearance.largest_disc(outside.into()), None);
            }
        }
    }
}

#[test]
fn a_vertex_has_the_largest_disc_of_its_cells() {
    for seed in seeds(60) {
        let (grid, _) = suite_grid(seed);
        let clearance = Clearance::new(Arc::new(grid.clone()), Fit::Centers, Outside::Open);
        for at in
            (0..=grid.height() as i32).flat_map(|y| (0..=grid.width() as i32).map(move |x| Vertex::new(x, y)))
        {
            fn check<P: Placement>(clearance: &Clearance, grid: &Grid, at: Vertex) {
                let largest = clearance.largest_disc_at(P::KIND, at);
                assert_eq!(largest.is_some(), P::is_free(grid, at));
                if let Some(radius) = largest.filter(|radius| radius.is_finite()) {
                    let free = |radius| P::is_free(&clearance.for_disc(radius).expect("a radius"), at);
                    assert!(free(radius) && !free(radius.next_up()), "{at}, {radius}");
                }
            }
            check::<Centers>(&clearance, &grid, at);
            check::<Corners>(&clearance, &grid, at);
        }
    }
}

/// Whether an end's own cell matters: the one case that is excepted.
fn is_excepted(rules: Rules, map: &Grid, ends: [Vertex; 2]) -> bool {
    rules == Rules::Corner(DiagonalGap::Closed) && ends.iter().any(|end| map.is_blocked(end.x, end.y))
}

#[test]
fn the_widest_path_is_that_of_trying_all_discs() {
    let mut wider = 0;
    for seed in seeds(60) {
        let (grid, kind) = suite_grid(seed);
        let (shared, mut rng) = (Arc::new(grid.clone()), Rng::new(seed));
        for (fit, outside) in KINDS {
            let rules = *rng.pick(&Rules::ALL).expect("rules");
            let k = *rng.pick(&[FiniteK::N4, FiniteK::N8, FiniteK::N16]).expect("a k");
            let clearance = Clearance::new(Arc::clone(&shared), fit, outside);
            let mut end = || random_free_vertex(&mut rng, &grid, rules.placement());
            let (Some(start), Some(goal)) = (end(), end()) else { continue };
            let cost = |map: &Grid| Explicit::new(map, rules, Some(k)).costs_from(start).to(goal);
            let free = |map: &Grid| {
                [start, goal].iter().all(|&at| mediant_oracle::vertex_is_free(map, rules.placement(), at))
            };
            let surplus = [1.0, 1.1, 1.5, 1e9][rng.below(4) as usize];
            let limit = cost(&grid).map_or(0.0, |cost| surplus * cost + 1e-9);
            let short = |map: &Grid| free(map).then(|| cost(map)).flatten().filter(|&cost| cost <= limit);

            // All discs, one after another.
            let maps = clearance.radii().into_iter().map(|radius| {
                let map = if radius.is_finite() {
                    clearance.for_disc(radius).expect("a radius")
                } else {
                    grid.clone()
                };
                (radius, map)
            });
            let expected = maps.rev().find_map(|(radius, map)| Some((radius, short(&map)?, map)));

            let mut searches = 0;
            let at_most =
                [start, goal].map(|at| clearance.largest_disc_at(rules.placement(), at).expect("free"));
            let found = clearance.widest(at_most[0].min(at_most[1]), |map| {
                searches += 1;
                Ok::<_, Infallible>(short(map))
            });
            let found = found.expect("no error");
            let radii = clearance.radii().len();
            assert!(searches <= radii.max(1).ilog2() + 2, "{searches} searches of {radii}");
            let context = || {
                format!(
                    "{fit:?}, {outside:?}, {rules}, {start} to {goal}, {kind}, seed {seed}:\n{}",
                    draw(&grid)
                )
            };
            match (found, expected) {
                (None, None) => {}
                (Some(found), Some((radius, cost, map))) => {
                    if !is_excepted(rules, &map, [start, goal]) {
                        assert_eq!((found.radius, found.found), (radius, cost), "{}", context());
                        assert_eq!(*found.map, map);
                    }
                    wider += u32::from(radius > 0.5);
                }
                (found, expected) => {
                    let map = expected.as_ref().map(|(.., map)| map);
                    assert!(
                        map.is_some_and(|map| is_excepted(rules, map, [start, goal])),
                        "{found:?}; {}",
                        context()
                    );
                }
            }
        }
    }
    assert!(wider > 20, "{wider}");
}

#[test]
fn the_bottleneck_is_the_largest_disc_whose_map_connects() {
    fn check<P: Placement>(clearance: &Clearance, rule: P::Rule, k: K, seed: u64) {
        let mut rng = Rng::new(seed);
        let grid = clearance.grid();
        let mut end = || random_free_vertex(&mut rng, grid, P::KIND);
        let (Some(a), Some(b)) = (end(), end()) else { return };
        let connects = |map: &Grid| FreeSpace::<P>::for_k(Arc::new(map.clone()), rule, k).connected(a, b);
        let mut maps = clearance.radii().into_iter().map(|radius| {
            let map = if radius.is_finite() {
                clearance.for_disc(radius).expect("a radius")
            } else {
                (**grid).clone()
            };
            (radius, map)
        });
        let expected = maps.rfind(|(_, map)| connects(map));
        if expected.as_ref().is_none_or(|(_, map)| !is_excepted(P::rules(rule), map, [a, b])) {
            let found = clearance.bottleneck::<P>(rule, k, a, b);
            assert_eq!(
                found,
                expected.map(|(radius, _)| radius),
                "{a} to {b}, {:?}, seed {seed}",
                P::rules(rule)
            );
        }
    }
    for seed in seeds(60) {
        let grid = Arc::new(suite_grid(seed).0);
        for (fit, outside) in KINDS {
            let clearance = Clearance::new(Arc::clone(&grid), fit, outside);
            check::<Centers>(&clearance, CornerRule::Never, K::N8, seed);
            check::<Centers>(&clearance, CornerRule::Always, K::N8, seed);
            check::<Corners>(&clearance, DiagonalGap::Open, K::ANY, seed);
            check::<Corners>(&clearance, DiagonalGap::Closed, K::N8, seed);
        }
    }
}

#[test]
fn an_error_of_the_search_is_passed_on() {
    let grid = Arc::new(Grid::from_fn(9, 9, |_, _| false).expect("a map"));
    let clearance = Clearance::new(grid, Fit::Centers, Outside::Blocked);
    let mut left = 2;
    let found = clearance.widest(f64::INFINITY, |_| {
        left -= 1;
        if left == 0 { Err("stopped") } else { Ok(Some(())) }
    });
    assert_eq!(found.err(), Some("stopped"));
}
