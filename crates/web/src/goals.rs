//! Goals that many starts ask for.

use js_sys::Float64Array;
use mediant::Goals as Inner;
use wasm_bindgen::prelude::*;

use crate::{
    answer::{object_of, points},
    arguments::{Points, object, point},
    errors::raised,
    index::Index,
    planner::Planner,
    types::JsWaypoints,
};

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
        self.inner.points().len()
    }

    /// The goals x, y, …, in the order in which they were given.
    pub fn points(&self) -> JsWaypoints {
        points(self.inner.points().iter().copied())
    }

    /// A second handle to the same goals, for arguments of calls.
    #[wasm_bindgen(js_name = __share, skip_typescript)]
    pub fn share(&self) -> Self {
        Self { inner: self.inner.clone() }
    }
}

/// The goals of an argument.
fn goals_of(goals: &JsValue) -> Result<Goals, JsValue> {
    object("goals", "Goals", goals)
}

#[wasm_bindgen]
impl Index {
    /// Prepares goals that many starts ask for. With hub labels this takes about two queries for each
    /// goal, and each start then far less than a query for each goal; on other indexes it takes as long.
    ///
    /// ```js
    /// const hotels = index.goals([[9, 0], [0, 9], [3, 4]]);
    /// const distances = index.planner().distances([0, 0], hotels);
    /// ```
    ///
    /// @throws MediantError `goal-blocked`, `goal-outside` for the first goal that is blocked or outside the
    /// map.
    pub fn goals(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Points")] goals: &JsValue,
    ) -> Result<Goals, JsValue> {
        let goals = Points::read("goals", goals)?.into_vec();
        Ok(Goals { inner: self.inner.goals(goals).map_err(raised)? })
    }
}

#[wasm_bindgen]
impl Planner {
    /// The lengths in cells of the paths to each of many goals, in their order; `Infinity` where none leads.
    /// With hub labels they are found together, in far less time than a query for each takes.
    ///
    /// @throws MediantError as `find`; `mismatch` for goals of another map or motion.
    pub fn distances(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] start: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Goals")] goals: &JsValue,
    ) -> Result<Float64Array, JsValue> {
        let (start, goals) = (point("start", start)?, goals_of(goals)?);
        let distances = self.idle()?.inner.distances(start, &goals.inner).map_err(raised)?;
        Ok(Float64Array::from(&distances[..]))
    }

    /// The goal to which the path is shortest, by its number, with hub labels the first of several; undefined
    /// if there is no way to any. With hub labels this takes one to two queries, also for a thousand
    /// goals.
    ///
    /// @throws MediantError as `distances`.
    #[wasm_bindgen(unchecked_return_type = "NearestGoal | undefined")]
    pub fn nearest(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] start: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Goals")] goals: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let (start, goals) = (point("start", start)?, goals_of(goals)?);
        let nearest = self.idle()?.inner.nearest(start, &goals.inner).map_err(raised)?;
        Ok(nearest.map_or(JsValue::UNDEFINED, |(goal, distance)| {
            object_of([("goal", Some((goal as u32).into())), ("distance", Some(distance.into()))])
        }))
    }
}
