//! Where cells were closed: which segments of an earlier path must be looked at.

use mediant_grid::{FreeSpace, Grid, Vertex};
use mediant_search::Path;

use super::difference::Cells;
use crate::placement::SubgoalPlacement;

/// The side of a block is 2 to the power of this, in cells.
const SHIFT: i32 = 3;
/// More rows of blocks than this are not looked at: a line of sight takes less.
const MOST_ROWS: i32 = 16;

/// The blocks of 8 × 8 vertices from which a path may touch a closed cell, one bit each.
#[derive(Clone, Debug, Default)]
pub(super) struct Closed {
    /// The words of a row of blocks.
    columns: usize,
    blocks: Vec<u64>,
}

impl Closed {
    /// The blocks near cells that are blocked on the present map.
    pub(super) fn new(now: &Grid, cells: &Cells) -> Self {
        let [width, height] = [now.width(), now.height()].map(|side| (side as usize >> SHIFT) + 1);
        let columns = width.div_ceil(64);
        let mut blocks = Vec::new();
        for (x, y) in cells.iter().filter(|&(x, y)| now.is_blocked(x, y)) {
            blocks.resize(columns * height, 0);
            // A vertex of either placement is at most one row and column away.
            for at in [(x - 1, y - 1), (x + 1, y - 1), (x - 1, y + 1), (x + 1, y + 1)] {
                let (column, row) = (at.0.max(0) as usize >> SHIFT, at.1.max(0) as usize >> SHIFT);
                if column < width && row < height {
                    let word: &mut u64 = &mut blocks[row * columns + column / 64];
                    *word |= 1 << (column % 64);
                }
            }
        }
        Self { columns, blocks }
    }

    /// Whether a path that held on the earlier map holds on the present one.
    pub(super) fn lets_pass<P: SubgoalPlacement>(&self, now: &FreeSpace<P>, path: &Path) -> bool {
        if self.blocks.is_empty() {
            return true;
        }
        let gaps = now.has_closed_gaps();
        path.waypoints().windows(2).all(|ends| {
            let [from, to] = [ends[0], ends[1]];
            !self.are_near(from, to)
                || now.sees(from, to) && !(gaps && (now.is_closed_gap(from) || now.is_closed_gap(to)))
        })
    }

    /// Whether a closed cell may be on the line between two vertices.
    fn are_near(&self, from: Vertex, to: Vertex) -> bool {
        let span = |a: i32, b: i32| (a.min(b).max(0) >> SHIFT, a.max(b).max(0) >> SHIFT);
        let ((left, right), (top, bottom)) = (span(from.x, to.x), span(from.y, to.y));
        if bottom - top >= MOST_ROWS {
            return true;
        }
        let [first, last] = [left, right].map(|column| column as usize / 64);
        (top..=bottom).any(|row| {
            let row = row as usize * self.columns;
            (first..=last).any(|number| {
                let low = if number == first { !0 << (left % 64) } else { !0 };
                let high = if number == last { !0 >> (63 - right % 64) } else { !0 };
                self.blocks.get(row + number).is_some_and(|word| word & low & high != 0)
            })
        })
    }

    pub(super) const fn memory_bytes(&self) -> usize {
        size_of_val(self.blocks.as_slice())
    }
}
