//! Calls that are made where memory is short.

use mediant::{
    Change, Costs, Engine, Error, K, Limits, Map, Motion, Pace, Rectangle, Space,
    grid::{Fit, Outside},
    options::{ConfiguredEngine, Levels},
};

/// Maps on which what grows with the map is more than the least that is asked for.
const SIDE: u32 = 512;
/// A smaller one for subgoals, which take longer to prepare.
const SUBGOAL_SIDE: u32 = 256;

/// Work, and the least piece of memory that counts.
pub(crate) struct Case {
    pub(crate) least: usize,
    pub(crate) work: Work,
}

type Work = Box<dyn FnOnce() -> Result<(), Error>>;

const OTHERS: [&str; 21] = [
    "map",
    "rows",
    "bits",
    "open",
    "edit",
    "space centers",
    "space corners",
    "field",
    "field corners",
    "field any",
    "field between",
    "field repair",
    "costs",
    "costs by",
    "costs field",
    "walking",
    "walking field",
    "disc",
    "square",
    "clearance",
    "distances",
];

fn engines() -> Vec<(String, ConfiguredEngine, Motion)> {
    let mut all: Vec<_> = [
        (Engine::AStar, Motion::centers(K::N8)),
        (Engine::Canonical, Motion::centers(K::N32)),
        (Engine::JpsBlock, Motion::centers(K::N8)),
        (Engine::JpsPlus, Motion::centers(K::N8)),
        (Engine::Hpa, Motion::centers(K::N8)),
        (Engine::Chpa, Motion::centers(K::N8)),
        (Engine::Landmarks, Motion::centers(K::N8)),
        (Engine::Anya, Motion::corners(K::ANY)),
    ]
    .map(|(engine, motion)| (engine.to_string(), ConfiguredEngine::from(engine), motion))
    .into();
    for levels in [Levels::Contracted, Levels::Labels] {
        let mut configured = ConfiguredEngine::from(Engine::Subgoal);
        if let ConfiguredEngine::Subgoal(own) = &mut configured {
            own.levels = Some(levels);
        }
        all.push((format!("subgoal {levels:?}"), configured, Motion::centers(K::N8)));
    }
    all
}

pub(crate) fn names() -> Vec<String> {
    let mut names: Vec<String> = OTHERS.map(str::to_owned).into();
    for (engine, ..) in engines() {
        let is_saved = ["jps-plus", "subgoal", "hpa", "chpa"].iter().any(|saved| engine.starts_with(saved));
        let all = if is_saved {
            &["prepare", "planner", "repair", "bytes", "read"][..]
        } else {
            &["prepare", "planner", "repair"]
        };
        names.extend(all.iter().map(|what| format!("{what}: {engine}")));
    }
    // Not asked for yet: the lists of JPS+ that a repair adds, and what is read of labels.
    names.retain(|name| name != "repair: jps-plus" && name != "read: subgoal Labels");
    names
}

/// Lists that grow with a search or a change are not asked for; those of the contraction have a fixed length.
fn least(name: &str) -> usize {
    match name {
        "field any" | "field between" | "field repair" => 512 << 10,
        "repair: anya" | "prepare: subgoal Contracted" | "prepare: subgoal Labels" => 256 << 10,
        _ => 64 << 10,
    }
}

fn is_blocked(x: u32, y: u32) -> bool {
    (x % 16 == 5 && y % 16 > 4 && y % 16 < 14) || (x * 7919 + y * 104_729) % 211 == 3
}

fn map(side: u32) -> Map {
    Map::from_fn(side, side, |x, y| is_blocked(x, y) && x + y > 0).expect("a map")
}

fn done<T>(result: Result<T, Error>) -> Result<(), Error> {
    result.map(drop)
}

pub(crate) fn ready(name: &str) -> Case {
    let work = match name.split_once(": ") {
        Some((what, engine)) => of_engine(what, engine),
        None => other(name),
    };
    Case { least: least(name), work }
}

fn of_engine(what: &str, name: &str) -> Work {
    let (_, engine, motion) = engines().into_iter().find(|(own, ..)| own == name).expect("an engine");
    let map = map(if engine.kind() == Engine::Subgoal { SUBGOAL_SIDE } else { SIDE });
    let is_on_costs = engine.kind() == Engine::Landmarks;
    let space = if is_on_costs { costs(&map).space(motion) } else { map.space(motion) }.expect("a space");
    space.make_ready(engine).expect("it takes the motion");
    if what == "prepare" {
        return Box::new(move || done(space.prepare(engine)));
    }
    let index = space.prepare(engine).expect("an index");
    match what {
        "planner" => Box::new(move || done(index.try_planner())),
        "repair" => {
            let change = change(&space);
            change.after().make_ready(engine).expect("it takes the motion");
            Box::new(move || done(index.repair(&change)))
        }
        "bytes" => Box::new(move || done(index.to_bytes())),
        "read" => {
            let bytes = index.to_bytes().expect("it is saved");
            Box::new(move || done(space.index_from_bytes(bytes)))
        }
        _ => panic!("{what}"),
    }
}

fn change(space: &Space) -> Change {
    if space.costs().is_some() {
        return space.edit_costs([((100, 100), Some(3.0)), ((200, 200), None)]).expect("cells");
    }
    space.edit(Rectangle::new(100, 100, 40, 40), |x, y| (x + y) % 3 == 0).expect("cells")
}

fn costs(map: &Map) -> Costs {
    map.costs((0..SIDE * SIDE).map(|i| f64::from(1 + i % 7))).expect("costs")
}

fn n8() -> Motion {
    Motion::centers(K::N8)
}

fn other(name: &str) -> Work {
    match name.split(' ').next() {
        Some("field") => of_fields(name),
        Some("costs" | "walking") => on_numbers(name),
        _ => of_maps(name),
    }
}

/// The rows of a map.
fn rows() -> Vec<String> {
    let row = |y| (0..SIDE).map(|x| if is_blocked(x, y) { '@' } else { '.' }).collect();
    (0..SIDE).map(row).collect()
}

fn of_maps(name: &str) -> Work {
    let map = map(SIDE);
    match name {
        "map" => Box::new(|| done(Map::from_fn(SIDE, SIDE, is_blocked))),
        "rows" => {
            let rows = rows();
            Box::new(move || done(Map::from_rows(&rows)))
        }
        "bits" => Box::new(|| done(Map::from_bits(SIDE, (0..SIDE * SIDE).map(|cell| cell % 7 == 0)))),
        "open" => {
            let folder = tempfile::tempdir().expect("a folder");
            let text = format!("type octile\nheight {SIDE}\nwidth {SIDE}\nmap\n{}\n", rows().join("\n"));
            std::fs::write(folder.path().join("rooms.map"), text).expect("a file");
            Box::new(move || done(Map::open(folder.path().join("rooms.map"))))
        }
        "edit" => Box::new(move || done(map.edit(Rectangle::new(0, 0, SIDE, SIDE), |x, _| x % 3 == 0))),
        "space centers" => Box::new(move || done(map.space(n8()))),
        "space corners" => Box::new(move || done(map.space(Motion::corners(K::ANY)))),
        "disc" => Box::new(move || done(map.for_disc(1.2, n8()))),
        "square" => Box::new(move || done(map.for_square(3))),
        "clearance" => {
            Box::new(move || done(map.within(Limits::new()).clearance(Fit::Centers, Outside::Open)))
        }
        "distances" => {
            let space = map.space(n8()).expect("a space");
            Box::new(move || done(space.distances(Engine::Dijkstra, (0, 0))))
        }
        _ => panic!("{name}"),
    }
}

fn of_fields(name: &str) -> Work {
    let motion = match name {
        "field corners" => Motion::corners(K::N16),
        "field any" => Motion::corners(K::ANY),
        "field between" => Motion::centers(K::ANY),
        _ => n8(),
    };
    let space = map(SIDE).space(motion).expect("a space");
    if name != "field repair" {
        return Box::new(move || done(space.field([(0, 0)])));
    }
    let field = space.field([(0, 0)]).expect("a field");
    let change = change(&space);
    Box::new(move || done(field.repair(&change)))
}

fn on_numbers(name: &str) -> Work {
    let map = map(SIDE);
    let heights = (0..SIDE * SIDE).map(|cell| f64::from(cell % 17));
    match name {
        "costs" => Box::new(move || done(map.costs((0..SIDE * SIDE).map(|cell| f64::from(1 + cell % 7))))),
        "costs by" => {
            let cost = |x: u32, y: u32| f64::from(1 + (x + y) % 5);
            Box::new(move || done(map.costs_by((1.0, 1.0), Limits::new(), cost)))
        }
        "costs field" => {
            let space = costs(&map).space(n8()).expect("a space");
            Box::new(move || done(space.field([(0, 0)])))
        }
        "walking" => Box::new(move || done(map.walking(heights, (10.0, 10.0), &Pace::Tobler))),
        "walking field" => {
            let walking = map.walking(heights, (10.0, 10.0), &Pace::Tobler).expect("elevations");
            let space = walking.space(n8()).expect("a space");
            Box::new(move || done(space.field([(0, 0)])))
        }
        _ => panic!("{name}"),
    }
}
