//! Agents of a size, and paths that keep off obstacles.

use js_sys::Float64Array;
use mediant::{
    Vertex,
    grid::{Fit, Outside},
};
use wasm_bindgen::prelude::*;

use crate::{
    answer,
    arguments::{integer_32, positive, room, vertex},
    errors::{argument, raised},
    grid::Grid,
    keywords::{Keywords, MOTION, entries, unknown_key},
    memory,
    space::Space,
};

#[wasm_bindgen]
impl Grid {
    /// The distance of each cell's center to the nearest obstacle, in cells, row by row: 0 in blocked cells.
    /// The outside of the map is an obstacle.
    pub fn clearance(&self) -> Result<Float64Array, JsValue> {
        let (width, height) = (self.map.width() as usize, self.map.height() as usize);
        let mut distances = room(width * height, 0.0, "the array of distances")?;
        let clearance = self.map.clearance(Fit::Centers, Outside::Blocked);
        for (y, row) in distances.chunks_exact_mut(width).enumerate() {
            for (x, distance) in row.iter_mut().enumerate() {
                *distance = clearance.largest_disc(Vertex::new(x as i32, y as i32)).unwrap_or(0.0);
            }
        }
        Ok(Float64Array::from(&distances[..]))
    }

    /// The grid of a disc, whose radius is in cells, or in meters for a grid with a world: free where the
    /// disc fits. The paths of its center are those of a point on that grid, and on each path over this
    /// motion the disc keeps its radius.
    ///
    /// ```js
    /// grid.forDisc(1.5); // in cells
    /// grid.forDisc({ meters: 0.3 }, { k: "any" });
    /// ```
    ///
    /// @throws MediantError `number` for a radius that is not finite, `argument` for one in meters where
    /// there is no world.
    #[wasm_bindgen(js_name = forDisc)]
    pub fn for_disc(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Radius")] radius: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "Motion")] motion: &JsValue,
    ) -> Result<Self, JsValue> {
        let motion = Keywords::read("motion", motion, MOTION)?.motion()?;
        self.instead(self.map.for_disc(self.radius(radius)?, motion).map_err(raised)?)
    }

    /// The grid of an agent that covers n × n cells. Its place is its top left cell: free where all its cells
    /// are.
    ///
    /// @throws MediantError `argument` for n = 0.
    #[wasm_bindgen(js_name = forSquare)]
    pub fn for_square(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] n: &JsValue,
    ) -> Result<Self, JsValue> {
        self.instead(self.map.for_square(integer_32("n", n, 1)?).map_err(raised)?)
    }
}

impl Grid {
    /// A radius in cells: a number, or an object with one in meters.
    fn radius(&self, value: &JsValue) -> Result<f64, JsValue> {
        if !value.is_object() {
            return positive("radius", value);
        }
        let mut meters = None;
        for (key, value) in entries("radius", value)? {
            match key.as_str() {
                "meters" => meters = Some(positive("meters", &value)?),
                _ => return Err(unknown_key("radius", &key, "meters")),
            }
        }
        match (meters, self.world) {
            (Some(meters), Some(world)) => Ok(world.cells(meters)),
            (Some(_), None) => {
                Err(argument("meters", "this grid has no place in the world: give the radius in cells"))
            }
            (None, _) => Err(argument("radius", "give it in cells, or as { meters }")),
        }
    }
}

#[wasm_bindgen]
impl Space {
    /// Of all paths whose length is at most (1 + `surplus`) times that of the shortest, one that keeps off
    /// walls farthest, measured where it comes nearest to one; undefined if there is no path. A surplus of
    /// 0.1 allows 10 % more.
    ///
    /// @throws MediantError as `Planner.find`.
    #[wasm_bindgen(js_name = widestPath, unchecked_return_type = "WidestPath | undefined")]
    pub fn widest_path(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] start: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Point")] goal: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] surplus: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let (start, goal) = (vertex("start", start)?, vertex("goal", goal)?);
        let surplus = positive("surplus", surplus)?;
        self.check_room("the path", memory::SPACE + memory::PLANNER)?;
        let widest = self.inner.widest_path(start, goal, surplus).map_err(raised)?;
        Ok(widest.map_or(JsValue::UNDEFINED, |widest| {
            answer::object_of([
                ("path", Some(answer::flat(&widest.path).into())),
                ("distance", Some(widest.path.cost().into())),
                ("radius", Some(widest.radius.into())),
            ])
        }))
    }
}
