//! Planners: queries on an index, at once or in steps.

use std::{
    cell::{RefCell, RefMut},
    rc::Rc,
};

use mediant::{Answer, Planner as Inner, PointEnds, Space, errors::QueryError};
use wasm_bindgen::prelude::*;

use crate::{
    answer::{flat, told},
    arguments::{Points, integer, object, point},
    errors::{argument, raised},
    keywords::{Keywords, WISHES},
    trace::Trace,
    types::{JsAnswer, JsWaypoints},
};

/// Answers queries on an index, one after another, at once or in steps. The same query always gives the same
/// path, by the same expansions.
///
/// ```js
/// const planner = index.planner();
/// planner.find([0, 0], [9, 9]).path;
/// // In steps, so that a page can draw in between:
/// planner.begin([0, 0], [9, 9]);
/// let answer;
/// while (!(answer = planner.step(100))) draw(planner.best());
/// ```
#[wasm_bindgen]
pub struct Planner {
    state: Rc<RefCell<State>>,
}

/// A planner, with its last answer.
pub(crate) struct State {
    pub(crate) inner: Inner,
    last: Option<Answer>,
}

/// The last search of a planner: its space and its answer.
pub(crate) struct Searched {
    pub(crate) space: Space,
    pub(crate) answer: Option<Answer>,
}

impl Planner {
    pub(crate) fn new(inner: Inner) -> Self {
        Self { state: Rc::new(RefCell::new(State { inner, last: None })) }
    }

    /// The planner, to be changed.
    fn state(&self) -> Result<RefMut<'_, State>, JsValue> {
        // Only a call out of a search, by a clock or a getter, finds it in use.
        self.state
            .try_borrow_mut()
            .map_err(|_| argument("planner", "it is searching: wait until it has ended"))
    }

    /// The planner, to be asked something else than it was asked last, which it forgets.
    pub(crate) fn idle(&self) -> Result<RefMut<'_, State>, JsValue> {
        let mut state = self.state()?;
        state.last = None;
        Ok(state)
    }

    /// Its last search.
    pub(crate) fn searched(&self) -> Result<Searched, JsValue> {
        let state = self.state()?;
        Ok(Searched { space: state.inner.index().space().clone(), answer: state.last.clone() })
    }
}

impl State {
    /// The answer as an object; it is kept for traces.
    fn answered(&mut self, answer: Result<Answer, QueryError>) -> Result<JsAnswer, JsValue> {
        let answer = answer.map_err(raised)?;
        let rules = self.inner.index().setup().rules();
        let object = told(&answer, (self.inner.guarantee(), rules));
        self.last = Some(answer);
        Ok(object)
    }

    /// Goes on by so many expansions.
    fn proceed(&mut self, expansions: u64, trace: Option<&Trace>) -> Result<Option<Answer>, JsValue> {
        let step = match trace {
            None => self.inner.step(expansions),
            Some(trace) => {
                let mut recorder = trace.recorder(self.inner.index().space())?;
                self.inner.step_observed(expansions, &mut *recorder)
            }
        };
        step.map_err(raised)
    }
}

/// The trace of an argument that may be left out.
fn trace_of(trace: &JsValue) -> Result<Option<Trace>, JsValue> {
    if trace.is_undefined() || trace.is_null() {
        return Ok(None);
    }
    object("trace", "Trace", trace).map(Some)
}

#[wasm_bindgen]
impl Planner {
    /// The engine that answered the last query: that of the index, or the one that searched in its place
    /// (`Index.searchedBy`, `Index.isFinished`).
    #[wasm_bindgen(getter, js_name = searchedBy)]
    pub fn searched_by(&self) -> Result<String, JsValue> {
        Ok(self.state()?.inner.searched_by().name().to_owned())
    }

    /// Answers a query: from a start to a goal, or from any of several starts to any of several goals. A
    /// trace records the events of the search.
    ///
    /// @throws MediantError `start-blocked`, `goal-outside`, … for a start or goal that is blocked or outside
    /// the map; `gave-up` where the engine gives up.
    pub fn find(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Points")] start: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Points")] goal: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "Wishes")] wishes: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "Trace")] trace: &JsValue,
    ) -> Result<JsAnswer, JsValue> {
        let keywords = Keywords::read("wishes", wishes, WISHES)?;
        let (start, goal) = (Points::read("start", start)?, Points::read("goal", goal)?);
        let trace = trace_of(trace)?;
        let mut state = self.idle()?;
        let query = keywords.query(&start, &goal);
        let answer = match trace {
            None => state.inner.find(query),
            Some(trace) => {
                let mut recorder = trace.recorder(state.inner.index().space())?;
                state.inner.find_observed(query, &mut *recorder)
            }
        };
        state.answered(answer)
    }

    /// The length in cells of the path that `find` finds; `Infinity` if there is none. Hub labels measure
    /// without the path: the length may differ from that of the path by a factor of 1 + 2^-31.
    ///
    /// @throws MediantError as `find`.
    pub fn distance(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] start: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Point")] goal: &JsValue,
    ) -> Result<f64, JsValue> {
        let ends = PointEnds::new(point("start", start)?, point("goal", goal)?);
        Ok(self.idle()?.inner.distance(ends).map_err(raised)?.unwrap_or(f64::INFINITY))
    }

    /// Begins a search, and forgets the last one. Nothing is expanded yet.
    ///
    /// @throws MediantError as `find`.
    pub fn begin(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Points")] start: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Points")] goal: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "Wishes")] wishes: &JsValue,
    ) -> Result<(), JsValue> {
        let keywords = Keywords::read("wishes", wishes, WISHES)?;
        let (start, goal) = (Points::read("start", start)?, Points::read("goal", goal)?);
        self.idle()?.inner.begin(keywords.query(&start, &goal)).map_err(raised)
    }

    /// Continues the search by at most so many expansions. The answer once it is there, else undefined.
    ///
    /// @throws MediantError `not-begun` without a search, `gave-up` where the engine gives up.
    #[wasm_bindgen(unchecked_return_type = "Answer | undefined")]
    pub fn step(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] expansions: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "Trace")] trace: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let (expansions, trace) = (integer("expansions", expansions, 0)?, trace_of(trace)?);
        let mut state = self.state()?;
        match state.proceed(expansions, trace.as_ref())? {
            Some(answer) => state.answered(Ok(answer)).map(Into::into),
            None => Ok(JsValue::UNDEFINED),
        }
    }

    /// Continues the search until there is an answer.
    ///
    /// @throws MediantError as `step`.
    pub fn finish(
        &self,
        #[wasm_bindgen(unchecked_optional_param_type = "Trace")] trace: &JsValue,
    ) -> Result<JsAnswer, JsValue> {
        let trace = trace_of(trace)?;
        let mut state = self.state()?;
        loop {
            if let Some(answer) = state.proceed(u64::MAX, trace.as_ref())? {
                return state.answered(Ok(answer));
            }
        }
    }

    /// The best path so far of the search that was begun: to a goal, if one was found, else to the vertex
    /// nearest to a goal among those that it expanded. Undefined without a search.
    pub fn best(&self) -> Result<Option<JsWaypoints>, JsValue> {
        Ok(self.state()?.inner.best().as_ref().map(flat))
    }

    /// The path by which the search that was begun has reached a vertex, until it has answered; undefined
    /// where it has not, and without a search.
    #[wasm_bindgen(js_name = pathTo)]
    pub fn path_to(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] at: &JsValue,
    ) -> Result<Option<JsWaypoints>, JsValue> {
        let at = point("at", at)?;
        Ok(self.state()?.inner.path_to(at).as_ref().map(flat))
    }

    /// A lower bound on the length of the path that is sought, in cells, as `Answer.lowerBound`; 0 without a
    /// search that was begun.
    #[wasm_bindgen(getter, js_name = lowerBound)]
    pub fn lower_bound(&self) -> Result<f64, JsValue> {
        Ok(self.state()?.inner.lower_bound())
    }

    /// The number of expansions so far of the search that was begun; 0 without one.
    #[wasm_bindgen(getter)]
    pub fn expansions(&self) -> Result<f64, JsValue> {
        Ok(self.state()?.inner.expansions() as f64)
    }

    /// A second handle to the same planner, for arguments of calls.
    #[wasm_bindgen(js_name = __share, skip_typescript)]
    pub fn share(&self) -> Self {
        Self { state: Rc::clone(&self.state) }
    }
}
