//! Planners: queries on an index, at once or in steps.

use std::{
    cell::{RefCell, RefMut},
    rc::Rc,
};

use js_sys::{Float64Array, Int32Array};
use mediant::{
    Answer, Ends, Error, Exceptions, Guarantee, Planner as Inner, Space, Stopped, errors::QueryError,
};
use wasm_bindgen::prelude::*;

use crate::{
    answer::{flat, object_of, told},
    arguments::{Points, flag, integer, object, point},
    errors::{argument, raised},
    goals::Goals,
    keywords::{Keywords, WISHES, entries, unknown_key},
    memory,
    trace::Trace,
    types::JsAnswer,
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
struct State {
    inner: Inner,
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
    fn idle(&self) -> Result<RefMut<'_, State>, JsValue> {
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

/// The goals of an argument.
fn goals_of(goals: &JsValue) -> Result<Goals, JsValue> {
    object("goals", "Goals", goals)
}

/// The trace of an argument that may be left out.
fn trace_of(trace: &JsValue) -> Result<Option<Trace>, JsValue> {
    if trace.is_undefined() || trace.is_null() {
        return Ok(None);
    }
    object("trace", "Trace", trace).map(Some)
}

/// The cells of an argument that count otherwise.
fn exceptions_of(given: &JsValue) -> Result<Exceptions, JsValue> {
    let (mut blocked, mut free, mut free_ends) = (Vec::new(), Vec::new(), false);
    for (key, value) in entries("exceptions", given)? {
        match key.as_str() {
            "blocked" | "free" | "freeEnds" if value.is_undefined() => {}
            "blocked" => blocked = Points::read(&key, &value)?.into_vec(),
            "free" => free = Points::read(&key, &value)?.into_vec(),
            "freeEnds" => free_ends = flag(&key, &value)?,
            _ => return Err(unknown_key("exceptions", &key, "blocked, free, freeEnds")),
        }
    }
    let exceptions = Exceptions::new().blocked(blocked).free(free);
    Ok(if free_ends { exceptions.free_ends() } else { exceptions })
}

#[wasm_bindgen]
impl Planner {
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

    /// Answers a query for which some cells count otherwise than on the map: as `find` does on the map with
    /// these cells edited, on an index that was prepared anew. Nothing that was prepared is used where a cell
    /// differs: an engine that prepares much is replaced by one that prepares next to nothing.
    ///
    /// ```js
    /// planner.findExcept([3, 1], [0, 1], { freeEnds: true, blocked: [[1, 1]] });
    /// ```
    ///
    /// @throws MediantError as `find`, and `edit-outside` for a cell outside the map.
    #[wasm_bindgen(js_name = findExcept)]
    pub fn find_except(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Points")] start: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Points")] goal: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Exceptions")] exceptions: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "Wishes")] wishes: &JsValue,
    ) -> Result<JsAnswer, JsValue> {
        let keywords = Keywords::read("wishes", wishes, WISHES)?;
        let (start, goal) = (Points::read("start", start)?, Points::read("goal", goal)?);
        let exceptions = exceptions_of(exceptions)?;
        let mut state = self.idle()?;
        let inner = &mut state.inner;
        let bytes = memory::SPACE + memory::INDEX + memory::PLANNER;
        memory::check("the search", memory::vertices(inner.index().space().map()), bytes)?;
        let (query, rules) = (keywords.query(&start, &goal), inner.index().setup().rules());
        let mut other = match inner.except(&query, &exceptions) {
            Err(Error::Stopped { by, .. }) => {
                let start = start.as_slice().first().copied().unwrap_or_default();
                let answer = Answer::Stopped(Stopped::before_search(by, start));
                return Ok(told(&answer, (Guarantee::Suboptimal, rules)));
            }
            other => other.map_err(raised)?,
        };
        let planner = other.as_mut().unwrap_or(inner);
        let answer = planner.find(query).map_err(raised)?;
        Ok(told(&answer, (planner.guarantee(), rules)))
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
        let ends = Ends::new(point("start", start)?, point("goal", goal)?);
        Ok(self.idle()?.inner.distance(ends).map_err(raised)?.unwrap_or(f64::INFINITY))
    }

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
    pub fn best(&self) -> Result<Option<Int32Array>, JsValue> {
        Ok(self.state()?.inner.best().as_ref().map(flat))
    }

    /// The path by which the search that was begun has reached a vertex, until it has answered; undefined
    /// where it has not, and without a search.
    #[wasm_bindgen(js_name = pathTo)]
    pub fn path_to(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Point")] at: &JsValue,
    ) -> Result<Option<Int32Array>, JsValue> {
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
