//! Queries for which some cells count otherwise than on the map.

use mediant::{Answer, Error, Exceptions, Guarantee, Stopped};
use wasm_bindgen::prelude::*;

use crate::{
    answer::told,
    arguments::{Points, flag},
    errors::raised,
    keywords::{Keywords, WISHES, entries, unknown_key},
    memory,
    planner::Planner,
    types::JsAnswer,
};

/// The cells of an argument that count otherwise.
fn exceptions_of(given: &JsValue) -> Result<Exceptions, JsValue> {
    let (mut blocked, mut free, mut free_ends) = (Vec::new(), Vec::new(), false);
    for (key, value) in entries("exceptions", given)? {
        match key.as_str() {
            "blocked" | "free" | "freeEnds" if value.is_undefined() => {}
            "blocked" => blocked = Points::read(&key, &value)?.into_vertices(&key)?,
            "free" => free = Points::read(&key, &value)?.into_vertices(&key)?,
            "freeEnds" => free_ends = flag(&key, &value)?,
            _ => return Err(unknown_key("exceptions", &key, "blocked, free, freeEnds")),
        }
    }
    let exceptions = Exceptions::new().blocked(blocked).free(free);
    Ok(if free_ends { exceptions.free_ends() } else { exceptions })
}

#[wasm_bindgen]
impl Planner {
    /// Answers a query for which some cells count otherwise than on the map: as `find` does on the map with
    /// these cells edited. The index is repaired for the query, by work that follows the cells; where it
    /// would be prepared anew instead, an engine that prepares next to nothing answers.
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
        let (answer, guarantee) = match inner.find_except(query, &exceptions) {
            Err(Error::Stopped { by, .. }) => {
                let start = start.as_slice().first().copied().unwrap_or_default();
                (Answer::Stopped(Stopped::before_search(by, start)), Guarantee::Suboptimal)
            }
            found => found.map(|found| (found.answer, found.guarantee)).map_err(raised)?,
        };
        Ok(told(&answer, (guarantee, rules)))
    }
}
