//! The answer to a query, and values that go out.

use js_sys::{Float64Array, Int32Array, Object, Reflect};
use mediant::{Answer, Guarantee, Motion, Path, Point, Rules, Status};
use wasm_bindgen::{JsCast, prelude::*};

use crate::types::{JsAnswer, JsMotion, JsWaypoints};

/// An object with these keys; those without a value are left out.
pub(crate) fn object_of<T: JsCast>(entries: impl IntoIterator<Item = (&'static str, Option<JsValue>)>) -> T {
    let object = Object::new();
    for (key, value) in entries {
        if let Some(value) = value {
            // An object that was just made takes every key.
            _ = Reflect::set(&object, &key.into(), &value);
        }
    }
    object.unchecked_into()
}

/// The waypoints of a path, x, y, …: a `Float64Array` if one of them is no vertex.
pub(crate) fn flat(path: &Path) -> JsWaypoints {
    points(path.points())
}

/// Points x, y, …, likewise.
pub(crate) fn points(points: impl Iterator<Item = Point> + Clone) -> JsWaypoints {
    let whole = points.clone().flat_map(|at| at.vertex().map_or([None; 2], |at| [Some(at.x), Some(at.y)]));
    match whole.collect::<Option<Vec<i32>>>() {
        Some(flat) => Int32Array::from(&flat[..]).unchecked_into(),
        None => {
            let flat: Vec<f64> = points.flat_map(|at| [at.x(), at.y()]).collect();
            Float64Array::from(&flat[..]).unchecked_into()
        }
    }
}

/// A point as [x, y].
pub(crate) fn pair(at: impl Into<Point>) -> js_sys::Array {
    let at = at.into();
    js_sys::Array::of2(&at.x().into(), &at.y().into())
}

thread_local! {
    /// The words of all statuses, made once.
    static STATUSES: [JsValue; Status::ALL.len()] = Status::ALL.map(|status| status.name().into());
}

/// The answer of an engine with this guarantee under these rules as an object. It is made key by key through
/// setters, which take a fifth of the time of keys that are texts: a query can take microseconds.
pub(crate) fn told(answer: &Answer, (guarantee, rules): (Guarantee, Rules)) -> JsAnswer {
    let object = Object::new().unchecked_into::<JsAnswer>();
    STATUSES.with(|statuses| object.set_status(&statuses[answer.status() as usize]));
    if let Some(path) = answer.path() {
        object.set_path(&flat(path));
    }
    object.set_distance(answer.distance(guarantee));
    if let (Guarantee::Cheapest(_), Some(path)) = (guarantee, answer.path()) {
        object.set_cost(path.cost());
        object.set_length(path.length());
    }
    object.set_lower_bound(answer.lower_bound(guarantee));
    if let Some(bound) = answer.any_angle_lower_bound(guarantee, rules) {
        object.set_any_angle_lower_bound(bound);
    }
    if let Some(limit) = answer.stopped_by() {
        object.set_stopped_by(limit.name());
    }
    if let Some(best) = answer.best() {
        object.set_best(&flat(best));
    }
    object
}

/// Motion as an object with every key that it has.
pub(crate) fn motion(motion: Motion) -> JsMotion {
    let k = motion.k.finite().map_or_else(|| JsValue::from("any"), |k| k.get().into());
    let (corners, gap) = match motion.rules {
        Rules::Center(rule) => (Some(rule.name().into()), None),
        Rules::Corner(gap) | Rules::CenterGap(gap) => (None, Some(gap.name().into())),
    };
    object_of([
        ("k", Some(k)),
        ("placement", Some(motion.rules.placement().name().into())),
        ("corners", corners),
        ("gap", gap),
    ])
}
