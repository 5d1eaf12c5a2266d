//! Where a map is in the world.

use js_sys::{Array, Float64Array};
use mediant::{
    PlacementKind,
    files::{WorldError, WorldFrame},
};
use wasm_bindgen::{JsCast, prelude::*};

use crate::{
    answer::pair,
    arguments::{Points, integer_32, number, object, word},
    errors::{argument, raised, wrong_type},
    grid::Grid,
};

/// Where a map is in the world, as a ROS map states it: between cells, with y down, and meters, with y up.
/// `Grid.world` of such a map has it; others get one that is made by hand, by `Grid.withWorld`. It never
/// changes.
///
/// ```js
/// const world = new World(40, 20, 0.05, [-1, -0.5]); // 40 × 20 cells of 5 cm
/// world.vertexAt(-0.99, -0.49); // [0, 19]
/// ```
#[wasm_bindgen]
pub struct World {
    pub(crate) frame: WorldFrame,
}

#[wasm_bindgen]
impl World {
    /// The place of a map of so many columns and rows: the side of a cell in meters, and the lower left
    /// corner of the map, below the last row: x and y in meters, and its turn in radians, counterclockwise,
    /// which may be left out. The origin is [0, 0] by default.
    ///
    /// @throws MediantError `argument` for a resolution or an origin that places no map, `map-size` for sides
    /// that no map has.
    #[wasm_bindgen(constructor)]
    pub fn new(
        #[wasm_bindgen(unchecked_param_type = "number")] width: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] height: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] resolution: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "readonly [x: number, y: number, yaw?: number]")]
        origin: &JsValue,
    ) -> Result<Self, JsValue> {
        let (width, height) = (integer_32("width", width, 0)?, integer_32("height", height, 0)?);
        let (resolution, origin) = (number("resolution", resolution)?, place(origin)?);
        let frame = WorldFrame::new(resolution, origin, width, height).map_err(|error| match error {
            WorldError::Size(error) => raised(error),
            WorldError::Origin { .. } => argument("origin", &error.to_string()),
            error => argument("resolution", &error.to_string()),
        })?;
        Ok(Self { frame })
    }

    /// The number of columns of the map.
    #[wasm_bindgen(getter)]
    pub fn width(&self) -> u32 {
        self.frame.width()
    }

    /// The number of rows of the map.
    #[wasm_bindgen(getter)]
    pub fn height(&self) -> u32 {
        self.frame.height()
    }

    /// The side of a cell, in meters.
    #[wasm_bindgen(getter)]
    pub fn resolution(&self) -> f64 {
        self.frame.resolution()
    }

    /// The lower left corner of the map: x and y in meters, and its turn in radians.
    #[wasm_bindgen(getter, unchecked_return_type = "[x: number, y: number, yaw: number]")]
    pub fn origin(&self) -> Array {
        self.frame.origin().into_iter().map(JsValue::from).collect()
    }

    /// The cell that a place of the world is in, in meters, or at `"corner"` the corner of cells that is
    /// nearest to it; undefined outside the map.
    #[wasm_bindgen(js_name = vertexAt, unchecked_return_type = "Point | undefined")]
    pub fn vertex_at(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] x: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] y: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "\"center\" | \"corner\"")] placement: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let at = self.frame.vertex_at(kind(placement)?, number("x", x)?, number("y", y)?);
        Ok(at.map_or(JsValue::UNDEFINED, |at| pair(at).into()))
    }

    /// The point of the map at a place of the world, for a path at any angle: rounded to multiples of 1/1024
    /// of a cell; undefined outside the map.
    #[wasm_bindgen(js_name = placeAt, unchecked_return_type = "Point | undefined")]
    pub fn place_at(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] x: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] y: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "\"center\" | \"corner\"")] placement: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let at = self.frame.place_at(kind(placement)?, number("x", x)?, number("y", y)?);
        Ok(at.map_or(JsValue::UNDEFINED, |at| pair(at).into()))
    }

    /// The places of vertices, or points of the map, in the world: x, y, … in meters.
    #[wasm_bindgen(js_name = pointOf)]
    pub fn point_of(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Points")] points: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "\"center\" | \"corner\"")] placement: &JsValue,
    ) -> Result<Float64Array, JsValue> {
        let (points, placement) = (Points::read("points", points)?, kind(placement)?);
        let place = |&at| <[f64; 2]>::from(self.frame.point_of(placement, at));
        let flat: Vec<f64> = points.as_slice().iter().flat_map(place).collect();
        Ok(Float64Array::from(&flat[..]))
    }

    /// A length in meters, in cells: for radii, limits, tolerances and spacings.
    pub fn cells(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] meters: &JsValue,
    ) -> Result<f64, JsValue> {
        Ok(self.frame.cells(number("meters", meters)?))
    }

    /// A second handle to the same place, for arguments of calls.
    #[wasm_bindgen(js_name = __share, skip_typescript)]
    pub fn share(&self) -> Self {
        Self { frame: self.frame }
    }
}

/// x and y in meters, and a turn in radians that may be left out.
fn place(origin: &JsValue) -> Result<[f64; 3], JsValue> {
    if origin.is_undefined() || origin.is_null() {
        return Ok([0.0; 3]);
    }
    let wrong = || wrong_type("origin", "[x, y] in meters, or [x, y, yaw] with the turn in radians", origin);
    let array =
        origin.dyn_ref::<Array>().filter(|array| matches!(array.length(), 2 | 3)).ok_or_else(wrong)?;
    let mut numbers = [0.0; 3];
    for (index, to) in (0..array.length()).zip(&mut numbers) {
        *to = number("origin", &js_sys::Reflect::get_u32(array, index)?)?;
    }
    Ok(numbers)
}

fn kind(value: &JsValue) -> Result<PlacementKind, JsValue> {
    if value.is_undefined() { Ok(PlacementKind::Center) } else { word("placement", value) }
}

#[wasm_bindgen]
impl Grid {
    /// Where the map is in the world, if it is a ROS map or was told by `withWorld`.
    #[wasm_bindgen(getter)]
    pub fn world(&self) -> Option<World> {
        self.world.map(|frame| World { frame })
    }

    /// This map with another place in the world; without one if it is left out. Edits and maps of agents keep
    /// it.
    ///
    /// @throws MediantError `argument` for the place of a map of another size.
    #[wasm_bindgen(js_name = withWorld)]
    pub fn with_world(
        &self,
        #[wasm_bindgen(unchecked_optional_param_type = "World")] world: &JsValue,
    ) -> Result<Self, JsValue> {
        if world.is_undefined() || world.is_null() {
            return Ok(Self { world: None, ..self.share() });
        }
        let World { frame } = object("world", "World", world)?;
        let (width, height) = (self.map.width(), self.map.height());
        if (frame.width(), frame.height()) != (width, height) {
            let text = format!(
                "expected that of a map of {width} × {height} cells, found one of {} × {}",
                frame.width(),
                frame.height()
            );
            return Err(argument("world", &text));
        }
        Ok(Self { world: Some(frame), ..self.share() })
    }
}
