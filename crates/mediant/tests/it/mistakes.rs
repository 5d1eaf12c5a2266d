//! Every mistake is an error with its code, and nothing panics.

use std::num::NonZeroU32;

use mediant::{
    CornerRule, Ends, Engine, Error, ErrorCode as Code, FiniteK, Index, K, Limits, Map, Motion, Path, Query,
    Rectangle, Setup, Space, Vertex,
    call::{Call, CallError, Group, Parameter, Spelling, Value},
    errors::absent,
    grid::Grid,
    options::{ConfiguredEngine, EngineOption, HpaOptions},
};
use mediant_formats::{IndexFile, IndexKey};

use super::{k, map};

/// A mistake, and the code that it should have.
type Mistake = (Code, Result<(), Error>);

fn walkers() -> Space {
    map().space(Motion::centers(K::N8)).expect("a space")
}

fn clusters() -> Index {
    walkers().prepare(Engine::Hpa).expect("an index")
}

/// A call with one parameter.
fn call(name: &str, value: Value<'_>) -> Result<Call, CallError> {
    let mut call = Call::default();
    let parameter = Parameter::find(name, Spelling::Kebab, &Group::ALL).expect("a parameter");
    call.set(parameter, value).map(|()| call)
}

/// Mistakes in maps, motion and queries.
fn in_maps_and_queries() -> Vec<Mistake> {
    let outside = Rectangle { x: 9, y: 0, width: 1, height: 1 };
    vec![
        (Code::MapSize, Map::from_rows::<&str>([]).map(drop)),
        (Code::MapSize, Map::from_fn(Grid::MAX_SIDE + 1, 1, |_, _| false).map(drop)),
        (Code::MapSize, Map::from_bits(0, []).map(drop)),
        (Code::MapRagged, Map::from_rows(["..", "..."]).map(drop)),
        (Code::MapRagged, Map::from_bits(3, [true; 7]).map(drop)),
        (Code::MapTile, Map::from_rows([".x"]).map(drop)),
        (Code::Cost, Map::new(2, 1).and_then(|map| map.costs([1.0, 0.0])).map(drop)),
        (Code::Cost, Map::new(2, 1).and_then(|map| map.costs([1_u8])).map(drop)),
        (Code::MapFormat, Map::open("Cargo.toml").map(drop)),
        (Code::FileMissing, Map::open("no such file").map(drop)),
        (Code::FileUnreadable, Map::open(".").map(drop)),
        (Code::EditOutside, map().edit(outside, |_, _| true).map(drop)),
        (Code::EditOutside, walkers().edit(outside, |_, _| true).map(drop)),
        (Code::K, FiniteK::new(1).map(drop).map_err(Error::from)),
        (Code::Motion, map().space(Motion::new(K::ANY, CornerRule::Never)).map(drop)),
        (Code::Motion, map().space(Motion::corners(k(13))).map(drop)),
        (Code::Argument, call("nearest", 1.into()).map(drop).map_err(Error::from)),
        (Code::Argument, call("tolerance", Value::Number(-1.0)).map(drop).map_err(Error::from)),
        (Code::UnknownName, call("corners", "sometimes".into()).map(drop).map_err(Error::from)),
        (Code::K, call("k", 1.into()).map(drop).map_err(Error::from)),
        (Code::BrokenPath, walkers().check(&Path::new(vec![(6, 0).into()])).map_err(Error::from)),
        (Code::StartBlocked, map().path((6, 0), (0, 0)).map(drop)),
        (Code::GoalBlocked, map().path((0, 0), (6, 0)).map(drop)),
        (Code::StartOutside, map().path((-1, 0), (0, 0)).map(drop)),
        (Code::GoalOutside, map().path((0, 0), (i32::MAX, i32::MIN)).map(drop)),
    ]
}

/// Mistakes in queries.
fn in_requests() -> Vec<Mistake> {
    let find = |query: Query| Ok(walkers().planner(Engine::AStar)?.find(query).map(drop)?);
    let (none, start): ([Vertex; 0], _) = ([], [(0, 0)]);
    let ends = Ends::new((0, 0), (1, 0));
    let step = || Ok(walkers().planner(Engine::AStar)?.step(1).map(drop)?);
    vec![
        (Code::NoEnd, find(Query::between(none, start))),
        (Code::NoEnd, find(Query::between(start, none).snap().nearest())),
        (Code::Between, find(Query::new((0.5, 0), (1, 0)))),
        (Code::Between, find(Query::new((0, 0), (1, 0.25)).nearest())),
        (Code::Number, find(ends.tolerance(f64::NAN))),
        (Code::Number, find(ends.within(Limits::new().cost(-1.0)))),
        (Code::NotBegun, step()),
        (Code::StartBlocked, find(Query::between([(0, 0), (6, 0)], start).nearest())),
        (Code::GoalOutside, find(Query::new((0, 0), (9, 0)).tolerance(5.0).nearest())),
    ]
}

/// Mistakes in engines and their indexes.
fn in_engines_and_indexes() -> Vec<Mistake> {
    let (space, far) = (walkers(), map().space(Motion::centers(K::N16)).expect("a space"));
    let whole = clusters().to_bytes().expect("an index that is saved");
    let file = IndexFile::from_bytes(whole.clone()).expect("an index");
    let key = IndexKey::new("warp", file.key().version(), space.identity()).expect("a plain name");
    let of_other_engine = IndexFile::new(key, file.into_payload()).to_bytes();
    let wide = "hpa,side=65".parse::<Setup>().expect("a setup");
    let other_side = HpaOptions { side: NonZeroU32::new(7), ..HpaOptions::default() };
    let other_side = ConfiguredEngine::Hpa(other_side);
    vec![
        (Code::UnknownName, "warp".parse::<Engine>().map(drop).map_err(Error::from)),
        (Code::SetupText, "astar:1".parse::<Setup>().map(drop).map_err(Error::from)),
        (Code::EngineK, far.planner(Engine::JpsBlock).map(drop)),
        (Code::EngineRules, space.planner(Engine::Anya).map(drop)),
        (Code::EngineWithout, space.prepare(Engine::AStar).and_then(|index| index.to_bytes()).map(drop)),
        (Code::EngineWithout, space.distances(Engine::Jps, (0, 0)).map(drop)),
        (Code::EngineOption, clusters().with_options(Engine::Chpa).map(drop)),
        (Code::IndexOptions, clusters().with_options(other_side).map(drop)),
        (Code::IndexRange, wide.prepare(&space).map(drop)),
        (Code::IndexEngine, space.index_from_bytes(of_other_engine).map(drop)),
        (Code::IndexDamaged, space.index_from_bytes(whole[..whole.len() - 1].to_vec()).map(drop)),
        (Code::IndexDamaged, space.index_from_bytes(Vec::new()).map(drop)),
        (Code::IndexDamaged, space.load("Cargo.toml").map(drop)),
        (Code::FileMissing, space.load("no such file").map(drop)),
        (Code::FileUnwritable, clusters().save("no such folder/x")),
    ]
}

#[test]
fn each_mistake_has_its_code() {
    let parts = [in_maps_and_queries(), in_requests(), in_engines_and_indexes()];
    let mistakes: Vec<Mistake> = parts.into_iter().flatten().collect();
    // Codes of other tests, of no call of the door, or of other versions alone.
    let elsewhere = [
        Code::Mismatch,
        Code::GaveUp,
        Code::ScenarioFormat,
        Code::Memory,
        Code::Cancelled,
        Code::Stopped,
        Code::Other,
    ];
    let made: Vec<Code> = mistakes.iter().map(|(code, _)| *code).collect();
    for code in Code::ALL {
        assert_eq!(made.contains(&code), !elsewhere.contains(&code), "{code}");
    }
    for (at, (expected, mistake)) in mistakes.into_iter().enumerate() {
        let error = mistake.expect_err("a mistake");
        let text = error.to_string();
        assert_eq!(error.code(), expected, "{at}: {text}");
        assert!(!text.is_empty() && !text.ends_with('.'), "{at}: {text}");
    }
}

/// Pinned: bindings and scripts rely on them. A new code comes before `other`, none is changed.
#[test]
fn codes_keep_their_names() {
    let names = Code::ALL.map(Code::name).join(" ");
    assert_eq!(
        names,
        "map-size map-ragged edit-outside k motion unknown-name setup-text engine-option engine-k \
         engine-rules engine-without mismatch start-blocked goal-blocked start-outside goal-outside gave-up \
         index-range index-options index-damaged index-engine file-missing file-unreadable \
         file-unwritable map-format scenario-format no-end between-vertices number not-begun memory cancelled \
         stopped argument broken-path map-tile cost other"
    );
}

#[test]
fn what_is_not_there_is_said_by_the_name_that_people_look_for() {
    for (name, part) in [
        ("weights", "a map with costs of cells"),
        ("cost_map", "costs of cells"),
        ("costMap", "costs of cells"),
        ("TERRAIN", "costs of cells"),
        ("one_way", "no one-way cells"),
        ("oneWay", "no one-way cells"),
        ("portals", "no links"),
        ("wrap-around", "does not wrap around"),
        ("hexagonal", "no hexagons"),
        ("layers", "no third dimension"),
        ("reservations", "no reservations"),
    ] {
        assert!(absent(name).is_some_and(|why| why.contains(part)), "{name}: {:?}", absent(name));
    }
    // Names of things that the library has, and names that nobody looks for.
    let options = EngineOption::ALL.map(|option| option.name);
    let others = ["k", "placement", "max_cost", "timeout", "nearest", "", "_", "wieghts"];
    for name in options.into_iter().chain(others) {
        assert_eq!(absent(name), None, "{name}");
    }
}
