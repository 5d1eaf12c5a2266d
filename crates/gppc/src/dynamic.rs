//! The dynamic track: shortest paths over eight directions, corners never cut, on a map that changes between
//! queries.
//!
//! The harness charges the time of its calls, and a change to the query after it. So the engine is one that
//! prepares next to nothing and whose preparation follows an edit: block-based JPS. Its dead ends make
//! queries quicker and changes slower. They pay where many queries come between two changes: so it has them
//! until it sees that few do.

#![allow(unsafe_code, reason = "functions of C")]

use std::{
    ffi::{c_char, c_void},
    panic::{AssertUnwindSafe, catch_unwind},
    ptr, slice,
};

use mediant::{Change, Engine, Error, Index, Map, Motion, Planner, Rectangle, Space};

/// A cell.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Point {
    /// The column.
    pub x: u16,
    /// The row.
    pub y: u16,
}

/// A rectangle of cells: bits row by row without padding, 1 = free.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Patch {
    /// The bits, the least significant one of a byte first.
    pub bits: *const u8,
    /// The number of columns.
    pub width: u16,
    /// The number of rows.
    pub height: u16,
    /// The place of its first cell on the map.
    pub at: Point,
}

/// A path, whose points stay the entry's.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PathPoints {
    /// The points.
    pub points: *const Point,
    /// Their number; 0 is no path.
    pub length: u32,
    /// Whether the harness is to ask again from the last point on.
    pub incomplete: u8,
}

/// The state of the entry for a map.
struct Entry {
    /// The map, which the harness changes.
    map: Patch,
    index: Index,
    planner: Planner,
    /// Whether the index has dead ends.
    has_dead_ends: bool,
    /// The number of queries and of changes so far.
    queries: u64,
    changes: u64,
    /// The last path.
    points: Vec<Point>,
}

/// With so many queries a change, dead ends save about as many instructions as they cost: 75 on a map of 281
/// × 209 cells with small changes, 28 on one of 1024 × 1024 cells with large ones.
const QUERIES_A_CHANGE: u64 = 60;

impl Patch {
    /// Whether the cell with a number is blocked.
    ///
    /// # Safety
    /// The bits are those of the whole rectangle, and the number is that of a cell.
    unsafe fn is_blocked(self, cell: usize) -> bool {
        // SAFETY: the caller promises it.
        unsafe { self.bits.add(cell / 8).read() >> (cell % 8) & 1 == 0 }
    }
}

impl Entry {
    /// # Safety
    /// The bits of the map stay until the entry is dropped.
    unsafe fn new(map: Patch) -> Result<Self, Error> {
        let (width, height) = (u32::from(map.width), u32::from(map.height));
        // SAFETY: the function asks for cells of the map alone.
        let is_blocked = |x: u32, y: u32| unsafe { map.is_blocked(y as usize * width as usize + x as usize) };
        let space = Map::from_fn(width, height, is_blocked)?.space(Motion::default())?;
        let index = space.prepare(Engine::JpsBlock)?;
        let planner = index.try_planner()?;
        Ok(Self { map, index, planner, has_dead_ends: true, queries: 0, changes: 0, points: Vec::new() })
    }

    /// Follows changes, which the map has already.
    fn change(&mut self, changes: &[Patch]) -> Result<(), Error> {
        let space: &Space = self.index.space();
        let (map, width) = (self.map, usize::from(self.map.width));
        // SAFETY: the library asks for cells of the map alone.
        let is_blocked = |x: u32, y: u32| unsafe { map.is_blocked(y as usize * width + x as usize) };
        let mut change = Change::new(space);
        for patch in changes {
            let (x, y) = (u32::from(patch.at.x), u32::from(patch.at.y));
            let area = Rectangle::new(x, y, u32::from(patch.width), u32::from(patch.height));
            change = change.edit(area, is_blocked)?;
        }
        self.changes += 1;
        let should_have_dead_ends = self.queries >= QUERIES_A_CHANGE * self.changes;
        self.index = match (self.has_dead_ends, should_have_dead_ends) {
            (true, false) => change.after().prepare_for_one_path(Engine::JpsBlock)?,
            (false, true) => change.after().prepare(Engine::JpsBlock)?,
            _ => self.index.repair(&change)?,
        };
        self.has_dead_ends = should_have_dead_ends;
        self.planner.follow(&self.index)
    }

    fn path(&mut self, start: Point, goal: Point) -> PathPoints {
        self.queries += 1;
        self.points.clear();
        let ends = [start, goal].map(|at| (i32::from(at.x), i32::from(at.y)));
        // An end that is blocked has no path.
        if let Ok(Some(path)) = self.planner.path(ends[0], ends[1]) {
            self.points.extend(path.waypoints().iter().map(|at| Point { x: at.x as u16, y: at.y as u16 }));
            // A path from a cell to itself is that cell, twice.
            if let [only] = self.points[..] {
                self.points.push(only);
            }
        }
        PathPoints { points: self.points.as_ptr(), length: self.points.len() as u32, incomplete: 0 }
    }
}

/// Nothing is prepared beforehand.
#[unsafe(no_mangle)]
pub extern "C" fn gppc_preprocess_init_map(_map: Patch, _file: *const c_char) {}

/// The entry for a map.
///
/// # Safety
/// The map is whole, and its bits stay until `gppc_free_data`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gppc_search_init(map: Patch, _file: *const c_char) -> *mut c_void {
    // SAFETY: the caller promises it.
    let made = catch_unwind(|| unsafe { Entry::new(map) });
    match made {
        Ok(Ok(entry)) => Box::into_raw(Box::new(entry)).cast(),
        _ => ptr::null_mut(),
    }
}

/// Follows changes of the map, which has them already.
///
/// # Safety
/// `data` is what `gppc_search_init` returned; `changes` leads to `count` patches.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gppc_map_change(data: *mut c_void, changes: *const Patch, count: u32) {
    if data.is_null() || changes.is_null() {
        return;
    }
    // SAFETY: the caller promises it.
    let (entry, changes) =
        unsafe { (&mut *data.cast::<Entry>(), slice::from_raw_parts(changes, count as usize)) };
    // A change that cannot be followed makes all anew.
    if !matches!(catch_unwind(AssertUnwindSafe(|| entry.change(changes))), Ok(Ok(()))) {
        // SAFETY: as above.
        if let Ok(Ok(anew)) = catch_unwind(|| unsafe { Entry::new(entry.map) }) {
            *entry = anew;
        }
    }
}

/// The path from a start to a goal. Its points stay until the next call.
///
/// # Safety
/// `data` is what `gppc_search_init` returned.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gppc_get_path(data: *mut c_void, start: Point, goal: Point) -> PathPoints {
    const NONE: PathPoints = PathPoints { points: ptr::null(), length: 0, incomplete: 0 };
    if data.is_null() {
        return NONE;
    }
    // SAFETY: the caller promises it.
    let entry = unsafe { &mut *data.cast::<Entry>() };
    catch_unwind(AssertUnwindSafe(|| entry.path(start, goal))).unwrap_or(NONE)
}

/// Frees the entry.
///
/// # Safety
/// `data` is what `gppc_search_init` returned, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gppc_free_data(data: *mut c_void) {
    if !data.is_null() {
        // SAFETY: the caller promises it.
        drop(unsafe { Box::from_raw(data.cast::<Entry>()) });
    }
}

/// The name of the entry.
#[unsafe(no_mangle)]
pub extern "C" fn gppc_get_name() -> *const c_char {
    c"Mediant".as_ptr()
}
