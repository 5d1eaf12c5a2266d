//! Functions that need no map.

use js_sys::{Array, Float64Array, Int32Array};
use mediant::{
    Engine, ErrorCode, Guarantee, Motion, Path, Setup, call::Spelling, moves::Neighborhood,
    options::ConfiguredEngine,
};
use wasm_bindgen::{JsCast, prelude::*};

use crate::{
    answer::object_of,
    arguments::{number, path_points},
    errors::{argument, coded, raised},
    keywords::{Keywords, MOTION, OPTIONS, call_error, read_engine},
    memory,
    types::JsEngines,
};

/// The moves of N(k) in angular order: x, y, …, 2^k of them.
///
/// ```js
/// moves(2); // Int32Array [0, 1, …]
/// ```
///
/// @throws MediantError `k` for a k below 2, `argument` for one above 12.
#[wasm_bindgen]
pub fn moves(#[wasm_bindgen(unchecked_param_type = "number")] k: &JsValue) -> Result<Int32Array, JsValue> {
    let finite = Keywords::default().with("k", k)?.motion()?.k.finite().filter(|k| k.get() <= Motion::MAX_K);
    let finite = finite.ok_or_else(|| argument("k", "expected an integer from 2 to 12"))?;
    let neighborhood = Neighborhood::new(finite).map_err(raised)?;
    let steps = (0..neighborhood.len()).filter_map(|index| neighborhood.get(index));
    let flat: Vec<i32> = steps.flat_map(|step| [step.x, step.y]).collect();
    Ok(Int32Array::from(&flat[..]))
}

/// An upper bound on the length of a shortest path over N(k), as a multiple of the shortest at any angle:
/// 1.0824 is 8.24 % longer. Undefined where none is proven.
///
/// @throws MediantError `k` for a k below 2.
#[wasm_bindgen]
pub fn bound(
    #[wasm_bindgen(unchecked_param_type = "Motion")] motion: &JsValue,
) -> Result<Option<f64>, JsValue> {
    let Motion { k, rules, .. } = Keywords::read("motion", motion, MOTION)?.motion()?;
    let guarantee = k.finite().map_or(Guarantee::OptimalAnyAngle, Guarantee::Optimal);
    Ok(guarantee.bound(rules))
}

/// Points along a path, x, y, …, evenly spaced: so many cells apart as measured along it. The first one is
/// the start, the last one the end: the last step is shorter unless the length is a multiple of the spacing.
///
/// ```js
/// spaced(Int32Array.of(0, 0, 2, 0, 2, 1), 1.25); // Float64Array [0, 0, 1.25, 0, 2, 0.5, 2, 1]
/// ```
///
/// @throws MediantError `number` for a spacing of 0 or less, `memory` if there is no room for the points.
#[wasm_bindgen]
pub fn spaced(
    #[wasm_bindgen(unchecked_param_type = "Waypoints")] path: &JsValue,
    #[wasm_bindgen(unchecked_param_type = "number")] spacing: &JsValue,
) -> Result<Float64Array, JsValue> {
    let (path, spacing) = (Path::through(path_points("path", path)?), number("spacing", spacing)?);
    let points = path.spaced(spacing).map_err(|error| coded(ErrorCode::Number, &error.to_string()))?;
    // It saturates.
    let most = ((path.cost() / spacing) as u64).saturating_add(3);
    memory::check("the points", most, 16)?;
    let mut flat = Vec::with_capacity(2 * most as usize);
    flat.extend(points.flat_map(|(x, y)| [x, y]));
    Ok(Float64Array::from(&flat[..]))
}

/// All engines of this module, with what each can do.
#[wasm_bindgen]
pub fn engines() -> JsEngines {
    let all: Array = Engine::ALL.into_iter().filter(|engine| engine.is_built()).map(info).collect();
    all.unchecked_into()
}

fn texts(all: impl IntoIterator<Item = String>) -> JsValue {
    all.into_iter().map(JsValue::from).collect::<Array>().into()
}

fn info(engine: Engine) -> JsValue {
    let can = engine.capabilities();
    let options = ConfiguredEngine::from(engine).options().into_iter();
    object_of([
        ("name", Some(engine.name().into())),
        ("placements", Some(texts(can.placements.iter().map(ToString::to_string)))),
        ("maxK", Some(can.max_k.into())),
        ("any", Some(can.any.into())),
        ("costs", Some((cfg!(feature = "full") && can.costs).into())),
        ("title", Some(can.title.into())),
        ("how", Some(can.how.into())),
        ("guarantee", Some(can.guarantee.name().into())),
        ("paper", Some(can.paper.into())),
        ("index", Some(can.index.is_some().into())),
        (
            "options",
            Some(texts(
                options.map(|option| Spelling::Camel.spell(option.name)).chain(["smooth".to_owned()]),
            )),
        ),
    ])
}

/// Why an engine does not go together with a motion and options, in a sentence; undefined if it does.
///
/// ```js
/// checkSetup("jps-block", { k: 4 }); // "jps-block needs a k from 2 to 3, found 4 (16 neighbors)"
/// ```
///
/// @throws MediantError `unknown-name` for an engine that does not exist.
#[wasm_bindgen(js_name = checkSetup)]
pub fn check_setup(
    #[wasm_bindgen(unchecked_param_type = "string")] engine: &JsValue,
    #[wasm_bindgen(unchecked_param_type = "Motion")] motion: &JsValue,
    #[wasm_bindgen(unchecked_optional_param_type = "Options")] options: &JsValue,
) -> Result<Option<String>, JsValue> {
    let Some(engine) = read_engine(engine)? else {
        return Err(crate::errors::wrong_type("engine", "the name of an engine", engine));
    };
    let keywords = Keywords::read("options", options, OPTIONS)?.and("motion", motion, MOTION)?;
    let call = keywords.call.with_engine(Some(engine));
    let motion = call.motion().map_err(call_error)?;
    let wrong = call.configured(engine).and_then(|own| Setup::new(own, motion).check());
    Ok(wrong.err().map(|wrong| wrong.to_string()))
}

/// The version of the package.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}
