//! Grids whose cells have costs.

use std::{cell::RefCell, rc::Rc};

use js_sys::{Array, ArrayBuffer, BigInt64Array, BigUint64Array, DataView, Float64Array, Reflect};
use mediant::{
    Answer, Costs, Demand, Error, ErrorCode, Guarantee, Limits, Map, Motion, Planner, Query, Setup, Space,
    Vertex, call::Call,
};
use wasm_bindgen::{JsCast, prelude::*};

use super::Grid;
use crate::{
    arguments::{Points, number, room},
    errors::{argument, coded, raised, wrong_type},
    memory,
};

/// The answer to cells and keys that hold costs.
pub(crate) const COSTS: &str = "costs of cells are the grid's: grid.withCosts(costs) has them";
/// The keys of a grid's options about costs.
pub(super) const KEYS: &str = "costs, cellSize";

/// The costs of a grid's cells, and what its paths prepared last.
#[derive(Clone)]
pub(crate) struct OfCells {
    costs: Costs,
    kept: Rc<RefCell<Vec<Planner>>>,
}

/// The planners that are kept, of one motion each.
const KEPT: usize = 4;

impl OfCells {
    pub(super) fn new(costs: Costs) -> Self {
        Self { costs, kept: Rc::default() }
    }

    /// The costs of a space, if it has any.
    pub(crate) fn of(space: &Space) -> Option<Self> {
        space.costs().cloned().map(Self::new)
    }

    pub(super) fn id(&self) -> String {
        self.costs.id().to_string()
    }

    pub(crate) fn space(&self, motion: Motion) -> Result<Space, Error> {
        self.costs.space(motion)
    }

    /// The same costs where another map has the cells blocked, which frees none.
    pub(super) fn on(&self, map: &Map) -> Result<Self, JsValue> {
        let (width, height, old) = (map.width() as i32, map.height() as i32, self.costs.map());
        let mut blocked = Vec::new();
        for cell in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            match (old.is_blocked(cell), map.is_blocked(cell)) {
                (true, false) => {
                    let text = format!(
                        "cell {} is freed, and has no cost: give it one, as in editCosts([{}, {}], 1)",
                        Vertex::from(cell),
                        cell.0,
                        cell.1
                    );
                    return Err(coded(ErrorCode::Cost, &text));
                }
                (false, true) => blocked.push((cell, None)),
                _ => {}
            }
        }
        Ok(Self::new(self.costs.edit_cells(blocked).map_err(raised)?))
    }

    /// The setup of a call.
    pub(super) fn setup(&self, call: &Call, motion: Motion) -> Result<Setup, Error> {
        Ok(self.space(motion)?.setup(call, Demand::Paths(1))?.0)
    }

    /// The answer to a query, and the guarantee of its engine, by what was prepared for the last ones.
    pub(super) fn find(
        &self,
        (call, motion): (&Call, Motion),
        query: Query,
    ) -> Result<(Answer, Guarantee), Error> {
        let limits = &Limits::from(query.limits());
        // A clock that is read meanwhile may ask this grid again: so nothing stays borrowed.
        let kept = {
            let mut all = self.kept.borrow_mut();
            let place = all.iter().position(|known| known.index().space().motion() == motion);
            place.map(|place| all.remove(place))
        };
        let space = match &kept {
            Some(planner) => planner.index().space().clone(),
            None => self.costs.within(limits).space(motion)?,
        };
        let (setup, _) = space.setup(call, Demand::Paths(1))?;
        let mut planner = match kept.filter(|planner| planner.index().setup() == setup) {
            Some(planner) => planner,
            None => space.within(limits).prepare(setup.engine)?.try_planner()?,
        };
        let answer = planner.find(query)?;
        let guarantee = planner.guarantee();
        let mut all = self.kept.borrow_mut();
        all.insert(0, planner);
        all.truncate(KEPT);
        Ok((answer, guarantee))
    }
}

/// The options of a new grid about costs.
#[derive(Default)]
pub(super) struct CostOptions {
    costs: JsValue,
    cell_size: JsValue,
}

impl CostOptions {
    /// Takes an option, if it is about costs.
    pub(super) fn take(&mut self, key: &str, value: &JsValue) -> bool {
        match key {
            "costs" => self.costs = value.clone(),
            "cellSize" => self.cell_size = value.clone(),
            _ => return false,
        }
        true
    }

    /// A grid with these costs.
    pub(super) fn on(&self, grid: Grid) -> Result<Grid, JsValue> {
        if self.costs.is_undefined() && !self.cell_size.is_undefined() {
            return Err(argument("cellSize", "only costs know the size of cells: give costs, too"));
        }
        if self.costs.is_undefined() { Ok(grid) } else { grid.with_costs(&self.costs, &self.cell_size) }
    }
}

/// The numbers of an array; `None` for those that are null, if they may be.
fn each_of(name: &str, value: &JsValue, may_be_null: bool) -> Result<Vec<Option<f64>>, JsValue> {
    const EXPECTED: &str = "an array of numbers";
    if let Some(array) = value.dyn_ref::<Array>() {
        let mut numbers = Vec::new();
        for index in 0..array.length() {
            let item = Reflect::get_u32(array, index)?;
            match item.as_f64() {
                None if may_be_null && item.is_null() => numbers.push(None),
                None => return Err(wrong_type(&format!("{name}[{index}]"), "a number", &item)),
                found => numbers.push(found),
            }
        }
        return Ok(numbers);
    }
    let is_numbers = ArrayBuffer::is_view(value)
        && !value.is_instance_of::<DataView>()
        && !value.is_instance_of::<BigInt64Array>()
        && !value.is_instance_of::<BigUint64Array>();
    if !is_numbers {
        return Err(wrong_type(name, EXPECTED, value));
    }
    // A detached array has no numbers, and throws if it is copied.
    let length = Reflect::get(value, &"length".into())?.as_f64().unwrap_or(0.0) as usize;
    let mut numbers = room(length, 0.0, name)?;
    if length > 0 {
        Float64Array::new(value).copy_to(&mut numbers);
    }
    Ok(numbers.into_iter().map(Some).collect())
}

/// Cells with their new costs.
pub(crate) fn cost_edits(cells: &JsValue, costs: &JsValue) -> Result<Vec<(Vertex, Option<f64>)>, JsValue> {
    let cells = Points::read("cells", cells)?.into_vertices("cells")?;
    if let (Some(_), ..) | (_, true) = (costs.as_f64(), costs.is_null()) {
        return Ok(cells.into_iter().map(|cell| (cell, costs.as_f64())).collect());
    }
    let each = each_of("costs", costs, true)?;
    if each.len() != cells.len() {
        let text = format!("expected one for each of {} cells, found {}", cells.len(), each.len());
        return Err(argument("costs", &text));
    }
    Ok(cells.into_iter().zip(each).collect())
}

#[wasm_bindgen]
impl Grid {
    /// This map with costs of its cells, row by row: what a unit of length costs in each, a positive number.
    /// Costs of blocked cells are not looked at. A move costs its length in each cell that it crosses times
    /// the cell's cost. Cells are 1 × 1 unless `cellSize` has another width and height. Without costs, if
    /// they are left out.
    ///
    /// On costs there are k = 2 to 8, A* and Dijkstra's algorithm, fields, tables, edits and repairs; no
    /// smoothing, no exceptions and no saved indexes. `Answer.distance`, fields and `maxCost` are costs.
    ///
    /// ```js
    /// // A road at the bottom, through land on which a step costs five times as much.
    /// const land = Grid.fromRows(["....", ".##.", "...."]).withCosts([5, 5, 5, 5, 1, 1, 1, 1, 1, 1, 1, 1]);
    /// const { cost, length } = land.find([0, 0], [3, 0], { k: 3 }); // 11, 7
    /// ```
    ///
    /// @throws MediantError `cost` for another number of costs than cells, a cost that is zero, negative,
    /// infinite or not a number, and costs more than 65,536 times as great as others; `number` for such a
    /// size of cells.
    #[wasm_bindgen(js_name = withCosts)]
    pub fn with_costs(
        &self,
        #[wasm_bindgen(unchecked_optional_param_type = "Costs")] costs: &JsValue,
        #[wasm_bindgen(
            js_name = cellSize,
            unchecked_optional_param_type = "readonly [x: number, y: number]"
        )]
        cell_size: &JsValue,
    ) -> Result<Self, JsValue> {
        if costs.is_undefined() || costs.is_null() {
            return Ok(Self { costs: None, ..self.share() });
        }
        memory::check("the costs", memory::vertices(&self.map), memory::COSTS)?;
        let costs = each_of("costs", costs, false)?.into_iter().map(Option::unwrap_or_default);
        let costs = self.map.costs(costs).map_err(raised)?;
        let costs = match size_of_cells(cell_size)? {
            None => costs,
            Some((x, y)) => costs.with_cell_size(x, y).map_err(raised)?,
        };
        Ok(Self { costs: Some(OfCells::new(costs)), ..self.share() })
    }

    /// The costs of the cells, row by row: `Infinity` for blocked ones. Undefined without costs. What is no
    /// integer is rounded by 2^-32 of the greatest.
    pub fn costs(&self) -> Result<Option<Float64Array>, JsValue> {
        let Some(OfCells { costs, .. }) = &self.costs else { return Ok(None) };
        let (width, height) = (self.map.width() as usize, self.map.height() as usize);
        let mut all = room(width * height, f64::INFINITY, "the array of costs")?;
        for (y, row) in all.chunks_exact_mut(width).enumerate() {
            for (x, to) in row.iter_mut().enumerate() {
                *to = costs.cost((x as i32, y as i32)).unwrap_or(f64::INFINITY);
            }
        }
        Ok(Some(Float64Array::from(&all[..])))
    }

    /// The width and the height of a cell, by which lengths cost; undefined without costs.
    #[wasm_bindgen(getter, js_name = cellSize, unchecked_return_type = "[x: number, y: number] | undefined")]
    pub fn cell_size(&self) -> JsValue {
        self.costs.as_ref().map_or(JsValue::UNDEFINED, |of| {
            let (x, y) = of.costs.cell_size();
            Array::of2(&x.into(), &y.into()).into()
        })
    }

    /// This grid of costs with other costs of some cells: one for all, or one for each; null blocks a cell.
    /// The last word on a cell counts. This grid stays as it is.
    ///
    /// @throws MediantError `edit-outside` for a cell outside the map, `cost` as `withCosts`, and for a grid
    /// without costs.
    #[wasm_bindgen(js_name = editCosts)]
    pub fn edit_costs(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Points")] cells: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number | null | Costs | readonly (number | null)[]")]
        costs: &JsValue,
    ) -> Result<Self, JsValue> {
        let edits = cost_edits(cells, costs)?;
        let Some(known) = &self.costs else {
            return Err(coded(ErrorCode::Cost, "the cells of this grid have no costs: withCosts gives them"));
        };
        let costs = known.costs.edit_cells(edits).map_err(raised)?;
        let map = costs.map().clone();
        Ok(Self { map, world: self.world, costs: Some(OfCells::new(costs)) })
    }
}

/// The width and the height of a cell, if they are given.
fn size_of_cells(value: &JsValue) -> Result<Option<(f64, f64)>, JsValue> {
    if value.is_undefined() || value.is_null() {
        return Ok(None);
    }
    let array = value.dyn_ref::<Array>().filter(|array| array.length() == 2);
    let array = array.ok_or_else(|| wrong_type("cellSize", "[x, y]: the width and the height", value))?;
    let side = |index| number("cellSize", &Reflect::get_u32(array, index)?);
    Ok(Some((side(0)?, side(1)?)))
}
