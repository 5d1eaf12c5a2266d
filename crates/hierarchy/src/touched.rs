//! The squares of a map that a change touches.

use mediant_grid::{Change, Grid, Interrupt, Interrupted, Rectangle};

use crate::window::{MAX_SIDE, Rows, low_bits};

/// A map in squares of cells, numbered row by row, and how far each looks beyond its own cells.
#[derive(Clone, Copy)]
pub(crate) struct Squares {
    pub(crate) side: u32,
    /// The columns to the left and to the right.
    pub(crate) beside: u32,
    /// The rows further up.
    pub(crate) above: u32,
    /// The rows further down.
    pub(crate) below: u32,
}

/// The rectangles that are compared between two questions of an interrupt.
const RECTANGLES: usize = 64;

/// The squares that see a cell in which the maps before and after a change differ, in ascending order.
pub(crate) fn touched(
    change: &Change,
    squares: Squares,
    (interrupt, during): (&Interrupt, &'static str),
) -> Result<Vec<u32>, Interrupted> {
    let Squares { side, beside, above, below } = squares;
    let [columns, rows] = [change.after().width(), change.after().height()].map(|cells| cells.div_ceil(side));
    let mut touched = Vec::new();
    for (number, &at) in change.cells().iter().enumerate() {
        interrupt.check_every(RECTANGLES, number, during)?;
        let differing = differing([change.before(), change.after()], at);
        let first = |cell: u32, reach: u32| cell.saturating_sub(reach) / side;
        let end = |cell: u32, all: u32| cell.div_ceil(side).min(all);
        // The part of a span of cells that is in the rectangle, from the rectangle's first cell on.
        let part = |from: u32, to: u32, first: u32, length: u32| {
            from.saturating_sub(first)..to.saturating_sub(first).min(length)
        };
        for y in first(at.y, below)..end(at.y + at.height + above, rows) {
            let lines = part((y * side).saturating_sub(above), (y + 1) * side + below, at.y, at.height);
            let seen =
                differing[lines.start as usize..lines.end as usize].iter().fold(0, |all, row| all | row);
            for x in first(at.x, beside)..end(at.x + at.width + beside, columns) {
                let cells = part((x * side).saturating_sub(beside), (x + 1) * side + beside, at.x, at.width);
                if seen & low_bits(cells.end) & !low_bits(cells.start) != 0 {
                    touched.push(y * columns + x);
                }
            }
        }
    }
    // The rectangles of several edits overlap, and a square can be in several.
    touched.sort_unstable();
    touched.dedup();
    Ok(touched)
}

/// The cells of a rectangle of a change in which two maps differ.
fn differing(maps: [&Grid; 2], at: Rectangle) -> Rows {
    let mut rows = [0; MAX_SIDE as usize];
    let word = |map: &Grid, y: u32| map.rows().row(y as i32).word(at.x as i32);
    for (row, y) in rows.iter_mut().zip(at.y..at.y + at.height) {
        *row = (word(maps[0], y) ^ word(maps[1], y)) & low_bits(at.width);
    }
    rows
}
