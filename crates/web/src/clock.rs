//! The time, which the library does not read.

use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// Milliseconds since the page or the process began.
    #[wasm_bindgen(catch, js_namespace = performance, js_name = now)]
    fn performance_now() -> Result<f64, JsValue>;
}

/// The time in milliseconds, from whichever moment.
fn now() -> f64 {
    performance_now().unwrap_or_else(|_| js_sys::Date::now())
}

/// A moment at which a search stops.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deadline {
    at: f64,
}

impl Deadline {
    /// This many milliseconds from now.
    pub(crate) fn after(milliseconds: f64) -> Self {
        Self { at: now() + milliseconds }
    }

    /// Whether the moment has come.
    pub(crate) fn is_over(self) -> bool {
        now() >= self.at
    }
}
