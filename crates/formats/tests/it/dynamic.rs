//! Scenarios of maps that change: what is accepted, and the message of every error.

use std::{fs, sync::Arc};

use mediant_formats::{
    DynamicEvent, DynamicQuery, DynamicScenario, MapFile, Optimal, Patch, PlacedPatch, ReadError, Scenario,
};
use mediant_grid::Grid;

const PATCHES: &str = "type patch\npatches 3\npatch 0\nheight 2\nwidth 3\nmap\n@.T\nGSO\n\
                       patch 1\nheight 1\nwidth 1\nmap\n.\npatch 2\nheight 1\nwidth 2\nmap\n#W\n";
const HEADER: &str = "version 2\nheight 3\nwidth 5\ncost 1 octile\npatch yard.patch\ncommands\n";

fn patches() -> Vec<Arc<Patch>> {
    Patch::parse_all(PATCHES.as_bytes()).expect("patches")
}

fn parsed(text: &str) -> DynamicScenario {
    assert!(DynamicScenario::is_one(text.as_bytes()));
    DynamicScenario::parse(text.as_bytes(), &patches()).expect(text)
}

#[track_caller]
fn refused(text: impl AsRef<[u8]>, message: &str) {
    let error = DynamicScenario::parse(text.as_ref(), &patches()).expect_err("to be refused");
    assert_eq!(error.to_string(), message);
}

#[track_caller]
fn patches_refused(text: impl AsRef<[u8]>, message: &str) {
    assert_eq!(Patch::parse_all(text.as_ref()).expect_err("to be refused").to_string(), message);
}

/// The rows of a grid, as a map file has them.
fn rows(grid: &Grid) -> Vec<String> {
    MapFile::from_grid(grid).rows().map(|row| String::from_utf8_lossy(row).into_owned()).collect()
}

#[test]
fn the_patches_before_the_first_query_make_the_map() {
    let scenario = parsed(&format!("{HEADER}P 0 0 1 0\nP 0 2 0 2\nP 0 1 1 0\nQ 0 0 0 4 2 -1\nP 4 1 3 1\n"));
    assert_eq!(rows(&scenario.grid()), ["...@.", "...@.", "@@..."]);
    let query =
        DynamicQuery { bucket: 0, start: (0, 0).into(), goal: (4, 2).into(), optimal: Optimal::NoPath };
    let patch = PlacedPatch { patch: Arc::clone(&patches()[1]), x: 3, y: 1 };
    assert_eq!(scenario.events(), [DynamicEvent::Query(query), DynamicEvent::Patch(patch)]);
    // Without a query all patches come before it.
    let scenario = parsed(&format!("{HEADER}P 0 2 3 2\n"));
    assert_eq!(
        (rows(&scenario.grid()), scenario.events().len()),
        (vec![".....".into(), ".....".into(), "...@@".into()], 0)
    );
}

#[test]
fn headers_costs_and_line_ends() {
    let optimal = |text: &str| match parsed(text).events() {
        [DynamicEvent::Query(query)] => query.optimal,
        other => panic!("{other:?}"),
    };
    assert_eq!(optimal(&format!("{HEADER}Q 0 0 0 4 2 4.82842\n")), Optimal::Length(4.828_42));
    assert_eq!(optimal(&format!("{HEADER}Q 0 0 0 0 0 0\n").replace('\n', "\r\n")), Optimal::Length(0.0));
    assert_eq!(optimal(&format!("\u{feff}{HEADER}\n\tQ  0 0 0 4 2 -1 \n\n")), Optimal::NoPath);
    let other = "version 2.0\npatch my yard.patch\nwidth 5\n\nheight 3\ncommands\nQ 7 -1 0 4 9";
    assert_eq!(optimal(other), Optimal::Unknown);
    assert_eq!(DynamicScenario::patch_file(other.as_bytes()).as_deref(), Ok("my yard.patch"));
    let costs = HEADER.replace("cost 1 octile", "cost 3 moves octile time");
    assert_eq!(optimal(&format!("{costs}Q 0 0 0 4 2 -9.5 3 1e3")), Optimal::Length(3.0));
    let unknown = HEADER.replace("octile", "manhattan");
    assert_eq!(optimal(&format!("{unknown}Q 0 0 0 4 2 6")), Optimal::Unknown);
    assert!(!DynamicScenario::is_one(b"version 1\n") && !DynamicScenario::is_one(b""));
    assert!(Scenario::parse(HEADER.as_bytes()).is_err());
}

#[test]
fn cells_of_a_patch() {
    let patches = patches();
    assert_eq!(*patches[0], Patch::new(3, [true, false, true, false, false, true]));
    let placed = PlacedPatch { patch: Arc::clone(&patches[0]), x: 2, y: 1 };
    assert_eq!(placed.rectangle(), mediant_grid::Rectangle::new(2, 1, 3, 2));
    let cells: Vec<Option<bool>> = [(2, 1), (3, 1), (4, 2), (5, 1), (1, 1), (2, 3), (2, u32::MAX)]
        .map(|(x, y)| placed.cell(x, y))
        .to_vec();
    assert_eq!(cells, [Some(true), Some(false), Some(true), None, None, None, None]);
    assert_eq!((Patch::new(2, [true; 5]).height(), Patch::new(0, [true]).width()), (2, 1));
}

#[test]
fn headers_that_are_refused() {
    let form = "a scenario of a map that changes begins with the lines `version 2`, `height N`, `width N`, \
                `cost N NAMES`, `patch FILE` and `commands`";
    for (text, line, expected, found) in [
        ("", 1, "`version 2`", "the end of the file"),
        ("version 1\n", 1, "`version 2`", "`version 1`"),
        ("version 2\n", 2, "`height N` or `width N` or `patch FILE`", "the end of the file"),
        ("version 2\nheight 3\ncommands\n", 3, "`width N` or `patch FILE`", "`commands`"),
        ("version 2\nheight 3\nheight 3\n", 3, "`width N` or `patch FILE`", "`height 3`"),
        ("version 2\nheight 3 4\n", 2, "`height N`", "`height 3 4`"),
        ("version 2\nheight 3\nwidth 4\npatch a\n\nP 0 0 0 0\n", 6, "`commands`", "`P 0 0 0 0`"),
        ("version 2\ncost 2 octile\n", 2, "`cost 1 NAMES` for the 1 names in it", "`cost 2 octile`"),
        ("version 2\npatch \n", 2, "`patch FILE` with a name in UTF-8", "`patch `"),
    ] {
        refused(text, &format!("line {line}, column 1: expected {expected}, found {found}; {form}"));
    }
    for (side, found) in [("0", "`0`"), ("32769", "`32769`"), ("x", "`x`"), ("", "nothing")] {
        let message = format!(
            "line 2, column 7: expected a number of cells from 1 to 32768 as width, found {found}; mend or remove the line"
        );
        refused(format!("version 2\nwidth {side}"), &message);
    }
}

#[test]
fn commands_that_are_refused() {
    for (line, found) in [
        ("R 0", "`R 0`"),
        ("P 0 0 1", "`P 0 0 1`"),
        ("P 0 0 1 0 0", "`P 0 0 1 0 0`"),
        ("Q 0 0 0 4 2", "`Q 0 0 0 4 2`"),
        ("Q 0 0 0 4 2 1 1", "`Q 0 0 0 4 2 1 1`"),
        ("Q", "`Q`"),
        ("\u{e9}", "`\\xc3\\xa9`"),
    ] {
        let message = format!(
            "line 7, column 1: expected `P bucket patch x y` or `Q bucket x y x y` with one cost after it, found \
             {found}; mend or remove the line"
        );
        refused(format!("{HEADER}{line}\n"), &message);
    }
    let count = "a whole number from 0 to 4294967295";
    let length = "a length of 0 or more, or -1 for no path";
    for (line, column, expected, field, found) in [
        ("P -1 0 0 0", 3, count, "bucket", "`-1`"),
        ("P 0 x 0 0", 5, count, "patch", "`x`"),
        ("P 0 0 -1 0", 7, count, "x", "`-1`"),
        ("P 0 0 0 1.5", 9, count, "y", "`1.5`"),
        (
            "Q 0 0 0 4 2147483648 1",
            11,
            "a whole number from -2147483648 to 2147483647",
            "goal y",
            "`2147483648`",
        ),
        ("Q 0 0 0 4 2 -2", 13, length, "octile cost", "`-2`"),
        ("Q 0 0 0 4 2 -0", 13, length, "octile cost", "`-0`"),
        ("Q 0 0 0 4 2 inf", 13, length, "octile cost", "`inf`"),
    ] {
        let message = format!(
            "line 7, column {column}: expected {expected} as {field}, found {found}; mend or remove the line"
        );
        refused(format!("{HEADER}{line}\n"), &message);
    }
    let other = "is this the file of patches that was made for the scenario?";
    let message = format!("line 7, column 5: expected a patch below 3, found 3; {other}");
    refused(format!("{HEADER}P 0 3 0 0\n"), &message);
    for (x, y) in [(3, 0), (0, 2), (4_294_967_295_u32, 0)] {
        let message = format!(
            "line 7, column 7: expected a place on the map of 5 × 3 cells, found 3 × 2 cells at ({x}, {y}); {other}"
        );
        refused(format!("{HEADER}P 0 0 {x} {y}\n"), &message);
    }
}

#[test]
fn patches_that_are_refused() {
    let form = "a file of patches begins with the lines `type patch` and `patches N`, and each patch, counted from 0, \
                with `patch I`, `height N`, `width N` and `map`, its rows below";
    let one = "type patch\npatches 1\npatch 0\nheight 1\nwidth 2\nmap\n";
    for (text, line, expected, found) in [
        (String::new(), 1, "`type patch`", "the end of the file"),
        ("type octile\n".into(), 1, "`type patch`", "`type octile`"),
        ("type patch\n".into(), 2, "`patches N`", "the end of the file"),
        ("type patch\npatches -1\n".into(), 2, "`patches N`", "`patches -1`"),
        ("type patch\npatches 1\n".into(), 3, "`patch 0`", "the end of the file"),
        ("type patch\npatches 1\npatch 1\n".into(), 3, "`patch 0`", "`patch 1`"),
        ("type patch\npatches 1\npatch 0\nwidth 2\nmap\n".into(), 5, "`height N`", "`map`"),
        (format!("{one}..\n..\n"), 8, "the end of the file after 1 patches", "`..`"),
        (format!("{one}..\n").replace("patches 1", "patches 2"), 8, "`patch 1`", "the end of the file"),
    ] {
        patches_refused(text, &format!("line {line}, column 1: expected {expected}, found {found}; {form}"));
    }
    patches_refused(
        format!("{one}.\n"),
        "line 7, column 2: expected a row of 2 cells, found the end of the line after 1; complete the row or mend the \
         width in the header",
    );
    patches_refused(
        one,
        "line 7, column 1: expected row 1 of 1, found the end of the file; is the file cut short, or the height in the \
         header too large?",
    );
    // A number of patches or rows takes no memory.
    let huge = "type patch\npatches 99999999999\npatch 0\nheight 32768\nwidth 32768\nmap\n";
    assert!(Patch::parse_all(huge.as_bytes()).is_err());
}

#[test]
fn the_patches_are_beside_the_scenario() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("yard.scen"), format!("{HEADER}P 0 0 0 0\n")).unwrap();
    assert!(
        matches!(DynamicScenario::read(at("yard.scen")), Err(ReadError::Missing { path }) if path == at("yard.patch"))
    );
    fs::write(at("yard.patch"), "type map\n").unwrap();
    assert!(
        matches!(DynamicScenario::read(at("yard.scen")), Err(ReadError::Patches { path, .. }) if path == at("yard.patch"))
    );
    fs::write(at("yard.patch"), PATCHES).unwrap();
    let scenario = DynamicScenario::read(at("yard.scen")).unwrap();
    assert_eq!((scenario.width(), scenario.height()), (5, 3));
    assert_eq!(scenario.grid().free_cells(), 12);
    fs::write(at("yard.scen"), format!("{HEADER}P 0 9 0 0\n")).unwrap();
    let error = DynamicScenario::read(at("yard.scen")).unwrap_err();
    assert!(
        matches!(error, ReadError::Dynamic { .. }) && error.to_string().contains("line 7, column 5"),
        "{error}"
    );
}
