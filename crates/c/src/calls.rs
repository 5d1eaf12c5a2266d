//! The table of calls that every language answers alike: see `crates/mediant/tests/calls.json`.

#![allow(unsafe_code, reason = "functions of C")]

use std::{collections::BTreeSet, ffi::CString, fs, mem::MaybeUninit, ptr, slice};

use serde_json::Value;

use crate::{
    answer::Answer,
    batch::{BatchHandle, Paths, mediant_batch_free, mediant_batch_paths},
    code::Code,
    find::mediant_map_find,
    map::{MapHandle, mediant_map_free, mediant_map_parse},
    points::Point,
};

/// The parameters of a call as a text; `None` where C cannot say them.
fn words(call: &Value) -> Option<String> {
    let mut words = Vec::new();
    for (name, value) in call.as_object()? {
        let name = name.replace('-', "_");
        words.push(match value {
            Value::Bool(true) => name,
            Value::Bool(false) => format!("{name}=false"),
            Value::Number(number) => format!("{name}={number}"),
            Value::String(text) if !text.contains(char::is_whitespace) && !text.is_empty() => {
                format!("{name}={text}")
            }
            _ => return None,
        });
    }
    Some(words.join(" "))
}

fn point(at: &Value) -> Point {
    let at = |i: usize| at[i].as_f64().expect("a coordinate");
    Point { x: at(0), y: at(1) }
}

/// The answer to a call, and the points of its path.
fn find(map: &str, case: &Value, words: &str) -> Result<(Answer, Vec<Point>), Code> {
    let (text, words) = (CString::new(map).expect("a text"), CString::new(words).expect("a text"));
    let (start, goal) = (point(&case["start"]), point(&case["goal"]));
    let (mut map, mut path) = (MapHandle { id: 0 }, BatchHandle { id: 0 });
    let mut answer = Answer::stopped(None.into());
    let mut paths = MaybeUninit::<Paths>::uninit();
    let (words, none) = (words.as_ptr(), ptr::null());
    // SAFETY: all of these are places of the right kinds.
    unsafe {
        assert_eq!(mediant_map_parse(text.as_ptr(), &raw mut map), Code::Ok);
        let (path, answer) = (&raw mut path, &raw mut answer);
        let code = mediant_map_find(map, &raw const start, 1, &raw const goal, 1, words, none, path, answer);
        assert_eq!(mediant_map_free(map), Code::Ok);
        if code != Code::Ok {
            return Err(code);
        }
        assert_eq!(mediant_batch_paths(*path, paths.as_mut_ptr()), Code::Ok);
        let points = slice::from_raw_parts(paths.assume_init_ref().points, (*answer).point_count).to_vec();
        assert_eq!(mediant_batch_free(*path), Code::Ok);
        Ok((*answer, points))
    }
}

fn check(case: &Value, map: &str, words: &str) {
    let expected = &case["expected"];
    match find(map, case, words) {
        Err(code) => {
            let has_number = case["call"].as_object().is_some_and(|call| call.values().any(Value::is_number));
            let known = match expected["code"].as_str() {
                // In a text a number in the place of a name is a name, too.
                Some("argument") if has_number && code == Code::UnknownName => Some("unknown-name"),
                known => known,
            };
            assert_eq!(code.name().to_str().ok(), known, "{case}");
        }
        Ok((answer, points)) => {
            let number = |of: Option<&str>, names: &[&str]| {
                names.iter().position(|name| of == Some(name)).map(|at| at as i32)
            };
            let statuses = ["found", "unreachable", "nearest", "stopped"];
            assert_eq!(Some(answer.status as i32), number(expected["status"].as_str(), &statuses), "{case}");
            let limits = ["none", "cost", "expansions", "timeout", "cancelled"];
            let by = expected["stopped_by"].as_str().or(Some("none"));
            assert_eq!(Some(answer.stopped_by as i32), number(by, &limits), "{case}");
            if let Some(path) = expected["path"].as_array() {
                let path: Vec<Point> = path.iter().map(point).collect();
                assert_eq!(
                    (&points, Some(answer.distance)),
                    (&path, expected["distance"].as_f64()),
                    "{case}"
                );
            }
        }
    }
}

#[test]
fn every_call_of_the_table_is_answered_as_it_says() {
    let table = fs::read_to_string("../mediant/tests/calls.json").expect("the table");
    let table: Value = serde_json::from_str(&table).expect("JSON");
    let map = |name: &Value| {
        let rows = table["maps"][name.as_str().expect("a name")].as_array().expect("rows");
        rows.iter().map(|row| row.as_str().expect("a row")).collect::<Vec<_>>().join("\n")
    };
    let mut tried = 0;
    for case in table["cases"].as_array().expect("calls") {
        // Options that only reproduce a publication are there where another crate of the build has them.
        let is_published = case.get("published").is_some();
        if let Some(words) = words(&case["call"]).filter(|_| !is_published) {
            check(case, &map(&case["map"]), &words);
            tried += 1;
        }
    }
    assert!(tried >= 120, "{tried} calls");
}

/// All functions, but for those that free and those that tell of others, are in the table of what can be
/// asked, and all that it names are functions.
#[test]
fn the_table_of_what_can_be_asked_names_the_functions() {
    let header = fs::read_to_string("include/mediant.h").expect("the header");
    let table = fs::read_to_string("../../docs/calls.md").expect("the table");
    let known: BTreeSet<&str> = header
        .split("mediant_")
        .skip(1)
        .filter_map(|text| text.split_once('(').map(|(name, _)| name))
        .filter(|name| name.chars().all(|letter| letter == '_' || letter.is_ascii_lowercase()))
        .collect();
    let rows = table.split("## What can be asked").nth(1).expect("the table").lines();
    let cells = rows.filter_map(|row| row.starts_with('|').then(|| row.rsplit('|').nth(1)).flatten());
    let told: BTreeSet<&str> = cells
        .flat_map(|cell| cell.split('`').skip(1).step_by(2))
        .filter(|name| !["any_angle_lower_bound", "limit"].contains(name))
        .collect();
    let of_no_row = [
        "batch_paths",
        "bytes_data",
        "code_name",
        "field_distances",
        "field_repair",
        "field_size",
        "goals_new",
        "index_bound",
        "index_is_finished",
        "index_memory",
        "index_setup",
        "index_space",
        "interface",
        "map_costs",
        "map_is_blocked",
        "map_size",
        "message",
        "objects",
        "planner_best",
        "planner_new",
        "planner_points",
        "planner_progress",
        "space_new",
        "version",
    ];
    let missing: Vec<_> = known
        .iter()
        .filter(|name| !name.ends_with("_free") && !told.contains(*name) && !of_no_row.contains(name))
        .collect();
    assert!(missing.is_empty(), "not in docs/calls.md: {missing:?}");
    assert!(told.is_subset(&known), "no functions: {:?}", told.difference(&known).collect::<Vec<_>>());
    assert!(told.len() > 50, "{}", told.len());
}
