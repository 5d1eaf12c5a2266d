//! Maps that change: timelines.

use std::collections::BTreeMap;

use mediant::{Engine, Map, Motion, Rectangle, Setup};
use serde_json::{Value, json};

use crate::{
    common::{Files, Ran, bundled, refused, run, run_on, shown, succeeds, told},
    errors::check,
};

/// SplitMix64 (Steele, Lea and Flood 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn below(&mut self, end: u32) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % u64::from(end)) as u32
    }
}

/// A random timeline for the bundled map `cave`: edits of 1 × 1 to 4 × 3 cells, many of which alter little,
/// and queries between cells that are free when they are asked.
fn timeline(seed: u64, events: usize) -> String {
    let (mut random, mut map) = (Random(seed), cave());
    let mut lines = String::new();
    for _ in 0..events {
        if random.below(2) == 0 {
            let (width, height) = (1 + random.below(4), 1 + random.below(3));
            let (x, y) = (random.below(map.width() - width + 1), random.below(map.height() - height + 1));
            let share = random.below(4);
            let rows: Vec<String> = (0..height)
                .map(|_| (0..width).map(|_| if random.below(3) < share { '#' } else { '.' }).collect())
                .collect();
            let edit = json!({"type": "edit", "x": x, "y": y, "rows": rows, "more": random.below(4) == 0});
            map = edited(&map, &edit);
            lines += &format!("{edit}\n");
        } else {
            let mut free = || loop {
                let at = (random.below(map.width()) as i32, random.below(map.height()) as i32);
                if map.is_free(at) {
                    return at;
                }
            };
            lines += &format!("{}\n", json!({"type": "query", "start": free(), "goal": free()}));
        }
    }
    lines
}

fn cave() -> Map {
    Map::open(bundled("cave.map")).expect("a map")
}

/// The rows of an edit.
fn rows(edit: &Value) -> Vec<&[u8]> {
    let rows = edit["rows"].as_array().expect("rows");
    rows.iter().map(|row| row.as_str().expect("a row").as_bytes()).collect()
}

/// The map after an edit.
fn edited(map: &Map, edit: &Value) -> Map {
    let rows = rows(edit);
    let [x, y] = ["x", "y"].map(|key| edit[key].as_u64().expect("a number") as u32);
    let at = Rectangle::new(x, y, rows[0].len() as u32, rows.len() as u32);
    map.edit(at, |i, j| rows[(j - y) as usize][(i - x) as usize] == b'#').expect("an edit on the map")
}

/// The records of a run on a timeline, without those of the run and of the summary, and these two.
#[track_caller]
pub(crate) fn events(line: &str) -> (Value, Vec<Value>, Value) {
    let (run, events, summary) = told(line);
    assert!(events.iter().all(|event| event["type"] == "edit" || event["type"] == "query"), "{line}");
    (run, events, summary)
}

/// The number of cells in which two maps differ.
fn differing(a: &Map, b: &Map) -> u64 {
    let cells = (0..a.height()).flat_map(|y| (0..a.width()).map(move |x| (x as i32, y as i32)));
    cells.filter(|&at| a.is_blocked(at) != b.is_blocked(at)).count() as u64
}

/// Replays events on maps of their own: the cells of each edit, and the cost of each query by the setup, if
/// its costs are those of a new planner.
#[track_caller]
fn replay(events: &[Value], (seed, setup): (u64, &str), same_cost: bool) {
    let setup: Setup = setup.parse().expect("a setup");
    let context = format!("seed {seed}, {setup}");
    let (mut map, mut planner) = (cave(), None);
    for event in events {
        if event["type"] == "edit" {
            let after = edited(&map, event);
            assert_eq!(event["cells"], differing(&map, &after), "{context}: {event}");
            assert_eq!(event["nanos"] == 0, event["more"] == true, "{context}: {event}");
            (map, planner) = (after, None);
            continue;
        }
        let planner = planner.get_or_insert_with(|| setup.planner(&map).expect("a planner"));
        let at = |key: &str| serde_json::from_value::<(i32, i32)>(event[key].clone()).expect("a vertex");
        let path = planner.path(at("start"), at("goal")).expect("free ends");
        assert_eq!(
            event["status"],
            if path.is_some() { "found" } else { "unreachable" },
            "{context}: {event}"
        );
        let costs = path.map(|path| path.cost()).zip(event["cost"].as_f64());
        if let Some((cost, told)) = costs.filter(|_| same_cost) {
            assert!((cost - told).abs() < 1e-9, "{context}: {cost} instead of {event}");
        }
    }
}

#[test]
fn every_engine_follows_edits() {
    let files = Files::new();
    for (number, (setup, options)) in [
        ("astar:3:never", "--engine astar"),
        ("astar:5:closed", "--engine astar --k 5 --gap closed"),
        ("dijkstra:2:one", "--engine dijkstra --k 2 --corners one"),
        ("wavefront:3:never", "--engine wavefront"),
        ("canonical:4:always", "--engine canonical --k 4 --corners always"),
        ("jps:5:open", "--engine jps --k 5 --placement corner"),
        ("jps-block:3:never", "--engine jps-block"),
        ("jps-block:2:closed", "--engine jps-block --k 2 --gap closed"),
        ("jps-plus:3:never", "--engine jps-plus"),
        ("theta:3:never", "--engine theta"),
        ("lazy-theta:3:open", "--engine lazy-theta --placement corner"),
        ("anya:any:open", "--engine anya"),
        ("anya:5:closed", "--engine anya --k 5 --gap closed"),
        ("subgoal:any:closed", "--engine subgoal --k any --gap closed"),
        ("subgoal:3:never", "--engine subgoal"),
        ("subgoal-theta:3:open", "--engine subgoal-theta"),
        ("hpa:3:never", "--engine hpa"),
        ("chpa:2:never", "--engine chpa --k 2"),
    ]
    .into_iter()
    .enumerate()
    {
        let seed = 7 + number as u64;
        let file = files.add("timeline.jsonl", timeline(seed, 60));
        let line = format!("run builtin:cave --edits {file} {options}");
        let (run, events, summary) = events(&line);
        let edits = events.iter().filter(|event| event["type"] == "edit");
        let (mut cells, mut nanos, mut changes) = (0, 0, 0);
        for edit in edits.clone() {
            cells += edit["cells"].as_u64().expect("a number");
            nanos += edit["nanos"].as_u64().expect("a time");
            changes += u64::from(edit["more"] != true);
        }
        let edits = edits.count();
        let told = &summary["edits"];
        assert_eq!(run["edits"], edits, "seed {seed}");
        assert_eq!(told["edits"], edits, "seed {seed}");
        assert_eq!((&told["cells"], &told["total_nanos"]), (&json!(cells), &json!(nanos)), "seed {seed}");
        assert_eq!(told["changes"], changes, "seed {seed}");
        assert_eq!(run["queries"], events.len() - edits, "seed {seed}");
        // Whether a path is as long as that of a new index is promised where it is a shortest one.
        let same_cost =
            !setup.starts_with("theta") && !setup.starts_with("lazy") && !setup.contains("-theta");
        replay(&events, (seed, setup), same_cost);
        let held = succeeds(&format!(
            "check builtin:cave {}",
            files.add("out.jsonl", succeeds(&format!("{line} --format jsonl")))
        ));
        assert!(held.ends_with("paths hold\n"), "seed {seed}: {held}");
    }
}

/// The status and the cost of each query, by its index. Costs are rounded: a length without a path is a sum
/// of integers.
pub(crate) fn costs(events: &[Value]) -> BTreeMap<u64, (String, String)> {
    let queries = events.iter().filter(|event| event["type"] == "query");
    let cost = |query: &Value| query["cost"].as_f64().map_or_else(String::new, |cost| format!("{cost:.6}"));
    let answer = |query: &Value| {
        let index = query["index"].as_u64().expect("a number");
        (index, (query["status"].to_string(), cost(query)))
    };
    queries.map(answer).collect()
}

#[test]
fn options_go_with_edits() {
    let files = Files::new();
    let text = timeline(1, 80);
    let file = files.add("timeline.jsonl", &text);
    let line = format!("run builtin:cave --edits {file}");
    let (run, all, summary) = events(&line);
    assert_eq!(
        (&run["engine"], &run["asked"], &run["scenario"]),
        (&json!("jps-block"), &json!("auto"), &json!("timeline.jsonl"))
    );
    assert_eq!(summary["errors"], 0);
    replay(&all, (1, "astar:3:never"), true);

    // A part of the queries, but all edits before them.
    let (_, third, _) = events(&format!("{line} --every 3"));
    assert!(costs(&third).iter().all(|(index, cost)| index % 3 == 0 && costs(&all)[index] == *cost));
    assert_eq!(costs(&third).len(), costs(&all).len().div_ceil(3));
    let edits = |events: &[Value]| events.iter().filter(|event| event["type"] == "edit").count();
    assert_eq!(edits(&third), edits(&all));
    let (_, few, _) = events(&format!("{line} --limit 5"));
    let fifth = all.iter().position(|event| event["index"] == 4).expect("five queries");
    assert_eq!((costs(&few).len(), few.len()), (5, fifth + 1));

    let (_, lengths, _) = events(&format!("{line} --distance --repeat 3"));
    assert_eq!(costs(&lengths), costs(&all));
    // Cells that count otherwise for each query, on the map of the time.
    let longest = all.iter().max_by_key(|event| event["path"].as_array().map_or(0, Vec::len));
    let path: Vec<(i32, i32)> =
        serde_json::from_value(longest.expect("a query")["path"].clone()).expect("a path");
    let blocked: String = path[1..path.len() - 1].iter().map(|(x, y)| format!(" --block {x},{y}")).collect();
    let cells = format!("--free-ends --unblock 4,1{blocked}");
    let [by_blocks, by_cells] =
        ["jps-block", "astar"].map(|engine| costs(&events(&format!("{line} --engine {engine} {cells}")).1));
    assert_eq!(by_blocks, by_cells);
    assert_ne!(by_blocks, costs(&all));
    let index = files.path("cave.idx");
    succeeds(&format!("build builtin:cave --engine jps-plus -o {index}"));
    let (_, loaded, _) = events(&format!("{line} --engine jps-plus --index {index}"));
    assert_eq!(costs(&loaded), costs(&all));
    // Smoothed, and compared with paths at any angle of their own.
    let (_, smooth, _) = events(&format!("{line} --smooth --placement corner --reference anya"));
    let (_, any, _) = events(&format!("{line} --engine anya"));
    for (smooth, any) in smooth.iter().zip(&any).filter(|(smooth, _)| smooth["status"] == "found") {
        let [cost, best] = [&smooth["any_angle"], &any["cost"]].map(|cost| cost.as_f64().expect("a cost"));
        assert!((cost - best).abs() < 1e-9, "{smooth} {any}");
    }
    // The output of one run is a timeline for another.
    let printed = succeeds(&format!("{line} --format jsonl"));
    let again = files.add("printed.jsonl", printed);
    assert_eq!(costs(&events(&format!("run builtin:cave --edits {again} --engine astar")).1), costs(&all));
    let Ran { stdout, .. } = run_on("run builtin:cave --edits - --format jsonl", &text);
    let piped: Vec<Value> = stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!((costs(&piped), &piped[0]["scenario"]), (costs(&all), &json!("stdin")));
}

#[test]
fn an_agent_keeps_off_obstacles_that_come() {
    let files = Files::new();
    let file = files.add("timeline.jsonl", timeline(5, 150));
    let line = format!("run builtin:cave --edits {file} --radius 0.6");
    let Ran { stdout, .. } = run(&format!("{line} --format jsonl"));
    let (mut map, mut found) = (cave(), 0);
    let motion = Motion::default();
    for event in stdout.lines().map(|line| serde_json::from_str::<Value>(line).expect("JSON")) {
        match event["type"].as_str() {
            Some("edit") => {
                let after = edited(&map, &event);
                assert_eq!(event["cells"], differing(&map, &after), "{event}");
                map = after;
            }
            Some("query") => {
                let at =
                    |key: &str| serde_json::from_value::<(i32, i32)>(event[key].clone()).expect("a vertex");
                let of_agent = map.for_disc(0.6, motion).expect("a map").space(motion).expect("a space");
                let expected =
                    of_agent.planner(Engine::AStar).expect("a planner").path(at("start"), at("goal"));
                match expected {
                    Ok(Some(path)) => {
                        found += 1;
                        let cost = event["cost"].as_f64().expect("a cost");
                        assert!((cost - path.cost()).abs() < 1e-9, "{event}");
                    }
                    Ok(None) => assert_eq!(event["status"], "unreachable", "{event}"),
                    Err(_) => assert_eq!(event["status"], "error", "{event}"),
                }
            }
            _ => {}
        }
    }
    assert!(found > 3, "{found}");
    let paths = files.add("out.jsonl", stdout);
    assert!(succeeds(&format!("check builtin:cave {paths} --radius 0.6")).ends_with("paths hold\n"));
}

#[test]
fn a_check_follows_the_edits_of_each_run() {
    let files = Files::new();
    let edit = json!({"type": "edit", "x": 3, "y": 5, "rows": ["#"]});
    let query = json!({"type": "query", "start": [2, 5], "goal": [4, 5]});
    let file = files.add("t.jsonl", format!("{query}\n{edit}\n{query}\n"));
    let printed = succeeds(&format!("run builtin:cave --edits {file} --format jsonl"));
    let both = files.add("both.jsonl", printed.repeat(2));
    assert_eq!(succeeds(&format!("check builtin:cave {both}")), "cave.map · all 4 paths hold\n");
    // The first path leads through the cell that the edit blocks.
    let turned: Vec<&str> = printed.lines().collect();
    let turned = files.add("turned.jsonl", [turned[0], turned[2], turned[1], turned[3]].join("\n"));
    let Ran { stdout, status, .. } = run(&format!("check builtin:cave {turned}"));
    assert!(
        stdout.contains(
            "path 0: segment 0 of the path, from (2, 5) to (4, 5), does not hold: cell (3, 5) is blocked"
        ),
        "{stdout}"
    );
    assert_eq!(status, Some(1));
    let outside = printed.replace("\"x\":3", "\"x\":72");
    let outside = files.add("outside.jsonl", outside);
    let text = refused(&files, &format!("check builtin:cave {outside}"));
    assert_eq!(
        text,
        "error: outside.jsonl: line 3: the edit of 1 × 1 cells at (72, 5) is not on the map, which has 72 × 36 cells\n"
    );
    let grounds =
        files.add("grounds.jsonl", printed.replacen("\"queries\"", "\"grounds\":true,\"queries\"", 1));
    let text = refused(&files, &format!("check builtin:cave {grounds}"));
    assert!(text.contains("line 3: a run with --grounds has no edits"), "{text}");
}

#[test]
fn a_timeline_in_words() {
    let files = Files::new();
    let file = files.add("timeline.jsonl", timeline(3, 50));
    insta::assert_snapshot!(shown(&format!("run builtin:cave --edits {file} --engine jps-block")));
}

#[test]
fn an_engine_that_is_prepared_anew_has_to_pay_until_the_next_edit() {
    let files = Files::new();
    let query = "{\"type\":\"query\",\"start\":[2,5],\"goal\":[4,5]}\n".repeat(1_100);
    let edit = "{\"type\":\"edit\",\"x\":0,\"y\":0,\"rows\":[\".\"]}\n";
    let engine = |text: String| {
        let file = files.add("t.jsonl", text);
        events(&format!("run builtin:cave --edits {file} --distance")).0["engine"].clone()
    };
    assert_eq!(engine(query.clone()), "subgoal");
    assert_eq!(engine(format!("{query}{edit}")), "jps-block");
}

#[test]
fn a_picture_is_of_the_map_after_the_edits() {
    let files = Files::new();
    let map = files
        .add("yard.map", "type octile\nheight 4\nwidth 8\nmap\n........\n........\n........\n........\n");
    let edit = "{\"type\":\"edit\",\"x\":2,\"y\":0,\"rows\":[\"####\",\"####\"]}\n";
    let query = "{\"type\":\"query\",\"start\":[0,0],\"goal\":[7,0]}\n";
    let file = files.add("t.jsonl", format!("{edit}{query}{edit}{query}"));
    let picture = succeeds(&format!("run {map} --edits {file} --limit 1 --draw --engine astar"));
    assert!(picture.contains('█'), "{picture}");
    let trace = files.path("t.json");
    succeeds(&format!("run {map} --edits {file} --limit 1 --trace {trace} --engine astar"));
    let Ran { status, stderr, .. } = run(&format!("run {map} --edits {file} --draw"));
    assert_eq!(
        (status, &*stderr),
        (Some(2), "error: --draw shows a single query: give --from and --to, or --limit 1\n")
    );
}

#[test]
fn edits_without_queries_are_timed() {
    let files = Files::new();
    let file = files.add("t.jsonl", "{\"type\":\"edit\",\"x\":0,\"y\":0,\"rows\":[\"..\",\"##\"]}\n");
    let (_, events, summary) = events(&format!("run builtin:cave --edits {file} --engine hpa"));
    assert_eq!((events.len(), &summary["queries"], &summary["edits"]["changes"]), (1, &json!(0), &json!(1)));
    assert!(shown(&format!("run builtin:cave --edits {file}")).contains("  changes    1, "));
}

#[test]
fn timelines_that_are_refused() {
    let files = Files::new();
    let query = "{\"type\":\"query\",\"start\":[2,5],\"goal\":[4,5]}";
    let edit =
        |x: &str, y: &str, rows: &str| format!("{{\"type\":\"edit\",\"x\":{x},\"y\":{y},\"rows\":{rows}}}");
    for (line, problem) in [
        ("{\"type\":\"query\"".to_owned(), "EOF while parsing an object"),
        ("{\"type\":\"query\",\"start\":[1,2]}".to_owned(), "missing field `goal`"),
        (
            "{\"type\":\"query\",\"start\":[1,2],\"goal\":[\"a\",2]}".to_owned(),
            "expected a number for a coordinate",
        ),
        (
            "{\"type\":\"wish\"}".to_owned(),
            "unknown variant `wish`, expected one of `edit`, `query`, `run`, `summary`",
        ),
        ("1,2".to_owned(), "invalid type: integer `1`, expected internally tagged enum Line"),
        (edit("0", "0", "[\"..\",\"#\"]"), "row 1 has 1 cells, and row 0 has 2: make them equally long"),
        (edit("0", "0", "[\"..\",\".@\"]"), "row 1 has the cell `@`: write # for blocked, . for free"),
        (edit("0", "0", "[]"), "an edit has rows of one cell or more, such as \"rows\": [\"..#\"]"),
        (edit("0", "0", "[\"\"]"), "an edit has rows of one cell or more, such as \"rows\": [\"..#\"]"),
        (edit("-1", "0", "[\".\"]"), "the edit at (-1, 0) is outside the map"),
        (
            edit("71", "0", "[\"..\"]"),
            "the edit of 2 × 1 cells at (71, 0) is not on the map, which has 72 × 36 cells",
        ),
        (
            edit("0", "4294967295", "[\"..\"]"),
            "the edit of 2 × 1 cells at (0, 4294967295) is not on the map, which has 72 × 36 cells",
        ),
    ] {
        let file = files.add("t.jsonl", format!("{query}\n\n{line}\n"));
        let text = refused(&files, &format!("run builtin:cave --edits {file}"));
        assert_eq!(text, format!("error: t.jsonl: line 3: {problem}\n"), "{line}");
    }
    let empty = files.add("empty.jsonl", "{\"type\":\"summary\"}\n");
    let text = refused(&files, &format!("run builtin:cave --edits {empty}"));
    assert!(
        text.starts_with(
            "error: empty.jsonl: nothing in it: write a line {\"type\":\"query\",\"start\":[x,y],"
        ),
        "{text}"
    );
    for other in ["--scen a.scen", "--pairs a.csv", "--from 1,2 --to 3,4", "--grounds"] {
        let text = refused(&files, &format!("run builtin:cave --edits t.jsonl {other}"));
        assert!(
            text.contains("cannot be used with '--edits <FILE>'")
                || text.contains("'--edits <FILE>' cannot be used with"),
            "{text}"
        );
    }
    let missing = files.path("missing.jsonl");
    check(
        &format!("run builtin:cave --edits {missing}"),
        &format!("{missing}: no such file; check the path and the folder that you are in"),
    );
    // A query that cannot be answered is no fault of the timeline.
    let block = files.add(
        "block.jsonl",
        format!("{}\n{query}\n{}\n{query}\n", edit("2", "5", "[\"#\"]"), edit("2", "5", "[\".\"]")),
    );
    let Ran { status, stdout, stderr } = run(&format!("run builtin:cave --edits {block} --format jsonl"));
    assert_eq!((status, stdout.matches("\"code\":\"start-blocked\"").count()), (Some(1), 1), "{stdout}");
    assert_eq!(
        stderr,
        "error: 1 query of 2 cannot be answered; the first, index 0: the start (2, 5) is blocked: choose a free vertex; the nearest one is (2, 4)\n"
    );
}
