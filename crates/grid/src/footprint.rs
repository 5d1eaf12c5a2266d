//! The cells that a move sweeps, by their offsets from its start, and sets of cells that are tested as words.

use mediant_moves::Vector;

use crate::{
    BitMatrix, Placement,
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
        sort_cells(&mut footprint.free);
        footprint
    }

    /// Whether a segment with this footprint obeys the rule, given which cells are free.
    pub(crate) fn is_legal(&self, is_free: impl Fn(CellOffset) -> bool) -> bool {
        let is_free = |&cell: &CellOffset| is_free(cell);
        self.free.iter().all(is_free) && self.either.iter().all(|cells| cells.iter().any(is_free))
    }
}

/// Sorts cells. `BTreeSet` sorts them in the same way when it is built, so the code for it is there already;
/// `sort_unstable` would add 4 kB to what a page loads.
pub(crate) fn sort_cells(cells: &mut [CellOffset]) {
    cells.sort();
}

/// Up to 64 cells of one row of a matrix, by the offset of their bits from that of a vertex's own cell. It
/// holds for all matrices of one width: so testing it takes no multiplication, which is 4 % of the time of A*
/// at k = 7.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CellMask {
    /// From the bit of a vertex's own cell to the first of the 64.
    offset: i32,
    /// Which of the 64.
    cells: u64,
}

impl CellMask {
    /// The mask of one cell, given as (along, across).
    pub(crate) const fn cell((along, across): CellOffset, matrix: &BitMatrix) -> Self {
        Self { offset: across * matrix.bits_per_row() + along, cells: 1 }
    }

    /// Masks that hold just these cells, given as (along, across); the nearest rows first.
    ///
    /// The cells that a segment sweeps are contiguous. So if some lie beyond the frame of the matrix, others
    /// lie on the frame, and whatever is read beyond it, the answer is 'blocked'.
    pub(crate) fn holding(mut cells: Vec<CellOffset>, matrix: &BitMatrix) -> Vec<Self> {
        cells.sort_unstable_by_key(|&(along, across)| (across.abs(), across, along));
        let mut masks = Vec::new();
        for mut row in cells.chunk_by(|a, b| a.1 == b.1) {
            while let Some(&first) = row.first() {
                let here = row.partition_point(|&(along, _)| along < first.0 + 64);
                let cells = row[..here].iter().fold(0, |mask, &(along, _)| mask | 1 << (along - first.0));
                masks.push(Self { cells, ..Self::cell(first, matrix) });
                row = &row[here..];
            }
        }
        masks
    }

    /// Whether all cells of the mask are free around the bit `at`.
    #[inline]
    pub(crate) fn is_free(&self, words: &[u64], at: BitIndex) -> bool {
        load(words, at.offset(self.offset)) & self.cells == 0
    }
}
