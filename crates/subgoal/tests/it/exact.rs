//! Sub-A* costs what the references cost, and Sub-Theta* finds a path whenever there is one, on seeded random
//! maps.

use mediant_grid::{Centers, CornerRule, Corners, FreeSpace, Grid, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{
    Explicit, Rng, Visibility, describe, is_exhaustive, is_gap, maps_of_nine_cells, on_all_cores,
    random_free_vertex, seeds, suite_grid, validate, vertex_is_free,
};
use mediant_search::{Answer, Counters, Ends, Guarantee, Path, Planner};
use mediant_subgoal::{Hierarchy, SubgoalAStar, SubgoalGraph, SubgoalPlacement, SubgoalTheta};

use crate::common::{GAPS, HIERARCHIES, all_ks, graph, k, space};

/// A query, and what the references say of it.
#[derive(Clone, Copy)]
struct Expected {
    start: Vertex,
    goal: Vertex,
    /// The optimum over N(k); `None` where there is no path.
    optimum: Option<f64>,
    /// The any-angle optimum.
    any_angle: Option<f64>,
}

/// The number of answers of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Tally {
    found: usize,
    unreachable: usize,
    /// Paths of Sub-Theta* that are the shortest at any angle, and others.
    shortest: usize,
    longer: usize,
}

impl Tally {
    fn add(&mut self, other: Self) {
        self.found += other.found;
        self.unreachable += other.unreachable;
        self.shortest += other.shortest;
        self.longer += other.longer;
    }
}

/// A graph under test, with what the message of a failure needs.
struct Suite<'t, P: SubgoalPlacement> {
    space: &'t FreeSpace<P>,
    graph: SubgoalGraph<P>,
    seed: u64,
}

impl<'t, P: SubgoalPlacement> Suite<'t, P> {
    fn new(space: &'t FreeSpace<P>, k: K, hierarchy: Hierarchy, seed: u64) -> Self {
        Self { space, graph: graph(space, k, hierarchy), seed }
    }

    /// Runs both planners on all queries of a map. Each query meets the scratch memory that the queries
    /// before it left.
    fn check(&self, queries: &[Expected]) -> Tally {
        let mut tally = Tally::default();
        let mut a_star = SubgoalAStar::new(self.space, &self.graph).expect("the graph is for this space");
        let mut theta = SubgoalTheta::new(self.space, &self.graph).expect("the graph is for this space");
        let optimal = match self.graph.k() {
            K::Finite(k) => Guarantee::Optimal(k),
            K::Any => Guarantee::OptimalAnyAngle,
        };
        assert_eq!((a_star.guarantee(), theta.guarantee()), (optimal, Guarantee::Suboptimal));
        for query in queries {
            let slack = 1.0 + 1e-9;
            let found = self.solve(&mut a_star, query, self.graph.k());
            assert_eq!(found.is_some(), query.optimum.is_some(), "{found:?}; {}", self.case(query));
            if let Some((cost, _)) = found {
                let best = query.optimum.unwrap_or(f64::NAN);
                let is_optimal = cost <= best * slack && best <= cost * slack;
                assert!(is_optimal, "Sub-A* {cost}, reference {best}; {}", self.case(query));
                tally.found += 1;
            } else {
                tally.unreachable += 1;
            }
            let found = self.solve(&mut theta, query, K::Any);
            // At centers N(2) may hold no path though one cell sees the other.
            let is_right = found.is_some() || query.optimum.is_none();
            assert!(is_right, "{found:?}; {}", self.case(query));
            if let Some((cost, counters)) = found {
                let best = query.any_angle.unwrap_or(f64::NAN);
                assert!(best <= cost * slack, "Sub-Theta* {cost} < {best}; {}", self.case(query));
                let searched = counters != Counters::default();
                assert!(
                    !searched || counters.generated > counters.expanded,
                    "{counters:?}; {}",
                    self.case(query)
                );
                *if cost <= best * slack { &mut tally.shortest } else { &mut tally.longer } += 1;
            }
        }
        tally
    }

    /// Solves a query twice and checks the path. Returns its cost and the counters, or `None` if there is no
    /// path.
    fn solve(&self, planner: &mut impl Planner, expected: &Expected, k: K) -> Option<(f64, Counters)> {
        let Expected { start, goal, .. } = *expected;
        let mut solve = || {
            let mut counters = Counters::default();
            let answer = planner.solve_observed(Ends::new(start, goal), &mut counters);
            (answer.expect("both ends are free"), counters)
        };
        let (answer, counters) = solve();
        assert_eq!(solve(), (answer.clone(), counters), "asked again; {}", self.case(expected));
        let cost = answer.path().map(Path::cost);
        let Answer::Found(path) = answer else {
            // If there is no path at any angle, the components tell so without a search.
            let searched = counters != Counters::default();
            assert!(!searched || expected.any_angle.is_some(), "{}", self.case(expected));
            return None;
        };
        let (grid, rules, way) = (self.space.grid(), self.space.rules(), path.waypoints());
        let fault = validate(grid, rules, k.finite(), start, goal, way, path.cost());
        assert_eq!(fault, Ok(()), "{way:?}; {}", self.case(expected));
        let turns = |at: &[Vertex]| at[0].to(at[1]).det(at[1].to(at[2])) != 0;
        assert!(way.windows(3).all(turns), "{way:?} goes straight on; {}", self.case(expected));
        cost.map(|cost| (cost, counters))
    }

    fn case(&self, &Expected { start, goal, .. }: &Expected) -> String {
        let (k, hierarchy) = (self.graph.k(), self.graph.hierarchy());
        let map = describe(self.space.grid(), self.space.rules(), start, goal, self.seed);
        format!("k = {k}, {hierarchy:?}; {map}")
    }
}

/// Free vertices of a map, as ends of queries: some convex corners, some where two blocked cells meet, some
/// of all.
pub(crate) fn ends(grid: &Grid, corners: &[Vertex], seed: u64) -> Vec<Vertex> {
    let mut rng = Rng::new(seed ^ 0x5AB6);
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    let vertices = (0..=height).flat_map(|y| (0..=width).map(move |x| Vertex::new(x, y)));
    let is_closed_gap = |&at: &Vertex| is_gap(grid, at) && vertex_is_free(grid, PlacementKind::Corner, at);
    let gaps: Vec<Vertex> = vertices.filter(is_closed_gap).collect();
    let special = [corners, &gaps, corners].map(|of| rng.pick(of).copied());
    let any = (0..3).map(|_| random_free_vertex(&mut rng, grid, PlacementKind::Corner));
    special.into_iter().chain(any.collect::<Vec<_>>()).flatten().collect()
}

/// The queries from each of the vertices to each, with their optima.
fn expected_at(visibility: &Visibility<'_>, ends: &[Vertex], k: K) -> Vec<Expected> {
    let (over_k, any) = (visibility.over(k.finite()), visibility.over(None));
    let mut expected = Vec::new();
    for &start in ends {
        let (costs, best) = (over_k.costs_from(start), any.costs_from(start));
        let to = |&goal: &Vertex| {
            let (optimum, any_angle) = (costs.to(goal), best.to(goal));
            Expected { start, goal, optimum, any_angle }
        };
        expected.extend(ends.iter().map(to));
    }
    expected
}

fn check_corners(seed: u64) -> Tally {
    let mut tally = Tally::default();
    let grid = suite_grid(seed).0;
    for gap in GAPS {
        let space = space::<Corners>(&grid, gap);
        let visibility = Visibility::new(&grid, gap);
        let ends = ends(&grid, visibility.corners(), seed);
        for (turn, k) in (0..).zip(all_ks()) {
            let expected = expected_at(&visibility, &ends, k);
            // Each k has one of the hierarchies; all have their turn.
            let hierarchy = HIERARCHIES[(seed as usize + turn) % HIERARCHIES.len()];
            tally.add(Suite::new(&space, k, hierarchy, seed).check(&expected));
        }
    }
    tally
}

fn sum(tallies: &[Tally]) -> Tally {
    let mut sum = Tally::default();
    tallies.iter().for_each(|&part| sum.add(part));
    assert!(sum.found <= sum.shortest + sum.longer, "{sum:?}");
    sum
}

#[test]
fn sub_a_star_costs_what_the_visibility_graph_costs() {
    let tallies = on_all_cores(seeds(150), check_corners);
    // A generator that went wrong must not make the suite empty.
    let (maps, tally) = (seeds(150).end as usize, sum(&tallies));
    assert_eq!(tallies.len(), maps);
    assert!(tally.found > 200 * maps && tally.unreachable > 30 * maps, "{tally:?} on {maps} maps");
    assert!(tally.shortest > 200 * maps && tally.longer > 2 * maps, "{tally:?} on {maps} maps");
}

/// Compares the planners with Dijkstra on the explicit graphs of N(k) and of all segments.
fn check_explicitly<P: SubgoalPlacement>(
    grid: &Grid,
    rule: P::Rule,
    k: K,
    hierarchy: Hierarchy,
    seed: u64,
) -> Tally {
    let space = space::<P>(grid, rule);
    let [over_k, any] = [k, K::Any].map(|k| Explicit::new(grid, space.rules(), k.finite()));
    let vertices: Vec<Vertex> = over_k.free_vertices().collect();
    // All pairs of a small map.
    let step = 1 + vertices.len() / 16;
    let mut expected = Vec::new();
    for &start in vertices.iter().skip(seed as usize % step).step_by(step) {
        let (costs, best) = (over_k.costs_from(start), any.costs_from(start));
        for &goal in vertices.iter().step_by(step) {
            let (optimum, any_angle) = (costs.to(goal), best.to(goal));
            expected.push(Expected { start, goal, optimum, any_angle });
        }
    }
    Suite::new(&space, k, hierarchy, seed).check(&expected)
}

fn check_rules_explicitly(grid: &Grid, rules: Rules, k: K, hierarchy: Hierarchy, seed: u64) -> Tally {
    match rules {
        Rules::Corner(gap) | Rules::CenterGap(gap) => {
            check_explicitly::<Corners>(grid, gap, k, hierarchy, seed)
        }
        Rules::Center(corners) => check_explicitly::<Centers>(grid, corners, k, hierarchy, seed),
    }
}

/// The rules under which there are subgoal graphs for this k.
pub(crate) fn rules_of(k: K) -> impl Iterator<Item = Rules> {
    let at_centers = match k.finite().map(FiniteK::get) {
        Some(2) => &[CornerRule::Never, CornerRule::One, CornerRule::Always][..],
        Some(3) => &[CornerRule::Never],
        _ => &[],
    };
    GAPS.map(Rules::Corner).into_iter().chain(at_centers.iter().map(|&corners| Rules::Center(corners)))
}

#[test]
fn sub_a_star_costs_what_dijkstra_on_the_explicit_graph_costs() {
    let check = |seed: u64| {
        let mut tally = Tally::default();
        let (grid, k) = (suite_grid(seed).0, [k(2), k(3), k(4), K::Any][seed as usize % 4]);
        // On large maps the graph of all segments takes too long.
        if grid.width() * grid.height() > 200 {
            return tally;
        }
        for rules in rules_of(k) {
            let hierarchy = HIERARCHIES[seed as usize / 4 % HIERARCHIES.len()];
            tally.add(check_rules_explicitly(&grid, rules, k, hierarchy, seed));
        }
        tally
    };
    let tallies = on_all_cores(seeds(200), check);
    let (maps, tally) = (seeds(200).end as usize, sum(&tallies));
    assert_eq!(tallies.len(), maps);
    assert!(tally.found > 150 * maps && tally.unreachable > 40 * maps, "{tally:?} on {maps} maps");
    assert!(2 * tally.longer > maps, "{tally:?} on {maps} maps");
}

#[test]
fn all_is_exact_on_every_map_of_nine_cells() {
    let maps: Vec<_> = maps_of_nine_cells(5).collect();
    let check = |index: u64| {
        let mut tally = Tally::default();
        let (cells, ref grid) = maps[index as usize];
        for (turn, k) in (0..).zip([k(2), k(3), k(4), K::Any]) {
            for rules in rules_of(k) {
                let hierarchy = HIERARCHIES[(cells as usize + turn) % HIERARCHIES.len()];
                tally.add(check_rules_explicitly(grid, rules, k, hierarchy, cells));
            }
        }
        tally
    };
    let tally = sum(&on_all_cores(0..maps.len() as u64, check));
    let (found, unreachable) = if is_exhaustive() { (464_016, 127_472) } else { (91_800, 26_728) };
    assert_eq!((tally.found, tally.unreachable), (found, unreachable));
    assert!(tally.shortest > 80_000 && tally.longer > 200, "{tally:?}");
}
