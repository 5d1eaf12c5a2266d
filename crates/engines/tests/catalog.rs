//! The catalog keeps what it says of each engine.

mod common;

use std::num::NonZeroU32;

use mediant_engines::{
    Engine, EngineError, Ground, HeuristicName, Hierarchy, Options, Prebuilt, Setup, SetupError, SharedRule,
    Solver, Variant, build, distances,
};
use mediant_grid::{CornerRule, DiagonalGap, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, K};
use mediant_search::{Guarantee, Query, QueryError, Smoothing};

use common::{grid, k};

const NEVER: Rules = Rules::Center(CornerRule::Never);
const OPEN: Rules = Rules::Corner(DiagonalGap::Open);

/// The engine on the problem that is meant where none is said.
fn plain(engine: Engine) -> Setup {
    let k = engine.about().default_k();
    Setup::new(engine, k, engine.about().default_rules(k))
}

fn solver(setup: Setup, prebuilt: Prebuilt) -> Solver {
    Solver::new(setup, &grid(), prebuilt).unwrap_or_else(|error| panic!("{setup}: {error}"))
}

#[test]
fn every_setup_makes_the_planner_that_it_promises() {
    let query = Query::new((0, 0), (8, 4));
    let mut setups = 0;
    for rules in Rules::ALL {
        let anya = Setup::new(Engine::Anya, K::Any, rules);
        let any_angle =
            Solver::new(anya, &grid(), Prebuilt::default()).and_then(|mut anya| Ok(anya.solve(query)?));
        let shortest = match any_angle {
            Ok(outcome) => outcome.path().expect("there is a way").cost(),
            Err(_) => query.start.distance(query.goal),
        };
        for k in (2..=5).map(|n| K::Finite(k(n))).chain([K::Any]) {
            let all: Vec<Setup> = Setup::all(k, rules).collect();
            let Some(&first) = all.first() else {
                assert_eq!((k, rules.placement()), (K::Any, PlacementKind::Center), "only this is left out");
                continue;
            };
            let engine = if k == K::Any { Engine::Anya } else { Engine::AStar };
            assert_eq!(first, Setup::new(engine, k, rules));
            let best = solver(first, Prebuilt::default()).solve(query).expect("both ends are free");
            let best = best.path().expect("there is a way").cost();
            for setup in all {
                let mut solver = solver(setup, Prebuilt::default());
                assert_eq!(solver.guarantee(), setup.guarantee(), "{setup}");
                let answer = solver.solve_counted(query);
                setups += 1;
                let as_published = (setup.engine, setup.variant()) == (Engine::Chpa, Some(Variant::Paper));
                if as_published && k == K::Finite(FiniteK::N4) {
                    // The windows of its segments join only what is joined within them.
                    assert!(matches!(answer, Err(QueryError::GaveUp { .. })), "{setup}: {answer:?}");
                    continue;
                }
                let (outcome, counters) = answer.expect("both ends are free");
                let cost = outcome.path().expect("there is a way").cost();
                match setup.guarantee() {
                    Guarantee::Suboptimal => {
                        let least = if setup.paths() == K::Any { shortest } else { best };
                        assert!(cost >= least - 1e-9, "{setup}: {cost}, {least}");
                    }
                    Guarantee::AtMost(_) => {
                        assert!((shortest - 1e-9..=best + 1e-9).contains(&cost), "{setup}: {cost}, {best}");
                    }
                    _ => assert!((cost - best).abs() < 1e-9, "{setup}: {cost}, {best}"),
                }
                assert!(counters.generated > 0 && counters.expanded > 0, "{setup}");
                assert_eq!(solver.solve(query), Ok(outcome), "{setup}: the same again");
                assert!(solver.preprocessing().index_bytes > 0 && !solver.preprocessing().time.is_zero());
            }
        }
    }
    // 4 of A*, Dijkstra, wavefront, 4 of canonical, 5 of jps, 3 each of theta and lazy-theta; for k ≤ 3 also 5 of jps-block and 4 of
    // jps-plus; 3 that are smoothed. Of each gap rule anya, and once smoothed.
    let grids = 5 * (4 * (4 + 1 + 1 + 4 + 5 + 3 + 3 + 3) + 2 * (5 + 4)) + 2 * 2;
    // 4 of subgoal, and once smoothed: at corners for each k and for any, at centers for k = 2 under 3 rules and for k = 3 under one. 4 of
    // subgoal-theta at corners.
    let subgoals = 5 * (2 * (4 + 1) + 3 + 1) + 4 * 2 * 4;
    // 8 of hpa and 10 of chpa, each once smoothed, for the same k at centers.
    assert_eq!(setups, grids + subgoals + (3 + 1) * (8 + 1 + 10 + 1));
}

#[test]
fn every_engine_is_in_its_own_range_of_k() {
    for engine in Engine::ALL {
        // Under one of these rules an engine takes every k that it takes at all.
        let about = engine.about();
        let rules = if about.placements.contains(&PlacementKind::Corner) { OPEN } else { NEVER };
        let setup = |k: K| Setup::new(engine, k, rules);
        let refused = |k: K, error: SetupError| {
            assert_eq!(setup(k).check(), Err(error.clone()));
            let solver = Solver::new(setup(k), &grid(), Prebuilt::default()).map(|_| ());
            assert_eq!(solver, Err(EngineError::Setup(error)));
        };
        if let Some(max) = about.max_k {
            let [least, most, beyond] = [2, max, max + 1].map(k);
            assert_eq!(
                (setup(least.into()).check(), setup(most.into()).check()),
                (Ok(()), Ok(())),
                "{engine}"
            );
            refused(beyond.into(), SetupError::K { engine, max, k: beyond });
            let others = "anya, subgoal".to_owned();
            if about.any {
                assert_eq!((engine, setup(K::Any).check()), (Engine::Subgoal, Ok(())));
            } else {
                refused(K::Any, SetupError::NeedsFiniteK { engine, max, others });
            }
        } else {
            assert_eq!((engine, setup(K::Any).check()), (Engine::Anya, Ok(())));
            refused(k(2).into(), SetupError::NeedsAny { engine, k: k(2) });
        }
    }
}

#[test]
fn every_engine_takes_the_placements_that_it_says() {
    for engine in Engine::ALL {
        for rules in Rules::ALL {
            let (about, placement) = (engine.about(), rules.placement());
            // Some engines take centers only for the smallest k under every rule.
            let k = about.max_k.map_or(K::Any, |_| K::Finite(k(2)));
            let said = Setup { rules, k, ..plain(engine) }.check();
            if about.placements.contains(&placement) {
                assert_eq!(said, Ok(()), "{engine}, {rules}");
            } else {
                let said = said.expect_err("it does not take it").to_string();
                let needs = match placement {
                    PlacementKind::Center => "placement corner; for center choose astar, dijkstra,",
                    PlacementKind::Corner => "placement center; for corner choose astar, dijkstra,",
                };
                let others = match placement {
                    PlacementKind::Center => " lazy-theta, subgoal, hpa, chpa",
                    PlacementKind::Corner => " lazy-theta, anya, subgoal, subgoal-theta",
                };
                assert!(
                    said.starts_with(&format!("{engine} needs {needs}")) && said.ends_with(others),
                    "{said}"
                );
            }
        }
    }
}

#[test]
fn a_ground_is_for_its_own_k_and_rules() {
    let setup = |text: &str| text.parse::<Setup>().expect("a setup");
    let ground = |text: &str| Ground::new(setup(text), &grid()).expect("a setup that was checked");
    for (ours, others) in [
        ("astar:3:open", "theta:3:open,taut"),
        ("anya", "anya:any:open,smooth"),
        ("jps:4:one", "astar:4:one"),
    ] {
        let solver = Solver::on(setup(ours), &ground(others), Prebuilt::default());
        let mut solver = solver.unwrap_or_else(|error| panic!("{ours} on the ground of {others}: {error}"));
        let alone = Solver::new(setup(ours), &grid(), Prebuilt::default())
            .expect("a solver")
            .solve_counted(Query::new((0, 0), (8, 4)));
        assert_eq!(solver.solve_counted(Query::new((0, 0), (8, 4))), alone, "{ours}");
    }
    for (ours, others) in [
        ("astar:3:open", "astar:4:open"),
        ("astar:3:open", "astar:3:closed"),
        ("anya", "astar:3:open"),
        ("astar:3:open", "anya"),
    ] {
        let refused = Solver::on(setup(ours), &ground(others), Prebuilt::default()).map(|_| ());
        assert!(
            matches!(refused, Err(EngineError::Ground { .. })),
            "{ours} on the ground of {others}: {refused:?}"
        );
    }
    assert!(matches!(
        Ground::new(Setup::new(Engine::Anya, K::Any, NEVER), &grid()),
        Err(EngineError::Setup(_))
    ));
    let said = Solver::on(setup("anya"), &ground("astar:3:open"), Prebuilt::default()).map(|_| ());
    assert_eq!(
        said.map_err(|error| error.to_string()),
        Err("needs the ground of k = any under corner, gap open, found that of k = 3 under corner, gap open"
            .to_owned())
    );
}

#[test]
fn options_are_refused_where_they_mean_nothing() {
    let chosen = |options: &str| {
        let setup = |engine: Engine| format!("{engine}{options}").parse::<Setup>();
        let takers = Engine::ALL.into_iter().filter(|&engine| setup(engine).is_ok());
        takers.map(Engine::name).collect::<Vec<_>>()
    };
    assert_eq!(chosen("").len(), Engine::ALL.len());
    let guided = ["astar", "canonical", "jps", "jps-block", "jps-plus", "theta", "lazy-theta"];
    assert_eq!(chosen(",euclidean"), [&guided[..], &["chpa"]].concat());
    assert_eq!(chosen(",squared"), ["astar", "chpa"]);
    assert_eq!((chosen(",smooth").len(), chosen(",taut").len()), (Engine::ALL.len(), Engine::ALL.len()));
    assert_eq!(chosen(",paper"), ["canonical", "chpa"]);
    assert_eq!((chosen(",exact"), chosen(",complete")), (vec!["canonical"], vec!["chpa"]));
    assert_eq!((chosen(",side=3"), chosen(",refined")), (vec!["hpa", "chpa"], vec!["hpa"]));
    for option in ["second=zero", "step=3", "detour=2"] {
        assert_eq!(chosen(&format!(",{option}")), ["chpa"], "{option}");
    }
    assert_eq!(chosen(",limit=4"), ["jps", "jps-block"]);
    assert_eq!(chosen(",intermediate"), ["jps", "jps-block", "jps-plus"]);
    for levels in ["1", "4", "all"] {
        assert_eq!(chosen(&format!(",levels={levels}")), ["subgoal", "subgoal-theta", "hpa"]);
    }
    let options = Options { jump_limit: NonZeroU32::new(4), ..Options::default() };
    let error = Setup { options, ..Setup::new(Engine::AStar, k(3), NEVER) }.check().expect_err("no jumps");
    assert_eq!(error.to_string(), "astar takes no jump limit: leave it out, or choose jps, jps-block");
}

#[test]
fn what_is_left_out_has_its_default() {
    let setup = |text: &str| text.parse::<Setup>().expect("a setup");
    assert_eq!(setup("astar").heuristic(), Some(HeuristicName::Hk));
    assert_eq!(setup("dijkstra").heuristic(), Some(HeuristicName::Zero));
    assert_eq!((setup("anya").heuristic(), setup("anya")), (None, setup("anya:any:open")));
    assert_eq!((setup("theta").to_string(), setup("anya:any").rules), ("theta:3:never".to_owned(), OPEN));
    assert_eq!(
        (setup("subgoal"), setup("subgoal-theta")),
        (setup("subgoal:3:never"), setup("subgoal-theta:3:open"))
    );
    assert_eq!((setup("subgoal").heuristic(), setup("subgoal-theta").heuristic()), (None, None));
    let levels = |n| NonZeroU32::new(n).map(Hierarchy::Levels);
    assert_eq!(
        (setup("astar").hierarchy(), setup("subgoal").hierarchy()),
        (None, Some(Hierarchy::Contracted))
    );
    assert_eq!(
        ["subgoal,levels=1", "subgoal-theta"].map(|text| setup(text).hierarchy()),
        [levels(1), levels(2)]
    );
    assert_eq!(setup("subgoal-theta,levels=all").hierarchy(), Some(Hierarchy::AllLevels));
    let paths = [
        "astar:4",
        "subgoal:4:open",
        "theta",
        "lazy-theta",
        "astar,smooth",
        "jps,taut",
        "anya",
        "subgoal-theta",
    ]
    .map(|text| setup(text).paths());
    assert_eq!(paths[..2], [K::Finite(k(4)); 2]);
    assert_eq!(paths[2..], [K::Any; 6]);
    let promised = ["astar:4:one,smooth", "theta,taut", "anya,taut", "wavefront:2,taut", "wavefront,taut"];
    assert_eq!(
        promised.map(|text| setup(text).guarantee()),
        [
            Guarantee::AtMost(k(4)),
            Guarantee::Suboptimal,
            Guarantee::OptimalAnyAngle,
            Guarantee::AtMost(k(2)),
            Guarantee::Suboptimal,
        ]
    );
    assert_eq!((setup("canonical").variant(), setup("jps").variant()), (Some(Variant::Exact), None));
    let over = ["jps:4", "subgoal:9:closed", "wavefront:2", "anya,taut", "subgoal:any"]
        .map(|text| setup(text).optimal_over());
    let ks = [4, 9, 2].map(|n| Some(K::Finite(k(n))));
    assert_eq!((&over[..3], &over[3..]), (&ks[..], &[Some(K::Any); 2][..]));
    for text in ["astar,taut", "theta", "canonical,paper", "subgoal,taut", "subgoal-theta"] {
        assert_eq!(setup(text).optimal_over(), None, "{text}");
    }
    let solves = |text: &str| setup(text).solves_scenarios();
    assert!(solves("subgoal") && !solves("subgoal:2:never") && !solves("subgoal-theta"));
    assert!(solves("jps-plus") && solves("canonical") && !solves("canonical,paper") && !solves("wavefront"));
    assert!(
        !solves("jps:3:one")
            && !solves("jps:4")
            && !solves("astar,smooth")
            && !solves("theta")
            && !solves("anya")
    );
}

#[test]
fn setups_are_read_as_they_are_written() {
    let mut setups = 0;
    for rules in Rules::ALL {
        for k in (2..=12).map(|n| K::Finite(k(n))).chain([K::Any]) {
            for setup in Setup::all(k, rules) {
                assert_eq!(setup.to_string().parse(), Ok(setup));
                setups += 1;
            }
        }
    }
    assert!(setups > 1_300, "{setups}");
    let many = "chpa:2:one,euclidean,side=4,second=squared,step=5,detour=7,taut";
    assert_eq!(many.parse::<Setup>().map(|setup| setup.to_string()), Ok(many.to_owned()));
    let many = "hpa:3:never,levels=2,side=4,refined";
    assert_eq!(many.parse::<Setup>().map(|setup| setup.to_string()), Ok(many.to_owned()));
    let both = Options {
        heuristic: Some(HeuristicName::Zero),
        smoothing: Some(Smoothing::Taut),
        ..Options::default()
    };
    let both = Setup { options: both, ..Setup::new(Engine::LazyTheta, k(5), OPEN) };
    assert_eq!(
        (both.to_string().as_str(), "lazy-theta:5:open,taut,zero".parse()),
        ("lazy-theta:5:open,zero,taut", Ok(both))
    );
    assert_eq!("astar".parse(), "astar:3:never".parse::<Setup>());
    assert_eq!(format!("{:>16}|", "jps:4:open".parse::<Setup>().expect("a setup")), "      jps:4:open|");
}

#[test]
fn each_wrong_part_is_named() {
    let wrong = |text: &str| text.parse::<Setup>().expect_err("no setup").to_string();
    let names = "astar, dijkstra, wavefront, canonical, jps, jps-block, jps-plus, theta, lazy-theta, anya, \
                 subgoal, subgoal-theta, hpa, chpa";
    let form = "expected ENGINE[:K[:RULE]][,OPTION…], found `warp`";
    assert_eq!(wrong("warp"), format!("{form}: the engines are {names}"));
    for k in ["", "x", "1", "-3"] {
        assert!(wrong(&format!("astar:{k}")).ends_with("K is a number from 2 to 12"));
    }
    assert!(
        wrong("jps-block:x").ends_with("K is a number from 2 to 3") && wrong("anya:x").ends_with("K is any")
    );
    assert!(wrong("jps-block:4").ends_with("jps-block needs a k from 2 to 3, found 4"));
    assert!(wrong("theta:any").ends_with("theta needs a k from 2 to 12; for any choose anya, subgoal"));
    assert!(wrong("subgoal:x").ends_with("K is a number from 2 to 12, or any"));
    assert!(
        wrong("subgoal-theta:any")
            .ends_with("subgoal-theta needs a k from 2 to 12; for any choose anya, subgoal")
    );
    assert!(wrong("subgoal:13:open").ends_with("subgoal needs a k from 2 to 12, found 13"));
    assert!(
        wrong("astar,levels=2")
            .ends_with("astar takes no levels: leave it out, or choose subgoal, subgoal-theta, hpa")
    );
    for levels in ["levels", "levels=", "levels=0", "levels=-1", "levels=some"] {
        assert!(
            wrong(&format!("subgoal,{levels}")).contains("the options are hk, euclidean, zero,"),
            "{levels}"
        );
    }

    assert!(
        wrong("anya:3")
            .ends_with("anya searches every direction, not those of k = 3: leave k out, or say any")
    );
    assert!(wrong("anya:any:one").contains("anya needs placement corner; for center choose astar, "));
    assert!(wrong("astar:3:sometimes").ends_with("the rules are never, one, always, open, closed"));
    assert!(wrong("astar:3:one:two").ends_with("nothing but options may follow the rule"));
    for option in ["", "limit=0", "limit=x", "limit", "fast"] {
        assert!(wrong(&format!("jps,{option}")).contains("the options are hk, euclidean, zero,"), "{option}");
    }
    assert!(wrong("jps,best").ends_with(
        "squared, exact, complete, paper, limit=N, intermediate, levels=N, levels=all, side=N, refined, second=HEURISTIC, \
         step=N, detour=N, smooth, taut"
    ));
    assert!(wrong("anya,zero").contains("anya takes no heuristic: leave it out, or choose astar, "));
    assert!(wrong("jps,paper").ends_with("jps takes no variant: leave it out, or choose canonical, chpa"));
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
    for engine in Engine::ALL.into_iter().filter(|&engine| engine.about().index.is_none()) {
        let setup = plain(engine);
        let error = format!("{engine} has no index: choose jps-plus, subgoal, subgoal-theta, hpa, chpa");
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
        let found = distances(plain(engine), &grid(), Vertex::new(0, 0));
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
