//! Paths at once.

use js_sys::Int32Array;
use mediant::{Error, ErrorCode, Outcome};
use wasm_bindgen::prelude::*;

use super::Grid;
use crate::{
    answer::flat,
    arguments::Points,
    errors::{coded, raised},
    keywords::{ALL, Keywords, call_error},
    memory,
    space::vertices,
};

#[wasm_bindgen]
impl Grid {
    /// A shortest path from a start to a goal, or from any of several starts to any of several goals: its
    /// waypoints x, y, …; undefined if there is none.
    ///
    /// The first call with some motion takes some milliseconds to prepare; the grid keeps that for the next
    /// ones. For many paths prepare an index in a space.
    ///
    /// ```js
    /// grid.path([0, 0], [9, 0], { k: "any", nearest: true });
    /// ```
    ///
    /// @throws MediantError `start-blocked`, `goal-outside`, … for a start or goal that is blocked or outside
    /// the map; `stopped` if a limit stopped the search; `engine-…` for motion or options that the engine
    /// does not take.
    pub fn path(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Points")] start: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Points")] goal: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "How")] how: &JsValue,
    ) -> Result<Option<Int32Array>, JsValue> {
        let keywords = Keywords::read("how", how, ALL)?;
        let (start, goal) = (Points::read("start", start)?, Points::read("goal", goal)?);
        // The time of the call begins before what it prepares.
        let request = keywords.request(&start, &goal);
        let setup = self.map.setup(&keywords.call).map_err(call_error)?;
        if self.map.kept_planners(&setup).is_none() {
            let bytes = memory::SPACE + memory::INDEX + memory::PLANNER;
            memory::check("the search", vertices(&self.map), bytes)?;
        }
        let planners = self.map.keep_planners(&setup, &request.limits()).map_err(|error| match error {
            Error::Stopped { .. } => {
                coded(ErrorCode::Stopped, &format!("{error}: nothing was searched; allow more time"))
            }
            error => raised(error),
        })?;
        planners.try_make_ready().map_err(raised)?;
        match planners.find(request).map_err(raised)? {
            Outcome::Stopped(stopped) => {
                let text = format!(
                    "the search was stopped by its limit ({}): no path is shorter than {:.3} cells; Planner.find \
                     gives the best so far",
                    stopped.by, stopped.lower_bound
                );
                Err(coded(ErrorCode::Stopped, &text))
            }
            outcome => Ok(outcome.path().map(flat)),
        }
    }
}
