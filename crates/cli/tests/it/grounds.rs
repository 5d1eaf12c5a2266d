//! Which characters and shades of a map are free: grounds, tiles that are named, the two readings of ROS
//! maps.

use mediant_formats::{MapOptions, read_map};

use super::common::{Files, Ran, run, succeeds, told};

const LAKE: &str = "type octile\nheight 3\nwidth 4\nmap\n.WW.\n.Ww.\n.tT.\n";

fn lake(files: &Files) -> String {
    files.add("lake.map", LAKE)
}

/// The message of a command line that fails.
#[track_caller]
fn fails(files: &Files, line: &str) -> String {
    let Ran { status, stdout, stderr } = run(line);
    assert_eq!((stdout.as_str(), status), ("", Some(2)), "{line}: {stderr}");
    files.strip(&stderr)
}

#[test]
fn who_starts_in_water_moves_in_water() {
    let files = Files::new();
    let map = lake(&files);
    let (ran, queries, _) = told(&format!("run {map} --grounds --from 1,0 --to 2,1"));
    assert_eq!((&ran["grounds"], &ran["free_cells"]), (&true.into(), &12.into()));
    assert_eq!(queries[0]["cost"], 2.0_f64.sqrt());
    assert_eq!(run(&format!("run {map} --from 1,0 --to 2,1")).status, Some(1));
    let (ran, queries, _) = told(&format!("run {map} --free W --from 1,0 --to 2,1"));
    assert_eq!((&ran["grounds"], &queries[0]["cost"]), (&serde_json::Value::Null, &2.0_f64.sqrt().into()));
    // On another ground the goal is blocked; the ground is that of the start.
    let Ran { stderr, status, .. } = run(&format!("run {map} --grounds --from 1,0 --to 0,0"));
    assert_eq!(status, Some(1));
    assert!(stderr.contains("the goal (0, 0) is blocked"), "{stderr}");
    // A disc keeps off other grounds: it fits into no part of the lake.
    let Ran { stderr, status, .. } = run(&format!("run {map} --grounds --radius 0.6 --from 1,0 --to 2,1"));
    assert!(status == Some(1) && stderr.contains("the start (1, 0) is blocked"), "{stderr}");
    // At corners of cells too, where a vertex has the ground of its own cell.
    let (_, queries, _) = told(&format!("run {map} --grounds --placement corner --from 1,0 --to 2,2"));
    assert_eq!(queries[0]["cost"], 1.0 + 2.0_f64.sqrt());
}

#[test]
fn a_scenario_runs_on_the_ground_of_each_start() {
    let files = Files::new();
    let map = lake(&files);
    let line = |x: i32, y: i32, to: (i32, i32), length: f64| {
        format!("0\tlake.map\t4\t3\t{x}\t{y}\t{}\t{}\t{length}\n", to.0, to.1)
    };
    let lines = [
        line(1, 0, (2, 1), std::f64::consts::SQRT_2),
        line(0, 0, (0, 2), 2.0),
        line(1, 2, (2, 2), 1.0),
        line(0, 0, (3, 0), 0.0),
        line(2, 0, (1, 1), 1.41),
    ];
    let scen = files.add("lake.map.scen", format!("\u{feff}version 1\n{}", lines.concat()));
    for engine in ["astar", "subgoal", "jps-plus"] {
        let (_, queries, summary) = told(&format!("run {map} --scen {scen} --grounds --engine {engine}"));
        let index: Vec<i64> =
            queries.iter().map(|query| query["index"].as_i64().expect("a number")).collect();
        assert_eq!(index, [0, 1, 2, 3, 4]);
        let costs: Vec<f64> = queries.iter().map(|query| query["cost"].as_f64().unwrap_or(-1.0)).collect();
        let diagonal = 2.0_f64.sqrt();
        assert_eq!(costs, [diagonal, 2.0, 1.0, -1.0, diagonal], "{engine}");
        // A length of 0 between two places is unknown.
        assert_eq!(queries[3]["reference"], serde_json::Value::Null);
        assert_eq!((&summary["unreachable"], &summary["errors"]), (&1.into(), &0.into()));
        let reference = &summary["reference"];
        assert_eq!((&reference["compared"], &reference["equal"]), (&4.into(), &4.into()));
    }
    assert!(succeeds(&format!("run {map} --scen {scen} --grounds --limit 1 --draw")).contains("1.4142"));
    // Its paths hold on the same grounds; without, those in water and among trees do not.
    let ran = succeeds(&format!("run {map} --scen {scen} --grounds --format jsonl"));
    let checked = |name: &str, ran: &str| {
        let paths = files.add(name, ran);
        let Ran { status, stdout, .. } = run(&format!("check {map} {paths} --format jsonl"));
        let last = stdout.lines().last().expect("a summary").to_owned();
        let last: serde_json::Value = serde_json::from_str(&last).expect("JSON");
        (status, last["paths"].as_u64(), last["broken"].as_u64())
    };
    assert_eq!(checked("grounds.jsonl", &ran), (Some(0), Some(4), Some(0)));
    let without = ran.replace("\"grounds\":true,", "");
    assert_eq!(checked("land.jsonl", &without), (Some(1), Some(4), Some(3)));
    let picture = files.add("lake.pgm", "P2 4 2 255  255 255 255 255  255 255 255 255");
    let paths = files.add("grounds.jsonl", &ran);
    assert_eq!(
        fails(&files, &format!("check {picture} {paths}")),
        "error: grounds.jsonl: its paths are on the grounds of a MovingAI map, and lake.pgm has none: give the \
         map that they were made on\n"
    );
}

#[test]
fn tiles_are_named_or_known() {
    let files = Files::new();
    let maze = files.add("maze.map", "type octile\nheight 1\nwidth 3\nmap\n.x.\n");
    let error = "error: maze.map: line 5, column 2: expected a tile, `.`, `G`, `S` (free) or `@`, `O`, `T`, `W`, \
                 `#` (blocked), found `x`; say which characters are free or blocked, by `free` or `blocked`\n";
    assert_eq!(fails(&files, &format!("run {maze} --from 0,0 --to 2,0")), error);
    let (_, queries, _) = told(&format!("run {maze} --free .X --from 0,0 --to 2,0"));
    assert_eq!(queries[0]["cost"], 2.0);
    let (_, queries, _) = told(&format!("run {maze} --blocked x --from 0,0 --to 2,0"));
    assert_eq!(queries[0]["status"], "unreachable");
    assert_eq!(
        fails(&files, &format!("run {maze} --free x --blocked X --from 0,0 --to 2,0")),
        "error: the character `X` is named as free and as blocked; leave it out of one of them\n"
    );
    let picture = files.add("a.pgm", "P2 2 1 255  255 255");
    assert_eq!(
        fails(&files, &format!("run {picture} --free W --from 0,0 --to 1,0")),
        "error: the map a.pgm has no characters for tiles: leave --free out, or give a MovingAI map\n"
    );
    assert_eq!(
        fails(&files, &format!("run {picture} --grounds --from 0,0 --to 1,0")),
        "error: the map a.pgm has no characters for tiles: leave --grounds out, or give a MovingAI map\n"
    );
    let swamp = files.add("swamp.map", "type octile\nheight 1\nwidth 5\nmap\n.sgS.  \n");
    let (_, queries, _) = told(&format!("run {swamp} --from 0,0 --to 4,0"));
    assert_eq!(queries[0]["cost"], 4.0);
}

#[test]
fn a_ros_map_is_read_as_by_ros_2_or_ros_1() {
    let files = Files::new();
    files.add("a.pgm", b"P5 2 1 255 \xff\0");
    let yaml = "{image: a.pgm, resolution: 1, origin: [0, 0, 0], negate: 0, occupied_thresh: 0.65, \
                free_thresh: 0.0}\n";
    let map = files.add("a.yaml", yaml);
    for (option, free) in [("", [true, false]), (" --ros 2", [true, false]), (" --ros 1", [false, false])] {
        let out = files.path("out.map");
        succeeds(&format!("convert {map}{option} -o {out}"));
        let grid = read_map(&out, &MapOptions::default()).expect("our own map").grid;
        assert_eq!([grid.is_free(0, 0), grid.is_free(1, 0)], free, "{option}");
    }
    let error = fails(&files, &format!("run {map} --ros 3 --from 0,0 --to 0,0"));
    assert!(error.contains("expected 1 or 2"), "{error}");
}
