//! Ends anywhere: points between vertices against the oracle of points, on seeded random maps.

use std::sync::Arc;

use mediant_grid::{Corners, DiagonalGap, FreeSpace, Grid, Obstruction, Point};
use mediant_oracle::{
    PointKind, PointVisibility, Rng, describe_points, point_is_free, random_free_point, random_point, seeds,
    segment_between_points_is_legal, suite_grid, validate_between_points,
};
use mediant_search::{Answer, Anya, Planner, PointEnds};

const GAPS: [DiagonalGap; 2] = [DiagonalGap::Open, DiagonalGap::Closed];

fn point((x, y): (i64, i64)) -> Point {
    Point::from_parts(x, y)
}

/// Points of every kind, some of them blocked or outside the map.
fn points(rng: &mut Rng, grid: &Grid) -> Vec<(i64, i64)> {
    PointKind::ALL.into_iter().map(|kind| random_point(rng, grid, kind)).collect()
}

fn for_each_map(maps: u64, mut check: impl FnMut(&Arc<Grid>, DiagonalGap, u64, &mut Rng)) {
    for seed in seeds(maps) {
        let grid = Arc::new(suite_grid(seed).0);
        for gap in GAPS {
            check(&grid, gap, seed, &mut Rng::new(seed));
        }
    }
}

#[test]
fn points_are_free_and_see_each_other_as_the_oracle_says() {
    let mut counts = [0; 2];
    for_each_map(300, |grid, gap, seed, rng| {
        let space = FreeSpace::<Corners>::new(Arc::clone(grid), gap);
        let points = points(rng, grid);
        for &from in &points {
            assert_eq!(space.point_is_free(point(from)), point_is_free(grid, from), "{from:?}, seed {seed}");
            for &to in &points {
                let case = || describe_points(grid, gap, from, to, seed);
                let free = [from, to].iter().all(|&at| point_is_free(grid, at));
                let expected = free && segment_between_points_is_legal(grid, gap, from, to);
                assert_eq!(space.point_sees(point(from), point(to)), expected, "{}", case());
                let found = space.point_obstruction(point(from), point(to));
                assert_eq!(found.is_none(), expected, "{found:?}: {}", case());
                counts[usize::from(expected)] += 1;
                match found {
                    Some(Obstruction::Cell { x, y }) => assert!(grid.is_blocked(x, y), "{}", case()),
                    Some(Obstruction::Between { cells }) => {
                        assert!(cells.iter().all(|&(x, y)| grid.is_blocked(x, y)), "{}", case());
                    }
                    _ => {}
                }
            }
        }
    });
    assert!(counts.iter().all(|&count| count > 5_000), "{counts:?}");
}

/// Whether there is a way, and how far it is, with the dead ends of the map and without them.
#[test]
fn anya_between_points_finds_the_shortest_paths() {
    let mut answers = [0; 2];
    for_each_map(600, |grid, gap, seed, rng| {
        let space = FreeSpace::<Corners>::new(Arc::clone(grid), gap);
        let oracle = PointVisibility::new(grid, gap);
        let mut planners = [Anya::new(&space), Anya::new(&space).without_dead_ends()];
        for _ in 0..12 {
            let Some((from, to)) = random_free_point(rng, grid).zip(random_free_point(rng, grid)) else {
                break;
            };
            let case = || describe_points(grid, gap, from, to, seed);
            let expected = oracle.cost(from, to);
            let ends = PointEnds::new(point(from), point(to));
            assert_eq!(space.points_connected(ends.start, ends.goal), expected.is_some(), "{}", case());
            for anya in &mut planners {
                let answer = anya.solve_at(ends).expect("any angle").expect("both ends are free");
                match (&answer, expected) {
                    (Answer::Unreachable, None) => {}
                    (Answer::Found(path), Some(best)) => {
                        assert!((path.cost() - best).abs() <= 1e-9 * best, "{path}, best {best}; {}", case());
                        let points: Vec<_> = path.points().map(Point::parts).collect();
                        let fault = validate_between_points(grid, gap, from, to, &points, path.cost());
                        assert_eq!(fault, Ok(()), "{path}; {}", case());
                        assert_eq!(path.check(&space), Ok(()), "{path}; {}", case());
                    }
                    _ => panic!("{answer:?}, not {expected:?}; {}", case()),
                }
            }
            answers[usize::from(expected.is_some())] += 1;
        }
    });
    assert!(answers.iter().all(|&count| count > 1_000), "{answers:?}");
}
