//! Maps.

#![allow(unsafe_code, reason = "functions of C")]

use std::{ffi::c_char, sync::Arc};

use library::{
    Ground, Map, Vertex,
    grid::{Fit, Grid, Outside},
};

use crate::{
    code::Code,
    failure::{Failure, call},
    handles::{Held, Kind, Table},
    memory,
    points::{Area, Cell},
    words,
};

/// A map: which cells are blocked, and what they cost. It never changes; any number of threads may use it.
/// `{0}` is no map.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MapHandle {
    /// Its number.
    pub id: u64,
}

impl Held for Ground {
    type Kept = Arc<Self>;

    fn handles() -> &'static Table<Arc<Self>> {
        static HANDLES: Table<Arc<Ground>> = Table::new(Kind::Map);
        &HANDLES
    }
}

impl MapHandle {
    /// Keeps a map, and writes its handle.
    ///
    /// # Safety
    /// As for [`memory::put`].
    pub(crate) unsafe fn put(ground: impl Into<Ground>, map: *mut Self) -> Result<(), Failure> {
        memory::check_place("map", map)?;
        let id = Ground::handles().share(ground.into())?;
        // SAFETY: the caller promises it.
        unsafe { memory::put("map", map, Self { id }) }
    }
}

/// Reads a map from a file: a `.map` of `MovingAI`, a picture (PNG, PGM), or the YAML of a ROS map.
///
/// # Safety
/// `path` is a text; `map` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_open(path: *const c_char, map: *mut MapHandle) -> Code {
    call(|| {
        // SAFETY: the caller promises it.
        let path = unsafe { memory::text("path", path) }?;
        let path = path.ok_or_else(|| Failure::argument("path", "it is null"))?;
        // SAFETY: as above.
        unsafe { MapHandle::put(Map::open(path)?, map) }
    })
}

/// Makes a map of rows of text, ended by line breaks: `.`, `G` and `S` are free, `@`, `O`, `T`, `W` and `#`
/// blocked.
///
/// # Safety
/// `rows` is a text; `map` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_parse(rows: *const c_char, map: *mut MapHandle) -> Code {
    call(|| {
        // SAFETY: the caller promises it.
        let rows = unsafe { memory::text("rows", rows) }?.unwrap_or_default();
        // SAFETY: as above.
        unsafe { MapHandle::put(rows.parse::<Map>()?, map) }
    })
}

/// Makes a map of bytes, row by row: 0 is free, all else blocked. Null is a map without obstacles.
///
/// # Safety
/// `blocked` is null or leads to `width` · `height` bytes; `map` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_new(
    width: u32,
    height: u32,
    blocked: *const u8,
    map: *mut MapHandle,
) -> Code {
    call(|| {
        Grid::check_size(width.into(), height.into())?;
        if blocked.is_null() {
            // SAFETY: the caller promises it.
            return unsafe { MapHandle::put(Map::new(width, height)?, map) };
        }
        // SAFETY: as above.
        let cells = unsafe { cells_of("blocked", (width, height), blocked) }?;
        let of = |x: u32, y: u32| cells[y as usize * width as usize + x as usize] != 0;
        // SAFETY: as above.
        unsafe { MapHandle::put(Map::from_fn(width, height, of)?, map) }
    })
}

/// Makes a map of bits, row by row without padding: bit i is in byte i / 8, the least significant one first;
/// 1 is free.
///
/// # Safety
/// `free` leads to (`width` · `height` + 7) / 8 bytes; `map` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_from_bits(
    width: u32,
    height: u32,
    free: *const u8,
    map: *mut MapHandle,
) -> Code {
    call(|| {
        // Before the memory is trusted to have so many.
        Grid::check_size(width.into(), height.into())?;
        let bytes = (u64::from(width) * u64::from(height)).div_ceil(8);
        let bytes = usize::try_from(bytes).unwrap_or(usize::MAX);
        // SAFETY: the caller promises it.
        let bits = unsafe { memory::array("free", free, bytes) }?;
        let is_blocked = |x: u32, y: u32| {
            let bit = y as usize * width as usize + x as usize;
            bits[bit / 8] >> (bit % 8) & 1 == 0
        };
        // SAFETY: as above.
        unsafe { MapHandle::put(Map::from_fn(width, height, is_blocked)?, map) }
    })
}

/// The bytes of a rectangle of cells.
///
/// # Safety
/// As for [`memory::array`].
pub(crate) unsafe fn cells_of<'a>(
    name: &str,
    (width, height): (u32, u32),
    cells: *const u8,
) -> Result<&'a [u8], Failure> {
    let count = u64::from(width) * u64::from(height);
    // SAFETY: the caller promises it.
    unsafe { memory::array(name, cells, usize::try_from(count).unwrap_or(usize::MAX)) }
}

/// Frees a map. What was made of it stays.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_map_free(map: MapHandle) -> Code {
    call(|| Ground::handles().free(map.id))
}

/// The numbers of columns and of rows.
///
/// # Safety
/// `width` and `height` lead to memory for a number each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_size(map: MapHandle, width: *mut u32, height: *mut u32) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        memory::check_place("height", height)?;
        // SAFETY: the caller promises it.
        unsafe {
            memory::put("width", width, ground.map().width())?;
            memory::put("height", height, ground.map().height())
        }
    })
}

/// Writes all cells, row by row: 0 is free, 1 blocked; as many as there is room for.
///
/// # Safety
/// `blocked` leads to memory for `room` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_cells(map: MapHandle, blocked: *mut u8, room: usize) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        let map = ground.map();
        let (width, height) = (map.width() as i32, map.height() as i32);
        let cells = (0..height).flat_map(|y| (0..width).map(move |x| Vertex::new(x, y)));
        // SAFETY: the caller promises it.
        unsafe { memory::fill("blocked", blocked, room, cells.map(|cell| u8::from(map.is_blocked(cell)))) }
    })
}

/// Whether a cell is blocked: 1 or 0. All outside the map is. Threads that ask one map wait for one another,
/// a tenth of a microsecond each time: for many cells `mediant_map_cells` has them all.
///
/// # Safety
/// `blocked` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_is_blocked(map: MapHandle, cell: Cell, blocked: *mut i32) -> Code {
    call(|| {
        let is_blocked = Ground::handles().get(map.id)?.map().is_blocked(cell);
        // SAFETY: the caller promises it.
        unsafe { memory::put("blocked", blocked, i32::from(is_blocked)) }
    })
}

/// This map with other cells in a rectangle: `blocked` has a byte for each of its cells, row by row, 0 for
/// free; those beyond the map are left out. The work follows the rectangle, and the maps share the rest.
///
/// # Safety
/// `blocked` leads to a byte for each cell of the area; `edited` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_edit(
    map: MapHandle,
    area: Area,
    blocked: *const u8,
    edited: *mut MapHandle,
) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        // Before the memory is trusted to have so many.
        if area.width.max(area.height) > Grid::MAX_SIDE {
            let wrong = format!(
                "{} × {} cells, and no map is longer than {}",
                area.width,
                area.height,
                Grid::MAX_SIDE
            );
            return Err(Failure::argument("area", &wrong));
        }
        // SAFETY: the caller promises it.
        let cells = unsafe { cells_of("blocked", (area.width, area.height), blocked) }?;
        let of = |x: u32, y: u32| {
            let (column, row) = ((x - area.x) as usize, (y - area.y) as usize);
            cells[row * area.width as usize + column] != 0
        };
        // SAFETY: as above.
        unsafe { MapHandle::put(ground.edit(area.into(), of)?, edited) }
    })
}

/// This map with other scattered cells: each is blocked where its byte is not 0, and else free.
///
/// # Safety
/// `cells` and `blocked` lead to `count` values each; `edited` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_edit_cells(
    map: MapHandle,
    cells: *const Cell,
    blocked: *const u8,
    count: usize,
    edited: *mut MapHandle,
) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        // SAFETY: the caller promises it.
        let (cells, blocked) =
            unsafe { (memory::array("cells", cells, count)?, memory::array("blocked", blocked, count)?) };
        let edits = cells.iter().zip(blocked).map(|(&cell, &blocked)| (cell, blocked != 0));
        // SAFETY: as above.
        unsafe { MapHandle::put(ground.edit_cells(edits)?, edited) }
    })
}

/// This map with a cost a unit of length for each cell, row by row: a positive number; those of blocked cells
/// do not matter.
///
/// # Safety
/// `costs` leads to a number for each cell; `priced` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_costs(
    map: MapHandle,
    costs: *const f64,
    count: usize,
    priced: *mut MapHandle,
) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        // SAFETY: the caller promises it.
        let costs = unsafe { memory::array("costs", costs, count) }?;
        // SAFETY: as above.
        unsafe { MapHandle::put(ground.map().costs(costs.iter().copied())?, priced) }
    })
}

/// This map, which has costs, with other ones of scattered cells: a cell with a number is free, one with NaN
/// blocked.
///
/// # Safety
/// `cells` and `costs` lead to `count` values each; `edited` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_edit_costs(
    map: MapHandle,
    cells: *const Cell,
    costs: *const f64,
    count: usize,
    edited: *mut MapHandle,
) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        // SAFETY: the caller promises it.
        let (cells, costs) =
            unsafe { (memory::array("cells", cells, count)?, memory::array("costs", costs, count)?) };
        let edits = cells.iter().zip(costs).map(|(&cell, &cost)| (cell, (!cost.is_nan()).then_some(cost)));
        // SAFETY: as above.
        unsafe { MapHandle::put(ground.edit_costs(edits)?, edited) }
    })
}

/// The map of a disc: free where one with this radius, in cells, fits around the vertex. `motion` as for
/// `mediant_space_new`.
///
/// # Safety
/// `motion` is a text or null; `fitted` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_for_disc(
    map: MapHandle,
    radius: f64,
    motion: *const c_char,
    fitted: *mut MapHandle,
) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        // SAFETY: the caller promises it.
        let motion = unsafe { words::read("motion", motion, words::MOTION) }?.motion()?;
        // SAFETY: as above.
        unsafe { MapHandle::put(ground.map().for_disc(radius, motion)?, fitted) }
    })
}

/// The map of an agent that covers n × n cells; its place is its top left cell.
///
/// # Safety
/// `fitted` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_for_square(map: MapHandle, n: u32, fitted: *mut MapHandle) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        // SAFETY: the caller promises it.
        unsafe { MapHandle::put(ground.map().for_square(n)?, fitted) }
    })
}

/// Writes the distance of each cell's center to the nearest obstacle, in cells, row by row: 0 in blocked
/// cells; as many as there is room for. The outside is an obstacle.
///
/// # Safety
/// `distances` leads to memory for `room` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_clearance(map: MapHandle, distances: *mut f64, room: usize) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        let map = ground.map();
        let clearance = map.clearance(Fit::Centers, Outside::Blocked);
        let (width, height) = (map.width() as i32, map.height() as i32);
        let cells = (0..height).flat_map(|y| (0..width).map(move |x| Vertex::new(x, y)));
        let all = cells.map(|cell| clearance.largest_disc(cell).unwrap_or(0.0));
        // SAFETY: the caller promises it.
        unsafe { memory::fill("distances", distances, room, all) }
    })
}
