//! One table of calls, which every language answers alike: `tests/calls.json` has each call with what becomes
//! of it. Here it is held to the library, and written by `MEDIANT_WRITE=1`; the tests of the program, of
//! Python and of JavaScript hold their calls to the same file. Calls with what only reproduces a publication
//! are marked: the packages refuse them.

use std::fmt::Write as _;

use mediant::{
    Error, Limits, Map, Point,
    call::{Call, CallError, Group, Parameter, Spelling, Value},
};
use serde_json::{Map as Object, Value as Json, json};

const FILE: &str = "tests/calls.json";

/// A value of JSON as the library's.
fn value(of: &Json) -> Value<'_> {
    match of {
        Json::Bool(flag) => Value::Flag(*flag),
        Json::Number(number) => match number.as_i64() {
            Some(integer) => Value::Integer(integer),
            None => Value::Number(number.as_f64().expect("a number")),
        },
        Json::String(text) => text.as_str().into(),
        Json::Null => Value::Absent,
        _ => Value::Other("a list".to_owned()),
    }
}

fn call(of: &Json) -> Result<Call, CallError> {
    let mut call = Call::default();
    for (name, given) in of.as_object().expect("parameters") {
        let parameter = Parameter::find(name, Spelling::Kebab, &Group::ALL).expect("a parameter");
        call.set(parameter, value(given))?;
    }
    Ok(call)
}

fn point(of: &Json) -> Point {
    let at = |index: usize| of[index].as_f64().expect("a coordinate");
    (at(0), at(1)).into()
}

/// The answer to a call.
fn answer(map: &Map, case: &Json) -> Result<Json, Error> {
    let call = call(&case["call"])?;
    let setup = map.setup(&call)?;
    let is_late = call.wishes().timeout == Some(0.0);
    let limits = |limits: Limits| if is_late { limits.deadline(|| true) } else { limits };
    let stopped = json!({ "setup": setup.to_string(), "status": "stopped", "stopped_by": "timeout" });
    let planners = match map.keep_planners(&setup, limits(Limits::new())) {
        Err(Error::Stopped { .. }) => return Ok(stopped),
        planners => planners?,
    };
    let limits = limits(call.wishes().limits());
    let query = call.wishes().query(&[point(&case["start"])], &[point(&case["goal"])], limits);
    let told = planners.find(query)?;
    let mut expected = Object::new();
    expected.insert("setup".to_owned(), setup.to_string().into());
    expected.insert("status".to_owned(), told.status().name().into());
    if let Some(path) = told.path() {
        let number = |cells: f64| if cells.fract() == 0.0 { json!(cells as i32) } else { json!(cells) };
        let waypoints: Vec<[Json; 2]> = path.points().map(|at| [number(at.x()), number(at.y())]).collect();
        expected.insert("path".to_owned(), json!(waypoints));
        expected.insert("distance".to_owned(), json!(told.distance(setup.guarantee())));
    }
    if let Some(limit) = told.stopped_by() {
        expected.insert("stopped_by".to_owned(), limit.name().into());
    }
    Ok(expected.into())
}

/// Whether a call has an option or a name that only the feature `publications` knows.
fn is_published(call: &Json) -> bool {
    call.as_object().expect("parameters").iter().any(|(name, given)| {
        let parameter = Parameter::find(name, Spelling::Kebab, &Group::ALL).expect("a parameter");
        parameter.option().is_some_and(|option| option.is_published) || given == "squared"
    })
}

/// The file, with a line for each call.
fn text(maps: &Json, cases: &[Json]) -> String {
    let mut text =
        format!("{{\n\"maps\": {},\n\"cases\": [\n", serde_json::to_string_pretty(maps).expect("JSON"));
    for (index, case) in cases.iter().enumerate() {
        _ = writeln!(text, "{case}{}", if index + 1 < cases.len() { "," } else { "" });
    }
    text + "]\n}\n"
}

#[test]
fn every_call_of_the_table_is_answered_as_it_says() {
    let known = std::fs::read_to_string(FILE).expect("the table");
    let table: Json = serde_json::from_str(&known).expect("JSON");
    let rows = |name: &str| {
        let rows = table["maps"][name].as_array().expect("rows");
        rows.iter().map(|row| row.as_str().expect("a row").to_owned()).collect::<Vec<_>>()
    };
    let mut cases = table["cases"].as_array().expect("calls").clone();
    for case in &mut cases {
        // Each on a map of its own: what another call prepared is not there.
        let map = Map::from_rows(rows(case["map"].as_str().expect("a map"))).expect("a map");
        case["expected"] = answer(&map, case)
            .unwrap_or_else(|error| json!({ "code": error.code().name(), "error": error.to_string() }));
        let mark = is_published(&case["call"]).then_some(Json::Bool(true));
        let row = case.as_object_mut().expect("a call");
        row.remove("published");
        row.extend(mark.map(|mark| ("published".to_owned(), mark)));
        let again = answer(&map, case).ok();
        assert!(again.is_none_or(|again| again == case["expected"]), "the second call: {case}");
    }
    assert!(cases.len() >= 140, "{} calls", cases.len());
    for group in Group::ALL {
        for name in Parameter::names(&[group], Spelling::Kebab) {
            let of = |case: &&Json| case["call"].get(&name).is_some();
            let failed = |case: &&Json| case["expected"].get("code").is_some();
            assert!(cases.iter().filter(of).any(|case| !failed(&case)), "no call with {name}");
            // A second heuristic and a side have their mistakes in common with others.
            let has_mistakes =
                !["second", "side", "step", "detour", "variant", "unstraightened"].contains(&&*name);
            assert!(
                !has_mistakes || cases.iter().filter(of).any(|case| failed(&case)),
                "no mistake with {name}"
            );
        }
    }
    let found = text(&table["maps"], &cases);
    if std::env::var_os("MEDIANT_WRITE").is_some() {
        std::fs::write(FILE, &found).expect("the table");
    }
    let said = std::fs::read_to_string(FILE).expect("the table");
    for (said, found) in said.lines().zip(found.lines()) {
        assert_eq!(said, found, "MEDIANT_WRITE=1 writes the table");
    }
    assert!(said == found, "the table has more or fewer calls: MEDIANT_WRITE=1 writes it");
}
