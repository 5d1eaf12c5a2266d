//! Long calls of the library can be stopped anywhere.

use std::sync::{
    Arc,
    atomic::{AtomicBool, AtomicUsize, Ordering},
};

use mediant::{
    Engine, Error, ErrorCode, Exceptions, K, Limit, Limits, Map, Motion, Planner, Query, Rectangle, Space,
    grid::{Fit, Outside},
};
use mediant_formats::{MapFile, MapOptions, Raster, RasterFormat, RosMap};
use mediant_grid::Grid;

const SIDE: u32 = 60;

fn map() -> Map {
    Map::from_fn(SIDE, SIDE, |x, y| x % 7 == 3 && y % 5 != 2).expect("a map")
}

/// A motion that an engine takes.
fn space(engine: Engine) -> Space {
    let motions = [Motion::centers(K::N8), Motion::corners(K::ANY), Motion::corners(K::N8)];
    let mut spaces = motions.into_iter().map(|motion| map().space(motion).expect("a space"));
    spaces.find(|space| space.make_ready(engine).is_ok()).expect("a motion that it takes")
}

/// Limits whose deadline is over from the question with this number on, and the number of questions.
fn counting(last: usize) -> (Limits, Arc<AtomicUsize>) {
    let asked = Arc::new(AtomicUsize::new(0));
    let counter = Arc::clone(&asked);
    (Limits::new().deadline(move || counter.fetch_add(1, Ordering::Relaxed) >= last), asked)
}

/// Checks that a call ends with [`Error::Stopped`] at the first question, at 1, 10, 50 and 90 % of them and
/// at the last, and asks no more.
fn check<T>(name: &str, work: impl Fn(&Limits) -> Result<T, Error>) {
    // The first call makes what the process keeps, such as pruning rules.
    drop(work(&Limits::new()));
    let (limits, asked) = counting(usize::MAX);
    if let Err(error) = work(&limits) {
        panic!("{name}: {error}");
    }
    let all = asked.load(Ordering::Relaxed);
    assert!(all > 0, "{name} asks nothing");
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    for last in [0, all / 100, all / 10, all / 2, all / 10 * 9, all - 1] {
        let (limits, asked) = counting(last);
        let Err(error) = work(&limits) else { panic!("{name} goes on after question {last} of {all}") };
        assert_eq!(error.code(), ErrorCode::Stopped, "{name}: {error}");
        assert!(error.to_string().starts_with("out of time while "), "{name}: {error}");
        let more = asked.load(Ordering::Relaxed) - last;
        // Each thread may be asking, and ask again so that the others know.
        assert!(more <= 2 * threads, "{name} asks {more} times more after question {last} of {all}");
    }
    let limits = Limits::new().cancel(Arc::new(AtomicBool::new(true)));
    let cancelled = work(&limits).err().unwrap_or_else(|| panic!("{name} goes on"));
    assert!(matches!(cancelled, Error::Stopped { by: Limit::Cancelled, .. }), "{name}: {cancelled}");
}

#[test]
fn maps_and_spaces_stop() {
    let map = map();
    let motion = Motion::centers(K::N8);
    check("a space", |limits| map.within(limits).space(motion));
    check("a disc", |limits| map.within(limits).for_disc(1.5, motion));
    check("a square", |limits| map.within(limits).for_square(2));
    check("a clearance", |limits| map.within(limits).clearance(Fit::Centers, Outside::Open));
    check("a path", |limits| map.within(limits).path((0, 0), (58, 58)));
}

/// The engines that prepare something of a map of this kind.
#[test]
fn preparations_stop() {
    for engine in [
        Engine::JpsBlock,
        Engine::JpsPlus,
        Engine::Anya,
        Engine::Subgoal,
        Engine::SubgoalTheta,
        Engine::Hpa,
        Engine::Chpa,
        Engine::Landmarks,
    ] {
        let space = space(engine);
        check(engine.name(), |limits| space.within(limits).prepare(engine));
        let index = space.prepare(engine).expect("an index");
        // A limit that is not met changes nothing.
        let within = space.within(Limits::new().deadline(|| false)).prepare(engine).expect("an index");
        assert_eq!(within.searched_by(), index.searched_by());
        if let Ok(bytes) = index.to_bytes() {
            assert!(within.to_bytes().is_ok_and(|same| same == bytes), "{engine}");
            check(engine.name(), |limits| space.map().within(limits).index_from_bytes(bytes.clone()));
            check(engine.name(), |limits| space.within(limits).index_from_bytes(bytes.clone()));
        }
        let at = Rectangle { x: 10, y: 10, width: 30, height: 30 };
        let edited = space.edit(at, |x, y| x == y).expect("on the map");
        check(engine.name(), |limits| index.within(limits).repair(&edited));
    }
    let canonical = map().space(Motion::centers(K::N16)).expect("a space");
    check("a pruning rule", |limits| canonical.within(limits).prepare(Engine::Canonical));
}

/// On noise labels do not pay: engines are compared, and nothing is kept.
#[test]
fn comparisons_stop() {
    let map = Map::from_fn(60, 60, |x, y| (x * 7919 + y * 104_729 + x * y * 31) % 101 < 12).expect("a map");
    let space = map.space(Motion::corners(K::ANY)).expect("a space");
    let engine = mediant::options::ConfiguredEngine::Subgoal(mediant::options::SubgoalOptions {
        memory: mediant::options::Memory::new(1000),
        ..mediant::options::SubgoalOptions::default()
    });
    check("a comparison", |limits| space.within(limits).prepare(engine));
}

#[test]
fn fields_tables_and_widest_paths_stop() {
    for motion in [Motion::centers(K::N8), Motion::centers(K::N16), Motion::corners(K::ANY)] {
        let space = map().space(motion).expect("a space");
        check("a field", |limits| space.within(limits).field([(0, 0)]));
        check("a range", |limits| space.within(limits).field_within([(0, 0)], 60.0));
        if motion.k != K::ANY {
            check("distances", |limits| space.within(limits).distances(Engine::Dijkstra, (0, 0)));
        }
        let field = space.field([(0, 0)]).expect("a free source");
        let change = space.edit(Rectangle::new(20, 20, 30, 30), |x, y| x == y).expect("on the map");
        check("a field's repair", |limits| field.within(limits).repair(&change));
        check("a path", |limits| space.within(limits).path((0, 0), (58, 58)));
        check("a widest path", |limits| space.within(limits).widest_path((0, 0), (58, 58), 0.2));
        let ends: Vec<(i32, i32)> = (0..9).map(|i| (7 * i, 7)).filter(|&at| space.is_free(at)).collect();
        for engine in [Engine::Subgoal, space.engine().engine] {
            let Ok(index) = space.prepare(engine) else { continue };
            let table = |limits: &Limits| index.within(limits).table(ends.clone(), ends.clone());
            check("a table", table);
            let (limited, plain) = (table(&Limits::new().deadline(|| false)), table(&Limits::new()));
            assert_eq!(limited.expect("no end is blocked"), plain.expect("no end is blocked"));
        }
    }
    let space = map().space(Motion::centers(K::N8)).expect("a space");
    check("layers", |limits| space.within(limits).distances(Engine::Wavefront, (0, 0)));
    let jps = space.prepare(Engine::JpsBlock).expect("an index");
    let ends = [(0, 0), (58, 58)];
    check("a table of searches", |limits| jps.within(limits).table(ends, ends));
    check("another k", |limits| jps.within(limits).for_k(K::N4));
}

/// Questions over many goals stop, whether labels answer them or searches; so do queries of many pairs, which
/// labels answer without an expansion.
#[test]
fn questions_over_many_goals_stop() {
    for (motion, engine) in [
        (Motion::centers(K::N8), Engine::Subgoal),
        (Motion::corners(K::ANY), Engine::Subgoal),
        (Motion::corners(K::ANY), Engine::Anya),
        (Motion::centers(K::N8), Engine::JpsBlock),
    ] {
        let index = map().space(motion).expect("a space").prepare(engine).expect("an index");
        let ends = || (0..SIDE as i32).flat_map(|x| (0..SIDE as i32).map(move |y| (x, y)));
        let ends: Vec<(i32, i32)> = ends().filter(|&at| index.space().is_free(at)).collect();
        check("goals", |limits| index.within(limits).goals(ends.iter().copied()));
        // A query of each pair takes its time without labels.
        let some = &ends[..if engine == Engine::Subgoal { ends.len() } else { 60 }];
        let goals = index.goals(some.iter().copied()).expect("free goals");
        let planner = || index.planner();
        check("distances", |limits| planner().within(limits).distances((0, 0), &goals));
        check("the nearest", |limits| planner().within(limits).nearest((58, 58), &goals));
        let (mut limited, mut plain) = (planner(), planner());
        let not_met = Limits::new().deadline(|| false).expansions(0).cost(0.0);
        let distances = limited.within(&not_met).distances((0, 0), &goals).expect("a free start");
        assert_eq!(distances, plain.distances((0, 0), &goals).expect("a free start"));
        let nearest = limited.within(&not_met).nearest((58, 58), &goals).expect("a free start");
        assert_eq!(nearest, plain.nearest((58, 58), &goals).expect("a free start"));
        check("a row", |limits| index.within(limits).table([(0, 0)], some.iter().copied()));
        let table = index.within(&not_met).table([(0, 0)], some.iter().copied()).expect("free ends");
        assert_eq!(table.values(), distances);

        // Pairs on both sides of a wall are close, and the way around it is long: all are searched.
        let wall = Map::from_fn(SIDE, SIDE, |x, y| x == 30 && y != SIDE - 1).expect("a map");
        let index = wall.space(motion).expect("a space").prepare(engine).expect("an index");
        let side = |x: i32| (10..25).map(move |y| (x, y)).collect::<Vec<_>>();
        let (starts, goals, planner) = (side(28), side(33), || index.planner());
        let query = || Query::between(starts.iter().copied(), goals.iter().copied());
        check("many pairs", |limits| match planner().find(query().within(limits))? {
            mediant::Answer::Stopped(stopped) => {
                Err(Error::Stopped { by: stopped.by, during: "searching pairs" })
            }
            answer => Ok(answer),
        });
        let (limits, asked) = counting(usize::MAX);
        assert!(planner().find(query().within(limits)).expect("free ends").path().is_some());
        let (looks, pairs) = (asked.load(Ordering::Relaxed), starts.len() * goals.len());
        assert!(looks >= pairs / 16, "{engine}: {looks} looks at {pairs} pairs");
    }
}

/// A query that labels answer makes no expansion: it needs none, and ends where it may not begin.
#[test]
fn labels_need_no_expansions() {
    for motion in [Motion::centers(K::N8), Motion::corners(K::ANY)] {
        let mut planner = map().space(motion).expect("a space").planner(Engine::Subgoal).expect("one");
        let query = || Query::new((0, 0), (58, 58));
        let plain = planner.find(query()).expect("free ends");
        assert_eq!(planner.find(query().within(Limits::new().expansions(0))), Ok(plain));
        for (limits, by) in [
            (Limits::new().deadline(|| true), Limit::Timeout),
            (Limits::new().cancel(Arc::new(AtomicBool::new(true))), Limit::Cancelled),
        ] {
            match planner.find(query().within(limits)).expect("free ends") {
                mediant::Answer::Stopped(stopped) => assert_eq!(stopped.by, by),
                answer => panic!("{answer:?} after {by:?}"),
            }
            assert_eq!(planner.expansions(), 0);
        }
    }
}

/// A query's limits cover what is prepared for it.
#[test]
fn exceptions_stop() {
    let mut planner: Planner =
        map().space(Motion::centers(K::N8)).expect("a space").planner(Engine::Subgoal).expect("one");
    let mut find = |limits: Limits| {
        let except = Exceptions::new().blocked([(30, 30)]);
        planner.find_except(Query::new((0, 0), (58, 58)).within(limits), &except)
    };
    // The engine that answers where labels of the map before do not is prepared with the first one.
    let late = find(Limits::new().deadline(|| true));
    assert!(matches!(late, Err(Error::Stopped { .. })), "{late:?}");
    assert!(find(Limits::new().deadline(|| false)).is_ok());
}

/// Files, too, and they stay what they are.
#[test]
fn loading_stops() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("map.index");
    let space = map().space(Motion::centers(K::N8)).expect("a space");
    space.prepare(Engine::Subgoal).expect("an index").save(&file).expect("room");
    check("loading", |limits| space.within(limits).load(&file));
    check("loading for a map", |limits| space.map().within(limits).load(&file));
    check("loading for an engine", |limits| space.within(limits).load_for(Engine::Subgoal, &file));
    assert!(space.load(&file).is_ok());
}

/// So are files of maps of all kinds, row by row.
#[test]
fn opening_stops() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let map = map();
    let grid = map.grid();
    let mut drawn = Vec::new();
    MapFile::from_grid(grid).write(&mut drawn).expect("memory");
    std::fs::write(path("hall.map"), drawn).expect("room");
    let picture = Raster::from_grid(grid).expect("a picture");
    let formats = [
        ("plain.pbm", RasterFormat::PlainPbm),
        ("plain.pgm", RasterFormat::PlainPgm),
        ("hall.pbm", RasterFormat::Pbm),
        ("hall.pgm", RasterFormat::Pgm),
        ("hall.png", RasterFormat::Png),
    ];
    for (name, format) in formats {
        let mut drawn = Vec::new();
        picture.write(format, &mut drawn).expect("memory");
        std::fs::write(path(name), drawn).expect("room");
    }
    let world = RosMap::from_grid(grid, "room.png", 0.5, [0.0; 3]).expect("a map");
    world.save(path("room.yaml")).expect("room");
    let options = MapOptions::default();
    let (limits, asked) = counting(usize::MAX);
    Grid::from_fn_interruptible(SIDE, SIDE, mediant_search::Limits::from(limits).interrupt(), |_, _| false)
        .expect("a map");
    let made = asked.load(Ordering::Relaxed);
    for name in formats.map(|(name, _)| name).into_iter().chain(["hall.map", "room.yaml"]) {
        let open = |limits: &Limits| Map::open_within(path(name), &options, limits);
        check(name, open);
        // Reading asks for each row, and not only making the map does.
        let (limits, asked) = counting(usize::MAX);
        assert!(open(&limits).is_ok() && asked.load(Ordering::Relaxed) >= made + SIDE as usize, "{name}");
        assert_eq!(open(&Limits::new()).expect("a map").0, map, "{name}");
    }
}

/// An older file stays.
#[test]
fn saving_stops() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("map.index");
    let space = map().space(Motion::centers(K::N8)).expect("a space");
    std::fs::write(&file, "older").expect("room");
    for engine in [Engine::Subgoal, Engine::JpsPlus, Engine::Hpa, Engine::Chpa, Engine::Landmarks] {
        let index = space.prepare(engine).expect("an index");
        check(&format!("saving {engine}"), |limits| {
            let saved = index.within(limits).save(&file);
            let content = std::fs::read(&file).expect("a file");
            assert_eq!(content == b"older", saved.is_err());
            std::fs::write(&file, "older").expect("room");
            saved
        });
        // Making the bytes asks the interrupt, too, not only their checksum; those of CHPA* are copied.
        let (limits, asked) = counting(usize::MAX);
        let bytes = index.within(&limits).to_bytes().expect("an index");
        let pieces = bytes.len().div_ceil(1 << 20);
        assert!(engine == Engine::Chpa || asked.load(Ordering::Relaxed) > pieces, "{engine}");
        assert_eq!(bytes, index.to_bytes().expect("an index"));
        check(&format!("the bytes of {engine}"), |limits| index.within(limits).to_bytes());
    }
    let files = std::fs::read_dir(folder.path()).expect("a folder");
    assert_eq!(files.count(), 1, "nothing else is left");
}
