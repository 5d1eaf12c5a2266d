//! Measurements on generated maps, with scenarios that the oracle's costs make.

use mediant_bench::{Baseline, Competitor, MeasureError, Problem, ProblemError, measure};
use mediant_formats::{Instance, Scenario};
use mediant_grid::{AsciiMap, CornerRule, Grid, PlacementKind, Rules};
use mediant_moves::FiniteK;
use mediant_oracle::{Explicit, Rng, caves, noise, random_free_vertex};

const SEED: u64 = 1;

/// Up to `count` solvable queries with their optimal costs.
fn scenario(rng: &mut Rng, grid: &Grid, count: usize) -> Scenario {
    let graph = Explicit::new(grid, Rules::Center(CornerRule::Never), Some(FiniteK::N8));
    let mut instances = Vec::new();
    for _ in 0..count {
        let start = random_free_vertex(rng, grid, PlacementKind::Center).expect("a free cell");
        let goal = random_free_vertex(rng, grid, PlacementKind::Center).expect("a free cell");
        let Some(optimal) = graph.costs_from(start).to(goal) else { continue };
        let (width, height) = (grid.width(), grid.height());
        instances.push(Instance { bucket: 0, map: "test.map".into(), width, height, start, goal, optimal });
    }
    Scenario::from_instances(instances).expect("lengths are finite")
}

/// The setups after the baselines: they solve the scenarios' problem.
const EXACT: [&str; 6] =
    ["dijkstra", "canonical,euclidean", "jps,limit=4", "jps-block,intermediate", "jps-plus", "subgoal"];

/// The competitors after these: any-angle paths between corners. The first three are optimal.
const ANY_ANGLE: [&str; 5] =
    ["anya:any:open", "anya:any:open,taut", "subgoal:any:open", "theta:3:open", "astar:3:open,smooth"];

/// The last competitors: the lengths alone, of the scenarios' problem and at any angle.
const DISTANCES: [&str; 2] = ["subgoal", "subgoal:any:open"];

fn competitors() -> Vec<Competitor> {
    let setups =
        ["astar", "astar:2:never", "astar:4:one", "astar:3:always", "astar:3:open", "astar:5:closed"];
    let setups = setups.iter().map(|setup| Competitor::Ours(setup.parse().expect("a setup")));
    let exact = EXACT.map(|setup| Competitor::Ours(setup.parse().expect("a setup")));
    let any_angle = ANY_ANGLE.map(|setup| Competitor::Ours(setup.parse().expect("a setup")));
    let distances = DISTANCES.map(|setup| Competitor::Distance(setup.parse().expect("a setup")));
    let baselines = Baseline::ALL.map(Competitor::Baseline);
    setups.chain(baselines).chain(exact).chain(any_angle).chain(distances).collect()
}

#[test]
fn all_competitors_answer_all_queries() {
    let mut queries = 0;
    for seed in SEED..SEED + 12 {
        let mut rng = Rng::new(seed);
        let grid = if seed % 2 == 0 { noise(&mut rng, 20, 14, 30) } else { caves(&mut rng, 20, 14) };
        let scenario = scenario(&mut rng, &grid, 12);
        if scenario.instances().is_empty() {
            continue;
        }
        let problem = Problem::new("made", "test", grid, &scenario, 1).expect("a problem");
        let record =
            measure(&problem, &competitors(), 2).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        assert_eq!((record.instances, record.timings.len()), (problem.len(), 21), "seed {seed}");
        for timing in &record.timings {
            assert_eq!(timing.passes.len(), 2, "seed {seed}");
            // The preparation of baselines is not measured.
            let ours = Baseline::ALL.iter().all(|baseline| baseline.name() != timing.competitor);
            assert_eq!(timing.preparation.is_some_and(|made| made.bytes > 0 && made.seconds > 0.0), ours);
            assert!(timing.passes.iter().all(|&pass| pass > 0.0) && timing.micros > 0.0, "seed {seed}");
        }
        let cost = |i: usize| record.timings[i].mean_cost;
        let optimum = scenario.instances().iter().map(|instance| instance.optimal).sum::<f64>();
        let optimum = optimum / problem.len() as f64;
        assert!((cost(0) - optimum).abs() < 1e-6 && (cost(6) - optimum).abs() < 1e-6, "seed {seed}");
        assert!((8..14).all(|i| (cost(i) - cost(0)).abs() < 1e-9), "seed {seed}");
        // Fewer moves are no better, more moves under `One` no worse, and no path that cuts corners is
        // shorter than the shortest under `Always`.
        assert!(cost(1) >= cost(0) - 1e-6 && cost(2) <= cost(0) + 1e-6, "seed {seed}");
        assert!(cost(3) <= cost(0) + 1e-6 && cost(7) >= cost(3) - 1e-6, "seed {seed}");
        // Competitor 4 has the gap rule of the five at any angle.
        let best = cost(14);
        assert!([15, 16].into_iter().all(|i| (cost(i) - best).abs() < 1e-9), "seed {seed}");
        assert!(cost(17) >= best - 1e-9, "seed {seed}");
        assert!((best - 1e-9..=cost(4) + 1e-9).contains(&cost(18)), "seed {seed}");
        // Labels round lengths to fractions of 2⁻³¹.
        assert!((cost(19) - cost(0)).abs() < 1e-8 && (cost(20) - best).abs() < 1e-8, "seed {seed}");
        queries += problem.len();
    }
    assert_eq!(
        queries, PINNED,
        "seeds from {SEED}: a change of this number means that other queries were run"
    );
}

/// The number of queries of the test above.
const PINNED: usize = 136;

#[test]
fn wrong_lengths_are_found() {
    let map = AsciiMap::parse("\n....\n.##.\n....\n").expect("a map");
    let instance = |optimal: f64| Instance {
        bucket: 0,
        map: "test.map".into(),
        width: 4,
        height: 3,
        start: (0, 1).into(),
        goal: (3, 1).into(),
        optimal,
    };
    let check = |optimal: f64, competitor: Competitor| {
        let scenario = Scenario::from_instances(vec![instance(5.0), instance(optimal)]).expect("a scenario");
        let problem = Problem::new("made", "test", map.grid.clone(), &scenario, 1).expect("a problem");
        measure(&problem, &[competitor], 1)
    };
    let astar = Competitor::Ours("astar".parse().expect("a setup"));
    let distance = Competitor::Distance("subgoal".parse().expect("a setup"));
    for competitor in [astar, distance, Competitor::Baseline(Baseline::Pathfinding)] {
        assert!(check(5.0, competitor).is_ok());
        for wrong in [4.99, 5.01] {
            match check(wrong, competitor) {
                Err(MeasureError::Answer { index: 1, expected, .. }) => assert_eq!(expected, wrong),
                other => panic!("{competitor}, {wrong}: {other:?}"),
            }
        }
    }
    // This baseline solves another problem: its lengths need not be the scenario's.
    assert!(check(4.99, Competitor::Baseline(Baseline::GridPathfinding)).is_ok());
}

#[test]
fn instances_are_picked_by_index_and_checked() {
    let map = AsciiMap::parse("\n...\n.#.\n").expect("a map");
    let instance = |start: (i32, i32)| Instance {
        bucket: 0,
        map: "test.map".into(),
        width: 3,
        height: 2,
        start: start.into(),
        goal: (0, 0).into(),
        optimal: 0.0,
    };
    let problem = |every: usize, starts: &[(i32, i32)]| {
        let scenario = Scenario::from_instances(starts.iter().map(|&start| instance(start)).collect());
        Problem::new("made", "test", map.grid.clone(), &scenario.expect("a scenario"), every)
    };
    assert_eq!(problem(2, &[(0, 0), (1, 1), (0, 0), (9, 9), (0, 0)]).expect("a problem").len(), 3);
    for wrong in [(1, 1), (3, 0), (0, -1)] {
        match problem(2, &[(0, 0), (0, 0), wrong]) {
            Err(ProblemError::Instances { wrong, .. }) => assert!(wrong.contains("instance 2"), "{wrong}"),
            other => panic!("{wrong:?}: {other:?}"),
        }
    }
    assert!(matches!(problem(1, &[]), Err(ProblemError::Instances { .. })));
}
