//! Paths by hub labels cost what the references cost: in integers over N(k), within rounding at any angle.

use mediant_grid::{Centers, Corners, FreeSpace, Grid, Rules, Vertex};
use mediant_moves::{Cost, K};
use mediant_oracle::{
    Explicit, Visibility, describe, is_exhaustive, on_all_cores, seeds, suite_grid, validate,
};
use mediant_search::{Answer, Ends, Guarantee, Planner};
use mediant_subgoal::{HubLabelSearch, HubLabels, SubgoalPlacement};

use crate::{
    common::{GAPS, all_ks, k, labels, length, space, with_vertices},
    exact::{ends, rules_of},
};

/// A query, and a shortest path of the reference.
struct Expected {
    start: Vertex,
    goal: Vertex,
    path: Option<Vec<Vertex>>,
}

/// The numbers of paths, of queries without one, and of paths that bend at a subgoal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Tally {
    found: usize,
    unreachable: usize,
    bent: usize,
}

fn sum(tallies: Vec<Tally>) -> Tally {
    tallies.into_iter().fold(Tally::default(), |a, b| Tally {
        found: a.found + b.found,
        unreachable: a.unreachable + b.unreachable,
        bent: a.bent + b.bent,
    })
}

/// Labels under test, with what the message of a failure needs.
struct Suite<'t, P: SubgoalPlacement> {
    space: &'t FreeSpace<P>,
    labels: HubLabels<P>,
    seed: u64,
}

impl<P: SubgoalPlacement> Suite<'_, P> {
    /// Asks all queries of a map with one planner, and all goals of a start at once.
    fn check(&self, queries: &[Expected]) -> Tally {
        let (k, mut tally) = (self.labels.k(), Tally::default());
        let mut planner =
            HubLabelSearch::new(self.space, &self.labels).expect("the labels are for this space");
        let optimal = match k {
            K::Finite(k) => Guarantee::Optimal(k),
            K::Any => Guarantee::OptimalAnyAngle,
        };
        assert_eq!(planner.guarantee(), optimal);
        for of_a_start in queries.chunk_by(|a, b| a.start == b.start) {
            let each: Vec<_> = of_a_start.iter().map(|query| self.solve(&mut planner, query)).collect();
            self.check_goals(&mut planner, of_a_start, &each);
            for cost in each {
                *if cost.is_some() { &mut tally.found } else { &mut tally.unreachable } += 1;
            }
            tally.bent +=
                of_a_start.iter().filter(|query| query.path.as_ref().is_some_and(|p| p.len() > 2)).count();
        }
        tally
    }

    /// Solves a query twice, checks the path, and returns its cost.
    fn solve<S, I>(&self, planner: &mut HubLabelSearch<S, I>, expected: &Expected) -> Option<Cost>
    where
        HubLabelSearch<S, I>: Planner,
        S: std::ops::Deref<Target = FreeSpace<P>>,
        I: std::ops::Deref<Target = HubLabels<P>>,
    {
        let (k, &Expected { start, goal, .. }) = (self.labels.k(), expected);
        let query = Ends::new(start, goal);
        let answer = planner.solve(query).unwrap_or_else(|error| panic!("{error}; {}", self.case(expected)));
        assert_eq!(planner.solve(query).as_ref(), Ok(&answer), "asked again; {}", self.case(expected));
        let distance = planner.cost(query).unwrap_or_else(|error| panic!("{error}; {}", self.case(expected)));
        let Answer::Found(path) = answer else {
            assert_eq!((distance, &expected.path), (None, &None), "{}", self.case(expected));
            return None;
        };
        let (grid, rules, way) = (self.space.grid(), self.space.rules(), path.waypoints());
        let fault = validate(grid, rules, k.finite(), start, goal, way, path.cost());
        assert_eq!(fault, Ok(()), "{way:?}; {}", self.case(expected));
        let turns = |at: &[Vertex]| at[0].to(at[1]).det(at[1].to(at[2])) != 0;
        assert!(way.windows(3).all(turns), "{way:?} goes straight on; {}", self.case(expected));
        let best = expected.path.as_ref().unwrap_or_else(|| panic!("{way:?}; {}", self.case(expected)));
        let (best, distance) = (length(k, best), distance.unwrap_or(Cost::ZERO));
        assert!(is_equal(k, distance, best), "{distance}, reference {best}; {}", self.case(expected));
        let cost = length(k, way);
        assert!(is_equal(k, distance, cost), "{distance}, path {cost} {way:?}; {}", self.case(expected));
        Some(distance)
    }

    fn check_goals<S, I>(
        &self,
        planner: &mut HubLabelSearch<S, I>,
        queries: &[Expected],
        each: &[Option<Cost>],
    ) where
        S: std::ops::Deref<Target = FreeSpace<P>>,
        I: std::ops::Deref<Target = HubLabels<P>>,
    {
        let (k, start) = (self.labels.k(), queries[0].start);
        let goals = self.labels.goals(self.space, queries.iter().map(|query| query.goal));
        let goals = goals.expect("the goals are free");
        let mut distances = vec![Some(Cost::MAX); 3];
        planner.distances(start, &goals, &mut distances).expect("the start is free");
        assert_eq!(distances.len(), each.len());
        for ((query, &own), &at_once) in queries.iter().zip(each).zip(&distances) {
            let is_same = own.zip(at_once).map_or(own == at_once, |(a, b)| is_equal(k, a, b));
            assert!(is_same, "{own:?}, with others {at_once:?}; {}", self.case(query));
        }
        let nearest = planner.nearest(start, &goals).expect("the start is free");
        let least = each.iter().zip(0..).filter_map(|(&cost, number)| Some((cost?, number))).min();
        match (nearest, least) {
            (None, None) => {}
            (Some((number, cost)), Some((least, first))) => {
                assert!(is_equal(k, cost, least), "{cost}, not {least}; {}", self.case(&queries[first]));
                let is_first =
                    number == first || k == K::Any && is_equal(k, each[number].unwrap_or(Cost::MAX), least);
                assert!(is_first, "{number}, not {first}; {}", self.case(&queries[first]));
            }
            (a, b) => panic!("{a:?}, not {b:?}; {}", self.case(&queries[0])),
        }
    }

    fn case(&self, &Expected { start, goal, .. }: &Expected) -> String {
        let map = describe(self.space.grid(), self.space.rules(), start, goal, self.seed);
        format!("k = {}; {map}", self.labels.k())
    }
}

/// Whether two costs are those of equally short paths: at any angle each segment is rounded.
pub(super) fn is_equal(k: K, a: Cost, b: Cost) -> bool {
    let (x, y) = (a.to_f64(), b.to_f64());
    a == b || k == K::Any && (x - y).abs() <= 1e-9 * x.max(y)
}

/// Labels of subgoals alone, and with labels of vertices besides.
fn check_with_and_without<P: SubgoalPlacement>(
    space: &FreeSpace<P>,
    k: K,
    queries: &[Expected],
    seed: u64,
) -> Tally {
    let labels = labels(space, k);
    let with = with_vertices(&labels, space, seed % 2 == 1);
    let tally = Suite { space, labels, seed }.check(queries);
    assert_eq!(Suite { space, labels: with, seed }.check(queries), tally, "seed {seed}");
    tally
}

/// Every pair of some vertices of a map.
fn expected(ends: &[Vertex], path: impl Fn(Vertex) -> Vec<Option<Vec<Vertex>>>) -> Vec<Expected> {
    let of = |&start: &Vertex| {
        let to = move |(&goal, path): (&Vertex, _)| Expected { start, goal, path };
        ends.iter().zip(path(start)).map(to).collect::<Vec<_>>()
    };
    ends.iter().flat_map(of).collect()
}

fn check_corners(seed: u64) -> Tally {
    let (grid, mut tallies) = (suite_grid(seed).0, Vec::new());
    for gap in GAPS {
        let space = space::<Corners>(&grid, gap);
        let visibility = Visibility::new(&grid, gap);
        let ends = ends(&grid, visibility.corners(), seed);
        for k in all_ks() {
            let over = visibility.over(k.finite());
            let expected = expected(&ends, |start| {
                let costs = over.costs_from(start);
                ends.iter().map(|&goal| costs.path_to(goal)).collect()
            });
            tallies.push(check_with_and_without(&space, k, &expected, seed));
        }
    }
    sum(tallies)
}

#[test]
fn labels_cost_what_the_visibility_graph_costs() {
    let maps = seeds(120).end as usize;
    let tally = sum(on_all_cores(seeds(120), check_corners));
    assert!(tally.found > 200 * maps && tally.unreachable > 30 * maps, "{tally:?} on {maps} maps");
    assert!(tally.bent > 40 * maps, "{tally:?} on {maps} maps");
}

/// Compares with Dijkstra on the graph of all moves, from and to at most `most` vertices.
fn check_explicitly<P: SubgoalPlacement>(grid: &Grid, rule: P::Rule, k: K, most: usize, seed: u64) -> Tally {
    let space = space::<P>(grid, rule);
    let explicit = Explicit::new(grid, space.rules(), k.finite());
    let all: Vec<Vertex> = explicit.free_vertices().collect();
    let step = all.len().div_ceil(most).max(1);
    let ends: Vec<Vertex> = all.into_iter().skip(seed as usize % step).step_by(step).collect();
    let expected = expected(&ends, |start| {
        let costs = explicit.costs_from(start);
        ends.iter().map(|&goal| costs.path_to(goal)).collect()
    });
    check_with_and_without(&space, k, &expected, seed)
}

fn check_rules(grid: &Grid, rules: Rules, k: K, most: usize, seed: u64) -> Tally {
    match rules {
        Rules::Corner(gap) | Rules::CenterGap(gap) => check_explicitly::<Corners>(grid, gap, k, most, seed),
        Rules::Center(corners) => check_explicitly::<Centers>(grid, corners, k, most, seed),
    }
}

#[test]
fn labels_cost_what_dijkstra_on_the_explicit_graph_costs() {
    let check = |seed: u64| {
        let (grid, k) = (suite_grid(seed).0, [k(2), k(3), k(4), K::Any][seed as usize % 4]);
        // On large maps the graph of all segments takes too long.
        if grid.width() * grid.height() > 200 {
            return Tally::default();
        }
        // Of small maps every pair.
        sum(rules_of(k).map(|rules| check_rules(&grid, rules, k, 40, seed)).collect())
    };
    let (maps, tally) = (seeds(120).end as usize, sum(on_all_cores(seeds(120), check)));
    assert!(tally.found > 300 * maps && tally.unreachable > 80 * maps, "{tally:?} on {maps} maps");
    assert!(tally.bent > 100 * maps, "{tally:?} on {maps} maps");
}

/// The smallest maps hold the oddest gaps. A k for each map and rule, all by `MEDIANT_EXHAUSTIVE`.
#[test]
fn labels_are_exact_on_every_map_of_nine_cells() {
    let check = |cells: u64| {
        let grid = Grid::from_fn(3, 3, |x, y| cells >> (3 * y + x) & 1 == 1).expect("a valid size");
        let ks = [k(2), k(3), k(4), K::Any]
            .into_iter()
            .zip(0..)
            .filter(|(_, turn)| is_exhaustive() || cells % 4 == *turn);
        let each = ks.flat_map(|(k, _)| rules_of(k).map(move |rules| (k, rules)));
        sum(each.map(|(k, rules)| check_rules(&grid, rules, k, 16, cells)).collect())
    };
    let tally = sum(on_all_cores(0..1 << 9, check));
    assert!(tally.found > 100_000 && tally.unreachable > 20_000 && tally.bent > 10_000, "{tally:?}");
}
