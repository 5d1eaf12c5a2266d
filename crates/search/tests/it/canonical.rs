//! Canonical search: the rule of the paper and the exact one, and what each of them prunes.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::{collections::HashMap, sync::Arc};

use mediant_grid::{
    AsciiMap, Centers, CornerRule, Corners, DiagonalGap, Grid, GridGraph, Placement, Rules, Vertex,
};
use mediant_moves::FiniteK;
use mediant_oracle::{Case, Explicit, Rng, adversarial, describe, is_gap, seeds, validate};
use mediant_search::{
    AStar, Answer, BlockJps, Canonical, CanonicalRule, Counters, Ends, Hk, Jps, JpsPlus, JumpTable,
    NodeEvent, Observer, PaperCanonical, Planner, Pruning, QueryError, Zero,
};

fn grid_graph<P: Placement>(grid: &Arc<Grid>, k: u32, rule: P::Rule) -> GridGraph<P> {
    GridGraph::new(Arc::clone(grid), FiniteK::new(k).unwrap(), rule).unwrap()
}

fn drawn(drawing: &str) -> (Arc<Grid>, Ends) {
    let map = AsciiMap::parse(drawing).unwrap();
    let query = Ends::new(map.mark('s').unwrap(), map.mark('g').unwrap());
    (Arc::new(map.grid), query)
}

fn cost(answer: &Result<Answer, QueryError>) -> Option<f64> {
    answer.as_ref().unwrap().path().map(|path| path.cost())
}

fn center_costs(drawing: &str, k: u32, corners: CornerRule) -> [Option<f64>; 2] {
    let (grid, query) = drawn(drawing);
    let grid_graph = &grid_graph::<Centers>(&grid, k, corners);
    let exact = cost(&Canonical::new(grid_graph, Hk).solve(query));
    [exact, cost(&PaperCanonical::new(grid_graph, Hk).solve(query))]
}

#[test]
fn the_published_rule_misses_what_the_exact_one_finds() {
    // The move (2, 1) is not legal at s, but it is one cell to the right, where no path on the 8-neighborhood
    // turns.
    let (grid, query) = drawn(
        "
        s....
        .#.g.
        .....
        .....
        ",
    );
    let grid_graph = grid_graph::<Centers>(&grid, 4, CornerRule::Never);
    let answer = Canonical::new(&grid_graph, Hk).solve(query).unwrap();
    assert_eq!(answer.path().unwrap().waypoints(), [(0, 0), (1, 0), (3, 1)].map(Vertex::from));
    assert_eq!(answer.path().unwrap().cost(), 1.0 + 5.0_f64.sqrt());

    // The best path turns where no obstacle is near.
    let drawing = "
        g#.
        ...
        ...
        ..s
    ";
    let [exact, paper] = center_costs(drawing, 4, CornerRule::Never).map(Option::unwrap);
    assert!((exact - (2.0_f64.sqrt() + 5.0_f64.sqrt())).abs() < 1e-12, "{exact}");
    assert!((paper - (1.0 + 8.0_f64.sqrt())).abs() < 1e-12, "{paper}");
}

/// A vertex is reached most cheaply by a long move, none of whose natural successors is legal there; and no
/// path on the 8-neighborhood turns there.
#[test]
fn the_published_rule_finds_a_path_where_long_moves_lead_nowhere() {
    let drawings = [
        "
        ....
        g#.s
        ",
        "
        g....
        ###.s
        ",
    ];
    for (drawing, k) in drawings.into_iter().flat_map(|drawing| [3, 4, 5, 6, 9].map(|k| (drawing, k))) {
        for corners in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
            let [exact, paper] = center_costs(drawing, k, corners);
            assert!(exact.is_some() && paper >= exact, "k = {k}, {corners}: {exact:?}, {paper:?}: {drawing}");
        }
    }
}

/// Which vertex generated which.
#[derive(Default)]
struct Births {
    /// How often each vertex was generated.
    generated: HashMap<Vertex, u32>,
    updated: u32,
    /// How many others each vertex generated.
    children: HashMap<Vertex, u32>,
    /// With their parents.
    expanded: Vec<(Vertex, Option<Vertex>)>,
}

impl Observer for Births {
    fn expanded(&mut self, node: NodeEvent) {
        self.expanded.push((node.at, node.parent));
    }

    fn generated(&mut self, node: NodeEvent) {
        *self.generated.entry(node.at).or_default() += 1;
        if let Some(parent) = node.parent {
            *self.children.entry(parent).or_default() += 1;
        }
    }

    fn updated(&mut self, _: NodeEvent) {
        self.updated += 1;
    }
}

/// Searches open ground from its middle for a vertex in its last corner, without a heuristic, so that all
/// nearer vertices are expanded.
fn births<P: Placement>(k: u32, rule: P::Rule) -> (Births, i32, GridGraph<P>) {
    let radius = FiniteK::new(k).unwrap().radius().unwrap();
    // So large that for some vertices around the middle nothing but the border is within reach of two moves.
    let side = 8 * radius + 9;
    let grid = Arc::new(Grid::from_fn(side as u32, side as u32, |_, _| false).unwrap());
    let grid_graph = grid_graph::<P>(&grid, k, rule);
    let (mut births, last) = (Births::default(), side - 1);
    let query = Ends::new((side / 2, side / 2), (last, last));
    Canonical::new(&grid_graph, Zero).solve_observed(query, &mut births).unwrap();
    (births, side / 2, grid_graph)
}

fn open_ground<P: Placement>(k: u32, rule: P::Rule) {
    let (births, middle, grid_graph) = births::<P>(k, rule);
    let case = format!("k = {k}, {}", grid_graph.rules());
    assert_eq!(births.updated, 0, "{case}");
    assert!(births.generated.values().all(|&times| times == 1), "{case}");
    // All vertices but a few as far as the goal.
    assert!(births.generated.len() > grid_graph.vertex_count() - 4, "{case}: {}", births.generated.len());
    let moves: Vec<_> = grid_graph.steps().iter().map(|step| step.vector()).collect();
    let reach = grid_graph.k().radius().unwrap();
    let mut seen = [0, 0];
    for &(at, parent) in &births.expanded {
        let d = Vertex::new(middle, middle).to(at);
        // Not where a successor would be outside the map.
        if d.x.abs().max(d.y.abs()) > middle - reach {
            continue;
        }
        let children = births.children.get(&at).copied().unwrap_or(0) as usize;
        let Some(parent) = parent else {
            assert_eq!(children, moves.len(), "{case}");
            continue;
        };
        let by = moves.iter().position(|&v| v == parent.to(at)).unwrap();
        assert_eq!(children, [1, 3][by % 2], "{case}: {at}, reached by {:?}", moves[by]);
        seen[by % 2] += 1;
    }
    assert!(seen.iter().all(|&nodes| nodes > 10), "{case}: {seen:?}");
}

/// The uni- and bidimensional nodes of the paper: one way to each vertex.
#[test]
fn on_open_ground_each_vertex_is_generated_once() {
    for k in 2..=7 {
        for corners in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
            open_ground::<Centers>(k, corners);
        }
        for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
            open_ground::<Corners>(k, gap);
        }
    }
}

/// Calls `each` with random cases under all rules, for each k.
fn on_random_maps(maps: u64, ks: &[u32], mut each: impl FnMut(&Arc<Grid>, u32, &Case)) {
    for seed in seeds(maps) {
        for rules in Rules::ALL {
            let Some(case) = Case::random(seed, rules) else { continue };
            let grid = Arc::new(case.grid.clone());
            ks.iter().for_each(|&k| each(&grid, k, &case));
        }
    }
}

/// The pruning rules, shared by all maps: to compute one takes longer than a search on a small map.
struct Shared<P: Placement>(HashMap<(u32, Rules), Arc<CanonicalRule<P>>>);

impl<P: Placement> Shared<P> {
    fn pruning(&mut self, grid_graph: &GridGraph<P>) -> Arc<Pruning<P>> {
        let (k, rule) = (grid_graph.k(), grid_graph.rule());
        let known = self.0.entry((k.get(), P::rules(rule)));
        let known = known.or_insert_with(|| Arc::new(CanonicalRule::new(k, rule)));
        Arc::new(Pruning::with_rule(grid_graph, Arc::clone(known)).unwrap())
    }
}

/// A planner's cost and counts for a query.
type Found = (Option<f64>, Counters);

fn solve(mut planner: impl Planner, case: &Case) -> Found {
    let mut counters = Counters::default();
    let answer = planner.solve_observed(Ends::new(case.start, case.goal), &mut counters);
    (cost(&answer), counters)
}

/// The answers of A*, of the exact variant and of the published one.
fn three<P: Placement>(
    shared: &mut Shared<P>,
    grid: &Arc<Grid>,
    k: u32,
    rule: P::Rule,
    case: &Case,
) -> [Found; 3] {
    let grid_graph = &grid_graph::<P>(grid, k, rule);
    let pruning = shared.pruning(grid_graph);
    [
        solve(AStar::new(grid_graph, Hk), case),
        solve(Canonical::with_pruning(grid_graph, pruning, Hk).unwrap(), case),
        solve(PaperCanonical::new(grid_graph, Hk), case),
    ]
}

#[test]
fn canonical_generates_no_more_than_a_star_and_the_published_rule_is_complete() {
    let (mut at_centers, mut at_corners) = (Shared(HashMap::new()), Shared(HashMap::new()));
    let ks = [2, 3, 4, 5, 6, 7, 9];
    let (mut generated, mut cases, mut longer) = (HashMap::new(), 0, 0);
    on_random_maps(75, &ks, |grid, k, case| {
        let [a_star, exact, paper] = match case.rules {
            Rules::Center(corners) => three::<Centers>(&mut at_centers, grid, k, corners, case),
            Rules::Corner(gap) | Rules::CenterGap(gap) => {
                three::<Corners>(&mut at_corners, grid, k, gap, case)
            }
        };
        let (best, found) = (a_star.0, paper.0);
        assert_eq!(best.is_some(), found.is_some(), "k = {k}; {case}");
        if let (Some(best), Some(found)) = (best, found) {
            assert!(found >= best * (1.0 - 1e-9), "{found}, the optimum is {best}: k = {k}; {case}");
            longer += u32::from(found > best * (1.0 + 1e-9));
        }
        cases += 1;
        let sums: &mut [u64; 2] = generated.entry(k).or_default();
        sums[0] += a_star.1.generated;
        sums[1] += exact.1.generated;
    });
    let maps = seeds(75).end as u32;
    assert!(cases > 30 * maps, "{cases} cases");
    assert!(longer > maps / 30, "only {longer} of {cases} paths are longer: the variants do not differ");
    for k in ks {
        let [a_star, exact] = generated[&k];
        assert!(exact <= a_star, "k = {k}: {exact} nodes generated, {a_star} by A*");
    }
}

/// Small maps full of gaps.
fn gap_map(seed: u64) -> Arc<Grid> {
    let rng = &mut Rng::new(seed);
    let (width, height) = (2 + rng.below(7), 2 + rng.below(7));
    if rng.chance(30) {
        return Arc::new(adversarial(rng, width, height));
    }
    let (flips, parity) = (rng.below(50), rng.below(2));
    let mut blocked = |x, y| ((x + y + parity) % 2 == 0) != rng.chance(flips);
    let cells: Vec<bool> =
        (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| blocked(x, y)).collect();
    Arc::new(Grid::from_fn(width, height, |x, y| cells[(y * width + x) as usize]).unwrap())
}

/// Up to three gaps and two other vertices.
fn ends(grid: &Grid, free: &[Vertex], seed: u64) -> Vec<Vertex> {
    let rng = &mut Rng::new(seed ^ 0x6A9);
    let (gaps, others): (Vec<Vertex>, Vec<Vertex>) = free.iter().partition(|&&at| is_gap(grid, at));
    let mut ends: Vec<Vertex> = (0..3).filter_map(|_| rng.pick(&gaps).copied()).collect();
    ends.extend((0..2).filter_map(|_| rng.pick(&others).copied()));
    ends
}

/// Under closed gaps, from and to gaps and others: how many queries of each kind had a path.
fn closed_gaps(k: u32, seeds: std::ops::Range<u64>) -> HashMap<[bool; 2], u32> {
    let number = FiniteK::new(k).unwrap();
    let rules = Rules::Corner(DiagonalGap::Closed);
    let shared = Arc::new(CanonicalRule::new(number, DiagonalGap::Closed));
    let mut found = HashMap::new();
    for seed in seeds {
        let grid = gap_map(seed);
        let grid_graph = &grid_graph::<Corners>(&grid, k, DiagonalGap::Closed);
        let pruning = || Arc::new(Pruning::with_rule(grid_graph, Arc::clone(&shared)).unwrap());
        let graph = Explicit::new(&grid, rules, Some(number));
        let free: Vec<Vertex> = graph.free_vertices().collect();
        let mut canonical = Canonical::with_pruning(grid_graph, pruning(), Hk).unwrap();
        let mut jps =
            Jps::with_finder(grid_graph, pruning(), mediant_search::parts::StepwiseFinder, Hk).unwrap();
        let mut blocks = (k <= 3).then(|| BlockJps::new(grid_graph, Hk).unwrap());
        let table = (k <= 3).then(|| Arc::new(JumpTable::new(grid_graph).unwrap()));
        let mut plus = table.map(|table| JpsPlus::new(grid_graph, table, Hk).unwrap());
        let ends = ends(&grid, &free, seed);
        for &start in &ends {
            let costs = graph.costs_from(start);
            for &goal in &ends {
                let query = Ends::new(start, goal);
                let answers = [
                    Some(canonical.solve(query)),
                    Some(jps.solve(query)),
                    blocks.as_mut().map(|planner| planner.solve(query)),
                    plus.as_mut().map(|planner| planner.solve(query)),
                ];
                let names = ["canonical", "jps", "jps-block", "jps-plus"];
                for (answer, name) in answers.into_iter().zip(names) {
                    let Some(answer) = answer.transpose().unwrap() else { continue };
                    let case = || format!("{name}, k = {k}; {}", describe(&grid, rules, start, goal, seed));
                    let best = costs.to(goal);
                    let path = answer.path();
                    assert_eq!(path.is_some(), best.is_some(), "{}", case());
                    let (Some(path), Some(best)) = (path, best) else { continue };
                    let points = path.waypoints();
                    let fault = validate(&grid, rules, Some(number), start, goal, points, path.cost());
                    assert_eq!(fault, Ok(()), "{}", case());
                    assert!((path.cost() - best).abs() < 1e-9, "{} for {best}: {}", path.cost(), case());
                }
                if start != goal && costs.to(goal).is_some() {
                    *found.entry([start, goal].map(|at| is_gap(&grid, at))).or_default() += 1;
                }
            }
        }
    }
    found
}

#[test]
fn paths_begin_and_end_at_closed_gaps_and_pass_none() {
    for k in 2..=6 {
        let found = closed_gaps(k, seeds(400));
        let maps = seeds(400).end as u32;
        for kind in [[false, false], [true, false], [false, true], [true, true]] {
            let paths = found.get(&kind).copied().unwrap_or(0);
            assert!(paths > maps / 20, "k = {k}: {paths} paths where start, goal are gaps: {kind:?}");
        }
    }
}

/// At k = 2 a path may pass a gap, and how it may go on there depends on how it came. So a path of the same
/// cost must not replace another. Found by the random suite.
#[test]
fn as_cheap_a_way_to_a_gap_replaces_no_other() {
    let (grid, query) = drawn(
        "
        ......#...
        .g..#.....
        ###..#....
        ....##..#.
        #.##..#...
        ..###..##.
        .#....#...
        ....#.....
        ....#.#...
        #.....#.##
        .s#...#...
    ",
    );
    let grid_graph = grid_graph::<Corners>(&grid, 2, DiagonalGap::Closed);
    let check = |answer: Result<Answer, QueryError>| {
        let answer = answer.unwrap();
        let path = answer.path().unwrap();
        let (start, goal) = (query.start, query.goal);
        let k = FiniteK::new(2).ok();
        assert_eq!(
            validate(&grid, grid_graph.rules(), k, start, goal, path.waypoints(), path.cost()),
            Ok(())
        );
    };
    check(Canonical::new(&grid_graph, Hk).solve(query));
    check(Jps::new(&grid_graph, Hk).solve(query));
    check(BlockJps::new(&grid_graph, Hk).unwrap().solve(query));
}

/// The number of times that a search began.
#[derive(Default)]
struct Begun(u32);

impl Observer for Begun {
    fn generated(&mut self, node: NodeEvent) {
        self.0 += u32::from(node.parent.is_none());
    }
}

/// Where the published rule finds no path, the search is repeated with all moves; the next one prunes again.
/// Random maps hardly ever need it. A long wall along a diagonal does.
#[test]
fn the_published_search_is_repeated_where_it_finds_no_path() {
    let (grid, query) = drawn(
        "
        .................#............................
        .#........#..###..............................
        ..####............###.........................
        ......#.......................................
        .......#......................................
        ........#.....................................
        .........#....................................
        ..........#...................................
        ...........#.........#........................
        ............#........#..........g.............
        .............#.........#......................
        ..............#.......#.......................
        ...............#......#.......................
        ................#.....#.......................
        .................#....#.......................
        ..................#...#.......................
        ...................#....#.....................
        ....................#.........................
        .....................#........................
        ......................#.......................
        .......................#......................
        ........................#.....................
        .........................#....................
        ..........................#...................
        ...........................#..................
        ............................#.................
        .............................#................
        ..............................#...............
        ...............................#..............
        ...............................s#.............
        ",
    );
    let graph = &grid_graph::<Centers>(&grid, 7, CornerRule::Never);
    let best = cost(&AStar::new(graph, Hk).solve(query)).unwrap();
    let mut planner = PaperCanonical::new(graph, Hk);
    for _ in 0..2 {
        let mut begun = Begun::default();
        let found = cost(&planner.solve_observed(query, &mut begun)).unwrap();
        assert!(found >= best && begun.0 == 2, "{found}, the optimum is {best}; begun {} times", begun.0);
        let [again, new] = [&mut planner, &mut PaperCanonical::new(graph, Hk)].map(|planner| {
            let mut counters = Counters::default();
            let found = cost(&planner.solve_observed(Ends::new(query.goal, (0, 0)), &mut counters));
            (found, counters)
        });
        assert_eq!(again, new);
    }
}
