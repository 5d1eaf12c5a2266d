//! The catalog is true of each engine, and wrong setups are refused.

use std::num::NonZeroU32;

use mediant::{
    Engine, Error, Motion, Setup,
    errors::SetupError,
    options::{ConfiguredEngine, GuidedOptions, HeuristicName, JumpOptions, Levels, Variant},
};
use mediant_grid::{DiagonalGap, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, K};
use mediant_search::{Ends, Guarantee, QueryError, Smoothing};

use super::{NEVER, OPEN, build, index, k, levels, map, planner, read, setup};

/// The engine with its default options, k and rules.
fn plain(engine: Engine) -> Setup {
    let k = engine.capabilities().default_k;
    Setup::new(engine, Motion::new(k, engine.capabilities().default_rules(k)))
}

/// The query that all setups answer.
fn query() -> Ends {
    Ends::new((0, 0), (8, 4))
}

/// The length of the shortest path at any angle under these rules. At centers, where no engine finds it, the
/// straight line.
fn any_angle_length(rules: Rules) -> f64 {
    let anya = Setup::new(Engine::Anya, Motion::new(K::Any, rules));
    match anya.planner(&map()) {
        Ok(mut anya) => {
            anya.find(query()).expect("both ends are free").path().expect("there is a path").cost()
        }
        Err(_) => query().start.distance(query().goal),
    }
}

/// Whether the engine prepares nothing.
fn prepares_nothing(setup: Setup) -> bool {
    match setup.engine {
        ConfiguredEngine::AStar(_)
        | ConfiguredEngine::Dijkstra
        | ConfiguredEngine::Wavefront
        | ConfiguredEngine::Theta(_)
        | ConfiguredEngine::LazyTheta(_) => true,
        ConfiguredEngine::Canonical(own) => own.variant == Some(Variant::Paper),
        _ => false,
    }
}

/// Checks a setup's planner against its guarantee: `best` is the length of the shortest path over its k,
/// `shortest` that of the shortest at any angle.
fn check(setup: Setup, best: f64, shortest: f64) {
    let index = index(setup, &map()).unwrap_or_else(|error| panic!("{setup}: {error}"));
    assert_eq!(index.memory_bytes() == 0, prepares_nothing(setup), "{setup}");
    let mut planner = index.planner();
    assert_eq!(planner.guarantee(), setup.guarantee(), "{setup}");
    let answer = planner.find_counted(query());
    let (kind, variant) = (setup.engine.kind(), setup.engine.variant());
    if (kind, variant, setup.k()) == (Engine::Chpa, Some(Variant::Paper), K::Finite(FiniteK::N4)) {
        // As published, the windows of its segments join only what is joined within them.
        assert!(matches!(answer, Err(QueryError::GaveUp { .. })), "{setup}: {answer:?}");
        return;
    }
    let (answer, counters) = answer.expect("both ends are free");
    let cost = answer.path().expect("there is a path").cost();
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
    // Hub labels answer without a search.
    let searches = levels(planner.index()) != Some(Levels::Labels);
    assert_eq!((counters.generated > 0, counters.expanded > 0), (searches, searches), "{setup}");
    assert_eq!(planner.find(query()), Ok(answer), "{setup}: the same answer again");
}

#[test]
fn every_setup_makes_the_planner_that_it_promises() {
    let mut setups = 0;
    for rules in Rules::ALL {
        let shortest = any_angle_length(rules);
        for k in (2..=5).map(|n| K::Finite(k(n))).chain([K::Any]) {
            let all: Vec<Setup> = Setup::all(Motion::new(k, rules)).collect();
            let Some(&first) = all.first() else {
                assert_eq!(
                    (k, rules.placement()),
                    (K::Any, PlacementKind::Center),
                    "only here is there none"
                );
                continue;
            };
            let engine = if k == K::Any { Engine::Anya } else { Engine::AStar };
            assert_eq!(first, Setup::new(engine, Motion::new(k, rules)));
            let best = planner(first).find(query()).expect("both ends are free");
            let best = best.path().expect("there is a path").cost();
            setups += all.len();
            all.into_iter().for_each(|setup| check(setup, best, shortest));
        }
    }
    // On grid graphs: 4 setups of astar, 1 each of dijkstra and wavefront, 4 of canonical, 5 of jps, 3 each
    // of theta and lazy-theta, 2 of landmarks, and 3 that are smoothed; for k ≤ 3 also 5 of jps-block and 4
    // of jps-plus.
    let grids = 5 * (4 * (4 + 1 + 1 + 4 + 5 + 3 + 3 + 2 + 3) + 2 * (5 + 4));
    // anya, plain and smoothed, for each k and for ∞ under each gap rule.
    let anya = 5 * 2 * 2;
    // 8 of subgoal and one that is smoothed: at corners for each k and for ∞, at centers for k = 2 under 3
    // rules and for k = 3 under one. 4 of subgoal-theta at corners.
    let subgoals = (5 * 2 + 4) * (8 + 1) + 4 * 2 * 4;
    // 8 of hpa and 10 of chpa, and one each that is smoothed, for the same k at centers.
    assert_eq!(setups, grids + anya + subgoals + (3 + 1) * (8 + 1 + 10 + 1));
}

#[test]
fn every_engine_takes_the_k_that_it_says() {
    for engine in Engine::ALL {
        // Under these rules an engine takes every k that it takes at all.
        let capabilities = engine.capabilities();
        let rules = if capabilities.placements.contains(&PlacementKind::Corner) { OPEN } else { NEVER };
        let setup = |k: K| Setup::new(engine, Motion::new(k, rules));
        let refused = |k: K, error: SetupError| {
            assert_eq!(setup(k).check(), Err(error.clone()));
            let planner = setup(k).planner(&map());
            assert!(matches!(planner, Err(Error::Setup(found)) if found == error), "{engine}");
        };
        let max = capabilities.max_k;
        let [least, most, too_large] = [2, max, max + 1].map(k);
        assert_eq!((setup(least.into()).check(), setup(most.into()).check()), (Ok(()), Ok(())), "{engine}");
        refused(too_large.into(), SetupError::K { engine, max, k: too_large });
        let others = "anya, subgoal".to_owned();
        if capabilities.any {
            assert!(matches!(engine, Engine::Anya | Engine::Subgoal), "{engine}");
            assert_eq!(setup(K::Any).check(), Ok(()), "{engine}");
        } else {
            refused(K::Any, SetupError::NeedsFiniteK { engine, max, others });
        }
    }
}

#[test]
fn every_engine_takes_the_placements_that_it_says() {
    for engine in Engine::ALL {
        for rules in Rules::ALL {
            let (capabilities, placement) = (engine.capabilities(), rules.placement());
            // k = 2, since some engines at centers take larger k only under some rules.
            let said = Setup::new(engine, Motion::new(K::N4, rules)).check();
            if capabilities.placements.contains(&placement) {
                assert_eq!(said, Ok(()), "{engine}, {rules}");
            } else {
                let said = said.expect_err("the engine does not take this placement").to_string();
                let needs = match placement {
                    PlacementKind::Center => "placement corner; for center choose astar, dijkstra,",
                    PlacementKind::Corner => "placement center; for corner choose astar, dijkstra,",
                };
                let others = match placement {
                    PlacementKind::Center => " lazy-theta, subgoal, hpa, chpa, landmarks",
                    PlacementKind::Corner => " lazy-theta, anya, subgoal, subgoal-theta, landmarks",
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
fn a_search_space_is_for_its_own_k_and_rules() {
    let space = |text: &str| setup(text).space(&map()).expect("a setup that was checked");
    let index = |ours: &str, others: &str| setup(ours).prepare(&space(others));
    for (ours, others) in [
        ("astar:3:open", "theta:3:open,taut"),
        ("anya", "anya:any:open,smooth"),
        ("jps:4:one", "astar:4:one"),
    ] {
        let index =
            index(ours, others).unwrap_or_else(|error| panic!("{ours} in the space of {others}: {error}"));
        let alone = planner(setup(ours)).find_counted(query());
        assert_eq!(index.planner().find_counted(query()), alone, "{ours}");
    }
    for (ours, others) in [
        ("astar:3:open", "astar:4:open"),
        ("astar:3:open", "astar:3:closed"),
        ("anya", "astar:3:open"),
        ("astar:3:open", "anya"),
    ] {
        let refused = index(ours, others).map(|_| ());
        assert!(matches!(refused, Err(Error::Mismatch(_))), "{ours} in the space of {others}: {refused:?}");
    }
    assert!(matches!(
        Setup::new(Engine::Anya, Motion::new(K::Any, NEVER)).space(&map()),
        Err(Error::Setup(_))
    ));
    let said = index("anya", "astar:3:open").map(|_| ()).map_err(|error| error.to_string());
    let expected = format!(
        "the setup is for every map, corner, gap open, k = any; the space is for {}, corner, gap open, k = 3: \
         use the setup with what it was made for, or make a new one",
        map().id()
    );
    assert_eq!(said, Err(expected));
}

#[test]
fn engines_take_only_their_own_options() {
    let takers = |options: &str| {
        let setup = |engine: Engine| format!("{engine}{options}").parse::<Setup>();
        let takers = Engine::ALL.into_iter().filter(|&engine| setup(engine).is_ok());
        takers.map(Engine::name).collect::<Vec<_>>()
    };
    assert_eq!(takers("").len(), Engine::ALL.len());
    let guided = ["astar", "canonical", "jps", "jps-block", "jps-plus", "theta", "lazy-theta"];
    assert_eq!(takers(",euclidean"), [&guided[..], &["chpa"]].concat());
    assert_eq!(takers(",squared"), ["astar", "chpa"]);
    assert_eq!((takers(",smooth").len(), takers(",taut").len()), (Engine::ALL.len(), Engine::ALL.len()));
    assert_eq!(takers(",paper"), ["canonical", "chpa"]);
    assert_eq!((takers(",exact"), takers(",complete")), (vec!["canonical"], vec!["chpa"]));
    assert_eq!((takers(",side=3"), takers(",unstraightened")), (vec!["hpa", "chpa"], vec!["hpa"]));
    for option in ["second=zero", "step=3", "detour=2"] {
        assert_eq!(takers(&format!(",{option}")), ["chpa"], "{option}");
    }
    assert_eq!(takers(",limit=4"), ["jps", "jps-block"]);
    assert_eq!(takers(",intermediate"), ["jps", "jps-block", "jps-plus"]);
    for levels in ["1", "4", "all"] {
        assert_eq!(takers(&format!(",levels={levels}")), ["subgoal", "subgoal-theta", "hpa"]);
    }
    let error = "astar,limit=4".parse::<Setup>().expect_err("no jumps").to_string();
    assert_eq!(
        error,
        "expected ENGINE[:K[:RULE]][,OPTION…], found `astar,limit=4`: astar takes no jump limit: \
         leave it out, or choose jps, jps-block"
    );
}

#[test]
fn what_is_left_out_has_its_default() {
    assert_eq!(setup("astar").engine.heuristic(), Some(HeuristicName::Hk));
    assert_eq!(setup("dijkstra").engine.heuristic(), Some(HeuristicName::Zero));
    assert_eq!((setup("anya").engine.heuristic(), setup("anya")), (None, setup("anya:any:open")));
    assert_eq!((setup("theta").to_string(), setup("anya:any").rules()), ("theta:3:never".to_owned(), OPEN));
    assert_eq!(setup("anya:3"), setup("anya:3:open"));
    assert_eq!(
        (setup("subgoal"), setup("subgoal-theta")),
        (setup("subgoal:3:never"), setup("subgoal-theta:3:open"))
    );
    assert_eq!(
        (setup("subgoal").engine.heuristic(), setup("subgoal-theta").engine.heuristic()),
        (None, None)
    );
    let levels = |n| NonZeroU32::new(n).map(Levels::Number);
    assert_eq!((setup("astar").engine.levels(), setup("subgoal").engine.levels()), (None, None));
    assert_eq!(
        ["subgoal,levels=1", "subgoal-theta"].map(|text| setup(text).engine.levels()),
        [levels(1), levels(2)]
    );
    assert_eq!(setup("subgoal-theta,levels=all").engine.levels(), Some(Levels::All));
    assert_eq!(
        (setup("canonical").engine.variant(), setup("jps").engine.variant()),
        (Some(Variant::Exact), None)
    );
}

#[test]
fn setups_say_what_their_paths_are() {
    let paths = [
        "astar:4",
        "subgoal:4:open",
        "anya:4",
        "theta",
        "lazy-theta",
        "astar,smooth",
        "jps,taut",
        "anya",
        "subgoal-theta",
    ]
    .map(|text| setup(text).paths());
    assert_eq!(paths[..3], [K::Finite(k(4)); 3]);
    assert_eq!(paths[3..], [K::Any; 6]);
    let promised = [
        "astar:4:one,smooth",
        "theta,taut",
        "anya,taut",
        "anya:4,taut",
        "anya:4",
        "wavefront:2,taut",
        "wavefront,taut",
    ];
    assert_eq!(
        promised.map(|text| setup(text).guarantee()),
        [
            Guarantee::AtMost(k(4)),
            Guarantee::Suboptimal,
            Guarantee::OptimalAnyAngle,
            Guarantee::AtMost(k(4)),
            Guarantee::Optimal(k(4)),
            Guarantee::AtMost(k(2)),
            Guarantee::Suboptimal,
        ]
    );
    let over = ["jps:4", "subgoal:9:closed", "wavefront:2", "anya:5", "anya,taut", "subgoal:any"]
        .map(|text| setup(text).optimal_over());
    let ks = [4, 9, 2, 5].map(|n| Some(K::Finite(k(n))));
    assert_eq!((&over[..4], &over[4..]), (&ks[..], &[Some(K::Any); 2][..]));
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
            for setup in Setup::all(Motion::new(k, rules)) {
                assert_eq!(setup.to_string().parse(), Ok(setup));
                setups += 1;
            }
        }
    }
    assert!(setups > 1_300, "{setups}");
    let many = "chpa:2:one,euclidean,side=4,second=squared,step=5,detour=7,taut";
    assert_eq!(many.parse::<Setup>().map(|setup| setup.to_string()), Ok(many.to_owned()));
    let many = "hpa:3:never,levels=2,side=4,unstraightened";
    assert_eq!(many.parse::<Setup>().map(|setup| setup.to_string()), Ok(many.to_owned()));
    let zero = ConfiguredEngine::LazyTheta(GuidedOptions { heuristic: Some(HeuristicName::Zero) });
    let both = Setup { smoothing: Some(Smoothing::Taut), ..Setup::new(zero, Motion::new(k(5), OPEN)) };
    let limited =
        ConfiguredEngine::Jps(JumpOptions { jump_limit: NonZeroU32::new(16), ..JumpOptions::default() });
    assert_eq!(Setup::new(limited, Motion::new(k(4), NEVER)), setup("jps:4:never,limit=16"));
    assert_eq!(
        (both.to_string().as_str(), "lazy-theta:5:open,taut,zero".parse()),
        ("lazy-theta:5:open,zero,taut", Ok(both))
    );
    assert_eq!("astar".parse(), "astar:3:never".parse::<Setup>());
    assert_eq!(format!("{:>16}|", "jps:4:open".parse::<Setup>().expect("a setup")), "      jps:4:open|");
}

#[test]
fn each_wrong_part_is_named() {
    let wrong = |text: &str| text.parse::<Setup>().expect_err("a wrong part").to_string();
    let names = "astar, dijkstra, wavefront, canonical, jps, jps-block, jps-plus, theta, lazy-theta, anya, \
                 subgoal, subgoal-theta, hpa, chpa, landmarks";
    let form = "expected ENGINE[:K[:RULE]][,OPTION…], found `warp`";
    assert_eq!(wrong("warp"), format!("{form}: the engines are {names}"));
    for k in ["", "x", "1", "-3"] {
        assert!(wrong(&format!("astar:{k}")).ends_with("K is a number from 2 to 12"));
    }
    assert!(
        wrong("jps-block:x").ends_with("K is a number from 2 to 3")
            && wrong("anya:x").ends_with("K is a number from 2 to 12, or any")
    );
    assert!(wrong("jps-block:4").ends_with("jps-block needs a k from 2 to 3, found 4 (16 neighbors)"));
    assert!(wrong("jps-block:63").ends_with("found 63 (9223372036854775808 neighbors)"));
    assert!(wrong("jps-block:64").ends_with("found 64"));
    assert!(wrong("theta:any").ends_with("theta needs a k from 2 to 12; for any choose anya, subgoal"));
    assert!(wrong("subgoal:x").ends_with("K is a number from 2 to 12, or any"));
    assert!(
        wrong("subgoal-theta:any")
            .ends_with("subgoal-theta needs a k from 2 to 12; for any choose anya, subgoal")
    );
    assert!(wrong("subgoal:13:open").ends_with("subgoal needs a k from 2 to 12, found 13 (8192 neighbors)"));
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

    assert!(wrong("anya:13").ends_with("anya needs a k from 2 to 12, found 13 (8192 neighbors)"));
    assert!(wrong("anya:4:one").contains("anya needs placement corner; for center choose astar, "));
    assert!(
        wrong("anya:any:one").contains("at any angle paths between centers bend at corners of obstacles")
    );
    assert!(
        wrong("astar:3:sometimes").contains("the rules are never, one, always, open, closed, center-open")
    );
    assert!(wrong("astar:3:one:two").ends_with("nothing but options may follow the rule"));
    for option in ["", "limit=0", "limit=x", "limit", "fast"] {
        assert!(wrong(&format!("jps,{option}")).contains("the options are hk, euclidean, zero,"), "{option}");
    }
    assert!(wrong("jps,best").ends_with(
        "squared, exact, complete, paper, limit=N, intermediate, levels=N, levels=all, levels=contracted, \
         levels=labels, memory=BYTES, side=N, landmarks=N, unstraightened, second=HEURISTIC, \
         step=N, detour=N, smooth, taut"
    ));
    assert!(wrong("anya,zero").contains("anya takes no heuristic: leave it out, or choose astar, "));
    assert!(wrong("landmarks,landmarks=17").ends_with("17 landmarks: choose 1 to 16"));
    assert!(wrong("landmarks:9").ends_with("landmarks needs a k from 2 to 8, found 9 (512 neighbors)"));
    assert_eq!("ALT:4:open".parse(), "landmarks:4:open".parse::<Setup>());
    assert!(wrong("jps,paper").ends_with("jps takes no variant: leave it out, or choose canonical, chpa"));
}

#[test]
fn a_saved_index_is_as_good_as_a_new_one() {
    for rules in Rules::ALL {
        for k in [2, 3].map(k) {
            let setup = Setup::new(Engine::JpsPlus, Motion::new(k, rules));
            let bytes = build(setup, &map()).expect("an index");
            let saved = read(setup, &map(), bytes.clone()).expect("these are its bytes");
            assert_eq!(saved.planner().find_counted(query()), planner(setup).find_counted(query()));
            let mut damaged = bytes;
            damaged[0] ^= 1;
            let refused = read(setup, &map(), damaged).map(|_| ());
            assert!(matches!(refused, Err(Error::IndexFile(_))), "{refused:?}");
        }
    }
}

#[test]
fn only_some_engines_have_an_index_or_distances() {
    let distances = |setup: Setup, start: (i32, i32)| {
        setup.space(&map()).and_then(|space| space.distances(setup.engine.kind(), start))
    };
    for engine in Engine::ALL.into_iter().filter(|&engine| engine.capabilities().index.is_none()) {
        let setup = plain(engine);
        let error =
            format!("{engine} has no index: choose jps-plus, subgoal, subgoal-theta, hpa, chpa, landmarks");
        assert_eq!(build(setup, &map()).map_err(|error| error.to_string()), Err(error));
    }
    for engine in Engine::ALL {
        let found = distances(plain(engine), (0, 0));
        match found {
            // The map is connected: every free cell is reached.
            Ok(found) => {
                assert!(matches!(engine, Engine::Dijkstra | Engine::Wavefront));
                assert_eq!(found.len() as u64, map().grid().free_cells());
                assert_eq!((found[0], found[1]), ((Vertex::new(0, 0), 0.0), (Vertex::new(1, 0), 1.0)));
            }
            Err(error) => assert_eq!(
                error.to_string(),
                format!("{engine} has no distances to all vertices: choose dijkstra, wavefront")
            ),
        }
    }
    let blocked = distances(Setup::new(Engine::Dijkstra, Motion::new(k(3), NEVER)), (6, 0));
    assert!(matches!(blocked, Err(Error::Query(_))), "{blocked:?}");
    let corner = Setup::new(Engine::Dijkstra, Motion::new(k(4), DiagonalGap::Closed));
    let found = distances(corner, (0, 0)).expect("a free start");
    let (_, distance) = found.iter().find(|(at, _)| *at == Vertex::new(2, 1)).expect("it is reached");
    assert!((distance - 5.0_f64.sqrt()).abs() < 1e-9, "{distance}");
}
