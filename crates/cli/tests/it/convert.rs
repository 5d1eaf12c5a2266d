//! `mediant convert`: maps keep their cells from format to format.

use std::fs;

use mediant::{K, Map, Motion};
use mediant_formats::{MapFile, MapOptions, MapSource, RosMap, read_map};

use crate::{
    common::{Files, Ran, add_example_files, bundled, run, run_examples, succeeds},
    errors::check,
};

fn read(path: &str) -> MapSource {
    read_map(path, &MapOptions::default()).expect(path)
}

/// Converts a map, and returns the path of the new one.
#[track_caller]
fn converted(files: &Files, options: &str, name: &str) -> String {
    let path = files.path(name);
    succeeds(&format!("convert {options} -o {path}"));
    path
}

#[test]
fn every_format_keeps_the_cells() {
    let files = Files::new();
    let town = read(&bundled("town.map")).grid;
    let names = ["1.map", "2.png", "3.PGM", "4.pbm", "5.yaml", "6.map", "7.yml", "8.png"];
    let mut last = "builtin:town".to_owned();
    for name in names {
        let is_ros = name.ends_with("yaml") || name.ends_with("yml");
        let options = if is_ros { " --resolution 0.1" } else { "" };
        last = converted(&files, &format!("{last}{options}"), name);
        assert_eq!(read(&last).grid, town, "{name}");
    }
}

#[test]
fn it_says_what_was_written() {
    let files = Files::new();
    let cells = "· 72 × 36 cells · 1,138 of 2,592 cells blocked, 43.9 %\n";
    let line = |name: &str| format!("convert builtin:town -o {}", files.path(name));
    assert_eq!(succeeds(&line("town.png")), format!("town.png {cells}"));
    assert_eq!(
        succeeds(&format!("{} --resolution 1", line("town.yaml"))),
        format!("town.yaml and town.pgm {cells}")
    );
}

#[test]
fn a_map_keeps_the_characters_of_its_tiles() {
    let files = Files::new();
    let text = "type octile\r\nheight 2\r\nwidth 3\r\nmap\r\n.TS\r\nW.G\r\n";
    let map = files.add("yard.map", text);
    let same = converted(&files, &map, "same.map");
    assert_eq!(fs::read_to_string(same).expect("a map"), text);
    let agent = files.path("agent.map");
    let Ran { status, stderr, .. } = run(&format!("convert {map} --radius 0.1 -o {agent}"));
    // A disc that small fits wherever a point may be, and it is said.
    assert_eq!(
        (stderr.as_str(), status),
        (
            "warning: a radius of 0.1000 cells changes nothing: such a disc fits wherever a point may be\n",
            Some(0)
        )
    );
    assert_eq!(fs::read_to_string(agent).expect("a map"), "type octile\nheight 2\nwidth 3\nmap\n.@.\n@..\n");
}

#[test]
fn a_ros_map_keeps_its_place() {
    let files = Files::new();
    let cave = converted(&files, "builtin:cave --resolution 0.05 --origin -1.5,2,0.25", "cave.yaml");
    let frame = |path: &str| {
        let frame = RosMap::read(path).expect("a ROS map").frame();
        (frame.resolution(), frame.origin())
    };
    assert_eq!(frame(&cave), (0.05, [-1.5, 2.0, 0.25]));
    assert_eq!(frame(&converted(&files, &cave, "same.yaml")), (0.05, [-1.5, 2.0, 0.25]));
    let coarse = converted(&files, &format!("{cave} --resolution 2"), "coarse.yaml");
    assert_eq!(frame(&coarse), (2.0, [-1.5, 2.0, 0.25]));
    let moved = converted(&files, &format!("{cave} --origin 0,0,0"), "moved.yaml");
    assert_eq!(frame(&moved), (0.05, [0.0; 3]));
    let plain = converted(&files, "builtin:cave --resolution 1", "plain.yaml");
    assert_eq!(frame(&plain), (1.0, [0.0; 3]));
}

#[test]
fn the_options_of_maps_count() {
    let files = Files::new();
    // Occupied, unknown, free, as savers write them.
    let depot = files.add("depot.pgm", "P2 3 1 255  0 205 254\n");
    let yaml = "image: depot.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n\
                occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    let ros = files.add("depot.yaml", yaml);
    for (options, row) in [
        (ros.clone(), "@@."),
        (format!("{ros} --unknown-free"), "@.."),
        (depot.clone(), "@.."),
        (format!("{depot} --threshold 0.9"), "@@."),
        (format!("{depot} --invert"), ".@@"),
    ] {
        let path = converted(&files, &options, "out.map");
        let text = fs::read_to_string(path).expect("a map");
        assert_eq!(text, format!("type octile\nheight 1\nwidth 3\nmap\n{row}\n"), "{options}");
    }
}

#[test]
fn with_a_radius_it_is_the_map_of_the_agent() {
    let files = Files::new();
    let isles = Map::open(bundled("archipelago.map")).expect("a map");
    let of = |radius: f64, motion: Motion| isles.for_disc(radius, motion).expect("a radius");
    let near = of(1.2, Motion::centers(K::N8));
    let far = of(1.2, Motion::corners(K::N8));
    assert_ne!(near, far, "the fit depends on the motion");
    for (options, expected) in [
        ("--radius 1.2", &near),
        ("--radius 1.2 --k 4", &far),
        ("--radius 1.2 --corners one", &far),
        ("--radius 1.2 --placement corner --gap closed", &far),
    ] {
        for name in ["agent.map", "agent.png"] {
            let path = converted(&files, &format!("builtin:archipelago {options}"), name);
            assert_eq!(read(&path).grid, **expected.grid(), "{options}");
        }
    }
    let yaml = converted(&files, "builtin:archipelago --resolution 0.5", "isles.yaml");
    let meters = converted(&files, &format!("{yaml} --world --radius 0.6"), "agent.yaml");
    assert_eq!(read(&meters).grid, **near.grid());
    check(
        &format!("convert builtin:cave --k 4 -o {}", files.path("cave.map")),
        "the following required arguments were not provided: --radius <R>; see --help",
    );
}

#[test]
fn a_map_never_overwrites_itself() {
    let files = Files::new();
    let map = MapFile::read(bundled("cave.map")).expect("a map");
    let cave = files.add("cave.map", map.as_bytes());
    let yaml = converted(&files, &format!("{cave} --resolution 1"), "cave.yaml");
    let pgm = files.path("cave.pgm");
    fs::create_dir(files.path("folder")).expect("a folder");
    let before = [&cave, &yaml, &pgm].map(|path| fs::read(path).expect(path));
    let around = files.path("folder/../cave.map");
    for (options, same) in [
        (format!("{cave} -o {cave} --invert"), &cave),
        (format!("{cave} -o {around}"), &around),
        (format!("{yaml} -o {yaml}"), &yaml),
        (format!("{yaml} -o {pgm}"), &pgm),
        (format!("{pgm} -o {yaml} --resolution 1"), &pgm),
    ] {
        check(
            &format!("convert {options}"),
            &format!("{same}: would be overwritten, and the map is read from it: choose another name"),
        );
    }
    assert_eq!([&cave, &yaml, &pgm].map(|path| fs::read(path).expect(path)), before);
    // Other files are replaced.
    converted(&files, "builtin:town", "cave.map");
    assert_eq!(read(&cave).grid, read(&bundled("town.map")).grid);
}

#[test]
fn what_cannot_be_converted() {
    let files = Files::new();
    let [yaml, png, no] = ["cave.yaml", "cave.png", "no/cave.png"].map(|name| files.path(name));
    check(
        &format!("convert builtin:cave -o {yaml}"),
        "the map cave.map has no place in the world: give --resolution METERS, the side of a cell, or choose \
         another format",
    );
    check(
        &format!("convert builtin:cave -o {yaml} --resolution 0"),
        &format!(
            "{yaml}: the place of the map: expected a resolution of more than 0 meters a cell, found 0; write \
             for instance 0.05"
        ),
    );
    check(
        &format!("convert builtin:cave -o {yaml} --resolution 1 --origin 1,2"),
        "invalid value '1,2' for '--origin <X,Y,YAW>': expected three numbers, such as -1.5,2,0: meters, meters \
         and radians; see --help",
    );
    for option in ["--resolution 1", "--origin 1,2,3"] {
        let name = option.split(' ').next().expect("a name");
        check(
            &format!("convert builtin:cave -o {png} {option}"),
            &format!("{name} is for a ROS map: leave it out, or give -o a name that ends in .yaml"),
        );
    }
    check(
        &format!("convert builtin:cave -o {no}"),
        &format!(
            "{no}: there is no folder {}: make it first, or choose another one",
            no.trim_end_matches("/cave.png")
        ),
    );
    for name in ["cave.bmp", "cave", "-"] {
        check(
            &format!("convert builtin:cave -o {name}"),
            &format!(
                "{name}: expected a name that ends in .map, .png, .pgm, .pbm, .yaml, .npy, .asc or .tif"
            ),
        );
    }
    let missing = "the following required arguments were not provided: --output <OUT>; see --help";
    check("convert builtin:cave", missing);
    for path in [&yaml, &png] {
        assert!(!fs::exists(path).expect("a folder"), "{path}");
    }
}

#[test]
fn the_examples_of_the_help_run() {
    let files = Files::new();
    add_example_files(&files);
    fs::remove_file(files.path("depot.map")).expect("it was there");
    run_examples(&files, "convert", 7);
}
