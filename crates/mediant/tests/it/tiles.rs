//! Maps from rows of text and from files: which characters and shades are free.

use mediant::{
    Error, ErrorCode, Map,
    files::{MapOptions, RosVersion, Tiles},
};

fn tiles(free: Option<&str>, blocked: Option<&str>) -> Tiles {
    Tiles::new(free, blocked).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn unknown_characters_are_errors_that_name_them() {
    for (rows, row, column, tile) in
        [(["#   #"], 0, 1, ' '), (["010"], 0, 0, '0'), (["x.x"], 0, 0, 'x'), ([".G█"], 0, 2, '█')]
    {
        let error = Map::from_rows(rows).expect_err("unknown characters");
        assert_eq!(error.code(), ErrorCode::MapTile);
        let begin = format!("row {row}, column {column}, from 0: expected a tile, ");
        let end =
            format!(", found `{tile}`; say which characters are free or blocked, by `free` or `blocked`");
        let text = error.to_string();
        assert!(text.starts_with(&begin) && text.ends_with(&end), "{text}");
    }
    let path = |rows: &str, tiles: &Tiles, to: i32| -> Result<f64, Error> {
        let path = Map::from_rows_with([rows], tiles)?.path((1, 0), (to, 0))?;
        Ok(path.map_or(f64::INFINITY, |path| path.cost()))
    };
    for (rows, tiles, to, cost) in [
        ("#   #", tiles(Some(" "), None), 3, 2.0),
        ("#   #", tiles(None, Some("#")), 3, 2.0),
        ("1001", tiles(Some("0"), Some("1")), 2, 1.0),
        ("x.x.x", tiles(None, Some("X")), 3, f64::INFINITY),
        (".sgS.", Tiles::default(), 4, 3.0),
        (".w@W.", tiles(Some("W"), None), 3, f64::INFINITY),
    ] {
        assert_eq!(path(rows, &tiles, to).unwrap_or_else(|error| panic!("{error}")), cost, "{rows}");
    }
    let wrong = Error::from(Tiles::new(Some("ab"), Some("B")).expect_err("both"));
    assert_eq!(wrong.code(), ErrorCode::MapTile);
}

#[test]
fn a_map_without_a_free_cell_says_so() {
    let rock = Map::from_rows(["##", "@T"]).unwrap_or_else(|error| panic!("{error}"));
    let error = rock.path((0, 0), (1, 1)).expect_err("blocked");
    assert_eq!(error.code(), ErrorCode::StartBlocked);
    assert!(error.to_string().starts_with("the start (0, 0) is blocked, and no cell of the map is free: "));
    let some = Map::from_rows(["#.", "@T"]).unwrap_or_else(|error| panic!("{error}"));
    let error = some.path((0, 0), (1, 1)).expect_err("blocked");
    assert_eq!(error.to_string(), "the start (0, 0) is blocked: choose a free vertex");
}

#[test]
fn ros_maps_are_read_by_the_rules_of_2025_or_by_the_old_ones() {
    let files = [
        ("a.pgm", &b"P5 2 1 255 \xff\0"[..]),
        (
            "a.yaml",
            b"image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n\
              free_thresh: 0.0\n",
        ),
    ];
    let open = |ros| {
        let options = MapOptions { ros, ..MapOptions::default() };
        let (map, _) = Map::open_in("a.yaml", &options, |path| {
            let file = files.iter().find(|(name, _)| path.as_os_str() == *name);
            Ok(file.map(|(_, bytes)| bytes.to_vec()).unwrap_or_default())
        })
        .unwrap_or_else(|error| panic!("{error}"));
        [0, 1].map(|x| map.is_blocked((x, 0)))
    };
    assert_eq!(open(RosVersion::default()), [false, true]);
    assert_eq!(open(RosVersion::Ros1), [true, true]);
}
