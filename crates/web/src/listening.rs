//! Functions of JavaScript that are told how far some work is.

use std::cell::RefCell;

use js_sys::Function;
use mediant::Limits;
use wasm_bindgen::{JsCast, prelude::*};

use crate::errors::wrong_type;

thread_local! {
    /// The listeners of the work that runs, the innermost last: the library's listener must be able to go to
    /// other threads, and a function of JavaScript is not. Beside each stands the value that it has thrown.
    static LISTENERS: RefCell<Vec<Listener>> = const { RefCell::new(Vec::new()) };
}

type Listener = (Option<Function>, Option<JsValue>);

/// Work that somebody may listen to.
pub(crate) struct Listening;

impl Listening {
    /// Begins it with the listener of a call, if there is one.
    pub(crate) fn begin(progress: &JsValue) -> Result<Self, JsValue> {
        let listener = match progress.dyn_ref::<Function>() {
            Some(function) => Some(function.clone()),
            None if progress.is_undefined() || progress.is_null() => None,
            None => return Err(wrong_type("progress", "a function", progress)),
        };
        LISTENERS.with_borrow_mut(|listeners| listeners.push((listener, None)));
        Ok(Self)
    }

    /// Limits that stop it once the one that listens has thrown.
    pub(crate) fn limits(&self) -> Limits {
        Limits::new()
            .deadline(|| LISTENERS.with_borrow(|listeners| matches!(listeners.last(), Some((_, Some(_))))))
    }

    /// Ends it.
    ///
    /// # Errors
    /// The value that the listener has thrown.
    pub(crate) fn end(self) -> Result<(), JsValue> {
        let listener = LISTENERS.with_borrow_mut(Vec::pop);
        listener.and_then(|(_, thrown)| thrown).map_or(Ok(()), Err)
    }
}

/// Tells the one that listens how much is done of how much, by a call. Once it has thrown, it is told no
/// more.
pub(crate) fn tell(
    done: usize,
    total: usize,
    call: impl FnOnce(&Function, &JsValue, &JsValue) -> Result<JsValue, JsValue>,
) {
    let listener = LISTENERS.with_borrow(|listeners| listeners.last().cloned());
    let Some((Some(function), None)) = listener else { return };
    let [done, total] = [done, total].map(|count| JsValue::from(count as f64));
    if let Err(thrown) = call(&function, &done, &total) {
        LISTENERS.with_borrow_mut(|listeners| {
            if let Some(last) = listeners.last_mut() {
                last.1 = Some(thrown);
            }
        });
    }
}
