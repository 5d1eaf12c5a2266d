//! Every engine against Dijkstra on explicit graphs, that of N(k) and that of all legal segments, on seeded
//! random maps.

use std::sync::Arc;

use mediant_grid::{CornerRule, Grid, Rules, Vertex};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{
    Explicit, Rng, describe, is_exhaustive, maps_of_nine_cells, on_all_cores, random_free_vertex, suite_grid,
    validate,
};
use mediant_search::{Answer, Counters, Ends, Guarantee, Path, QueryError};

use crate::common::{TestedEngine, with_any_angle_engines, with_engines};

/// The maps of the default run.
const MAPS: u64 = 36;

fn seeds() -> std::ops::Range<u64> {
    mediant_oracle::seeds(MAPS)
}

/// The largest k of the suite of all engines. Making the five pruning rules of k = 7 takes longer than all
/// maps of the default run, which leaves them to longer ones.
fn largest_k() -> u32 {
    if seeds().end > MAPS { 8 } else { 6 }
}

/// Six queries on a map: three goals for each of two starts.
fn queries(grid: &Grid, rules: Rules, seed: u64) -> Vec<(Vertex, Vec<Vertex>)> {
    let mut rng = Rng::new(seed ^ 0x5EED);
    let mut free = || random_free_vertex(&mut rng, grid, rules.placement());
    (0..2).filter_map(|_| Some((free()?, (0..3).filter_map(|_| free()).collect()))).collect()
}

/// The engines that search prepared graphs are checked on one map in so many: the crates of these engines
/// have long suites of their own.
const PREPARED: u64 = 5;

/// How a query with a path was answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Found {
    /// By a path.
    Path,
    /// By a path, after the search left its plan.
    OffPlan,
    /// By a path between two different vertices, of an engine that may give up.
    AsPublished,
    /// By giving up.
    GaveUp,
}

/// The number of queries of each kind.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    found: usize,
    unreachable: usize,
    off_plan: usize,
    as_published: usize,
    gave_up: usize,
}

impl Tally {
    fn add(self, other: Self) -> Self {
        Self {
            found: self.found + other.found,
            unreachable: self.unreachable + other.unreachable,
            off_plan: self.off_plan + other.off_plan,
            as_published: self.as_published + other.as_published,
            gave_up: self.gave_up + other.gave_up,
        }
    }
}

/// A query on a map, with the costs of its optimal paths.
struct Case<'g> {
    grid: &'g Grid,
    rules: Rules,
    start: Vertex,
    goal: Vertex,
    seed: u64,
    /// The optimum over the moves of the engines; `None` where there is no path.
    optimum: Option<f64>,
    /// The any-angle optimum.
    any_angle: Option<f64>,
}

impl Case<'_> {
    /// Checks the answer of an engine against its guarantee. Returns how it was answered; `None` where there
    /// is no path.
    fn check(&self, engine: &mut TestedEngine<'_>) -> Option<Found> {
        let Self { grid, rules, start, goal, seed, .. } = *self;
        let answer = engine.solve(Ends::new(start, goal));
        let case = || format!("{}; {}", engine.name, describe(grid, rules, start, goal, seed));
        let (answer, counters) = match answer {
            Ok(answer) => answer,
            Err(QueryError::GaveUp { .. }) if engine.may_give_up && self.optimum.is_some() => {
                return Some(Found::GaveUp);
            }
            Err(error) => panic!("{error}: {}", case()),
        };
        let cost = answer.path().map(Path::cost);
        assert!(!cost.is_some_and(f64::is_sign_negative), "cost {cost:?}: {}", case());
        // At k = 2 where corners are always cut, segments connect more than moves.
        let is_of_segments = ["theta", "lazy-theta"].iter().any(|name| engine.name.starts_with(name));
        let best = if is_of_segments { self.any_angle } else { self.optimum };
        assert_eq!(cost.is_some(), best.is_some(), "{cost:?}, Dijkstra {best:?}: {}", case());
        let Answer::Found(path) = answer else {
            // The components know without a search.
            assert_eq!(counters, Counters::default(), "{}", case());
            return None;
        };
        let fault = validate(grid, rules, engine.paths.finite(), start, goal, path.waypoints(), path.cost());
        assert_eq!(fault, Ok(()), "{}", case());
        let [optimum, any_angle] = [self.optimum, self.any_angle].map(|cost| cost.unwrap_or(f64::NAN));
        let (least, most) = match engine.guarantee {
            Guarantee::Optimal(_) | Guarantee::Cheapest(_) => (optimum, optimum),
            Guarantee::AtMost(_) | Guarantee::AtMostCheapest(_) => (any_angle, optimum),
            Guarantee::OptimalAnyAngle => (any_angle, any_angle),
            Guarantee::Suboptimal if engine.paths == K::Any => (any_angle, f64::INFINITY),
            Guarantee::Suboptimal => (optimum, f64::INFINITY),
        };
        let (cost, slack) = (path.cost(), 1.0 + 1e-9);
        assert!(least <= cost * slack && cost <= most * slack, "{least} ≤ {cost} ≤ {most}: {}", case());
        // The lower bound of all paths that follows from this one.
        let certain = engine.guarantee.lower_bound(rules, cost, start.distance(goal));
        assert!(certain <= any_angle * slack, "certified {certain}, any-angle {any_angle}: {}", case());
        Some(match engine.may_give_up {
            true if start != goal => Found::AsPublished,
            _ if counters.fallbacks > 0 => Found::OffPlan,
            _ => Found::Path,
        })
    }
}

/// All engines on the map of one seed.
fn check_all(seed: u64) -> Tally {
    let mut tally = Tally::default();
    let grid = Arc::new(suite_grid(seed).0);
    for rules in Rules::ALL {
        let any_angle = Explicit::new(&grid, rules, None);
        let queries = queries(&grid, rules, seed);
        let mut run = |graph: &Explicit, mut engines: Vec<TestedEngine<'_>>| {
            for (start, goals) in &queries {
                let (costs, best) = (graph.costs_from(*start), any_angle.costs_from(*start));
                for &goal in goals {
                    let (optimum, any_angle) = (costs.to(goal), best.to(goal));
                    let case = Case { grid: &grid, rules, start: *start, goal, seed, optimum, any_angle };
                    let all = seed.is_multiple_of(PREPARED);
                    for engine in engines.iter_mut().filter(|engine| all || !engine.is_prepared) {
                        match case.check(engine) {
                            None | Some(Found::Path) => {}
                            Some(Found::OffPlan) => tally.off_plan += 1,
                            Some(Found::AsPublished) => tally.as_published += 1,
                            Some(Found::GaveUp) => tally.gave_up += 1,
                        }
                    }
                    *(if optimum.is_some() { &mut tally.found } else { &mut tally.unreachable }) += 1;
                }
            }
        };
        for k in 2..=largest_k() {
            let graph = Explicit::new(&grid, rules, FiniteK::new(k).ok());
            with_engines(&grid, rules, k, |engines| run(&graph, engines));
        }
        if let Rules::Corner(gap) = rules {
            with_any_angle_engines(&grid, gap, |engines| run(&any_angle, engines));
        }
    }
    tally
}

#[test]
fn engines_cost_what_dijkstra_on_the_explicit_graph_costs() {
    let parts: Vec<Tally> = on_all_cores(seeds(), check_all);
    let Tally { found, unreachable, off_plan, as_published, gave_up } =
        parts.iter().copied().fold(Tally::default(), Tally::add);
    // A generator that went wrong must not make the suite empty.
    let maps = seeds().end as usize;
    assert_eq!(parts.len(), maps);
    assert!(found > 100 * maps && unreachable > 10 * maps, "{found} found, {unreachable} unreachable");
    // Some plans must fail, also those of CHPA* as published, but most must not.
    let maps = maps.div_ceil(PREPARED as usize);
    assert!(
        off_plan > 5 * maps && as_published > 5 * maps,
        "{off_plan} off plan, {as_published} as published"
    );
    assert!(2 * gave_up > maps && 2 * gave_up < as_published, "{gave_up} given up");
}

/// From every vertex to every other.
#[test]
fn engines_are_exact_on_every_map_of_nine_cells() {
    let mut queries = 0;
    for grid in maps_of_nine_cells(7).map(|(_, grid)| Arc::new(grid)) {
        for rules in Rules::ALL {
            let any_angle = Explicit::new(&grid, rules, None);
            let mut run = |graph: &Explicit, mut engines: Vec<TestedEngine<'_>>| {
                for start in graph.free_vertices() {
                    let (costs, best) = (graph.costs_from(start), any_angle.costs_from(start));
                    for goal in graph.free_vertices() {
                        let (optimum, any_angle) = (costs.to(goal), best.to(goal));
                        let case = Case { grid: &grid, rules, start, goal, seed: 0, optimum, any_angle };
                        // The first engine on all pairs, the others in turn.
                        let turn = 1 + queries % (engines.len() - 1);
                        [0, turn].into_iter().for_each(|i| _ = case.check(&mut engines[i]));
                        queries += 1;
                    }
                }
            };
            for k in 2..=4 {
                let graph = Explicit::new(&grid, rules, FiniteK::new(k).ok());
                with_engines(&grid, rules, k, |engines| run(&graph, engines));
            }
            if let Rules::Corner(gap) = rules {
                with_any_angle_engines(&grid, gap, |engines| run(&any_angle, engines));
            }
        }
    }
    assert_eq!(queries, if is_exhaustive() { 698_240 } else { 101_481 });
}

/// The suboptimality bound of paths over N(k), as a multiple of the any-angle optimum under the same rules:
/// Kramm 2018, Theorem 2 at corners, Theorem 3 at centers. In Theorem 3 moves may touch corners: it fails
/// under `Never`, where (2, 1) can be legal and (1, 1) not, and at k = 2 under `Always`, since no axis moves
/// lead between two blocked cells that touch diagonally.
fn bound(rules: Rules, k: u32) -> f64 {
    let number = FiniteK::new(k).expect("k is at least 2");
    match rules {
        Rules::Corner(_) | Rules::CenterGap(_) => mediant_moves::bound_at_corners(number),
        Rules::Center(CornerRule::Never) => mediant_moves::BOUND_WITHOUT_CORNER_CUTTING,
        Rules::Center(CornerRule::Always) if k == 2 => f64::INFINITY,
        Rules::Center(_) => mediant_moves::bound_at_centers(number),
    }
}

/// Any-angle ≤ k + 1 ≤ k ≤ bound · any-angle, among obstacles. (At centers the papers' any-angle paths may
/// also bend at cell corners; the reference here bends at centers only.)
#[test]
fn costs_fall_with_k_and_stay_within_the_bound() {
    let mut tight = [0, 0];
    for seed in 0..seeds().end.min(300) {
        let grid = Arc::new(suite_grid(seed).0);
        for rules in Rules::ALL {
            let any_angle = Explicit::new(&grid, rules, None);
            let mut cases = Vec::new();
            for (start, goals) in queries(&grid, rules, seed) {
                let costs = any_angle.costs_from(start);
                let reached = goals.into_iter().filter_map(|goal| Some((goal, costs.to(goal)?)));
                cases.extend(reached.map(|(goal, best)| (start, goal, best, f64::INFINITY)));
            }
            for k in 2..=8 {
                with_engines(&grid, rules, k, |mut engines| {
                    for (start, goal, best, last) in &mut cases {
                        let answer = engines[0].solve(Ends::new(*start, *goal));
                        let (answer, _) = answer.expect("both ends are free");
                        let cost = answer.path().map_or(f64::INFINITY, Path::cost);
                        // Not as a product where there is no bound: the optimum may be 0.
                        let limit =
                            if bound(rules, k).is_finite() { *best * bound(rules, k) } else { f64::INFINITY };
                        let slack = 1.0 + 1e-9;
                        assert!(
                            *best <= cost * slack && cost <= *last * slack && cost <= limit * slack,
                            "k = {k}: any-angle {best}, k - 1 {last}, k {cost}, bound {limit}; {}",
                            describe(&grid, rules, *start, *goal, seed)
                        );
                        tight[usize::from(cost > *best * slack)] += 1;
                        *last = cost;
                    }
                });
            }
        }
    }
    assert!(tight.iter().all(|&cases| cases > 1_000), "too few cases: {tight:?}");
}
