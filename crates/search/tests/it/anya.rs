//! Anya against the visibility graph, and over N(k) against Dijkstra on explicit graphs: on seeded random
//! maps, on all small ones, and on odd cases.

use std::sync::Arc;

use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace, Grid, Identity, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{
    Explicit, Rng, Visibility, describe, every, is_exhaustive, random_free_vertex, seeds, suite_grid,
    validate,
};
use mediant_search::{Answer, Anya, Counters, Ends, Guarantee, Norm, Planner, QueryError};

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

/// Starts, each with its goals.
type Queries = [(Vertex, Vec<Vertex>)];

/// Checks all queries against the costs from their starts. Returns how many had a path, and how many had
/// none.
fn check<N: Norm>(
    mut anya: Anya<&FreeSpace<Corners>, N>,
    grid: &Grid,
    (queries, seed): (&Queries, u64),
    costs: impl Fn(Vertex, &[Vertex]) -> Vec<Option<f64>>,
) -> [u64; 2] {
    let Identity { rules, k, .. } = anya.identity();
    let k = k.and_then(K::finite);
    assert_eq!(anya.guarantee(), k.map_or(Guarantee::OptimalAnyAngle, Guarantee::Optimal));
    let mut answers = [0, 0];
    for (start, goals) in queries {
        for (&goal, expected) in goals.iter().zip(costs(*start, goals)) {
            let case = || format!("k = {k:?}; {}", describe(grid, rules, *start, goal, seed));
            let answer = anya.solve(Ends::new(*start, goal)).expect("both ends are free");
            match (&answer, expected) {
                (Answer::Unreachable, None) => {}
                (Answer::Found(path), Some(best)) => {
                    let (cost, waypoints) = (path.cost(), path.waypoints());
                    assert!((cost - best).abs() <= 1e-9 * best, "cost {cost}, best {best}; {}", case());
                    let fault = validate(grid, rules, k, *start, goal, waypoints, cost);
                    assert_eq!(fault, Ok(()), "{waypoints:?}; {}", case());
                    let is_taut = k.is_some() || is_taut(grid, waypoints);
                    assert!(is_taut, "{waypoints:?} is not taut; {}", case());
                }
                (answer, best) => panic!("{answer:?}, best {best:?}; {}", case()),
            }
            answers[usize::from(answer.path().is_none())] += 1;
        }
    }
    answers
}

/// Checks all queries at any angle, against the visibility graph.
fn check_any(grid: &Arc<Grid>, gap: DiagonalGap, queries: &Queries, seed: u64) -> [u64; 2] {
    let visibility = Visibility::new(grid, gap);
    let graph = visibility.over(None);
    let space = FreeSpace::<Corners>::new(Arc::clone(grid), gap);
    let check = |anya| {
        check(anya, grid, (queries, seed), |start, goals| {
            let costs = graph.costs_from(start);
            goals.iter().map(|&goal| costs.to(goal)).collect()
        })
    };
    let answers = check(Anya::new(&space));
    assert_eq!(check(Anya::new(&space).without_dead_ends()), answers);
    answers
}

/// Checks all queries over N(k), against Dijkstra on the graph of all its moves.
fn check_over(k: FiniteK, grid: &Arc<Grid>, gap: DiagonalGap, queries: &Queries, seed: u64) -> [u64; 2] {
    let graph = Explicit::new(grid, Rules::Corner(gap), Some(k));
    let space = FreeSpace::<Corners>::new(Arc::clone(grid), gap);
    let check = |anya| {
        check(anya, grid, (queries, seed), |start, goals| {
            let costs = graph.costs_from(start);
            goals.iter().map(|&goal| costs.to(goal)).collect()
        })
    };
    let answers = check(Anya::over(&space, k).expect("a small k"));
    assert_eq!(check(Anya::over(&space, k).expect("a small k").without_dead_ends()), answers);
    answers
}

/// From each start of a few to some goals each, all random.
fn random_queries(grid: &Grid, mut rng: Rng, starts: usize, goals: usize) -> Vec<(Vertex, Vec<Vertex>)> {
    let mut free = || random_free_vertex(&mut rng, grid, PlacementKind::Corner);
    (0..starts).filter_map(|_| Some((free()?, (0..goals).filter_map(|_| free()).collect()))).collect()
}

/// Calls `check` with each `step`-th map of this size, or [all](every), under both gap rules, and from every
/// free vertex to every other. Returns the sum of the answers.
fn on_all_maps(
    (width, height, step): (u32, u32, usize),
    check: impl Fn(&Arc<Grid>, DiagonalGap, &Queries, u64) -> [u64; 2],
) -> u64 {
    let mut answers = 0;
    for cells in (0..1_u32 << (width * height)).step_by(every(step)) {
        let grid = Grid::from_fn(width, height, |x, y| cells >> (width * y + x) & 1 == 1);
        let grid = Arc::new(grid.expect("a valid size"));
        for gap in GAPS {
            let space = FreeSpace::<Corners>::new(Arc::clone(&grid), gap);
            let vertices =
                (0..=height as i32).flat_map(|y| (0..=width as i32).map(move |x| Vertex::new(x, y)));
            let free: Vec<Vertex> = vertices.filter(|&at| space.is_free(at)).collect();
            let pairs: Vec<_> = free.iter().map(|&start| (start, free.clone())).collect();
            answers += check(&grid, gap, &pairs, u64::from(cells)).into_iter().sum::<u64>();
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
            let queries = random_queries(&grid, Rng::new(seed ^ 0xA17A), 3, 5);
            let [some, none] = check_any(&grid, gap, &queries, seed);
            (found, unreachable) = (found + some, unreachable + none);
        }
    }
    let maps = seeds(400).end;
    assert!(found > 15 * maps && unreachable > maps, "{found} found, {unreachable} unreachable");
}

/// Maps of other sizes, too, from every vertex to every other, under both gap rules.
#[test]
fn anya_is_exact_on_every_map_of_nine_cells() {
    let sizes = [(3, 3, 5), (4, 3, 61), (1, 9, 7), (9, 1, 7)];
    let queries = sizes.map(|size| on_all_maps(size, check_any)).into_iter().sum::<u64>();
    assert_eq!(queries, if is_exhaustive() { 2_519_200 } else { 123_568 });
}

#[test]
fn anya_over_n_k_costs_what_dijkstra_says() {
    let (mut found, mut unreachable) = (0, 0);
    for seed in seeds(120) {
        let grid = Arc::new(suite_grid(seed).0);
        for (k, gap) in (2..=8).flat_map(|k| GAPS.map(|gap| (k, gap))) {
            let queries = random_queries(&grid, Rng::new(seed ^ 0xA17B ^ u64::from(k) << 32), 2, 4);
            let k = FiniteK::new(k).expect("k is at least 2");
            let [some, none] = check_over(k, &grid, gap, &queries, seed);
            (found, unreachable) = (found + some, unreachable + none);
        }
    }
    let maps = seeds(120).end;
    assert!(found > 50 * maps && unreachable > 3 * maps, "{found} found, {unreachable} unreachable");
}

/// The same over N(k).
#[test]
fn anya_over_n_k_is_exact_on_every_map_of_nine_cells() {
    let sizes = [
        (2, (3, 3, 7)),
        (2, (4, 3, 127)),
        (2, (9, 1, 7)),
        (3, (3, 3, 7)),
        (3, (4, 3, 127)),
        (3, (1, 9, 7)),
        (4, (3, 3, 7)),
        (4, (4, 3, 127)),
        (5, (3, 3, 7)),
        (5, (4, 3, 127)),
    ];
    let queries = sizes.map(|(k, size)| {
        let k = FiniteK::new(k).expect("k is at least 2");
        on_all_maps(size, |grid, gap, queries, seed| check_over(k, grid, gap, queries, seed))
    });
    let expected = if is_exhaustive() { 8_789_632 } else { 205_632 };
    assert_eq!(queries.into_iter().sum::<u64>(), expected);
}

fn solve(drawing: &str, gap: DiagonalGap, start: (i32, i32), goal: (i32, i32)) -> Option<f64> {
    let grid = Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid);
    let space = FreeSpace::<Corners>::new(grid, gap);
    let answer = Anya::new(&space).solve(Ends::new(start, goal)).expect("both ends are free");
    answer.path().map(|path| path.cost())
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
    let mut solve = |start: (i32, i32), goal: (i32, i32)| anya.solve(Ends::new(start, goal));
    assert!(matches!(solve((0, 0), (2, 0)), Err(QueryError::Blocked { .. })));
    assert!(matches!(solve((2, 0), (4, 0)), Err(QueryError::Outside { .. })));
    assert!(matches!(solve((i32::MIN, 0), (i32::MAX, 9)), Err(QueryError::Outside { .. })));
    // No path: the components tell this without a search.
    let grid = Arc::new(AsciiMap::parse(".#.").expect("the drawing is a map").grid);
    let space = FreeSpace::<Corners>::new(grid, DiagonalGap::Open);
    let mut counters = Counters::default();
    let answer = Anya::new(&space).solve_observed(Ends::new((0, 0), (3, 0)), &mut counters);
    assert_eq!((answer, counters), (Ok(Answer::Unreachable), Counters::default()));
    // All blocked: no vertex is free.
    let grid = Arc::new(Grid::from_fn(3, 2, |_, _| true).expect("a valid size"));
    let space = FreeSpace::<Corners>::new(grid, DiagonalGap::Closed);
    assert!(Anya::new(&space).solve(Ends::new((0, 0), (1, 1))).is_err());
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
            let query = Ends::new(start, goal);
            let answer = anya.solve(query).expect("both ends are free");
            let path = answer.path().expect("there is a way");
            assert_eq!(path.waypoints(), [query.start, query.goal]);
        }
    }
    // Walls in every eighth column, open one cell at the end.
    let comb = Grid::from_fn(side, side, |x, y| x % 8 == 4 && y != if x % 16 == 4 { 0 } else { side - 1 });
    let space = FreeSpace::<Corners>::new(Arc::new(comb.expect("a valid size")), DiagonalGap::Open);
    let answer = Anya::new(&space).solve(Ends::new((0, far), (far, far))).expect("both ends are free");
    let path = answer.path().expect("there is a way");
    // Two bends at each of the 512 walls, but one at the last.
    assert_eq!(path.waypoints().len(), 2 + 2 * 512 - 1);
    let (first, between, last) = (4.0_f64.hypot(4095.0), 7.0_f64.hypot(4094.0), 4.0_f64.hypot(1.0));
    let length = first + 511.0 * (1.0 + between) + last;
    assert!((path.cost() - length).abs() < 1e-6, "{}, not {length}", path.cost());
}
