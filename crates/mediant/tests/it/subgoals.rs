//! Subgoal graphs in the catalog: for which setups there are any, and how they are saved and read.

use std::sync::{Arc, Mutex};

use mediant::{
    Answer, Engine, Error, Map, Motion, Query, Setup, Smoothing,
    errors::SetupError,
    options::{ConfiguredEngine, Levels, SubgoalOptions},
    search::{Progress, Stage},
};
use mediant_grid::{Centers, GridGraph, PlacementKind, Rules};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Rng, random_grid};
use mediant_search::{Counters, Ends};
use mediant_subgoal::{Hierarchy, SubgoalGraph};

use super::{build, index, k, levels, map, read, setup};

/// Whether the engine of a setup searches a subgoal graph.
fn is_subgoal(setup: &Setup) -> bool {
    matches!(setup.engine.kind(), Engine::Subgoal | Engine::SubgoalTheta)
}

#[test]
fn subgoal_graphs_at_centers_are_for_small_k() {
    let mut taken = Vec::new();
    for rules in Rules::ALL.into_iter().filter(|rules| rules.placement() == PlacementKind::Center) {
        for k in (2..=12).map(|n| K::Finite(k(n))).chain([K::Any]) {
            let setup = Setup::new(Engine::Subgoal, Motion::new(k, rules));
            // The catalog and the subgoal graphs agree on which exist.
            let small = k.finite().map_or(4, |k| k.get().min(4));
            let Rules::Center(rule) = rules else { panic!("{rules}") };
            let small = FiniteK::new(small).expect("a k");
            let grid_graph =
                GridGraph::<Centers>::new(Arc::clone(map().grid()), small, rule).expect("a small k");
            let exists = SubgoalGraph::new(&grid_graph, k, Hierarchy::Contracted).is_ok();
            match setup.check() {
                Ok(()) => taken.push(setup.to_string()),
                Err(error) if k == K::Any => assert_eq!(error, SetupError::AnyAngleWithCorners),
                Err(error) => {
                    assert_eq!(error, SetupError::Centers { engine: Engine::Subgoal, k, rules });
                }
            }
            assert_eq!(setup.check().is_ok(), exists, "{setup}");
        }
    }
    assert_eq!(taken, ["subgoal:2:never", "subgoal:3:never", "subgoal:2:one", "subgoal:2:always"]);
    let said = "subgoal:3:one".parse::<Setup>().expect_err("corners are cut").to_string();
    assert!(
        said.ends_with(
            "at centers subgoal takes k = 2, or k = 3 with corners never, not k = 3 with corners one: \
             choose one of these, placement corner, or another engine"
        ),
        "{said}"
    );
    // For k = any the default is corners.
    assert_eq!("subgoal:any".parse(), "subgoal:any:open".parse::<Setup>());
}

#[test]
fn a_saved_subgoal_graph_is_as_good_as_a_new_one() {
    let query = Ends::new((0, 0), (8, 4));
    let mut setups = 0;
    for rules in Rules::ALL {
        for k in [2, 3, 5].map(|n| K::Finite(k(n))).into_iter().chain([K::Any]) {
            for setup in Setup::all(Motion::new(k, rules)).filter(is_subgoal) {
                let new = index(setup, &map()).unwrap_or_else(|error| panic!("{setup}: {error}"));
                let bytes = new.to_bytes().unwrap_or_else(|error| panic!("{setup}: {error}"));
                let saved = read(setup, &map(), bytes).unwrap_or_else(|error| panic!("{setup}: {error}"));
                assert_eq!(saved.planner().find_counted(query), new.planner().find_counted(query), "{setup}");
                assert_eq!(saved.memory_bytes(), new.memory_bytes(), "{setup}");
                assert_eq!(levels(&new), levels(&saved), "{setup}");
                let named = setup.engine.levels();
                assert!(named.is_none_or(|named| levels(&new) == Some(named)), "{setup}");
                setups += 1;
            }
        }
    }
    assert_eq!(setups, 5 * (2 * 4 + 3 + 1) + 4 * 2 * 3 + 12 * 4);
}

#[test]
fn a_saved_subgoal_graph_has_the_levels_that_are_named() {
    let with = |built: &str, asked: &str| {
        let bytes = build(setup(built), &map()).expect("an index");
        read(setup(asked), &map(), bytes)
    };
    for (built, asked) in [
        ("subgoal:3:open,levels=2", "subgoal:3:open"),
        ("subgoal:3:open,levels=all", "subgoal:3:open,levels=4294967295"),
        ("subgoal-theta", "subgoal-theta,levels=2"),
        ("subgoal-theta,levels=all", "subgoal-theta"),
    ] {
        let index = with(built, asked).unwrap_or_else(|error| panic!("{built}, {asked}: {error}"));
        assert_eq!(levels(&index), setup(built).engine.levels(), "{built}, {asked}");
    }
    for (built, asked, message) in [
        (
            "subgoal,levels=contracted",
            "subgoal,levels=1",
            "needs an index with 1 level, found one with a contraction hierarchy",
        ),
        (
            "subgoal",
            "subgoal,levels=contracted",
            "needs an index with a contraction hierarchy, found one with hub labels",
        ),
        (
            "subgoal,levels=2",
            "subgoal,levels=labels",
            "needs an index with hub labels, found one with 2 levels",
        ),
        ("subgoal,levels=2", "subgoal,levels=all", "needs an index with all levels, found one with 2 levels"),
    ] {
        let error = with(built, asked).map(|_| ()).expect_err("another hierarchy");
        assert!(matches!(error, Error::Levels { .. }), "{error:?}");
        let advice = "choose the levels that it has, or prepare it again";
        assert_eq!(error.to_string(), format!("{message}; {advice}"));
    }
    // As many levels as a number can say are all.
    let most = index(setup("subgoal:3:open,levels=4294967295"), &map()).expect("an index");
    assert_eq!(levels(&most), Some(Levels::All));
    for text in ["1", "7", "all", "contracted", "labels"] {
        assert_eq!(text.parse::<Levels>().map(|levels| levels.to_string()), Ok(text.to_owned()));
    }
    let said = "0".parse::<Levels>().expect_err("there is one level at least").to_string();
    assert_eq!(said, "expected a whole number from 1 to 4294967295, all, contracted or labels");
}

#[test]
fn progress_is_reported() {
    let told = |text: &str| {
        let told = Mutex::new(Vec::new());
        let progress = |step: Progress| told.lock().expect("nobody panics").push(step);
        let setup: Setup = text.parse().expect("a setup");
        let space = setup.space(&map()).expect("a setup that was checked");
        let made = space.prepare_with_progress(setup.engine, &progress).expect("an index");
        assert_eq!(made.to_bytes().ok(), build(setup, &map()).ok());
        told.into_inner().expect("nobody panics")
    };
    let steps = told("subgoal");
    for stage in [Stage::Edges, Stage::Hierarchy, Stage::Sight, Stage::Labels] {
        let steps: Vec<&Progress> = steps.iter().filter(|step| step.stage == stage).collect();
        assert!(!steps.is_empty() && steps.iter().all(|step| step.done <= step.total), "{steps:?}");
    }
    assert_eq!(told("jps-plus"), []);
}

/// A path that is smoothed from the bends that the search knows: in steps, observed and among several goals
/// the same as at once.
#[test]
fn smoothed_paths_of_subgoals_are_the_same_in_steps() {
    let (mut found, mut shorter) = (0, 0);
    for seed in 0..12 {
        let map = Map::from(random_grid(seed).0);
        for (levels, smoothing) in [
            (Levels::Labels, Smoothing::Linear),
            (Levels::Labels, Smoothing::Taut),
            (Levels::Contracted, Smoothing::Linear),
            (Levels::Number(2.try_into().expect("two")), Smoothing::Linear),
        ] {
            let options = SubgoalOptions { levels: Some(levels), memory: None };
            let engine = ConfiguredEngine::Subgoal(options);
            let plain = Setup::new(engine, Motion::new(K::N16, super::OPEN));
            let setup = Setup { smoothing: Some(smoothing), ..plain };
            let mut planner = setup.planner(&map).expect("a planner");
            let mut unsmoothed = plain.planner(&map).expect("a planner");
            let mut rng = Rng::new(seed);
            let mut any = || (rng.below(map.width() + 1) as i32, rng.below(map.height() + 1) as i32);
            for _ in 0..30 {
                let (start, goal, case) = (any(), any(), format!("{setup}, seed {seed}"));
                let Ok(expected) = planner.find([start, goal]) else { continue };
                let observed = planner.find_observed([start, goal], &mut Counters::default());
                assert_eq!(observed.as_ref(), Ok(&expected), "{case}: {start:?} to {goal:?}");
                planner.begin(Query::new(start, goal)).expect("both ends are free");
                let answer = loop {
                    if let Some(answer) = planner.step(1).expect("a search") {
                        break answer;
                    }
                };
                assert_eq!(answer, expected, "{case}: {start:?} to {goal:?}");
                let several = planner.find(Query::between([start], [goal, goal]));
                assert_eq!(several.as_ref(), Ok(&expected), "{case}: {start:?} to {goal:?}");
                if let Answer::Found(path) = &expected {
                    assert_eq!(planner.best().as_ref(), Some(path), "{case}: {start:?} to {goal:?}");
                    let plain = unsmoothed.find([start, goal]).expect("both ends are free");
                    let plain = plain.cost().expect("there is a path");
                    assert!(path.cost() <= plain + 1e-9, "{case}: {start:?} to {goal:?}");
                    (found, shorter) = (found + 1, shorter + usize::from(path.cost() < plain - 1e-9));
                }
            }
        }
    }
    assert!(found > 500 && shorter > 50, "{found} paths, {shorter} made shorter");
}
