//! Lengths without paths, and tables of them.

use serde_json::{Value, json};

use super::common::{Files, add_example_files, run, run_examples};

/// The objects of a jsonl output.
fn objects(line: &str) -> Vec<Value> {
    let ran = run(line);
    assert_eq!(ran.status, Some(0), "{line}: {}", ran.stderr);
    ran.stdout.lines().map(|line| serde_json::from_str(line).expect("an object")).collect()
}

/// The lengths of a run, by query.
fn lengths(line: &str) -> Vec<f64> {
    let of = |object: &Value| object["cost"].as_f64();
    objects(line)
        .iter()
        .filter(|object| object["type"] == "query")
        .map(|object| of(object).expect("a path"))
        .collect()
}

#[test]
fn distances_are_the_costs_of_the_paths() {
    for options in
        ["--engine subgoal", "--engine subgoal --k any", "--engine jps", "--engine subgoal --smooth"]
    {
        let line = format!("run builtin:town --format jsonl {options}");
        let (paths, measured) = (lengths(&line), lengths(&format!("{line} --distance")));
        assert_eq!((paths.len(), measured.len()), (22, 22));
        for (path, length) in paths.iter().zip(&measured) {
            assert!((path - length).abs() < 1e-9 * path, "{options}: {path}, {length}");
        }
        let found = objects(&format!("{line} --distance --limit 1"));
        assert_eq!(found[0]["distance"], true);
        assert_eq!((found[1].get("path"), &found[1]["smoothness"]), (None, &Value::Null), "{options}");
        assert!(found[1]["lower_bound"].as_f64() > Some(0.0) && found[1]["nanos"].as_u64() > Some(0));
        assert_eq!(found[2]["mean_smoothness"], Value::Null);
    }
    let shown = run("run builtin:town --engine subgoal --from 10,3 --to 60,29 --distance").stdout;
    assert!(shown.contains("lengths without paths") && !shown.contains("waypoints"), "{shown}");
    assert!(shown.ends_with("longer than the shortest path at any angle (certificate)\n"), "{shown}");
}

#[test]
fn distances_do_not_go_with_what_needs_a_path() {
    for (options, said) in [
        ("--distance --nearest", "cannot be used with"),
        ("--distance --draw", "cannot be used with"),
        ("--distance --max-nodes 3", "cannot be used with"),
        (
            "--distance --to 11,3",
            "--distance is for one start and one goal: for several there is mediant table",
        ),
    ] {
        let ran = run(&format!("run builtin:town --from 10,3 --to 60,29 {options}"));
        assert!(ran.status == Some(2) && ran.stderr.contains(said), "{options}: {}", ran.stderr);
    }
}

/// Every form of the same table, by labels, by a contraction hierarchy and by A*.
#[test]
fn tables_have_the_lengths_of_single_runs() {
    let files = Files::new();
    let ends = "--from 10,3 --from 58,18 --to 6,6 --to 60,29 --to 10,3";
    let lines: Vec<String> =
        [("10,3", "6,6"), ("10,3", "60,29"), ("58,18", "6,6"), ("58,18", "60,29"), ("58,18", "10,3")]
            .map(|(from, to)| format!("run builtin:town --engine jps --format jsonl --from {from} --to {to}"))
            .to_vec();
    let single: Vec<f64> = lines.iter().map(|line| lengths(line)[0]).collect();
    let expected = [[single[0], single[1], 0.0], [single[2], single[3], single[4]]];
    let from = files.add("from.txt", "10,3\r\n\n58, 18\n");
    let to = files.add("to.txt", "60,29\n10,3");
    let index = files.path("town.idx");
    assert_eq!(run(&format!("build builtin:town --engine subgoal -o {index}")).status, Some(0));
    for line in [
        format!("table builtin:town {ends}"),
        format!("table builtin:town {ends} --levels contracted"),
        format!("table builtin:town {ends} --engine astar"),
        format!("table builtin:town {ends} --index {index}"),
        format!("table builtin:town --from-file {from} --to 6,6 --to-file {to}"),
    ] {
        let found = objects(&format!("{line} --format jsonl"));
        assert_eq!(
            (&found[0]["type"], &found[0]["starts"], &found[0]["goals"]),
            (&json!("table"), &json!(2), &json!(3))
        );
        assert_eq!(found[0]["searched_by"], found[0]["engine"], "{line}");
        for (row, expected) in found[1..3].iter().zip(&expected) {
            let distances = row["distances"].as_array().expect("distances");
            for (distance, expected) in distances.iter().zip(expected) {
                let distance = distance.as_f64().expect("a way");
                assert!((distance - expected).abs() < 1e-8, "{line}: {distance}, {expected}");
            }
        }
        assert_eq!((&found[2]["start"], &found[3]["type"]), (&json!([58, 18]), &json!("summary")), "{line}");
        let csv = run(&format!("{line} --format csv")).stdout;
        let rows: Vec<&str> = csv.lines().collect();
        assert_eq!((rows.len(), rows[0]), (7, "start_x,start_y,goal_x,goal_y,distance"), "{line}");
        assert!(rows[5].starts_with(&format!("58,18,60,29,{:.6}", single[3])), "{line}: {csv}");
        let shown = run(&line).stdout;
        assert!(
            shown.contains(&format!("{:.4}", single[2])) && shown.contains("2 starts, 3 goals"),
            "{shown}"
        );
    }
}

#[test]
fn the_nearest_goal_is_found() {
    for engine in ["subgoal", "subgoal --levels 2", "jps"] {
        let line = format!(
            "table builtin:town --engine {engine} --from 10,3 --from 60,28 --to 60,29 --to 6,6 --nearest"
        );
        let found = objects(&format!("{line} --format jsonl"));
        assert_eq!(
            found[2],
            json!({"type": "row", "start": [60, 28], "goal": [60, 29], "number": 0, "distance": 1.0})
        );
        assert_eq!((&found[1]["goal"], &found[1]["number"]), (&json!([6, 6]), &json!(1)));
        let csv = run(&format!("{line} --format csv")).stdout;
        assert!(csv.ends_with("\n60,28,60,29,1\n"), "{csv}");
        let shown = run(&line).stdout;
        assert!(shown.ends_with("  (60, 28)  (60, 29)      1.0000\n"), "{shown}");
    }
}

#[test]
fn where_there_is_no_way_there_is_no_length() {
    let files = Files::new();
    let map = files.add("two.map", "type octile\nheight 1\nwidth 3\nmap\n.@.\n");
    let line = format!("table {map} --from 0,0 --to 2,0 --to 0,0");
    assert_eq!(objects(&format!("{line} --format jsonl"))[1]["distances"], json!([null, 0.0]));
    assert!(run(&format!("{line} --format csv")).stdout.contains("\n0,0,2,0,\n0,0,0,0,0\n"));
    assert!(run(&line).stdout.contains("no way"));
    let line = format!("table {map} --from 0,0 --to 2,0 --nearest");
    let row = json!({"type": "row", "start": [0, 0], "goal": null, "number": null, "distance": null});
    assert_eq!(objects(&format!("{line} --format jsonl"))[1], row);
    assert!(run(&format!("{line} --format csv")).stdout.ends_with("\n0,0,,,\n"));
    assert!(run(&line).stdout.contains("no way to any"));
}

#[test]
fn bad_ends_are_named() {
    let files = Files::new();
    let wrong = files.add("wrong.txt", "10,3\n\nx,3\n");
    for (options, status, said) in [
        (
            "--to 10,3".to_owned(),
            2,
            "error: no starts: give --from X,Y, or --from-file a file with one x,y a line",
        ),
        (
            "--from 10,3".to_owned(),
            2,
            "error: no goals: give --to X,Y, or --to-file a file with one x,y a line",
        ),
        ("--from 5,5 --to 10,3".to_owned(), 1, "error: the start (5, 5) is blocked"),
        ("--from 10,3 --to 999,0 --nearest".to_owned(), 1, "error: the goal (999, 0) is outside the map"),
        (format!("--from-file {wrong} --to 10,3"), 2, "wrong.txt: line 3: `x` is no number"),
        (format!("--from-file {wrong}.none --to 10,3"), 2, "wrong.txt.none: no such file"),
        ("--from 10,3 --to 10,3 --engine anya --levels 2".to_owned(), 2, "error: anya takes no levels"),
    ] {
        let ran = run(&format!("table builtin:town {options}"));
        assert!(ran.status == Some(status) && ran.stderr.contains(said), "{options}: {ran:?}");
    }
}

#[test]
fn memory_is_read_strictly() {
    let made = |memory: &str| {
        let found =
            objects(&format!("run builtin:town --engine subgoal --format jsonl --limit 1 --memory {memory}"));
        (found[0]["levels"].clone(), found[0]["memory"].clone())
    };
    assert_eq!(made("8MB"), (json!("labels"), json!(8_000_000)));
    assert_eq!(made("1000"), (json!("contracted"), json!(1000)));
    let ran = run("run builtin:town --engine subgoal --memory 8MiB");
    let said = "expected a whole number of bytes from 1 up, also as 500kB, 8MB or 1GB";
    assert!(ran.status == Some(2) && ran.stderr.contains(said), "{}", ran.stderr);
    let ran = run("run builtin:town --engine subgoal --levels labels --memory 1kB");
    let said =
        "the hub labels take more than 1000 bytes: allow more memory, or prepare a contraction hierarchy";
    assert!(ran.status == Some(2) && ran.stderr.contains(said), "{}", ran.stderr);
}

/// Noise, of which nothing is kept.
#[test]
fn the_program_says_which_engine_searches() {
    let files = Files::new();
    let mut state = 1_u64;
    let mut cell = || {
        // Numbers without a pattern (Marsaglia 2003).
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        if state.is_multiple_of(20) { '@' } else { '.' }
    };
    let rows: Vec<String> = (0..120).map(|_| (0..120).map(|_| cell()).collect()).collect();
    let map =
        files.add("noise.map", format!("type octile\nheight 120\nwidth 120\nmap\n{}\n", rows.join("\n")));
    let index = files.path("noise.idx");
    let falls = "subgoal falls back to anya: on this map its graph would be slower than no index\n";
    let built = run(&format!("build {map} --engine subgoal --k any -o {index}")).stdout;
    assert!(built.ends_with(falls), "{built}");
    let line = format!("{map} --engine subgoal --k any --index {index} --from 0,0 --to 120,120");
    assert!(run(&format!("run {line}")).stdout.contains(&format!("\n{falls}")));
    assert!(run(&format!("table {line}")).stdout.contains(&format!("\n{falls}")));
    let found = objects(&format!("run {line} --format jsonl"));
    assert_eq!((&found[0]["engine"], &found[0]["searched_by"]), (&json!("subgoal"), &json!("anya")));
    assert_eq!((&found[0]["levels"], &found[0]["guarantee"]), (&Value::Null, &json!("optimal(any)")));
}

#[test]
fn the_examples_of_the_help_run() {
    let files = Files::new();
    add_example_files(&files);
    for name in ["homes.txt", "hotels.txt", "goals.txt"] {
        files.add(name, "1,11\n40,30\n");
    }
    let (map, index) = (files.path("arena.map"), files.path("arena.idx"));
    assert_eq!(run(&format!("build {map} --engine subgoal --k any -o {index}")).status, Some(0));
    run_examples(&files, "table", 4);
}
