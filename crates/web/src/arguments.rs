//! Points, numbers and bytes, as a call was given them. Each mistake names its argument.

use std::str::FromStr;

use js_sys::{Array, Float64Array, Int32Array, Uint8Array, Uint8ClampedArray};
use mediant::{ErrorCode, Point, Vertex, errors::UnknownName};
use wasm_bindgen::{JsCast, convert::TryFromJsValue, prelude::*};

use crate::errors::{argument, coded, no_memory, raised_for, wrong_type};

/// The form of a point, for errors.
const POINT: &str = "a point [x, y] of two numbers";
/// The form of one or several points, for errors.
const POINTS: &str = "a point [x, y], an array of points, or an Int32Array or Float64Array of x, y, …";
/// The form of the points of a path, for errors.
const FLAT: &str = "an Int32Array or Float64Array of x, y, …";

/// One point, or several.
pub(crate) enum Points {
    One(Point),
    Several(Vec<Point>),
}

impl Points {
    /// The points of an argument.
    pub(crate) fn read(name: &str, value: &JsValue) -> Result<Self, JsValue> {
        let Some(array) = value.dyn_ref::<Array>() else {
            let several = flat_points(name, value)?.ok_or_else(|| wrong_type(name, POINTS, value))?;
            return Ok(if let [at] = several[..] { Self::One(at) } else { Self::Several(several) });
        };
        if array.length() == 2 {
            let first = item(array, 0)?;
            // By far the most frequent form.
            if first.as_f64().is_some() || !first.is_object() {
                return nearest(name, &first, &item(array, 1)?).map(Self::One);
            }
        }
        let mut several = Vec::new();
        for index in 0..array.length() {
            let value = item(array, index)?;
            let at = one(name, &value)?;
            several.push(at.ok_or_else(|| wrong_type(name, POINTS, &value))?);
        }
        Ok(Self::Several(several))
    }

    pub(crate) fn into_vec(self) -> Vec<Point> {
        match self {
            Self::One(at) => vec![at],
            Self::Several(all) => all,
        }
    }

    pub(crate) fn as_slice(&self) -> &[Point] {
        match self {
            Self::One(at) => std::slice::from_ref(at),
            Self::Several(all) => all,
        }
    }

    /// The points, where they are vertices.
    pub(crate) fn into_vertices(self, name: &str) -> Result<Vec<Vertex>, JsValue> {
        self.into_vec().into_iter().map(|at| whole(name, at)).collect()
    }
}

/// An item of an array, which may be a proxy that throws.
fn item(array: &Array, index: u32) -> Result<JsValue, JsValue> {
    js_sys::Reflect::get_u32(array, index)
}

/// The point of an array of two numbers; `None` for anything else.
fn one(name: &str, value: &JsValue) -> Result<Option<Point>, JsValue> {
    match value.dyn_ref::<Array>() {
        Some(array) if array.length() == 2 => nearest(name, &item(array, 0)?, &item(array, 1)?).map(Some),
        Some(_) => Ok(None),
        None => Ok(flat_points(name, value)?.filter(|points| points.len() == 1).map(|points| points[0])),
    }
}

/// The one point of an argument.
pub(crate) fn point(name: &str, value: &JsValue) -> Result<Point, JsValue> {
    one(name, value)?.ok_or_else(|| wrong_type(name, POINT, value))
}

/// The one vertex of an argument.
pub(crate) fn vertex(name: &str, value: &JsValue) -> Result<Vertex, JsValue> {
    whole(name, point(name, value)?)
}

/// The point as a vertex.
fn whole(name: &str, at: Point) -> Result<Vertex, JsValue> {
    let wrong = || argument(name, &format!("{at} lies between vertices: two whole numbers are expected"));
    at.vertex().ok_or_else(wrong)
}

/// The points of a path.
pub(crate) fn path_points(name: &str, value: &JsValue) -> Result<Vec<Point>, JsValue> {
    flat_points(name, value)?.ok_or_else(|| wrong_type(name, FLAT, value))
}

/// The points of a typed array x, y, …; `None` for anything else.
fn flat_points(name: &str, value: &JsValue) -> Result<Option<Vec<Point>>, JsValue> {
    let pairs = |numbers: u32| {
        let even = || format!("expected an even number of coordinates x, y, …, found {numbers}");
        if numbers.is_multiple_of(2) { Ok(numbers as usize) } else { Err(argument(name, &even())) }
    };
    // A detached array has no numbers, and throws if it is copied.
    if let Some(flat) = value.dyn_ref::<Int32Array>() {
        let mut copy = room(pairs(flat.length())?, 0, name)?;
        if !copy.is_empty() {
            flat.copy_to(&mut copy);
        }
        return Ok(Some(copy.chunks_exact(2).map(|at| Vertex::new(at[0], at[1]).into()).collect()));
    }
    let Some(flat) = value.dyn_ref::<Float64Array>() else { return Ok(None) };
    let mut copy = room(pairs(flat.length())?, 0.0, name)?;
    if !copy.is_empty() {
        flat.copy_to(&mut copy);
    }
    copy.chunks_exact(2).map(|at| rounded(name, at[0], at[1])).collect::<Result<_, _>>().map(Some)
}

/// The point with these coordinates.
fn nearest(name: &str, x: &JsValue, y: &JsValue) -> Result<Point, JsValue> {
    let number = |value: &JsValue| {
        let found = value.as_f64().filter(|found| found.is_finite());
        found.ok_or_else(|| wrong_type(name, POINT, value))
    };
    rounded(name, number(x)?, number(y)?)
}

fn rounded(name: &str, x: f64, y: f64) -> Result<Point, JsValue> {
    Point::nearest(x, y).ok_or_else(|| far_outside(name))
}

/// The error for an end whose numbers are larger than those of any map.
fn far_outside(name: &str) -> JsValue {
    let code = match name {
        "start" => ErrorCode::StartOutside,
        "goal" | "goals" => ErrorCode::GoalOutside,
        _ => ErrorCode::Argument,
    };
    coded(code, &format!("{name}: an x or y beyond that of any map"))
}

/// A number.
pub(crate) fn number(name: &str, value: &JsValue) -> Result<f64, JsValue> {
    value.as_f64().ok_or_else(|| wrong_type(name, "a number", value))
}

/// A number that is not negative, nor none.
pub(crate) fn positive(name: &str, value: &JsValue) -> Result<f64, JsValue> {
    let found = number(name, value)?;
    if found >= 0.0 {
        return Ok(found);
    }
    Err(argument(name, &format!("expected a number of 0 or more, found {found}")))
}

/// The largest integer up to which a number of JavaScript tells all integers apart.
const LARGEST: f64 = 9_007_199_254_740_991.0;

/// A whole number of at least `least`.
pub(crate) fn integer(name: &str, value: &JsValue, least: u32) -> Result<u64, JsValue> {
    let found = value.as_f64().ok_or_else(|| wrong_type(name, "an integer", value))?;
    if found.fract() == 0.0 && found >= f64::from(least) && found <= LARGEST {
        return Ok(found as u64);
    }
    Err(argument(name, &format!("expected an integer of {least} or more, found {found}")))
}

/// A whole number of 32 bits; what is larger is the largest of them.
pub(crate) fn integer_32(name: &str, value: &JsValue, least: u32) -> Result<u32, JsValue> {
    Ok(u32::try_from(integer(name, value, least)?).unwrap_or(u32::MAX))
}

/// True or false.
pub(crate) fn flag(name: &str, value: &JsValue) -> Result<bool, JsValue> {
    value.as_bool().ok_or_else(|| wrong_type(name, "true or false", value))
}

/// A text.
pub(crate) fn text(name: &str, expected: &str, value: &JsValue) -> Result<String, JsValue> {
    value.as_string().ok_or_else(|| wrong_type(name, expected, value))
}

/// A copy of bytes.
pub(crate) fn bytes(name: &str, value: &JsValue) -> Result<Vec<u8>, JsValue> {
    if let Some(array) = value.dyn_ref::<Uint8Array>() {
        let mut copy = room(array.length() as usize, 0, name)?;
        if !copy.is_empty() {
            array.copy_to(&mut copy);
        }
        return Ok(copy);
    }
    if let Some(array) = value.dyn_ref::<Uint8ClampedArray>() {
        let mut copy = room(array.length() as usize, 0, name)?;
        if !copy.is_empty() {
            array.copy_to(&mut copy);
        }
        return Ok(copy);
    }
    Err(wrong_type(name, "a Uint8Array", value))
}

/// A vector of this length, or the error that there is no memory for it.
pub(crate) fn room<T: Clone>(length: usize, value: T, what: &str) -> Result<Vec<T>, JsValue> {
    let mut made = Vec::new();
    made.try_reserve_exact(length).map_err(|_| no_memory(what))?;
    made.resize(length, value);
    Ok(made)
}

/// One of the names of an enum.
pub(crate) fn word<T: FromStr<Err = UnknownName>>(name: &str, value: &JsValue) -> Result<T, JsValue> {
    let known = || "".parse::<T>().err().map_or(String::new(), |error| error.known);
    let text = value.as_string().ok_or_else(|| wrong_type(name, &format!("one of {}", known()), value))?;
    text.parse().map_err(|error| raised_for(name, error))
}

#[wasm_bindgen]
extern "C" {
    /// An object of one of our classes, as far as is known.
    type Ours;

    #[wasm_bindgen(method, catch, js_name = __share)]
    fn share(this: &Ours) -> Result<JsValue, JsValue>;
}

/// The object of one of our classes. It is not taken away from the caller: what is read is a second handle.
pub(crate) fn object<T: TryFromJsValue>(name: &str, class: &str, value: &JsValue) -> Result<T, JsValue> {
    let wrong = || wrong_type(name, &format!("a {class} that was not freed"), value);
    if !value.is_object() {
        return Err(wrong());
    }
    let shared = value.unchecked_ref::<Ours>().share().map_err(|_| wrong())?;
    T::try_from_js_value(shared).map_err(|_| wrong())
}
