//! Costs in a space.

use mediant::Path;
use wasm_bindgen::prelude::*;

use crate::{arguments::path_points, errors::raised, grid::cost_edits, space::Space};

#[wasm_bindgen]
impl Space {
    /// The cost of a path, x, y, …, over N(k) in this space: its length, unless cells have costs. Undefined
    /// where one of its moves is not legal there, or none of N(k).
    ///
    /// A rest of a path has to be measured so, and a path after an edit of costs.
    pub fn cost(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Waypoints")] path: &JsValue,
    ) -> Result<Option<f64>, JsValue> {
        Ok(self.inner.cost(&Path::through(path_points("path", path)?)))
    }

    /// This space of costs with other costs of some cells, as `Grid.editCosts`: an index is repaired for it
    /// (`Index.repair`). This space stays as it is.
    ///
    /// @throws MediantError as `Grid.editCosts`.
    #[wasm_bindgen(js_name = editCosts)]
    pub fn edit_costs(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Points")] cells: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number | null | Costs | readonly (number | null)[]")]
        costs: &JsValue,
    ) -> Result<Self, JsValue> {
        let change = self.inner.edit_costs(cost_edits(cells, costs)?).map_err(raised)?;
        Ok(Self { inner: change.after().clone(), world: self.world })
    }
}
