//! From a space to an index.

use std::cell::RefCell;

use js_sys::{Function, JsString};
use mediant::{Demand, Limits, search::Progress};
use wasm_bindgen::{JsCast, prelude::*};

use crate::{
    errors::{raised, wrong_type},
    index::Index,
    keywords::{Keywords, OPTIONS},
    memory,
    space::Space,
};

#[wasm_bindgen]
impl Space {
    /// Prepares what an engine needs; by default the engine that `engine()` names. `progress` is called with
    /// a stage (`"edges"`, `"hierarchy"`, `"sight"` or `"labels"`), and how much of it is done of all. What
    /// it throws stops the preparation. From outside, a preparation is stopped by ending its worker.
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
        let listener = match progress.dyn_ref::<Function>() {
            Some(function) => Some(function.clone()),
            None if progress.is_undefined() || progress.is_null() => None,
            None => return Err(wrong_type("progress", "a function", progress)),
        };
        self.check_room("the index", memory::INDEX)?;
        let listening = Listening::begin(listener);
        let limits = Limits::new().deadline(has_thrown);
        let index = self.inner.within(&limits).prepare_with_progress(setup.engine, &tell);
        listening.end()?;
        let inner = index.map_err(raised)?.with_smoothing(setup.smoothing);
        Ok(Index { inner, world: self.world })
    }
}

thread_local! {
    /// The listeners of the preparations that run, the innermost last: the library's listener must be able to
    /// go to other threads, and a function of JavaScript is not. Beside each stands the value that it has
    /// thrown.
    static LISTENERS: RefCell<Vec<Listener>> = const { RefCell::new(Vec::new()) };
}

type Listener = (Option<Function>, Option<JsValue>);

/// A preparation that somebody listens to.
struct Listening;

impl Listening {
    fn begin(listener: Option<Function>) -> Self {
        LISTENERS.with_borrow_mut(|listeners| listeners.push((listener, None)));
        Self
    }

    /// Ends it.
    ///
    /// # Errors
    /// The value that the listener has thrown.
    fn end(self) -> Result<(), JsValue> {
        let listener = LISTENERS.with_borrow_mut(Vec::pop);
        listener.and_then(|(_, thrown)| thrown).map_or(Ok(()), Err)
    }
}

/// Whether the one that listens has thrown: then the preparation stops.
fn has_thrown() -> bool {
    LISTENERS.with_borrow(|listeners| matches!(listeners.last(), Some((_, Some(_)))))
}

/// Tells the one that listens. Once it has thrown, it is told no more.
fn tell(progress: Progress) {
    let listener = LISTENERS.with_borrow(|listeners| listeners.last().cloned());
    let Some((Some(function), None)) = listener else { return };
    let stage = progress.stage.name();
    let [done, total] = [progress.done, progress.total].map(|count| JsValue::from(count as f64));
    let called = function.call3(&JsValue::UNDEFINED, &JsString::from(stage), &done, &total);
    if let Err(thrown) = called {
        LISTENERS.with_borrow_mut(|listeners| {
            if let Some(last) = listeners.last_mut() {
                last.1 = Some(thrown);
            }
        });
    }
}
