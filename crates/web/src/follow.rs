//! Planners that follow a map that changes.

use wasm_bindgen::prelude::*;

use crate::{arguments::object, errors::raised, index::Index, memory, planner::Planner};

#[wasm_bindgen]
impl Planner {
    /// Continues on another index of the same engine and motion, such as a repaired one, and forgets the
    /// search that was begun last. It answers as a new planner of that index, but keeps its scratch memory
    /// where the map has the same size.
    ///
    /// @throws MediantError `engine-option` for an index of another engine, `mismatch` for one of other rules
    /// or another k, `memory` if there is no room for a larger map. The planner stays as it is then.
    pub fn follow(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Index")] index: &JsValue,
    ) -> Result<(), JsValue> {
        let index: Index = object("index", "Index", index)?;
        let mut state = self.idle()?;
        let [known, map] = [state.inner.index(), &index.inner].map(|index| index.space().map());
        if (known.width(), known.height()) != (map.width(), map.height()) {
            index.space().check_room("the planner", memory::PLANNER)?;
        }
        state.inner.follow(&index.inner).map_err(raised)
    }
}
