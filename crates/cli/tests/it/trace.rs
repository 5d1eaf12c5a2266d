//! `--trace`: the events of a search.

use serde_json::Value;

use crate::common::{Files, Ran, mediant, told};

#[test]
fn a_trace_has_the_search_and_its_path() {
    let files = Files::new();
    let path = files.path("trace.json");
    for engine in mediant::Engine::ALL {
        for placement in engine.capabilities().placements.iter().map(ToString::to_string) {
            let line = format!(
                "run builtin:town --from 60,18 --to 10,5 --engine {engine} --placement {placement} --trace {path}"
            );
            let (_, queries, _) = told(&line);
            let text = std::fs::read_to_string(&path).expect("a trace");
            let trace: Value = serde_json::from_str(&text).expect("a trace is JSON");
            let events = trace["events"].as_array().expect("events");
            let of = |kind: &str| events.iter().filter(|event| event["type"] == kind).collect::<Vec<_>>();
            let count = |kind: &str| Some(of(kind).len() as u64);
            assert_eq!(count("generating"), queries[0]["generated"].as_u64(), "{engine}");
            assert_eq!(count("expanding"), queries[0]["expanded"].as_u64(), "{engine}");
            assert_eq!(
                (count("closing"), count("updating")),
                (count("expanding"), queries[0]["updated"].as_u64())
            );
            assert_eq!((&events[0]["type"], &events[1]["type"]), (&"source".into(), &"destination".into()));
            assert_eq!((&events[0]["x"], &events[0]["y"]), (&60.into(), &18.into()));
            assert!(events[0]["map"].is_array(), "the map is drawn");
            let ends: Vec<Value> =
                of("end").iter().map(|event| serde_json::json!([event["x"], event["y"]])).collect();
            assert_eq!(Value::from(ends), queries[0]["path"], "{engine}");
            for pair in of("end").windows(2) {
                assert_eq!(pair[1]["pId"], pair[0]["id"], "{engine}");
            }
            let last = of("end").last().and_then(|event| event["g"].as_f64()).expect("a length");
            let cost = queries[0]["cost"].as_f64().expect("a path");
            assert!((last - cost).abs() < 1e-9, "{engine}: {last}, {cost}");
        }
    }
}

#[test]
fn a_query_that_is_an_error_has_a_trace_without_events() {
    let files = Files::new();
    let path = files.path("trace.json");
    let Ran { status, .. } =
        mediant(&["run", "builtin:town", "--from", "-5,99999", "--to", "10,5", "--trace", &path]);
    let trace: Value = serde_json::from_str(&std::fs::read_to_string(&path).expect("a trace")).expect("JSON");
    assert_eq!((status, &trace["events"]), (Some(1), &serde_json::json!([])));
}
