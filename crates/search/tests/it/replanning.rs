//! Searches that keep what they know while the map changes, against new searches, in exact costs.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::{
    cmp::Reverse,
    collections::{BinaryHeap, HashMap, HashSet},
    sync::Arc,
};

use mediant_grid::{
    Centers, Change, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Placement, Rectangle,
    Vertex,
};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::{
    Rng, describe, every, random_change, random_free_vertex, random_vertex, seeds, suite_grid,
};
use mediant_search::{
    AStar, Answer, Counters, DStarLite, Ends, Hk, LpaStar, MoveCosts, Path, Planner, QueryError,
};

/// The cost of a path over N(k), in the integers of a search.
fn exact(path: &Path) -> Cost {
    path.waypoints().windows(2).fold(Cost::ZERO, |cost, ends| {
        let v = ends[0].to(ends[1]);
        let times = v.gcd();
        cost + Cost::of_move((v.x / times as i32, v.y / times as i32).into()) * times
    })
}

/// Checks an answer against A*'s: the error, that there is no path, or the exact cost of one that holds.
fn check<P: Placement>(
    graph: &GridGraph<P>,
    ends: Ends,
    (found, cost): (Result<Answer, QueryError>, Option<Cost>),
    best: &Result<Answer, QueryError>,
    message: &dyn Fn() -> String,
) {
    let found = match (found, best) {
        (Ok(found), Ok(_)) => found,
        (found, best) => {
            assert!(found == *best && cost.is_none(), "{found:?}, not {best:?}; {}", message());
            return;
        }
    };
    let best = best.as_ref().ok().and_then(Answer::path).map(exact);
    assert_eq!((found.path().map(exact), cost), (best, best), "{found}; {}", message());
    if let Some(path) = found.path() {
        // A*'s path to a vertex at which no path ends has one waypoint, too.
        let holds = path.len() == 1 || path.check(graph).is_ok();
        assert!(holds && path.is_over(graph.k().into()), "{path}; {}", message());
        assert_eq!(
            [path.waypoints().first(), path.waypoints().last()],
            [Some(&ends.start), Some(&ends.goal)]
        );
    }
}

/// The sums of a suite.
#[derive(Debug, Default)]
struct Told {
    found: usize,
    unreachable: usize,
    refused: usize,
    expanded: u64,
    by_astar: u64,
}

impl Told {
    fn add(&mut self, answer: &Result<Answer, QueryError>) {
        match answer {
            Ok(Answer::Found(_)) => self.found += 1,
            Ok(_) => self.unreachable += 1,
            Err(_) => self.refused += 1,
        }
    }
}

/// One map with a number of changes.
fn check_changes<P: Placement>(seed: u64, rule: P::Rule, k: u32, told: &mut Told) {
    let (mut rng, k) = (Rng::new(seed), FiniteK::new(k).unwrap());
    let mut grid = Arc::new(suite_grid(seed).0);
    let mut space = FreeSpace::<P>::for_k(Arc::clone(&grid), rule, k.into());
    let [Some(start), Some(goal)] = [(); 2].map(|()| random_free_vertex(&mut rng, &grid, P::KIND)) else {
        return;
    };
    let ends = Ends::new(start, goal);
    let mut graph = Arc::new(GridGraph::in_space(&space, k).unwrap());
    let mut astar = AStar::new(Arc::clone(&graph), Hk);
    let mut lpa = LpaStar::new(Arc::clone(&graph), ends);
    let mut robot = DStarLite::new(Arc::clone(&graph), ends);
    // Changes of which LPA* was not told yet.
    let mut untold = Change::new(Arc::clone(&grid));
    for round in 0..20 {
        let from = robot.ends();
        let message = || {
            let text = describe(&grid, space.rules(), ends.start, ends.goal, seed);
            format!("k = {k}, round {round}, the robot at {}; {text}", from.start)
        };
        if untold.cells().is_empty() {
            let (mut of_astar, mut counters) = (Counters::default(), Counters::default());
            let best = astar.solve_observed(ends, &mut of_astar);
            let found = lpa.path_observed(&mut counters);
            check(&graph, ends, (found, lpa.cost()), &best, &message);
            told.add(&best);
            told.by_astar += of_astar.expanded;
            told.expanded += counters.expanded;
        }
        if rng.chance(80) {
            let (found, best) = (robot.path(), astar.solve(from));
            told.add(&best);
            // Along its path, and seldom elsewhere.
            let steps = rng.below(4) as usize;
            let next = found.as_ref().ok().and_then(Answer::path).and_then(|path| path.vertices().nth(steps));
            check(&graph, from, (found, robot.cost()), &best, &message);
            match next {
                Some(next) if rng.chance(90) => robot.move_to(next),
                _ => robot.move_to(random_vertex(&mut rng, &grid, P::KIND)),
            }
        }

        let change = random_change(&mut rng, &grid);
        space = space.after(&change);
        grid = Arc::clone(change.after());
        graph = Arc::new(GridGraph::in_space(&space, k).unwrap());
        astar.follow(Arc::clone(&graph));
        robot.change(Arc::clone(&graph), &change);
        untold = untold.then(change).unwrap();
        if rng.chance(80) {
            lpa.change(Arc::clone(&graph), &untold);
            untold = Change::new(Arc::clone(&grid));
        }
    }
}

fn check_rules(seed: u64, k: u32, told: &mut Told) {
    for rule in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
        check_changes::<Centers>(seed, rule, k, told);
    }
    for rule in [DiagonalGap::Open, DiagonalGap::Closed] {
        check_changes::<Corners>(seed, rule, k, told);
    }
}

#[test]
fn after_every_change_paths_cost_what_a_new_search_finds() {
    let mut told = Told::default();
    let seeds = seeds(36);
    for seed in seeds.clone() {
        check_rules(seed, 2 + (seed % 6) as u32, &mut told);
    }
    let most = seeds.end as usize * 5 * 32;
    assert!(
        told.found > most / 4 && told.unreachable > most / 20 && told.refused > most / 40,
        "{told:?} of {most}"
    );
    assert!(told.expanded < told.by_astar, "{told:?}");
}

#[test]
fn after_every_change_with_large_k() {
    let mut told = Told::default();
    for (seed, k) in [(0, 8), (1, 9), (2, 10), (3, 12)] {
        check_rules(seed, k, &mut told);
    }
    assert!(told.found > 100, "{told:?}");
}

/// Through all maps of nine cells, one cell after another: each gap comes and goes beside all others.
#[test]
fn through_all_maps_of_nine_cells() {
    let empty = Arc::new(Grid::from_fn(3, 3, |_, _| false).unwrap());
    let vertices = || (0..16).map(|id| Vertex::new(id % 4, id / 4));
    let pairs: Vec<_> =
        vertices().flat_map(|start| vertices().map(move |goal| Ends::new(start, goal))).collect();
    for (number, &ends) in pairs.iter().enumerate().step_by(every(11)) {
        let k = [FiniteK::N4, FiniteK::N8, FiniteK::N16, FiniteK::new(5).unwrap()][number % 4];
        let (mut grid, mut from) = (Arc::clone(&empty), ends);
        let mut space = FreeSpace::<Corners>::for_k(Arc::clone(&grid), DiagonalGap::Closed, k.into());
        let mut graph = Arc::new(GridGraph::in_space(&space, k).unwrap());
        let mut astar = AStar::new(Arc::clone(&graph), Hk);
        let (mut lpa, mut robot) =
            (LpaStar::new(Arc::clone(&graph), ends), DStarLite::new(Arc::clone(&graph), ends));
        for turn in 1..=1_u32 << 9 {
            let message = || describe(&grid, graph.rules(), from.start, from.goal, u64::from(turn));
            let found = lpa.path();
            check(&graph, ends, (found, lpa.cost()), &astar.solve(ends), &message);
            let found = robot.path();
            check(&graph, from, (found, robot.cost()), &astar.solve(from), &message);
            from.start = Vertex::new((from.start.x + 1) % 4, (from.start.y + turn as i32 / 5) % 4);
            robot.move_to(from.start);
            let cell = turn.trailing_zeros() % 9;
            let (x, y) = (cell % 3, cell / 3);
            let blocked = grid.is_blocked(x as i32, y as i32);
            let change = Change::new(Arc::clone(&grid)).edit_cells([(x, y, !blocked)]);
            (space, grid) = (space.after(&change), Arc::clone(change.after()));
            graph = Arc::new(GridGraph::in_space(&space, k).unwrap());
            astar.follow(Arc::clone(&graph));
            lpa.change(Arc::clone(&graph), &change);
            robot.change(Arc::clone(&graph), &change);
        }
    }
}

/// Costs of cells: a move costs its length as many times as the worst of the two cells at its ends says.
#[derive(Clone, Debug)]
struct Swamp(HashMap<Vertex, u32>);

impl MoveCosts<Centers> for Swamp {
    fn cost(&self, graph: &GridGraph<Centers>, from: Vertex, index: usize) -> Option<Cost> {
        let step = graph.step(index);
        let weights = [from, from + step.vector()].map(|at| self.0.get(&at).copied().unwrap_or(1));
        // Some cells have no way at all.
        (!weights.contains(&0)).then(|| step.cost * weights[0].max(weights[1]))
    }
}

/// The costs of all paths from a vertex, by Dijkstra's algorithm.
fn dijkstra(graph: &GridGraph<Centers>, costs: &Swamp, start: Vertex) -> HashMap<Vertex, Cost> {
    let (mut settled, mut open) = (HashMap::new(), BinaryHeap::from([(Reverse(Cost::ZERO), start)]));
    while let Some((Reverse(g), at)) = open.pop() {
        if settled.contains_key(&at) {
            continue;
        }
        settled.insert(at, g);
        for index in graph.legal_moves(at).iter() {
            let next = at + graph.step(index).vector();
            open.extend(costs.cost(graph, at, index).map(|cost| (Reverse(g + cost), next)));
        }
    }
    settled
}

#[test]
fn costs_of_cells_change_with_the_map() {
    for seed in seeds(20) {
        let (mut rng, k) = (Rng::new(seed), FiniteK::new(2 + (seed % 4) as u32).unwrap());
        let mut grid = Arc::new(suite_grid(seed).0);
        let Some(goal) = random_free_vertex(&mut rng, &grid, Centers::KIND) else { continue };
        let mut space = FreeSpace::<Centers>::new(Arc::clone(&grid), CornerRule::Never);
        let mut graph = Arc::new(GridGraph::in_space(&space, k).unwrap());
        let mut swamp = Swamp(HashMap::new());
        let ends = Ends::new(random_free_vertex(&mut rng, &grid, Centers::KIND).unwrap(), goal);
        let mut robot = DStarLite::with_costs(Arc::clone(&graph), swamp.clone(), ends);
        for round in 0..20 {
            let (from, known) = (robot.ends().start, dijkstra(&graph, &swamp, goal));
            if let Ok(answer) = robot.path() {
                let best = known.get(&from).copied();
                assert_eq!(robot.cost(), best, "seed {seed}, round {round}, {answer}, {swamp:?}");
                assert_eq!(answer.path().is_some(), best.is_some());
            }
            if let Some(at) = random_free_vertex(&mut rng, &grid, Centers::KIND) {
                robot.move_to(at);
            }
            let change = random_change(&mut rng, &grid);
            (space, grid) = (space.after(&change), Arc::clone(change.after()));
            graph = Arc::new(GridGraph::in_space(&space, k).unwrap());
            let wet: Vec<_> = (0..3).map(|_| (rng.below(grid.width()), rng.below(grid.height()))).collect();
            swamp.0.extend(wet.iter().map(|&(x, y)| (Vertex::new(x as i32, y as i32), rng.below(5))));
            let wet = wet.iter().map(|&(x, y)| Rectangle::new(x, y, 1, 1));
            let cells: Vec<_> = change.cells().iter().copied().chain(wet).collect();
            robot.change_costs(Arc::clone(&graph), swamp.clone(), &cells);
        }
    }
}

fn graph(map: &Arc<Grid>, k: FiniteK) -> GridGraph<Corners> {
    GridGraph::new(Arc::clone(map), k, DiagonalGap::Closed).unwrap()
}

/// Cell by cell, a map changes and back again: what is known of its moves is that of this k. Whether the cost
/// of a path ever changes.
fn check_each_cell(
    lpa: &mut LpaStar<Arc<GridGraph<Corners>>>,
    map: &Arc<Grid>,
    ends: Ends,
    k: FiniteK,
) -> bool {
    let mut costs = HashSet::new();
    let cells = (0..map.height()).flat_map(|y| (0..map.width()).map(move |x| (x, y)));
    for (x, y) in cells.take(300) {
        let change = Change::new(Arc::clone(map)).edit_cells([(x, y, map.is_free(x as i32, y as i32))]);
        let after = Arc::new(graph(change.after(), k));
        lpa.change(Arc::clone(&after), &change);
        let (answer, best) = (lpa.path(), AStar::new(Arc::clone(&after), Hk).solve(ends));
        check(&after, ends, (answer, lpa.cost()), &best, &|| format!("{k}, ({x}, {y}) of {}", map.id()));
        costs.insert(lpa.cost());
        let back =
            Change::new(Arc::clone(change.after())).edit_cells([(x, y, map.is_blocked(x as i32, y as i32))]);
        lpa.change(Arc::new(graph(back.after(), k)), &back);
    }
    costs.len() > 1
}

/// A graph that does not follow from the one before: another map, another size, another k.
#[test]
fn what_does_not_follow_is_searched_anew() {
    let maps: Vec<_> = (0..12).map(|seed| Arc::new(suite_grid(seed).0)).collect();
    let ends = Ends::new((1, 2), (6, 5));
    let first = graph(&maps[0], FiniteK::N8);
    let mut lpa = LpaStar::new(Arc::new(first), ends);
    let (mut found, mut changed) = (0, 0);
    for (map, k) in maps.iter().zip([FiniteK::N8, FiniteK::N16].into_iter().cycle()) {
        let other = Arc::new(graph(map, k));
        // The change of another map.
        lpa.change(Arc::clone(&other), &Change::new(Arc::clone(&maps[5])));
        let best = AStar::new(Arc::clone(&other), Hk).solve(ends);
        let answer = lpa.path();
        found += usize::from(answer.as_ref().is_ok_and(|answer| answer.path().is_some()));
        check(&other, ends, (answer, lpa.cost()), &best, &|| format!("{k} on\n{}", map.id()));
        assert_eq!(lpa.identity(), other.identity());
        // One more, whose moves become longer.
        let mut lpa = LpaStar::new(Arc::new(graph(map, FiniteK::N8)), ends);
        for k in [FiniteK::N8, FiniteK::N16, FiniteK::N8] {
            lpa.change(Arc::new(graph(map, k)), &Change::new(Arc::clone(&maps[5])));
            changed += usize::from(lpa.path().is_ok() && check_each_cell(&mut lpa, map, ends, k));
        }
    }
    assert!(found > 2 && changed > 2, "{found}, {changed}");
}
