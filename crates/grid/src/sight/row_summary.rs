//! Rows of cells by eights.

use crate::{BitMatrix, Grid};

/// What eight rows of cells have in common, so that a beam can leap over them.
#[derive(Clone, Debug)]
pub struct RowSummary {
    /// For each column, whether any of the cells is blocked.
    pub(super) blocked: BitMatrix,
    /// For each column, whether all are.
    pub(super) solid: BitMatrix,
}

impl RowSummary {
    /// The rows of a band.
    pub(super) const LINES: i32 = 8;

    /// The bands of a map.
    #[must_use]
    pub fn new(grid: &Grid) -> Self {
        let (rows, count) = (grid.rows(), grid.height().div_ceil(Self::LINES as u32));
        let of = |x, band, join: fn(u64, u64) -> u64| {
            let lines = band * Self::LINES..(grid.height() as i32).min((band + 1) * Self::LINES);
            // Of the last band some rows may be beyond the map.
            let beyond = if lines.len() < Self::LINES as usize { !0 } else { rows.row(lines.start).word(x) };
            lines.map(|y| rows.row(y).word(x)).fold(beyond, join)
        };
        Self {
            blocked: BitMatrix::from_words(grid.width(), count, true, |x, band| of(x, band, |a, b| a | b)),
            solid: BitMatrix::from_words(grid.width(), count, true, |x, band| of(x, band, |a, b| a & b)),
        }
    }

    /// The memory that they take.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        size_of_val(self.blocked.words()) + size_of_val(self.solid.words())
    }
}
