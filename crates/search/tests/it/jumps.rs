//! Jumps on maps with few obstacles, where they are long, and where most of them are cut.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::sync::Arc;

use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, Grid, GridGraph, Placement, Rules, Vector, Vertex,
};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::{
    Rng, caves, describe, noise, on_all_cores, random_free_vertex, rooms, seeds, sparse, validate,
};
use mediant_search::{
    AStar, Answer, BlockJps, Counters, Ends, Euclidean, Hk, Jps, JpsPlus, JumpTable, NodeEvent, Observer,
    Path, Planner, SearchStatus, Zero,
};

/// Open ground behind a wall, or with a few cells blocked anywhere; sides of up to 130 cells, so that jumps
/// are longer than two words.
fn grid(seed: u64) -> Grid {
    let rng = &mut Rng::new(seed);
    let side = 30 + rng.below(101);
    if rng.chance(50) {
        let one_in = 10 + rng.below(90);
        sparse(rng, side, one_in)
    } else {
        let percent = 1 + rng.below(6);
        noise(rng, side, 30 + side / 2, percent)
    }
}

/// Jumps of all engines on a map against A*: the same costs, and paths that hold. Returns the number of
/// queries, and the expansions with nodes for intermediate jump points and without.
fn check<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, seed: u64) -> [u64; 3] {
    let mut sums = [0; 3];
    for k in [2, 3, 4] {
        let graph = &GridGraph::<P>::new(Arc::clone(grid), FiniteK::new(k).unwrap(), rule).unwrap();
        let mut planners: Vec<(&str, Box<dyn Solve + '_>)> = vec![
            ("jps", Box::new(Jps::new(graph, Hk))),
            ("jps, Euclidean", Box::new(Jps::new(graph, Euclidean))),
        ];
        if k <= 3 {
            let table = Arc::new(JumpTable::new(graph).unwrap());
            planners.push(("jps-plus", Box::new(JpsPlus::new(graph, Arc::clone(&table), Hk).unwrap())));
            planners.push(("jps-plus, zero", Box::new(JpsPlus::new(graph, table, Zero).unwrap())));
            planners.push(("jps-block, zero", Box::new(BlockJps::new(graph, Zero).unwrap())));
            let limited = BlockJps::new(graph, Hk).unwrap().with_jump_limit(Some(5));
            planners.push(("jps-block, limit 5", Box::new(limited)));
            let kept = BlockJps::new(graph, Hk).unwrap().with_intermediate(true);
            planners.push(("jps-block, kept", Box::new(kept)));
            planners.push(("jps-block", Box::new(BlockJps::new(graph, Hk).unwrap())));
        }
        let mut astar = AStar::new(graph, Hk);
        let rng = &mut Rng::new(seed ^ 0x0DD);
        for _ in 0..4 {
            let mut free = || random_free_vertex(rng, grid, P::KIND).unwrap();
            let query = Ends::new(free(), free());
            let expected = astar.solve(query).unwrap();
            // Paths of the same cost have other segments, whose lengths are rounded otherwise.
            let cost = |answer: &Answer| answer.path().map(|path| (path.cost() * 1e9).round());
            let case = |name: &str| {
                format!("{name}, k = {k}, {}", describe(grid, P::rules(rule), query.start, query.goal, seed))
            };
            for (name, planner) in &mut planners {
                let (answer, expanded) = planner.counted(query);
                assert_eq!(cost(&answer), cost(&expected), "{}", case(name));
                if let Some(path) = answer.path() {
                    let (rules, k) = (P::rules(rule), Some(graph.k()));
                    let (start, goal) = (query.start, query.goal);
                    let fault = validate(grid, rules, k, start, goal, path.waypoints(), path.cost());
                    assert_eq!(fault, Ok(()), "{}", case(name));
                }
                sums[1] += if *name == "jps-block, kept" { expanded } else { 0 };
                sums[2] += if *name == "jps-block" { expanded } else { 0 };
            }
            sums[0] += 1;
        }
    }
    sums
}

/// A planner of any type.
trait Solve {
    /// The answer, and the number of expansions.
    fn counted(&mut self, query: Ends) -> (Answer, u64);
}

impl<T: Planner> Solve for T {
    fn counted(&mut self, query: Ends) -> (Answer, u64) {
        let mut counters = Counters::default();
        let answer = self.solve_observed(query, &mut counters).unwrap();
        (answer, counters.expanded)
    }
}

#[test]
fn cut_jumps_lose_no_optimum() {
    let seeds = seeds(24);
    let maps = seeds.end;
    let parts = on_all_cores(seeds, |seed| {
        let grid = Arc::new(grid(seed));
        let on = |rules: Rules| match rules {
            Rules::Center(rule) => check::<Centers>(&grid, rule, seed),
            Rules::Corner(rule) | Rules::CenterGap(rule) => check::<Corners>(&grid, rule, seed),
        };
        Rules::ALL.map(on).iter().fold([0; 3], |sums, one| [0, 1, 2].map(|i| sums[i] + one[i]))
    });
    let [queries, kept, pruned] = parts.iter().fold([0; 3], |sums, one| [0, 1, 2].map(|i| sums[i] + one[i]));
    assert_eq!(queries, 60 * maps, "a query was left out");
    assert!(5 * pruned < 4 * kept, "{pruned} expansions, {kept} with intermediate jump points");
}

/// The searches of one planner on a map, moved by (`x`, `y`): their answers and expansions.
fn searches<P: Placement>(grid: Grid, rule: P::Rule, (x, y): (i32, i32), seed: u64) -> Vec<(Answer, u64)> {
    let by = Vector::new(x, y);
    let graph = &GridGraph::<P>::new(Arc::new(grid), FiniteK::N8, rule).unwrap();
    let mut planner = Jps::new(graph, Hk);
    let rng = &mut Rng::new(seed);
    let mut any = || Vertex::new(rng.below(120) as i32, rng.below(120) as i32);
    let queries = (0..40).map(|_| (any(), any()));
    let free = queries.filter(|&(start, goal)| graph.is_free(start + by) && graph.is_free(goal + by));
    let moved_back = |answer: Answer| match answer {
        Answer::Found(path) => {
            Answer::Found(Path::new(path.waypoints().iter().map(|&at| at + -by).collect()))
        }
        other => other,
    };
    free.map(|(start, goal)| planner.counted(Ends::new(start + by, goal + by)))
        .map(|(answer, expanded)| (moved_back(answer), expanded))
        .collect()
}

/// On large maps nodes of jumps are stored in blocks. The searches of a small map, somewhere in a large one,
/// are the same.
#[test]
fn on_large_maps_jumps_search_what_they_search_on_small_ones() {
    let seed = 7;
    let small = noise(&mut Rng::new(seed), 120, 120, 12);
    let place = (1500, 2001);
    let large = Grid::from_fn(2100, 2130, |x, y| small.is_blocked(x as i32 - place.0, y as i32 - place.1));
    let large = large.unwrap();
    let (never, open) = (CornerRule::Never, DiagonalGap::Open);
    let expected = searches::<Centers>(small.clone(), never, (0, 0), seed);
    assert!(expected.len() > 20);
    assert_eq!(searches::<Centers>(large.clone(), never, place, seed), expected);
    let expected = searches::<Corners>(small, open, (0, 0), seed);
    assert_eq!(searches::<Corners>(large, open, place, seed), expected);
}

/// Whether the path by diagonal moves first and then along an axis is legal.
fn is_in_sight(graph: &GridGraph<Centers>, start: Vertex, goal: Vertex) -> bool {
    let mut at = start;
    while at != goal {
        let v = Vector::new((goal.x - at.x).signum(), (goal.y - at.y).signum());
        if !graph.is_legal(at, v) {
            return false;
        }
        at = at + v;
    }
    true
}

/// Where the goal is in sight, engines that jump by words expand the start alone.
#[test]
fn a_goal_in_sight_is_found_at_once() {
    let mut in_sight = 0;
    for seed in seeds(40) {
        let grid = Arc::new(grid(seed));
        let graph = &GridGraph::<Centers>::new(Arc::clone(&grid), FiniteK::N8, CornerRule::Never).unwrap();
        let table = Arc::new(JumpTable::new(graph).unwrap());
        let mut engines: [Box<dyn Solve + '_>; 2] =
            [Box::new(BlockJps::new(graph, Hk).unwrap()), Box::new(JpsPlus::new(graph, table, Hk).unwrap())];
        let rng = &mut Rng::new(seed ^ 0x51E);
        for _ in 0..50 {
            let mut free = || random_free_vertex(rng, &grid, Centers::KIND).unwrap();
            let (start, goal) = (free(), free());
            if start == goal || !is_in_sight(graph, start, goal) {
                continue;
            }
            for engine in &mut engines {
                let (answer, expanded) = engine.counted(Ends::new(start, goal));
                let case = || describe(&grid, Rules::Center(CornerRule::Never), start, goal, seed);
                let least = graph.costs().distance(start.to(goal)).to_f64();
                let cost = answer.path().map_or(f64::INFINITY, |path| path.cost());
                assert!((cost - least).abs() < 1e-8, "{cost} instead of {least}, {}", case());
                assert_eq!(expanded, 1, "{}", case());
            }
            in_sight += 1;
        }
    }
    assert!(in_sight > 300, "{in_sight}");
}

/// Pauses after so many expansions, and does not count swaps.
struct Pause {
    left: u32,
}

impl Observer for Pause {
    fn expanded(&mut self, _: NodeEvent) {
        self.left -= 1;
    }

    fn pauses(&mut self, _: Cost) -> bool {
        self.left == 0
    }

    fn counts_swaps(&self) -> bool {
        false
    }
}

/// The path of a search in two parts, and whether swaps were counted when it had been under way.
fn in_parts(planner: &mut impl Planner, query: Ends, expansions: u32) -> (Option<Path>, bool) {
    let mut counters = Counters::default();
    let mut status = planner.begin(query, &mut ()).unwrap();
    if status == SearchStatus::Searching {
        status = planner.proceed(&mut Pause { left: expansions }).unwrap();
    }
    if status == SearchStatus::Searching {
        status = planner.proceed(&mut counters).unwrap();
    }
    let path = (status == SearchStatus::Found).then(|| planner.path_to(query.goal)).flatten();
    (path, counters.percolations > 0)
}

/// Planners find the same paths, with as many expansions, whether or not somebody counts swaps, also in
/// searches with many open nodes, many of which are reached again by a cheaper path.
#[test]
fn paths_do_not_depend_on_whether_swaps_are_counted() {
    let parts = on_all_cores(seeds(12), |seed| {
        let rng = &mut Rng::new(seed);
        let grid = Arc::new(match seed % 3 {
            0 => rooms(rng, 260, 140),
            1 => caves(rng, 190, 180),
            _ => noise(rng, 160, 120, 25),
        });
        let graph = &GridGraph::<Centers>::new(Arc::clone(&grid), FiniteK::N8, CornerRule::Never).unwrap();
        let table = Arc::new(JumpTable::new(graph).unwrap());
        let mut blocks = BlockJps::new(graph, Hk).unwrap();
        let mut lists = JpsPlus::new(graph, Arc::clone(&table), Hk).unwrap();
        let mut all = JpsPlus::new(graph, table, Zero).unwrap();
        let (mut updated, mut switched) = (0, 0);
        for _ in 0..8 {
            let mut free = || random_free_vertex(rng, &grid, Centers::KIND).unwrap();
            let (query, expansions) = (Ends::new(free(), free()), 1 + rng.below(100));
            let case = || describe(&grid, Rules::Center(CornerRule::Never), query.start, query.goal, seed);
            macro_rules! check {
                ($planner:ident) => {
                    let mut counters = Counters::default();
                    let counted = $planner.solve_observed(query, &mut counters).unwrap();
                    let mut quiet = Pause { left: u32::MAX };
                    assert_eq!($planner.solve_observed(query, &mut quiet).unwrap(), counted, "{}", case());
                    assert_eq!(u64::from(u32::MAX - quiet.left), counters.expanded, "{}", case());
                    let (path, has_switched) = in_parts(&mut $planner, query, expansions);
                    assert_eq!(path.as_ref(), counted.path(), "in parts, {}", case());
                    updated += counters.updated;
                    switched += u32::from(has_switched);
                };
            }
            check!(blocks);
            check!(lists);
            check!(all);
        }
        (updated, switched)
    });
    let (updated, switched) = parts.iter().fold((0, 0), |sums, part| (sums.0 + part.0, sums.1 + part.1));
    assert!(updated > 1000 && switched > 50, "{updated}, {switched}");
}
