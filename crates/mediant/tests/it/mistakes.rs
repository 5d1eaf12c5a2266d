//! Every mistake is an error with its code, and nothing panics.

use mediant::{Engine, Error, ErrorCode, Grid, K, Map, Motion, Rectangle, Setup};

use super::{k, map};

#[test]
fn each_mistake_has_its_code() {
    use ErrorCode as Code;
    let code = |wrong: Result<(), Error>| wrong.map_err(|error| (error.code(), error.to_string()));
    let space = |motion| map().space(motion);
    let outside = Rectangle { x: 9, y: 0, width: 1, height: 1 };
    let cut = |bytes: Vec<u8>| bytes[..bytes.len() - 1].to_vec();
    let walkers = space(Motion::centers(K::N8)).expect("a space");
    let bytes = walkers.prepare(Engine::Hpa).and_then(|index| index.to_bytes()).expect("an index");
    let mistakes: Vec<(Code, Result<(), Error>)> = vec![
        (Code::MapSize, Map::from_rows::<&str>([]).map(drop)),
        (Code::MapSize, Map::from_fn(Grid::MAX_SIDE + 1, 1, |_, _| false).map(drop)),
        (Code::MapSize, Map::from_bits(0, &[]).map(drop)),
        (Code::MapRagged, Map::from_rows(["..", "..."]).map(drop)),
        (Code::MapRagged, Map::from_bits(3, &[true; 7]).map(drop)),
        (Code::EditOutside, map().edit(outside, |_, _| true).map(drop)),
        (Code::EditOutside, walkers.edit(outside, |_, _| true).map(drop)),
        (Code::Motion, space(Motion::centers(K::ANY)).map(drop)),
        (Code::Motion, space(Motion::corners(k(13))).map(drop)),
        (Code::UnknownName, "warp".parse::<Engine>().map(drop).map_err(Error::from)),
        (Code::SetupText, "astar:1".parse::<Setup>().map(drop).map_err(Error::from)),
        (Code::EngineK, walkers.planner(Engine::Anya).map(drop)),
        (Code::EngineRules, walkers.planner(Engine::SubgoalTheta).map(drop)),
        (Code::EngineWithout, walkers.prepare(Engine::AStar).and_then(|index| index.to_bytes()).map(drop)),
        (Code::EngineWithout, walkers.distances(Engine::Jps, (0, 0)).map(drop)),
        (Code::StartBlocked, map().path((6, 0), (0, 0)).map(drop)),
        (Code::GoalBlocked, map().path((0, 0), (6, 0)).map(drop)),
        (Code::StartOutside, map().path((-1, 0), (0, 0)).map(drop)),
        (Code::GoalOutside, map().path((0, 0), (i32::MAX, i32::MIN)).map(drop)),
        (Code::IndexDamaged, walkers.index_from_bytes(cut(bytes.clone())).map(drop)),
        (Code::IndexDamaged, walkers.index_from_bytes(Vec::new()).map(drop)),
        (
            Code::IndexOptions,
            walkers.prepare(Engine::Hpa).and_then(|index| {
                let side = std::num::NonZeroU32::new(7);
                let side = mediant::HpaOptions { side, ..mediant::HpaOptions::default() };
                index.with_options(mediant::ConfiguredEngine::Hpa(side)).map(drop)
            }),
        ),
        (
            Code::EngineOption,
            walkers.prepare(Engine::Hpa).and_then(|index| index.with_options(Engine::Chpa).map(drop)),
        ),
        (
            Code::IndexRange,
            "hpa,side=65"
                .parse::<Setup>()
                .map_err(Error::from)
                .and_then(|setup| setup.prepare(&walkers).map(drop)),
        ),
        (Code::FileMissing, Map::open("no such file").map(drop)),
        (Code::FileMissing, walkers.load("no such file").map(drop)),
        (Code::FileUnreadable, Map::open(".").map(drop)),
        (Code::FileUnwritable, walkers.prepare(Engine::Hpa).and_then(|index| index.save("no such folder/x"))),
        (Code::MapFormat, Map::open("Cargo.toml").map(drop)),
        (Code::IndexDamaged, walkers.load("Cargo.toml").map(drop)),
    ];
    for (at, (expected, mistake)) in mistakes.into_iter().enumerate() {
        let (found, text) = code(mistake).expect_err("a mistake");
        assert_eq!(found, expected, "{at}: {text}");
        assert!(!text.is_empty() && !text.ends_with('.'), "{at}: {text}");
    }
}

/// Pinned: bindings and scripts rely on them. A new code is added at its place, none is changed.
#[test]
fn codes_keep_their_names() {
    let names = ErrorCode::ALL.map(ErrorCode::name).join(" ");
    assert_eq!(
        names,
        "map-size map-ragged edit-outside k motion unknown-name setup-text engine-option engine-k \
         engine-rules engine-without mismatch start-blocked goal-blocked start-outside goal-outside gave-up \
         index-range index-options index-damaged index-engine index-edit file-missing file-unreadable \
         file-unwritable map-format scenario-format other"
    );
}
