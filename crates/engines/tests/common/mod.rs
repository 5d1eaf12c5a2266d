//! What the suites of the catalog share.

use std::sync::Arc;

use mediant_grid::{AsciiMap, Grid};
use mediant_moves::FiniteK;

pub(crate) fn k(k: u32) -> FiniteK {
    FiniteK::new(k).expect("k is at least 2")
}

pub(crate) fn grid() -> Arc<Grid> {
    let drawing = "
        ......#..
        .##...#..
        .#....#..
        ...#.....
        ...#..#..
    ";
    Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid)
}
