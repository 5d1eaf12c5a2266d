//! The answer to a query, and values that go out.

use js_sys::{Int32Array, Object, Reflect};
use mediant::{Guarantee, Limit, Motion, Outcome, Path, Rules, Stopped, Vertex};
use wasm_bindgen::{JsCast, prelude::*};

use crate::types::{JsAnswer, JsMotion};

/// The name of a limit.
const fn limit_name(limit: Limit) -> &'static str {
    match limit {
        Limit::Cost => "cost",
        Limit::Expansions => "expansions",
        _ => "timeout",
    }
}

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

/// The waypoints of a path, x, y, ….
pub(crate) fn flat(path: &Path) -> Int32Array {
    let flat: Vec<i32> = path.waypoints().iter().flat_map(|at| [at.x, at.y]).collect();
    Int32Array::from(&flat[..])
}

/// A vertex as [x, y].
pub(crate) fn pair(at: Vertex) -> js_sys::Array {
    js_sys::Array::of2(&at.x.into(), &at.y.into())
}

/// The words of answers, made once.
struct Words {
    found: JsValue,
    unreachable: JsValue,
    nearest: JsValue,
    stopped: JsValue,
}

thread_local! {
    static WORDS: Words = Words {
        found: "found".into(),
        unreachable: "unreachable".into(),
        nearest: "nearest".into(),
        stopped: "stopped".into(),
    };
}

/// The answer of an engine with this guarantee as an object. It is made key by key through setters, which
/// take a fifth of the time of keys that are texts: a query can take microseconds.
pub(crate) fn answer(outcome: &Outcome, guarantee: Guarantee) -> JsAnswer {
    let answer: JsAnswer = Object::new().unchecked_into();
    WORDS.with(|words| {
        answer.set_status(match outcome {
            Outcome::Found(_) => &words.found,
            Outcome::Nearest(_) => &words.nearest,
            Outcome::Stopped(_) => &words.stopped,
            _ => &words.unreachable,
        });
    });
    if let Some(path) = outcome.path() {
        answer.set_path(flat(path));
    }
    answer.set_distance(match outcome {
        Outcome::Unreachable => f64::INFINITY,
        // The same number as that of tables and fields.
        outcome => outcome.path().map_or(f64::NAN, |path| guarantee.length(path)),
    });
    answer.set_lower_bound(match outcome {
        Outcome::Stopped(Stopped { lower_bound, .. }) => *lower_bound,
        Outcome::Found(path) if matches!(guarantee, Guarantee::Optimal(_) | Guarantee::OptimalAnyAngle) => {
            guarantee.length(path)
        }
        Outcome::Found(_) => 0.0,
        _ => f64::INFINITY,
    });
    if let Outcome::Stopped(Stopped { by, best, .. }) = outcome {
        answer.set_stopped_by(limit_name(*by));
        answer.set_best(flat(best));
    }
    answer
}

/// Motion as an object with every key that it has.
pub(crate) fn motion(motion: Motion) -> JsMotion {
    let k = motion.k.finite().map_or_else(|| JsValue::from("any"), |k| k.get().into());
    let (corners, gap) = match motion.rules {
        Rules::Center(rule) => (Some(rule.to_string().into()), None),
        Rules::Corner(gap) => (None, Some(gap.to_string().into())),
    };
    object_of([
        ("k", Some(k)),
        ("placement", Some(motion.rules.placement().to_string().into())),
        ("corners", corners),
        ("gap", gap),
    ])
}
