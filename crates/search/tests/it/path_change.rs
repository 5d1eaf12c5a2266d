//! The effect of changes on shortest paths, against the oracle.

use std::sync::Arc;

use mediant_grid::{Centers, Change, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, Placement};
use mediant_moves::FiniteK;
use mediant_oracle::{Explicit, Rng, random_change, random_free_vertex, random_grid, seeds};
use mediant_search::Path;

/// Of one map and change: how many shortest paths broke, became longer than a new one, and stayed shortest
/// beside freed cells.
fn check_change<P: Placement>(seed: u64, rule: P::Rule, told: &mut [usize; 3]) {
    let (grid, mut rng) = (Arc::new(random_grid(seed).0), Rng::new(seed));
    let space = FreeSpace::<P>::new(Arc::clone(&grid), rule);
    let change = random_change(&mut rng, &grid);
    let after = space.after(&change);
    let rules = space.rules();
    for k in [Some(FiniteK::N4), Some(FiniteK::N8), Some(FiniteK::N16), None] {
        let Some(start) = random_free_vertex(&mut rng, &grid, rules.placement()) else { return };
        let Some(goal) = random_free_vertex(&mut rng, &grid, rules.placement()) else { return };
        let waypoints = Explicit::new(&grid, rules, k).costs_from(start).path_to(goal);
        let new = Explicit::new(change.after(), rules, k);
        let cost = if after.is_free(start) { new.costs_from(start).to(goal) } else { None };
        let Some(path) = waypoints.map(Path::new) else { continue };
        let message = format!("seed {seed}, {rules}, {:?}: {path}", change.cells());
        if path.check(&space).is_err() {
            continue;
        }
        let holds = path.check(&after);
        assert_eq!(path.check_after(&after, &change), holds, "{message}");
        let least = path.least_by_freed::<P>(&change);
        match cost {
            Some(cost) if cost < path.cost() - 1e-9 => {
                assert!(cost >= least - 1e-9, "{message}: {cost} is less than {least}");
                told[1] += 1;
            }
            _ if holds.is_err() => told[0] += 1,
            _ => told[2] += usize::from(least.is_finite()),
        }
    }
}

#[test]
fn changes_do_to_paths_what_a_new_search_finds() {
    let mut told = [0; 3];
    for seed in seeds(100) {
        for rule in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
            check_change::<Centers>(seed, rule, &mut told);
        }
        for rule in [DiagonalGap::Open, DiagonalGap::Closed] {
            check_change::<Corners>(seed, rule, &mut told);
        }
    }
    assert!(told.iter().all(|&count| count > 40), "{told:?}");
}

/// From (0, 0) to (10, 0) beside a freed cell, whose square begins 4.5 cells along and 2.5 below.
#[test]
fn what_is_freed_is_as_far_as_its_square() {
    let map = Arc::new(Grid::from_fn(11, 5, |_, y| y == 3).expect("a map"));
    let path = Path::new(vec![(0, 0).into(), (10, 0).into()]);
    let least = |cells: &[(u32, u32, bool)]| {
        path.least_by_freed::<Centers>(&Change::new(Arc::clone(&map)).edit_cells(cells.iter().copied()))
    };
    assert!((least(&[(5, 3, false)]) - 2.0 * 4.5_f64.hypot(2.5)).abs() < 1e-12);
    assert!((least(&[(2, 3, false)]) - 1.5_f64.hypot(2.5) - 7.5_f64.hypot(2.5)).abs() < 1e-12);
    assert_eq!(least(&[(5, 2, true)]), f64::INFINITY);
}
