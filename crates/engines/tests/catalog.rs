//! The catalog keeps what it says of each engine.

use std::{num::NonZeroU32, sync::Arc};

use mediant_engines::{
    Engine, EngineError, HeuristicName, Options, Prebuilt, Setup, SetupError, SharedRule, Solver, Variant,
    build, distances,
};
use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Grid, Rules, Vertex};
use mediant_moves::K;
use mediant_search::{Guarantee, Query};

const NEVER: Rules = Rules::Center(CornerRule::Never);

fn k(k: u32) -> K {
    K::new(k).expect("k is at least 2")
}

fn grid() -> Arc<Grid> {
    let drawing = "
        ......#..
        .##...#..
        .#....#..
        ...#.....
        ...#..#..
    ";
    Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid)
}

fn solver(setup: Setup, prebuilt: Prebuilt) -> Solver {
    Solver::new(setup, &grid(), prebuilt).unwrap_or_else(|error| panic!("{setup}: {error}"))
}

#[test]
fn every_setup_makes_the_planner_that_it_promises() {
    let query = Query::new((0, 0), (8, 4));
    let mut setups = 0;
    for rules in Rules::ALL {
        for k in (2..=5).map(k) {
            let all: Vec<Setup> = Setup::all(k, rules).collect();
            assert_eq!(all[0], Setup::new(Engine::AStar, k, rules));
            let best = solver(all[0], Prebuilt::default()).solve(query).expect("both ends are free");
            let best = best.path().expect("there is a way").cost();
            for setup in all {
                let mut solver = solver(setup, Prebuilt::default());
                assert_eq!(solver.guarantee(), setup.guarantee(), "{setup}");
                let (outcome, counters) = solver.solve_counted(query).expect("both ends are free");
                let cost = outcome.path().expect("there is a way").cost();
                match setup.guarantee() {
                    Guarantee::Suboptimal => assert!(cost >= best - 1e-9, "{setup}: {cost}, {best}"),
                    _ => assert!((cost - best).abs() < 1e-9, "{setup}: {cost}, {best}"),
                }
                assert!(counters.generated > 0, "{setup}");
                assert_eq!(solver.solve(query), Ok(outcome), "{setup}: the same again");
                assert!(solver.preprocessing().index_bytes > 0 && !solver.preprocessing().time.is_zero());
                setups += 1;
            }
        }
    }
    // 3 of A*, Dijkstra, wavefront, 4 of canonical, 5 of jps; for k ≤ 3 also 5 of jps-block and 4 of jps-plus.
    assert_eq!(setups, 5 * (4 * (3 + 1 + 1 + 4 + 5) + 2 * (5 + 4)));
}

#[test]
fn every_engine_is_in_its_own_range_of_k() {
    for engine in Engine::ALL {
        let max = engine.about().max_k;
        let setup = |k| Setup::new(engine, k, NEVER);
        assert_eq!((setup(k(2)).check(), setup(k(max)).check()), (Ok(()), Ok(())), "{engine}");
        let error = SetupError::K { engine, max, k: max + 1 };
        assert_eq!(setup(k(max + 1)).check(), Err(error.clone()));
        let refused = Solver::new(setup(k(max + 1)), &grid(), Prebuilt::default()).map(|_| ());
        assert_eq!(refused, Err(EngineError::Setup(error)));
    }
}

#[test]
fn options_are_refused_where_they_mean_nothing() {
    let chosen = |options: &str| {
        let setup = |engine: Engine| format!("{engine}:3{options}").parse::<Setup>();
        let takers = Engine::ALL.into_iter().filter(|&engine| setup(engine).is_ok());
        takers.map(Engine::name).collect::<Vec<_>>()
    };
    assert_eq!(chosen("").len(), Engine::ALL.len());
    assert_eq!(chosen(",euclidean"), ["astar", "canonical", "jps", "jps-block", "jps-plus"]);
    assert_eq!(chosen(",paper"), ["canonical"]);
    assert_eq!(chosen(",limit=4"), ["jps", "jps-block"]);
    assert_eq!(chosen(",intermediate"), ["jps", "jps-block", "jps-plus"]);
    let options = Options { jump_limit: NonZeroU32::new(4), ..Options::default() };
    let error = Setup { options, ..Setup::new(Engine::AStar, k(3), NEVER) }.check().expect_err("no jumps");
    assert_eq!(error.to_string(), "astar takes no jump limit: leave it out, or choose jps, jps-block");
}

#[test]
fn what_is_left_out_has_its_default() {
    let setup = |text: &str| text.parse::<Setup>().expect("a setup");
    assert_eq!(setup("astar").heuristic(), HeuristicName::Hk);
    assert_eq!(setup("dijkstra").heuristic(), HeuristicName::Zero);
    assert_eq!((setup("canonical").variant(), setup("jps").variant()), (Some(Variant::Exact), None));
    let solves = |text: &str| setup(text).solves_scenarios();
    assert!(solves("jps-plus") && solves("canonical") && !solves("canonical,paper") && !solves("wavefront"));
    assert!(!solves("jps:3:one") && !solves("jps:4"));
}

#[test]
fn setups_are_read_as_they_are_written() {
    let mut setups = 0;
    for rules in Rules::ALL {
        for k in (2..=12).map(k) {
            for setup in Setup::all(k, rules) {
                assert_eq!(setup.to_string().parse(), Ok(setup));
                setups += 1;
            }
        }
    }
    assert!(setups > 700, "{setups}");
    assert_eq!("astar".parse(), "astar:3:never".parse::<Setup>());
    assert_eq!(format!("{:>16}|", "jps:4:open".parse::<Setup>().expect("a setup")), "      jps:4:open|");
}

#[test]
fn each_wrong_part_is_named() {
    let wrong = |text: &str| text.parse::<Setup>().expect_err("no setup").to_string();
    let names = "astar, dijkstra, wavefront, canonical, jps, jps-block, jps-plus";
    let form = "expected ENGINE[:K[:RULE]][,OPTION…], found `warp`";
    assert_eq!(wrong("warp"), format!("{form}: the engines are {names}"));
    for k in ["", "x", "1", "13", "-3"] {
        assert!(wrong(&format!("astar:{k}")).ends_with("K is a number from 2 to 12"));
    }
    assert!(wrong("jps-block:4").ends_with("K is a number from 2 to 3"));
    assert!(wrong("astar:3:sometimes").ends_with("the rules are never, one, always, open, closed"));
    assert!(wrong("astar:3:one:two").ends_with("nothing but options may follow the rule"));
    for option in ["", "limit=0", "limit=x", "limit", "fast"] {
        assert!(wrong(&format!("jps,{option}")).contains("the options are hk, euclidean, zero,"), "{option}");
    }
    assert!(wrong("jps,paper").ends_with("jps takes no variant: leave it out, or choose canonical"));
}

#[test]
fn a_saved_index_is_as_good_as_a_new_one() {
    for rules in Rules::ALL {
        for k in [2, 3].map(k) {
            let setup = Setup::new(Engine::JpsPlus, k, rules);
            let (bytes, took) = build(setup, &grid()).expect("an index");
            assert_eq!(took.index_bytes, bytes.len() as u64);
            let index = Prebuilt { index: Some(bytes.clone()), rule: None };
            let query = Query::new((0, 0), (8, 4));
            assert_eq!(
                solver(setup, index).solve_counted(query),
                solver(setup, Prebuilt::default()).solve_counted(query)
            );
            let mut damaged = bytes;
            damaged[0] ^= 1;
            let index = Prebuilt { index: Some(damaged), rule: None };
            let refused = Solver::new(setup, &grid(), index).map(|_| ());
            assert!(matches!(refused, Err(EngineError::JumpTable(_))), "{refused:?}");
        }
    }
}

#[test]
fn only_some_engines_have_an_index_or_distances() {
    for engine in Engine::ALL.into_iter().filter(|&engine| engine != Engine::JpsPlus) {
        let setup = Setup::new(engine, k(3), NEVER);
        let error = format!("{engine} has no index: choose jps-plus");
        let said = [
            build(setup, &grid()).map(|_| ()),
            Solver::new(setup, &grid(), Prebuilt { index: Some(Vec::new()), rule: None }).map(|_| ()),
        ];
        assert_eq!(
            said.map(|said| said.map_err(|error| error.to_string())),
            [Err(error.clone()), Err(error)]
        );
    }
    for engine in Engine::ALL {
        let found = distances(Setup::new(engine, k(2), NEVER), &grid(), Vertex::new(0, 0));
        match found {
            // The wall parts nothing: every free cell is reached.
            Ok(found) => {
                assert!(matches!(engine, Engine::Dijkstra | Engine::Wavefront));
                assert_eq!(found.len() as u64, grid().free_cells());
                assert_eq!((found[0], found[1]), ((Vertex::new(0, 0), 0.0), (Vertex::new(1, 0), 1.0)));
            }
            Err(error) => assert_eq!(
                error.to_string(),
                format!("{engine} has no distances to all vertices: choose dijkstra, wavefront")
            ),
        }
    }
    let blocked = distances(Setup::new(Engine::Dijkstra, k(3), NEVER), &grid(), Vertex::new(6, 0));
    assert!(matches!(blocked, Err(EngineError::Query(_))), "{blocked:?}");
    let corner = Setup::new(Engine::Dijkstra, k(4), Rules::Corner(DiagonalGap::Closed));
    let found = distances(corner, &grid(), Vertex::new(0, 0)).expect("a free start");
    let (_, distance) = found.iter().find(|(at, _)| *at == Vertex::new(2, 1)).expect("it is reached");
    assert!((distance - 5.0_f64.sqrt()).abs() < 1e-9, "{distance}");
}

#[test]
fn a_shared_rule_changes_nothing() {
    let query = Query::new((0, 0), (8, 4));
    for rules in Rules::ALL {
        for engine in [Engine::Canonical, Engine::Jps] {
            let setup = Setup::new(engine, k(5), rules);
            let alone = solver(setup, Prebuilt::default()).solve_counted(query);
            // Also one for another k, which is then not used.
            for shared in [5, 4] {
                let rule = Some(SharedRule::new(k(shared), rules));
                assert_eq!(
                    solver(setup, Prebuilt { index: None, rule }).solve_counted(query),
                    alone,
                    "{setup}"
                );
            }
        }
    }
}
