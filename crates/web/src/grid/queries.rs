//! Paths at once.

use js_sys::Int32Array;
use mediant::{Choice, Outcome, Planner, Setup, Space};
use wasm_bindgen::prelude::*;

use super::Grid;
use crate::{
    answer::flat,
    arguments::Points,
    errors::{coded, raised},
    keywords::{Keywords, Takes},
};

/// The space and the planner of the last path, for the next one.
pub(super) struct Last {
    setup: Setup,
    space: Space,
    planner: Planner,
}

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
        let keywords = Keywords::read("how", how, Takes::ALL)?;
        let (start, goal) = (Points::read("start", start)?, Points::read("goal", goal)?);
        let motion = keywords.motion()?;
        // It is kept elsewhere while it searches: a clock could call back.
        let kept = self.last.try_borrow_mut().ok().and_then(|mut last| last.take());
        let kept = kept.filter(|last| last.setup.motion() == motion);
        // Not another one for the first path: the same call would give another path of the same length.
        let engine = keywords.engine.unwrap_or(Choice::for_next_path(motion, &self.map).engine);
        let setup = Setup {
            smoothing: keywords.smoothing,
            ..Setup::new(keywords.configured(engine)?, motion.k, motion.rules)
        };
        // The time of the call begins before what it prepares.
        let request = keywords.request(&start, &goal);
        let mut last = match kept {
            Some(last) if last.setup == setup => last,
            kept => {
                let limits = request.limits();
                let space = kept.map(|last| last.space);
                let (space, planner) = crate::space::planner(setup, &self.map, space, &limits)?;
                Last { setup, space, planner }
            }
        };
        let answer = last.planner.find(request);
        if let Ok(mut kept) = self.last.try_borrow_mut() {
            *kept = Some(last);
        }
        match answer.map_err(raised)? {
            Outcome::Stopped(stopped) => {
                let text = format!(
                    "the search was stopped by its limit ({}): no path is shorter than {:.3} cells; Planner.find \
                     gives the best so far",
                    stopped.by, stopped.lower_bound
                );
                Err(coded("stopped", &text))
            }
            outcome => Ok(outcome.path().map(flat)),
        }
    }
}
