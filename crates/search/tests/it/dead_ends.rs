//! Dead ends that follow edits of the map: searches without them find paths that cost the same.

use std::sync::Arc;

use mediant_grid::{
    Change, Corners, DiagonalGap, FreeSpace, Grid, PlacementKind, Rectangle, Rules, uninterrupted,
};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Rng, caves, describe, maze, noise, random_free_vertex, rooms, seeds, validate};
use mediant_search::{Anya, DeadEnds, Ends, Norm, Planner};

type Space = Arc<FreeSpace<Corners>>;

fn grid(rng: &mut Rng) -> Grid {
    let (width, height) = (4 + rng.below(36), 4 + rng.below(36));
    match rng.below(6) {
        0 => maze(rng, width, height),
        1 => caves(rng, width, height),
        2 => noise(rng, width, height, 20),
        3 => noise(rng, width, height, 35),
        _ => rooms(rng, width, height),
    }
}

/// A few cells by chance, a rectangle, or the last cell again, as a door that closes and opens.
fn edited(grid: &Arc<Grid>, rng: &mut Rng, door: &mut (u32, u32)) -> Change {
    let flip = |change: Change, (x, y): (u32, u32)| {
        let is_blocked = change.after().is_blocked(x as i32, y as i32);
        change.edit_cells([(x, y, !is_blocked)])
    };
    let mut cell = || (rng.below(grid.width()), rng.below(grid.height()));
    let (at, other, change) = (cell(), cell(), Change::new(Arc::clone(grid)));
    match rng.below(6) {
        0 | 1 => flip(change, *door),
        2 => flip(flip(change, at), other),
        3 => {
            let at = Rectangle { x: at.0, y: at.1, width: 1 + rng.below(6), height: 1 + rng.below(6) };
            let percent = [0, 50, 100][rng.below(3) as usize];
            change.edit(at, |_, _| rng.below(100) < percent)
        }
        _ => {
            *door = at;
            flip(change, at)
        }
    }
}

/// Compares the costs of paths, and checks that those without dead ends are legal.
fn compare<N: Norm>(
    with: &mut Anya<Space, N>,
    without: &mut Anya<Space, N>,
    (space, queries): (&Space, &[Ends]),
    seed: u64,
) {
    let (grid, rules) = (space.grid(), space.identity().rules);
    let k = without.identity().k.and_then(K::finite);
    for &query in queries {
        let case = || format!("k = {k:?}; {}", describe(grid, rules, query.start, query.goal, seed));
        let [with, without] =
            [&mut *with, &mut *without].map(|anya| anya.solve(query).expect("both ends are free"));
        let [best, cost] = [&with, &without].map(|answer| answer.path().map(|path| path.cost()));
        let is_same = match (best, cost) {
            (Some(best), Some(cost)) => (cost - best).abs() <= 1e-9 * best,
            (best, cost) => best == cost,
        };
        assert!(is_same, "best {best:?}, found {cost:?}; {}", case());
        if let Some(path) = without.path() {
            let fault = validate(grid, rules, k, query.start, query.goal, path.waypoints(), path.cost());
            assert_eq!(fault, Ok(()), "{}", case());
        }
    }
}

#[test]
fn searches_without_repaired_dead_ends_lose_no_path() {
    for seed in seeds(24) {
        let rng = &mut Rng::new(seed ^ 0xED17);
        let (mut grid, mut door) = (Arc::new(grid(rng)), (0, 0));
        for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
            let mut space = Arc::new(FreeSpace::<Corners>::new(Arc::clone(&grid), gap));
            let mut dead_ends = Arc::new(DeadEnds::new(&space));
            let mut any = Anya::new(Arc::clone(&space)).without(Arc::clone(&dead_ends)).expect("its own");
            for edit in 0..20 {
                let change = edited(&grid, rng, &mut door);
                grid = Arc::clone(change.after());
                space = Arc::new(FreeSpace::new(Arc::clone(&grid), gap));
                dead_ends = Arc::new(uninterrupted(|never| dead_ends.repaired(&space, &change, never)));
                assert_eq!(dead_ends.identity(), space.identity());
                assert_eq!(space.identity().rules, Rules::Corner(gap));
                if rng.below(3) == 0 {
                    continue;
                }
                let mut free = || random_free_vertex(rng, &grid, PlacementKind::Corner);
                let queries: Vec<_> = (0..12).filter_map(|_| Some(Ends::new(free()?, free()?))).collect();
                any.follow(Arc::clone(&space), Some(Arc::clone(&dead_ends))).expect("its own");
                compare(&mut Anya::new(Arc::clone(&space)), &mut any, (&space, &queries), seed);
                let k = FiniteK::new(2 + edit % 4).expect("a small k");
                let over = || Anya::over(Arc::clone(&space), k).expect("a small k");
                let mut without = over().without(Arc::clone(&dead_ends)).expect("its own");
                compare(&mut over(), &mut without, (&space, &queries), seed);
            }
        }
    }
}
