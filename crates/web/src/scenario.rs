//! Scenarios: queries of a benchmark with the lengths of their shortest paths.

use js_sys::{Array, Float64Array, Int32Array, Uint32Array};
use mediant::{ErrorCode, Vertex};
use mediant_formats::{Instance, Scenario as Inner};
use wasm_bindgen::prelude::*;

use crate::{
    arguments::{bytes, object},
    errors::coded,
    grid::Grid,
};

/// The queries of a MovingAI scenario, `.scen`, in the order of the file.
///
/// ```js
/// const scenario = Scenario.read(bytes);
/// const [starts, goals, lengths] = [scenario.starts(), scenario.goals(), scenario.lengths()];
/// ```
#[wasm_bindgen]
pub struct Scenario {
    inner: Inner,
}

impl Scenario {
    fn points(&self, of: impl Fn(&Instance) -> Vertex) -> Int32Array {
        let flat: Vec<i32> = self.inner.instances().iter().map(of).flat_map(|at| [at.x, at.y]).collect();
        Int32Array::from(&flat[..])
    }
}

#[wasm_bindgen]
impl Scenario {
    /// Reads the bytes of a file.
    ///
    /// @throws MediantError `scenario-format` for what is no scenario. It says in which line.
    pub fn read(
        #[wasm_bindgen(unchecked_param_type = "Uint8Array", js_name = bytes)] file: &JsValue,
    ) -> Result<Self, JsValue> {
        let read = Inner::from_bytes(bytes("bytes", file)?);
        let inner = read.map_err(|error| coded(ErrorCode::ScenarioFormat, &error.to_string()))?;
        Ok(Self { inner })
    }

    /// The number of queries.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.inner.instances().len()
    }

    /// Where the paths begin: x, y, ….
    pub fn starts(&self) -> Int32Array {
        self.points(|instance| instance.start)
    }

    /// Where the paths end: x, y, ….
    pub fn goals(&self) -> Int32Array {
        self.points(|instance| instance.goal)
    }

    /// The lengths of shortest paths in cells that the file states, for eight directions between centers that
    /// cut no corners. Files round them. `NaN` where the file knows none: it has 0 there between two places.
    pub fn lengths(&self) -> Float64Array {
        let lengths = self.inner.instances().iter();
        let lengths: Vec<f64> = lengths.map(|query| query.known_optimal().unwrap_or(f64::NAN)).collect();
        Float64Array::from(&lengths[..])
    }

    /// The bucket of each query: those of about the same length share one.
    pub fn buckets(&self) -> Uint32Array {
        let buckets: Vec<u32> = self.inner.instances().iter().map(|query| query.bucket).collect();
        Uint32Array::from(&buckets[..])
    }

    /// The name of each query's map.
    #[wasm_bindgen(unchecked_return_type = "string[]")]
    pub fn maps(&self) -> Array {
        self.inner.instances().iter().map(|query| JsValue::from(&*query.map)).collect()
    }

    /// Checks that each query was made for a map of this grid's size. Names are not compared.
    ///
    /// @throws MediantError `mismatch` for the first query that was made for a map of another size.
    pub fn check(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Grid")] grid: &JsValue,
    ) -> Result<(), JsValue> {
        let grid: Grid = object("grid", "Grid", grid)?;
        let checked = self.inner.check_map(grid.map.grid(), "the grid");
        checked.map_err(|error| coded(ErrorCode::Mismatch, &error.to_string()))
    }
}
