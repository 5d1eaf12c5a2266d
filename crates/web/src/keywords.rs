//! The objects of options, as the library's parameters.

use js_sys::Reflect;
use mediant::{
    Engine, Motion, Query,
    call::{Call, CallError, Group, Parameter, Spelling, Value},
    errors::{NO_COSTS, absent},
};
use wasm_bindgen::prelude::*;

use crate::{
    arguments::Points,
    clock::Deadline,
    errors::{coded, kind, raised, wrong_type},
    grid::COSTS,
};

/// The groups of keys that an object may have.
pub(crate) type Takes = &'static [Group];

pub(crate) const ALL: Takes = &Group::ALL;
pub(crate) const MOTION: Takes = &[Group::Motion];
pub(crate) const WISHES: Takes = &[Group::Wishes];
pub(crate) const OPTIONS: Takes = &[Group::Options];

/// The parameters of a call.
#[derive(Clone, Debug, Default)]
pub(crate) struct Keywords {
    pub(crate) call: Call,
}

impl Keywords {
    /// Reads an object; undefined and null are one without keys, and a key that is undefined is none.
    /// `name` is that of the argument, for errors.
    pub(crate) fn read(name: &str, given: &JsValue, takes: Takes) -> Result<Self, JsValue> {
        Self::default().and(name, given, takes)
    }

    /// Reads one more object.
    pub(crate) fn and(mut self, name: &str, given: &JsValue, takes: Takes) -> Result<Self, JsValue> {
        for (key, value) in entries(name, given)? {
            let parameter = Parameter::find(&key, Spelling::Camel, takes).ok_or_else(|| {
                let known: Vec<String> = Parameter::names(takes, Spelling::Camel).collect();
                unknown_key(name, &key, &known.join(", "))
            })?;
            self.call.set(parameter, value_of(&value)).map_err(call_error)?;
        }
        Ok(self)
    }

    /// Reads a parameter that a function has as an argument of its own.
    pub(crate) fn with(mut self, name: &str, value: &JsValue) -> Result<Self, JsValue> {
        if let (Some(parameter), false) = (Parameter::find(name, Spelling::Camel, ALL), value.is_null()) {
            self.call.set(parameter, value_of(value)).map_err(call_error)?;
        }
        Ok(self)
    }

    /// The motion that the keywords give.
    pub(crate) fn motion(&self) -> Result<Motion, JsValue> {
        self.call.motion().map_err(call_error)
    }

    /// The query for a path between points. Its time begins now.
    pub(crate) fn query(&self, start: &Points, goal: &Points) -> Query {
        let mut limits = self.call.wishes().limits();
        if let Some(milliseconds) = self.call.wishes().timeout {
            let deadline = Deadline::after(milliseconds);
            limits = limits.deadline(move || deadline.is_over());
        }
        self.call.wishes().query(start.as_slice(), goal.as_slice(), limits)
    }
}

/// A value of JavaScript as the library's.
fn value_of(value: &JsValue) -> Value<'static> {
    if value.is_undefined() {
        Value::Absent
    } else if let Some(flag) = value.as_bool() {
        Value::Flag(flag)
    } else if let Some(number) = value.as_f64() {
        Value::Number(number)
    } else if let Some(text) = value.as_string() {
        Value::Text(text.into())
    } else {
        Value::Other(kind(value))
    }
}

/// The error of the library about the parameters of a call.
pub(crate) fn call_error(error: CallError) -> JsValue {
    match error {
        CallError::Type { .. } => js_sys::TypeError::new(&error.text(Spelling::Camel)).into(),
        error => raised(error),
    }
}

/// The keys of an object with their values; none of undefined and null.
pub(crate) fn entries(name: &str, given: &JsValue) -> Result<Vec<(String, JsValue)>, JsValue> {
    if given.is_undefined() || given.is_null() {
        return Ok(Vec::new());
    }
    if !given.is_object() || js_sys::Array::is_array(given) {
        return Err(wrong_type(name, "an object of options", given));
    }
    let mut entries = Vec::new();
    for key in Reflect::own_keys(given)?.iter() {
        // Symbols are no options, and nobody misspells one.
        if let Some(text) = key.as_string() {
            entries.push((text, Reflect::get(given, &key)?));
        }
    }
    Ok(entries)
}

/// The error for a key that an object cannot have.
pub(crate) fn unknown_key(name: &str, key: &str, known: &str) -> JsValue {
    let why = absent(key).map(|why| if why == NO_COSTS { COSTS } else { why });
    let why = why.map_or(String::new(), |why| format!(" ({why})"));
    let known = known.trim_end_matches(", ");
    let known = if known.is_empty() { String::new() } else { format!("; the keys are {known}") };
    let text = format!("{name}: no key '{key}' is known{why}{known}");
    coded(mediant::ErrorCode::Argument, &text)
}

/// An engine's name; `None` for undefined and `"auto"`.
pub(crate) fn read_engine(value: &JsValue) -> Result<Option<Engine>, JsValue> {
    Ok(Keywords::default().with("engine", value)?.call.engine())
}
