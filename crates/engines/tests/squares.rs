//! Clusters and segments in the catalog: where there are any, what is left out, and what becomes of a saved graph.

mod common;

use std::{num::NonZeroU32, sync::Arc};

use mediant_engines::{
    Engine, EngineError, Ground, HeuristicName, Hierarchy, Levels, Options, Prebuilt, Setup, SetupError,
    Solver, Variant, build,
};
use mediant_grid::{CornerRule, Grid, PlacementKind, Rules};
use mediant_hierarchy::{ClusterGraph, Clustering, FallbackPolicy, HierarchyError, SegmentGraph};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Rng, caves};
use mediant_search::{Guarantee, Query, QueryError};

use common::{grid, k};

const NEVER: Rules = Rules::Center(CornerRule::Never);

fn setup(text: &str) -> Setup {
    text.parse().unwrap_or_else(|error| panic!("{error}"))
}

fn solver(setup: Setup, grid: &Arc<Grid>, index: Option<Vec<u8>>) -> Result<Solver, EngineError> {
    Solver::new(setup, grid, Prebuilt { index, rule: None })
}

/// Whether an engine searches clusters or segments.
fn has_squares(setup: &Setup) -> bool {
    matches!(setup.engine, Engine::Hpa | Engine::Chpa)
}

/// A map of many clusters, and queries all over it.
fn map() -> (Arc<Grid>, Vec<Query>) {
    let grid = caves(&mut Rng::new(3), 50, 40);
    let all = (0..40).flat_map(|y| (0..50).map(move |x| (x, y)));
    let free: Vec<(i32, i32)> = all.filter(|&(x, y)| !grid.is_blocked(x, y)).step_by(149).collect();
    let queries = free.iter().flat_map(|&from| free.iter().map(move |&to| Query::new(from, to))).collect();
    (Arc::new(grid), queries)
}

#[test]
fn there_are_graphs_where_the_catalog_says_so() {
    let mut taken = Vec::new();
    for rules in Rules::ALL {
        for k in (2..=5).map(|n| K::Finite(k(n))).chain([K::Any]) {
            for engine in [Engine::Hpa, Engine::Chpa] {
                let setup = Setup::new(engine, k, rules);
                if setup.check().is_ok() {
                    taken.push(setup.to_string());
                }
                let (K::Finite(number), Rules::Center(_)) = (k, rules) else { continue };
                // What the catalog says is what the graphs say.
                let ground = Ground::new(Setup::new(Engine::AStar, number, rules), &grid());
                let Ok(Ground::Centers(grid_graph)) = ground else { panic!("{ground:?}") };
                let there = match engine {
                    Engine::Hpa => ClusterGraph::new(&grid_graph, Clustering::default()).map(|_| ()),
                    _ => SegmentGraph::new(&grid_graph, 3).map(|_| ()),
                };
                assert_eq!(setup.check().is_ok(), there.is_ok(), "{setup}: {there:?}");
            }
        }
    }
    let expected = ["never", "never", "one", "always"].into_iter().zip([2, 3, 2, 2]);
    let expected =
        expected.flat_map(|(rule, k)| ["hpa", "chpa"].map(|engine| format!("{engine}:{k}:{rule}")));
    assert_eq!(taken, expected.collect::<Vec<_>>());
    let (k, rules) = (K::Finite(FiniteK::N8), Rules::Center(CornerRule::One));
    let refused = Setup::new(Engine::Hpa, k, rules).check();
    assert_eq!(refused, Err(SetupError::Centers { engine: Engine::Hpa, k, rules }));
    let needed = PlacementKind::Center;
    let corners = Setup::new(Engine::Chpa, k, Rules::Corner(Default::default())).check();
    assert!(
        matches!(corners, Err(SetupError::PlacementKind { needed: found, .. }) if found == needed),
        "{corners:?}"
    );
}

#[test]
fn what_is_left_out_has_its_default() {
    let (hpa, chpa) = (setup("hpa"), setup("chpa"));
    assert_eq!((hpa, chpa), (setup("hpa:3:never"), setup("chpa:3:never")));
    assert_eq!(
        (hpa.heuristic(), hpa.second(), hpa.step(), hpa.detour(), hpa.variant()),
        (None, None, None, None, None)
    );
    let levels = |n| NonZeroU32::new(n).map(Hierarchy::Levels);
    assert_eq!((hpa.hierarchy(), chpa.hierarchy()), (levels(Clustering::default().levels), None));
    assert_eq!((chpa.heuristic(), chpa.second()), (Some(HeuristicName::Hk), Some(HeuristicName::Hk)));
    assert_eq!(setup("chpa,squared").second(), Some(HeuristicName::SquaredEuclidean));
    assert_eq!(setup("chpa,squared,second=zero").second(), Some(HeuristicName::Zero));
    assert_eq!(chpa.variant(), Some(Variant::Complete));
    let FallbackPolicy::Complete { detour } = FallbackPolicy::default() else {
        panic!("it is complete by default")
    };
    assert_eq!((chpa.detour(), setup("chpa,paper").detour()), (Some(detour), None));
    assert_eq!((chpa.step(), setup("chpa,step=5").step()), (NonZeroU32::new(2), NonZeroU32::new(5)));
    for text in ["hpa", "chpa", "chpa,paper", "hpa,taut", "astar,squared", "astar:5:open,squared,smooth"] {
        assert_eq!(setup(text).guarantee(), Guarantee::Suboptimal, "{text}");
        assert!(!setup(text).solves_scenarios() && setup(text).optimal_over().is_none(), "{text}");
    }
    assert_eq!((setup("hpa").paths(), setup("chpa,smooth").paths()), (K::Finite(FiniteK::N8), K::Any));
    let both = Options { variant: Some(Variant::Paper), detour: NonZeroU32::new(2), ..Options::default() };
    let refused = Setup { options: both, ..chpa }.check();
    assert_eq!(refused, Err(SetupError::DetourAsPublished { engine: Engine::Chpa }));
}

#[test]
fn all_levels_are_as_many_as_fit() {
    for side in 2..=64 {
        let options =
            Options { side: NonZeroU32::new(side), levels: Some(Levels::All), ..Options::default() };
        let all = Setup { options, ..Setup::new(Engine::Hpa, k(3), NEVER) };
        let Some(Hierarchy::Levels(levels)) = all.hierarchy() else { panic!("{all}: {:?}", all.hierarchy()) };
        let solver = solver(all, &grid(), None).unwrap_or_else(|error| panic!("{all}: {error}"));
        let made = solver.preprocessing();
        assert_eq!((made.hierarchy, made.side), (Some(Hierarchy::Levels(levels)), Some(side)));
        let more = Options { levels: levels.checked_add(1).map(Levels::Number), ..options };
        let refused = Solver::new(Setup { options: more, ..all }, &grid(), Prebuilt::default()).map(|_| ());
        assert!(
            matches!(refused, Err(EngineError::Squares(HierarchyError::Levels { .. }))),
            "{side}: {refused:?}"
        );
        // Where a side alone is said, the default levels fit.
        let one = Options { levels: None, ..options };
        let built = build(Setup { options: one, ..all }, &grid());
        assert!(built.is_ok(), "{side}: {built:?}");
    }
    for text in ["hpa,side=1", "hpa,side=65", "hpa,side=4294967295,levels=all", "chpa,side=64"] {
        let refused = build(setup(text), &grid());
        assert!(
            matches!(refused, Err(EngineError::Squares(HierarchyError::Side { .. }))),
            "{text}: {refused:?}"
        );
    }
}

#[test]
fn a_saved_graph_is_as_good_as_a_new_one() {
    let (grid, queries) = map();
    let mut setups = 0;
    for rules in Rules::ALL {
        for k in [2, 3].map(k) {
            for setup in Setup::all(k, rules).filter(has_squares) {
                let (bytes, took) = build(setup, &grid).unwrap_or_else(|error| panic!("{setup}: {error}"));
                let [mut new, mut saved] = [None, Some(bytes.clone())].map(|index| {
                    solver(setup, &grid, index).unwrap_or_else(|error| panic!("{setup}: {error}"))
                });
                for &query in &queries {
                    assert_eq!(saved.solve_counted(query), new.solve_counted(query), "{setup}, {query:?}");
                }
                let about = |solver: &Solver| {
                    let made = solver.preprocessing();
                    (made.index_bytes, made.hierarchy, made.side)
                };
                assert_eq!(about(&saved), about(&new), "{setup}");
                assert_eq!(
                    (took.index_bytes, took.hierarchy, took.side),
                    (bytes.len() as u64, setup.hierarchy(), about(&new).2),
                    "{setup}"
                );
                setups += 1;
            }
        }
    }
    assert_eq!(setups, (3 + 1) * (9 + 11));
}

#[test]
fn a_saved_graph_has_the_levels_and_the_side_that_are_named() {
    let with = |built: &str, asked: &str| {
        let index = build(setup(built), &grid()).expect("an index").0;
        solver(setup(asked), &grid(), Some(index)).map(|solver| solver.preprocessing())
    };
    for (built, asked) in [
        ("hpa,levels=1", "hpa"),
        ("hpa,side=5,levels=2", "hpa"),
        ("hpa,side=5,levels=2", "hpa,levels=2,refined"),
        ("hpa,side=5,levels=2", "hpa,side=5"),
        ("hpa,side=5,levels=6", "hpa,levels=all"),
        ("chpa,side=7", "chpa,paper"),
        ("chpa,side=7", "chpa,side=7,squared"),
    ] {
        let made = with(built, asked).unwrap_or_else(|error| panic!("{built}, {asked}: {error}"));
        assert_eq!(made.hierarchy, setup(built).hierarchy(), "{built}, {asked}");
        let side = setup(built).options.side.map(NonZeroU32::get);
        assert_eq!(made.side, side.or(Some(10)), "{built}, {asked}");
    }
    let number = |n| Hierarchy::Levels(NonZeroU32::new(n).expect("a level"));
    let levels =
        |expected, found| EngineError::Hierarchy { expected: number(expected), found: number(found) };
    for (built, asked, error) in [
        ("hpa,levels=1", "hpa,levels=2", levels(2, 1)),
        ("hpa,side=5,levels=2", "hpa,levels=all", levels(6, 2)),
        ("hpa,side=5,levels=2", "hpa,side=10,levels=2", EngineError::Side { expected: 10, found: 5 }),
        ("chpa", "chpa,side=4", EngineError::Side { expected: 4, found: 3 }),
    ] {
        assert_eq!(with(built, asked).map(|_| ()), Err(error), "{built}, {asked}");
    }
}

/// Bytes that were damaged are refused, or are those of another graph: never more than that.
#[test]
fn damaged_graphs_do_no_harm() {
    let (mut refused, mut read) = (0, 0);
    for text in ["hpa,side=4,levels=2", "hpa:2:one,side=3", "chpa", "chpa:2:always,side=2"] {
        let setup = setup(text);
        let whole = build(setup, &grid()).expect("an index").0;
        let mut check = |bytes: Vec<u8>, what: &str| match solver(setup, &grid(), Some(bytes)) {
            Ok(mut solver) => {
                match solver.solve(Query::new((0, 0), (8, 4))) {
                    // Only the file that holds an index knows whether it is whole.
                    Ok(_) | Err(QueryError::GaveUp { .. }) => read += 1,
                    Err(error) => panic!("{text}, {what}: {error}"),
                }
            }
            Err(EngineError::Squares(_) | EngineError::Hierarchy { .. } | EngineError::Side { .. }) => {
                refused += 1;
            }
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
    assert!(refused > 500 && read > 500, "{refused} refused, {read} read");
}
