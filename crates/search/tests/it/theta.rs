//! Theta* and Lazy Theta*: they find a path whenever there is one, a legal one, and what is known of its
//! length.

use std::{fmt::Debug, sync::Arc};

use mediant_grid::{
    AsciiMap, Centers, CornerRule, Corners, DiagonalGap, Grid, GridGraph, Placement, Rules, Vertex,
};
use mediant_moves::FiniteK;
use mediant_oracle::{
    Costs, Explicit, Rng, describe, is_exhaustive, maps_of_nine_cells, random_free_vertex, seeds, suite_grid,
    validate,
};
use mediant_search::{
    Answer, Counters, Ends, Euclidean, Guarantee, Heuristic, Hk, LazyThetaStar, NodeEvent, Observer, Path,
    Planner, ThetaStar, Zero,
    parts::{Eager, Lazy, SightCheck, Theta},
};

/// A query, what is known of its answer, and the seed of its map.
struct Expected {
    start: Vertex,
    goal: Vertex,
    /// The optimum over N(k).
    over_k: Option<f64>,
    /// The any-angle optimum, where it was computed.
    any_angle: Option<f64>,
    /// Whether there is a path at any angle.
    is_reachable: bool,
    seed: u64,
}

/// Checks one planner on all queries of a map, so that each is answered with the scratch memory of the
/// others. Returns how many paths were optimal, and how many not.
fn check<P: Placement, H: Heuristic + Debug, S: SightCheck>(
    grid_graph: &GridGraph<P>,
    h: H,
    queries: &[Expected],
) -> [usize; 2] {
    let mut planner = Theta::<_, H, S>::new(grid_graph, h);
    assert_eq!(planner.guarantee(), Guarantee::Suboptimal);
    let (k, grid, rules) = (grid_graph.k(), grid_graph.grid(), grid_graph.rules());
    let mut optimal = [0; 2];
    for expected in queries {
        let Expected { start, goal, .. } = *expected;
        let case = || {
            format!(
                "eager: {}, {h:?}, k = {k}; {}",
                S::EAGER,
                describe(grid, rules, start, goal, expected.seed)
            )
        };
        let query = Ends::new(start, goal);
        let solve = |planner: &mut Theta<_, H, S>| {
            let mut counters = Counters::default();
            let answer = planner.solve_observed(query, &mut counters).expect("both ends are free");
            (answer, counters)
        };
        let (answer, counters) = solve(&mut planner);
        assert_eq!((&answer, counters), (&solve(&mut Theta::new(grid_graph, h)).0, counters), "{}", case());
        assert_eq!((&answer, counters), (&solve(&mut planner).0, counters), "{}", case());
        assert_eq!(answer.path().is_some(), expected.is_reachable, "{}", case());
        let Answer::Found(path) = answer else {
            assert_eq!(counters, Counters::default(), "{}", case());
            continue;
        };
        let (way, cost) = (path.waypoints(), path.cost());
        assert_eq!(validate(grid, rules, None, start, goal, way, cost), Ok(()), "{}", case());
        let turns = |at: &[Vertex]| at[0].to(at[1]).det(at[1].to(at[2])) != 0;
        assert!(way.windows(3).all(turns), "{way:?} goes straight on; {}", case());
        assert!(counters.generated > counters.expanded, "{counters:?}; {}", case());
        let (best, slack) = (expected.any_angle.unwrap_or(0.0), 1.0 + 1e-9);
        assert!(cost * slack >= best, "{cost} < {best}; {}", case());
        // The heuristics are consistent: see `Theta`.
        let limit = expected.over_k.filter(|_| S::EAGER).unwrap_or(f64::INFINITY);
        assert!(cost <= limit * slack, "{cost} > {limit}; {}", case());
        optimal[usize::from(cost > best * slack)] += 1;
    }
    optimal
}

fn check_all<P: Placement>(
    grid: &Arc<Grid>,
    rule: P::Rule,
    k: FiniteK,
    queries: impl Fn(Rules) -> Vec<Expected>,
) -> [usize; 2] {
    let grid_graph = GridGraph::<P>::new(Arc::clone(grid), k, rule).expect("k is in range");
    let queries = queries(grid_graph.rules());
    let optimal = [
        check::<P, _, Eager>(&grid_graph, Hk, &queries),
        check::<P, _, Lazy>(&grid_graph, Hk, &queries),
        check::<P, _, Eager>(&grid_graph, Euclidean, &queries),
        check::<P, _, Lazy>(&grid_graph, Euclidean, &queries),
        check::<P, _, Eager>(&grid_graph, Zero, &queries),
        check::<P, _, Lazy>(&grid_graph, Zero, &queries),
    ];
    [0, 1].map(|i| optimal.iter().map(|counts| counts[i]).sum())
}

fn check_under(
    grid: &Arc<Grid>,
    rules: Rules,
    k: FiniteK,
    queries: impl Fn(Rules) -> Vec<Expected>,
) -> [usize; 2] {
    match rules {
        Rules::Center(corners) => check_all::<Centers>(grid, corners, k, queries),
        Rules::Corner(gap) | Rules::CenterGap(gap) => check_all::<Corners>(grid, gap, k, queries),
    }
}

#[test]
fn a_path_is_found_whenever_there_is_one_and_is_no_shorter_than_any_path() {
    let mut optimal = [0; 2];
    for seed in seeds(60) {
        let grid = Arc::new(suite_grid(seed).0);
        for rules in Rules::ALL {
            let mut rng = Rng::new(seed ^ 0x7E7A);
            let mut free = || random_free_vertex(&mut rng, &grid, rules.placement());
            let pairs: Vec<(Vertex, Vertex)> = (0..5).filter_map(|_| Some((free()?, free()?))).collect();
            let any_angle = Explicit::new(&grid, rules, None);
            let any: Vec<Costs<'_>> = pairs.iter().map(|&(start, _)| any_angle.costs_from(start)).collect();
            for k in [2, 3, 4, 6].map(|k| FiniteK::new(k).expect("k is at least 2")) {
                let graph = Explicit::new(&grid, rules, Some(k));
                let counts = check_under(&grid, rules, k, |_| {
                    let expected = pairs.iter().zip(&any).map(|(&(start, goal), any)| {
                        let over_k = graph.costs_from(start).to(goal);
                        let any_angle = any.to(goal);
                        Expected { start, goal, over_k, any_angle, is_reachable: any_angle.is_some(), seed }
                    });
                    expected.collect()
                });
                optimal.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
            }
        }
    }
    let maps = seeds(60).end as usize;
    assert!(optimal.iter().all(|&count| count > 20 * maps), "optimal, and not: {optimal:?}");
}

/// Where corners are always cut, segments connect what N(2) does not.
#[test]
fn four_moves_do_not_say_what_segments_connect() {
    let always = Rules::Center(CornerRule::Always);
    check_paths(".#\n#.", always, 2, [(0, 0), (1, 1)], [&[(0, 0), (1, 1)]; 2]);
    check_paths(".#\n#.", NEVER, 2, [(0, 0), (1, 1)], [&[]; 2]);
    check_paths(".##\n#.#\n#..", always, 2, [(0, 0), (2, 2)], [&[(0, 0), (2, 2)]; 2]);
    check_paths("..\n..", always, 2, [(0, 0), (1, 1)], [&[(0, 0), (1, 1)]; 2]);
}

#[test]
fn a_path_is_found_on_every_map_of_nine_cells() {
    let mut found = 0;
    for (cells, grid) in maps_of_nine_cells(7) {
        let grid = Arc::new(grid);
        let (rules, k) = (Rules::ALL[cells as usize % 5], [2, 3][cells as usize / 5 % 2]);
        // Under the rule of closed gaps all maps, under the others in turn.
        for rules in [Rules::Corner(DiagonalGap::Closed), rules] {
            let graph = Explicit::new(&grid, rules, FiniteK::new(k).ok());
            let vertices: Vec<Vertex> = graph.free_vertices().collect();
            let any_angle = Explicit::new(&grid, rules, None);
            let all_pairs = |_| {
                let from = |&start: &Vertex| {
                    let (costs, best) = (graph.costs_from(start), any_angle.costs_from(start));
                    let to = |&goal| {
                        let (over_k, any_angle) = (costs.to(goal), best.to(goal));
                        Expected {
                            start,
                            goal,
                            over_k,
                            any_angle,
                            is_reachable: any_angle.is_some(),
                            seed: 0,
                        }
                    };
                    vertices.iter().map(to).collect::<Vec<_>>()
                };
                vertices.iter().flat_map(from).collect()
            };
            let k = FiniteK::new(k).expect("k is at least 2");
            found += check_under(&grid, rules, k, all_pairs).iter().sum::<usize>();
        }
    }
    assert_eq!(found, if is_exhaustive() { 480_018 } else { 66_000 });
}

/// The paths of Theta* and of Lazy Theta* with h_k.
#[track_caller]
fn check_paths(
    drawing: &str,
    rules: Rules,
    k: u32,
    [start, goal]: [(i32, i32); 2],
    expected: [&[(i32, i32)]; 2],
) {
    let grid = Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid);
    let (query, k) = (Ends::new(start, goal), FiniteK::new(k).expect("k is at least 2"));
    let paths = match rules {
        Rules::Center(corners) => paths::<Centers>(grid, k, corners, query),
        Rules::Corner(gap) | Rules::CenterGap(gap) => paths::<Corners>(grid, k, gap, query),
    };
    let expected = expected.map(|way| way.iter().map(|&at| at.into()).collect::<Vec<Vertex>>());
    assert_eq!(paths, expected, "k = {k}, {rules}");
}

fn paths<P: Placement>(grid: Arc<Grid>, k: FiniteK, rule: P::Rule, query: Ends) -> [Vec<Vertex>; 2] {
    let grid_graph = GridGraph::<P>::new(grid, k, rule).expect("k is in range");
    let eager = ThetaStar::new(&grid_graph, Hk).solve(query);
    let lazy = LazyThetaStar::new(&grid_graph, Hk).solve(query);
    [eager, lazy].map(|answer| match answer.expect("both ends are free") {
        Answer::Found(path) => path.into_waypoints(),
        _ => Vec::new(),
    })
}

const NEVER: Rules = Rules::Center(CornerRule::Never);
const OPEN: Rules = Rules::Corner(DiagonalGap::Open);
const CLOSED: Rules = Rules::Corner(DiagonalGap::Closed);

const WALL: &str = "
    .........
    .....#...
    .....#...
    .....#...
    .........
";

#[test]
fn one_bend_around_a_wall() {
    let ends = [(0, 1), (8, 2)];
    for rules in [OPEN, CLOSED] {
        for k in 3..=6 {
            check_paths(WALL, rules, k, ends, [&[(0, 1), (6, 1), (8, 2)]; 2]);
        }
        // With four moves Theta* considers fewer vertices, and is not optimal.
        check_paths(WALL, rules, 2, ends, [&[(0, 1), (8, 1), (8, 2)], &[(0, 1), (6, 1), (8, 2)]]);
    }
    // At centers the path does not bend at a corner. The optimum bends at (5, 0), which Theta* with k = 3
    // does not find.
    check_paths(WALL, NEVER, 3, ends, [&[(0, 1), (6, 0), (8, 2)]; 2]);
    check_paths(WALL, NEVER, 4, ends, [&[(0, 1), (5, 0), (8, 2)]; 2]);
}

#[test]
fn five_bends_through_a_slalom() {
    let slalom = "
        ....#.......
        ....#...#...
        ....#...#...
        ........#...
        ....#...#...
        ....#...#...
    ";
    let (ends, best) = ([(0, 0), (11, 5)], [(0, 0), (4, 3), (5, 3), (8, 1), (9, 1), (11, 5)]);
    check_paths(slalom, OPEN, 3, ends, [&best; 2]);
    // Lazy Theta* expands (8, 1) before the neighbor that would give it its best parent.
    let lazy = [(0, 0), (4, 3), (5, 3), (7, 2), (8, 1), (9, 1), (11, 5)];
    check_paths(slalom, OPEN, 4, ends, [&best, &lazy]);
    check_paths(slalom, OPEN, 5, ends, [&best; 2]);
}

#[test]
fn open_ground_is_crossed_straight() {
    let ground = "
        .......
        .......
        .......
        .......
        .......
    ";
    for (rules, k) in Rules::ALL.into_iter().flat_map(|rules| [2, 3, 4, 7].map(|k| (rules, k))) {
        for goal in [(6, 4), (3, 1), (6, 0), (4, 4), (1, 0)] {
            check_paths(ground, rules, k, [(0, 0), goal], [&[(0, 0), goal]; 2]);
        }
        check_paths(ground, rules, k, [(2, 2), (2, 2)], [&[(2, 2)]; 2]);
    }
}

#[test]
fn gaps_are_passed_where_they_are_open() {
    let gap = "
        ...#...
        ...#...
        ...#...
        ###....
        .......
        .......
    ";
    check_paths(gap, OPEN, 4, [(0, 0), (6, 5)], [&[(0, 0), (3, 3), (6, 5)]; 2]);
    check_paths(gap, CLOSED, 4, [(0, 0), (6, 5)], [&[]; 2]);
    // The end of a path lies in the cell to the lower right.
    check_paths(gap, CLOSED, 4, [(3, 3), (6, 5)], [&[(3, 3), (6, 5)]; 2]);
    check_paths(gap, CLOSED, 4, [(0, 0), (3, 3)], [&[]; 2]);
    // A free cell of which three corners are gaps. With four moves the path passes one of them, where it may
    // not leave the cell.
    let cell = "
        .#..
        #.#.
        .##.
        ....
    ";
    for k in [2, 3, 5] {
        check_paths(cell, CLOSED, k, [(1, 1), (2, 2)], [&[(1, 1), (2, 2)]; 2]);
        check_paths(cell, CLOSED, k, [(2, 2), (1, 1)], [&[(2, 2), (1, 1)]; 2]);
        check_paths(cell, CLOSED, k, [(1, 1), (0, 0)], [&[]; 2]);
    }
}

/// A vertex must not become the parent of another that it sees through the other quadrant of a gap. Without a
/// heuristic the search meets such pairs.
#[test]
fn nothing_hangs_through_a_closed_gap() {
    let both = |drawing: &str, k: u32, [start, goal]: [(i32, i32); 2], expected: &[(i32, i32)]| {
        let grid = Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid);
        let k = FiniteK::new(k).expect("k is at least 2");
        let grid_graph = GridGraph::<Corners>::new(grid, k, DiagonalGap::Closed).expect("k is in range");
        let (query, expected) = (Ends::new(start, goal), expected.iter().map(|&at| at.into()));
        let expected = Ok(Answer::Found(Path::new(expected.collect())));
        assert_eq!(ThetaStar::new(&grid_graph, Zero).solve(query), expected);
        assert_eq!(LazyThetaStar::new(&grid_graph, Zero).solve(query), expected);
    };
    // From the start: (4, 2), whose parent it is, leads to (1, 0) by (−3, −2).
    let start = "
        .....
        .#...
        #....
        .....
    ";
    both(start, 5, [(1, 2), (1, 0)], &[(1, 2), (2, 2), (2, 1), (1, 0)]);
    // To the goal: (5, 6), whose parent is the start, leads to it by (−4, −1).
    let goal = "
        ......
        ......
        ......
        .##...
        .##...
        #.....
        ......
    ";
    both(goal, 6, [(1, 0), (1, 5)], &[(1, 0), (3, 3), (3, 5), (1, 5)]);
    // To the goal, when its parent does not see it: (3, 3) does not, and (1, 1) is a closed neighbor.
    let neighbor = "
        .....
        .##..
        #.#..
        .....
    ";
    both(neighbor, 3, [(0, 0), (1, 2)], &[(0, 0), (3, 1), (3, 3), (2, 3), (1, 2)]);
}

/// Records events as text, without swaps.
#[derive(Default)]
struct Log(Vec<String>);

impl Log {
    fn line(&mut self, word: &str, node: NodeEvent) {
        let parent = node.parent.map_or("nowhere".to_owned(), |parent| parent.to_string());
        self.0.push(format!(
            "{word} {} from {parent}: g {:.3}, f {:.3}",
            node.at,
            node.g.to_f64(),
            node.f.to_f64()
        ));
    }
}

impl Observer for Log {
    fn expanded(&mut self, node: NodeEvent) {
        self.line("expanded", node);
    }

    fn generated(&mut self, node: NodeEvent) {
        self.line("generated", node);
    }

    fn updated(&mut self, node: NodeEvent) {
        self.line("updated", node);
    }
}

/// The events of a search on a small map.
fn events<S: SightCheck>() -> Vec<String> {
    let drawing = "
        ...#
        .#..
        ....
    ";
    let map = AsciiMap::parse(drawing).expect("the drawing is a map");
    let grid_graph =
        GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::N8, CornerRule::Never).expect("k is in range");
    let (mut log, mut counters) = (Log::default(), Counters::default());
    let mut planner = Theta::<_, _, S>::new(&grid_graph, Hk);
    let query = Ends::new((0, 0), (3, 1));
    planner.solve_observed(query, &mut log).expect("both ends are free");
    planner.solve_observed(query, &mut counters).expect("both ends are free");
    let count = |word| log.0.iter().filter(|line| line.starts_with(word)).count() as u64;
    assert_eq!(
        (counters.expanded, counters.generated, counters.updated, counters.scanned),
        (count("expanded"), count("generated"), count("updated"), 0)
    );
    log.0
}

#[test]
fn events_to_the_letter() {
    let begin = [
        "generated (0, 0) from nowhere: g 0.000, f 3.414",
        "expanded (0, 0) from nowhere: g 0.000, f 3.414",
        "generated (0, 1) from (0, 0): g 1.000, f 4.000",
        "generated (1, 0) from (0, 0): g 1.000, f 3.414",
        "expanded (1, 0) from (0, 0): g 1.000, f 3.414",
        "generated (2, 0) from (0, 0): g 2.000, f 3.414",
        "expanded (2, 0) from (0, 0): g 2.000, f 3.414",
    ];
    let eager = [
        // (0, 0) does not see it.
        "generated (2, 1) from (2, 0): g 3.000, f 4.000",
        "expanded (2, 1) from (2, 0): g 3.000, f 4.000",
        "generated (2, 2) from (2, 0): g 4.000, f 5.414",
        "generated (3, 2) from (2, 0): g 4.236, f 5.236",
        "generated (3, 1) from (2, 1): g 4.000, f 4.000",
    ];
    assert_eq!(events::<Eager>(), [&begin[..], &eager].concat());
    let lazy = [
        // Its parent does not see it, which is found out when it is expanded.
        "generated (2, 1) from (0, 0): g 2.236, f 3.236",
        "expanded (2, 1) from (2, 0): g 3.000, f 4.000",
        "generated (2, 2) from (2, 0): g 4.000, f 5.414",
        "generated (3, 2) from (2, 0): g 4.236, f 5.236",
        // So it is here, where the search ends.
        "generated (3, 1) from (2, 0): g 3.414, f 3.414",
    ];
    assert_eq!(events::<Lazy>(), [&begin[..], &lazy].concat());
}
