//! Clusters and segments in the catalog: for which setups there are any, their defaults, and how they are
//! saved and read.

use std::{num::NonZeroU32, sync::Arc};

use mediant::{
    Engine, Error, Index, Map, Motion, Setup,
    errors::SetupError,
    options::{
        ChpaOptions, ConfiguredEngine, EngineOption, HeuristicName, HpaOptions, Levels, OptionValue, Variant,
    },
};
use mediant_grid::{Centers, CornerRule, GridGraph, PlacementKind, Rules};
use mediant_hierarchy::{ClusterGraph, Clustering, FallbackPolicy, HierarchyError, SegmentGraph};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Rng, caves};
use mediant_search::{Ends, Guarantee};

use super::{NEVER, build, index, k, map, read, setup};

/// The levels and the side of an index.
fn shape(index: &Index) -> (Option<Levels>, Option<u32>) {
    let value = |name: &str| EngineOption::ALL.into_iter().find(|option| option.name == name);
    let value = |name: &str| value(name).and_then(|option| index.value(option));
    let levels = match value("levels") {
        Some(OptionValue::Levels(levels)) => Some(levels),
        _ => None,
    };
    let side = match value("side") {
        Some(OptionValue::Number(side)) => Some(side.get()),
        _ => None,
    };
    (levels, side)
}

/// Whether the engine of a setup searches clusters or segments.
fn has_hierarchy(setup: &Setup) -> bool {
    matches!(setup.engine.kind(), Engine::Hpa | Engine::Chpa)
}

/// A map with many clusters, and queries between cells all over it.
fn caves_with_queries() -> (Map, Vec<Ends>) {
    let grid = caves(&mut Rng::new(3), 50, 40);
    let all = (0..40).flat_map(|y| (0..50).map(move |x| (x, y)));
    let free: Vec<(i32, i32)> = all.filter(|&(x, y)| !grid.is_blocked(x, y)).step_by(149).collect();
    let queries = free.iter().flat_map(|&from| free.iter().map(move |&to| Ends::new(from, to))).collect();
    (grid.into(), queries)
}

#[test]
fn graphs_exist_for_the_setups_that_the_catalog_takes() {
    let mut taken = Vec::new();
    for rules in Rules::ALL {
        for k in (2..=5).map(|n| K::Finite(k(n))).chain([K::Any]) {
            for engine in [Engine::Hpa, Engine::Chpa] {
                let setup = Setup::new(engine, Motion::new(k, rules));
                if setup.check().is_ok() {
                    taken.push(setup.to_string());
                }
                let (K::Finite(number), Rules::Center(rule)) = (k, rules) else { continue };
                // The catalog and the graphs agree on which exist.
                let grid_graph = GridGraph::<Centers>::new(Arc::clone(map().grid()), number, rule);
                let grid_graph = grid_graph.expect("a small k");
                let made = match engine {
                    Engine::Hpa => ClusterGraph::new(&grid_graph, Clustering::default()).map(|_| ()),
                    _ => SegmentGraph::new(&grid_graph, 3).map(|_| ()),
                };
                assert_eq!(setup.check().is_ok(), made.is_ok(), "{setup}: {made:?}");
            }
        }
    }
    let expected = ["never", "never", "one", "always"].into_iter().zip([2, 3, 2, 2]);
    let expected =
        expected.flat_map(|(rule, k)| ["hpa", "chpa"].map(|engine| format!("{engine}:{k}:{rule}")));
    assert_eq!(taken, expected.collect::<Vec<_>>());
    let (k, rules) = (K::Finite(FiniteK::N8), Rules::Center(CornerRule::One));
    let refused = Setup::new(Engine::Hpa, Motion::new(k, rules)).check();
    assert_eq!(refused, Err(SetupError::Centers { engine: Engine::Hpa, k, rules }));
    let needed = PlacementKind::Center;
    let corners = Setup::new(Engine::Chpa, Motion::corners(k)).check();
    assert!(
        matches!(corners, Err(SetupError::Placement { needed: found, .. }) if found == needed),
        "{corners:?}"
    );
}

#[test]
fn what_is_left_out_has_its_default() {
    let (hpa, chpa) = (setup("hpa"), setup("chpa"));
    assert_eq!((hpa, chpa), (setup("hpa:3:never"), setup("chpa:3:never")));
    assert_eq!(
        (
            hpa.engine.heuristic(),
            hpa.engine.second(),
            hpa.engine.step(),
            hpa.engine.detour(),
            hpa.engine.variant()
        ),
        (None, None, None, None, None)
    );
    let levels = |n| NonZeroU32::new(n).map(Levels::Number);
    assert_eq!((hpa.engine.levels(), chpa.engine.levels()), (levels(Clustering::default().levels), None));
    assert_eq!(
        (chpa.engine.heuristic(), chpa.engine.second()),
        (Some(HeuristicName::Hk), Some(HeuristicName::Hk))
    );
    assert_eq!(setup("chpa,squared").engine.second(), Some(HeuristicName::SquaredEuclidean));
    assert_eq!(setup("chpa,squared,second=zero").engine.second(), Some(HeuristicName::Zero));
    assert_eq!(chpa.engine.variant(), Some(Variant::Complete));
    let FallbackPolicy::Complete { detour } = FallbackPolicy::default() else {
        panic!("it is complete by default")
    };
    assert_eq!((chpa.engine.detour(), setup("chpa,paper").engine.detour()), (Some(detour), None));
    assert_eq!(
        (chpa.engine.step(), setup("chpa,step=5").engine.step()),
        (NonZeroU32::new(2), NonZeroU32::new(5))
    );
    for text in ["hpa", "chpa", "chpa,paper", "hpa,taut", "astar,squared", "astar:5:open,squared,smooth"] {
        assert_eq!(setup(text).guarantee(), Guarantee::Suboptimal, "{text}");
        assert!(!setup(text).solves_scenarios() && setup(text).optimal_over().is_none(), "{text}");
    }
    assert_eq!((setup("hpa").paths(), setup("chpa,smooth").paths()), (K::Finite(FiniteK::N8), K::Any));
    let both =
        ChpaOptions { variant: Some(Variant::Paper), detour: NonZeroU32::new(2), ..ChpaOptions::default() };
    let refused = Setup { engine: ConfiguredEngine::Chpa(both), ..chpa }.check();
    assert_eq!(refused, Err(SetupError::DetourAsPublished { engine: Engine::Chpa }));
}

#[test]
fn all_levels_are_as_many_as_fit() {
    for side in 2..=64 {
        let of = |levels| {
            let own = HpaOptions { side: NonZeroU32::new(side), levels, ..HpaOptions::default() };
            Setup::new(ConfiguredEngine::Hpa(own), Motion::new(k(3), NEVER))
        };
        let all = of(Some(Levels::All));
        let Some(Levels::Number(levels)) = all.engine.levels() else {
            panic!("{all}: {:?}", all.engine.levels())
        };
        let made = index(all, &map()).unwrap_or_else(|error| panic!("{all}: {error}"));
        assert_eq!(shape(&made), (Some(Levels::Number(levels)), Some(side)));
        let more = of(levels.checked_add(1).map(Levels::Number));
        let refused = index(more, &map()).map(|_| ());
        assert!(
            matches!(refused, Err(Error::Hierarchy(HierarchyError::Levels { .. }))),
            "{side}: {refused:?}"
        );
        // The default levels fit every side.
        let built = build(of(None), &map());
        assert!(built.is_ok(), "{side}: {built:?}");
    }
    for text in ["hpa,side=1", "hpa,side=65", "hpa,side=4294967295,levels=all", "chpa,side=64"] {
        let refused = build(setup(text), &map());
        assert!(matches!(refused, Err(Error::Hierarchy(HierarchyError::Side { .. }))), "{text}: {refused:?}");
    }
}

#[test]
fn a_saved_graph_is_as_good_as_a_new_one() {
    let (map, queries) = caves_with_queries();
    let mut setups = 0;
    for rules in Rules::ALL {
        for k in [2, 3].map(k) {
            for setup in Setup::all(Motion::new(k, rules)).filter(has_hierarchy) {
                let new = index(setup, &map).unwrap_or_else(|error| panic!("{setup}: {error}"));
                let bytes = new.to_bytes().unwrap_or_else(|error| panic!("{setup}: {error}"));
                let saved = read(setup, &map, bytes).unwrap_or_else(|error| panic!("{setup}: {error}"));
                let [mut on_saved, mut on_new] = [&saved, &new].map(Index::planner);
                for &query in &queries {
                    assert_eq!(
                        on_saved.find_counted(query),
                        on_new.find_counted(query),
                        "{setup}, {query:?}"
                    );
                }
                assert_eq!(
                    (saved.memory_bytes(), shape(&saved)),
                    (new.memory_bytes(), shape(&new)),
                    "{setup}"
                );
                let side = setup.engine.side().map(NonZeroU32::get);
                assert_eq!(shape(&new), (setup.engine.levels(), side), "{setup}");
                setups += 1;
            }
        }
    }
    assert_eq!(setups, (3 + 1) * (9 + 11));
}

#[test]
fn a_saved_graph_has_the_levels_and_the_side_that_are_named() {
    let with = |built: &str, asked: &str| {
        let bytes = build(setup(built), &map()).expect("an index");
        read(setup(asked), &map(), bytes).map(|index| shape(&index))
    };
    for (built, asked) in [
        ("hpa,levels=1", "hpa"),
        ("hpa,side=5,levels=2", "hpa"),
        ("hpa,side=5,levels=2", "hpa,levels=2,unstraightened"),
        ("hpa,side=5,levels=2", "hpa,side=5"),
        ("hpa,side=5,levels=6", "hpa,levels=all"),
        ("chpa,side=7", "chpa,paper"),
        ("chpa,side=7", "chpa,side=7,squared"),
    ] {
        let made = with(built, asked).unwrap_or_else(|error| panic!("{built}, {asked}: {error}"));
        let built = setup(built).engine;
        assert_eq!(made, (built.levels(), built.side().map(NonZeroU32::get)), "{asked}");
    }
    let number = |n| Levels::Number(NonZeroU32::new(n).expect("a level"));
    let levels = |expected, found| Error::Levels { expected: number(expected), found: Some(number(found)) };
    for (built, asked, error) in [
        ("hpa,levels=1", "hpa,levels=2", levels(2, 1)),
        ("hpa,side=5,levels=2", "hpa,levels=all", levels(6, 2)),
        ("hpa,side=5,levels=2", "hpa,side=10,levels=2", Error::Side { expected: 10, found: 5 }),
        ("chpa", "chpa,side=4", Error::Side { expected: 4, found: 3 }),
    ] {
        let refused = with(built, asked).map(|_| ()).map_err(|refused| refused.to_string());
        assert_eq!(refused, Err(error.to_string()), "{built}, {asked}");
    }
}
