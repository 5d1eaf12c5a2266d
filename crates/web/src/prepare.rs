//! From a space to an index.

use js_sys::JsString;
use mediant::{Demand, search::Progress};
use wasm_bindgen::prelude::*;

use crate::{
    errors::raised,
    index::Index,
    keywords::{Keywords, OPTIONS},
    listening::{Listening, tell},
    memory,
    space::Space,
};

#[wasm_bindgen]
impl Space {
    /// Prepares what an engine needs; by default the engine that `engine()` names. `progress` is called with
    /// a stage (`"edges"`, `"hierarchy"`, `"sight"`, `"labels"` or `"vertices"`), and how much of it is done
    /// of all. What it throws stops the preparation. From outside, a preparation is stopped by ending its
    /// worker.
    ///
    /// ```js
    /// const index = space.prepare("subgoal");
    /// const path = index.planner().find([0, 0], [9, 9]).path;
    /// ```
    ///
    /// @throws MediantError `engine-…` for an engine that does not take the motion or the options;
    /// `index-range` for a map that is too large for the index; what `progress` throws.
    pub fn prepare(
        &self,
        #[wasm_bindgen(unchecked_optional_param_type = "string")] engine: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "Options")] options: &JsValue,
        #[wasm_bindgen(
            unchecked_optional_param_type = "(stage: string, done: number, total: number) => void"
        )]
        progress: &JsValue,
    ) -> Result<Index, JsValue> {
        let keywords = Keywords::read("options", options, OPTIONS)?.with("engine", engine)?;
        let (setup, _) = self.inner.setup(&keywords.call, Demand::Paths(u64::MAX)).map_err(raised)?;
        self.check_room("the index", memory::INDEX)?;
        let listening = Listening::begin(progress)?;
        let tell = |Progress { stage, done, total }| {
            tell(done, total, |listener, done, total| {
                listener.call3(&JsValue::UNDEFINED, &JsString::from(stage.name()), done, total)
            });
        };
        let index = self.inner.within(listening.limits()).prepare_with_progress(setup.engine, &tell);
        listening.end()?;
        let inner = index.map_err(raised)?.with_smoothing(setup.smoothing);
        Ok(Index { inner, world: self.world })
    }
}
