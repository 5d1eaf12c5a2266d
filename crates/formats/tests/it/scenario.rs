//! Scenarios: what is accepted, what is written, and the message of every error.

use std::sync::Arc;

use mediant_formats::{Instance, Scenario};
use mediant_grid::{Grid, Vertex};

fn parsed(text: impl AsRef<[u8]>) -> Scenario {
    let scenario = Scenario::parse(text.as_ref()).expect("a well-formed scenario");
    assert_eq!(scenario.as_bytes(), text.as_ref());
    let mut written = Vec::new();
    scenario.write(&mut written).expect("a vector takes every byte");
    assert_eq!(written, text.as_ref());
    scenario
}

#[track_caller]
fn refused(text: impl AsRef<[u8]>, message: &str) {
    assert_eq!(Scenario::parse(text.as_ref()).expect_err("to be refused").to_string(), message);
}

fn instance(map: &str, optimal: f64) -> Instance {
    let (start, goal) = (Vertex::new(1, 2), Vertex::new(3, 4));
    Instance { bucket: 7, map: map.into(), width: 10, height: 20, start, goal, optimal }
}

#[test]
fn tabs_spaces_versions_and_line_ends() {
    let accepted = [
        "version 1\n7\tmaps/a.map\t10\t20\t1\t2\t3\t4\t2.82842712\n",
        "version 1.0\n7 maps/a.map 10 20 1 2 3 4 2.82842712\n",
        "version 1.0\r\n7  maps/a.map\x2010 20 1 2 3 4 2.82842712 \r\n\r\n",
        "version\t1 \n\n 7\t maps/a.map \t10\t20\t1\t2\t3\t4\t2.82842712\t\n \n",
        "version 1\n7\tmaps/a.map\t10\t20\t1\t2\t3\t4\t2.82842712",
        "\u{feff}version 1\r\n7\tmaps/a.map\t10\t20\t1\t2\t3\t4\t2.82842712\n",
        "version 1\n07\tmaps/a.map\t+10\t20\t1\t2\t3\t4\t282842712e-8",
    ];
    for text in accepted {
        assert_eq!(parsed(text).instances(), [instance("maps/a.map", 2.828_427_12)], "{text:?}");
    }
    assert_eq!(parsed("version 1").instances(), []);
}

#[test]
fn a_length_of_0_is_known_only_where_nothing_moves() {
    let known = |start: (i32, i32), optimal| {
        Instance { start: start.into(), ..instance("a.map", optimal) }.known_optimal()
    };
    assert_eq!([known((1, 2), 0.0), known((3, 4), 0.0), known((1, 2), 2.5)], [None, Some(0.0), Some(2.5)]);
}

#[test]
fn names_of_maps() {
    let text = "version 1\n0\tmy maps/old  yard.map\t1\t1\t0\t0\t0\t0\t0\n0\tmy maps/old  yard.map\t1\t1\t0\t0\t0\t0\t0\n";
    let scenario = parsed(text);
    let [first, second] = scenario.instances() else { panic!("two instances") };
    assert_eq!((&*first.map, first.map_file_name()), ("my maps/old  yard.map", "old  yard.map"));
    assert!(Arc::ptr_eq(&first.map, &second.map), "equal names in a row are kept once");
    assert_eq!(instance(r"maps\dao\arena.map", 0.0).map_file_name(), "arena.map");
    assert_eq!(instance("arena.map", 0.0).map_file_name(), "arena.map");
}

#[test]
fn instances_become_a_scenario_and_come_back() {
    let mut instances: Vec<Instance> = [0.0, 1.0 / 3.0, 2.0_f64.sqrt(), 1e300, 5e-324]
        .map(|optimal| instance("a b/c.map", optimal))
        .to_vec();
    instances[1].start = Vertex::new(i32::MIN, i32::MAX);
    instances[2].bucket = u32::MAX;
    instances[3].map = "d.map".into();
    let scenario = Scenario::from_instances(instances.clone()).unwrap();
    assert_eq!(parsed(scenario.as_bytes()).instances(), instances);
    let one = Scenario::from_instances(vec![instance("a.map", 2.5)]).unwrap();
    assert_eq!(one.as_bytes(), b"version 1\n7\ta.map\t10\t20\t1\t2\t3\t4\t2.5\n");
}

#[test]
fn instances_that_cannot_be_written() {
    let lengths = [(-1.0, "-1"), (-0.0, "-0"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")];
    for (optimal, found) in lengths {
        let error = Scenario::from_instances(vec![instance("a.map", 1.0), instance("a.map", optimal)]);
        let message = format!(
            "instance 1: expected a length of 0 or more as optimal length, found {found}; change it before it is written"
        );
        assert_eq!(error.unwrap_err().to_string(), message);
    }
    for name in ["", " a", "a ", "a\tb", "a\nb", "a\r", "a\u{85}"] {
        let message = format!(
            "instance 0: expected a UTF-8 name without control characters and without spaces around it as map, \
             found {name:?}; change it before it is written"
        );
        let error = Scenario::from_instances(vec![instance(name, 1.0)]);
        assert_eq!(error.unwrap_err().to_string(), message);
    }
}

#[test]
fn versions_that_are_refused() {
    let rest = "a MovingAI scenario begins with its version, followed by one line per query";
    let cases = [
        ("\n", "an empty line"),
        ("version\n", "`version`"),
        ("version 3\n", "`version 3`"),
        ("version 1 0\n", "`version 1 0`"),
        ("type octile\nheight 1\n", "`type octile`"),
        ("0\ta.map\t1\t1\t0\t0\t0\t0\t0\n", "`0\\ta.map\\t1\\t1\\t0\\t0\\t0\\t0\\t0`"),
    ];
    for (text, found) in cases {
        let message =
            format!("line 1, column 1: expected `version 1` or `version 1.0`, found {found}; {rest}");
        refused(text, &message);
    }
    refused(
        "version 2\nheight 1\n",
        "line 1, column 1: expected `version 1` or `version 1.0`, found `version 2`; this is a scenario of a map \
         that changes, which has its map with it: give it in place of a map",
    );
    refused(
        "",
        "line 1, column 1: expected a MovingAI scenario, found an empty file; is this the file that you meant?",
    );
    let message = "line 1, column 1: expected `version 1` or `version 1.0`, found `PK\\x03\\x04\\xff`";
    refused(b"PK\x03\x04\xff", &format!("{message}; {rest}"));
}

#[test]
fn lines_with_too_few_or_too_many_fields() {
    let cases = [
        ("0", 2, 1),
        ("0\ta.map\t1\t1\t0\t0\t0\t0\t", 20, 8),
        ("0 a.map 1 1 0 0 0 0", 20, 8),
        ("0 my map 1 1 0 0 0 0 0", 22, 10),
        ("0\ta.map\t1\t1\t0\t0\t0\t0\t0\t 8\t9", 24, 11),
    ];
    for (line, column, found) in cases {
        let message = format!(
            "line 3, column {column}: expected nine fields (bucket, map, width, height, start x, start y, goal x, \
             goal y, optimal length), found {found}; separate them by tabs if the map's name has spaces"
        );
        refused(format!("version 1\n\n{line}\n"), &message);
    }
}

#[test]
fn fields_that_are_refused() {
    let count = "a whole number from 0 to 4294967295";
    let coordinate = "a whole number from -2147483648 to 2147483647";
    let length = "a length of 0 or more";
    let name = "a UTF-8 name without control characters and without spaces around it";
    let cases: [(&[u8], usize, &str, &str, &str); 14] = [
        (b"x\ta\t1\t1\t0\t0\t0\t0\t0", 1, count, "bucket", "`x`"),
        (b"\ta\t1\t1\t0\t0\t0\t0\t0", 1, count, "bucket", "nothing"),
        (b"0\t \t1\t1\t0\t0\t0\t0\t0", 4, name, "map", "nothing"),
        (b"0\t\xffa\t1\t1\t0\t0\t0\t0\t0", 3, name, "map", "`\\xffa`"),
        (b"0\ta\x07\t1\t1\t0\t0\t0\t0\t0", 3, name, "map", "`a\\x07`"),
        (b"0\ta\t -1\t1\t0\t0\t0\t0\t0", 6, count, "width", "`-1`"),
        (b"0\ta\t1\t4294967296\t0\t0\t0\t0\t0", 7, count, "height", "`4294967296`"),
        (b"0\ta\t1\t1\t1.5\t0\t0\t0\t0", 9, coordinate, "start x", "`1.5`"),
        (b"0\ta\t1\t1\t0\t2147483648\t0\t0\t0", 11, coordinate, "start y", "`2147483648`"),
        (b"0 a 1 1 0 0 ! 0 0", 13, coordinate, "goal x", "`!`"),
        (b"0 a 1 1 0 0 0 a 0", 15, coordinate, "goal y", "`a`"),
        (b"0 a 1 1 0 0 0 0 -1", 17, length, "optimal length", "`-1`"),
        (b"0 a 1 1 0 0 0 0 nan", 17, length, "optimal length", "`nan`"),
        (b"0 a 1 1 0 0 0 0 1e999", 17, length, "optimal length", "`1e999`"),
    ];
    for (line, column, expected, field, found) in cases {
        let message = format!(
            "line 2, column {column}: expected {expected} as {field}, found {found}; mend or remove the line"
        );
        refused([b"version 1\n", line].concat(), &message);
    }
}

#[test]
fn a_scenario_for_another_map() {
    let mut instances = vec![instance("maps/a.map", 1.0), instance("maps/b.map", 1.0)];
    instances[1].height = 21;
    let scenario = Scenario::from_instances(instances).unwrap();
    let grid = |width, height| Grid::from_fn(width, height, |_, _| false).unwrap();
    let error = scenario.check_map(&grid(10, 20), "c.map").unwrap_err();
    assert_eq!(
        error.to_string(),
        "instance 1 of the scenario: expected the map `maps/b.map` of 10 × 21 cells, \
         found `c.map` of 10 × 20 cells; take the scenario that was made for this map"
    );
    assert_eq!(scenario.check_map(&grid(20, 10), "c.map").unwrap_err().index, 0);
    let scenario = Scenario::from_instances(vec![instance("maps/a.map", 1.0)]).unwrap();
    assert_eq!(scenario.check_map(&grid(10, 20), "renamed.map"), Ok(()));
}
