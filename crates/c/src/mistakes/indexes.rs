//! Calls of indexes, of bytes, of goals and of many paths.

use std::{env, fs, ptr, rc::Rc};

use library::{Setup, errors::TextError};

use super::{
    ask,
    draw::untouched,
    model::{BytesModel, End, GoalsModel, IndexModel, MapModel, SpaceModel},
    world::World,
};
use crate::{
    batch::{BatchHandle, Paths, mediant_batch_paths, mediant_index_paths},
    bytes::{BytesHandle, mediant_bytes_data},
    code::Code,
    goals::{mediant_goals_new, mediant_index_table},
    index::{
        IndexHandle, mediant_index_bound, mediant_index_finish, mediant_index_from_bytes,
        mediant_index_is_finished, mediant_index_load, mediant_index_memory, mediant_index_prepare,
        mediant_index_repair, mediant_index_save, mediant_index_setup, mediant_index_space,
    },
    map::MapHandle,
    points::{Ends, Point},
    space::SpaceHandle,
};

/// Engines with options. Not every one takes every motion.
const ENGINES: [&str; 24] = [
    "",
    "engine=auto",
    "engine=astar",
    "engine=astar heuristic=zero",
    "engine=dijkstra",
    "engine=wavefront",
    "engine=canonical",
    "engine=jps",
    "engine=jps-block",
    "engine=jps-plus",
    "engine=theta",
    "engine=lazy-theta",
    "engine=anya",
    "engine=subgoal",
    "engine=subgoal levels=1",
    "engine=subgoal levels=all",
    "engine=subgoal levels=contracted",
    "engine=subgoal levels=labels memory=1MB",
    "engine=subgoal smooth=taut",
    "engine=subgoal-theta",
    "engine=hpa side=3 levels=2",
    "engine=chpa side=2",
    "engine=landmarks landmarks=4",
    "engine=astar smooth=linear",
];

const BAD: [(&str, Code); 8] = [
    ("engine=none", Code::UnknownName),
    ("engine=", Code::UnknownName),
    ("engine=astar side=3", Code::EngineOption),
    ("engine=hpa side=0", Code::IndexRange),
    ("engine=subgoal memory=much", Code::Argument),
    ("engine=landmarks landmarks=0", Code::IndexRange),
    ("nearest", Code::Argument),
    ("smooth=silk", Code::UnknownName),
];

/// Codes of an engine for a motion that it does not take, or a map with costs.
const UNFIT: [Code; 9] = [
    Code::EngineK,
    Code::EngineRules,
    Code::EngineOption,
    Code::EngineWithout,
    Code::Motion,
    Code::Cost,
    Code::IndexRange,
    Code::IndexOptions,
    Code::Argument,
];

/// The setup of an index.
fn setup(index: IndexHandle) -> Setup {
    let (mut text, mut length) = (vec![0_u8; 400], 0);
    let code = ask!(mediant_index_setup(index, text.as_mut_ptr().cast(), text.len(), &raw mut length));
    assert_eq!(code, Code::Ok);
    let text = String::from_utf8(text[..length].to_vec()).expect("UTF-8");
    text.parse().unwrap_or_else(|error: TextError| panic!("{text}: {error}"))
}

impl World {
    /// An index that a call made, if it did.
    fn made_index(
        &mut self,
        name: &str,
        code: Code,
        index: &[IndexHandle],
        space: impl FnOnce() -> Rc<SpaceModel>,
    ) {
        if self.ended(name, code) {
            let (handle, space) = (index[0], space());
            let setup = setup(handle);
            assert_eq!((setup.k(), setup.rules()), (space.motion.k, space.motion.rules), "{name}: {setup}");
            self.indexes.add(handle.id, IndexModel { space, setup });
        }
    }
}

/// Prepares an index.
pub(super) fn prepare(world: &mut World) {
    let (id, space) = world.handle(|world| &world.spaces);
    let (words, which) = world.words(&ENGINES, &BAD);
    let is_null = which == Some(0) && world.rng.chance(50);
    let watcher = world.watcher(0);
    let place = world.place();
    // The best one for a map without costs is always there, and so are those that search every finite k.
    let is_plain = space.as_ref().is_some_and(|space| space.map.costs.is_none());
    let is_finite = space.as_ref().is_some_and(|space| space.finite().is_some());
    if !(is_plain && matches!(which, Some(0 | 1)) || is_plain && is_finite && matches!(which, Some(2..=4))) {
        world.maybe(&UNFIT);
    }
    let at = if is_null { ptr::null() } else { words.as_ptr() };
    let code = ask!(mediant_index_prepare(SpaceHandle { id }, at, watcher.at, place.at));
    watcher.caller.check();
    world.made_index("index_prepare", code, &place.values(), || space.expect("right"));
}

/// Any call of an index.
pub(super) fn any(world: &mut World) {
    match world.rng.below(16) {
        0 | 1 => facts(world),
        2 => setup_text(world),
        3 | 4 => repair(world),
        5 => finish(world),
        6 => to_bytes(world),
        7 | 8 => from_bytes(world),
        9 => space(world),
        10 => save_and_load(world),
        11 | 12 => goals(world),
        13 => table(world),
        _ => paths(world),
    }
}

fn facts(world: &mut World) {
    let (id, index) = world.handle(|world| &world.indexes);
    let handle = IndexHandle { id };
    match world.rng.below(3) {
        0 => {
            let place = world.place::<i32>();
            let code = ask!(mediant_index_is_finished(handle, place.at));
            if world.ended("index_is_finished", code) {
                assert!([0, 1].contains(&place.values()[0]));
            }
        }
        1 => {
            let place = world.place::<u64>();
            let code = ask!(mediant_index_memory(handle, place.at));
            if world.ended("index_memory", code) {
                assert!(place.values()[0] < 1 << 30, "{} bytes", place.values()[0]);
            }
        }
        _ => {
            let place = world.place::<f64>();
            let code = ask!(mediant_index_bound(handle, place.at));
            if world.ended("index_bound", code) {
                let bound = place.values()[0];
                let is_any = index.is_some_and(|index| index.space.finite().is_none() && index.is_exact());
                assert!(if is_any { bound == 1.0 } else { bound.is_nan() || bound >= 1.0 }, "{bound}");
            }
        }
    }
}

fn setup_text(world: &mut World) {
    let (id, index) = world.handle(|world| &world.indexes);
    let (text, length) = (world.room::<u8>(60), world.place::<usize>());
    let code = ask!(mediant_index_setup(IndexHandle { id }, text.at.cast(), text.count, length.at));
    if world.ended("index_setup", code) {
        let expected = index.expect("right").setup.to_string();
        assert_eq!(length.values()[0], expected.len(), "{expected}");
        if let Some(end) = text.values().iter().position(|&letter| letter == 0) {
            assert_eq!(&text.values()[..end], &expected.as_bytes()[..end], "{expected}");
        } else {
            assert_eq!(text.count, 0, "a text without an end");
        }
    }
}

/// Codes of work that follows an edit.
const REPAIR: [Code; 5] =
    [Code::Mismatch, Code::EngineWithout, Code::IndexRange, Code::Cost, Code::EngineOption];

fn repair(world: &mut World) {
    let (id, index) = world.handle(|world| &world.indexes);
    let (other, space) = world.handle(|world| &world.spaces);
    let place = world.place();
    if let (Some(index), Some(space)) = (&index, &space) {
        if index.space.motion != space.motion {
            world.wrong(Code::Mismatch);
        }
        if index.space.map.costs.is_some() != space.map.costs.is_some() {
            world.maybe(&REPAIR);
        }
    }
    let code = ask!(mediant_index_repair(IndexHandle { id }, SpaceHandle { id: other }, place.at));
    world.made_index("index_repair", code, &place.values(), || space.expect("right"));
}

fn finish(world: &mut World) {
    let (id, index) = world.handle(|world| &world.indexes);
    let watcher = world.watcher(0);
    let place = world.place();
    let code = ask!(mediant_index_finish(IndexHandle { id }, watcher.at, place.at));
    watcher.caller.check();
    let made = place.values();
    world.made_index("index_finish", code, &made, || index.expect("right").space.clone());
    if code == Code::Ok {
        let mut is = -1;
        assert_eq!((ask!(mediant_index_is_finished(made[0], &raw mut is)), is), (Code::Ok, 1));
    }
}

fn to_bytes(world: &mut World) {
    let (id, index) = world.handle(|world| &world.indexes);
    let place = world.place::<BytesHandle>();
    world.maybe(&[Code::EngineWithout]);
    let code = ask!(crate::index::mediant_index_to_bytes(IndexHandle { id }, place.at));
    if world.ended("index_to_bytes", code) {
        let model = BytesModel { index: index.expect("right") };
        world.bytes.add(place.values()[0].id, model);
    }
    let (id, _) = world.handle(|world| &world.bytes);
    let (data, size) = (world.place::<*const u8>(), world.place::<usize>());
    let code = ask!(mediant_bytes_data(BytesHandle { id }, data.at, size.at));
    if world.ended("bytes_data", code) {
        assert!(!data.values()[0].is_null() && size.values()[0] > 16);
    } else {
        assert!(size.is_untouched());
    }
}

/// Codes of bytes that were changed.
const DAMAGED: [Code; 7] = [
    Code::IndexDamaged,
    Code::IndexEngine,
    Code::IndexOptions,
    Code::IndexRange,
    Code::Mismatch,
    Code::UnknownName,
    Code::EngineOption,
];

/// Options of indexes that were saved, for the engines that take them.
const OPTIONS: [&str; 5] = ["", " ", "smooth=linear", "smooth=taut", "heuristic=zero"];

/// Notes that an index is that of another map.
fn note_other(world: &mut World, map: Option<&MapModel>, index: &IndexModel) {
    if map.is_some_and(|map| *map != *index.space.map) {
        world.wrong(Code::Mismatch);
        // No index of this motion is of a map with costs, or without them.
        world.maybe(&[Code::Motion, Code::EngineK, Code::EngineRules, Code::EngineOption]);
    }
}

fn from_bytes(world: &mut World) {
    let (id, map) = world.handle(|world| &world.maps);
    let Some((of, model)) = world.bytes.any(&mut world.rng) else {
        world.handled();
        return;
    };
    let (mut data, mut size) = (ptr::null(), 0);
    assert_eq!(ask!(mediant_bytes_data(BytesHandle { id: of }, &raw mut data, &raw mut size)), Code::Ok);
    // SAFETY: bytes that are held stay, as many as they say.
    let mut bytes = unsafe { std::slice::from_raw_parts(data, size) }.to_vec();
    let damage = world.rng.below(4);
    match damage {
        0 => {
            let at = world.rng.below(size as u32) as usize;
            bytes[at] ^= 1 << world.rng.below(8);
        }
        1 => bytes.truncate(world.rng.below(size as u32) as usize),
        _ => {}
    }
    if damage < 2 {
        world.wrong(Code::IndexDamaged);
        world.maybe(&DAMAGED);
    }
    note_other(world, map.as_deref(), &model.index);
    let options = OPTIONS[world.rng.below(OPTIONS.len() as u32) as usize];
    let (_text, at) = world.text((!options.is_empty()).then_some(options));
    if options.trim().len() > 1 {
        world.maybe(&UNFIT);
    }
    let (array, place) = (world.values(&bytes), world.place());
    let code = ask!(mediant_index_from_bytes(MapHandle { id }, array.at, array.count, at, place.at));
    world.made_index("index_from_bytes", code, &place.values(), || model.index.space.clone());
}

fn space(world: &mut World) {
    let (id, index) = world.handle(|world| &world.indexes);
    let place = world.place();
    let code = ask!(mediant_index_space(IndexHandle { id }, place.at));
    if world.ended("index_space", code) {
        let space = index.expect("right").space.clone();
        world.spaces.add_same(place.values()[0].id, space);
    }
}

fn save_and_load(world: &mut World) {
    // Miri has no disk.
    if cfg!(miri) {
        return;
    }
    let (id, index) = world.handle(|world| &world.indexes);
    let file = env::temp_dir().join(format!("mediant-c-{}-{:x}.index", std::process::id(), id));
    let right = file.to_str().expect("UTF-8").to_owned();
    let path = [Some(&*right), Some("/none/at/all.index"), Some(""), None][world.rng.below(4) as usize];
    match path {
        None => world.wrong(Code::Argument),
        Some(path) if path != right => world.wrong(Code::FileUnwritable),
        Some(_) => {}
    }
    world.maybe(&[Code::EngineWithout]);
    let (_path, at) = world.text(path);
    let code = ask!(mediant_index_save(IndexHandle { id }, at));
    if !world.ended("index_save", code) {
        return;
    }
    let (map_id, map) = world.handle(|world| &world.maps);
    let index = index.expect("right");
    note_other(world, map.as_deref(), &index);
    let place = world.place();
    let code = ask!(mediant_index_load(MapHandle { id: map_id }, at, ptr::null(), place.at));
    world.made_index("index_load", code, &place.values(), || index.space.clone());
    fs::remove_file(file).expect("it was written");
}

fn goals(world: &mut World) {
    let (id, index) = world.handle(|world| &world.indexes);
    let space = index.map(|index| index.space.clone());
    let goals = world.ends(space.as_deref(), End::Goal);
    let (array, place) = (world.values(&goals), world.place());
    let code = ask!(mediant_goals_new(IndexHandle { id }, array.at, array.count, place.at));
    if world.ended("goals_new", code) {
        let model = GoalsModel { space: space.expect("right"), goals };
        world.goals.add(place.values()[0].id, model);
    }
}

fn table(world: &mut World) {
    let (id, index) = world.handle(|world| &world.indexes);
    let space = index.as_ref().map(|index| index.space.clone());
    let starts = world.ends(space.as_deref(), End::Start);
    let goals = world.ends(space.as_deref(), End::Goal);
    let (from, to, watcher) = (world.values(&starts), world.values(&goals), world.watcher(0));
    index.iter().for_each(|index| world.maybe(index.maybe()));
    // Its room is the product of the counts.
    let lengths = world.values(&vec![untouched::<f64>(); starts.len() * goals.len()]);
    if lengths.count != starts.len() * goals.len() {
        world.forgive(Code::Argument);
    }
    let code = ask!(mediant_index_table(
        IndexHandle { id },
        from.at,
        from.count,
        to.at,
        to.count,
        watcher.at,
        lengths.at
    ));
    watcher.caller.check();
    if world.ended("index_table", code) {
        let index = index.expect("right");
        let pairs = starts.iter().flat_map(|&start| goals.iter().map(move |&goal| (start, goal)));
        for (ends, cost) in pairs.zip(lengths.values()) {
            index.check_cost(&index.space, ends, cost);
        }
    }
}

fn paths(world: &mut World) {
    let (id, index) = world.handle(|world| &world.indexes);
    let space = index.as_ref().map(|index| index.space.clone());
    let count = if world.rng.below(40) == 0 { 600 } else { world.rng.below(6) };
    let any = |world: &mut World| world.point(space.as_deref());
    let ends: Vec<Ends> = (0..count).map(|_| Ends { start: any(world), goal: any(world) }).collect();
    let (array, watcher, place) = (world.values(&ends), world.watcher(0), world.place::<BatchHandle>());
    let threads = [0, 1, 1, 1, 2, usize::MAX][world.rng.below(6) as usize];
    let code =
        ask!(mediant_index_paths(IndexHandle { id }, array.at, array.count, threads, watcher.at, place.at));
    watcher.caller.check();
    if !world.ended("index_paths", code) {
        return;
    }
    let (index, batch) = (index.expect("right"), place.values()[0]);
    world.batches.add(batch.id, ());
    let mut paths = untouched::<Paths>();
    assert_eq!(ask!(mediant_batch_paths(batch, &raw mut paths)), Code::Ok);
    assert_eq!(paths.count, ends.len());
    for (query, ends) in ends.iter().enumerate() {
        // SAFETY: the arrays of a batch have as many values as it says.
        let (cost, code, points) = unsafe {
            let (first, after) = (*paths.firsts.add(query), *paths.firsts.add(query + 1));
            let points: Vec<Point> = (first..after).map(|at| *paths.points.add(at)).collect();
            (*paths.lengths.add(query), *paths.codes.add(query), points)
        };
        let start = index.space.wrong_end(ends.start, End::Start);
        let wrong: Vec<_> = start.into_iter().chain(index.space.wrong_end(ends.goal, End::Goal)).collect();
        if wrong.is_empty() && code == 0 {
            index.check_path(&index.space, (ends.start, ends.goal), &points, cost);
        } else {
            let known = || wrong.iter().chain(index.maybe()).any(|&known| known as i32 == code);
            assert!(known() && cost.is_nan() && points.is_empty(), "{code}, not {wrong:?}: {ends:?}");
        }
    }
    let (id, _) = world.handle(|world| &world.batches);
    let place = world.place::<Paths>();
    let code = ask!(mediant_batch_paths(BatchHandle { id }, place.at));
    world.ended("batch_paths", code);
}
