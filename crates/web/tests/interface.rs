//! The interface as JavaScript sees it, under node.
#![cfg(target_arch = "wasm32")]

mod js;

use js::{call, class, get, json, numbers, ok, text, thrown};
use js_sys::{Array, Function, Reflect, Uint8Array, Uint32Array};
use mediant_web::{Grid, Picture, Scenario, Trace, World};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_test::wasm_bindgen_test as test;

const NONE: JsValue = JsValue::UNDEFINED;

/// A map whose way from (0, 0) to (7, 0) is 11 long.
fn grid() -> JsValue {
    grid_of(r#"["...#....", ".#.#.##.", ".#...#.."]"#)
}

fn grid_of(rows: &str) -> JsValue {
    Grid::from_rows(&json(rows), &NONE).unwrap_or_else(|error| panic!("{}", text(&error))).into()
}

fn at(x: i32, y: i32) -> JsValue {
    Array::of2(&x.into(), &y.into()).into()
}

fn bytes(all: &[u8]) -> JsValue {
    Uint8Array::from(all).into()
}

fn planner(grid: &JsValue, motion: &str, engine: &str) -> JsValue {
    let space = ok(grid, "space", &[json(motion)]);
    ok(&ok(&space, "prepare", &[engine.into()]), "planner", &[])
}

#[test]
fn paths_at_once() {
    let grid = grid();
    let way = [0, 0, 2, 0, 2, 2, 4, 2, 4, 0, 7, 0];
    assert_eq!(numbers(&ok(&grid, "path", &[at(0, 0), at(7, 0)])), way);
    // Again, on what the grid has kept; with other forms of points; and with other motion.
    let flat = js_sys::Int32Array::from(&[7, 0][..]).into();
    assert_eq!(numbers(&ok(&grid, "path", &[at(0, 0), flat])), way);
    let any = numbers(&ok(&grid, "path", &[at(0, 0), at(8, 3), json(r#"{"k": "any"}"#)]));
    assert_eq!((&any[..2], &any[any.len() - 2..]), (&[0, 0][..], &[8, 3][..]));
    let several = ok(&grid, "path", &[json("[[0, 0], [6, 0]]"), json("[[7, 0], [4, 0]]")]);
    assert_eq!(numbers(&several), [6, 0, 7, 0]);
    let closed = grid_of(r#"["..#."]"#);
    assert!(ok(&closed, "path", &[at(0, 0), at(3, 0)]).is_undefined());
    let nearest = json(r#"{"nearest": true, "engine": "astar", "heuristic": "euclidean"}"#);
    assert_eq!(numbers(&ok(&closed, "path", &[at(0, 0), at(3, 0), nearest])), [0, 0, 1, 0]);
    let stopped = json(r#"{"maxExpansions": 1}"#);
    assert_eq!(thrown(&grid, "path", &[at(0, 0), at(7, 0), stopped]), "MediantError stopped");
}

#[test]
fn grids() {
    let grid = grid();
    assert_eq!((get(&grid, "width").as_f64(), get(&grid, "height").as_f64()), (Some(8.0), Some(3.0)));
    let cells: Uint8Array = ok(&grid, "cells", &[]).unchecked_into();
    let same = Grid::from_cells(&8.into(), &3.into(), &cells, &NONE).map(JsValue::from).expect("a grid");
    assert_eq!(get(&grid, "id"), get(&same, "id"));
    let edited = ok(&grid, "edit", &[3.into(), 0.into(), 1.into(), 1.into(), bytes(&[0])]);
    assert_eq!(ok(&edited, "isBlocked", &[3.into(), 0.into()]), JsValue::FALSE);
    assert_eq!(ok(&grid, "isBlocked", &[3.into(), 0.into()]), JsValue::TRUE);
    assert_eq!(ok(&grid, "isBlocked", &[f64::NAN.into(), 0.into()]), JsValue::TRUE);
    let map = ok(&grid, "toMap", &[]).as_string().expect("a text");
    let read = ok(&class(&grid), "read", &["a.map".into(), bytes(map.as_bytes())]);
    assert_eq!(get(&grid, "id"), get(&read, "id"));
    let clearance: js_sys::Float64Array = ok(&grid, "clearance", &[]).unchecked_into();
    assert_eq!(clearance.to_vec()[..4], [0.5, 0.5, 0.5, 0.0]);
    let disc = ok(&grid, "forDisc", &[0.6.into()]);
    assert_eq!(ok(&disc, "isBlocked", &[0.into(), 0.into()]), JsValue::TRUE);
    assert_eq!(ok(&ok(&grid, "forSquare", &[2.into()]), "isBlocked", &[0.into(), 0.into()]), JsValue::TRUE);
}

#[test]
fn files_in_memory() {
    let class = class(&grid());
    let yaml = "image: room.pgm\nresolution: 0.5\norigin: [1, 2, 0]\nnegate: 0\n\
        occupied_thresh: 0.65\nfree_thresh: 0.25\n";
    let pgm = bytes(b"P2 2 1 255  254 0");
    let files = js_sys::Object::new();
    Reflect::set(&files, &"room.pgm".into(), &pgm).expect("an object");
    let arguments = ["maps/room.yaml".into(), bytes(yaml.as_bytes()), files.into()];
    let room = ok(&class, "read", &arguments);
    assert_eq!(Uint8Array::from(ok(&room, "cells", &[])).to_vec(), [0, 1]);
    assert_eq!(Array::from(&ok(&class, "size", &arguments)).join(","), "2,1");
    assert_eq!(thrown(&class, "read", &arguments[..2]), "MediantError file-missing");
    let inverted =
        ok(&class, "read", &["x".into(), pgm, NONE, json(r#"{"invert": true, "threshold": 0.3}"#)]);
    assert_eq!(Uint8Array::from(ok(&inverted, "cells", &[])).to_vec(), [1, 0]);
    // By ROS 1 the end of the scale is unknown, by nav2 since 2025 it is free.
    let yaml = yaml.replace("0.25", "0");
    let white = js_sys::Object::new();
    Reflect::set(&white, &"room.pgm".into(), &bytes(b"P2 2 1 255  255 0")).expect("an object");
    for (options, cells) in [("{}", [0, 1]), (r#"{"ros": 2}"#, [0, 1]), (r#"{"ros": 1}"#, [1, 1])] {
        let arguments = ["room.yaml".into(), bytes(yaml.as_bytes()), white.clone().into(), json(options)];
        assert_eq!(Uint8Array::from(ok(&ok(&class, "read", &arguments), "cells", &[])).to_vec(), cells);
    }
    let lake = bytes(b"type octile\nheight 1\nwidth 4\nmap\n.wW@\n");
    let water = ok(&class, "read", &["a.map".into(), lake, NONE, json(r#"{"free": "W"}"#)]);
    assert_eq!(Uint8Array::from(ok(&water, "cells", &[])).to_vec(), [1, 0, 0, 1]);
    let rows = || js_sys::JSON::parse(r##"["#  #"]"##).expect("JSON");
    assert_eq!(thrown(&class, "fromRows", &[rows()]), "MediantError map-tile");
    let hall = ok(&class, "fromRows", &[rows(), json(r#"{"free": " "}"#)]);
    assert_eq!(Uint8Array::from(ok(&hall, "cells", &[])).to_vec(), [1, 0, 0, 1]);
    // The size of a map that nobody could make here.
    let huge = bytes(b"P5 16384 16384 255 ");
    assert_eq!(Array::from(&ok(&class, "size", &["x".into(), huge.clone()])).join(","), "16384,16384");
    assert_eq!(thrown(&class, "read", &["x".into(), huge]), "MediantError map-format");
}

#[test]
fn spaces_and_indexes() {
    let grid = grid();
    let space = ok(&grid, "space", &[json(r#"{"k": 3}"#)]);
    let motion = js_sys::JSON::stringify(&get(&space, "motion")).expect("JSON");
    assert_eq!(motion, r#"{"k":3,"placement":"center","corners":"never"}"#);
    let eight = ok(&grid, "space", &[json(r#"{"neighbors": 8}"#)]);
    assert_eq!(js_sys::JSON::stringify(&get(&eight, "motion")).expect("JSON"), motion);
    let both = json(r#"{"neighbors": 8, "k": 3}"#);
    assert_eq!(thrown(&grid, "space", &[both]), "MediantError argument");
    assert_eq!(thrown(&grid, "space", &[json(r#"{"neighbors": 6}"#)]), "MediantError k");
    // Engines as people write them.
    assert_eq!(get(&ok(&space, "prepare", &["JPS+".into()]), "setup"), "jps-plus:3:never");
    // The motion of a space makes the same space.
    ok(&grid, "space", &[get(&space, "motion")]);
    assert_eq!(ok(&space, "isFree", &[at(3, 0)]), JsValue::FALSE);
    assert_eq!(ok(&space, "sees", &[at(0, 0), at(2, 0)]), JsValue::TRUE);
    assert_eq!(ok(&space, "connected", &[at(0, 0), at(7, 2)]), JsValue::TRUE);
    let path = ok(&grid, "path", &[at(0, 0), at(7, 0)]);
    assert_eq!(ok(&space, "holds", std::slice::from_ref(&path)), JsValue::TRUE);
    let along = |space: &JsValue, name, path: &[i32]| {
        let path = js_sys::Int32Array::from(path).into();
        js_sys::Int32Array::from(ok(space, name, &[path])).to_vec()
    };
    assert_eq!(along(&space, "vertices", &[0, 0, 2, 0]), [0, 0, 1, 0, 2, 0]);
    assert_eq!(along(&space, "touchedCells", &[0, 0, 1, 1]), [0, 0, 1, 0, 0, 1, 1, 1]);
    let corners = ok(&grid, "space", &[json(r#"{"k": "any"}"#)]);
    assert_eq!(along(&corners, "touchedCells", &[0, 1, 1, 1]), [0, 0, 0, 1]);
    let far: JsValue = js_sys::Int32Array::from(&[i32::MIN, 0, i32::MAX, 0][..]).into();
    assert_eq!(thrown(&space, "vertices", std::slice::from_ref(&far)), "MediantError memory");
    assert_eq!(thrown(&space, "touchedCells", &[far]), "MediantError memory");
    let block = [2.into(), 1.into(), 1.into(), 1.into(), bytes(&[1])];
    let edited = ok(&space, "edit", &block);
    assert_eq!(ok(&edited, "holds", std::slice::from_ref(&path)), JsValue::FALSE);
    assert_eq!(thrown(&edited, "check", &[path]), "MediantError broken-path");
    assert_eq!(get(&ok(&space, "engine", &[]), "engine"), "subgoal");
    // Prepared, heard, saved, loaded, repaired.
    let heard = Array::new();
    let listener = Function::new_with_args("heard", "return stage => heard.push(stage)");
    let listener = listener.call1(&NONE, &heard).expect("a function");
    let index = ok(&space, "prepare", &[NONE, NONE, listener]);
    assert!(heard.length() > 0 && heard.get(0) == "edges");
    assert_eq!(
        (get(&index, "setup"), get(&index, "guarantee")),
        ("subgoal:3:never".into(), "optimal(3)".into())
    );
    let loaded = ok(&space, "load", &[ok(&index, "toBytes", &[])]);
    assert_eq!(get(&loaded, "origin"), "loaded");
    assert_eq!(thrown(&edited, "load", &[ok(&index, "toBytes", &[])]), "MediantError mismatch");
    let hpa = ok(&space, "prepare", &["hpa".into(), json(r#"{"side": 4}"#)]);
    let repaired = ok(&hpa, "repair", std::slice::from_ref(&edited));
    assert_eq!((get(&repaired, "origin"), get(&repaired, "optimal")), ("repaired".into(), JsValue::FALSE));
    let answer = ok(&ok(&repaired, "planner", &[]), "find", &[at(0, 0), at(7, 0)]);
    assert_eq!(get(&answer, "status"), "unreachable");
    let other = ok(&grid, "space", &[json(r#"{"k": 2}"#)]);
    assert_eq!(thrown(&hpa, "repair", &[other]), "MediantError mismatch");
    // The error of a listener comes out, and the space is as it was.
    let throws = Function::new_no_args("throw new Error('enough')").into();
    let error = call(&space, "prepare", &[NONE, NONE, throws]).expect_err("the listener throws");
    assert_eq!(get(&error, "message"), "enough");
    ok(&space, "prepare", &[]);
}

#[test]
fn planners_follow() {
    let space = ok(&grid(), "space", &[json(r#"{"k": 3}"#)]);
    let edited = ok(&space, "edit", &[2.into(), 1.into(), 1.into(), 1.into(), bytes(&[1])]);
    let hpa = ok(&space, "prepare", &["hpa".into(), json(r#"{"side": 4}"#)]);
    let repaired = ok(&hpa, "repair", std::slice::from_ref(&edited));
    let answer = ok(&ok(&repaired, "planner", &[]), "find", &[at(0, 0), at(7, 0)]);
    // Labels of the map before answer where they prove it, until all is made anew.
    let labels = ok(&space, "prepare", &["subgoal".into()]);
    assert_eq!(get(&labels, "isFinished"), JsValue::TRUE);
    let unfinished = ok(&labels, "repair", std::slice::from_ref(&edited));
    assert_eq!(get(&unfinished, "isFinished"), JsValue::FALSE);
    let asked = ok(&unfinished, "planner", &[]);
    let found = ok(&asked, "find", &[at(0, 0), at(1, 0)]);
    assert_eq!((get(&found, "status"), get(&asked, "searchedBy")), ("found".into(), "subgoal".into()));
    assert_eq!(get(&ok(&unfinished, "finish", &[]), "isFinished"), JsValue::TRUE);
    // A planner of the index before goes on with the repaired one.
    let follower = ok(&hpa, "planner", &[]);
    ok(&follower, "begin", &[at(0, 0), at(7, 0)]);
    assert!(ok(&follower, "follow", std::slice::from_ref(&repaired)).is_undefined());
    assert_eq!(thrown(&follower, "step", &[1.into()]), "MediantError not-begun");
    let followed = ok(&follower, "find", &[at(0, 0), at(7, 0)]);
    assert_eq!(get(&followed, "distance"), get(&answer, "distance"));
    let astar = ok(&space, "prepare", &["astar".into()]);
    assert_eq!(thrown(&follower, "follow", &[astar]), "MediantError engine-option");
    assert_eq!(thrown(&follower, "follow", &[space.clone()]), "TypeError ");
}

#[test]
fn steps_and_traces() {
    let grid = grid();
    let planner = planner(&grid, "{}", "astar");
    let trace = JsValue::from(Trace::new(&JsValue::TRUE).expect("a trace"));
    let at_once = ok(&planner, "find", &[at(0, 0), at(7, 0), NONE, trace.clone()]);
    let steps = Uint32Array::from(ok(&trace, "steps", &[])).to_vec();
    let expanded = steps.iter().filter(|&step| step % 2 == 1).count();
    assert_eq!(get(&trace, "expanded").as_f64(), Some(expanded as f64));
    assert_eq!((steps[0], steps[1]), (0, 1), "the start is generated, then expanded");
    let tail = Uint32Array::from(ok(&trace, "steps", &[2.into()])).to_vec();
    assert_eq!(tail, steps[2..]);
    // The same in steps.
    let text = ok(&trace, "posthoc", &[planner.clone(), at(0, 0), at(7, 0)]).as_string().expect("a text");
    assert!(text.contains(r#"{"type":"source","id":1,"#) && text.contains(r#""type":"end""#));
    js_sys::JSON::parse(&text).expect("the trace is JSON");
    ok(&trace, "clear", &[]);
    ok(&planner, "begin", &[at(0, 0), at(7, 0)]);
    let (mut lower, mut count) = (0.0, 0.0);
    let answer = loop {
        let answer = ok(&planner, "step", &[1.into(), trace.clone()]);
        if !answer.is_undefined() {
            break answer;
        }
        let now = get(&planner, "lowerBound").as_f64().expect("a number");
        assert!(now >= lower && ok(&planner, "best", &[]).is_object());
        lower = now;
        assert_eq!(numbers(&ok(&planner, "pathTo", &[at(0, 0)])), [0, 0]);
        assert!(ok(&planner, "pathTo", &[at(7, 2)]).is_undefined(), "it is far away");
        count += 1.0;
        assert_eq!(get(&planner, "expansions").as_f64(), Some(count));
    };
    assert_eq!(numbers(&get(&answer, "path")), numbers(&get(&at_once, "path")));
    assert_eq!(Uint32Array::from(ok(&trace, "steps", &[])).to_vec(), steps);
    // Finished, stopped, not begun.
    ok(&planner, "begin", &[at(0, 0), at(7, 0)]);
    assert_eq!(get(&ok(&planner, "finish", &[]), "distance").as_f64(), Some(11.0));
    let stopped = ok(&planner, "find", &[at(0, 0), at(7, 0), json(r#"{"maxExpansions": 2}"#)]);
    assert_eq!(
        (get(&stopped, "status"), get(&stopped, "stoppedBy")),
        ("stopped".into(), "expansions".into())
    );
    assert!(get(&stopped, "distance").as_f64().is_some_and(f64::is_nan) && get(&stopped, "best").is_object());
    let late = ok(&planner, "find", &[at(0, 0), at(7, 0), json(r#"{"timeout": 0}"#)]);
    assert_eq!(get(&late, "stoppedBy"), "timeout");
    let fresh = self::planner(&grid, "{}", "jps");
    assert_eq!(thrown(&fresh, "step", &[1.into()]), "MediantError not-begun");
    // A trace is of one size of map.
    let corners = self::planner(&grid, r#"{"placement": "corner"}"#, "astar");
    assert_eq!(thrown(&corners, "find", &[at(0, 0), at(1, 0), NONE, trace.clone()]), "MediantError mismatch");
    let plain = JsValue::from(Trace::new(&NONE).expect("a trace"));
    assert_eq!(thrown(&plain, "posthoc", &[planner, at(0, 0), at(7, 0)]), "MediantError argument");
}

#[test]
fn labels_and_goals() {
    let grid = grid();
    let space = ok(&grid, "space", &[json("{}")]);
    let prepare = |engine: &str, options: &str| ok(&space, "prepare", &[engine.into(), json(options)]);
    for (engine, options, levels, searched_by) in [
        ("subgoal", "{}", "labels".into(), "subgoal"),
        ("subgoal", r#"{"memory": "8MB"}"#, "labels".into(), "subgoal"),
        ("subgoal", r#"{"levels": "labels", "memory": 8000000}"#, "labels".into(), "subgoal"),
        ("subgoal", r#"{"memory": 1}"#, "contracted".into(), "subgoal"),
        ("subgoal", r#"{"levels": 2}"#, 2.into(), "subgoal"),
        ("hpa", r#"{"levels": 1}"#, 1.into(), "hpa"),
        ("astar", "{}", NONE, "astar"),
    ] {
        let index = prepare(engine, options);
        assert_eq!(
            (get(&index, "levels"), get(&index, "searchedBy")),
            (levels, searched_by.into()),
            "{options}"
        );
        let planner = ok(&index, "planner", &[]);
        assert_eq!(
            ok(&planner, "distance", &[at(0, 0), at(7, 0)]).as_f64(),
            Some(11.0),
            "{engine} {options}"
        );
        let goals = ok(&index, "goals", &[json("[[7, 0], [2, 0], [0, 0], [0, 2]]")]);
        assert_eq!(get(&goals, "length").as_f64(), Some(4.0));
        assert_eq!(numbers(&ok(&goals, "points", &[])), [7, 0, 2, 0, 0, 0, 0, 2]);
        let distances = js_sys::Float64Array::from(ok(&planner, "distances", &[at(0, 0), goals.clone()]));
        assert_eq!(distances.to_vec(), [11.0, 2.0, 0.0, 2.0], "{engine} {options}");
        let nearest = ok(&planner, "nearest", &[at(2, 1), goals.clone()]);
        assert_eq!((get(&nearest, "goal"), get(&nearest, "distance")), (1.into(), 1.into()));
        ok(&goals, "free", &[]);
        assert_eq!(thrown(&planner, "nearest", &[at(2, 1), goals]), "TypeError ");
    }
    let refused = [NONE, json(r#"{"levels": "labels", "memory": 1}"#)];
    assert_eq!(thrown(&space, "prepare", &refused), "MediantError index-range");
    // Where no path leads, and no goal.
    let closed = ok(&grid_of(r#"["..#.", "..#."]"#), "space", &[]);
    let index = ok(&closed, "prepare", &[]);
    let (planner, goals) = (ok(&index, "planner", &[]), ok(&index, "goals", &[at(3, 0)]));
    assert_eq!(ok(&planner, "distance", &[at(0, 0), at(3, 0)]).as_f64(), Some(f64::INFINITY));
    assert!(ok(&planner, "nearest", &[at(0, 0), goals.clone()]).is_undefined());
    assert!(ok(&planner, "nearest", &[at(0, 0), ok(&index, "goals", &[json("[]")])]).is_undefined());
    // Mistakes.
    assert_eq!(thrown(&index, "goals", &[json("[[0, 0], [2, 0]]")]), "MediantError goal-blocked");
    assert_eq!(thrown(&index, "goals", &[json("[[0, 1e300]]")]), "MediantError goal-outside");
    assert_eq!(thrown(&planner, "distance", &[at(2, 0), at(0, 0)]), "MediantError start-blocked");
    assert_eq!(thrown(&planner, "distances", &[at(0, 9), goals.clone()]), "MediantError start-outside");
    assert_eq!(thrown(&planner, "nearest", &[at(2, 0), goals.clone()]), "MediantError start-blocked");
    assert_eq!(thrown(&planner, "distances", &[at(0, 0), json("[[3, 0]]")]), "TypeError ");
    let other = ok(&prepare("subgoal", "{}"), "planner", &[]);
    assert_eq!(thrown(&other, "distances", &[at(0, 0), goals]), "MediantError mismatch");
}

#[test]
fn costmaps() {
    let grid = grid();
    let soft = ok(&grid, "inflated", &[json(r#"{"inflationRadius": 3, "weight": 1}"#)]);
    let answer = ok(&soft, "find", &[at(0, 0), at(7, 0)]);
    let (cost, length) = (get(&answer, "cost").as_f64(), get(&answer, "length").as_f64());
    assert!(cost > length && length > Some(7.0), "{cost:?}, {length:?}");
    assert_eq!(thrown(&soft, "inflated", &[json(r#"{"inflationRadius": 3}"#)]), "MediantError cost");
    let wrong = json(r#"{"inflationRadius": 1, "inscribedRadius": 2}"#);
    assert_eq!(thrown(&grid, "inflated", &[wrong]), "MediantError argument");
    let row = [3.into(), 1.into(), bytes(&[0, 126, 255])];
    let costs = ok(&ok(&class(&grid), "fromCostmap", &row), "costs", &[]);
    assert_eq!(js_sys::Float64Array::from(costs).to_vec(), [1.0, 2.0, f64::INFINITY]);
    assert_eq!(thrown(&class(&grid), "fromCostmap", &row[..2]), "TypeError ");
    // A field of costs tells how far it is, and ends when its listener throws.
    let (space, heard) = (ok(&soft, "space", &[]), Array::new());
    let listener = Function::new_with_args("heard", "return (...counts) => heard.push(counts.join())");
    let listener = listener.call1(&NONE, &heard).expect("a function");
    let field = ok(&space, "field", &[at(0, 0), NONE, listener]);
    assert_eq!(ok(&field, "get", &[at(7, 0)]).as_f64(), cost);
    assert_eq!(heard.join(" "), "0,17 17,17");
    let throws = Function::new_no_args("throw new Error('enough')").into();
    let error = call(&space, "field", &[at(0, 0), NONE, throws]).expect_err("the listener throws");
    assert_eq!(get(&error, "message"), "enough");
}

#[test]
fn fields_and_pictures() {
    let grid = grid();
    let space = ok(&grid, "space", &[]);
    let field = ok(&space, "field", &[at(0, 0)]);
    assert_eq!(ok(&field, "get", &[at(7, 0)]).as_f64(), Some(11.0));
    assert_eq!(Array::from(&ok(&field, "next", &[at(7, 0)])).join(","), "6,0");
    assert!(ok(&field, "next", &[at(0, 0)]).is_undefined());
    assert_eq!(numbers(&ok(&field, "pathFrom", &[at(7, 0)]))[..2], [7, 0]);
    let flow = js_sys::Float32Array::from(ok(&field, "flow", &[])).to_vec();
    assert_eq!((flow.len(), &flow[..4]), (48, &[0.0, 0.0, -1.0, 0.0][..]));
    let near = ok(&space, "field", &[at(0, 0), 1.5.into()]);
    assert_eq!(ok(&near, "get", &[at(2, 0)]).as_f64(), Some(f64::INFINITY));
    assert_eq!(thrown(&space, "field", &[at(3, 0)]), "MediantError start-blocked");
    let widest = ok(&space, "widestPath", &[at(0, 0), at(7, 0), 0.5.into()]);
    assert_eq!((get(&widest, "radius").as_f64(), get(&widest, "distance").as_f64()), (Some(0.5), Some(11.0)));

    let trace = JsValue::from(Trace::new(&NONE).expect("a trace"));
    ok(&planner(&grid, "{}", "astar"), "find", &[at(0, 0), at(7, 0), NONE, trace.clone()]);
    let picture = JsValue::from(Picture::new(&grid, &"center".into()).expect("a picture"));
    ok(&picture, "field", std::slice::from_ref(&field));
    ok(&picture, "searched", std::slice::from_ref(&trace));
    ok(&picture, "path", &["way".into(), ok(&grid, "path", &[at(0, 0), at(7, 0)])]);
    ok(&picture, "start", &[at(0, 0)]);
    ok(&picture, "goal", &[json("[[7, 0], [7, 2]]")]);
    ok(&picture, "caption", &["a picture".into()]);
    ok(&picture, "radius", &[0.3.into()]);
    ok(&picture, "largestSide", &[500.into()]);
    let svg = ok(&picture, "svg", &[]).as_string().expect("a text");
    assert!(svg.starts_with("<svg") && svg.contains("a picture") && svg.contains("way"));
    assert_eq!(Uint8Array::from(ok(&picture, "png", &[])).to_vec()[1..4], *b"PNG");
    let corners = JsValue::from(Picture::new(&grid, &"corner".into()).expect("a picture"));
    assert_eq!(thrown(&corners, "field", &[field]), "MediantError mismatch");
    assert_eq!(thrown(&corners, "searched", &[trace]), "MediantError mismatch");
}

#[test]
fn what_needs_no_map() {
    let moves = mediant_web::moves(&2.into()).expect("moves").to_vec();
    assert_eq!(moves.len(), 8);
    let bound = mediant_web::bound(&json(r#"{"k": 3, "placement": "corner"}"#)).expect("a bound");
    assert!(bound.is_some_and(|bound| (bound - 1.0824).abs() < 1e-4));
    let engines = Array::from(&mediant_web::engines());
    assert_eq!(engines.length(), 15);
    let theta = engines.iter().find(|engine| get(engine, "name") == "theta").expect("theta");
    assert_eq!(Array::from(&get(&theta, "options")).join(","), "heuristic,smooth");
    let check = |engine: &str, motion: &str| {
        mediant_web::check_setup(&engine.into(), &json(motion), &NONE).map_err(|error| text(&error))
    };
    assert_eq!(check("astar", "{}"), Ok(None));
    assert_eq!(check("anya", r#"{"k": 3}"#), Ok(None));
    assert_eq!(check("anya", r#"{"placement": "center"}"#), Ok(None));
    assert_eq!(
        check("jps-block", r#"{"k": 4}"#),
        Ok(Some("jps-block needs a k from 2 to 3, found 4 (16 neighbors)".to_owned()))
    );
    assert!(
        check("anya", r#"{"k": 4, "placement": "center"}"#)
            .is_ok_and(|why| why.is_some_and(|why| why.starts_with("anya needs placement corner")))
    );
    assert!(check("astar2", "{}").is_err_and(|error| error.starts_with("MediantError unknown-name")));
}

/// A map keeps its place in the world, and what is measured in meters is what is measured in cells.
#[test]
fn worlds_and_scenarios() {
    let size = [8.into(), 3.into()];
    let world = World::new(&size[0], &size[1], &0.5.into(), &json("[1, 2]")).expect("a world");
    let grid = ok(&grid(), "withWorld", &[world.into()]);
    let edited = ok(&grid, "editCells", &[json("[[0, 0], [7, 2]]"), JsValue::TRUE]);
    let space = ok(&edited, "space", &[]);
    let world = get(&get(&space, "grid"), "world");
    assert_eq!(numbers_of(&get(&world, "origin")), [1.0, 2.0, 0.0]);
    assert_eq!(numbers_of(&ok(&world, "vertexAt", &[1.2.into(), 2.2.into()])), [0.0, 2.0]);
    let meters = ok(&grid, "forDisc", &[json(r#"{"meters": 0.3}"#)]);
    assert_eq!(get(&meters, "id"), get(&ok(&grid, "forDisc", &[0.6.into()]), "id"));
    assert_eq!(
        thrown(&ok(&grid, "withWorld", &[]), "forDisc", &[json(r#"{"meters": 1}"#)]),
        "MediantError argument"
    );
    let text = b"version 1\n0 a.map 8 3 0 0 7 0 11\n";
    let scenario = JsValue::from(Scenario::read(&bytes(text)).expect("a scenario"));
    assert_eq!(numbers(&ok(&scenario, "goals", &[])), [7, 0]);
    ok(&scenario, "check", &[grid]);
}

/// The numbers of an array.
fn numbers_of(array: &JsValue) -> Vec<f64> {
    array.unchecked_ref::<Array>().iter().filter_map(|number| number.as_f64()).collect()
}
