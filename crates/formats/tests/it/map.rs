//! Maps: what is accepted, what is written, and the message of every error.

use mediant_formats::{Ground, MapError, MapFile, Tiles};
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
    let free: Vec<u8> = (0..=255).filter(|&tile| map.is_free(tile)).collect();
    assert_eq!(free, b".GSgs");
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
        PLAIN.to_ascii_lowercase(),
        format!("\u{feff}{PLAIN}"),
        format!("\r\n{}", PLAIN.replace("map", " \nmap")),
        PLAIN.replace("type", "\n\ntype").replace("width", "\nwidth"),
        PLAIN.replace("@G\n", "@G  \n").replace("SW\n", "SW \t\r\n"),
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
        ("\n", "line 2, column 1: expected `type octile`, found the end of the file"),
        ("version 1\n", "line 1, column 1: expected `type octile`, found `version 1`"),
        ("type tile\n", "line 1, column 1: expected `type octile`, found `type tile`"),
        ("type octile x\n", "line 1, column 1: expected `type octile`, found `type octile x`"),
        ("type octile\rheight", "line 1, column 1: expected `type octile`, found `type octile\\rheight`"),
        ("type octile", "line 2, column 1: expected `height N` or `width N`, found the end of the file"),
        ("type octile\nmap\n", "line 2, column 1: expected `height N` or `width N`, found `map`"),
        ("type octile\nheight 3\n", "line 3, column 1: expected `width N`, found the end of the file"),
        ("type octile\nheight 3\nheight 3\n", "line 3, column 1: expected `width N`, found `height 3`"),
        ("type octile\nwidth 3\n\n", "line 4, column 1: expected `height N`, found the end of the file"),
        ("type octile\nwidth 3\n\nmap\n", "line 4, column 1: expected `height N`, found `map`"),
        (
            "voxel 3 4 5\n",
            "line 1, column 1: expected `type octile`, found a 3-D map, `voxel` (only flat maps are read)",
        ),
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
            "..x\n...\n",
            "line 5, column 3: expected a tile, `.`, `G`, `S` (free) or `@`, `O`, `T`, `W`, `#` (blocked), \
             found `x`; say which characters are free or blocked, by `free` or `blocked`",
        ),
        (
            "...\n. .\n",
            "line 6, column 2: expected a tile, `.`, `G`, `S` (free) or `@`, `O`, `T`, `W`, `#` (blocked), \
             found ` `; say which characters are free or blocked, by `free` or `blocked`",
        ),
        (
            "...\n.  \n",
            "line 6, column 2: expected a row of 3 cells, found the end of the line after 1; \
             complete the row or mend the width in the header",
        ),
        (
            "...\n... .\n",
            "line 6, column 4: expected the end of a row of 3 cells, found 2 more bytes; \
             shorten the row or mend the width in the header",
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

#[test]
fn tiles_can_be_named() {
    let text = "type octile\nheight 2\nwidth 4\nmap\n.x #\nWw\"T\n";
    let drawn = |free: Option<&str>, blocked: Option<&str>| {
        let tiles = Tiles::new(free, blocked).unwrap();
        let map = MapFile::from_bytes(text.into(), tiles).map_err(|error| error.to_string())?;
        assert_eq!(map.as_bytes(), text.as_bytes());
        let grid = map.to_grid();
        let row = |y| (0..4).map(|x| if grid.is_free(x, y) { '.' } else { '#' }).collect::<String>();
        Ok::<_, String>(format!("{}/{}", row(0), row(1)))
    };
    assert_eq!(drawn(Some(". "), None).unwrap(), ".#.#/####");
    assert_eq!(drawn(None, Some("x ")).unwrap(), ".##./....");
    assert_eq!(
        drawn(Some("W "), Some("X.#\"")).unwrap_err(),
        "line 6, column 4: expected a tile, `W`, ` ` \
        (free) or `X`, `.`, `#`, `\"` (blocked), found `T`; say which characters are free or blocked, by `free` \
        or `blocked`"
    );
    assert_eq!(drawn(Some("W "), Some("X.#\"t")).unwrap(), "##.#/..##");
    // A space is a tile only where it is named.
    assert!(drawn(Some("W"), None).unwrap_err().contains("line 5, column 3: "));
    assert_eq!(
        Tiles::new(Some(""), None).unwrap_err().to_string(),
        "expected the characters of free cells, found none; name at least one, or leave them out"
    );
    assert_eq!(
        Tiles::new(Some("ab"), Some("B")).unwrap_err().to_string(),
        "the character `B` is named as free and as blocked; leave it out of one of them"
    );
    assert_eq!(Tiles::new(None, None), Ok(Tiles::default()));
}

#[test]
fn rows_of_text() {
    let usual = Tiles::default();
    for (rows, error) in [
        (
            &["#   #"][..],
            "row 0, column 1, from 0: expected a tile, `.`, `G`, `S` (free) or `@`, `O`, `T`, `W`, `#` \
          (blocked), found ` `; say which characters are free or blocked, by `free` or `blocked`",
        ),
        (
            &["...", ".█."],
            "row 1, column 1, from 0: expected a tile, `.`, `G`, `S` (free) or `@`, `O`, `T`, `W`, `#` \
          (blocked), found `█`; say which characters are free or blocked, by `free` or `blocked`",
        ),
    ] {
        assert_eq!(usual.grid(rows).unwrap_err().to_string(), error);
    }
    let walls = Tiles::new(None, Some("█")).unwrap().grid(["x█ "]).unwrap();
    assert_eq!([0, 1, 2].map(|x| walls.is_free(x, 0)), [true, false, true]);
    assert!(usual.grid(["..", "."]).is_err() && usual.grid([""; 0]).is_err());
}

#[test]
fn grounds() {
    let map = parsed("type octile\nheight 3\nwidth 4\nmap\n.Ww.\nGWtS\n.@OT\n");
    let ground = |x, y| map.ground(x, y);
    let (land, water, trees) = (Some(Ground::Land), Some(Ground::Water), Some(Ground::Trees));
    let expected =
        [[land, water, water, land], [land, water, trees, land], [land, None, None, trees]].concat();
    let cells = || (0..3).flat_map(|y| (0..4).map(move |x| (x, y)));
    assert_eq!(cells().map(|(x, y)| ground(x, y)).collect::<Vec<_>>(), expected);
    assert_eq!([ground(-1, 0), ground(4, 0), ground(0, 3), ground(0, i32::MIN)], [None; 4]);
    for kind in Ground::ALL {
        let grid = map.ground_grid(kind);
        assert!(cells().all(|(x, y)| grid.is_free(x, y) == (ground(x, y) == Some(kind))), "{kind:?}");
    }
    assert_eq!(map.ground_grid(Ground::Land), map.to_grid());
}
