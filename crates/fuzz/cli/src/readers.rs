//! Files of questions and of paths, from bytes.

use std::{
    path::Path,
    sync::{Arc, LazyLock},
};

use mediant::{K, Motion, PlacementKind, PointEnds, grid::Grid};

use crate::{
    check::file::{self, Entry, Waypoints},
    failure::Failure,
    map::NamedMap,
    run::{
        queries::read_pairs,
        timeline::{Timeline, altered},
    },
};

static MAP: LazyLock<NamedMap> = LazyLock::new(|| {
    let grid = Grid::from_fn(9, 6, |x, y| x % 4 == 2 && y % 3 != 1).expect("a small map");
    NamedMap::plain("a.map".to_owned(), Arc::new(grid))
});

/// The first byte chooses what the rest is: a file with paths, pairs, or a timeline. It panics where one is
/// treated wrongly.
pub fn read(bytes: &[u8]) {
    let Some((&what, bytes)) = bytes.split_first() else { return };
    match what % 3 {
        0 => paths(bytes),
        1 => pairs(bytes, if what >= 128 { Motion::corners(K::ANY) } else { Motion::centers(K::N8) }),
        _ => timeline(bytes),
    }
}

/// A message names the file, and is one line of text or more.
fn told(failure: &Failure) {
    assert!(!failure.to_string().trim().is_empty(), "{failure:?}");
}

fn paths(bytes: &[u8]) {
    match file::parse(bytes, Path::new("paths")) {
        Ok(entries) => {
            let lengths = entries.iter().filter_map(|entry| match entry {
                Entry::Path(path) => Some(match &path.waypoints {
                    Waypoints::Points(points) => points.len(),
                    Waypoints::Places(places) => places.len(),
                }),
                _ => None,
            });
            assert!(lengths.clone().count() > 0 && lengths.min() > Some(0), "a file without a path was read");
        }
        Err(failure) => told(&failure),
    }
}

/// Pairs that are read are written, and read again.
fn pairs(bytes: &[u8], motion: Motion) {
    let read = |bytes: &[u8]| read_pairs(bytes, Path::new("pairs.csv"), &MAP, motion);
    let pairs = match read(bytes) {
        Ok(pairs) => pairs,
        Err(failure) => return told(&failure),
    };
    assert!(!pairs.is_empty(), "a file without a pair was read");
    let line = |ends: &PointEnds| {
        let [start, goal] = [ends.start, ends.goal];
        format!("{},{},{},{}\n", start.x(), start.y(), goal.x(), goal.y())
    };
    let text: String = pairs.iter().map(line).collect();
    let again = read(text.as_bytes()).unwrap_or_else(|failure| panic!("{failure}: {text}"));
    assert_eq!(again, pairs, "{text}");
    assert_eq!(motion.rules.placement() == PlacementKind::Corner, motion.k == K::Any);
}

/// The edits of a timeline are on the map, and each belongs to a change.
fn timeline(bytes: &[u8]) {
    let timeline = match Timeline::parse(bytes, Path::new("timeline.jsonl"), &MAP) {
        Ok(timeline) => timeline,
        Err(failure) => return told(&failure),
    };
    let (width, height) = (MAP.grid.width(), MAP.grid.height());
    for edit in &timeline.edits {
        let at = edit.cells.rectangle();
        assert!(at.x + at.width <= width && at.y + at.height <= height, "{edit:?}");
        assert!(edit.after <= timeline.queries.len(), "{edit:?}");
    }
    for change in Timeline::changes(&timeline.edits) {
        let cells = change.iter().map(|edit| edit.cells.rectangle());
        let cells: Vec<u64> = cells.map(|at| u64::from(at.width) * u64::from(at.height)).collect();
        let altered = altered(change, &MAP);
        assert!(altered.len() == cells.len() && altered.iter().zip(&cells).all(|(few, all)| few <= all));
    }
    let (queries, every) = (timeline.queries.len(), 2);
    let taken = timeline.take(every, 3);
    assert_eq!(taken.queries.len(), queries.div_ceil(every).min(3));
}
