//! Calls of spaces, and of paths that are there.

use std::{
    ffi::{CStr, c_char},
    ptr,
};

use library::{CornerRule, DiagonalGap, K, Motion, Path, PlacementKind, Rules};

use super::{
    ask,
    model::{End, SpaceModel, inner_of, is_near, length},
    world::World,
};
use crate::{
    batch::{BatchHandle, Paths, mediant_batch_free, mediant_batch_paths},
    code::Code,
    map::MapHandle,
    paths::{
        mediant_path_spaced, mediant_path_touched_cells, mediant_path_vertices, mediant_space_engine,
        mediant_space_path, mediant_space_widest_path,
    },
    points::{Cell, Point},
    space::{
        SpaceHandle, mediant_space_check, mediant_space_connected, mediant_space_is_free, mediant_space_new,
        mediant_space_sees,
    },
};

/// Motions that there are. [`motion`] says what each is.
pub(super) const MOTIONS: [&str; 14] = [
    "",
    "k=3",
    "neighbors=4",
    "k=4 corners=one",
    "  k=2\tcorners=always\n",
    "k=3 placement=corner",
    "k=4 gap=closed",
    "k=5 gap=open",
    "k=any",
    "k=any gap=closed",
    "k=any gap=open",
    "k=any placement=center",
    "k=any placement=center gap=open",
    "k=2 k=3 placement=center",
];

/// The motion of a text.
pub(super) fn motion(which: usize) -> Motion {
    let center = |k: u32, rule| Motion::new(k, Rules::Center(rule));
    let corner = |k: u32, gap| Motion::new(k, Rules::Corner(gap));
    match which {
        0 | 1 | 13 => center(3, CornerRule::Never),
        2 => center(2, CornerRule::Never),
        3 => center(4, CornerRule::One),
        4 => center(2, CornerRule::Always),
        5 => corner(3, DiagonalGap::Open),
        6 => corner(4, DiagonalGap::Closed),
        7 => corner(5, DiagonalGap::Open),
        9 => Motion::new(K::Any, Rules::Corner(DiagonalGap::Closed)),
        11 => Motion::new(K::Any, Rules::CenterGap(DiagonalGap::Closed)),
        12 => Motion::new(K::Any, Rules::CenterGap(DiagonalGap::Open)),
        _ => Motion::new(K::Any, Rules::Corner(DiagonalGap::Open)),
    }
}

/// Texts that are no motion.
pub(super) const BAD_MOTIONS: [(&str, Code); 10] = [
    ("k=0", Code::K),
    ("k=1", Code::K),
    ("k=-3", Code::Argument),
    ("k=", Code::Argument),
    ("k=three", Code::Argument),
    ("k=3 neighbors=8", Code::Argument),
    ("corners=never gap=open", Code::Argument),
    ("placement=middle", Code::UnknownName),
    ("engine=astar", Code::Argument),
    ("k=any placement=center corners=one", Code::Argument),
];

/// Makes a space.
pub(super) fn make(world: &mut World) {
    let (id, map) = world.handle(|world| &world.maps);
    let (words, which) = world.words(&MOTIONS, &BAD_MOTIONS);
    let is_null = world.rng.below(20) == 0 && which == Some(0);
    let place = world.place();
    if map.as_ref().is_some_and(|map| map.costs.is_some()) {
        world.maybe(&[Code::Cost, Code::Motion, Code::EngineK]);
    }
    let at = if is_null { ptr::null() } else { words.as_ptr() };
    let code = ask!(mediant_space_new(MapHandle { id }, at, place.at));
    if world.ended("space_new", code) {
        let model = SpaceModel::new(map.expect("right"), motion(which.expect("right")), &mut world.rng);
        world.spaces.add(place.values()[0].id, model);
    }
}

/// Any call of a space.
pub(super) fn any(world: &mut World) {
    match world.rng.below(10) {
        0..3 => between(world),
        3 => check(world),
        4..6 => path(world),
        6 => widest_path(world),
        7 => engine(world),
        8 => path_vertices(world),
        _ => path_spaced(world),
    }
}

/// Questions whose answer is yes or no.
fn between(world: &mut World) {
    let (id, space) = world.handle(|world| &world.spaces);
    let space = space.as_deref();
    let handle = SpaceHandle { id };
    let (from, to) = (world.end(space, End::Other), world.end(space, End::Other));
    let place = world.place::<i32>();
    let (name, code) = match world.rng.below(3) {
        0 => {
            // The other point is not asked for.
            SpaceModel::known_wrong(to, End::Other).into_iter().for_each(|code| world.forgive(code));
            ("space_is_free", ask!(mediant_space_is_free(handle, from, place.at)))
        }
        1 => ("space_connected", ask!(mediant_space_connected(handle, from, to, place.at))),
        _ => ("space_sees", ask!(mediant_space_sees(handle, from, to, place.at))),
    };
    if world.ended(name, code) {
        let (space, found) = (space.expect("right"), place.values()[0] == 1);
        let cost = || space.cost(from, to);
        let expected = match name {
            "space_is_free" => space.is_free(inner_of(from)),
            "space_connected" => cost().is_some(),
            _ if space.motion.k == K::Any => space.is_segment(inner_of(from), inner_of(to)),
            _ => return,
        };
        assert_eq!(found, expected, "{name} {from:?} {to:?} {}\n{:?}", space.motion, space.map);
    }
}

fn check(world: &mut World) {
    let (id, space) = world.handle(|world| &world.spaces);
    let points: Vec<Point> =
        (0..world.rng.below(4)).map(|_| world.end(space.as_deref(), End::Other)).collect();
    let array = world.values(&points);
    world.maybe(&[Code::BrokenPath]);
    let code = ask!(mediant_space_check(SpaceHandle { id }, array.at, array.count));
    if world.ended("space_check", code) {
        let space = space.expect("right");
        let distinct = points.windows(2).all(|pair| inner_of(pair[0]) != inner_of(pair[1]));
        let inner: Vec<Point> = points.iter().map(|&at| inner_of(at).into()).collect();
        if space.motion.k == K::Any && distinct && inner.first() != inner.last() {
            space.check(&inner, (inner[0], inner[inner.len() - 1]), length(&inner), false);
        }
    }
}

/// A batch with a path alone, which is freed.
fn only_path(batch: BatchHandle) -> (Vec<Point>, f64) {
    let mut paths = super::draw::untouched::<Paths>();
    assert_eq!(ask!(mediant_batch_paths(batch, &raw mut paths)), Code::Ok);
    assert_eq!(paths.count, 1, "a batch of one");
    // SAFETY: the arrays of a batch have as many values as it says.
    let found = unsafe {
        assert_eq!([*paths.firsts, u64::from(*paths.codes != 0) as usize], [0, 0]);
        let count = *paths.firsts.add(1);
        ((0..count).map(|at| *paths.points.add(at)).collect(), *paths.lengths)
    };
    assert_eq!(mediant_batch_free(batch), Code::Ok);
    found
}

fn path(world: &mut World) {
    let (id, space) = world.handle(|world| &world.spaces);
    let (from, to) = (world.end(space.as_deref(), End::Start), world.end(space.as_deref(), End::Goal));
    let watcher = world.watcher(0);
    let place = world.place();
    if space.as_ref().is_some_and(|space| space.map.costs.is_some()) {
        world.maybe(&[Code::Motion, Code::EngineK, Code::EngineRules]);
    }
    let code = ask!(mediant_space_path(SpaceHandle { id }, from, to, watcher.at, place.at));
    watcher.caller.check();
    if world.ended("space_path", code) {
        let (points, cost) = only_path(place.values()[0]);
        let space = space.expect("right");
        let expected = space.cost(from, to).unwrap_or(f64::INFINITY);
        assert!(
            is_near(cost, expected),
            "{cost}, not {expected}: {from:?} {to:?} {}\n{:?}",
            space.motion,
            space.map
        );
        if !points.is_empty() {
            let told = if space.map.costs.is_some() { length(&points) } else { cost };
            space.check(&points, (from, to), told, true);
        }
    }
}

fn widest_path(world: &mut World) {
    let (id, space) = world.handle(|world| &world.spaces);
    let size = space.as_ref().map_or((4, 4), |space| space.map.size);
    let (from, to) = (world.cell(size), world.cell(size));
    let surplus = [0.0, 0.2, 1.0, 1e300, -0.5, f64::NAN][world.rng.below(6) as usize];
    let point = |at: Cell| Point { x: at.x.into(), y: at.y.into() };
    if space.as_ref().is_some_and(|space| space.map.costs.is_some()) {
        world.maybe(&[
            Code::Motion,
            Code::EngineK,
            Code::EngineRules,
            Code::EngineOption,
            Code::EngineWithout,
        ]);
    }
    world.maybe(&[Code::Cost]);
    if surplus.is_nan() || surplus < 0.0 {
        world.wrong(Code::Number);
    }
    world.note_end(space.as_deref(), point(from), End::Start);
    world.note_end(space.as_deref(), point(to), End::Goal);
    let watcher = world.watcher(0);
    let (place, radius) = (world.place(), world.place::<f64>());
    let code = ask!(mediant_space_widest_path(
        SpaceHandle { id },
        from,
        to,
        surplus,
        watcher.at,
        place.at,
        radius.at
    ));
    watcher.caller.check();
    if world.ended("space_widest_path", code) {
        let (points, cost) = only_path(place.values()[0]);
        let (space, radius) = (space.expect("right"), radius.values()[0]);
        let shortest = space.cost(point(from), point(to));
        let case = || format!("{cost}, {points:?}: {from:?} {to:?} {}\n{:?}", space.motion, space.map);
        assert_eq!(
            (points.is_empty(), radius.is_nan(), cost.is_infinite()),
            match shortest {
                Some(_) => (false, false, false),
                None => (true, true, true),
            },
            "{}",
            case()
        );
        if let Some(shortest) = shortest {
            assert!(cost <= shortest * (1.0 + surplus) + 1e-9, "{shortest}: {}", case());
            space.check(&points, (point(from), point(to)), cost, false);
        }
    }
}

fn engine(world: &mut World) {
    let (id, space) = world.handle(|world| &world.spaces);
    let paths = [0, 1, 10, u64::MAX][world.rng.below(4) as usize];
    let (engine, why, length) =
        (world.place::<*const c_char>(), world.room::<u8>(300), world.place::<usize>());
    if space.is_some_and(|space| space.map.costs.is_some()) {
        world.maybe(&[Code::Motion, Code::EngineK, Code::EngineRules, Code::Cost]);
    }
    let code =
        ask!(mediant_space_engine(SpaceHandle { id }, paths, engine.at, why.at.cast(), why.count, length.at));
    if world.ended("space_engine", code) {
        // SAFETY: it is a text that stays for ever.
        let name = unsafe { CStr::from_ptr(engine.values()[0]) }.to_str().expect("UTF-8");
        assert!(name.parse::<library::Engine>().is_ok(), "the engine {name}");
        let (text, length) = (why.values(), length.values()[0]);
        if let Some(end) = text.len().checked_sub(1) {
            assert_eq!(
                text.iter().position(|&letter| letter == 0),
                Some(length.min(end)),
                "{text:?} of {length}"
            );
        }
    }
}

/// Points of a path that need not hold.
fn points(world: &mut World) -> Vec<Point> {
    let space = world.spaces.first();
    (0..world.rng.below(5)).map(|_| world.end(space.as_deref(), End::Other)).collect()
}

fn path_vertices(world: &mut World) {
    let (id, space) = world.handle(|world| &world.spaces);
    let points = points(world);
    // Some lead across all numbers that there are.
    let far = |at: &Point| at.x.abs() > 100.0 || at.y.abs() > 100.0;
    if points.iter().any(far) {
        world.handled();
        return;
    }
    let (array, cells, total) = (world.values(&points), world.room::<Cell>(40), world.place::<usize>());
    let is_touched = world.rng.chance(50);
    let (name, code) = if is_touched {
        let code = ask!(mediant_path_touched_cells(
            SpaceHandle { id },
            array.at,
            array.count,
            cells.at,
            cells.count,
            total.at
        ));
        ("path_touched_cells", code)
    } else {
        if space.is_none() {
            world.forgive(Code::Handle);
        }
        ("path_vertices", ask!(mediant_path_vertices(array.at, array.count, cells.at, cells.count, total.at)))
    };
    if world.ended(name, code) {
        let path = Path::through(points.iter().map(|&at| inner_of(at)));
        let vertices: Vec<Cell> = path.vertices().map(Cell::from).collect();
        let found = cells.values();
        let count = total.values()[0];
        if is_touched {
            // Of a path over vertices the cells of these are among those that it touches.
            let space = space.expect("right");
            if space.rules().placement() == PlacementKind::Center && found.len() >= count {
                assert!(vertices.iter().all(|at| found[..count].contains(at)), "{found:?} of {points:?}");
            }
        } else {
            assert_eq!(count, vertices.len(), "path_vertices {points:?}");
            assert!(found.iter().zip(&vertices).all(|(found, at)| found == at), "path_vertices {points:?}");
        }
    }
}

fn path_spaced(world: &mut World) {
    let points = points(world);
    let spacing = [0.5, 1.0, 3.7, 1e300, 0.0, -1.0, f64::NAN, 1e-300][world.rng.below(8) as usize];
    let inner: Vec<Point> = points
        .iter()
        .filter(|at| SpaceModel::known_wrong(**at, End::Other).is_empty())
        .map(|&at| inner_of(at).into())
        .collect();
    let whole = length(&inner);
    if whole / spacing > 1e6 && whole / spacing < f64::from(u32::MAX) {
        world.handled();
        return;
    }
    if spacing.is_nan() || spacing <= 0.0 || whole / spacing > f64::from(u32::MAX) {
        world.wrong(Code::Number);
    }
    let (array, spaced, total) = (world.values(&points), world.room::<Point>(40), world.place::<usize>());
    let code = ask!(mediant_path_spaced(array.at, array.count, spacing, spaced.at, spaced.count, total.at));
    if world.ended("path_spaced", code) {
        let (found, count) = (spaced.values(), total.values()[0]);
        let expected = if inner.is_empty() { 0 } else { (whole / spacing) as usize + 1 };
        // Its last point, unless one that is spaced is there.
        assert!((expected..=expected + 1).contains(&count), "{count} points, {whole} by {spacing}");
        if let (Some(first), Some(last), true) = (inner.first(), inner.last(), found.len() >= count) {
            assert!(
                found[0] == *first && length(&[found[count - 1], *last]) < 1e-9,
                "{found:?} of {inner:?}"
            );
        }
    }
}
