//! Maps: what is accepted, what is written, and the message of every error.

use mediant_formats::{MapError, MapFile};
use mediant_grid::{AsciiMap, Grid};

const PLAIN: &str = "type octile\nheight 2\nwidth 3\nmap\n.@G\nTSW\n";

fn parsed(text: impl AsRef<[u8]>) -> MapFile {
    let map = MapFile::parse(text.as_ref()).expect("a well-formed map");
    assert_eq!(map.as_bytes(), text.as_ref());
    let mut written = Vec::new();
    map.write(&mut written).expect("a vector takes every byte");
    assert_eq!(written, text.as_ref());
    map
}

#[track_caller]
fn refused(text: impl AsRef<[u8]>, message: &str) {
    assert_eq!(MapFile::parse(text.as_ref()).expect_err("to be refused").to_string(), message);
}

#[test]
fn tiles_sizes_and_free_cells() {
    let map = parsed(PLAIN);
    assert_eq!((map.width(), map.height()), (3, 2));
    assert_eq!(map.rows().collect::<Vec<_>>(), [b".@G", b"TSW"]);
    let drawn = AsciiMap::parse(".#.\n#.#").unwrap().grid;
    assert_eq!(map.to_grid(), drawn);
    let free: Vec<u8> = (0..=255).filter(|&tile| MapFile::is_free_tile(tile)).collect();
    assert_eq!(free, b".GS");
}

#[test]
fn every_well_formed_variant_is_accepted_and_written_back() {
    let grid = parsed(PLAIN).to_grid();
    let variants = [
        PLAIN.replace('\n', "\r\n"),
        PLAIN.trim_end().to_owned(),
        PLAIN.replace('\n', "\r\n").trim_end().to_owned(),
        format!("{PLAIN}\n\n"),
        format!("{PLAIN}\r\n \t\r\n\n"),
        format!("{PLAIN}   "),
        "type octile\nwidth 3\nheight 2\nmap\n.@G\nTSW\n".to_owned(),
        "type  octile \n\theight\t002\nwidth 3\t\r\nmap \n.@G\r\nTSW".to_owned(),
    ];
    for text in variants {
        assert_eq!(parsed(&text).to_grid(), grid, "{text:?}");
    }
}

#[test]
fn a_grid_becomes_a_map_and_comes_back() {
    let grid = AsciiMap::parse("..#\n#..\n.##\n...").unwrap().grid;
    let map = MapFile::from_grid(&grid);
    assert_eq!(map.as_bytes(), b"type octile\nheight 4\nwidth 3\nmap\n..@\n@..\n.@@\n...\n");
    assert_eq!(map, parsed(map.as_bytes()));
    assert_eq!(map.to_grid(), grid);
}

#[test]
fn the_longest_sides_are_accepted() {
    let side = Grid::MAX_SIDE as usize;
    let wide = format!("type octile\nheight 1\nwidth {side}\nmap\n{}\n", ".".repeat(side));
    assert_eq!(parsed(&wide).width(), Grid::MAX_SIDE);
    let tall = format!("type octile\nheight {side}\nwidth 1\nmap\n{}", ".\n".repeat(side));
    assert_eq!(parsed(&tall).height(), Grid::MAX_SIDE);
}

#[test]
fn headers_that_are_refused() {
    let form = "a MovingAI map begins with the lines `type octile`, `height N`, `width N` and `map`, with its rows below";
    let cases = [
        ("\n", "line 1, column 1: expected `type octile`, found an empty line"),
        ("version 1\n", "line 1, column 1: expected `type octile`, found `version 1`"),
        ("type tile\n", "line 1, column 1: expected `type octile`, found `type tile`"),
        ("type octile x\n", "line 1, column 1: expected `type octile`, found `type octile x`"),
        ("type octile\rheight", "line 1, column 1: expected `type octile`, found `type octile\\rheight`"),
        ("type octile", "line 2, column 1: expected `height N` or `width N`, found the end of the file"),
        ("type octile\nmap\n", "line 2, column 1: expected `height N` or `width N`, found `map`"),
        ("type octile\nheight 3\n", "line 3, column 1: expected `width N`, found the end of the file"),
        ("type octile\nheight 3\nheight 3\n", "line 3, column 1: expected `width N`, found `height 3`"),
        ("type octile\nwidth 3\n\n", "line 3, column 1: expected `height N`, found an empty line"),
        ("type octile\nheight 1\nwidth 1\n.\n", "line 4, column 1: expected `map`, found `.`"),
        ("type octile\nheight 1\nwidth 1\n", "line 4, column 1: expected `map`, found the end of the file"),
    ];
    for (text, message) in cases {
        refused(text, &format!("{message}; {form}"));
    }
    refused(
        "",
        "line 1, column 1: expected a MovingAI map, found an empty file; is this the file that you meant?",
    );
    let junk = [&b"\x7fELF\x02\x01\x01\0"[..], &[0xff; 50]].concat();
    let quoted = format!("`\\x7fELF\\x02\\x01\\x01\\x00{}…`", "\\xff".repeat(32));
    refused(junk, &format!("line 1, column 1: expected `type octile`, found {quoted}; {form}"));
}

#[test]
fn sides_that_are_refused() {
    let cases = [
        ("", "7: expected a height of 1 to 32768 cells, found nothing"),
        (" ", "8: expected a height of 1 to 32768 cells, found nothing"),
        (" x", "8: expected a height of 1 to 32768 cells, found `x`"),
        (" 0", "8: expected a height of 1 to 32768 cells, found `0`"),
        ("  -1", "9: expected a height of 1 to 32768 cells, found `-1`"),
        (" 2.5", "8: expected a height of 1 to 32768 cells, found `2.5`"),
        (" 32769", "8: expected a height of 1 to 32768 cells, found `32769`"),
        (" 4294967297", "8: expected a height of 1 to 32768 cells, found `4294967297`"),
        (
            " 99999999999999999999999",
            "8: expected a height of 1 to 32768 cells, found `99999999999999999999999`",
        ),
        (" 3 4", "10: expected a height of 1 to 32768 cells, found also `4`"),
    ];
    let mend = "write the number of rows that follow, or split the map";
    for (value, message) in cases {
        let text = format!("type octile\r\nheight{value}\r\nwidth 3\r\nmap\r\n");
        refused(&text, &format!("line 2, column {message}; {mend}"));
    }
    refused(
        "type octile\nheight 1\nwidth 1e3\nmap\n.",
        "line 3, column 7: expected a width of 1 to 32768 cells, found `1e3`; \
         write the number of characters in the rows that follow, or split the map",
    );
}

#[test]
fn rows_that_are_refused() {
    let header = "type octile\nheight 2\nwidth 3\nmap\n";
    let cases = [
        (
            "...\n..\n",
            "line 6, column 3: expected a row of 3 cells, found the end of the line after 2; \
             complete the row or mend the width in the header",
        ),
        (
            "\n...\n",
            "line 5, column 1: expected a row of 3 cells, found the end of the line after 0; \
             complete the row or mend the width in the header",
        ),
        (
            "...\r\n.....\r\n",
            "line 6, column 4: expected the end of a row of 3 cells, found 2 more bytes; \
             shorten the row or mend the width in the header",
        ),
        (
            "...\n.\0.\n",
            "line 6, column 2: expected a tile, found `\\x00`; \
             a tile is a printable ASCII character such as `.` (free) or `@` (blocked)",
        ),
        (
            "..é\n...\n",
            "line 5, column 3: expected a tile, found `\\xc3`; \
             a tile is a printable ASCII character such as `.` (free) or `@` (blocked)",
        ),
        (
            "...\n",
            "line 6, column 1: expected row 2 of 2, found the end of the file; \
             is the file cut short, or the height in the header too large?",
        ),
        (
            "...\n...\n\n@@@\n",
            "line 8, column 1: expected the end of the file after 2 rows, found `@@@`; \
             remove what follows or mend the height in the header",
        ),
    ];
    for (rows, message) in cases {
        refused(format!("{header}{rows}"), message);
    }
}

#[test]
fn a_header_allocates_nothing() {
    let text = "type octile\nheight 32768\nwidth 32768\nmap\n";
    assert_eq!(MapFile::parse(text.as_bytes()), Err(MapError::FewRows { line: 5, row: 1, height: 32768 }));
}
