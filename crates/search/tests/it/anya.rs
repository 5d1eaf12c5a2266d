//! Anya against the visibility graph, on seeded random maps, on all small ones, and on odd cases.

use std::sync::Arc;

use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace, Grid, PlacementKind, Rules, Vertex};
use mediant_oracle::{Rng, Visibility, describe, random_free_vertex, seeds, suite_grid, validate};
use mediant_search::{Anya, Counters, Guarantee, Outcome, Planner, Query, QueryError};

const GAPS: [DiagonalGap; 2] = [DiagonalGap::Open, DiagonalGap::Closed];

/// Whether a path bends only around corners of obstacles, and towards the obstacle, as every optimal path
/// does.
fn is_taut(grid: &Grid, waypoints: &[Vertex]) -> bool {
    waypoints.windows(3).all(|bend| {
        let (u, v) = (bend[0].to(bend[1]), bend[1].to(bend[2]));
        let turn = i64::from(u.x) * i64::from(v.y) - i64::from(u.y) * i64::from(v.x);
        let quadrants = [(0, 0), (-1, 0), (0, -1), (-1, -1)];
        let mut around = quadrants.iter().filter(|(dx, dy)| grid.is_blocked(bend[1].x + dx, bend[1].y + dy));
        turn != 0
            && around.any(|&(dx, dy)| {
                // The middle of the blocked cell, seen from the bend, in half cells: on the inner side of
                // both segments.
                let (x, y) = (i64::from(2 * dx + 1), i64::from(2 * dy + 1));
                let side = |w: mediant_grid::Vector| (i64::from(w.x) * y - i64::from(w.y) * x).signum();
                side(u) == turn.signum() && side(v) == turn.signum()
            })
    })
}

#[track_caller]
fn check(grid: &Grid, rules: Rules, query: Query, outcome: &Outcome, expected: Option<f64>, seed: u64) {
    let Query { start, goal, .. } = query;
    let case = || describe(grid, rules, start, goal, seed);
    match (outcome, expected) {
        (Outcome::Unreachable, None) => {}
        (Outcome::Found(path), Some(best)) => {
            let cost = path.cost();
            assert!((cost - best).abs() <= 1e-9 * best, "cost {cost}, best {best}; {}", case());
            let fault = validate(grid, rules, None, start, goal, path.waypoints(), cost);
            assert_eq!(fault, Ok(()), "{:?}; {}", path.waypoints(), case());
            assert!(is_taut(grid, path.waypoints()), "{:?} is not taut; {}", path.waypoints(), case());
        }
        _ => panic!("{outcome:?}, best {expected:?}; {}", case()),
    }
}

/// Checks every start with its goals. Returns how many queries had a path, and how many had none.
fn check_all(grid: &Arc<Grid>, gap: DiagonalGap, queries: &[(Vertex, Vec<Vertex>)], seed: u64) -> [u64; 2] {
    let visibility = Visibility::new(grid, gap);
    let graph = visibility.over(None);
    let space = FreeSpace::<Corners>::new(Arc::clone(grid), gap);
    let mut anya = Anya::new(&space);
    let mut answers = [0, 0];
    for (start, goals) in queries {
        let costs = graph.costs_from(*start);
        for &goal in goals {
            let query = Query::new(*start, goal);
            let outcome = anya.solve(query).expect("both ends are free");
            check(grid, Rules::Corner(gap), query, &outcome, costs.to(goal), seed);
            answers[usize::from(outcome.path().is_none())] += 1;
        }
    }
    answers
}

#[test]
fn anya_costs_what_the_visibility_graph_says() {
    let (mut found, mut unreachable) = (0, 0);
    for seed in seeds(400) {
        let grid = Arc::new(suite_grid(seed).0);
        for gap in GAPS {
            let mut rng = Rng::new(seed ^ 0xA17A);
            let mut free = || random_free_vertex(&mut rng, &grid, PlacementKind::Corner);
            let queries: Vec<(Vertex, Vec<Vertex>)> =
                (0..3).filter_map(|_| Some((free()?, (0..5).filter_map(|_| free()).collect()))).collect();
            let [some, none] = check_all(&grid, gap, &queries, seed);
            (found, unreachable) = (found + some, unreachable + none);
        }
    }
    let maps = seeds(400).end;
    assert!(found > 15 * maps && unreachable > maps, "{found} found, {unreachable} unreachable");
}

/// Every map of 3 × 3 cells, and of 4 × 3 in a sample, from every vertex to every other, under both gap
/// rules.
#[test]
fn anya_is_exact_on_every_map_of_nine_cells() {
    let mut queries = 0;
    for (width, height, step) in [(3, 3, 1_usize), (4, 3, 13), (1, 9, 7), (9, 1, 7)] {
        for cells in (0..1_u32 << (width * height)).step_by(step) {
            let grid = Grid::from_fn(width, height, |x, y| cells >> (width * y + x) & 1 == 1);
            let grid = Arc::new(grid.expect("a valid size"));
            for gap in GAPS {
                let space = FreeSpace::<Corners>::new(Arc::clone(&grid), gap);
                let vertices =
                    (0..=height as i32).flat_map(|y| (0..=width as i32).map(move |x| Vertex::new(x, y)));
                let free: Vec<Vertex> = vertices.filter(|&at| space.is_free(at)).collect();
                let pairs: Vec<_> = free.iter().map(|&start| (start, free.clone())).collect();
                let [found, unreachable] = check_all(&grid, gap, &pairs, u64::from(cells));
                queries += found + unreachable;
            }
        }
    }
    assert_eq!(queries, 360_524);
}

fn solve(drawing: &str, gap: DiagonalGap, start: (i32, i32), goal: (i32, i32)) -> Option<f64> {
    let grid = Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid);
    let space = FreeSpace::<Corners>::new(grid, gap);
    let outcome = Anya::new(&space).solve(Query::new(start, goal)).expect("both ends are free");
    outcome.path().map(|path| path.cost())
}

#[test]
fn gaps_are_passed_where_they_are_open() {
    const GAP: &str = "
        .#
        #.
    ";
    let root = 2.0_f64.sqrt();
    assert_eq!(solve(GAP, DiagonalGap::Open, (0, 0), (2, 2)), Some(2.0 * root));
    assert_eq!(solve(GAP, DiagonalGap::Closed, (0, 0), (2, 2)), None);
    // From the gap itself a path leaves into the quadrant of its own cell, whatever the start sees.
    assert_eq!(solve(GAP, DiagonalGap::Closed, (1, 1), (2, 2)), Some(root));
    assert_eq!(solve(GAP, DiagonalGap::Closed, (1, 1), (0, 0)), None);
    assert_eq!(solve(GAP, DiagonalGap::Closed, (2, 2), (1, 1)), Some(root));
    assert_eq!(solve(GAP, DiagonalGap::Open, (1, 1), (0, 0)), Some(root));
    // Where the gap's own cell is blocked, no path starts or ends at it.
    const OTHER: &str = "
        #.
        .#
    ";
    assert_eq!(solve(OTHER, DiagonalGap::Closed, (1, 1), (2, 0)), None);
    assert_eq!(solve(OTHER, DiagonalGap::Open, (1, 1), (2, 0)), Some(root));
    // Straight along a grid line through a gap.
    const LINE: &str = "
        .#
        #.
        ..
    ";
    assert_eq!(solve(LINE, DiagonalGap::Open, (0, 1), (2, 1)), Some(2.0));
    assert_eq!(solve(LINE, DiagonalGap::Closed, (0, 1), (2, 1)), None);
}

#[test]
fn odd_starts_and_goals() {
    const CORRIDOR: &str = "
        .######
        .#...##
        ...#...
    ";
    for gap in GAPS {
        // Down a wall, around its corner, and straight on past three obstacles on alternate sides, to the
        // border.
        assert_eq!(solve(CORRIDOR, gap, (1, 0), (7, 2)), Some(8.0));
        // On a vertex with one free cell, and on the same one.
        assert_eq!(solve(CORRIDOR, gap, (1, 0), (1, 2)), Some(2.0));
        assert_eq!(solve(CORRIDOR, gap, (5, 1), (5, 1)), Some(0.0));
        // The borders of the map are walls to go along.
        assert_eq!(solve(CORRIDOR, gap, (0, 0), (0, 3)), Some(3.0));
        assert_eq!(solve(CORRIDOR, gap, (0, 3), (3, 3)), Some(3.0));
        // Inside a corridor of one cell, from side to side.
        assert_eq!(solve("...", gap, (0, 0), (3, 1)), Some(10.0_f64.sqrt()));
        assert_eq!(solve(".", gap, (0, 0), (1, 1)), Some(2.0_f64.sqrt()));
        assert_eq!(solve(".#.", gap, (0, 0), (3, 0)), None);
    }
}

#[test]
fn ends_that_no_path_may_stand_on_are_errors() {
    let grid = Arc::new(AsciiMap::parse("##.\n##.").expect("the drawing is a map").grid);
    let space = FreeSpace::<Corners>::new(grid, DiagonalGap::Open);
    let mut anya = Anya::new(&space);
    assert_eq!(anya.guarantee(), Guarantee::OptimalAnyAngle);
    let mut solve = |start: (i32, i32), goal: (i32, i32)| anya.solve(Query::new(start, goal));
    assert!(matches!(solve((0, 0), (2, 0)), Err(QueryError::Blocked { .. })));
    assert!(matches!(solve((2, 0), (4, 0)), Err(QueryError::Outside { .. })));
    assert!(matches!(solve((i32::MIN, 0), (i32::MAX, 9)), Err(QueryError::Outside { .. })));
    // No path: the components tell this without a search.
    let grid = Arc::new(AsciiMap::parse(".#.").expect("the drawing is a map").grid);
    let space = FreeSpace::<Corners>::new(grid, DiagonalGap::Open);
    let mut counters = Counters::default();
    let outcome = Anya::new(&space).solve_observed(Query::new((0, 0), (3, 0)), &mut counters);
    assert_eq!((outcome, counters), (Ok(Outcome::Unreachable), Counters::default()));
    // All blocked: no vertex is free.
    let grid = Arc::new(Grid::from_fn(3, 2, |_, _| true).expect("a valid size"));
    let space = FreeSpace::<Corners>::new(grid, DiagonalGap::Closed);
    assert!(Anya::new(&space).solve(Query::new((0, 0), (1, 1))).is_err());
}

/// From corner to corner of a large map, without obstacles, and with a comb of walls that are open at the top
/// and at the bottom in turn.
#[test]
fn large_maps() {
    let side = 4096;
    let free = Arc::new(Grid::from_fn(side, side, |_, _| false).expect("a valid size"));
    let far = side as i32;
    for gap in GAPS {
        let space = FreeSpace::<Corners>::new(Arc::clone(&free), gap);
        let mut anya = Anya::new(&space);
        for (start, goal) in
            [((0, 0), (far, far)), ((far, 0), (0, far)), ((7, far), (far, 1)), ((0, 9), (far, 9))]
        {
            let query = Query::new(start, goal);
            let outcome = anya.solve(query).expect("both ends are free");
            let path = outcome.path().expect("there is a way");
            assert_eq!(path.waypoints(), [query.start, query.goal]);
        }
    }
    // Walls in every eighth column, open one cell at the end.
    let comb = Grid::from_fn(side, side, |x, y| x % 8 == 4 && y != if x % 16 == 4 { 0 } else { side - 1 });
    let space = FreeSpace::<Corners>::new(Arc::new(comb.expect("a valid size")), DiagonalGap::Open);
    let outcome = Anya::new(&space).solve(Query::new((0, far), (far, far))).expect("both ends are free");
    let path = outcome.path().expect("there is a way");
    // Two bends at each of the 512 walls, but one at the last.
    assert_eq!(path.waypoints().len(), 2 + 2 * 512 - 1);
    let (first, between, last) = (4.0_f64.hypot(4095.0), 7.0_f64.hypot(4094.0), 4.0_f64.hypot(1.0));
    let length = first + 511.0 * (1.0 + between) + last;
    assert!((path.cost() - length).abs() < 1e-6, "{}, not {length}", path.cost());
}
