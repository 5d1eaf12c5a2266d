//! Every mistake is an error that JavaScript can catch, and none a trap: a trap would end this program.
#![cfg(target_arch = "wasm32")]

mod js;

use js::{call, class, get, json, ok, text, thrown};
use js_sys::{Function, Object, Reflect, Uint8Array};
use mediant_web::{Grid, Picture, Scenario, Trace, World};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_test::wasm_bindgen_test as test;

fn grid() -> JsValue {
    Grid::from_rows(&json(r#"["...#....", ".#.#.##.", ".#...#.."]"#), &JsValue::UNDEFINED)
        .map(JsValue::from)
        .expect("a grid")
}

#[test]
fn mistakes_have_names_and_codes() {
    let grid = grid();
    let planner = ok(&ok(&ok(&grid, "space", &[]), "prepare", &[]), "planner", &[]);
    for (start, goal, wishes, expected) in [
        ("[3, 0]", "[0, 0]", "{}", "MediantError start-blocked"),
        ("[0, 0]", "[3, 0]", "{}", "MediantError goal-blocked"),
        ("[-1, 0]", "[0, 0]", "{}", "MediantError start-outside"),
        ("[0, 0]", "[0, 1e300]", "{}", "MediantError goal-outside"),
        ("[]", "[0, 0]", "{}", "MediantError no-end"),
        ("[0, 0]", "[0, 0.5]", "{}", "MediantError between-vertices"),
        ("[0, 0]", "[0, null]", "{}", "TypeError "),
        ("[0, 0]", "[0, 0, 0]", "{}", "TypeError "),
        ("[0, 0]", "[[0, 0], 3]", "{}", "TypeError "),
        ("[0, 0]", "\"ab\"", "{}", "TypeError "),
        ("[0, 0]", "[0, 0]", "[]", "TypeError "),
        ("[0, 0]", "[0, 0]", "3", "TypeError "),
        ("[0, 0]", "[0, 0]", r#"{"maxcost": 3}"#, "MediantError argument"),
        ("[0, 0]", "[0, 0]", r#"{"k": 3}"#, "MediantError argument"),
        ("[0, 0]", "[0, 0]", r#"{"maxCost": -1}"#, "MediantError argument"),
        ("[0, 0]", "[0, 0]", r#"{"maxExpansions": 1.5}"#, "MediantError argument"),
        ("[0, 0]", "[0, 0]", r#"{"nearest": 1}"#, "TypeError "),
        ("[0, 0]", "[0, 0]", r#"{"timeout": "5"}"#, "TypeError "),
    ] {
        let found = thrown(&planner, "find", &[json(start), json(goal), json(wishes)]);
        assert_eq!(found, expected, "{start} {goal} {wishes}");
    }
    for (motion, expected) in [
        (r#"{"k": 13}"#, "MediantError motion"),
        (r#"{"k": 1}"#, "MediantError k"),
        (r#"{"k": 1e300}"#, "MediantError argument"),
        (r#"{"k": "3"}"#, "TypeError "),
        (r#"{"placement": "centre"}"#, "MediantError unknown-name"),
        (r#"{"placement": "center", "gap": "open"}"#, "MediantError argument"),
        (r#"{"placement": "corner", "corners": "one"}"#, "MediantError argument"),
        (r#"{"k": "any", "placement": "center", "corners": "one"}"#, "MediantError argument"),
    ] {
        assert_eq!(thrown(&grid, "space", &[json(motion)]), expected, "{motion}");
    }
    let unknown = call(&grid, "space", &[json(r#"{"K": 3}"#)]).expect_err("no key K");
    assert!(
        text(&unknown).ends_with("no key 'K' is known; the keys are k, neighbors, placement, corners, gap")
    );
    let space = ok(&grid, "space", &[]);
    assert_eq!(thrown(&space, "prepare", &["star".into()]), "MediantError unknown-name");
    assert_eq!(thrown(&space, "prepare", &["anya".into()]), "MediantError engine-rules");
    let wide = ok(&grid, "space", &[json(r#"{"k": 4}"#)]);
    assert_eq!(thrown(&wide, "prepare", &["jps-block".into()]), "MediantError engine-k");
    assert_eq!(
        thrown(&space, "prepare", &["jps".into(), json(r#"{"side": 3}"#)]),
        "MediantError engine-option"
    );
    assert_eq!(thrown(&space, "prepare", &["jps".into(), JsValue::UNDEFINED, 3.into()]), "TypeError ");
    assert_eq!(
        thrown(&space, "load", &[Uint8Array::new_with_length(9).into()]),
        "MediantError index-damaged"
    );
}

/// Costs in place of cells, and features that are absent, are named where people ask for them.
#[test]
fn costs_of_cells() {
    let wrong = |cells: JsValue| {
        Grid::from_cells(&2.into(), &2.into(), &cells, &JsValue::UNDEFINED).err().map(|error| text(&error))
    };
    let costs = wrong(Uint8Array::from(&[0, 1, 5, 1][..]).into()).expect("a cost is an error");
    assert!(
        costs.starts_with(
            "MediantError argument: blocked: expected 0 (free) or 1 (blocked), found 5 as item 2"
        )
    );
    assert!(
        costs.contains("grid.withCosts(costs) has them; or make cells, for instance Uint8Array.from(costs")
    );
    let clamped = js_sys::Uint8ClampedArray::from(&[0, 0, 255, 0][..]);
    assert!(wrong(clamped.into()).expect("255 is an error").contains("found 255 as item 2"));
    for cells in [
        JsValue::from(js_sys::Float32Array::from(&[1.0, 1.0, 2.5, 1.0][..])),
        js_sys::Float64Array::from(&[1.0, 1.0, 2.5, 1.0][..]).into(),
        js_sys::Uint16Array::from(&[0, 1, 1, 0][..]).into(),
    ] {
        let error = wrong(cells).expect("other numbers are an error");
        assert!(
            error.starts_with("TypeError : blocked: expected a Uint8Array, found another type"),
            "{error}"
        );
        assert!(error.contains("grid.withCosts(costs)"), "{error}");
    }
    assert_eq!(wrong(Uint8Array::from(&[0, 1, 1, 0][..]).into()), None);
    let edit =
        call(&grid(), "edit", &[0.into(), 0.into(), 1.into(), 1.into(), Uint8Array::from(&[9][..]).into()]);
    assert!(text(&edit.expect_err("a cost is an error")).contains("found 9 as item 0"));
    for (key, part) in
        [("weights", "costs of cells"), ("wrap", "does not wrap around"), ("oneWay", "one-way")]
    {
        let motion = json(&format!(r#"{{"{key}": true}}"#));
        let error = text(&call(&grid(), "space", &[motion]).expect_err("an unknown key"));
        assert!(
            error.contains(part) && error.ends_with("; the keys are k, neighbors, placement, corners, gap"),
            "{error}"
        );
    }
}

#[test]
fn sizes_that_no_map_has() {
    let made = |width: f64, height: f64, cells: u32| {
        let cells = Uint8Array::new_with_length(cells);
        let error = Grid::from_cells(&width.into(), &height.into(), &cells, &JsValue::UNDEFINED)
            .err()
            .expect("no grid");
        text(&error).split(':').next().unwrap_or_default().to_owned()
    };
    // 65,536 × 65,536 is 0 in 32 bits.
    assert_eq!(made(65_536.0, 65_536.0, 0), "MediantError map-size");
    assert_eq!(made(32_768.0, 32_768.0, 9), "MediantError argument");
    assert_eq!(made(0.0, 3.0, 0), "MediantError map-size");
    assert_eq!(made(f64::NAN, 3.0, 3), "MediantError argument");
    assert_eq!(made(-3.0, -3.0, 9), "MediantError argument");
    assert_eq!(made(1.5, 2.0, 3), "MediantError argument");
    assert_eq!(made(f64::INFINITY, 1.0, 3), "MediantError argument");
    let edit = |[x, y, width, height]: [f64; 4], cells: u32| {
        let cells = Uint8Array::new_with_length(cells).into();
        call(&grid(), "edit", &[x.into(), y.into(), width.into(), height.into(), cells])
            .map_err(|error| text(&error))
    };
    assert!(edit([7.0, 2.0, 2.0, 2.0], 4).is_ok(), "beyond the map in part");
    assert!(edit([0.0, 0.0, 0.0, 1e9], 0).is_ok(), "no cell");
    assert!(edit([8.0, 0.0, 1.0, 1.0], 1).is_err_and(|error| error.contains("edit-outside")));
    assert!(edit([0.0, 0.0, 65_536.0, 65_536.0], 0).is_err());
    assert!(edit([0.0, 0.0, 9e15, 9e15], 0).is_err());
    // The space of a large map takes more than there is. Without optimization the map takes half a minute.
    if cfg!(debug_assertions) {
        return;
    }
    let cells = Uint8Array::new_with_length(16_000 * 16_000);
    let large = JsValue::from(
        Grid::from_cells(&16_000.into(), &16_000.into(), &cells, &JsValue::UNDEFINED).expect("a grid"),
    );
    assert_eq!(thrown(&large, "space", &[]), "MediantError memory");
    assert_eq!(thrown(&large, "path", &[json("[0, 0]"), json("[1, 0]")]), "MediantError memory");
}

#[test]
fn objects_that_were_freed_and_arrays_that_were_detached() {
    let (grid, other) = (grid(), grid());
    let index = ok(&ok(&grid, "space", &[]), "prepare", &["hpa".into()]);
    let space = ok(&other, "space", &[]);
    ok(&space, "free", &[]);
    assert_eq!(thrown(&index, "repair", std::slice::from_ref(&space)), "TypeError ");
    assert!(call(&space, "isFree", &[json("[0, 0]")]).is_err());
    // An index outlives its grid.
    ok(&grid, "free", &[]);
    assert!(call(&grid, "cells", &[]).is_err());
    assert!(
        get(&ok(&ok(&index, "planner", &[]), "find", &[json("[0, 0]"), json("[1, 0]")]), "path").is_object()
    );
    let detached = Function::new_no_args(
        "const a = new Uint8Array(24); structuredClone(a.buffer, { transfer: [a.buffer] }); return a",
    );
    let detached = detached.call0(&JsValue::UNDEFINED).expect("an array");
    assert!(Grid::from_cells(&8.into(), &3.into(), &detached, &JsValue::UNDEFINED).is_err());
}

/// An object whose getter throws, and one that calls back into what reads it.
#[test]
fn getters_that_throw_and_call_back() {
    let grid = grid();
    let planner = ok(&ok(&ok(&grid, "space", &[]), "prepare", &["astar".into()]), "planner", &[]);
    let throws = Function::new_no_args("return { get nearest() { throw new Error('mine') } }");
    let wishes = throws.call0(&JsValue::UNDEFINED).expect("an object");
    let error =
        call(&planner, "find", &[json("[0, 0]"), json("[7, 0]"), wishes]).expect_err("the getter throws");
    assert_eq!(get(&error, "message"), "mine");
    let back = Function::new_with_args(
        "planner",
        "return { get nearest() { planner.find([0, 0], [1, 0]); return true } }",
    );
    let wishes = back.call1(&JsValue::UNDEFINED, &planner).expect("an object");
    assert_eq!(get(&ok(&planner, "find", &[json("[0, 0]"), json("[7, 0]"), wishes]), "status"), "found");
    let keys = Function::new_no_args("return new Proxy({}, { ownKeys() { throw new Error('mine') } })");
    let wishes = keys.call0(&JsValue::UNDEFINED).expect("an object");
    assert!(call(&planner, "find", &[json("[0, 0]"), json("[7, 0]"), wishes]).is_err());
    let point = Function::new_no_args(
        "const a = [0, 0]; Object.defineProperty(a, 0, { get() { throw 5 } }); return a",
    );
    let point = point.call0(&JsValue::UNDEFINED).expect("an array");
    assert_eq!(call(&planner, "find", &[point, json("[7, 0]")]), Err(5.into()));
    // A listener that prepares in turn.
    let space = ok(&grid, "space", &[]);
    let nested =
        Function::new_with_args("space", "return () => { space.prepare('jps'); space.prepare('subgoal') }");
    let nested = nested.call1(&JsValue::UNDEFINED, &space).expect("a function");
    ok(&space, "prepare", &["subgoal".into(), JsValue::UNDEFINED, nested]);
}

/// Values that nobody would pass on purpose.
fn odd_values() -> Vec<JsValue> {
    [
        "null",
        "true",
        "0",
        "1",
        "-1",
        "0.5",
        "2147483648",
        "-2147483649",
        "4294967296",
        "1e300",
        "\"\"",
        "\"any\"",
        "\"subgoal\"",
        "\"corner\"",
        "[]",
        "[0]",
        "[0, 0]",
        "[1, 1]",
        "[-1, 9]",
        "[3e9, 0]",
        "[0, 0, 0]",
        "[[0, 0], [1, 1]]",
        "{}",
        r#"{"k": 2}"#,
        r#"{"nearest": true}"#,
        r#"{"constructor": 1}"#,
        r#"["..", ".#"]"#,
    ]
    .map(json)
    .into_iter()
    .chain([JsValue::UNDEFINED, f64::NAN.into(), f64::INFINITY.into(), f64::NEG_INFINITY.into()])
    .chain([Uint8Array::new_with_length(0).into(), Uint8Array::from(&b"P1 1 1 0"[..]).into()])
    .chain([
        js_sys::Int32Array::from(&[0, 0, 1][..]).into(),
        js_sys::Int32Array::from(&[0, 0, i32::MAX, i32::MIN][..]).into(),
    ])
    .chain([
        js_sys::BigInt::from(5).into(),
        js_sys::Symbol::iterator().into(),
        Function::new_no_args("").into(),
    ])
    .collect()
}

/// Every method with odd values in every place: each call ends, with a value or an error.
#[test]
fn odd_values_everywhere() {
    let grid = grid();
    let space = ok(&grid, "space", &[json(r#"{"placement": "corner"}"#)]);
    let index = ok(&space, "prepare", &["subgoal".into()]);
    let planner = ok(&index, "planner", &[]);
    let field = ok(&space, "field", &[json("[0, 0]")]);
    let trace = JsValue::from(Trace::new(&JsValue::TRUE).expect("a trace"));
    let picture = JsValue::from(Picture::new(&grid, &"corner".into()).expect("a picture"));
    ok(&picture, "largestSide", &[64.into()]);
    let goals = ok(&index, "goals", &[json("[[8, 3], [0, 0]]")]);
    let size = [get(&grid, "width"), get(&grid, "height")];
    let world = World::new(&size[0], &size[1], &0.5.into(), &json("[1, 2]")).map(JsValue::from);
    let world = world.expect("a world");
    let scenario = b"version 1\n0 a 8 3 0 0 7 0 11\n";
    let scenario = JsValue::from(Scenario::read(&Uint8Array::from(&scenario[..])).expect("a scenario"));
    let ours = [&grid, &space, &planner, &trace, &field, &goals, &world].map(Clone::clone);
    let odd: Vec<JsValue> = odd_values().into_iter().chain(ours).collect();
    let class = class(&grid);
    let more = [&world, &scenario];
    let objects = [&grid, &class, &space, &index, &planner, &field, &trace, &picture, &goals];
    let mut calls = 0_u32;
    for object in objects.into_iter().chain(more) {
        for method in methods(object) {
            for (number, first) in odd.iter().enumerate() {
                let other = |step: usize| odd[(number * step + step) % odd.len()].clone();
                for arguments in [
                    vec![first.clone()],
                    vec![json("[0, 0]"), first.clone(), other(3)],
                    vec![json("[0, 0]"), json("[1, 0]"), first.clone(), other(7)],
                    vec![0.into(), 0.into(), 1.into(), first.clone(), other(5)],
                    vec![first.clone(), other(2), other(5), other(11), other(13)],
                ] {
                    if let Err(error) = call(object, &method, &arguments) {
                        let text = text(&error);
                        assert!(
                            !text.contains("RuntimeError") && !text.contains("unreachable"),
                            "{method}: {text}"
                        );
                    }
                    calls += 1;
                }
            }
        }
    }
    assert!(calls > 8000, "{calls}");
    // Everything is still in order.
    assert!(get(&ok(&planner, "find", &[json("[0, 0]"), json("[8, 3]")]), "path").is_object());
}

/// The methods of an object of our classes, or of a class itself.
fn methods(object: &JsValue) -> Vec<String> {
    let of = if object.is_function() {
        object.clone()
    } else {
        Reflect::get_prototype_of(object).expect("one").into()
    };
    let names = Object::get_own_property_names(of.unchecked_ref::<Object>());
    let is_ours = |name: &String| {
        let other = ["free", "constructor", "prototype", "length", "name", "__wrap", "__destroy_into_raw"];
        !other.contains(&name.as_str())
    };
    let names = names.iter().filter_map(|name| name.as_string()).filter(is_ours);
    let is_method = |name: &String| {
        let described = Object::get_own_property_descriptor(of.unchecked_ref::<Object>(), &name.into());
        !described.is_undefined() && get(&described, "value").is_function()
    };
    names.filter(is_method).collect()
}
