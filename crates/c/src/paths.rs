//! Paths that are there already, and paths of a single question.

#![allow(unsafe_code, reason = "functions of C")]

use std::ffi::c_char;

use library::{Demand, PlacementKind, Rules, Space, Vertex, errors::SpacingError};

use crate::{
    batch::{Batch, BatchHandle},
    code::Code,
    failure::{Failure, call},
    handles::Held,
    index::static_name,
    memory,
    points::{self, Cell, Point},
    space::SpaceHandle,
    watch::{Watch, Watcher},
    words,
};

/// A path of a single question, without an index, by the engine that is best for one path: as a batch with
/// this path alone, so that however many points it has, it is found once.
///
/// # Safety
/// `watcher` is null or leads to one; `path` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_space_path(
    space: SpaceHandle,
    start: Point,
    goal: Point,
    watcher: *const Watcher,
    path: *mut BatchHandle,
) -> Code {
    call(|| {
        memory::check_place("path", path)?;
        let space = Space::handles().get(space.id)?;
        // SAFETY: the caller promises it.
        let watch = unsafe { Watch::read(watcher) }?;
        let found = space.within(words::limits(&watch)).path(start.inner("start")?, goal.inner("goal")?);
        let found = found.map_err(|error| watch.failure(error))?;
        // SAFETY: as above.
        unsafe { BatchHandle::put(Batch::of_one(found.as_ref()), ("path", path)) }
    })
}

/// The path that keeps as far off obstacles as one can that is at most so much longer than the shortest: 0.2
/// is a fifth. As a batch with this path alone, as `mediant_space_path`; and its least distance to obstacles,
/// in cells, NaN where there is no path.
///
/// # Safety
/// As for `mediant_space_path`; `radius` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_space_widest_path(
    space: SpaceHandle,
    start: Cell,
    goal: Cell,
    surplus: f64,
    watcher: *const Watcher,
    path: *mut BatchHandle,
    radius: *mut f64,
) -> Code {
    call(|| {
        memory::check_place("path", path)?;
        memory::check_place("radius", radius)?;
        let space = Space::handles().get(space.id)?;
        // SAFETY: the caller promises it.
        let watch = unsafe { Watch::read(watcher) }?;
        let widest = space.within(words::limits(&watch)).widest_path(start, goal, surplus);
        let widest = widest.map_err(|error| watch.failure(error))?;
        let found = Batch::of_one(widest.as_ref().map(|widest| &widest.path));
        // SAFETY: as above.
        unsafe {
            BatchHandle::put(found, ("path", path))?;
            memory::put("radius", radius, widest.as_ref().map_or(f64::NAN, |widest| widest.radius))
        }
    })
}

/// The name of the engine that is best for so many paths in this space, and a sentence that says why.
///
/// # Safety
/// `engine` leads to memory for a pointer; `why` to `room` bytes, `length` to a number's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_space_engine(
    space: SpaceHandle,
    paths: u64,
    engine: *mut *const c_char,
    why: *mut c_char,
    room: usize,
    length: *mut usize,
) -> Code {
    call(|| {
        memory::check_place("engine", engine)?;
        let choice = Space::handles().get(space.id)?.engine_for(Demand::Paths(paths))?;
        // SAFETY: the caller promises it.
        unsafe {
            memory::put_text("why", (why, room), choice.why, length)?;
            memory::put("engine", engine, static_name(choice.engine)?)
        }
    })
}

/// Every vertex on a path, where its points are the turns alone: as many as there is room for, and how many
/// there are. A path with points between vertices has none.
///
/// # Safety
/// `points` leads to `count` points, `vertices` to memory for `room` cells, `total` to a number's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_path_vertices(
    points: *const Point,
    count: usize,
    vertices: *mut Cell,
    room: usize,
    total: *mut usize,
) -> Code {
    call(|| {
        // SAFETY: the caller promises it.
        let path = unsafe { points::path(points, count) }?;
        // SAFETY: as above.
        unsafe { write_cells(("vertices", vertices, room), || path.vertices().map(Cell::from), total) }
    })
}

/// The cells that a path touches in a space, with blocked ones beside it and ones outside the map: as many as
/// there is room for, and how many there are.
///
/// # Safety
/// As for `mediant_path_vertices`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_path_touched_cells(
    space: SpaceHandle,
    points: *const Point,
    count: usize,
    cells: *mut Cell,
    room: usize,
    total: *mut usize,
) -> Code {
    call(|| {
        let rules = Space::handles().get(space.id)?.motion().rules;
        // SAFETY: the caller promises it.
        let path = unsafe { points::path(points, count) }?;
        let (path, placement) = match rules {
            Rules::CenterGap(_) => (path.at_corners(), PlacementKind::Corner),
            _ => (path, rules.placement()),
        };
        let touched = || path.touched_cells(placement).map(|cell| Cell::from(Vertex::from(cell)));
        // SAFETY: as above.
        unsafe { write_cells(("cells", cells, room), touched, total) }
    })
}

/// Points on a path, evenly spaced by so many cells, and its last one: as many as there is room for, and how
/// many there are.
///
/// # Safety
/// `points` leads to `count` points, `spaced` to memory for `room` points, `total` to a number's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_path_spaced(
    points: *const Point,
    count: usize,
    spacing: f64,
    spaced: *mut Point,
    room: usize,
    total: *mut usize,
) -> Code {
    call(|| {
        memory::check_place("total", total)?;
        // SAFETY: the caller promises it.
        let path = unsafe { points::path(points, count) }?;
        let wrong = |error: SpacingError| Failure { code: Code::Number, text: error.to_string() };
        let all = || Ok::<_, Failure>(path.spaced(spacing).map_err(wrong)?.map(|(x, y)| Point { x, y }));
        // All are counted: not for ever.
        if path.length() / spacing > f64::from(u32::MAX) {
            let text = format!("points {spacing} cells apart are more than {} on this path", u32::MAX);
            return Err(Failure { code: Code::Number, text });
        }
        let number = all()?.count();
        // SAFETY: as above.
        unsafe {
            memory::fill("spaced", spaced, room, all()?)?;
            memory::put("total", total, number)
        }
    })
}

/// Writes cells, and how many there are.
///
/// # Safety
/// As for [`memory::fill`] and [`memory::put`].
unsafe fn write_cells<I: Iterator<Item = Cell>>(
    (name, cells, room): (&str, *mut Cell, usize),
    all: impl Fn() -> I,
    total: *mut usize,
) -> Result<(), Failure> {
    memory::check_place("total", total)?;
    // SAFETY: the caller promises it.
    unsafe {
        memory::fill(name, cells, room, all())?;
        memory::put("total", total, all().count())
    }
}
