//! Calls as JavaScript makes them, through the bindings.
#![allow(dead_code, reason = "each program of tests uses a part")]

use js_sys::{Array, Function, Int32Array, JSON, Reflect};
use wasm_bindgen::{JsCast, JsValue};

/// A value from its text in JSON.
pub(crate) fn json(text: &str) -> JsValue {
    JSON::parse(text).unwrap_or_else(|_| panic!("no JSON: {text}"))
}

/// A property.
pub(crate) fn get(object: &JsValue, key: &str) -> JsValue {
    Reflect::get(object, &key.into()).unwrap_or_else(|_| panic!("{key} throws"))
}

/// The value that a method returns or throws.
pub(crate) fn call(object: &JsValue, method: &str, arguments: &[JsValue]) -> Result<JsValue, JsValue> {
    let function: Function = get(object, method).dyn_into().unwrap_or_else(|_| panic!("no method {method}"));
    Reflect::apply(&function, object, &arguments.iter().collect::<Array>())
}

/// The value that a method returns.
pub(crate) fn ok(object: &JsValue, method: &str, arguments: &[JsValue]) -> JsValue {
    call(object, method, arguments).unwrap_or_else(|error| panic!("{method}: {}", text(&error)))
}

/// Name, code and message of what was thrown.
pub(crate) fn text(error: &JsValue) -> String {
    let part = |key| get(error, key).as_string().unwrap_or_default();
    format!("{} {}: {}", part("name"), part("code"), part("message"))
}

/// The name and the code of what a method throws: `MediantError start-blocked`, `TypeError `.
pub(crate) fn thrown(object: &JsValue, method: &str, arguments: &[JsValue]) -> String {
    let error = call(object, method, arguments).err().unwrap_or_else(|| panic!("{method} throws nothing"));
    text(&error).split(':').next().unwrap_or_default().to_owned()
}

/// The numbers of a path.
pub(crate) fn numbers(path: &JsValue) -> Vec<i32> {
    path.dyn_ref::<Int32Array>().unwrap_or_else(|| panic!("no Int32Array")).to_vec()
}

/// The class of an object, whose static methods can be called.
pub(crate) fn class(object: &JsValue) -> JsValue {
    get(object, "constructor")
}
