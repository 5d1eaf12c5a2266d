//! Walking over elevation, costs around obstacles, and rasters in other formats.

use mediant::{Map, Motion, Pace, files::SurfaceOptions};
use mediant_formats::{Georeference, Surface, read_surface};
use serde_json::Value;

use crate::{
    common::{Files, run, succeeds, told},
    errors::check,
};

/// A hillside in cells of 30 m, with a lake.
const HEIGHTS: [i16; 12] = [0, 6, 12, 18, 0, 6, -99, 18, 1, 7, 13, 19];

fn hill() -> Surface {
    let surface = Surface::new(4, 3, HEIGHTS.to_vec()).expect("twelve numbers").with_no_data(Some(-99.0));
    surface.with_georeference(Georeference::from_lower_left((30.0, 30.0), (500.0, 70.0)).expect("a place"))
}

fn files() -> Files {
    let files = Files::new();
    for name in ["dem.tif", "dem.asc", "dem.npy"] {
        hill().save(files.path(name)).expect("a file");
    }
    files
}

/// The times of the library, from a vertex or to it.
fn times(pace: &Pace, at: (i32, i32), is_from: bool) -> Vec<f64> {
    let map = Map::with_data(&hill()).expect("a map");
    let walking = map.walking_of(&hill(), None, pace).expect("elevations");
    let space = walking.space(Motion::centers(4)).expect("k = 4");
    let field = if is_from { space.field_from([at]) } else { space.field([at]) };
    field.expect("free").lengths()
}

fn numbers(path: &str) -> Vec<f64> {
    let surface = read_surface(path, &SurfaceOptions::default()).expect(path);
    surface.iter().map(|number| number.unwrap_or(f64::INFINITY)).collect()
}

#[test]
fn reach_has_times_from_and_to_places() {
    let files = files();
    let dem = files.path("dem.tif");
    for (way, is_from) in [("--from", true), ("--to", false)] {
        for (name, pace) in
            [("tobler", Pace::Tobler), ("langmuir", Pace::Langmuir(mediant::Langmuir::default()))]
        {
            let expected = times(&pace, (0, 0), is_from);
            for output in ["time.tif", "time.asc", "time.npy"] {
                let output = files.path(output);
                succeeds(&format!("reach {dem} {way} 0,0 --k 4 --pace {name} -o {output} --elevation"));
                let written = numbers(&output);
                let is_near = written
                    .iter()
                    .zip(&expected)
                    .all(|(one, other)| one == other || (one - other).abs() < 1e-6 * other);
                assert!(is_near, "{way}, {name}: {written:?}, not {expected:?}");
            }
        }
    }
    let placed = read_surface(files.path("time.tif"), &SurfaceOptions::default()).expect("a raster");
    assert_eq!(
        (placed.cell_size(), placed.georeference().lower_left()),
        (Some((30.0, 30.0)), Some((500.0, 70.0)))
    );
    let furthest =
        times(&Pace::Tobler, (0, 0), true).into_iter().filter(|time| time.is_finite()).fold(0.0, f64::max);
    let text = succeeds(&format!("reach {dem} --elevation --from 0,0 --k 4"));
    assert!(
        text.contains(&format!("{furthest:.4} s (")) && text.contains("11 vertices reached from (0, 0)"),
        "{text}"
    );
    let text = succeeds(&format!("reach {dem} --elevation --to 0,0 --k 4 --within 40"));
    assert!(text.contains("within 40 s of (0, 0)"), "{text}");
    // A map with walls, the size of a cell by hand, and friction.
    let walls = files.add("walls.map", "type octile\nheight 3\nwidth 4\nmap\n....\n....\n@...\n");
    let friction = files.path("friction.npy");
    Surface::new(4, 3, vec![0.5_f32; 12]).expect("twelve").save(&friction).expect("a file");
    let csv = succeeds(&format!(
        "reach {walls} --elevation {} --cell-size 30 --friction {friction} --from 0,0 --k 2 --within 40 -o -",
        files.path("dem.npy")
    ));
    let beside = 30.0 * (Pace::Tobler.time(0.0) + 0.5);
    let line = csv.lines().nth(2).expect("a line for (0, 1)");
    let time: f64 = line.rsplit(',').next().and_then(|time| time.parse().ok()).expect("a time");
    assert!(line.starts_with("0,1,") && (time - beside).abs() < 1e-4 && !csv.contains("0,2,"), "{csv}");
}

#[test]
fn run_walks_over_elevation() {
    let files = files();
    let dem = files.path("dem.tif");
    let (run, queries, _) = told(&format!("run {dem} --elevation --k 4 --from 0,0 --to 3,2"));
    assert_eq!((&run["walking"], &run["engine"]), (&Value::Bool(true), &"astar".into()));
    let expected = times(&Pace::Tobler, (0, 0), true)[11];
    let cost = queries[0]["cost"].as_f64().expect("a path");
    assert!((cost - expected).abs() < 1e-6 * expected, "{cost}, not {expected}");
    assert!(queries[0]["length"].is_number() && queries[0]["lower_bound"].is_null());
    let (_, back, _) = told(&format!("run {dem} --elevation --k 4 --from 3,2 --to 0,0"));
    assert!(back[0]["cost"].as_f64().is_some_and(|back| back < cost), "downhill takes less time");
}

#[test]
fn what_does_not_go_with_elevation_is_said() {
    let files = files();
    let (dem, array) = (files.path("dem.tif"), files.path("dem.npy"));
    check(
        &format!("reach {array} --from 0,0 --elevation"),
        &format!("{array}: it does not say how large a cell is: give --cell-size METERS"),
    );
    check(
        "reach builtin:cave --from 2,5 --elevation",
        "the cells of cave.map have no numbers: give --elevation a FILE, or a raster of elevations as the map",
    );
    check(
        &format!("reach {dem} --from 0,0 --elevation {dem}"),
        &format!(
            "--elevation {dem} for dem.tif, whose cells have numbers of their own: leave one of the two out"
        ),
    );
    check(
        &format!("reach builtin:cave --from 2,5 --elevation {dem}"),
        &format!(
            "{dem}: 4 columns and 3 rows of numbers, and the map has 72 and 36: give one number for each cell"
        ),
    );
    for option in ["--block 1,1", "--unblock 1,1", "--free-ends"] {
        let name = option.split(' ').next().expect("a name");
        check(
            &format!("run {dem} --from 0,0 --to 1,1 {option} --elevation"),
            &format!("{name} does not go with --elevation: leave one of the two out"),
        );
    }
    for (line, part) in [
        (format!("reach {dem} --from 0,0 --placement corner --elevation"), "choose centers, not corners"),
        (format!("reach {dem} --from 0,0 --k 9 --elevation"), "choose a k from 2 to 8"),
        (format!("run {dem} --from 0,0 --to 1,1 --engine jps --elevation"), "jps knows no costs of cells"),
        (format!("reach {dem} --from 0,0 --pace naismith --elevation"), "tobler, langmuir"),
        (format!("reach {dem} --from 0,0 --pace tobler"), "--elevation"),
        (format!("reach {dem} --from 0,0 --to 1,1 --elevation"), "cannot be used with"),
        (format!("reach {dem} --from 0,0 --elevation --radius 1"), "cannot be used with"),
        (format!("reach {array} --from 0,0 --cell-size 0 --elevation"), "positive"),
        (format!("reach {dem} --from 0,0 --cell-size 9 --elevation"), "leave --cell-size out"),
        (format!("reach {dem} --from 0,0 -o {dem} --elevation"), "would be overwritten"),
    ] {
        let ran = run(&line);
        assert!(ran.status == Some(2) && ran.stderr.contains(part), "{line}: {}", ran.stderr);
    }
    // A blocked source is one of the query.
    let ran = run(&format!("reach {dem} --from 2,1 --elevation"));
    assert!(ran.status == Some(1) && ran.stderr.contains("(2, 1) is blocked"), "{}", ran.stderr);
}

/// A wall with a narrow door on the straight way, and a wide gate below.
fn depot(files: &Files) -> String {
    let row =
        |y: usize| (0..40).map(move |x| if x == 20 && !(4..7).contains(&y) && y < 16 { '@' } else { '.' });
    let rows: Vec<String> = (0..30).map(|y| row(y).collect()).collect();
    let map = files.add("depot.map", format!("type octile\nheight 30\nwidth 40\nmap\n{}\n", rows.join("\n")));
    let depot = files.path("depot.yaml");
    succeeds(&format!("convert {map} -o {depot} --resolution 0.05 --origin 1,2,0"));
    depot
}

#[test]
fn robots_keep_off_walls() {
    let files = Files::new();
    let depot = depot(&files);
    let plain = told(&format!("run {depot} --k 4 --from 5,5 --to 35,5")).1;
    let cells = "--inscribed-radius 1 --inflation-radius 8 --cost-scaling-factor 0.15 --weight 3";
    let soft = told(&format!("run {depot} --k 4 --from 5,5 --to 35,5 {cells}")).1;
    let [short, round] =
        [&plain[0]["cost"], &soft[0]["length"]].map(|length| length.as_f64().expect("a path"));
    assert!(short == 30.0 && round > 45.0, "{short} and {round}");
    // The same in meters.
    let meters = "--inscribed-radius 0.05 --inflation-radius 0.4 --cost-scaling-factor 3 --weight 3 --world";
    let (from, to) = ("1.275,3.225", "2.775,3.225");
    let world = told(&format!("run {depot} --k 4 --from {from} --to {to} {meters}")).1;
    assert_eq!(world[0]["cost"], soft[0]["cost"]);
    for (options, part) in [
        ("--inflation-radius 1 --inscribed-radius 2", "inflation radius"),
        ("--inflation-radius -1", "expected a number"),
        ("--weight 2", "--inflation-radius"),
        ("--inflation-radius 3 --radius 1", "cannot be used with"),
    ] {
        let ran = run(&format!("run {depot} --from 5,5 --to 35,5 {options}"));
        assert!(ran.status == Some(2) && ran.stderr.contains(part), "{options}: {}", ran.stderr);
    }
    let costs = files.path("costs.tif");
    let text = succeeds(&format!("convert {depot} {cells} -o {costs}"));
    assert!(text.starts_with("costs.tif · 40 × 30 numbers from 1 to "), "{text}");
    let surface = read_surface(&costs, &SurfaceOptions::default()).expect("a raster");
    assert_eq!(
        (surface.cell_size(), surface.georeference().lower_left()),
        (Some((0.05, 0.05)), Some((1.0, 2.0)))
    );
    assert_eq!((surface.get(20, 0), surface.get(0, 29)), (None, Some(1.0)));
    // The raster has the same paths: costs are one a meter there.
    let read = told(&format!("run {costs} --k 4 --from 5,5 --to 35,5")).1;
    let [one, other] = [&read[0], &soft[0]].map(|query| query["cost"].as_f64().expect("a path"));
    assert!((one - 0.05 * other).abs() < 1e-6 * one, "{one} and {other}");
}

#[test]
fn rasters_are_converted() {
    let files = files();
    let known: Vec<f64> =
        HEIGHTS.map(|height| if height == -99 { f64::INFINITY } else { height.into() }).into();
    let mut last = files.path("dem.tif");
    for name in ["1.asc", "2.tif", "3.npy", "4.asc"] {
        let next = files.path(name);
        succeeds(&format!("convert {last} -o {next}"));
        assert_eq!(numbers(&next), known, "{name}");
        last = next;
    }
    let whole = files.path("whole.asc");
    Surface::new(3, 1, vec![1_u16, 300, 65_535]).expect("three").save(&whole).expect("a file");
    let mut last = whole;
    for name in ["1.pgm", "2.npy", "3.png", "4.tif", "5.pgm"] {
        let next = files.path(name);
        succeeds(&format!("convert {last} -o {next}"));
        assert_eq!(numbers(&next), [1.0, 300.0, 65_535.0], "{name}");
        last = next;
    }
    let gray = files.path("dem.pgm");
    succeeds(&format!("convert {} -o {gray}", files.path("dem.tif")));
    let expected: Vec<f64> = HEIGHTS.map(|height| if height == -99 { 0.0 } else { height.into() }).into();
    assert_eq!(numbers(&gray), expected, "cells without data are 0");
    // A map with costs beside it.
    let map = files.add("yard.map", "type octile\nheight 1\nwidth 3\nmap\n.@.\n");
    let (costs, output) = (files.path("5.pgm"), files.path("costs.npy"));
    succeeds(&format!("convert {map} --costs {costs} -o {output}"));
    assert_eq!(numbers(&output), [1.0, f64::INFINITY, 65_535.0]);
    check(
        &format!("convert {map} -o {output}"),
        "the cells of yard.map have no costs: give --costs FILE or --inflation-radius R, or choose a format for maps",
    );
    let halves = files.path("halves.npy");
    Surface::new(2, 1, vec![0.5, 1.0]).expect("two").save(&halves).expect("a file");
    let ran = run(&format!("convert {halves} -o {}", files.path("halves.png")));
    assert!(ran.status == Some(2) && ran.stderr.contains("0.5"), "{}", ran.stderr);
}
