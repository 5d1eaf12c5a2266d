//! The library's errors as those of JavaScript.

use mediant::{Error, ErrorCode, call::Spelling, errors::BrokenPath};
use wasm_bindgen::prelude::*;

/// The error for a mistake that the library found: an `Error` with the name `MediantError` and the `code` of
/// the library.
pub(crate) fn raised(error: impl Into<Error>) -> JsValue {
    let error = error.into();
    match &error {
        Error::Call(wrong) => coded(error.code(), &wrong.text(Spelling::Camel)),
        error => coded(error.code(), &error.to_string()),
    }
}

/// The error of the library about an argument that has another name than its own.
pub(crate) fn raised_for(name: &str, error: impl Into<Error>) -> JsValue {
    let error = error.into();
    let text = match &error {
        // A field has sources, where the library speaks of starts.
        Error::Query(error) => error.to_string().replacen("the start", &format!("the {name}"), 1),
        error => format!("{name}: {error}"),
    };
    coded(error.code(), &text)
}

/// The error for an argument that has a value which it cannot have.
pub(crate) fn argument(name: &str, wrong: &str) -> JsValue {
    coded(ErrorCode::Argument, &format!("{name}: {wrong}"))
}

/// The error for an argument of another type.
pub(crate) fn wrong_type(name: &str, expected: &str, found: &JsValue) -> JsValue {
    js_sys::TypeError::new(&format!("{name}: expected {expected}, found {}", kind(found))).into()
}

/// The error for what needs more memory than WebAssembly has.
pub(crate) fn no_memory(what: &str) -> JsValue {
    coded(
        ErrorCode::Memory,
        &format!("{what} needs more memory than there is: free what is not needed, or take a smaller map"),
    )
}

/// The error for a path that does not hold.
pub(crate) fn broken(error: &BrokenPath) -> JsValue {
    coded(ErrorCode::BrokenPath, &error.to_string())
}

/// An `Error` with the name `MediantError` and a code.
pub(crate) fn coded(code: ErrorCode, text: &str) -> JsValue {
    let error = js_sys::Error::new(text);
    error.set_name("MediantError");
    // An object that was just made takes every key.
    _ = js_sys::Reflect::set(&error, &"code".into(), &code.name().into());
    error.into()
}

/// The kind of a value, for an error.
pub(crate) fn kind(value: &JsValue) -> String {
    if value.is_undefined() {
        return "undefined".to_owned();
    }
    if value.is_null() {
        return "null".to_owned();
    }
    if let Some(number) = value.as_f64() {
        return format!("the number {number}");
    }
    if let Some(text) = value.as_string() {
        let start: String = text.chars().take(20).collect();
        return format!("the text '{start}'");
    }
    if js_sys::Array::is_array(value) {
        return "an array".to_owned();
    }
    value
        .js_typeof()
        .as_string()
        .map_or_else(|| "something else".to_owned(), |kind| format!("a value of type {kind}"))
}
