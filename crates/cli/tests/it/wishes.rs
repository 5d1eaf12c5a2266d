//! Several ends, tolerance, nearest vertices, moved ends and limits: the answers, against all distances from
//! the start, and what is said of them.

use serde_json::{Value, json};

use crate::{
    common::{Files, Ran, add_example_files, mediant, run, run_examples, shown, told},
    errors::check,
};

type At = (i32, i32);

/// The distances from a vertex to all that can be reached, by Dijkstra's algorithm on N(3).
#[track_caller]
fn distances(map: &str, (x, y): At) -> Vec<(At, f64)> {
    let Ran { stdout, .. } = run(&format!("run {map} --engine dijkstra --from {x},{y} --distances -"));
    let parse = |line: &str| {
        let parts: Vec<f64> = line.split(',').map(|part| part.parse().expect("a number")).collect();
        ((parts[0] as i32, parts[1] as i32), parts[2])
    };
    stdout.lines().skip(1).map(parse).collect()
}

/// The record of a single query that is answered.
#[track_caller]
fn query(line: &str) -> Value {
    let (_, mut queries, _) = told(line);
    assert_eq!(queries.len(), 1, "{line}");
    queries.remove(0)
}

/// The last waypoint of a record's path.
#[track_caller]
fn end(query: &Value) -> At {
    let last = query["path"].as_array().and_then(|path| path.last()).expect("a path");
    let number = |i: usize| last[i].as_i64().expect("a coordinate") as i32;
    (number(0), number(1))
}

#[track_caller]
fn number(record: &Value, key: &str) -> f64 {
    record[key].as_f64().unwrap_or_else(|| panic!("{key} of {record}"))
}

/// h_3, the distance on an empty map.
fn octile(a: At, b: At) -> f64 {
    let (dx, dy) = (f64::from((a.0 - b.0).abs()), f64::from((a.1 - b.1).abs()));
    dx.max(dy) + (2.0_f64.sqrt() - 1.0) * dx.min(dy)
}

#[track_caller]
fn assert_close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-6, "{a}, {b}");
}

const CAVE: &str = "run builtin:cave --from 2,5";

#[test]
fn of_several_ends_those_with_the_shortest_path_are_taken() {
    let near = distances("builtin:cave", (2, 5));
    let far = distances("builtin:cave", (57, 3));
    let goals = [(62, 33), (28, 21), (40, 3), (4, 22)];
    let listed: String = goals.iter().map(|(x, y)| format!(" --to {x},{y}")).collect();
    for (starts, from) in [("", vec![&near]), (" --from 57,3", vec![&near, &far])] {
        let found = query(&format!("{CAVE}{starts}{listed}"));
        let all = from.iter().flat_map(|known| known.iter()).filter(|(at, _)| goals.contains(at));
        let (at, least) = all.copied().min_by(|a, b| a.1.total_cmp(&b.1)).expect("a goal");
        assert_eq!((&found["status"], end(&found)), (&json!("found"), at));
        assert_close(number(&found, "cost"), least);
        assert_eq!(found["goal"], json!([at.0, at.1]), "the goal that was reached");
        assert_eq!(found["goals"], json!(goals), "the goals that were asked for");
        assert_eq!(found["starts"].as_array().map(Vec::len), Some(from.len()));
        assert_eq!(found["start"], found["path"][0]);
    }
}

#[test]
fn a_path_may_end_within_the_tolerance() {
    let all = distances("builtin:cave", (2, 5));
    // The goal of the second is blocked.
    for (goal, tolerance) in [((62, 33), 2.5), ((30, 20), 3.0), ((30, 20), 2.3), ((40, 3), 0.5)] {
        let (x, y) = goal;
        let found = query(&format!("{CAVE} --to {x},{y} --tolerance {tolerance}"));
        let is_near = |at: At| f64::from(at.0 - x).hypot(f64::from(at.1 - y)) <= tolerance;
        let near = all.iter().filter(|(at, _)| is_near(*at)).map(|(_, distance)| *distance);
        assert_close(number(&found, "cost"), near.fold(f64::INFINITY, f64::min));
        assert!(is_near(end(&found)), "{found}");
        assert_eq!((&found["status"], &found["goals"]), (&json!("found"), &json!([goal])));
    }
}

#[test]
fn the_nearest_vertex_is_near_by_h_k_and_then_by_its_path() {
    let all = distances("builtin:cave", (2, 5));
    for goal in [(37, 0), (60, 13), (36, 27), (0, 35), (71, 0)] {
        let (x, y) = goal;
        let found = query(&format!("{CAVE} --to {x},{y} --nearest"));
        let key = |&(at, distance): &(At, f64)| (octile(at, goal), distance);
        let (near, least) = all.iter().map(key).fold((f64::INFINITY, f64::INFINITY), |a, b| {
            if b.0 < a.0 - 1e-9 || b.0 < a.0 + 1e-9 && b.1 < a.1 { b } else { a }
        });
        assert_eq!((&found["status"], &found["goal"]), (&json!("nearest"), &json!(goal)));
        assert_close(octile(end(&found), goal), near);
        assert_close(number(&found, "cost"), least);
        let certificate = ["lower_bound", "bound", "any_angle", "ratio"].map(|key| found[key].is_null());
        assert_eq!(certificate, [true; 4], "there is no certificate of such a path");
    }
    let found = query(&format!("{CAVE} --to 62,33 --nearest"));
    assert_eq!(found["status"], "found", "where there is a way, it is found");
}

#[test]
fn ends_are_moved_to_free_vertices() {
    let plain = query(&format!("{CAVE} --to 38,1"));
    let found = query(&format!("{CAVE} --to 37,0 --snap"));
    let keys = ["status", "start", "goal", "path", "cost", "lower_bound", "bound", "expanded"];
    for key in keys {
        assert_eq!(found[key], plain[key], "{key}");
    }
    assert_eq!((&found["goals"], plain.get("goals")), (&json!([[37, 0]]), None));
    // Outside, and far outside.
    let outside = query("run builtin:cave --from -2147483648,5 --to 99,2147483647 --snap");
    assert_eq!((&outside["status"], &outside["start"]), (&json!("found"), &json!([0, 5])));
    // The program's own hint for a blocked end names the nearest one by the straight line, here the same.
    assert_eq!(query(&format!("{CAVE} --to 30,20 --snap"))["goal"], json!([28, 21]));
}

#[test]
fn a_limit_on_the_cost_stops_what_costs_more() {
    let plain = query(&format!("{CAVE} --to 62,33"));
    let cost = number(&plain, "cost");
    let enough = query(&format!("{CAVE} --to 62,33 --max-cost {}", cost + 1e-6));
    assert_eq!((&enough["status"], &enough["path"]), (&json!("found"), &plain["path"]));
    assert_eq!(enough.get("stopped_by"), None);
    for limit in [cost - 1e-6, 75.0, 40.0, 0.0] {
        let stopped = query(&format!("{CAVE} --to 62,33 --max-cost {limit}"));
        assert_eq!((&stopped["status"], &stopped["stopped_by"]), (&json!("stopped"), &json!("cost")));
        let bound = number(&stopped, "lower_bound");
        assert!(bound > limit && bound <= cost, "{limit}: {stopped}");
        assert_eq!((&stopped["bound"], &stopped["goal"]), (&Value::Null, &json!([62, 33])));
    }
}

#[test]
fn a_limit_on_the_nodes_is_kept() {
    let plain = query(&format!("{CAVE} --to 62,33"));
    let all = distances("builtin:cave", (2, 5));
    let expanded = plain["expanded"].as_u64().expect("a count");
    for limit in [0, 1, 100, expanded - 1] {
        let stopped = query(&format!("{CAVE} --to 62,33 --max-expansions {limit}"));
        assert_eq!((&stopped["status"], &stopped["stopped_by"]), (&json!("stopped"), &json!("expansions")));
        assert_eq!(stopped["expanded"], limit);
        assert_eq!(stopped["path"][0], json!([2, 5]), "the best so far begins at the start");
        let known = all.iter().find(|(at, _)| *at == end(&stopped)).expect("a vertex that can be reached").1;
        assert!(number(&stopped, "cost") > known - 1e-6, "{stopped}");
        assert!(number(&stopped, "lower_bound") <= number(&plain, "cost"), "{stopped}");
    }
    let enough = query(&format!("{CAVE} --to 62,33 --max-expansions {expanded}"));
    assert_eq!((&enough["status"], &enough["path"]), (&json!("found"), &plain["path"]));
}

#[test]
fn a_deadline_is_looked_at() {
    let over = query(&format!("{CAVE} --to 62,33 --timeout 0"));
    assert_eq!((&over["status"], &over["stopped_by"]), (&json!("stopped"), &json!("timeout")));
    assert_eq!((&over["path"], &over["cost"], &over["expanded"]), (&json!([[2, 5]]), &json!(0.0), &json!(0)));
    assert_close(number(&over, "lower_bound"), octile((2, 5), (62, 33)));
    // It runs for each query, and each time anew.
    let (run, queries, summary) = told("run builtin:cave --timeout 60000 --repeat 3");
    assert_eq!((&run["timeout_ms"], queries.len()), (&json!(60_000.0), 32));
    assert_eq!((&summary["found"], &summary["stopped"]), (&json!(32), &json!(0)));
}

#[test]
fn wishes_hold_for_each_query_of_a_scenario() {
    let (run, plain, summary) = told("run builtin:cave");
    let absent = |record: &Value, keys: &[&str]| keys.iter().all(|key| record.get(key).is_none());
    assert!(absent(&run, &["tolerance", "nearest", "snap", "max_cost", "max_expansions", "timeout_ms"]));
    assert!(
        absent(&summary, &["nearest", "stopped"]) && absent(&plain[0], &["starts", "goals", "stopped_by"])
    );

    let (run, queries, summary) = told("run builtin:cave --max-cost 50 --nearest");
    assert_eq!((&run["max_cost"], &run["nearest"], run.get("snap")), (&json!(50.0), &json!(true), None));
    let mut found = 0;
    for (query, plain) in queries.iter().zip(&plain) {
        let is_short = number(plain, "cost") <= 50.0;
        found += u64::from(is_short);
        assert_eq!(query["status"], if is_short { "found" } else { "stopped" }, "{query}");
        assert!(!is_short || query["path"] == plain["path"], "{query}");
    }
    assert!((1..32).contains(&found), "both kinds are there");
    let counts = ["queries", "found", "nearest", "unreachable", "stopped", "errors"];
    assert_eq!(counts.map(|key| summary[key].as_u64()), [32, found, 0, 0, 32 - found, 0].map(Some));
    // Stopped queries are not compared with the scenario.
    assert_eq!([&summary["reference"]["compared"], &summary["reference"]["equal"]], [found, found]);
    let mean = queries.iter().filter(|query| query["status"] == "found").map(|query| number(query, "cost"));
    assert_close(number(&summary, "mean_cost"), mean.sum::<f64>() / found as f64);

    // Nor are paths that end elsewhere.
    let (_, queries, summary) = told("run builtin:cave --tolerance 2");
    let short = queries.iter().filter(|query| query["goal"] == query["goals"][0]).count();
    assert_eq!(summary["reference"]["compared"].as_u64().unwrap_or(0), short as u64);
    assert_eq!(summary["found"], 32);
}

#[test]
fn every_engine_takes_every_wish() {
    for engine in mediant::Engine::ALL {
        let town = format!("run builtin:town --engine {engine} --from 60,18");
        let found = query(&format!("{town} --to 10,5 --to 66,27 --tolerance 1.5 --timeout 60000"));
        let (x, y) = end(&found);
        let near = f64::from(x - 66).hypot(f64::from(y - 27));
        assert!(found["status"] == "found" && near <= 1.5, "{engine}: {found}");
        let plain = query(&format!("{town} --to 66,27"));
        assert!(number(&found, "cost") <= number(&plain, "cost"), "{engine}: {found}");
        let nodes = plain["expanded"].as_u64().expect("a count");
        let stopped = query(&format!("{town} --to 66,27 --max-expansions {}", nodes / 2));
        // HPA* links its ends to their clusters before it looks at a limit.
        let expanded = stopped["expanded"].as_u64().expect("a count");
        let is_kept = expanded == nodes / 2 || engine == mediant::Engine::Hpa && expanded < nodes;
        assert!(is_kept, "{engine}: {expanded} of {nodes}");
        assert_eq!(stopped["status"] == "stopped", nodes > 0, "{engine}: {stopped}");
        let bound = number(&stopped, "lower_bound");
        assert!(bound <= number(&plain, "cost") + 1e-6, "{engine}: {bound}, {plain}");
        let snapped = query(&format!("{town} --to 54,2 --snap --nearest --max-cost 500"));
        assert_eq!(snapped["status"], "found", "{engine}");
    }
}

#[test]
fn a_reference_is_between_the_ends_of_the_path() {
    let line = "run builtin:cave --placement corner --k 3 --reference anya --tolerance 4";
    let (_, queries, summary) = told(line);
    for query in &queries {
        let (any_angle, bound) = (number(query, "any_angle"), number(query, "lower_bound"));
        assert!(bound <= any_angle + 1e-6 && any_angle <= number(query, "cost") + 1e-6, "{query}");
    }
    assert!(number(&summary["ratio"], "worst") > 1.0);
}

#[test]
fn a_stopped_search_has_a_trace() {
    let files = Files::new();
    let path = files.path("trace.json");
    let stopped = query(&format!("{CAVE} --to 99,99 --snap --max-expansions 30 --trace {path}"));
    let trace: Value =
        serde_json::from_str(&std::fs::read_to_string(&path).expect("a trace")).expect("a trace is JSON");
    let events = trace["events"].as_array().expect("events");
    let of = |kind: &str| events.iter().filter(|event| event["type"] == kind).collect::<Vec<_>>();
    assert_eq!((of("expanding").len(), &stopped["expanded"]), (30, &json!(30)));
    let ends: Vec<Value> = of("end").iter().map(|event| json!([event["x"], event["y"]])).collect();
    assert_eq!(Value::from(ends), stopped["path"]);
    assert_eq!((of("source").len(), of("destination").len()), (1, 0), "the goal is outside the map");
    let found = query(&format!("{CAVE} --to 37,0 --snap --trace {path}"));
    let text = std::fs::read_to_string(&path).expect("a trace");
    let trace: Value = serde_json::from_str(&text).expect("a trace is JSON");
    let events = trace["events"].as_array().expect("events");
    let goal = events.iter().find(|event| event["type"] == "destination").expect("a goal");
    assert_eq!(json!([goal["x"], goal["y"]]), found["goal"], "the goal that was reached");
}

#[test]
fn the_table_says_what_was_asked_and_what_came_of_it() {
    insta::assert_snapshot!("a_nearest_vertex", shown(&format!("{CAVE} --engine astar --to 37,0 --nearest")));
    insta::assert_snapshot!(
        "a_stopped_search",
        shown(&format!("{CAVE} --engine astar --to 62,33 --max-expansions 100"))
    );
    insta::assert_snapshot!(
        "several_ends",
        shown(
            "run builtin:cave --engine astar --from 2,5 --from 57,3 --to 62,33 --to 28,21 --tolerance 1 --draw"
        )
    );
    insta::assert_snapshot!(
        "stopped_queries",
        shown("run builtin:cave --engine astar --every 4 --max-cost 60 --nearest --snap")
    );
    for line in [
        "run builtin:cave --every 4 --max-cost 60 --nearest --snap",
        "run builtin:cave --from 2,5 --to 37,0 --nearest",
        "run builtin:cave --from 2,5 --to 62,33 --max-expansions 100",
    ] {
        let text = run(line).stdout;
        assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    }
    let all = "--snap --nearest --tolerance 1.5 --max-cost 60.5 --max-expansions 12345 --timeout 60000";
    let text = shown(&format!("run builtin:cave {all}"));
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    let cost = shown(&format!("{CAVE} --to 62,33 --max-cost 75"));
    assert!(cost.contains("\n  stopped by --max-cost: this path is the best so far, of length "), "{cost}");
    let time = shown(&format!("{CAVE} --to 62,33 --timeout 0"));
    assert!(
        time.contains("\n  stopped by --timeout: this path is the best so far, of length 0.0000\n"),
        "{time}"
    );
}

#[test]
fn the_examples_of_the_help_run() {
    let files = Files::new();
    add_example_files(&files);
    files.add("arena.map.scen", "version 1\n0\tarena.map\t49\t49\t1\t11\t40\t30\t46.87\n");
    files.add("pairs.csv", "1,11,40,30\n");
    let (map, index) = (files.path("arena.map"), files.path("arena.idx"));
    assert_eq!(mediant(&["build", &map, "--engine", "subgoal", "-o", &index]).status, Some(0));
    let query = "{\"type\":\"query\",\"start\":[1,11],\"goal\":[40,30]}\n";
    let edit = "{\"type\":\"edit\",\"x\":9,\"y\":0,\"rows\":[\"..#\"]}\n";
    files.add("timeline.jsonl", [query, edit, query].concat());
    files.add("yard.patch", "type patch\npatches 1\npatch 0\nheight 1\nwidth 1\nmap\n@\n");
    files.add(
        "changing.scen",
        "version 2\nheight 2\nwidth 3\ncost 1 octile\npatch yard.patch\ncommands\nP 0 0 1 0\nQ 0 0 0 2 0 4\n",
    );
    run_examples(&files, "run", 20);
}

#[test]
fn wishes_that_make_no_sense() {
    for (wrong, found) in [
        ("-1", " of 0 or more, found -1"),
        ("nan", " of 0 or more, found NaN"),
        ("far", ", found the text 'far'"),
        ("2,5", ", found the text '2,5'"),
    ] {
        for (option, name) in [("tolerance", "CELLS"), ("max-cost", "CELLS"), ("timeout", "MS")] {
            check(
                &format!("run builtin:cave --{option} {wrong}"),
                &format!(
                    "invalid value '{wrong}' for '--{option} <{name}>': expected a number{found}; see --help"
                ),
            );
        }
    }
    for (wrong, found) in [("-1", "-1"), ("1.5", "1.5"), ("-9e9", "-9000000000")] {
        check(
            &format!("run builtin:cave --max-expansions {wrong}"),
            &format!(
                "invalid value '{wrong}' for '--max-expansions <N>': expected an integer of 0 or more, found {found}; \
                 see --help"
            ),
        );
    }
    check(
        "run builtin:cave --to 62,33 --to 28,21",
        "the following required arguments were not provided: --from <X,Y>; see --help",
    );
}

#[test]
fn limits_have_their_old_names_too() {
    let stopped = |limit: &str| query(&format!("{CAVE} --to 62,33 {limit}"))["stopped_by"].clone();
    assert_eq!([stopped("--max-nodes 9"), stopped("--deadline 0")], [json!("expansions"), json!("timeout")]);
    let help = run("run --help").stdout;
    assert!(!help.contains("--max-nodes") && !help.contains("--deadline"), "{help}");
}

#[test]
fn wishes_that_do_not_go_with_others() {
    for (wish, shown) in [
        ("--tolerance 2", "--tolerance <CELLS>"),
        ("--nearest", "--nearest"),
        ("--snap", "--snap"),
        ("--max-cost 9", "--max-cost <CELLS>"),
        ("--max-expansions 9", "--max-expansions <N>"),
        ("--timeout 9", "--timeout <MS>"),
    ] {
        check(
            &format!("run builtin:cave --engine dijkstra --from 2,5 {wish} --distances -"),
            &format!("the argument '{shown}' cannot be used with '--distances <FILE>'; see --help"),
        );
    }
    for (wish, shown) in [
        ("--tolerance 2", "--tolerance <CELLS>"),
        ("--nearest", "--nearest"),
        ("--timeout 9", "--timeout <MS>"),
    ] {
        check(
            &format!("run builtin:cave --from 2,5 --to 62,33 {wish} --trace t.json"),
            &format!("the argument '{shown}' cannot be used with '--trace <FILE>'; see --help"),
        );
    }
    let several = "run builtin:cave --from 2,5 --to 62,33 --to 28,21";
    check(&format!("{several} --trace t.json"), "--trace follows a single search: give --from and --to once");
    check(
        "run builtin:cave --engine dijkstra --from 2,5 --from 28,21 --distances -",
        "--distances begin at one vertex: give --from once",
    );
    check(
        &format!("{several} --every 2"),
        "the argument '--from <X,Y>' cannot be used with '--every <N>'; see --help",
    );
}

#[test]
fn ends_that_no_wish_mends() {
    let files = Files::new();
    let rock = files.add("rock.map", "type octile\nheight 1\nwidth 2\nmap\n@@\n");
    let check = |line: &str, message: &str| {
        let Ran { status, stderr, .. } = run(line);
        assert_eq!((stderr, status), (format!("error: {message}\n"), Some(1)), "{line}");
    };
    check(
        &format!("run {rock} --from 0,0 --to 1,0 --snap --nearest"),
        "the start (0, 0) is blocked, and no cell of the map is free: check which cells, characters or shades \
         count as free, and the size of the agent",
    );
    let blocked = "the goal (30, 20) is blocked: choose a free vertex; the nearest one is (28, 21)";
    check("run builtin:cave --from 2,5 --to 62,33 --to 30,20", blocked);
    check("run builtin:cave --from 2,5 --to 30,20 --tolerance 2 --max-expansions 9", blocked);
    let outside = "the goal (72, 0) is outside the map, whose vertices run from (0, 0) to (71, 35)";
    check("run builtin:cave --from 2,5 --to 72,0 --nearest --tolerance 9", outside);
    let start = "the start (0, 0) is blocked: choose a free vertex; the nearest one is (2, 1)";
    check("run builtin:cave --from 0,0 --to 62,33 --nearest", start);
}

#[test]
fn cells_count_otherwise_for_these_queries() {
    let files = Files::new();
    let map = files.add("agents.map", "type octile\nheight 3\nwidth 5\nmap\n.....\n@..@.\n.....\n");
    let ends = format!("run {map} --from 3,1 --to 0,1");
    assert_eq!(run(&ends).status, Some(1), "both ends are blocked");
    for engine in ["auto", "astar", "subgoal", "hpa"] {
        let (ran, queries, _) = told(&format!("{ends} --engine {engine} --free-ends"));
        assert_eq!((&ran["free_ends"], &queries[0]["cost"]), (&true.into(), &3.0.into()), "{engine}");
    }
    let (ran, queries, _) = told(&format!("{ends} --engine subgoal --free-ends --block 1,1 --block 2,0"));
    assert_eq!(ran["block"], serde_json::json!([[1, 1], [2, 0]]));
    assert!(
        queries[0]["cost"].as_f64() > Some(3.0) && queries[0]["searched_by"] == "jps-block",
        "{queries:?}"
    );
    let (_, queries, _) = told(&format!("run {map} --from 0,0 --to 0,2 --unblock 0,1"));
    assert_eq!(queries[0]["cost"], 2.0);
    let outside = run(&format!("{ends} --block 5,0"));
    assert!(outside.stderr.contains("an edit of cell (5, 0), outside the map"), "{}", outside.stderr);
}
