//! `mediant check`: what it says of paths, against the cells that they touch.

use std::{
    fs,
    io::Write,
    process::{Command, Stdio},
};

use mediant::Map;
use mediant_formats::MapFile;
use serde_json::{Value, json};

use crate::{
    common::{Files, Ran, add_example_files, bundled, run, run_examples, succeeds, told},
    errors::check,
};

/// The paths of a run, as a file.
#[track_caller]
fn paths(files: &Files, name: &str, options: &str) -> String {
    files.add(name, succeeds(&format!("run {options} --format jsonl")))
}

/// The records that a check prints: of the paths, and of the summary.
#[track_caller]
fn records(line: &str) -> (Vec<Value>, Value, Option<i32>) {
    let Ran { status, stdout, stderr } = run(&format!("check {line} --format jsonl"));
    assert_eq!(stderr, "", "{line}");
    let mut records: Vec<Value> =
        stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let summary = records.pop().expect("a summary");
    (records, summary, status)
}

#[test]
fn the_paths_of_every_run_hold() {
    let files = Files::new();
    for options in [
        "--k 2",
        "--corners one --k 5 --engine jps",
        "--corners always --smooth",
        "--placement corner --gap closed --k 4 --smooth=taut",
        "--engine theta --k 3",
        "--engine lazy-theta --placement corner",
        "--engine anya --gap closed",
        "--engine subgoal --k any",
        "--engine subgoal-theta",
        "--engine hpa",
    ] {
        let file = paths(&files, "cave.jsonl", &format!("builtin:cave --every 2 {options}"));
        assert_eq!(
            succeeds(&format!("check builtin:cave {file}")),
            "cave.map · all 16 paths hold\n",
            "{options}"
        );
    }
    let file = paths(&files, "isles.jsonl", "builtin:archipelago --radius 0.8 --from 16,7 --to 50,10");
    let held = "archipelago.map · the path holds\n";
    assert_eq!(succeeds(&format!("check builtin:archipelago {file} --radius 0.8")), held);
}

/// The cells of a path between centers over N(2), in order.
fn cells(path: &[(i32, i32)]) -> Vec<(i32, i32)> {
    let mut cells = vec![path[0]];
    for &(x, y) in &path[1..] {
        while let Some(&(a, b)) = cells.last().filter(|&&last| last != (x, y)) {
            cells.push((a + (x - a).signum(), b + (y - b).signum()));
        }
    }
    cells
}

#[test]
fn the_first_blocked_cell_on_a_path_is_named() {
    let files = Files::new();
    let (_, queries, _) = told("run builtin:cave --k 2");
    let file = paths(&files, "cave.jsonl", "builtin:cave --k 2");
    let cave = Map::open(bundled("cave.map")).expect("a map");
    let is_blocked = |x: i32, y: i32| cave.is_blocked((x, y)) || (7 * x + 13 * y) % 61 == 0;
    let edited = Map::from_fn(cave.width(), cave.height(), |x, y| is_blocked(x as i32, y as i32));
    let text = MapFile::from_grid(edited.expect("a map").grid());
    let map = files.add("edited.map", text.as_bytes());
    let (found, summary, status) = records(&format!("{map} {file}"));
    assert_eq!(found.len(), queries.len());
    let mut broken = 0;
    for (found, query) in found.iter().zip(&queries) {
        let path: Vec<(i32, i32)> = serde_json::from_value(query["path"].clone()).expect("a path");
        let first = cells(&path).into_iter().find(|&(x, y)| is_blocked(x, y));
        assert_eq!((found["holds"].as_bool(), &found["index"]), (Some(first.is_none()), &query["index"]));
        broken += u64::from(first.is_some());
        let Some(cell) = first else { continue };
        let ends = [path[0], path[path.len() - 1]];
        if ends.iter().any(|&(x, y)| is_blocked(x, y)) {
            assert_eq!((&found["holds_up_to"], found.get("cell")), (&json!(0), None), "{found}");
            continue;
        }
        assert_eq!(found["cell"], json!(cell), "{found}");
        let segment = found["segment"].as_u64().expect("a segment") as usize;
        assert_eq!((&found["from"], &found["to"]), (&json!(path[segment]), &json!(path[segment + 1])));
        assert_eq!(found["holds_up_to"], json!(segment + 1));
        assert!(cells(&path[..=segment]).iter().all(|&(x, y)| !is_blocked(x, y)), "{found}");
    }
    assert!(0 < broken && broken < found.len() as u64, "{broken}");
    assert_eq!(summary, json!({"type": "summary", "map": "edited.map", "paths": 32, "broken": broken}));
    assert_eq!(status, Some(1));
}

#[test]
fn segments_are_moves_of_the_neighborhood() {
    let files = Files::new();
    let (_, queries, _) = told("run builtin:cave --engine theta --k 3");
    let file = paths(&files, "theta.jsonl", "builtin:cave --engine theta --k 3");
    let (found, ..) = records(&format!("builtin:cave {file} --k 3"));
    let mut broken = 0;
    for (found, query) in found.iter().zip(&queries) {
        let path: Vec<(i32, i32)> = serde_json::from_value(query["path"].clone()).expect("a path");
        let is_octile = |ends: &[(i32, i32)]| {
            let (dx, dy) = ((ends[0].0 - ends[1].0).abs(), (ends[0].1 - ends[1].1).abs());
            dx == 0 || dy == 0 || dx == dy
        };
        let wrong = path.windows(2).position(|ends| !is_octile(ends));
        assert_eq!(found.get("segment"), wrong.map(|index| json!(index)).as_ref(), "{found}");
        // To the first waypoint of that segment it can be followed.
        assert_eq!(found.get("holds_up_to"), wrong.map(|index| json!(index + 1)).as_ref(), "{found}");
        broken += usize::from(wrong.is_some());
    }
    assert!(broken > 5, "{broken}");
    assert_eq!(succeeds(&format!("check builtin:cave {file} --k any --placement center")).lines().count(), 1);
}

#[test]
fn options_count_more_than_the_run() {
    let files = Files::new();
    let cut = paths(&files, "cut.jsonl", "builtin:cave --corners always --k 5");
    let open = paths(&files, "open.jsonl", "builtin:maze --placement corner");
    for (line, holds) in [
        (format!("builtin:cave {cut}"), true),
        (format!("builtin:cave {cut} --corners never"), false),
        (format!("builtin:cave {cut} --k 6"), true),
        (format!("builtin:cave {cut} --k 3"), false),
        (format!("builtin:cave {cut} --k 3 --corners always"), false),
        (format!("builtin:maze {open}"), true),
        (format!("builtin:maze {open} --placement center"), false),
    ] {
        let (found, _, status) = records(&line);
        let broken = found.iter().filter(|path| path["holds"] == false).count();
        assert_eq!((status, broken == 0), (Some(i32::from(!holds)), holds), "{line}: {broken}");
    }
}

#[test]
fn the_text_says_where() {
    let files = Files::new();
    let lines = [
        json!({"type": "query", "index": 3, "path": [[2, 5], [30, 20]]}),
        json!({"type": "query", "index": 4, "path": []}),
        json!({"type": "query", "index": 5, "path": [[2, 5], [99, 20]]}),
        json!({"type": "query", "index": 6, "path": [[3, 1], [22, 1]]}),
        json!({"type": "query", "index": 7, "path": [[3, 1], [4, 2]]}),
        json!({"type": "query", "index": 8, "path": [[3, 2], [5, 3]]}),
        json!({"type": "summary", "queries": 6}),
    ];
    let file = files.add("q.jsonl", lines.map(|line| line.to_string()).join("\n"));
    let Ran { status, stdout, stderr } = run(&format!("check builtin:cave {file} --k 3"));
    assert_eq!((stderr.as_str(), status), ("", Some(1)));
    let expected = "\
q.jsonl, path 3: the goal of the path, (30, 20), is blocked now: choose a free vertex
q.jsonl, path 5: waypoint 1 of the path, (99, 20), is outside the map: the path is that of a larger map
q.jsonl, path 6: segment 0 of the path, from (3, 1) to (22, 1), does not hold: cell (4, 1) is blocked
q.jsonl, path 7: segment 0 of the path, from (3, 1) to (4, 2), does not hold: cell (4, 1) is blocked
q.jsonl, path 8: segment 0 of the path, from (3, 2) to (5, 3), is not made of moves of N(3)
cave.map · 5 of 5 paths do not hold
";
    assert_eq!(files.strip(&stdout), expected);
    let cut = run(&format!("check builtin:cave {file} --corners always")).stdout;
    assert!(!cut.contains("path 7") && !cut.contains("path 8"), "{cut}");
}

#[test]
fn a_path_for_an_agent_holds_on_its_map() {
    let files = Files::new();
    let file = paths(&files, "isles.jsonl", "builtin:archipelago");
    for options in ["--radius 0.8", "--radius 1.2 --k 3"] {
        let map = files.path("agent.map");
        succeeds(&format!("convert builtin:archipelago {options} -o {map}"));
        let (on_map, ..) = records(&format!("{map} {file}"));
        let (found, summary, _) = records(&format!("builtin:archipelago {file} {options}"));
        assert_eq!(found, on_map, "{options}");
        assert!(summary["broken"].as_u64() > Some(0), "{summary}");
    }
}

#[test]
fn a_table_is_one_path() {
    let files = Files::new();
    let plain = files.add("plain.csv", "2,5\n3,5\n3,2\n");
    let named = files.add("named.csv", "t,y,x\n0,5.0,2\n1,5,3\n2,2,3e0\n");
    for file in [plain, named] {
        assert_eq!(succeeds(&format!("check builtin:cave {file} --k 2")), "cave.map · the path holds\n");
    }
    let corner = files.add("corner.csv", "2,2\n4,2\n");
    assert_eq!(run(&format!("check builtin:cave {corner} --placement corner --gap closed")).status, Some(0));
    let yaml = files.path("cave.yaml");
    succeeds(&format!("convert builtin:cave --resolution 0.5 -o {yaml}"));
    // The centers of cells (3, 1) and (22, 1).
    let world = files.add("world.csv", "x,y\n1.75,17.25\n11.25,17.25\n");
    let Ran { status, stdout, .. } = run(&format!("check {yaml} {world} --world"));
    let said = "world.csv, path 0: segment 0 of the path, from (3, 1) to (22, 1), does not hold: cell (4, 1) is \
                blocked, whose center is at (2.250, 17.250) m\ncave.yaml · the path does not hold\n";
    assert_eq!((files.strip(&stdout).as_str(), status), (said, Some(1)));
}

#[test]
fn paths_may_come_from_a_pipe() {
    let jsonl = succeeds("run builtin:cave --k 4 --format jsonl")
        + &succeeds("run builtin:cave --engine anya --format jsonl");
    let mut child = Command::new(env!("CARGO_BIN_EXE_mediant"))
        .args(["check", "builtin:cave", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    child.stdin.take().expect("a pipe").write_all(jsonl.as_bytes()).expect("it reads");
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(String::from_utf8_lossy(&output.stdout), "cave.map · all 64 paths hold\n");
}

#[test]
fn files_without_paths() {
    let files = Files::new();
    let none = "no path in it: give what `mediant run --format jsonl` prints of queries that have one, or a CSV \
                with the columns x and y";
    for (text, problem) in [
        ("", none),
        ("x,y\n", none),
        ("{\"type\":\"summary\"}\n", none),
        (
            "{\"type\":\"run\"}\n",
            "line 1: expected a line of `mediant run --format jsonl`: missing field `engine`",
        ),
        ("{}\n{\n", "line 1: expected a line of `mediant run --format jsonl`: missing field `type`"),
        (
            "{\"type\":\"run\",\"engine\":\"warp\",\"k\":3,\"placement\":\"center\",\"corners\":\"never\",\"gap\":\"open\"}",
            "line 1: the run: ",
        ),
        ("1,1\n\n2;3\n", "line 3: expected x,y in the columns 1 and 2, found `2;3`"),
        ("y,x\n1\n", "line 2: expected x,y in the columns 2 and 1, found `1`"),
        (
            "1,1\n2.5,3\n",
            "line 2: (2.5, 3) is no vertex: write whole numbers, such as 3,14, or --k any, or meters with --world",
        ),
    ] {
        let file = files.add("odd.txt", text);
        let Ran { status, stdout, stderr } = run(&format!("check builtin:cave {file}"));
        assert_eq!((&*stdout, status, stderr.lines().count()), ("", Some(2), 1), "{text}: {stderr}");
        let said = files.strip(&stderr);
        assert!(said.starts_with(&format!("error: odd.txt: {problem}")), "{text}: {said}");
    }
    let (missing, folder) = (files.path("missing.jsonl"), files.path(""));
    check(
        &format!("check builtin:cave {missing}"),
        &format!("{missing}: no such file; check the path and the folder that you are in"),
    );
    let directory = format!("{folder}: expected a file, found a directory; name a file in it");
    check(&format!("check builtin:cave {folder}"), &directory);
    check("check builtin:cave", "the following required arguments were not provided: <PATHS>...; see --help");
    let file = files.add("p.csv", "2,5\n");
    check(
        &format!("check builtin:cave {file} --placement center --gap open"),
        "--gap: at centers it is for k = any; else there is corners in its place: never, one or always",
    );
}

#[test]
fn the_examples_of_the_help_run() {
    let files = Files::new();
    add_example_files(&files);
    let arena = files.path("arena.map");
    paths(&files, "arena.jsonl", &format!("{arena} --from 1,11 --to 40,30"));
    files.add("arena.csv", "x,y\n1,11\n20,30\n40,30\n");
    files.add("depot.csv", "x,y\n0.5,0.5\n1.5,0.8\n");
    paths(&files, "friction.jsonl", &format!("{} --from 1,11 --to 40,30", files.path("friction.tif")));
    paths(&files, "walk.jsonl", &format!("{} --elevation --from 1,11 --to 40,30", files.path("dem.tif")));
    run_examples(&files, "check", 6);
    assert!(fs::exists(files.path("arena.csv")).expect("a folder"));
}
