//! Maps as text.

use std::path::Path;

use mediant::Map;
use mediant_formats::{Ground, MapFile, MapOptions, Tiles, map_size_with, read_map_with};
use mediant_grid::{AsciiMap, Grid};

use crate::bytes::halves;

/// The most cells of a map that is compared cell by cell.
const MOST: u64 = 1 << 16;

pub(crate) fn run(data: &[u8]) {
    let (options, text) = halves(data);
    moving_ai(text, &Tiles::default());
    if let Ok(letters) = std::str::from_utf8(options) {
        let (free, blocked) = letters.split_once(' ').unwrap_or((letters, ""));
        let some = |letters| Some(letters).filter(|letters: &&str| !letters.is_empty());
        if let Ok(tiles) = Tiles::new(some(free), some(blocked)) {
            let is_free = |tile| tiles.is_free(tile) == Some(true);
            assert!(free.chars().all(is_free), "tiles that were said to be free: {letters:?}");
            moving_ai(text, &tiles);
        }
    }
    if let Ok(drawing) = std::str::from_utf8(text) {
        drawn(drawing);
    }
}

fn moving_ai(text: &[u8], tiles: &Tiles) {
    let size = MapFile::size(text);
    let Ok(map) = MapFile::from_bytes(text.to_vec(), tiles.clone()) else { return };
    let grid = map.to_grid();
    assert_eq!(size, Ok((grid.width(), grid.height())), "the header states the size");
    assert_eq!(map.as_bytes(), text);
    if u64::from(grid.width()) * u64::from(grid.height()) > MOST {
        return;
    }
    let again = MapFile::from_grid(&grid);
    assert_eq!(MapFile::parse(again.as_bytes()).map(|map| map.to_grid()), Ok(grid.clone()));
    let grounds = Ground::ALL.map(|ground| map.ground_grid(ground));
    for (y, row) in (0..).zip(map.rows()) {
        for (x, &tile) in (0..).zip(row) {
            assert_eq!(grid.is_free(x, y), map.is_free(tile));
            let ground = map.ground(x, y);
            let found = Ground::ALL.into_iter().zip(&grounds).filter(|(_, grid)| grid.is_free(x, y));
            assert!(found.map(|(ground, _)| ground).eq(ground), "the ground of ({x}, {y})");
        }
    }
    let options = MapOptions { tiles: tiles.clone(), ..MapOptions::default() };
    let read = |_: &Path| Ok(text.to_vec());
    if let Ok(source) = read_map_with("a.map", &options, read) {
        assert_eq!(source.grid, grid);
        assert_eq!(map_size_with("a.map", read).ok(), Some((grid.width(), grid.height())));
    }
}

fn drawn(drawing: &str) {
    if let Ok(map) = drawing.parse::<Map>() {
        let again: Map = map.to_string().parse().expect("a map as it is written");
        assert_eq!(again.id(), map.id());
    }
    if let Ok(map) = AsciiMap::parse(drawing) {
        let Grid { .. } = map.grid;
        let is_on_map = |x: i32, y: i32| x >= 0 && y >= 0 && x <= map.grid.width() as i32;
        let marks = drawing.chars().filter_map(|mark| map.mark(mark));
        assert!(marks.into_iter().all(|at| is_on_map(at.x, at.y)));
    }
}
