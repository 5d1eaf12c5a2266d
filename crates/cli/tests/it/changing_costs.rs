//! Costs that change: timelines on costs, and checks of their paths.

use mediant::{Costs, Engine, Map, Motion};
use mediant_formats::Surface;
use serde_json::{Value, json};

use crate::{
    common::{Files, Ran, refused, run, succeeds, told},
    edits::{Random, events},
    errors::check,
};

const WIDTH: u32 = 12;
const HEIGHT: u32 = 9;

/// The cost of each cell, row by row; `None` for a wall.
type Land = Vec<Option<f64>>;

fn land(random: &mut Random) -> Land {
    (0..WIDTH * HEIGHT).map(|_| (random.below(6) > 0).then(|| f64::from(1 + random.below(9)) / 2.0)).collect()
}

/// Saves costs as a raster, and returns its path.
fn saved(files: &Files, land: &Land) -> String {
    let numbers: Vec<f64> = land.iter().map(|cost| cost.unwrap_or(-1.0)).collect();
    let path = files.path("land.asc");
    let surface = Surface::new(WIDTH, HEIGHT, numbers).expect("a number a cell").with_no_data(Some(-1.0));
    surface.save(&path).expect("a file");
    path
}

fn number(x: u32, y: u32) -> usize {
    (y * WIDTH + x) as usize
}

/// A random edit of 1 × 1 to 3 × 2 cells, in one form or the other, and the land after it. `last` are the
/// costs that cells had last.
fn edit(random: &mut Random, land: &mut Land, last: &mut Land) -> Value {
    let (width, height) = (1 + random.below(3), 1 + random.below(2));
    let (x, y) = (random.below(WIDTH - width + 1), random.below(HEIGHT - height + 1));
    let cells: Vec<usize> = (y..y + height).flat_map(|y| (x..x + width).map(move |x| number(x, y))).collect();
    let by_rows = random.below(2) == 0 && cells.iter().all(|&cell| last[cell].is_some());
    for &cell in &cells {
        let is_free = random.below(3) > 0;
        land[cell] = match by_rows {
            true => last[cell].filter(|_| is_free),
            false => is_free.then(|| f64::from(1 + random.below(9)) / 2.0),
        };
        last[cell] = land[cell].or(last[cell]);
    }
    let now: Vec<Option<f64>> = cells.iter().map(|&cell| land[cell]).collect();
    let more = random.below(4) == 0;
    let rows = now.chunks(width as usize);
    if by_rows {
        let text = |row: &[Option<f64>]| -> String {
            row.iter().map(|cost| if cost.is_some() { '.' } else { '#' }).collect()
        };
        return json!({"type": "edit", "x": x, "y": y, "rows": rows.map(text).collect::<Vec<_>>(), "more": more});
    }
    json!({"type": "edit", "x": x, "y": y, "costs": rows.collect::<Vec<_>>(), "more": more})
}

/// The cost of the cheapest path by a planner of its own.
fn least(land: &Land, engine: Engine, (start, goal): ([u32; 2], [u32; 2])) -> Option<f64> {
    let costs = Costs::from_fn(WIDTH, HEIGHT, |x, y| land[number(x, y)]).expect("costs");
    let at = |[x, y]: [u32; 2]| (x as i32, y as i32);
    let mut planner = costs.space(Motion::centers(4)).and_then(|space| space.planner(engine)).expect("k = 4");
    planner.path(at(start), at(goal)).expect("free ends").map(|path| path.cost())
}

#[test]
fn paths_follow_edits_of_costs() {
    let files = Files::new();
    for (seed, engine) in
        [(1, Engine::AStar), (2, Engine::Landmarks), (3, Engine::Dijkstra), (4, Engine::AStar)]
    {
        let mut random = Random(seed);
        let mut now = land(&mut random);
        let (map, mut last) = (saved(&files, &now), now.clone());
        let (mut text, mut expected, mut altered) = (String::new(), Vec::new(), Vec::new());
        for _ in 0..60 {
            if random.below(2) == 0 {
                let before = now.clone();
                text += &format!("{}\n", edit(&mut random, &mut now, &mut last));
                altered.push(before.iter().zip(&now).filter(|(one, other)| one != other).count());
                continue;
            }
            let mut free = || loop {
                let at = [random.below(WIDTH), random.below(HEIGHT)];
                if now[number(at[0], at[1])].is_some() {
                    return at;
                }
            };
            let ends = (free(), free());
            text += &format!("{}\n", json!({"type": "query", "start": ends.0, "goal": ends.1}));
            expected.push(least(&now, engine, ends));
        }
        let timeline = files.add("timeline.jsonl", &text);
        let line = format!("--k 4 --engine {engine}");
        let (head, all, _) = events(&format!("run {map} --edits {timeline} {line}"));
        assert_eq!(head["edits"], altered.len(), "seed {seed}");
        let of = |all: &[Value], kind: &str, key: &str| -> Vec<Value> {
            all.iter().filter(|event| event["type"] == kind).map(|event| event[key].clone()).collect()
        };
        let costs = of(&all, "query", "cost");
        for (number, (cost, expected)) in costs.iter().zip(&expected).enumerate() {
            let is_same = match (cost.as_f64(), expected) {
                (Some(cost), Some(expected)) => (cost - expected).abs() <= 1e-6 * expected,
                (cost, expected) => cost.is_none() && expected.is_none(),
            };
            assert!(is_same, "seed {seed}, query {number}: {cost}, not {expected:?}");
        }
        assert_eq!(of(&all, "edit", "cells"), altered, "seed {seed}");
        assert!(all.iter().all(|event| event["type"] != "edit" || event["rows"].is_null()), "seed {seed}");
        // The output is a timeline, and its paths hold and cost what it says.
        let printed = files
            .add("printed.jsonl", succeeds(&format!("run {map} --edits {timeline} {line} --format jsonl")));
        let again = events(&format!("run {map} --edits {printed} {line}")).1;
        assert_eq!(of(&again, "query", "cost"), costs, "seed {seed}");
        let found = costs.iter().filter(|cost| cost.is_number()).count();
        let said = succeeds(&format!("check {map} {printed}"));
        assert_eq!(said, format!("land.asc · all {found} paths hold\n"), "seed {seed}");
        // Without the edits paths cost something else, or meet a wall.
        let kept = std::fs::read_to_string(&printed).expect("a file");
        let kept: Vec<&str> = kept.lines().filter(|line| !line.contains("\"edit\"")).collect();
        let unedited = files.add("unedited.jsonl", kept.join("\n"));
        let said = run(&format!("check {map} {unedited}"));
        assert!(said.status == Some(1) && said.stdout.contains("the path costs "), "seed {seed}: {said:?}");
    }
}

#[test]
fn what_is_wrong_with_an_edit_of_costs_is_said() {
    let files = Files::new();
    let mut costs: Land = vec![Some(2.0); (WIDTH * HEIGHT) as usize];
    costs[number(3, 0)] = None;
    let map = saved(&files, &costs);
    let edit = |rest: &str| format!("{{\"type\":\"edit\",\"x\":3,\"y\":0,{rest}}}\n");
    for (line, problem) in [
        (
            edit("\"rows\":[\".\"]"),
            "cell (3, 0) never had a cost: write \"costs\" in place of \"rows\", such as \"costs\": [[1, 2.5, null]]",
        ),
        (
            edit("\"rows\":[\".\"],\"costs\":[[1]]"),
            "an edit has \"rows\" or \"costs\": leave one of them out",
        ),
        (
            edit("\"costs\":[[]]"),
            "an edit has costs of one cell or more, such as \"costs\": [[1, 2.5, null]]",
        ),
        (edit("\"costs\":[[1],[0]]"), "row 1 has the cost 0: write a positive number, or null for blocked"),
        (edit("\"costs\":[[1],[2,3]]"), "row 1 has 2 cells, and row 0 has 1: make them equally long"),
        (edit("\"costs\":[[\"a\"]]"), "invalid type: string \"a\", expected f64"),
    ] {
        let file = files.add("t.jsonl", &line);
        let said = refused(&files, &format!("run {map} --edits {file}"));
        assert_eq!(said, format!("error: t.jsonl: line 1: {problem}\n"), "{line}");
    }
    let file = files.add("t.jsonl", edit("\"costs\":[[1]]"));
    let said = refused(&files, &format!("run builtin:cave --edits {file}"));
    assert_eq!(
        said,
        "error: t.jsonl: line 1: the edit has \"costs\", and the map has none: give it costs, or write \"rows\"\n"
    );
    // A cell that was given a cost has one from then on.
    let query = "{\"type\":\"query\",\"start\":[3,0],\"goal\":[4,0]}\n";
    let door =
        [edit("\"costs\":[[4]]"), edit("\"rows\":[\"#\"]"), edit("\"rows\":[\".\"]"), query.to_owned()]
            .concat();
    let file = files.add("door.jsonl", door);
    assert_eq!(told(&format!("run {map} --edits {file}")).1[3]["cost"], 3.0);
    check(
        &format!("run {map} --edits {file} --elevation"),
        "--edits does not go with --elevation: leave one of the two out",
    );
}

#[test]
fn a_check_measures_paths_on_costs() {
    let files = Files::new();
    let mut random = Random(7);
    let costs = land(&mut random);
    let map = saved(&files, &costs);
    let walls = files.path("walls.map");
    succeeds(&format!("convert {map} -o {walls}"));
    let pairs: String = (0..40)
        .map(|_| [WIDTH, HEIGHT, WIDTH, HEIGHT].map(|side| random.below(side).to_string()).join(",") + "\n")
        .collect();
    let pairs = files.add("pairs.csv", pairs);
    for options in
        ["--k 2", "--k 3", "--k 5", "--k 8", "--smooth", "--engine theta --k 4", "--placement corner --k 5"]
    {
        let printed = run(&format!("run {map} --pairs {pairs} --format jsonl {options}")).stdout;
        let file = files.add("paths.jsonl", &printed);
        let said = succeeds(&format!("check {map} {file}"));
        assert!(said.ends_with(" paths hold\n"), "{options}: {said}");
        // The costs may come from beside the map, and what is told of each path is its cost.
        let told = succeeds(&format!("check {walls} --costs {map} {file} --format jsonl"));
        let costs: Vec<f64> = printed.lines().filter_map(cost_of_path).collect();
        let told: Vec<f64> = told
            .lines()
            .filter_map(|line| serde_json::from_str::<Value>(line).expect("JSON")["cost"].as_f64())
            .collect();
        assert!(costs.len() > 10, "{options}: {costs:?}");
        assert_eq!(told.len(), costs.len(), "{options}");
        assert!(told.iter().zip(&costs).all(|(one, other)| (one - other).abs() <= 1e-9 * other), "{options}");
        // Other costs are other ones, and none are not compared.
        let swamp: Land =
            self::land(&mut Random(7)).into_iter().map(|cost| cost.map(|cost| 2.0 * cost)).collect();
        let dear = Files::new();
        let Ran { status, stdout, .. } = run(&format!("check {} {file}", saved(&dear, &swamp)));
        assert!(status == Some(1) && stdout.contains(": the path costs "), "{options}: {stdout}");
        succeeds(&format!("check {walls} {file}"));
    }
    let file = files.add("way.csv", "x,y\n0,0\n1,0\n");
    let flat = files.add("flat.asc", "ncols 2\nnrows 1\ncellsize 10\n3 5\n");
    // From center to center it is half in each cell, along the border in the first one alone.
    for (options, cost) in
        [("", "40.0"), ("--k 12", "40.0"), ("--k any", "30.0"), ("--k any --placement center", "40.0")]
    {
        let told = succeeds(format!("check {flat} {file} --format jsonl {options}").trim_end());
        assert!(told.contains(&format!("\"holds\":true,\"cost\":{cost}}}")), "{options}: {told}");
    }
    let walk = run(&format!("run {flat} --elevation --from 0,0 --to 1,0 --format jsonl")).stdout;
    let walk = files.add("walk.jsonl", walk);
    assert_eq!(succeeds(&format!("check {flat} {walk} --elevation")), "flat.asc · the path holds\n");
    let back = run(&format!("check {flat} {walk} --elevation --pace langmuir")).stdout;
    assert!(back.contains("the path costs "), "{back}");
}

/// The cost of the path in a line.
fn cost_of_path(line: &str) -> Option<f64> {
    let line: Value = serde_json::from_str(line).expect("JSON");
    line["cost"].as_f64().filter(|_| line["path"].as_array().is_some_and(|path| !path.is_empty()))
}

#[test]
fn costs_of_the_program_are_those_of_a_map() {
    // The oracle above is not the program: a map of costs 2 costs twice its length.
    let even = vec![Some(2.0); (WIDTH * HEIGHT) as usize];
    let map = Map::new(WIDTH, HEIGHT).expect("a map");
    let length = map.space(Motion::centers(4)).expect("a space").path((0, 0), (11, 5)).expect("free");
    let length = length.expect("a way").length();
    let cost = least(&even, Engine::AStar, ([0, 0], [11, 5])).expect("a way");
    assert!((cost - 2.0 * length).abs() < 1e-6, "{cost} and {length}");
}
