//! Subgoals as the map decides: hub labels within a budget of memory, contraction hierarchies, and neither.

use mediant::{Ends, Engine, Error, ErrorCode, Guarantee, Index, Map, Query, Setup, Vertex, options::Levels};
use mediant_formats::{IndexFile, IndexKey};
use mediant_grid::Identity;
use mediant_oracle::{Rng, noise, random_free_vertex};

use super::{index, levels, map, read, setup};

/// A map of noise.
fn noisy(side: u32, percent: u32) -> Map {
    Map::from(noise(&mut Rng::new(7), side, side, percent))
}

/// Some queries between free vertices of a map.
fn queries(map: &Map, setup: Setup, count: usize) -> Vec<Ends> {
    let rng = &mut Rng::new(11);
    let mut end = || -> Vertex {
        random_free_vertex(rng, map.grid(), setup.rules().placement()).expect("a free vertex")
    };
    (0..count).map(|_| Ends::new(end(), end())).collect()
}

/// Checks that two indexes give paths of the same lengths.
fn check_equal(one: &Index, other: &Index, queries: &[Ends]) {
    let (mut one, mut other) = (one.planner(), other.planner());
    for &query in queries {
        let [a, b] = [&mut one, &mut other].map(|planner| planner.find(query).expect("free ends").cost());
        assert_eq!(a.is_some(), b.is_some(), "{query:?}");
        let [a, b] = [a, b].map(Option::unwrap_or_default);
        assert!((a - b).abs() < 1e-9 * a.max(1.0), "{query:?}: {a}, {b}");
    }
}

#[test]
fn labels_are_made_where_they_fit() {
    let map = noisy(40, 20);
    for text in ["subgoal:2:one", "subgoal:3:never", "subgoal:4:closed", "subgoal:any:open"] {
        let default = index(setup(text), &map).expect("an index");
        assert_eq!(levels(&default), Some(Levels::Labels), "{text}");
        assert_eq!(default.searched_by(), Engine::Subgoal);
        // To the byte.
        let bytes = default.memory_bytes();
        for (most, made) in
            [(bytes, Levels::Labels), (bytes - 1, Levels::Contracted), (1, Levels::Contracted)]
        {
            let setup = setup(&format!("{text},memory={most}"));
            let within = index(setup, &map).expect("an index");
            assert_eq!(levels(&within), Some(made), "{setup}");
            assert_eq!((within.setup(), within.searched_by()), (setup, Engine::Subgoal));
            check_equal(&within, &default, &queries(&map, setup, 30));
        }
        let named = |levels: &str| index(setup(&format!("{text},levels={levels}")), &map);
        assert_eq!(named("labels").map(|index| levels(&index)).ok(), Some(Some(Levels::Labels)));
        assert_eq!(named("contracted").map(|index| levels(&index)).ok(), Some(Some(Levels::Contracted)));
        let error = named("labels,memory=1kB").expect_err("they do not fit");
        let expected =
            "the hub labels take more than 1000 bytes: allow more memory, or prepare a contraction hierarchy";
        assert_eq!((error.to_string().as_str(), error.code()), (expected, ErrorCode::IndexRange));
    }
}

#[test]
fn a_loaded_index_may_take_no_more_than_is_allowed() {
    let bytes = index(setup("subgoal"), &map()).and_then(|index| index.to_bytes()).expect("an index");
    let takes = index(setup("subgoal"), &map()).expect("an index").memory_bytes();
    let with = |memory: u64| read(setup(&format!("subgoal,memory={memory}")), &map(), bytes.clone());
    assert_eq!(with(takes).map(|index| levels(&index)).ok(), Some(Some(Levels::Labels)));
    let error = with(takes - 1).expect_err("it takes more");
    assert!(matches!(error, Error::Memory { .. }) && error.code() == ErrorCode::IndexOptions, "{error:?}");
    let expected = format!(
        "needs hub labels of at most {}, found {takes} in the index; allow more memory, or prepare it again",
        takes - 1
    );
    assert_eq!(error.to_string(), expected);
}

#[test]
fn distances_are_the_lengths_of_paths() {
    let map = noisy(30, 25);
    for text in [
        "subgoal",
        "subgoal,levels=contracted",
        "subgoal:any:open",
        "subgoal:5:closed",
        "astar",
        "subgoal:3:open,taut",
    ] {
        let setup = setup(text);
        let mut planner = setup.planner(&map).expect("a planner");
        for query in queries(&map, setup, 50) {
            let path = planner.find(query).expect("free ends").cost();
            let distance = planner.distance(query).expect("free ends");
            assert_eq!(path.is_some(), distance.is_some(), "{setup}: {query:?}");
            let [path, distance] = [path, distance].map(Option::unwrap_or_default);
            assert!((path - distance).abs() <= 1e-9 * path, "{setup}: {query:?}: {path}, {distance}");
        }
        let outside = planner.distance(Ends::new((0, 0), (-1, 0))).map_err(|error| error.to_string());
        assert_eq!(
            outside,
            planner.find(Query::new((0, 0), (-1, 0))).map(|_| None).map_err(|error| error.to_string())
        );
    }
}

/// The saved index of a map on which nothing was kept.
pub(crate) fn nothing(setup: Setup, map: &Map) -> Vec<u8> {
    let space = setup.space(map).expect("a space");
    let identity: Identity = space.identity();
    let version = setup.index_version().expect("it is saved");
    let key = IndexKey::new("subgoal", version, identity).expect("a key");
    let payload = [&identity.to_bytes()[..], &(u32::MAX - 2).to_le_bytes()].concat();
    IndexFile::new(key, payload).to_bytes()
}

#[test]
fn where_nothing_is_kept_another_engine_searches() {
    let map = noisy(30, 25);
    for (text, engine) in [
        ("subgoal:2:never", Engine::JpsBlock),
        ("subgoal:3:never", Engine::JpsBlock),
        ("subgoal:3:open", Engine::JpsBlock),
        ("subgoal:4:closed", Engine::Anya),
        ("subgoal:any:open", Engine::Anya),
        ("subgoal:any:open,taut", Engine::Anya),
    ] {
        let setup = setup(text);
        let bytes = nothing(setup, &map);
        let loaded = read(setup, &map, bytes.clone()).expect("an index");
        assert_eq!((loaded.setup(), loaded.searched_by()), (setup, engine));
        assert_eq!((levels(&loaded), loaded.to_bytes().ok()), (None, Some(bytes.clone())));
        assert_eq!(loaded.planner().guarantee(), setup.guarantee());
        check_equal(&loaded, &index(setup, &map).expect("an index"), &queries(&map, setup, 30));
        let mut named = setup;
        named.engine = super::setup("subgoal:3:open,levels=contracted").engine;
        let error = read(named, &map, bytes).expect_err("it has no graph").to_string();
        assert!(
            error.starts_with("needs an index with a contraction hierarchy, found one with no subgoals"),
            "{error}"
        );
    }
}

#[test]
fn old_versions_are_refused_by_name() {
    let setup = setup("subgoal");
    let space = setup.space(&map()).expect("a space");
    let key = IndexKey::new("subgoal", 3, space.identity()).expect("a key");
    let error = space.index_from_bytes(IndexFile::new(key, Vec::new()).to_bytes()).expect_err("an old one");
    assert_eq!(error.code(), ErrorCode::IndexEngine);
    assert_eq!(
        error.to_string(),
        "expected version 5 of the subgoal index, found version 3; prepare it again"
    );
}

#[test]
fn an_index_that_was_loaded_can_be_prepared_again() {
    let map = noisy(40, 20);
    for text in ["subgoal", "subgoal,memory=1kB", "subgoal,levels=labels", "subgoal,levels=2"] {
        let made = index(setup(text), &map).expect("an index");
        let space = made.space();
        let loaded = space.index_from_bytes(made.to_bytes().expect("bytes")).expect("an index");
        let again = loaded.setup().prepare(space).expect("an index");
        assert_eq!(levels(&again), levels(&made), "{text}");
        assert_eq!(again.to_bytes().ok(), made.to_bytes().ok(), "{text}");
        assert_eq!(again.planner().guarantee(), Guarantee::Optimal(super::k(3)));
    }
}
/// On noise the contraction leaves a core, and a search that passes it is slower than one without an index.
#[test]
fn on_noise_nothing_is_kept() {
    let (map, setup) = (noisy(90, 5), setup("subgoal:any:open"));
    let made = index(setup, &map).expect("an index");
    let anya = index(super::setup("anya"), &map).expect("dead ends");
    assert_eq!((made.searched_by(), levels(&made)), (Engine::Anya, None));
    assert_eq!(made.memory_bytes(), anya.memory_bytes(), "dead ends alone");
    let bytes = made.to_bytes().expect("bytes");
    assert_eq!(bytes, nothing(setup, &map));
    let (mut anya, mut planner) = (anya.planner(), made.planner());
    for query in queries(&map, setup, 3) {
        assert_eq!(planner.find_counted(query), anya.find_counted(query));
    }
    let error =
        made.space().prepare(super::setup("subgoal:any:open,levels=labels").engine).expect_err("a core");
    assert_eq!(error.code(), ErrorCode::IndexRange);
    let said = error.to_string();
    assert!(said.starts_with("this map has no hub labels: the contraction leaves a core of "), "{said}");
}

/// For every k it is compared with the engine that would search in its place.
#[test]
fn on_sparse_noise_jumps_or_anya_search_for_every_k() {
    let map = noisy(90, 5);
    for (text, engine) in [
        ("subgoal:3:closed", Engine::JpsBlock),
        ("subgoal:3:open", Engine::JpsBlock),
        ("subgoal:6:open", Engine::Anya),
    ] {
        let made = index(setup(text), &map).expect("an index");
        assert_eq!((made.searched_by(), levels(&made)), (engine, None), "{text}");
    }
    // With more obstacles the hierarchy pays, whether as labels or with a core.
    let index = index(setup("subgoal:3:never,memory=1"), &noisy(90, 25)).expect("an index");
    assert_eq!((index.searched_by(), levels(&index)), (Engine::Subgoal, Some(Levels::Contracted)));
}

#[test]
fn another_k_gives_the_index_of_that_k() {
    let map = noisy(40, 20);
    for (text, other) in [
        ("subgoal:any:open", "subgoal:3:open"),
        ("subgoal:3:closed,memory=1MB", "subgoal:any:closed,memory=1MB"),
        ("subgoal:any:open,levels=labels", "subgoal:4:open,levels=labels"),
        ("subgoal:any:open,memory=1", "subgoal:4:open,memory=1"),
        ("subgoal:2:never", "subgoal:3:never"),
        ("jps-plus:2:never", "jps-plus:3:never"),
        ("subgoal:any:open,taut", "subgoal:5:open,taut"),
    ] {
        let made =
            index(setup(text), &map).and_then(|index| index.for_k(setup(other).k())).expect("an index");
        let alone = index(setup(other), &map).expect("an index");
        assert_eq!((made.setup(), made.identity()), (alone.setup(), alone.identity()));
        assert_eq!(made.to_bytes().ok(), alone.to_bytes().ok(), "{text}, {other}");
    }
    let error = index(setup("subgoal:3:never"), &map).and_then(|index| index.for_k(mediant::K::ANY));
    assert_eq!(error.map(|_| ()).map_err(|error| error.code()), Err(ErrorCode::Motion));
    let error = index(setup("subgoal:2:always"), &map).and_then(|index| index.for_k(mediant::K::N8));
    assert_eq!(error.map(|_| ()).map_err(|error| error.code()), Err(ErrorCode::EngineRules));
}
