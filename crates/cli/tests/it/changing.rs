//! Maps that change: scenarios of patches.

use serde_json::{Value, json};

use crate::{
    common::{Files, refused, shown, succeeds},
    edits::{costs, events},
};

const PATCHES: &str = "type patch\npatches 4\npatch 0\nheight 4\nwidth 1\nmap\n@\nT\n@\n@\n\
                       patch 1\nheight 1\nwidth 1\nmap\n.\npatch 2\nheight 2\nwidth 2\nmap\n@.\n.@\n\
                       patch 3\nheight 1\nwidth 1\nmap\n@\n";
const HALL: &str = "version 2\nheight 4\nwidth 7\ncost 1 octile\npatch hall.patch\ncommands\n\
                    P 0 0 3 0\nQ 0 0 0 6 0 -1\nP 1 1 3 0\nP 1 2 0 2\nQ 1 0 0 6 0 6\nQ 1 6 3 0 3 -1\nP 2 3 3 0\nP 2 1 3 3\n\
                    P 2 3 3 0\nQ 2 0 0 6 0 9.65685425\nQ 2 6 1 6 1 0\n";

/// Adds `hall.scen` with its patches, and returns its path.
fn hall(files: &Files) -> String {
    files.add("hall.patch", PATCHES);
    files.add("hall.scen", HALL)
}

#[test]
fn a_scenario_of_patches_is_a_map_with_queries() {
    let files = Files::new();
    let scenario = hall(&files);
    let (run, all, summary) = events(&format!("run {scenario} --engine jps-block"));
    assert_eq!(
        (&run["map"], &run["free_cells"], &run["queries"], &run["edits"]),
        (&json!("hall.scen"), &json!(24), &json!(5), &json!(6))
    );
    let edits: Vec<&Value> = all.iter().filter(|event| event["type"] == "edit").collect();
    let first = &edits[0];
    assert_eq!(
        (&first["rows"][0], &first["cells"], &first["initial"], &first["nanos"]),
        (&json!("...#..."), &json!(4), &json!(true), &json!(0))
    );
    let cells: Vec<(u64, bool)> = edits[1..]
        .iter()
        .map(|edit| (edit["cells"].as_u64().expect("a number"), edit["more"] == true))
        .collect();
    // The last edit finds the cell as the first of its change left it.
    assert_eq!(cells, [(1, true), (2, false), (1, true), (1, true), (0, false)]);
    assert_eq!(
        (&summary["edits"]["edits"], &summary["edits"]["changes"], &summary["edits"]["cells"]),
        (&json!(5), &json!(2), &json!(5))
    );
    let references: Vec<&Value> = all.iter().filter_map(|event| event.get("reference")).collect();
    assert_eq!(references, [&json!(-1.0), &json!(6.0), &json!(-1.0), &json!(9.656_854_25), &json!(0.0)]);
    assert_eq!((&summary["reference"]["compared"], &summary["unreachable"]), (&json!(5), &json!(2)));
    insta::assert_snapshot!(shown(&format!("run {scenario} --engine jps-block")));
    let costs_by = |engine: &str| costs(&events(&format!("run {scenario} --engine {engine}")).1);
    assert_eq!(costs_by("astar"), costs_by("hpa"));

    // The output is replayed on a map without obstacles, and on the scenario.
    let out = files.add("out.jsonl", succeeds(&format!("run {scenario} --format jsonl")));
    let free =
        files.add("free.map", format!("type octile\nheight 4\nwidth 7\nmap\n{}", ".......\n".repeat(4)));
    assert_eq!(succeeds(&format!("check {free} {out}")), "free.map · all 3 paths hold\n");
    assert_eq!(succeeds(&format!("check {scenario} {out}")), "hall.scen · all 3 paths hold\n");
    // For other commands it is the map at the first query.
    let map = files.path("hall.map");
    succeeds(&format!("convert {scenario} -o {map}"));
    let text = std::fs::read_to_string(&map).expect("a map");
    assert!(text.ends_with("map\n...@...\n...@...\n...@...\n...@...\n"), "{text}");
    let single = succeeds(&format!("run {scenario} --from 0,0 --to 2,3 --format jsonl"));
    assert!(single.contains("\"status\":\"found\"") && !single.contains("\"edit\""), "{single}");
    let index = files.path("hall.idx");
    succeeds(&format!("build {scenario} --engine jps-plus -o {index}"));
    assert_eq!(costs(&events(&format!("run {scenario} --engine jps-plus --index {index}")).1), costs(&all));
}

#[test]
fn scenarios_of_patches_that_are_refused() {
    let files = Files::new();
    let scenario = hall(&files);
    let text = refused(&files, &format!("run builtin:cave --scen {scenario}"));
    assert_eq!(
        text,
        "error: hall.scen: line 1, column 1: expected `version 1` or `version 1.0`, found `version 2`; this is a \
         scenario of a map that changes, which has its map with it: give it in place of a map\n"
    );
    let text = refused(&files, &format!("run {scenario} --free W"));
    assert!(text.contains("the map hall.scen has no characters for tiles"), "{text}");
    let text = refused(&files, &format!("run {scenario} --grounds"));
    assert!(text.contains("leave --grounds out"), "{text}");
    let text = refused(&files, &format!("run {scenario} --inflation-radius 1"));
    assert!(text.contains("a scenario of a map that changes does not go with costs"), "{text}");
    files.add("hall.patch", PATCHES.replace("patches 4", "patches 3"));
    let text = refused(&files, &format!("run {scenario}"));
    assert!(text.starts_with("error: hall.patch: line 22, column 1: expected the end of the file after 3 patches, found `patch 3`; "), "{text}");
    files.add("hall.scen", HALL.replace("P 1 1 3 0", "P 1 1 7 0"));
    files.add("hall.patch", PATCHES);
    let text = refused(&files, &format!("run {scenario}"));
    assert!(text.starts_with("error: hall.scen: line 9, column 7: expected a place on the map of 7 × 4 cells, found 1 × 1 cells at (7, 0)"), "{text}");
    std::fs::remove_file(files.path("hall.patch")).expect("a file");
    let text = refused(&files, &format!("run {scenario}"));
    assert!(text.starts_with("error: hall.patch: no such file"), "{text}");
}
