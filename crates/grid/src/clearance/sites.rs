//! The centers or corner vertices to which distances are measured, by words.

use super::{Fit, Outside};
use crate::BitMatrix;

/// From which points distances are measured, and to what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    /// From cell centers to blocked squares, in half cells.
    CentersToSquares,
    /// From corner vertices to blocked squares, in cells.
    CornersToSquares,
    /// From cell centers to the centers of blocked cells, in cells.
    CentersToCenters,
}

impl From<Fit> for Measure {
    fn from(fit: Fit) -> Self {
        match fit {
            Fit::Centers => Self::CentersToSquares,
            Fit::WholeCells => Self::CornersToSquares,
        }
    }
}

impl Measure {
    pub(super) const fn is_from_corners(self) -> bool {
        matches!(self, Self::CornersToSquares)
    }
}

/// The cell centers, or the corner vertices, that lie on obstacles.
///
/// A blocked cell is a closed square. The point of it that is nearest to a corner vertex is a corner vertex,
/// so the distance to a blocked cell is that to the nearest of its corners. For centers see
/// [`envelope`](super::envelope).
#[derive(Clone, Copy)]
pub(super) struct Sites<'g> {
    pub(super) rows: &'g BitMatrix,
    pub(super) measure: Measure,
    pub(super) outside: Outside,
}

impl Sites<'_> {
    /// The columns and rows of centers or corner vertices.
    pub(super) const fn size(self) -> (usize, usize) {
        let more = self.measure.is_from_corners() as usize;
        (self.rows.width() as usize + more, self.rows.height() as usize + more)
    }

    /// The words of a row.
    pub(super) const fn words(self) -> usize {
        self.size().0.div_ceil(64)
    }

    /// Word `word` of row y, 1 = on an obstacle. The bits beyond the last column mean nothing.
    #[inline]
    pub(super) fn word(self, word: usize, y: usize) -> u64 {
        if !self.measure.is_from_corners() {
            return self.rows.row_words(y as u32)[word];
        }
        let [before, here] = [word.wrapping_sub(1), word].map(|at| self.cells(at, y));
        here | here << 1 | before >> 63
    }

    /// The 64 cells of row y or of the row above that are blocked, the outside of the map among them if it
    /// counts.
    #[inline]
    fn cells(self, word: usize, y: usize) -> u64 {
        let outside = if self.outside == Outside::Blocked { !0 } else { 0 };
        let (width, height) = (self.rows.width() as usize, self.rows.height() as usize);
        // The word before the first one wraps, to columns beyond all.
        let Some(columns @ 1..) = width.checked_sub(word.wrapping_mul(64)) else {
            return outside;
        };
        let beyond = !0_u64 << 1 << (columns.min(64) - 1);
        let row = |y: usize| if y < height { self.rows.row_words(y as u32)[word] & !beyond } else { outside };
        row(y) | row(y.wrapping_sub(1)) | outside & beyond
    }
}
