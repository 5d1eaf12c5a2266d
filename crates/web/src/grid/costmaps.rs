//! Robots' costmaps: costs around obstacles, and bytes that are costs.

use mediant::{
    Costmap, Costs, Error, ErrorCode, Inflation, Traversal, errors::CostsError, grid::Grid as Bits,
};
use wasm_bindgen::prelude::*;

use super::{Grid, costs::OfCells};
use crate::{
    arguments::{bytes, integer, number},
    errors::{argument, coded, raised},
    keywords::{entries, unknown_key},
    memory,
};

/// The weight of bytes where none is given: as in the program.
const WEIGHT: f64 = 2.0;

#[wasm_bindgen]
impl Grid {
    /// This grid with costs around its blocked cells, as the inflation layer of nav2 has them. Lengths are in
    /// meters where the grid has a `world`, else in cells. At a distance d from the center of the nearest
    /// blocked cell, a cell has the byte 252 · exp(-factor · (d - inscribed radius)), rounded down, and costs
    /// 1 + weight · byte / 252 for each cell of length. A path costs its length in cells, and more near
    /// obstacles. The outside of the map is no obstacle.
    ///
    /// ```js
    /// grid.inflated({ inflationRadius: 4, inscribedRadius: 1 }).find([0, 0], [9, 0]).cost;
    /// ```
    ///
    /// @throws MediantError `argument` for a number that is negative or not finite, for an inflation radius
    /// below the inscribed one, and for a weight so great that costs are too far apart; `cost` for a grid
    /// that has costs.
    pub fn inflated(
        &self,
        #[wasm_bindgen(unchecked_param_type = "InflationOptions")] options: &JsValue,
    ) -> Result<Self, JsValue> {
        if self.costs.is_some() {
            let text = "this grid has costs: inflate one of its cells alone, grid.withCosts().inflated(…)";
            return Err(coded(ErrorCode::Cost, text));
        }
        let (mut inflation_radius, mut inscribed_radius, mut factor, mut weight) = (None, 0.0, None, WEIGHT);
        for (key, value) in given(options)? {
            match &*key {
                "inflationRadius" => inflation_radius = Some(number(&key, &value)?),
                "inscribedRadius" => inscribed_radius = number(&key, &value)?,
                "costScalingFactor" => factor = Some(number(&key, &value)?),
                "weight" => weight = number(&key, &value)?,
                _ => return Err(unknown_key("options", &key, INFLATION_KEYS)),
            }
        }
        let inflation_radius =
            inflation_radius.ok_or_else(|| argument("inflationRadius", "expected a number, found none"))?;
        let by_distance = inflation_radius - inscribed_radius;
        // Beyond that distance less than 1 of 252 would be left.
        let falling = if by_distance > 0.0 { 252.0_f64.ln() / by_distance } else { 0.0 };
        let inflation = Inflation {
            resolution: self.world.map_or(1.0, |frame| frame.resolution()),
            inscribed_radius,
            inflation_radius,
            cost_scaling_factor: factor.unwrap_or_else(|| falling.min(f64::MAX)),
            ..Inflation::default()
        };
        memory::check("the costmap", memory::vertices(&self.map), memory::COSTMAP)?;
        let costs = self.map.inflated(&inflation).and_then(|costmap| costmap.costs(weight));
        Ok(Self { world: self.world, ..Self::of_costs(costs.map_err(refused)?) })
    }

    /// The grid of a robot's costmap, a byte a cell, row by row from the highest one (the messages of ROS
    /// begin with the lowest). 0 is free, 1 to 252 is free and the nearer to an obstacle the more, 253 so
    /// near that the robot touches it, 254 an obstacle, 255 unknown. A cell up to 252 costs
    /// 1 + weight · byte / 252 for each cell of length; the others are blocked.
    ///
    /// ```js
    /// Grid.fromCostmap(3, 1, Uint8Array.of(0, 126, 254)).costs(); // 1, 2, Infinity
    /// ```
    ///
    /// @throws MediantError `map-size` for a side of 0 or above 32,768, `argument` for another number of
    /// bytes, for a weight that is negative, not finite or too great, and for an unknown byte above 252.
    #[wasm_bindgen(js_name = fromCostmap)]
    pub fn from_costmap(
        #[wasm_bindgen(unchecked_param_type = "number")] width: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] height: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array | Uint8ClampedArray")] costmap: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "CostmapOptions")] options: &JsValue,
    ) -> Result<Self, JsValue> {
        let (mut weight, mut traversal) = (WEIGHT, Traversal::default());
        for (key, value) in given(options)? {
            match &*key {
                "weight" => weight = number(&key, &value)?,
                "unknown" if value.is_null() => traversal.unknown = None,
                "unknown" => traversal.unknown = Some(free_byte(&value)?),
                _ => return Err(unknown_key("options", &key, COSTMAP_KEYS)),
            }
        }
        let (width, height) = (integer("width", width, 0)?, integer("height", height, 0)?);
        Bits::check_size(width, height).map_err(raised)?;
        memory::check("the costmap", width * height, memory::COSTMAP)?;
        let costmap = bytes("costmap", costmap)?;
        if costmap.len() as u64 != width * height {
            let text = format!("expected width × height = {} bytes, found {}", width * height, costmap.len());
            return Err(argument("costmap", &text));
        }
        let costmap = Costmap::from_bytes(width as u32, height as u32, costmap).map_err(raised)?;
        Ok(Self::of_costs(costmap.costs_with(weight, &traversal).map_err(refused)?))
    }
}

impl Grid {
    fn of_costs(costs: Costs) -> Self {
        let map = costs.map().clone();
        Self { costs: Some(OfCells::new(costs)), ..Self::new(map) }
    }
}

/// The options that are given.
fn given(options: &JsValue) -> Result<Vec<(String, JsValue)>, JsValue> {
    let mut entries = entries("options", options)?;
    entries.retain(|(_, value)| !value.is_undefined());
    Ok(entries)
}

/// The keys of the options of inflation.
const INFLATION_KEYS: &str = "inflationRadius, inscribedRadius, costScalingFactor, weight";
/// The keys of the options of a costmap.
const COSTMAP_KEYS: &str = "weight, unknown";

/// A byte of a cell that can be crossed.
fn free_byte(value: &JsValue) -> Result<u8, JsValue> {
    let found = integer("unknown", value, 0)?;
    let byte = u8::try_from(found).ok().filter(|&byte| byte <= Costmap::DEAREST);
    byte.ok_or_else(|| argument("unknown", &format!("expected an integer from 0 to 252, found {found}")))
}

/// The error for settings of costs that cannot be.
fn refused(error: Error) -> JsValue {
    match &error {
        Error::Costs(CostsError::Setting { name, value, expected }) => {
            let name = match *name {
                "inflation_radius" => "inflationRadius",
                "inscribed_radius" => "inscribedRadius",
                "cost_scaling_factor" => "costScalingFactor",
                name => name,
            };
            argument(name, &format!("expected {expected}, found {value}"))
        }
        Error::Costs(error @ CostsError::SmallInflation { .. }) => {
            argument("inflationRadius", &error.to_string())
        }
        Error::Costs(error @ CostsError::Range { .. }) => argument("weight", &error.to_string()),
        _ => raised(error),
    }
}
