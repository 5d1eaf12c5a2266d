//! Maps of robots: meters, discs, pictures.

use serde_json::Value;

use super::common::{Files, Ran, mediant, succeeds};

/// A map of 40 × 20 cells of 0.5 m, whose lower left corner is at (-2, 1): a wall across it in column 20,
/// with a gap of three cells at the top, rows 0 to 2.
fn depot(files: &Files) -> String {
    let shade = |x: usize, y: usize| if x == 20 && y >= 3 { "0\n" } else { "254\n" };
    let shades: String = (0..20).flat_map(|y| (0..40).map(move |x| shade(x, y))).collect();
    files.add("depot.pgm", format!("P2\n# a depot\n40 20 255\n{shades}"));
    let yaml = "image: depot.pgm\nmode: trinary\nresolution: 0.5\norigin: [-2.0, 1.0, 0.0]\nnegate: 0\n\
                occupied_thresh: 0.65\nfree_thresh: 0.25\n";
    files.add("depot.yaml", yaml)
}

fn run(map: &str, options: &str) -> Ran {
    let words: Vec<&str> = ["run", map].into_iter().chain(options.split(' ')).collect();
    mediant(&words)
}

/// The run's line and the query's.
fn lines(map: &str, options: &str) -> (Value, Value) {
    let Ran { stdout, stderr, .. } = run(map, &format!("{options} --format jsonl"));
    let mut lines = stdout.lines().map(|line| serde_json::from_str(line).expect("JSON"));
    (lines.next().unwrap_or_else(|| panic!("{stderr}")), lines.next().expect("a query"))
}

#[test]
fn meters_lead_to_cells_and_back() {
    let files = Files::new();
    let map = depot(&files);
    // The lower left cell has its center at (-1.75, 1.25), the upper right one at (17.75, 10.75).
    let (ran, query) = lines(&map, "--world --from -1.7,1.3 --to 17.6,10.9");
    assert_eq!((&query["start"], &query["goal"]), (&[0, 19].into(), &[39, 0].into()));
    let world = query["world"].as_array().expect("points");
    assert_eq!((&world[0], &world[world.len() - 1]), (&[-1.75, 1.25].into(), &[17.75, 10.75].into()));
    assert_eq!((&ran["resolution"], &ran["radius"]), (&0.5.into(), &Value::Null));
    // At corners, whole meters: (-2, 1) is the lower left corner of the map.
    let (_, query) = lines(&map, "--world --placement corner --from -2,1 --to 18,11");
    assert_eq!((&query["start"], &query["goal"]), (&[0, 20].into(), &[40, 0].into()));
    // Without --world nothing is in meters.
    let (ran, query) = lines(&map, "--from 0,19 --to 39,0");
    assert_eq!((&query["world"], &ran["resolution"]), (&Value::Null, &Value::Null));
    // Lengths of wishes are in meters, too: 19.5 m are 39 cells.
    let (_, query) = lines(&map, "--world --from -1.7,10.9 --to 17.6,10.9 --max-cost 19.5");
    assert_eq!((&query["status"], &query["cost"]), (&"found".into(), &39.0.into()));
    let (_, query) = lines(&map, "--world --from -1.7,10.9 --to 17.6,10.9 --max-cost 19.4");
    assert_eq!(query["status"], "stopped");
}

#[test]
fn a_disc_keeps_its_radius() {
    let files = Files::new();
    let map = depot(&files);
    // The gap has three cells, so a disc of 1.5 cells fits in its middle row.
    let (ran, query) = lines(&map, "--world --radius 0.75 --from 0.25,8 --to 15.25,8");
    assert_eq!((&ran["radius"], &query["status"]), (&1.5.into(), &"found".into()));
    let path = query["path"].as_array().expect("a path");
    assert!(path.iter().any(|at| at[1] == 1), "{path:?}");
    let (_, query) = lines(&map, "--world --radius 0.76 --from 0.25,8 --to 15.25,8");
    assert_eq!(query["status"], "unreachable");
    // In cells, without --world.
    let (ran, query) = lines(&map, "--radius 1.5 --from 4,10 --to 34,10");
    assert_eq!((&ran["radius"], &query["status"]), (&1.5.into(), &"found".into()));
    let Ran { stderr, status, .. } = run(&map, "--radius 1.5 --from 19,10 --to 34,10");
    assert_eq!(status, Some(1));
    assert!(
        stderr.contains(
            "the start (19, 10) is too near to an obstacle for a radius of 1.5000 cells; the nearest one is \
             (18, 10)"
        ),
        "{stderr}"
    );
    let Ran { stdout, .. } = run(&map, "--world --radius 0.75 --from 0.25,8 --to 15.25,8");
    assert!(stdout.contains("\na disc of radius 1.5000 cells (0.75 m)\n"), "{stdout}");
    assert!(
        stdout.contains("\n  world ") && stdout.contains(" m, (0.250, 8.250) to (15.250, 8.250)\n"),
        "{stdout}"
    );
}

#[test]
fn ends_are_moved_and_it_is_said_how_far() {
    let files = Files::new();
    let map = depot(&files);
    // The centers of the cells are at (-1.75, 1.25) and (17.75, 10.75).
    let ends = "--world --from -1.71,1.28 --to 17.75,10.75";
    let (ran, _) = lines(&map, ends);
    assert_eq!(ran["moved"], serde_json::json!([0.05, 0.0]));
    let Ran { stdout, .. } = run(&map, ends);
    assert!(
        stdout.contains("\n  moved to vertices: the start by 0.050 m, the goal by 0.000 m\n"),
        "{stdout}"
    );
    let (ran, _) = lines(&map, "--world --placement corner --from -2,1 --to 18,10.7");
    assert_eq!(ran["moved"], serde_json::json!([0.0, 0.2]));
    let Ran { stdout, .. } = run(&map, "--world --from -1.75,1.25 --to 17.75,10.75");
    assert!(!stdout.contains("moved"), "{stdout}");
    let (ran, _) = lines(&map, "--from 0,19 --to 39,0");
    assert!(ran.get("moved").is_none());
}

#[test]
fn sources_and_ends_of_tables_are_moved_and_it_is_said_how_far() {
    let files = Files::new();
    let map = depot(&files);
    let reach = |ends: &str| succeeds(&format!("reach {map} --world --within 3 {ends}"));
    let moved = reach("--from -1.71,1.28 --from 17.75,10.75");
    assert!(moved.contains("\n  moved to vertices: the sources by at most 0.050 m\n"), "{moved}");
    assert!(!reach("--from -1.75,1.25").contains("moved"));
    let table = |options: &str| succeeds(&format!("table {map} --world {options}"));
    let moved = table("--from -1.75,1.25 --from -1.71,1.28 --to 17.75,10.75");
    let line = "\nmoved to vertices: the starts by at most 0.050 m, the goals by at most 0.000 m\n";
    assert!(moved.contains(line), "{moved}");
    assert!(!table("--from -1.75,1.25 --to 17.75,10.75").contains("moved"));
    let records = table("--from -1.75,1.25 --to 17.75,10.45 --format jsonl");
    let head: Value = serde_json::from_str(records.lines().next().expect("a line")).expect("JSON");
    assert_eq!(head["moved"], serde_json::json!([0.0, 0.2]));
}

#[test]
fn errors_in_the_world_are_in_meters_too() {
    let files = Files::new();
    let map = depot(&files);
    let error = |options: &str| {
        let Ran { stderr, status, .. } = run(&map, options);
        assert_eq!(status, Some(1), "{stderr}");
        stderr
    };
    assert_eq!(
        error("--world --from 8.1,3.2 --to 17,3"),
        "error: the start (20, 15) is blocked: choose a free vertex; the nearest one is (19, 15); in the world the \
         start is at (8.250, 3.250) m, the nearest one at (7.750, 3.250) m\n"
    );
    assert_eq!(
        error("--world --radius 0.75 --from 7.6,6.1 --to 15.25,6"),
        "error: the start (19, 9) is too near to an obstacle for a radius of 1.5000 cells (0.75 m); the nearest one \
         is (18, 9); in the world the start is at (7.750, 6.250) m, the nearest one at (7.250, 6.250) m\n"
    );
    assert_eq!(
        error("--from 20,15 --to 39,3"),
        "error: the start (20, 15) is blocked: choose a free vertex; the nearest one is (19, 15)\n"
    );
}

#[test]
fn a_radius_that_changes_nothing_is_told() {
    let files = Files::new();
    let map = depot(&files);
    let said = |options: &str| run(&map, &format!("{options} --from 4,3 --to 15,3")).stderr;
    let nothing = "cells changes nothing: such a disc fits wherever a point may be";
    assert_eq!(
        said("--radius 0.22"),
        format!("warning: a radius of 0.2200 {nothing}; with --world it is in meters\n")
    );
    assert_eq!(said("--world --radius 0.2"), format!("warning: a radius of 0.4000 {nothing}\n"));
    assert_eq!(said("--world --radius 0.4"), "");
    assert_eq!(said("--radius 0"), "");
}

#[test]
fn pictures_are_written() {
    let files = Files::new();
    let map = depot(&files);
    for (name, first) in [("path.png", &b"\x89PNG\r\n"[..]), ("path.svg", b"<svg ")] {
        let file = files.path(name);
        let draw = format!("--radius 1.5 --from 4,10 --to 34,10 --draw {file}");
        let Ran { stdout, stderr, status } = run(&map, &draw);
        assert_eq!((stderr.as_str(), status), ("", Some(0)));
        assert!(stdout.ends_with(&format!("  drawn {name}\n")), "{stdout}");
        assert!(std::fs::read(&file).expect("a picture").starts_with(first), "{name}");
        // Lines of JSON stay alone.
        let Ran { stdout, .. } = run(&map, &format!("{draw} --format jsonl"));
        assert!(stdout.lines().all(|line| line.starts_with('{')), "{stdout}");
    }
    // A picture is a map: the agent's way is drawn on white, the wall is dark.
    let picture = files.path("path.png");
    let Ran { status, .. } = mediant(&["run", &picture, "--from", "0,0", "--to", "9,9"]);
    assert_eq!(status, Some(0));
}

#[test]
fn mistakes_are_told_in_a_line() {
    let files = Files::new();
    let map = depot(&files);
    let check = |options: &str, expected: &str| {
        let Ran { stdout, stderr, status } = run(&map, options);
        assert_eq!((stdout.as_str(), status), ("", Some(2)), "{options}");
        assert!(stderr.contains(expected) && stderr.lines().count() == 1, "{options}: {stderr}");
    };
    check(
        "--world --from 100,2 --to 0,2",
        "(100, 2) is outside the map, which lies between (-2.000, 1.000) and (18.000, 11.000) in the world",
    );
    check(
        "--from 0.5,2 --to 0,2",
        "(0.5, 2) is no vertex: write whole numbers, such as 3,14, or --k any, or meters",
    );
    check("--from 1,2 --to 0,2 --radius -1", "expected a number of cells, 0 or more");
    check("--from 1,2 --to 0,2 --draw path.gif", "path.gif: expected a name that ends in .png or .svg");
    check("--from 1,2 --to 0,2 --threshold 2", "threshold");
    let Ran { stderr, status, .. } = run("builtin:cave", "--world --from 1,2 --to 0,2");
    assert_eq!(status, Some(2));
    assert!(stderr.contains("the map cave.map has no place in the world: leave --world out"), "{stderr}");
}
