//! The library as its users call it.

use std::sync::Arc;

use mediant::{
    Answer, Choice, CornerRule, Demand, DiagonalGap, Ends, Engine, Error, ErrorCode, K, Map, Motion, Path,
    Planner, Query, Rules, Setup, Smoothing, Space, Vertex,
    errors::{BrokenPath, QueryError},
    files::MapOptions,
    grid::Identity,
    options::EngineName,
    search::{Counters, End, Observer},
};
use mediant_formats::IndexFile;

use super::{k, map};

/// Handles can go to another thread; threads can share a map, a space and an index.
#[test]
fn handles_are_owned_and_can_be_sent() {
    fn shared<T: Clone + Send + Sync + 'static>() {}
    fn owned<T: Send + 'static>() {}
    shared::<Map>();
    shared::<Space>();
    shared::<mediant::Index>();
    owned::<Planner>();
    fn error<T: std::error::Error + Send + Sync + 'static>() {}
    error::<Error>();
}

/// A path whose goal was blocked can be followed as far as before.
#[test]
fn a_path_tells_how_far_it_holds() {
    let space =
        Map::from_rows(["...", "..#"]).expect("a map").space(Motion::centers(K::N8)).expect("a space");
    let path = Path::new([(0, 1), (0, 0), (2, 0), (2, 1)].map(Vertex::from).into());
    let broken = space.check(&path).expect_err("its goal is blocked");
    assert!(matches!(broken, BrokenPath::Blocked { end: End::Goal, .. }));
    assert_eq!(broken.holds_up_to(), 3);
}

/// A smoothed path has a waypoint only where it turns.
#[test]
fn a_smoothed_path_goes_straight() {
    let setup = Setup { smoothing: Some(Smoothing::Linear), ..super::setup("astar:2:open") };
    let map = Map::from_rows(["#.", ".."]).expect("a map");
    let path = setup.planner(&map).expect("a planner").find(Query::new((2, 0), (0, 2))).expect("free ends");
    let path = path.into_path().expect("a path");
    assert_eq!(path.waypoints(), [(2, 0), (0, 2)].map(Vertex::from));
}

/// The wavefront takes the fewest moves, though they pass a closed gap.
#[test]
fn fewest_moves_pass_a_closed_gap() {
    let map = Map::from_rows(["..#.", "#...", ".#.."]).expect("a map");
    let motion = Motion::new(K::N32, Rules::Corner(DiagonalGap::Closed));
    let space = map.space(motion).expect("a space");
    let path = space.planner(Engine::Wavefront).expect("a planner").find(Query::new((2, 0), (4, 1)));
    let path = path.expect("free ends").into_path().expect("a path");
    assert_eq!(path.moves().count(), 2, "{path}");
    assert_eq!(space.check(&path), Ok(()));
    let moves = space.distances(Engine::Wavefront, (2, 0)).expect("a free start");
    assert!(moves.contains(&((4, 1).into(), 2.0)), "{moves:?}");
}

#[test]
fn maps_are_made_in_many_ways() {
    let rows = ["..#", "S@G"];
    let from_rows = Map::from_rows(rows).expect("a map");
    let cells: Vec<bool> = rows.concat().chars().map(|tile| "#@".contains(tile)).collect();
    assert_eq!(Map::from_bits(3, cells.iter().copied()).expect("a map"), from_rows);
    assert_eq!(Map::from_fn(3, 2, |x, y| cells[(3 * y + x) as usize]).expect("a map"), from_rows);
    let file = tempfile::Builder::new().suffix(".map").tempfile().expect("a file");
    std::fs::write(&file, "type octile\nheight 2\nwidth 3\nmap\n..@\n.TG\n").expect("it is written");
    assert_eq!(Map::open(file.path()).expect("a map").id(), from_rows.id());
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("it is written");
        path
    };
    let picture = file("yard.pbm", "P1 3 2  001 010\n");
    assert_eq!(Map::open(&picture).expect("a map").id(), from_rows.id());
    let yaml = "image: yard.pbm\nresolution: 0.5\norigin: [-1, 2, 0]\nnegate: 0\noccupied_thresh: 0.65\n\
                free_thresh: 0.25\n";
    let (map, world) = Map::open_with(file("yard.yaml", yaml), &MapOptions::default()).expect("a map");
    assert_eq!(map.id(), from_rows.id());
    let world = world.expect("a place in the world");
    assert_eq!(
        (world.cell_at(-0.9, 2.1), world.center_of((0, 1).into())),
        (Some((0, 1).into()), (-0.75, 2.25))
    );
    let options = MapOptions { invert: true, ..MapOptions::default() };
    assert!(
        Map::open_with(&picture, &options).is_ok_and(|(map, world)| {
            map.is_blocked((0, 0)) && !map.is_blocked((2, 0)) && world.is_none()
        })
    );
    let code = |name: &str, text: &str| Map::open(file(name, text)).map_err(|error| error.code().name());
    assert_eq!(code("cut.pgm", "P5 9 9 255\n"), Err("map-format"));
    assert_eq!(code("no.yaml", &yaml.replace("yard", "none")), Err("file-missing"));
    assert_eq!(code("half.yaml", "image: yard.pbm\n"), Err("map-format"));
    assert_eq!(code("letter.txt", "Dear reader"), Err("map-format"));
    assert_eq!((from_rows.width(), from_rows.height()), (3, 2));
    assert!(from_rows.is_blocked((2, 0)) && !from_rows.is_blocked((2, 1)) && from_rows.is_blocked((3, 0)));
    let grid = Arc::clone(from_rows.grid());
    assert_eq!(Map::from(grid.as_ref().clone()), Map::from(grid));
}

/// An observer is a trait object, and hears what the counters count.
#[test]
fn observers_are_trait_objects() {
    let space = map().space(Motion::centers(K::N8)).expect("a space");
    let mut planner = space.planner(Engine::AStar).expect("a planner");
    let query = Ends::new((0, 0), (8, 4));
    let mut counters: Box<dyn Observer> = Box::new(Counters::default());
    let observed = planner.find_observed(query, &mut *counters);
    let (counted, counts) = planner.find_counted(query).expect("both ends are free");
    assert_eq!(observed, Ok(counted));
    assert!(counts.expanded > 3);
}

/// The engine that is chosen takes the space, and its paths are shortest.
#[test]
fn the_chosen_engine_finds_shortest_paths() {
    let query = Ends::new((0, 0), (8, 4));
    for rules in Rules::ALL {
        for k in (2..=7).map(|n| K::Finite(k(n))).chain([K::Any]) {
            let Ok(space) = map().space(Motion::new(k, rules)) else { continue };
            let reference = if k == K::Any { Engine::Anya } else { Engine::AStar };
            let cost = |engine: Engine| {
                let answer = space.planner(engine).expect("it takes the space").find(query);
                answer.expect("both ends are free").path().expect("there is one").cost()
            };
            let best = cost(reference);
            assert!(
                (cost(space.engine().engine) - best).abs() < 1e-9,
                "{}: {}",
                space.motion(),
                space.engine()
            );
            let motion = space.motion();
            let choices = [Choice::for_some_paths, Choice::for_one_path].map(|choice| choice(motion));
            for choice in choices.into_iter().chain([Choice::for_next_path(motion, space.map())]) {
                assert!((cost(choice.engine) - best).abs() < 1e-9, "{}: {choice}", space.motion());
            }
            let now = space.path(query.start, query.goal).expect("both ends are free").expect("there is one");
            assert!((now.cost() - best).abs() < 1e-9, "{}", space.motion());
        }
    }
}

/// At corners Anya needs hardly any preparation. On maps too large for subgoals it also searches many paths.
#[test]
fn the_choice_depends_on_the_motion() {
    use Engine::{AStar, Anya, Canonical, Jps, JpsBlock};
    let large = Map::from_fn(4097, 4096, |_, _| false).expect("a map");
    for (motion, one, some, many) in [
        (Motion::centers(K::N8), Canonical, JpsBlock, JpsBlock),
        (Motion::centers(K::N16), AStar, AStar, Jps),
        (Motion::centers(k(6)), AStar, AStar, Canonical),
        (Motion::corners(K::N4), Anya, JpsBlock, JpsBlock),
        (Motion::corners(K::N8), Anya, JpsBlock, JpsBlock),
        (Motion::corners(K::N16), Anya, Anya, Anya),
        (Motion::corners(k(12)), Anya, Anya, Anya),
        (Motion::corners(K::ANY), Anya, Anya, Anya),
    ] {
        let chosen = [Choice::for_one_path(motion), Choice::for_some_paths(motion)].map(|one| one.engine);
        assert_eq!(chosen, [one, some], "{motion}");
        assert_eq!(large.space(motion).expect("a space").engine().engine, many, "{motion}");
    }
}

/// A path after each edit of a small map: nothing is prepared that one path would not need.
#[test]
fn the_next_path_on_a_small_map_is_searched_at_once() {
    use Engine::{AStar, Anya, Canonical, JpsBlock};
    let maps = [(64, 64), (65, 64)].map(|(w, h)| Map::from_fn(w, h, |_, _| false).expect("a map"));
    for (motion, engines) in [
        (Motion::centers(K::N4), [Canonical, JpsBlock]),
        (Motion::centers(K::N8), [Canonical, JpsBlock]),
        (Motion::centers(K::N16), [AStar; 2]),
        (Motion::corners(K::N8), [JpsBlock; 2]),
        (Motion::corners(K::ANY), [Anya; 2]),
    ] {
        let chosen = [0, 1].map(|i: usize| Choice::for_next_path(motion, &maps[i]).engine);
        assert_eq!(chosen, engines, "{motion}");
    }
}

/// `auto` knows how much is asked, and with options takes an engine that has them.
#[test]
fn the_engine_follows_what_is_asked() {
    use Engine::{Canonical, Dijkstra, JpsBlock, JpsPlus, Landmarks, Subgoal};
    let space =
        |motion| Map::from_rows(["....", ".##.", "...."]).expect("a map").space(motion).expect("a space");
    let centers = space(Motion::centers(K::N8));
    let asked = |space: &Space, demand| space.engine_for(demand).map(|choice| choice.engine);
    for (paths, engine) in [
        (0, Canonical),
        (1, Canonical),
        (2, JpsBlock),
        (1_000, JpsBlock),
        (1_001, Subgoal),
        (u64::MAX, Subgoal),
    ] {
        assert_eq!(asked(&centers, Demand::Paths(paths)), Ok(engine), "{paths}");
    }
    assert_eq!(asked(&centers, Demand::Distances), Ok(Dijkstra));
    assert!(asked(&space(Motion::corners(K::ANY)), Demand::Distances).is_err());
    for (motion, engine) in [
        (Motion::centers(K::N8), Some(Subgoal)),
        (Motion::new(K::N8, CornerRule::One), Some(JpsPlus)),
        (Motion::corners(k(12)), Some(Subgoal)),
        (Motion::corners(K::ANY), Some(Subgoal)),
        (Motion::centers(K::N16), Some(Landmarks)),
        (Motion::centers(k(8)), Some(Landmarks)),
        (Motion::centers(k(9)), None),
    ] {
        let found = asked(&space(motion), Demand::Index);
        assert_eq!(found.as_ref().ok(), engine.as_ref(), "{motion}");
        if let Err(error) = found {
            assert_eq!(Error::from(error).code(), ErrorCode::EngineWithout);
        }
    }
    // For every demand and motion the engine takes the motion and does what is asked.
    for rules in Rules::ALL {
        for k in [K::N4, K::N8, K::N16, k(7).into()] {
            let space = space(Motion::new(k, rules));
            let changing = [0, 10, 100, u64::MAX].map(|paths| Demand::Changing { paths });
            let others = [Demand::Paths(1), Demand::Paths(9), Demand::Paths(u64::MAX), Demand::Distances];
            for demand in others.into_iter().chain(changing) {
                let engine = space.engine_for(demand).expect("there is one").engine;
                assert!(Setup::new(engine, Motion::new(k, rules)).check().is_ok(), "{engine}, {demand:?}");
                assert!(demand != Demand::Distances || engine.capabilities().distances);
            }
        }
    }
}

/// People write names in many ways; what is printed is one.
#[test]
fn names_are_read_as_people_write_them() {
    for engine in Engine::ALL {
        let name = engine.name();
        let written =
            [name.to_uppercase(), name.replace('-', "_"), name.replace('-', ""), format!("{name}*")];
        for text in written {
            assert_eq!(text.parse(), Ok(engine), "{text}");
        }
    }
    for (text, engine) in
        [("A*", Engine::AStar), ("jps+", Engine::JpsPlus), ("Lazy Theta*", Engine::LazyTheta)]
    {
        assert_eq!(text.parse(), Ok(engine), "{text}");
        assert_eq!(text.parse(), Ok(EngineName::Engine(engine)), "{text}");
    }
    assert_eq!(("AUTO".parse(), "auto".parse::<Engine>().is_err()), (Ok(EngineName::Auto), true));
    for text in ["", "*", "star", "jps++", "jps*plus", "+", "a"] {
        assert!(text.parse::<Engine>().is_err(), "{text}");
    }
    let error = "warp".parse::<EngineName>().expect_err("no engine").to_string();
    assert!(
        error.starts_with("expected one of auto, astar, dijkstra, ") && error.ends_with(", found `warp`")
    );
}

/// A file says for which rules and k its index is: a map alone can read it.
#[test]
fn maps_read_indexes_of_any_motion() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("index");
    let other = Map::from_fn(9, 5, |x, y| x == 4 && y != 0).expect("a map");
    for text in
        ["jps-plus:2", "subgoal:4:closed", "subgoal:any,levels=2", "subgoal-theta", "hpa,side=4", "chpa"]
    {
        let setup: Setup = text.parse().expect("a setup");
        let index = setup.space(&map()).and_then(|space| setup.prepare(&space)).expect("an index");
        index.save(&file).expect("a file");
        let bytes = index.to_bytes().expect("bytes");
        for read in [map().load(&file), map().index_from_bytes(bytes.clone())] {
            let read = read.expect("the index of this map");
            assert_eq!(
                (read.identity(), read.to_bytes().ok()),
                (index.identity(), Some(bytes.clone())),
                "{text}"
            );
        }
        let code = other.index_from_bytes(bytes).map_err(|error| error.code());
        assert_eq!(code.err(), Some(ErrorCode::Mismatch), "{text}");
        assert!(other.load(&file).is_err_and(|error| matches!(error, Error::InFile { .. })), "{text}");
    }
}

/// Nothing is made that an engine does not search.
#[test]
fn engines_in_free_space_make_no_grid_graph() {
    for (motion, engine, is_free) in [
        (Motion::centers(K::N8), Engine::Subgoal, true),
        (Motion::corners(K::N32), Engine::Subgoal, true),
        (Motion::corners(K::N32), Engine::SubgoalTheta, true),
        (Motion::corners(K::ANY), Engine::Anya, true),
        (Motion::corners(K::N16), Engine::Anya, true),
        (Motion::centers(K::N8), Engine::AStar, false),
        (Motion::centers(K::N8), Engine::Hpa, false),
    ] {
        let space = map().space(motion).expect("a space");
        let before = space.memory_bytes();
        let mut planner = space.planner(engine).expect("it takes the motion");
        assert!(planner.find(Query::new((0, 0), (8, 4))).is_ok_and(|answer| answer.path().is_some()));
        assert_eq!(space.memory_bytes() == before, is_free, "{engine}, {motion}");
    }
}

/// Damaged bytes are refused, whatever is damaged: by the checksum, and where that is right, by what reads
/// them, or they are an index that answers or gives up.
#[test]
fn damaged_indexes_are_refused() {
    for text in ["jps-plus", "subgoal", "subgoal:any,levels=2", "subgoal-theta", "hpa,side=4", "chpa"] {
        let setup: Setup = text.parse().expect("a setup");
        let space = setup.space(&map()).expect("a space");
        let whole = setup.prepare(&space).and_then(|index| index.to_bytes()).expect("an index");
        let refused = |bytes: Vec<u8>, what: &str| {
            let Err(error) = space.index_from_bytes(bytes) else { panic!("{text}, {what}: accepted") };
            assert!(matches!(error, Error::IndexFile(_)), "{text}, {what}: {error}");
        };
        for length in 0..whole.len() {
            refused(whole[..length].to_vec(), "cut");
        }
        for bit in (0..8 * whole.len()).step_by(3) {
            let mut bytes = whole.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            refused(bytes, &format!("bit {bit}"));
        }
        let file = IndexFile::from_bytes(whole).expect("an index");
        let (mut read, mut refused) = (0, 0);
        for bit in (0..8 * file.payload().len()).step_by(5) {
            let mut payload = file.payload().to_vec();
            payload[bit / 8] ^= 1 << (bit % 8);
            match space.index_from_bytes(IndexFile::new(file.key().clone(), payload).to_bytes()) {
                Err(_) => refused += 1,
                Ok(index) => {
                    let answer = index.planner().find(Query::new((0, 0), (8, 4)));
                    assert!(matches!(answer, Ok(_) | Err(QueryError::GaveUp { .. })), "{text}: {answer:?}");
                    read += 1;
                }
            }
        }
        // At least every bit of the identity is checked.
        assert!(refused >= 8 * Identity::BYTES / 5, "{text}: {refused} refused, {read} read");
    }
}

#[test]
fn answers_are_taken_apart() {
    let space = map().space(Motion::centers(K::N8)).expect("a space");
    let mut planner = space.planner(Engine::Subgoal).expect("a planner");
    let answer = planner.find(Query::new((0, 0), (0, 0))).expect("a free cell");
    assert!(matches!(&answer, Answer::Found(path) if path.cost() == 0.0));
    assert_eq!(answer.into_path().map(|path| path.waypoints().len()), Some(1));
    assert!(planner.bound().is_some_and(|bound| bound > 1.0));
    let cutting =
        map().space(Motion::new(K::N8, CornerRule::Always)).and_then(|space| space.planner(Engine::AStar));
    assert_eq!(cutting.expect("a planner").bound(), None, "where corners are always cut none is proven");
    assert_eq!(planner.index().space().identity(), space.identity());
}

/// The README shows the first example as it is. Nine jobs take at most six names and ten lines each; other
/// examples are whole programs.
#[test]
fn common_jobs_are_short() {
    const PROGRAMS: [&str; 3] = ["agents.rs", "draw.rs", "open.rs"];
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let readme = std::fs::read_to_string(format!("{root}/README.md")).expect("the README");
    let examples = std::fs::read_dir("examples").expect("a folder").map(|file| file.expect("a file").path());
    let mut jobs = 0;
    for path in examples {
        if path.file_name().is_some_and(|name| PROGRAMS.iter().any(|program| name == *program)) {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("an example");
        let (_, code) = text.split_once("\n\n").expect("a first line that says what it shows");
        let is_shown = readme.contains(&format!("```rust\n{code}```"));
        assert_eq!(is_shown, path.ends_with("path.rs"), "{}", path.display());
        let [uses, main] = ["use mediant::", "fn main()"].map(|from| code.find(from).expect("it is there"));
        let names = code[uses..main].split(';').next().map_or(0, |names| names.split(',').count());
        let lines = code[main..].lines().skip(1).take_while(|line| *line != "    Ok(())");
        let lines = lines.filter(|line| !line.trim().is_empty()).count();
        assert!(names <= 6 && lines <= 10, "{}: {names} names, {lines} lines", path.display());
        jobs += 1;
    }
    assert_eq!(jobs, 9);
}

/// Options are changed on an index as if it had been prepared with them, or refused; whatever is accepted
/// makes planners.
#[test]
fn an_index_takes_the_options_that_it_serves() {
    let (mut accepted, mut refused) = (0, 0);
    let query = Ends::new((0, 0), (8, 4));
    let motions =
        [Motion::centers(K::N4), Motion::centers(K::N8), Motion::corners(K::N16), Motion::corners(K::ANY)];
    for motion in motions {
        let space = map().space(motion).expect("a space");
        let setups: Vec<Setup> = Setup::all(motion).filter(|one| one.smoothing.is_none()).collect();
        for (one, other) in setups.iter().flat_map(|one| setups.iter().map(move |other| (one, other))) {
            let index = one.prepare(&space).expect("it fits");
            match index.with_options(other.engine) {
                Err(error) => {
                    let is_right = matches!(
                        error,
                        Error::Setup(_)
                            | Error::Levels { .. }
                            | Error::Side { .. }
                            | Error::LandmarkCount { .. }
                            | Error::Memory { .. }
                    );
                    assert!(is_right, "{one}, {other}: {error}");
                    assert!(one != other, "{one}");
                    refused += 1;
                }
                Ok(index) => {
                    let found = index.planner().find_counted(query);
                    // Levels and side stay as prepared where the options leave them out.
                    let named = index.setup().prepare(&space).expect("it fits").planner().find_counted(query);
                    assert_eq!(found, named, "{one}, {other}");
                    accepted += 1;
                }
            }
        }
    }
    assert!(accepted > 200 && refused > 1_000, "{accepted} accepted, {refused} refused");
}
