//! Goals that many starts ask for.

use js_sys::Int32Array;
use mediant::Goals as Inner;
use wasm_bindgen::prelude::*;

/// Goals that are prepared for an index: `Index.goals` makes them, `Planner.distances` and `Planner.nearest`
/// ask for them. They never change; any number of planners of indexes with the same map and motion share
/// them.
#[wasm_bindgen]
pub struct Goals {
    pub(crate) inner: Inner,
}

#[wasm_bindgen]
impl Goals {
    /// The number of goals.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.inner.vertices().len()
    }

    /// The goals x, y, …, in the order in which they were given.
    pub fn points(&self) -> Int32Array {
        let flat: Vec<i32> = self.inner.vertices().iter().flat_map(|at| [at.x, at.y]).collect();
        Int32Array::from(&flat[..])
    }

    /// A second handle to the same goals, for arguments of calls.
    #[wasm_bindgen(js_name = __share, skip_typescript)]
    pub fn share(&self) -> Self {
        Self { inner: self.inner.clone() }
    }
}
