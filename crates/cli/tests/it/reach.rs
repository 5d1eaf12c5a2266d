//! `mediant reach`: the distances, against those of `run`, and the files.

use std::fs;

use crate::{
    common::{Files, Ran, add_example_files, run, run_examples, succeeds, told},
    errors::check,
};

type At = (i32, i32);

/// The rows of a CSV with distances.
fn rows(csv: &str) -> Vec<(At, f64)> {
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("x,y,distance"));
    let parse = |line: &str| {
        let parts: Vec<f64> = line.split(',').map(|part| part.parse().expect("a number")).collect();
        ((parts[0] as i32, parts[1] as i32), parts[2])
    };
    lines.map(parse).collect()
}

/// The distance of each vertex from one source, as `run` finds it.
fn of_run(options: &str) -> String {
    succeeds(&format!("run {options} --engine dijkstra --distances -"))
}

#[test]
fn the_distances_are_those_of_run() {
    for options in [
        "builtin:cave --from 2,5",
        "builtin:cave --from 2,5 --k 2 --corners always",
        "builtin:town --from 1,31 --k 5 --placement corner --gap closed",
        "builtin:archipelago --from 16,7 --radius 0.8",
    ] {
        let reached = succeeds(&format!("reach {options} -o -"));
        assert_eq!(reached, of_run(options), "{options}");
        assert!(reached.lines().count() > 100, "{options}");
    }
}

#[test]
fn what_is_beyond_the_limit_is_left_out() {
    let all = rows(&of_run("builtin:cave --from 2,5"));
    for limit in [0.0, 1.0, 19.5, 40.0] {
        let near: Vec<_> = all.iter().copied().filter(|(_, distance)| *distance <= limit).collect();
        assert_eq!(rows(&succeeds(&format!("reach builtin:cave --from 2,5 --within {limit} -o -"))), near);
    }
}

/// The length of a path, as a limit, reaches its end.
#[test]
fn what_lies_exactly_at_the_limit_is_reached() {
    let all = rows(&of_run("builtin:cave --from 2,5"));
    for ((x, y), distance) in all.into_iter().skip(60).step_by(307) {
        let (_, queries, _) = told(&format!("run builtin:cave --from 2,5 --to {x},{y}"));
        let cost = queries[0]["cost"].as_f64().expect("a path");
        for limit in [cost, distance] {
            let near = rows(&succeeds(&format!("reach builtin:cave --from 2,5 --within {limit} -o -")));
            assert!(near.contains(&((x, y), distance)), "({x}, {y}) within {limit}");
        }
    }
}

#[test]
fn of_several_sources_the_nearest_counts() {
    let each = [(2, 5), (57, 3)].map(|(x, y)| rows(&of_run(&format!("builtin:cave --from {x},{y}"))));
    let both = rows(&succeeds("reach builtin:cave --from 2,5 --from 57,3 -o -"));
    assert_eq!(both.len(), each[0].len());
    for ((at, found), (a, b)) in both.into_iter().zip(each[0].iter().zip(&each[1])) {
        assert_eq!((at, at), (a.0, b.0));
        assert!((found - a.1.min(b.1)).abs() < 1e-8, "{at:?}: {found}, {a:?}, {b:?}");
    }
}

#[test]
fn at_any_angle_they_are_those_of_any_angle_paths() {
    for gap in ["open", "closed"] {
        let all = rows(&succeeds(&format!("reach builtin:cave --from 2,5 --k any --gap {gap} -o -")));
        for (at, distance) in all.iter().step_by(97) {
            let (x, y) = at;
            let (_, queries, _) =
                told(&format!("run builtin:cave --engine anya --gap {gap} --from 2,5 --to {x},{y}"));
            let cost = queries[0]["cost"].as_f64().expect("a path");
            assert!((cost - distance).abs() < 1e-6, "{at:?}: {cost}, {distance}");
        }
    }
}

#[test]
fn the_array_has_the_numbers_row_by_row() {
    let files = Files::new();
    let [csv, npy] = ["near.csv", "near.npy"].map(|name| files.path(name));
    let line = "reach builtin:cave --from 2,5 --within 40 --k any";
    let said = succeeds(&format!("{line} -o {csv} -o {npy}"));
    assert_eq!(said, succeeds(line), "files change nothing in the summary");
    let bytes = fs::read(npy).expect("an array");
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
    let length = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert_eq!(length % 64, 0);
    let header = String::from_utf8(bytes[10..length].to_vec()).expect("ASCII");
    let expected = "{'descr': '<f8', 'fortran_order': False, 'shape': (37, 73), }";
    assert_eq!((header.trim_end(), header.ends_with(" \n")), (expected, true));
    let numbers: Vec<f64> =
        bytes[length..].chunks(8).map(|n| f64::from_le_bytes(n.try_into().expect("8 bytes"))).collect();
    assert_eq!(numbers.len(), 37 * 73);
    let finite = numbers.iter().enumerate().filter(|(_, number)| **number != f64::INFINITY);
    let finite: Vec<_> = finite.map(|(i, number)| (((i % 73) as i32, (i / 73) as i32), *number)).collect();
    let expected = rows(&fs::read_to_string(csv).expect("a CSV"));
    assert_eq!(finite.len(), expected.len());
    for (found, expected) in finite.into_iter().zip(expected) {
        assert_eq!(found.0, expected.0);
        assert!((found.1 - expected.1).abs() <= 1e-9, "{found:?}, {expected:?}");
    }
}

#[test]
fn pictures_show_the_sources() {
    let files = Files::new();
    let [png, svg] = ["near.png", "near.SVG"].map(|name| files.path(name));
    succeeds(&format!("reach builtin:cave --from 2,5 --from 57,3 --within 20 -o {png} -o {svg}"));
    assert!(fs::read(png).expect("a picture").starts_with(b"\x89PNG\r\n"));
    let svg = fs::read_to_string(svg).expect("a picture");
    // The third is the sign of the legend.
    assert_eq!(svg.matches("class=\"badge\"").count(), 3);
    assert!(svg.contains("cave.map: center, corners never, k = 3") && svg.contains(">0 to 19.97<"));
}

#[test]
fn the_summary_says_what_was_reached() {
    assert_eq!(
        succeeds("reach builtin:cave --from 2,5 --within 40"),
        "cave.map · center, corners never, k = 3 (8 moves) · 500 vertices within 40 of (2, 5), the furthest \
         (36, 12) at 39.9706\n"
    );
    assert_eq!(
        succeeds("reach builtin:cave --from 2,5 --from 57,3 --k any"),
        "cave.map · corner, gap open, k = any · 1,522 vertices reached from 2 sources, the furthest (37, 30) at \
         53.8693\n"
    );
    assert_eq!(
        succeeds("reach builtin:cave --from 2,5 --within 0"),
        "cave.map · center, corners never, k = 3 (8 moves) · 1 vertex within 0 of (2, 5), the furthest \
         (2, 5) at 0.0000\n"
    );
}

#[test]
fn lengths_are_in_meters_in_the_world() {
    let files = Files::new();
    let yaml = files.path("isles.yaml");
    succeeds(&format!("convert builtin:archipelago -o {yaml} --resolution 0.5 --origin -3,2,0"));
    let line = format!("reach {yaml} --world --from 5.2,16.2 --within 20 --radius 0.4");
    let cells = "reach builtin:archipelago --from 16,7 --within 40 --radius 0.8";
    assert_eq!(succeeds(&format!("{line} -o -")), succeeds(&format!("{cells} -o -")));
    assert_eq!(
        succeeds(&line),
        "isles.yaml · center, corners never, k = 3 (8 moves) · 558 vertices within 20 m of (16, 7), the furthest \
         (50, 10) at 39.9706 cells: in the world (22.250, 14.750) at 19.985 m\n  \
         moved to vertices: the sources by at most 0.071 m\n"
    );
}

#[test]
fn sources_that_cannot_be() {
    let fails = |line: &str, message: &str| {
        let Ran { status, stdout, stderr } = run(line);
        assert_eq!((&*stderr, &*stdout, status), (&*format!("error: {message}\n"), "", Some(1)), "{line}");
    };
    let blocked = "the start (0, 0) is blocked: choose a free vertex; the nearest one is (2, 1)";
    fails("reach builtin:cave --from 2,5 --from 0,0 -o -", blocked);
    let outside = "the start (99, 0) is outside the map, whose vertices run from (0, 0) to (71, 35)";
    fails("reach builtin:cave --from 99,0", outside);
    let missing = "the following required arguments were not provided: --from <X,Y>; see --help";
    check("reach builtin:cave", missing);
    let no_vertex =
        "(2.5, 5) is no vertex: write whole numbers, such as 3,14, or --k any, or meters with --world";
    check("reach builtin:cave --from 2.5,5", no_vertex);
    check(
        "reach builtin:cave --from 2,5 --world",
        "the map cave.map has no place in the world: leave --world out, or give the YAML file of a ROS map",
    );
}

#[test]
fn arguments_that_make_no_sense() {
    check(
        "reach builtin:cave --from 2,5 --within -1",
        "invalid value '-1' for '--within <COST>': expected a number of cells, 0 or more, such as 2.5; see --help",
    );
    check(
        "reach builtin:cave --from 2,5 --k any --placement center --corners one",
        "--corners: for k = any there is gap in its place: open or closed",
    );
    check(
        "reach builtin:cave --from 2,5 --placement center --gap open",
        "--gap: at centers it is for k = any; else there is corners in its place: never, one or always",
    );
    let known = "expected a name that ends in .png, .svg, .csv, .npy, .asc or .tif (- prints CSV)";
    for name in ["near.gif", "near", ".png"] {
        check(&format!("reach builtin:cave --from 2,5 -o {name}"), &format!("{name}: {known}"));
    }
}

#[test]
fn files_that_cannot_be_written() {
    let files = Files::new();
    let path = files.path("no/near.png");
    let folder = path.trim_end_matches("/near.png");
    check(
        &format!("reach builtin:cave --from 2,5 -o {path}"),
        &format!("{path}: there is no folder {folder}: make it first, or choose another one"),
    );
    for end in ["csv", "npy", "png", "svg"] {
        let folder = files.path(&format!("folder.{end}"));
        fs::create_dir(&folder).expect("a folder");
        let Ran { status, stdout, stderr } = run(&format!("reach builtin:cave --from 2,5 -o {folder}"));
        assert_eq!((&*stdout, status, stderr.lines().count()), ("", Some(2), 1), "{stderr}");
        assert!(stderr.starts_with(&format!("error: {folder}: ")), "{stderr}");
    }
}

#[test]
fn the_map_is_not_overwritten() {
    let files = Files::new();
    let png = files.path("cave.png");
    succeeds(&format!("convert builtin:cave -o {png}"));
    let before = fs::read(&png).expect("a map");
    let message = format!("{png}: would be overwritten, and the map is read from it: choose another name");
    check(&format!("reach {png} --from 2,5 -o {} -o {png}", files.path("near.csv")), &message);
    for options in [format!("--to 9,9 --draw {png}"), format!("--to 9,9 --trace {png}")] {
        check(&format!("run {png} --from 2,5 {options}"), &message);
    }
    check(&format!("run {png} --from 2,5 --engine dijkstra --distances {png}"), &message);
    check(&format!("build {png} --engine subgoal -o {png}"), &message);
    assert_eq!(fs::read(&png).expect("a map"), before);
}

#[test]
fn the_examples_of_the_help_run() {
    let files = Files::new();
    add_example_files(&files);
    run_examples(&files, "reach", 11);
}
