//! What a move asks of the cells around its start, and sets of cells tested as words.

use mediant_moves::Vector;

use crate::{BitIndex, BitMatrix, Demand, Placement, load, sight::Frame};

/// A cell by its offset from cell (x, y) of a vertex (x, y).
pub type CellOffset = (i32, i32);

/// What a straight segment asks of the map, by offsets from its start: [`Placement::sweep`] in all directions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Footprint {
    /// Cells that must be free, sorted.
    pub free: Vec<CellOffset>,
    /// Pairs of cells of which one must be free.
    pub either: Vec<[CellOffset; 2]>,
}

impl Footprint {
    /// The footprint of a displacement, not (0, 0), under a rule of motion.
    #[must_use]
    pub fn new<P: Placement>(rule: P::Rule, v: Vector) -> Self {
        let (frame, d) = Frame::of(v);
        let cell = |(i, j)| {
            let (along, across) = frame.cell::<P>(i, j);
            if frame.transposed { (across, along) } else { (along, across) }
        };
        let mut footprint = Self::default();
        P::sweep(rule, d, |demand| {
            match demand {
                Demand::Free { row, first, last } => {
                    footprint.free.extend((first..=last).map(|column| cell((column, row))));
                }
                Demand::EitherFree(cells) => footprint.either.push(cells.map(cell)),
            }
            true
        });
        footprint.free.sort_unstable();
        footprint
    }
}

/// Up to 64 cells of one row of a matrix, by their offset from the bit of a vertex's own cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellMask {
    /// Rows down.
    pub across: i32,
    /// Columns to the right, to the first of the 64.
    pub along: i32,
    /// Which of the 64.
    pub cells: u64,
}

impl CellMask {
    /// Masks that hold just these cells, given as (along, across); the nearest rows first.
    ///
    /// What is swept is contiguous, so cells beyond the frame of a matrix come with cells of the frame: whatever is read there, the answer
    /// is 'blocked'.
    #[must_use]
    pub fn cover(cells: impl IntoIterator<Item = CellOffset>) -> Vec<Self> {
        let mut cells: Vec<CellOffset> = cells.into_iter().collect();
        cells.sort_unstable_by_key(|&(along, across)| (across.abs(), across, along));
        let mut masks = Vec::new();
        for mut row in cells.chunk_by(|a, b| a.1 == b.1) {
            while let Some(&(along, across)) = row.first() {
                let here = row.partition_point(|&(other, _)| other < along + 64);
                let cells = row[..here].iter().fold(0, |mask, &(other, _)| mask | 1 << (other - along));
                masks.push(Self { across, along, cells });
                row = &row[here..];
            }
        }
        masks
    }

    /// Whether all cells of the mask are free around the bit `at` of `matrix`.
    #[must_use]
    #[inline]
    pub fn is_free(&self, matrix: &BitMatrix, at: BitIndex) -> bool {
        self.on(matrix).is_free(matrix.words(), at)
    }

    /// The mask for one matrix alone.
    #[inline]
    pub(crate) fn on(&self, matrix: &BitMatrix) -> BitMask {
        BitMask { offset: self.across * matrix.bits_per_row() + self.along, cells: self.cells }
    }
}

/// A [`CellMask`] for matrices of one width: testing it takes no multiplication, which is 4 % of the time of A* at k = 7.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BitMask {
    /// From the bit of a vertex's own cell to the first of the 64.
    offset: i32,
    cells: u64,
}

impl BitMask {
    /// Whether all cells of the mask are free around the bit `at`.
    #[inline]
    pub(crate) fn is_free(&self, words: &[u64], at: BitIndex) -> bool {
        load(words, at.offset(self.offset)) & self.cells == 0
    }
}
