//! Search traces: what is written, whether it is the JSON of the format, and what happens when a writer
//! fails.

use std::io::{self, Write};

use mediant_formats::{TraceEvent, TraceEventKind, TraceHeader, TraceWriter};
use mediant_grid::{AsciiMap, Grid, PlacementKind};
use serde_json::{Value, json};

fn event(id: u32, parent: Option<u32>, (x, y): (i32, i32), (f, g): (f64, f64)) -> TraceEvent {
    TraceEvent { id, parent, x: f64::from(x), y: f64::from(y), f: Some(f), g: Some(g) }
}

/// A search from (1, 0) to (0, 1) on a map of 2 × 2 cells.
fn write_events(trace: &mut TraceWriter<'_, impl Write>) -> io::Result<()> {
    use TraceEventKind::{Closing, Destination, End, Expanding, Generating, Source, Updating};
    let start = event(1, None, (1, 0), (1.5, 0.0));
    let goal = event(2, Some(1), (0, 1), (1.5, 2.0_f64.sqrt()));
    trace.event(Source, &TraceEvent { f: None, g: None, ..start })?;
    trace.event(Destination, &TraceEvent { parent: None, f: None, g: None, ..goal })?;
    trace.event(Expanding, &start)?;
    trace.event(Generating, &TraceEvent { f: Some(f64::INFINITY), g: Some(0.1 + 0.2), ..goal })?;
    trace.event(Updating, &goal)?;
    trace.event(Closing, &start)?;
    trace.event(End, &goal)
}

fn written(header: &TraceHeader<'_>) -> String {
    let mut trace = TraceWriter::new(Vec::new(), header).expect("a vector takes every byte");
    write_events(&mut trace).expect("a vector takes every byte");
    assert_eq!(trace.events(), 7);
    String::from_utf8(trace.finish().expect("a vector takes every byte")).expect("JSON is text")
}

fn parsed(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in {text}"))
}

#[test]
fn a_trace_word_by_word() {
    let text = written(&TraceHeader { placement: PlacementKind::Center, map: None });
    let render = "\"render\":";
    let (before, after) = (text.find(render).unwrap(), text.find("\n\"events\":").unwrap());
    assert_eq!(&text[..before], "{\"version\":\"1.0.5\",\n");
    let drawn = parsed(&text[before + render.len()..after - 1]);
    insta::assert_snapshot!("render", serde_json::to_string_pretty(&drawn).unwrap());
    insta::assert_snapshot!("events", &text[after..]);
}

#[test]
fn a_trace_is_json_with_its_events_in_order() {
    let trace = parsed(&written(&TraceHeader { placement: PlacementKind::Center, map: None }));
    assert_eq!(trace["version"], "1.0.5");
    let types: Vec<&str> =
        trace["events"].as_array().unwrap().iter().map(|event| event["type"].as_str().unwrap()).collect();
    assert_eq!(
        types,
        ["source", "destination", "expanding", "generating", "updating", "closing", "end"],
        "the names that the format has"
    );
    let expected =
        json!({ "type": "updating", "id": 2, "pId": 1, "x": 0, "y": 1, "f": 1.5, "g": 2.0_f64.sqrt() });
    assert_eq!(trace["events"][4], expected);
    assert_eq!(trace["events"][0], json!({ "type": "source", "id": 1, "pId": null, "x": 1, "y": 0 }));
    // A cost is written with enough digits to be read back; one that JSON cannot hold is null.
    assert_eq!(trace["events"][3]["g"].as_f64(), Some(0.1 + 0.2));
    assert_eq!(trace["events"][3]["f"], Value::Null);
}

#[test]
fn a_trace_without_events_is_a_document_too() {
    let header = TraceHeader { placement: PlacementKind::Corner, map: None };
    let text = String::from_utf8(TraceWriter::new(Vec::new(), &header).unwrap().finish().unwrap()).unwrap();
    assert_eq!(parsed(&text)["events"], json!([]));
}

#[test]
fn squares_lie_on_cells_or_around_corners() {
    let drawn = |placement| parsed(&written(&TraceHeader { placement, map: None }))["render"].clone();
    let (center, corner) = (drawn(PlacementKind::Center), drawn(PlacementKind::Corner));
    let square = |render: &Value| render["components"]["vertex"][0].clone();
    assert_eq!(square(&center)["x"], "{{$.event.x + 0}}");
    assert_eq!(square(&center)["width"], 1.0);
    assert_eq!(center["path"]["pivot"]["x"], "{{$.event.x + 0.5}}");
    assert_eq!(square(&corner)["x"], "{{$.event.x + -0.25}}");
    assert_eq!(square(&corner)["width"], 0.5);
    assert_eq!(corner["path"]["pivot"]["x"], "{{$.event.x + 0}}");
    // Every component that the view names exists.
    for part in center["views"]["main"]["components"].as_array().unwrap() {
        assert!(center["components"][part["$"].as_str().unwrap()].is_array(), "{part}");
    }
}

/// How often the closed polygon winds around a point. A canvas fills where this is not 0.
fn winding(points: &[(f64, f64)], (x, y): (f64, f64)) -> i32 {
    let edges = points.iter().zip(points.iter().cycle().skip(1));
    let turns = edges.map(|(&(ax, ay), &(bx, by))| {
        let side = (bx - ax) * (y - ay) - (x - ax) * (by - ay);
        i32::from(ay <= y && by > y && side > 0.0) - i32::from(ay > y && by <= y && side < 0.0)
    });
    turns.sum()
}

fn check_map(grid: &Grid) {
    let trace = parsed(&written(&TraceHeader { placement: PlacementKind::Center, map: Some(grid) }));
    let (first, rest) = trace["events"].as_array().and_then(|events| events.split_first()).expect("events");
    assert!(rest.iter().all(|event| event.get("map").is_none()), "the map is written once");
    assert_eq!((&first["type"], &first["id"]), (&json!("source"), &json!(1)));
    let number = |value: &Value| value.as_f64().expect("a number");
    let outline = first["map"].as_array().expect("the points of the map");
    let points: Vec<(f64, f64)> = outline.iter().map(|p| (number(&p["x"]), number(&p["y"]))).collect();
    for y in -1..=grid.height() as i32 {
        for x in -1..=grid.width() as i32 {
            // Not the middle of the cell: it may lie on a line without area.
            let wound = winding(&points, (f64::from(x) + 0.617, f64::from(y) + 0.382));
            let inside = (0..grid.width() as i32).contains(&x) && (0..grid.height() as i32).contains(&y);
            assert_eq!(wound, i32::from(inside && grid.is_blocked(x, y)), "cell ({x}, {y})");
        }
    }
}

#[test]
fn the_outline_of_the_map_encloses_its_blocked_cells() {
    for drawing in ["#", ".", "##..#\n.....\n#.#.#\n.####", "....\n.##.\n.##.\n....", "#####\n#...#\n#####"] {
        check_map(&AsciiMap::parse(drawing).unwrap().grid);
    }
    check_map(&Grid::from_fn(70, 9, |x, y| (x * x + 3 * y) % 7 < 3).unwrap());
}

/// A writer that takes this many bytes, then fails.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = bytes.len().min(self.0);
        self.0 -= taken;
        if taken == 0 { Err(io::Error::other("full")) } else { Ok(taken) }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_writer_that_fails_anywhere_is_reported() {
    let grid = AsciiMap::parse("#.").unwrap().grid;
    let header = TraceHeader { placement: PlacementKind::Center, map: Some(&grid) };
    let length = written(&header).len();
    let run = |room: usize| -> io::Result<()> {
        let mut trace = TraceWriter::new(Full(room), &header)?;
        write_events(&mut trace)?;
        trace.finish().map(drop)
    };
    for room in 0..length {
        let error = run(room).expect_err("no room for the whole trace");
        assert!(error.to_string().contains("full"), "room for {room} bytes: {error}");
    }
    run(length).unwrap();
}

#[test]
fn nothing_is_held_back() {
    let mut out = Vec::new();
    let header = TraceHeader { placement: PlacementKind::Center, map: None };
    let mut trace = TraceWriter::new(&mut out, &header).unwrap();
    trace.event(TraceEventKind::Expanding, &event(7, None, (3, 1), (2.0, 0.0))).unwrap();
    assert!(out.ends_with(br#"{"type":"expanding","id":7,"pId":null,"x":3,"y":1,"f":2.0,"g":0.0}"#));
}
