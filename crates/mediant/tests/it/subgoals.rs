//! Subgoal graphs in the catalog: for which setups there are any, and how they are saved and read.

use std::sync::Mutex;

use mediant::{
    Engine, EngineError, EngineOption, Index, Levels, OptionValue, Progress, Setup, SetupError, Space, Stage,
};
use mediant_grid::{PlacementKind, Rules};
use mediant_moves::{FiniteK, K};
use mediant_search::Query;
use mediant_subgoal::{Hierarchy, SubgoalGraph};

use super::{RULES, build, grid, index, k, planner_on, setup};

/// The levels of an index.
fn levels(index: &Index) -> Option<Levels> {
    match index.value(EngineOption::ALL.into_iter().find(|option| option.name == "levels")?)? {
        OptionValue::Levels(levels) => Some(levels),
        _ => None,
    }
}

/// Whether the engine of a setup searches a subgoal graph.
fn is_subgoal(setup: &Setup) -> bool {
    matches!(setup.engine.kind(), Engine::Subgoal | Engine::SubgoalTheta)
}

#[test]
fn subgoal_graphs_at_centers_are_for_small_k() {
    let mut taken = Vec::new();
    for rules in Rules::ALL.into_iter().filter(|rules| rules.placement() == PlacementKind::Center) {
        for k in (2..=12).map(|n| K::Finite(k(n))).chain([K::Any]) {
            let setup = Setup::new(Engine::Subgoal, k, rules);
            // The catalog and the subgoal graphs agree on which exist.
            let small = k.finite().map_or(4, |k| k.get().min(4));
            let space =
                Space::new(Setup::new(Engine::AStar, FiniteK::new(small).expect("a k"), rules), &grid());
            let Ok(Space::Centers(grid_graph)) = space else { panic!("{space:?}") };
            let exists = SubgoalGraph::new(&grid_graph, k, Hierarchy::Contracted).is_ok();
            match setup.check() {
                Ok(()) => taken.push(setup.to_string()),
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
            "at centers subgoal needs k = 2, or k = 3 under corners never, found k = 3 under center, corners one: \
             choose one of these, placement corner, or another engine"
        ),
        "{said}"
    );
    // For k = any the default is corners.
    assert_eq!("subgoal:any".parse(), "subgoal:any:open".parse::<Setup>());
}

#[test]
fn a_saved_subgoal_graph_is_as_good_as_a_new_one() {
    let query = Query::new((0, 0), (8, 4));
    let mut setups = 0;
    for rules in Rules::ALL {
        for k in [2, 3, 5].map(|n| K::Finite(k(n))).into_iter().chain([K::Any]) {
            for setup in Setup::all(k, rules).filter(is_subgoal) {
                let new = index(setup, &grid(), None).unwrap_or_else(|error| panic!("{setup}: {error}"));
                let bytes = new.to_bytes().unwrap_or_else(|error| panic!("{setup}: {error}"));
                let saved =
                    index(setup, &grid(), Some(&bytes)).unwrap_or_else(|error| panic!("{setup}: {error}"));
                assert_eq!(
                    planner_on(&saved).solve_counted(query),
                    planner_on(&new).solve_counted(query),
                    "{setup}"
                );
                assert_eq!(saved.memory_bytes(), new.memory_bytes(), "{setup}");
                assert_eq!([&new, &saved].map(levels), [setup.engine.levels(); 2], "{setup}");
                setups += 1;
            }
        }
    }
    assert_eq!(setups, 5 * (2 * 4 + 3 + 1) + 4 * 2 * 3);
}

#[test]
fn a_saved_subgoal_graph_has_the_levels_that_are_named() {
    let with = |built: &str, asked: &str| {
        let bytes = build(setup(built), &grid()).expect("an index");
        index(setup(asked), &grid(), Some(&bytes))
    };
    for (built, asked) in [
        ("subgoal:3:open,levels=2", "subgoal:3:open"),
        ("subgoal:3:open,levels=2", "subgoal-theta,levels=2"),
        ("subgoal:3:open,levels=all", "subgoal-theta"),
    ] {
        let index = with(built, asked).unwrap_or_else(|error| panic!("{built}, {asked}: {error}"));
        assert_eq!(levels(&index), setup(built).engine.levels(), "{built}, {asked}");
    }
    for (built, asked, message) in [
        (
            "subgoal",
            "subgoal,levels=1",
            "needs an index with 1 level, found one with a contraction hierarchy",
        ),
        ("subgoal,levels=2", "subgoal,levels=all", "needs an index with all levels, found one with 2 levels"),
        (
            "subgoal:3:open",
            "subgoal-theta",
            "needs an index with 2 levels, found one with a contraction hierarchy",
        ),
    ] {
        let error = with(built, asked).map(|_| ()).expect_err("another hierarchy");
        assert!(matches!(error, EngineError::Levels { .. }), "{error:?}");
        let advice = "choose the levels that it has, or build it again";
        assert_eq!(error.to_string(), format!("{message}; {advice}"));
    }
    for text in ["1", "7", "all", "contracted"] {
        assert_eq!(text.parse::<Levels>().map(|levels| levels.to_string()), Ok(text.to_owned()));
    }
    let said = "0".parse::<Levels>().expect_err("there is one level at least").to_string();
    assert_eq!(said, "expected a whole number from 1 to 4294967295, or all");
}

/// Damaged bytes are refused, or read as another graph, on which a planner works.
#[test]
fn damaged_subgoal_graphs_do_no_harm() {
    let (mut refused, mut read) = (0, 0);
    for text in ["subgoal", "subgoal:4:closed", "subgoal:any,levels=2", "subgoal-theta"] {
        let setup: Setup = text.parse().expect("a setup");
        let whole = build(setup, &grid()).expect("an index");
        let mut check = |bytes: Vec<u8>, what: &str| match index(setup, &grid(), Some(&bytes)) {
            Ok(index) => {
                let _ = planner_on(&index).solve(Query::new((0, 0), (8, 4))).expect("both ends are free");
                read += 1;
            }
            Err(EngineError::Subgoal(_) | EngineError::Levels { .. }) => refused += 1,
            Err(error) => panic!("{text}, {what}: {error}"),
        };
        for length in 0..whole.len() {
            check(whole[..length].to_vec(), "cut");
        }
        for bit in 0..8 * whole.len() {
            let mut bytes = whole.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            check(bytes, &format!("bit {bit}"));
        }
    }
    assert!(refused > 5_000 && refused > 20 * read, "{refused} refused, {read} read");
}

#[test]
fn progress_is_reported() {
    let told = |text: &str| {
        let told = Mutex::new(Vec::new());
        let progress = |step: Progress| told.lock().expect("nobody panics").push(step);
        let setup: Setup = text.parse().expect("a setup");
        let space = Space::new(setup, &grid()).expect("a setup that was checked");
        let made = Index::with_progress(setup, &space, &RULES, &progress).expect("an index");
        assert_eq!(made.to_bytes(), build(setup, &grid()));
        told.into_inner().expect("nobody panics")
    };
    let steps = told("subgoal");
    for stage in [Stage::Edges, Stage::Hierarchy] {
        let steps: Vec<&Progress> = steps.iter().filter(|step| step.stage == stage).collect();
        assert!(!steps.is_empty() && steps.iter().all(|step| step.done <= step.total), "{steps:?}");
    }
    assert_eq!(told("jps-plus"), []);
}
