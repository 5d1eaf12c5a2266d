//! The cells that a move sweeps, by their offsets from its start, and sets of cells that are tested as words.

use mediant_moves::Vector;

use crate::{
    Placement,
    bits::{BitIndex, load},
    frame::{CellOffset, Frame},
    placement::SweptCells,
};

/// The cells that a straight segment sweeps, by offsets from its start: [`Placement::sweep`] in all
/// directions.
///
/// Hidden: the pruning rules of `mediant-search` are derived from it. A segment is tested by
/// [`line_of_sight`](crate::sight::line_of_sight).
#[doc(hidden)]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Footprint {
    /// Cells that must all be free, sorted.
    pub free: Vec<CellOffset>,
    /// Pairs of cells of which one must be free.
    pub either: Vec<[CellOffset; 2]>,
}

impl Footprint {
    /// The footprint of a displacement, not (0, 0), under a rule of motion.
    #[must_use]
    pub fn new<P: Placement>(rule: P::Rule, v: Vector) -> Self {
        let (frame, d) = Frame::of(v);
        let mut footprint = Self::default();
        P::sweep(rule, d, |cells| {
            match cells {
                SweptCells::AllFree { row, first, last } => {
                    footprint.free.extend((first..=last).map(|column| frame.offset::<P>((column, row))));
                }
                SweptCells::EitherFree(cells) => {
                    footprint.either.push(cells.map(|cell| frame.offset::<P>(cell)));
                }
            }
            true
        });
        // Not by `sort_unstable`, which would add 4 kB to what a page loads: `BTreeSet` sorts in this way.
        footprint.free.sort();
        footprint
    }

    /// Whether a segment with this footprint obeys the rule, given which cells are free.
    pub(crate) fn is_legal(&self, is_free: impl Fn(CellOffset) -> bool) -> bool {
        let is_free = |&cell: &CellOffset| is_free(cell);
        self.free.iter().all(is_free) && self.either.iter().all(|cells| cells.iter().any(is_free))
    }
}

/// Up to 64 cells of one row of a matrix, by the offset of their bits from that of a vertex's own cell. It
/// holds for all matrices of one width: so testing it takes no multiplication, which is 4 % of the time of A*
/// at k = 7.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct CellMask {
    /// From the bit of a vertex's own cell to the first of the 64.
    offset: i32,
    /// Which of the 64.
    cells: u64,
}

impl CellMask {
    /// Cells of row `across`, the lowest bit that of column `along`, in matrices with so many bits a row.
    ///
    /// The cells that a segment sweeps are contiguous. So if some lie beyond the frame of the matrix, others
    /// lie on the frame, and whatever is read beyond it, the answer is 'blocked'.
    pub(crate) const fn new((along, across): CellOffset, cells: u64, bits_per_row: i32) -> Self {
        Self { offset: across * bits_per_row + along, cells }
    }

    /// The bits that it tests, by their offsets from that of a vertex's own cell.
    #[cfg(test)]
    pub(crate) fn bits(&self) -> impl Iterator<Item = i32> {
        (0..64).filter(|bit| self.cells >> bit & 1 == 1).map(|bit| self.offset + bit)
    }

    /// Whether all cells of the mask are free around the bit `at`.
    #[inline]
    pub(crate) fn is_free(&self, words: &[u64], at: BitIndex) -> bool {
        load(words, at.offset(self.offset)) & self.cells == 0
    }
}
