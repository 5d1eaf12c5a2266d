//! Maps.

#[cfg(not(feature = "full"))]
mod absent;
#[cfg(feature = "full")]
mod costmaps;
#[cfg(feature = "full")]
mod costs;
mod queries;
#[cfg(feature = "full")]
mod reading;
mod tiles;

use js_sys::{Array, ArrayBuffer, Uint8Array, Uint8ClampedArray};
use mediant::{Map, Motion, Rectangle, Space, files::WorldFrame, grid::Grid as Bits};
use wasm_bindgen::{JsCast, prelude::*};

#[cfg(not(feature = "full"))]
use self::absent as costs;
#[cfg(feature = "full")]
pub(crate) use self::costs::cost_edits;
pub(crate) use self::costs::{COSTS, OfCells};
use self::costs::{CostOptions, KEYS};
use crate::{
    arguments::{Points, bytes, flag, integer, integer_32, room, text},
    errors::{argument, raised, wrong_type},
    keywords::{entries, unknown_key},
};

/// A map: a rectangle of cells, each free or blocked. Cell (x, y) is in column x from the left and row y from
/// the top, both from 0. Everything outside is blocked.
///
/// A grid never changes: `edit` makes another one.
///
/// ```js
/// const grid = Grid.fromRows(["...#....", ".#.#.##.", ".#...#.."]);
/// grid.path([0, 0], [7, 0]); // Int32Array [0, 0, 2, 0, 2, 2, …]
/// ```
#[wasm_bindgen]
pub struct Grid {
    pub(crate) map: Map,
    pub(crate) world: Option<WorldFrame>,
    /// The costs of its cells, if they have any.
    pub(crate) costs: Option<OfCells>,
}

impl Grid {
    pub(crate) fn new(map: Map) -> Self {
        Self { map, world: None, costs: None }
    }

    /// Another map at the same place in the world, with the same costs: it frees no cell that has none.
    pub(crate) fn instead(&self, map: Map) -> Result<Self, JsValue> {
        let costs = self.costs.as_ref().map(|costs| costs.on(&map)).transpose()?;
        Ok(Self { map, world: self.world, costs })
    }

    /// The map with rules of motion.
    pub(crate) fn searched(&self, motion: Motion) -> Result<Space, JsValue> {
        match &self.costs {
            Some(costs) => costs.space(motion),
            None => self.map.space(motion),
        }
        .map_err(raised)
    }
}

#[wasm_bindgen]
impl Grid {
    /// The map with these cells, row by row: 0 is free, 1 is blocked. The options are those of `withCosts`.
    ///
    /// ```js
    /// new Grid(3, 1, new Uint8Array(3), { costs: [1, 5, 1] });
    /// ```
    ///
    /// @throws MediantError `map-size` for a side of 0 or above 32,768, `argument` for another number of
    /// cells, and for a cell that is neither 0 nor 1; `cost` as `withCosts`.
    #[wasm_bindgen(constructor)]
    pub fn from_cells(
        #[wasm_bindgen(unchecked_param_type = "number")] width: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] height: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array | Uint8ClampedArray")] blocked: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "CostOptions")] options: &JsValue,
    ) -> Result<Self, JsValue> {
        let mut of_costs = CostOptions::default();
        for (key, value) in entries("options", options)? {
            if !of_costs.take(&key, &value) {
                return Err(unknown_key("options", &key, KEYS));
            }
        }
        let (width, height) = (integer("width", width, 0)?, integer("height", height, 0)?);
        Bits::check_size(width, height).map_err(raised)?;
        let cells = cells_of(blocked, (SIDES, width * height))?;
        let (width, height) = (width as u32, height as u32);
        let map = Map::from_fn(width, height, |x, y| cells[y as usize * width as usize + x as usize] != 0);
        of_costs.on(Self::new(map.map_err(raised)?))
    }

    /// The map with these rows from top to bottom, all of the same length: `.`, `G` and `S` are free cells,
    /// `#`, `@`, `O`, `T` and `W` blocked ones, small letters as capitals. The options `free` and `blocked`
    /// name other characters, `costs` and `cellSize` are those of `withCosts`.
    ///
    /// @throws MediantError `map-tile` for another character, `map-ragged` for rows of different lengths,
    /// `map-size` for no rows or too long ones.
    #[wasm_bindgen(js_name = fromRows)]
    pub fn from_rows(
        #[wasm_bindgen(unchecked_param_type = "readonly string[]")] rows: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "RowOptions")] options: &JsValue,
    ) -> Result<Self, JsValue> {
        let expected = "an array of texts";
        let Some(array) = rows.dyn_ref::<Array>() else { return Err(wrong_type("rows", expected, rows)) };
        let mut rows = Vec::new();
        for index in 0..array.length() {
            rows.push(text("rows", expected, &js_sys::Reflect::get_u32(array, index)?)?);
        }
        let (tiles, of_costs) = tiles::row_options(options)?;
        of_costs.on(Self::new(Map::from_rows_with(rows, &tiles).map_err(raised)?))
    }

    /// The number of columns.
    #[wasm_bindgen(getter)]
    pub fn width(&self) -> u32 {
        self.map.width()
    }

    /// The number of rows.
    #[wasm_bindgen(getter)]
    pub fn height(&self) -> u32 {
        self.map.height()
    }

    /// The identity of the map: the same for all maps with the same cells, and costs.
    #[wasm_bindgen(getter)]
    pub fn id(&self) -> String {
        self.costs.as_ref().map_or_else(|| self.map.id().to_string(), OfCells::id)
    }

    /// The cells, row by row; 1 is blocked.
    pub fn cells(&self) -> Result<Uint8Array, JsValue> {
        let (width, height) = (self.map.width() as usize, self.map.height() as usize);
        let mut cells = room(width * height, 0, "the array of cells")?;
        for (y, row) in cells.chunks_exact_mut(width).enumerate() {
            for (x, cell) in row.iter_mut().enumerate() {
                *cell = u8::from(self.map.is_blocked((x, y)));
            }
        }
        Ok(Uint8Array::from(&cells[..]))
    }

    /// Whether a cell is blocked; those outside the map are.
    #[wasm_bindgen(js_name = isBlocked)]
    pub fn is_blocked(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] x: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] y: &JsValue,
    ) -> Result<bool, JsValue> {
        let (x, y) = (crate::arguments::number("x", x)?, crate::arguments::number("y", y)?);
        let is_inside = |at: f64, size: u32| at >= 0.0 && at < f64::from(size);
        let is_inside = is_inside(x, self.map.width()) && is_inside(y, self.map.height());
        Ok(!is_inside || self.map.is_blocked((x as i32, y as i32)))
    }

    /// This map with other cells in a rectangle, which are given row by row: 0 is free, 1 is blocked. Cells
    /// of the rectangle beyond the map are left out. This map stays as it is.
    ///
    /// @throws MediantError `edit-outside` for a rectangle that lies outside the map as a whole, `argument`
    /// for a cell that is neither 0 nor 1; `cost` for a cell that is freed where cells have costs.
    pub fn edit(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] x: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] y: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] width: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] height: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array | Uint8ClampedArray")] blocked: &JsValue,
    ) -> Result<Self, JsValue> {
        let edit = Edit::read([x, y, width, height], blocked)?;
        self.instead(self.map.edit(edit.at, |x, y| edit.is_blocked(x, y)).map_err(raised)?)
    }

    /// This map with other scattered cells: whether they are blocked is one value for all, or 0 or 1 for
    /// each. The last word on a cell counts. This map stays as it is.
    ///
    /// ```js
    /// grid.editCells([[0, 0], [3, 1]], true);
    /// ```
    ///
    /// @throws MediantError `edit-outside` for a cell outside the map, `argument` for another number of
    /// values, and for one that is neither 0 nor 1; `cost` as `edit`.
    #[wasm_bindgen(js_name = editCells)]
    pub fn edit_cells(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Points")] cells: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "boolean | Uint8Array | Uint8ClampedArray")] blocked: &JsValue,
    ) -> Result<Self, JsValue> {
        let cells = Points::read("cells", cells)?.into_vertices("cells")?;
        let each = match blocked.as_bool() {
            Some(_) => Vec::new(),
            None => cells_of(blocked, ("one for each cell", cells.len() as u64))?,
        };
        let all = each.is_empty() && !cells.is_empty() && flag("blocked", blocked)?;
        let value = |index: usize| each.get(index).map_or(all, |&cell| cell != 0);
        let cells = cells.into_iter().enumerate().map(|(index, cell)| (cell, value(index)));
        self.instead(self.map.edit_cells(cells).map_err(raised)?)
    }

    /// A second handle to the same map, for arguments of calls.
    #[wasm_bindgen(js_name = __share, skip_typescript)]
    pub fn share(&self) -> Self {
        Self { map: self.map.clone(), world: self.world, costs: self.costs.clone() }
    }
}

/// The number of cells of a rectangle, for messages.
const SIDES: &str = "width × height";

/// The reason why cells are 0 or 1, and the way to make them.
fn no_costs() -> String {
    format!("{COSTS}; or make cells, for instance Uint8Array.from(costs, (cost) => Number(cost > limit))")
}

/// The cells of an argument, of which there must be so many, for this reason.
fn cells_of(blocked: &JsValue, (why, expected): (&str, u64)) -> Result<Vec<u8>, JsValue> {
    let is_other = ArrayBuffer::is_view(blocked)
        && !blocked.is_instance_of::<Uint8Array>()
        && !blocked.is_instance_of::<Uint8ClampedArray>();
    if is_other {
        let wrong = format!("blocked: expected a Uint8Array, found another type of numbers: {}", no_costs());
        return Err(js_sys::TypeError::new(&wrong).into());
    }
    let cells = bytes("blocked", blocked)?;
    if cells.len() as u64 != expected {
        let wrong = format!("expected {why} = {expected} cells, found {}", cells.len());
        return Err(argument("blocked", &wrong));
    }
    if let Some(at) = cells.iter().position(|&cell| cell > 1) {
        let (found, why) = (cells[at], no_costs());
        let wrong = format!("expected 0 (free) or 1 (blocked), found {found} as item {at}: {why}");
        return Err(argument("blocked", &wrong));
    }
    Ok(cells)
}

/// Other cells in a rectangle.
pub(crate) struct Edit {
    pub(crate) at: Rectangle,
    cells: Vec<u8>,
}

impl Edit {
    /// Reads the arguments of an edit.
    pub(crate) fn read([x, y, width, height]: [&JsValue; 4], blocked: &JsValue) -> Result<Self, JsValue> {
        let (x, y) = (integer_32("x", x, 0)?, integer_32("y", y, 0)?);
        let (width, height) = (integer("width", width, 0)?, integer("height", height, 0)?);
        let cells = cells_of(blocked, (SIDES, width.saturating_mul(height)))?;
        // A side is larger only if the other one is 0.
        let [width, height] = [width, height].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
        Ok(Self { at: Rectangle { x, y, width, height }, cells })
    }

    /// Whether a cell of the rectangle is to be blocked.
    pub(crate) fn is_blocked(&self, x: u32, y: u32) -> bool {
        let at = (y - self.at.y) as usize * self.at.width as usize + (x - self.at.x) as usize;
        self.cells.get(at).is_some_and(|&cell| cell != 0)
    }
}
