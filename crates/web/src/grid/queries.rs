//! Paths at once.

use mediant::{Answer, Error, ErrorCode, Guarantee, Limit, Rules, Stopped};
use wasm_bindgen::prelude::*;

use super::Grid;
use crate::{
    answer::{flat, told},
    arguments::Points,
    errors::{coded, raised},
    keywords::{ALL, Keywords, call_error},
    memory,
    types::{JsAnswer, JsWaypoints},
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
    ) -> Result<Option<JsWaypoints>, JsValue> {
        match self.answered(start, goal, how)? {
            (Answer::Stopped(Stopped { by, lower_bound, .. }), _) => {
                let text = format!(
                    "the search was stopped by its limit ({by}): no path is shorter than {lower_bound:.3} cells; \
                     Grid.find gives the best so far"
                );
                Err(coded(ErrorCode::Stopped, &text))
            }
            (answer, _) => Ok(answer.path().map(flat)),
        }
    }

    /// The whole answer to a query: path, length, and what stopped the search. The arguments are those of
    /// `path`.
    ///
    /// @throws MediantError as `path`, but for a limit.
    pub fn find(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Points")] start: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Points")] goal: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "How")] how: &JsValue,
    ) -> Result<JsAnswer, JsValue> {
        let (answer, promised) = self.answered(start, goal, how)?;
        Ok(told(&answer, promised))
    }

    /// The setup of a call of `path` or `find`: the engine, k, rule and options in one text. The same text,
    /// the same answers.
    ///
    /// @throws MediantError `engine-…` for motion or options that the engine does not take.
    pub fn setup(
        &self,
        #[wasm_bindgen(unchecked_optional_param_type = "How")] how: &JsValue,
    ) -> Result<String, JsValue> {
        let call = Keywords::read("how", how, ALL)?.call;
        let setup = match &self.costs {
            Some(costs) => costs.setup(&call, call.motion().map_err(call_error)?).map_err(raised)?,
            None => self.map.setup(&call).map_err(call_error)?,
        };
        Ok(setup.to_string())
    }
}

/// An answer, and what its engine guarantees under which rules.
type Promised = (Answer, (Guarantee, Rules));

/// The answer where a limit stopped what is prepared for a search.
fn before_search(by: Limit, start: &Points, rules: Rules) -> Promised {
    let start = start.as_slice().first().copied().unwrap_or_default();
    (Answer::Stopped(Stopped::before_search(by, start)), (Guarantee::Suboptimal, rules))
}

impl Grid {
    /// The answer of a call, and what its engine guarantees under which rules.
    fn answered(&self, start: &JsValue, goal: &JsValue, how: &JsValue) -> Result<Promised, JsValue> {
        let keywords = Keywords::read("how", how, ALL)?;
        let (start, goal) = (Points::read("start", start)?, Points::read("goal", goal)?);
        // The time of the call begins before what it prepares.
        let query = keywords.query(&start, &goal);
        if let Some(costs) = &self.costs {
            let motion = keywords.motion()?;
            return match costs.find((&keywords.call, motion), query) {
                Ok((answer, guarantee)) => Ok((answer, (guarantee, motion.rules))),
                Err(Error::Stopped { by, .. }) => Ok(before_search(by, &start, motion.rules)),
                Err(error) => Err(raised(error)),
            };
        }
        let setup = self.map.setup(&keywords.call).map_err(call_error)?;
        if self.map.kept_planners(&setup).is_none() {
            let bytes = memory::SPACE + memory::INDEX + memory::PLANNER;
            memory::check("the search", memory::vertices(&self.map), bytes)?;
        }
        let planners = match self.map.keep_planners(&setup, query.limits()) {
            Ok(planners) => planners,
            Err(Error::Stopped { by, .. }) => return Ok(before_search(by, &start, setup.rules())),
            Err(error) => return Err(raised(error)),
        };
        planners.try_make_ready().map_err(raised)?;
        Ok((planners.find(query).map_err(raised)?, (setup.guarantee(), setup.rules())))
    }
}
