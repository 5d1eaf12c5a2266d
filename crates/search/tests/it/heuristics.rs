//! Heuristics: that they are lower bounds, and close ones; A* with one that is inconsistent, and with one
//! that is inadmissible; and searches within a limit.

use std::{collections::HashMap, sync::Arc};

use mediant_grid::{Centers, Corners, DiagonalGap, Grid, GridGraph, Placement, Rules, Vector, Vertex};
use mediant_moves::{Cost, FiniteK, Neighborhood};
use mediant_oracle::{Explicit, Rng, describe, random_free_vertex, seeds, suite_grid, validate};
use mediant_search::{
    AStar, Answer, Counters, Ends, Euclidean, FieldQuery, Fields, Guarantee, Heuristic, Hk, NodeEvent,
    Observer, Planner, SquaredEuclidean, Zero,
};

/// h_k at every other vertex, as on a checkerboard, and half of it at the others: a lower bound, but
/// inconsistent. (With 0 at the others, only these would be reopened.)
#[derive(Clone, Copy)]
struct Checkered;

impl Heuristic for Checkered {
    fn estimate<P: Placement>(self, grid_graph: &GridGraph<P>, to_goal: Vector) -> Cost {
        let h = Hk.estimate(grid_graph, to_goal);
        if (to_goal.x + to_goal.y) % 2 == 0 { Cost::from_bits(h.to_bits() / 2) } else { h }
    }
}

/// How often each vertex was expanded, with the g of its last expansion; and all events.
#[derive(Default)]
struct Log {
    expansions: HashMap<Vertex, (u32, Cost)>,
    events: Vec<NodeEvent>,
}

impl Observer for Log {
    fn generated(&mut self, node: NodeEvent) {
        self.events.push(node);
    }

    fn updated(&mut self, node: NodeEvent) {
        self.events.push(node);
    }

    fn expanded(&mut self, node: NodeEvent) {
        let (times, g) = self.expansions.entry(node.at).or_insert((0, Cost::MAX));
        assert!(node.g < *g, "{} was expanded again, and not at a lower cost", node.at);
        (*times, *g) = (*times + 1, node.g);
        self.events.push(node);
    }
}

/// Six pairs of free vertices.
fn queries(grid: &Grid, rules: Rules, seed: u64) -> Vec<(Vertex, Vertex)> {
    let mut rng = Rng::new(seed ^ 0xB0B);
    let mut free = || random_free_vertex(&mut rng, grid, rules.placement());
    (0..6).filter_map(|_| Some((free()?, free()?))).collect()
}

/// Compares with Dijkstra. Returns the number of vertices that were expanded more than once.
fn reopened<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, k: FiniteK, seed: u64) -> usize {
    let grid_graph = GridGraph::<P>::new(Arc::clone(grid), k, rule).expect("k is in range");
    let graph = Explicit::new(grid, grid_graph.rules(), Some(k));
    let mut planner = AStar::new(&grid_graph, Checkered);
    let mut reopened = 0;
    for (start, goal) in queries(grid, grid_graph.rules(), seed) {
        let mut log = Log::default();
        let answer = planner.solve_observed(Ends::new(start, goal), &mut log);
        let cost = answer.expect("both ends are free").path().map(|path| path.cost());
        let agrees = match (cost, graph.costs_from(start).to(goal)) {
            (Some(cost), Some(best)) => (cost - best).abs() <= best * 1e-9,
            (None, None) => true,
            _ => false,
        };
        assert!(agrees, "k = {k}: {cost:?}; {}", describe(grid, grid_graph.rules(), start, goal, seed));
        for node in log.events {
            // Also when a node enters the open list again.
            assert_eq!(
                node.f,
                node.g + Checkered.estimate(&grid_graph, node.at.to(goal)),
                "seed {seed}: {node:?}"
            );
        }
        reopened += log.expansions.values().filter(|(times, _)| *times > 1).count();
    }
    reopened
}

#[test]
fn a_star_reopens_nodes_and_is_optimal_with_an_inconsistent_heuristic() {
    for k in 2..=5 {
        let number = FiniteK::new(k).expect("k is at least 2");
        let mut seen = 0;
        for seed in seeds(120) {
            let grid = Arc::new(suite_grid(seed).0);
            for rules in Rules::ALL {
                seen += match rules {
                    Rules::Center(corners) => reopened::<Centers>(&grid, corners, number, seed),
                    Rules::Corner(gap) | Rules::CenterGap(gap) => {
                        reopened::<Corners>(&grid, gap, number, seed)
                    }
                };
            }
        }
        assert!(seen > 100, "k = {k}: only {seen} nodes were reopened");
    }
}

/// Every vertex of a path: the ends of all its moves.
fn vertices<P: Placement>(grid_graph: &GridGraph<P>, waypoints: &[Vertex]) -> Vec<Vertex> {
    let mut all = vec![waypoints[0]];
    for ends in waypoints.windows(2) {
        let by = ends[0].to(ends[1]);
        let is_step = |v: &Vector| v.x * by.y == v.y * by.x && v.x * by.x + v.y * by.y > 0;
        let step =
            Neighborhood::new(grid_graph.k()).expect("k is in range").iter().find(is_step).expect("a move");
        while *all.last().expect("the start") != ends[1] {
            all.push(*all.last().expect("the start") + step);
        }
    }
    all
}

/// Compares the estimates along paths with the costs. Returns the number of vertices on the paths found.
fn check_bounds<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, k: FiniteK, seed: u64) -> usize {
    let grid_graph = GridGraph::<P>::new(Arc::clone(grid), k, rule).expect("k is in range");
    let (mut guided, mut blind) = (AStar::new(&grid_graph, Hk), AStar::new(&grid_graph, Zero));
    let mut seen = 0;
    for (start, goal) in queries(grid, grid_graph.rules(), seed) {
        let case = || format!("k = {k}; {}", describe(grid, grid_graph.rules(), start, goal, seed));
        let (query, mut few, mut many) = (Ends::new(start, goal), Counters::default(), Counters::default());
        let answer = guided.solve_observed(query, &mut few).expect("both ends are free");
        blind.solve_observed(query, &mut many).expect("both ends are free");
        // Every vertex with f ≤ the optimum, except the goal, has a g below the optimum.
        assert!(few.expanded <= many.expanded, "{few:?}, {many:?}; {}", case());
        let Answer::Found(path) = answer else { continue };
        let mut rest = Cost::ZERO;
        let way = vertices(&grid_graph, path.waypoints());
        for (i, &at) in way.iter().enumerate().rev() {
            rest = way.get(i + 1).map_or(rest, |&next| rest + Cost::of_move(at.to(next)));
            let (h, straight) =
                (Hk.estimate(&grid_graph, at.to(goal)), Euclidean.estimate(&grid_graph, at.to(goal)));
            assert!(h <= rest, "h_k = {h:?} > {rest:?} at {at}; {}", case());
            assert!(straight <= rest, "Euclidean {straight:?} > {rest:?} at {at}; {}", case());
            seen += 1;
        }
    }
    seen
}

#[test]
fn no_estimate_exceeds_the_cost_along_a_path() {
    let mut seen = 0;
    for seed in seeds(100) {
        let grid = Arc::new(suite_grid(seed).0);
        for (rules, k) in Rules::ALL.into_iter().flat_map(|rules| [2, 3, 4, 6, 8].map(|k| (rules, k))) {
            let k = FiniteK::new(k).expect("k is at least 2");
            seen += match rules {
                Rules::Center(corners) => check_bounds::<Centers>(&grid, corners, k, seed),
                Rules::Corner(gap) | Rules::CenterGap(gap) => check_bounds::<Corners>(&grid, gap, k, seed),
            };
        }
    }
    assert!(seen > 30_000, "only {seen} vertices");
}

/// When a move is repeated, its rounding adds up.
#[test]
fn the_straight_line_is_a_bound_and_a_close_one() {
    let grid = Arc::new(Grid::from_fn(1, 1, |_, _| false).expect("a valid size"));
    let k = FiniteK::new(8).expect("k is at least 2");
    let grid_graph = GridGraph::<Centers>::new(grid, k, Default::default()).expect("k is in range");
    let mut rounded_down = 0;
    for v in Neighborhood::new(k).expect("k is in range").iter() {
        let length = Cost::of_move(v);
        rounded_down += usize::from(length.to_f64() < v.norm());
        for n in (1..100).chain([1_000, 1_500]) {
            let d = Vector::new(n * v.x, n * v.y);
            let straight = Euclidean.estimate(&grid_graph, d);
            let cost = Cost::from_bits(n as u64 * length.to_bits());
            assert!(straight <= cost, "{n} times {v:?}: {straight:?} > {cost:?}");
            let least = d.norm() * (1.0 - 2.0_f64.powi(-30));
            assert!(straight.to_f64() >= least, "{n} times {v:?}: {straight:?} is far below {}", d.norm());
        }
    }
    assert!(rounded_down > 50, "only {rounded_down} moves cost less than their length");
    for h in
        [Euclidean.estimate(&grid_graph, Vector::new(0, 0)), Zero.estimate(&grid_graph, Vector::new(9, 9))]
    {
        assert_eq!(h, Cost::ZERO);
    }
}

/// Returns the number of queries with a path, of those whose path is not optimal, and of the vertices
/// expanded again.
fn check_squared<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, k: FiniteK, seed: u64) -> [usize; 3] {
    let grid_graph = GridGraph::<P>::new(Arc::clone(grid), k, rule).expect("k is in range");
    let (rules, graph) = (grid_graph.rules(), Explicit::new(grid, grid_graph.rules(), Some(k)));
    let mut planner = AStar::new(&grid_graph, SquaredEuclidean);
    assert_eq!(planner.guarantee(), Guarantee::Suboptimal);
    let [mut found, mut longer, mut again] = [0; 3];
    for (start, goal) in queries(grid, rules, seed) {
        let case = || format!("k = {k}; {}", describe(grid, rules, start, goal, seed));
        let mut log = Log::default();
        let answer = planner.solve_observed(Ends::new(start, goal), &mut log).expect("both ends are free");
        let best = graph.costs_from(start).to(goal);
        assert_eq!(answer.path().is_some(), best.is_some(), "{}", case());
        for node in log.events {
            let d = node.at.to(goal);
            let h = Cost::from_bits(d.norm_squared() << Cost::FRACTION_BITS);
            assert_eq!(node.f, node.g + h, "{node:?}; {}", case());
        }
        let (Answer::Found(path), Some(best)) = (answer, best) else { continue };
        let fault = validate(grid, rules, Some(k), start, goal, path.waypoints(), path.cost());
        assert_eq!(fault, Ok(()), "{}", case());
        assert!(path.cost() >= best * (1.0 - 1e-9), "{} < {best}; {}", path.cost(), case());
        found += 1;
        longer += usize::from(path.cost() > best * (1.0 + 1e-9));
        again += log.expansions.values().filter(|(times, _)| *times > 1).count();
    }
    assert!(grid_graph.has_closed_gaps() || again == 0, "{again} vertices were expanded again, seed {seed}");
    [found, longer, again]
}

#[test]
fn a_star_finds_a_path_by_a_heuristic_that_overestimates_whenever_there_is_one() {
    for rules in Rules::ALL {
        let mut seen = [0; 3];
        for (seed, k) in seeds(100).flat_map(|seed| (2..=8).map(move |k| (seed, k))) {
            let grid = Arc::new(suite_grid(seed).0);
            let k = FiniteK::new(k).expect("k is at least 2");
            let more = match rules {
                Rules::Center(corners) => check_squared::<Centers>(&grid, corners, k, seed),
                Rules::Corner(gap) | Rules::CenterGap(gap) => check_squared::<Corners>(&grid, gap, k, seed),
            };
            seen.iter_mut().zip(more).for_each(|(seen, more)| *seen += more);
        }
        let [found, longer, again] = seen;
        assert!(
            found > 2_000 && longer > found / 20 && longer < found,
            "{rules}: {longer} of {found} longer"
        );
        // At closed gaps successors depend on the arriving move, so closed nodes are reopened there.
        let reopens = rules == Rules::Corner(DiagonalGap::Closed);
        assert_eq!(again > 0, reopens, "{rules}: {again} vertices were expanded again");
    }
}

/// Searches within limits around the optimum. Returns how many found a path, and how many found none although
/// there is one.
fn check_within<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, k: FiniteK, seed: u64) -> [usize; 2] {
    let grid_graph = GridGraph::<P>::new(Arc::clone(grid), k, rule).expect("k is in range");
    let (mut rng, mut seen) = (Rng::new(seed ^ 0x11111), [0; 2]);
    for (start, goal) in queries(grid, grid_graph.rules(), seed) {
        let distances = Fields::new(&grid_graph).field(FieldQuery::new(&[start])).expect("a free start");
        let best = distances.get(goal);
        let mut limits = vec![Cost::ZERO, Cost::MAX];
        if let Some(best) = best {
            let bits = best.to_bits();
            limits.extend([bits, bits + 1, bits.saturating_sub(1), bits / 2].map(Cost::from_bits));
            limits.extend((0..3).map(|_| Cost::from_bits(rng.bits() % (2 * bits + 1))));
        }
        for limit in limits {
            let case = || {
                format!(
                    "k = {k}, within {limit:?}; {}",
                    describe(grid, grid_graph.rules(), start, goal, seed)
                )
            };
            let is_within = best.is_some_and(|best| best <= limit);
            let query = Ends::new(start, goal);
            let mut few = Counters::default();
            let answers = [
                AStar::new(&grid_graph, Hk).solve_within(query, limit, &mut few),
                AStar::new(&grid_graph, Euclidean).solve_within(query, limit, &mut ()),
                AStar::new(&grid_graph, Checkered).solve_within(query, limit, &mut ()),
                AStar::new(&grid_graph, Zero).solve_within(query, limit, &mut ()),
            ];
            for answer in answers {
                let path = answer.expect("both ends are free");
                assert_eq!(path.is_some(), is_within, "{path:?}; {}", case());
                let Some((path, best)) = path.zip(best) else { continue };
                assert!(
                    (path.cost() - best.to_f64()).abs() < 1e-6,
                    "{} and not {best:?}; {}",
                    path.cost(),
                    case()
                );
                let fault =
                    validate(grid, grid_graph.rules(), Some(k), start, goal, path.waypoints(), path.cost());
                assert_eq!(fault, Ok(()), "{}", case());
            }
            // Nothing through which every path is longer is expanded.
            let mut all = Counters::default();
            AStar::new(&grid_graph, Hk).solve_within(query, Cost::MAX, &mut all).expect("free ends");
            assert!(few.expanded <= all.expanded, "{few:?}, {all:?}; {}", case());
            if best.is_some() {
                seen[usize::from(!is_within)] += 1;
            }
        }
    }
    seen
}

#[test]
fn a_path_is_found_within_a_limit_if_the_shortest_is() {
    let mut seen = [0; 2];
    for seed in seeds(10) {
        let grid = Arc::new(suite_grid(seed).0);
        for (rules, k) in Rules::ALL.into_iter().flat_map(|rules| [2, 3, 5].map(|k| (rules, k))) {
            let k = FiniteK::new(k).expect("k is at least 2");
            let more = match rules {
                Rules::Center(corners) => check_within::<Centers>(&grid, corners, k, seed),
                Rules::Corner(gap) | Rules::CenterGap(gap) => check_within::<Corners>(&grid, gap, k, seed),
            };
            seen.iter_mut().zip(more).for_each(|(seen, more)| *seen += more);
        }
    }
    assert!(seen.iter().all(|&cases| cases > 1_000), "too few cases: {seen:?}");
}
