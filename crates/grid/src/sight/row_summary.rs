//! Summaries of eight rows of cells each.

use crate::{BitMatrix, Grid};

/// For each column of each band of eight rows, whether any and whether all cells are blocked. With it a
/// [`VisibilitySweep`](super::VisibilitySweep) skips eight free rows at once.
#[derive(Clone, Debug)]
pub struct RowSummary {
    /// For each band and column, whether any of the eight cells is blocked.
    pub(super) blocked: BitMatrix,
    /// For each band and column, whether all eight cells are blocked.
    pub(super) solid: BitMatrix,
}

impl RowSummary {
    /// The number of rows of a band.
    pub(super) const LINES: i32 = 8;

    /// The summary of a map.
    #[must_use]
    pub fn new(grid: &Grid) -> Self {
        let (rows, count) = (grid.rows(), grid.height().div_ceil(Self::LINES as u32));
        let of = |x, band, join: fn(u64, u64) -> u64| {
            let lines = band * Self::LINES..(grid.height() as i32).min((band + 1) * Self::LINES);
            // Some rows of the last band may be beyond the map, where cells are blocked.
            let beyond = if lines.len() < Self::LINES as usize { !0 } else { rows.row(lines.start).word(x) };
            lines.map(|y| rows.row(y).word(x)).fold(beyond, join)
        };
        Self {
            blocked: BitMatrix::from_words(grid.width(), count, true, |x, band| of(x, band, |a, b| a | b)),
            solid: BitMatrix::from_words(grid.width(), count, true, |x, band| of(x, band, |a, b| a & b)),
        }
    }

    /// The memory used, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        size_of_val(self.blocked.words()) + size_of_val(self.solid.words())
    }
}
