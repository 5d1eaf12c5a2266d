//! A row of cells, read by words of 64.

use mediant_grid::{BitIndex, Grid, load};

/// Runs of free and blocked cells of a row. Every scan ends at the frame of the map at the latest.
pub(super) trait Row: Copy {
    /// Whether the cell is blocked.
    fn is_blocked(self, column: i32) -> bool;

    /// The first blocked column from `from` on; `to` if there is none before it.
    fn first_blocked(self, from: i32, to: i32) -> i32;

    /// The first free column from `from` on; `to` if there is none before it.
    fn first_free(self, from: i32, to: i32) -> i32;

    /// The first column of the run of free cells that ends before column `end`, as far as it reaches back to `to`.
    fn run_start(self, end: i32, to: i32) -> i32;
}

/// The row of cells between two neighboring horizontal lines.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip<'g> {
    words: &'g [u64],
    /// The bit of column 0.
    origin: BitIndex,
    bits_per_row: i32,
}

impl<'g> Strip<'g> {
    /// The row of cells that a path enters when it leaves horizontal line `line` downwards (`down` = 1) or upwards (−1). There is
    /// one beyond the last lines, too: it is blocked.
    #[inline]
    pub(super) fn ahead(grid: &'g Grid, line: i32, down: i32) -> Self {
        let rows = grid.rows();
        let origin = rows.index(0, line + (down - 1) / 2);
        Self { words: rows.words(), origin, bits_per_row: rows.bits_per_row() }
    }

    /// The next row downwards or upwards.
    #[inline]
    pub(super) const fn next(self, down: i32) -> Self {
        Self { origin: self.origin.offset(self.bits_per_row * down), ..self }
    }

    /// Which of the 64 cells from column `first` on are blocked, the first one's the lowest bit.
    #[inline]
    pub(super) fn word(self, first: i32) -> u64 {
        load(self.words, self.origin.offset(first))
    }
}

impl Row for Strip<'_> {
    #[inline]
    fn is_blocked(self, column: i32) -> bool {
        let BitIndex(at) = self.origin.offset(column);
        self.words.get(at as usize / 64).is_none_or(|word| word >> (at % 64) & 1 == 1)
    }

    #[inline]
    fn first_blocked(self, mut from: i32, to: i32) -> i32 {
        while from < to {
            let blocked = self.word(from);
            if blocked != 0 {
                return to.min(from + blocked.trailing_zeros() as i32);
            }
            from += 64;
        }
        to
    }

    #[inline]
    fn first_free(self, mut from: i32, to: i32) -> i32 {
        while from < to {
            let free = !self.word(from);
            if free != 0 {
                return to.min(from + free.trailing_zeros() as i32);
            }
            from += 64;
        }
        to
    }

    #[inline]
    fn run_start(self, mut end: i32, to: i32) -> i32 {
        while end > to {
            let blocked = self.word(end - 64);
            if blocked != 0 {
                return to.max(end - blocked.leading_zeros() as i32);
            }
            end -= 64;
        }
        to
    }
}

/// 64 cells of a row, loaded once. Only columns among them may be asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    blocked: u64,
    first: i32,
}

impl Window {
    pub(super) const WIDTH: i32 = 64;

    /// The cells from column `first` on.
    #[inline]
    pub(super) fn new(strip: Strip<'_>, first: i32) -> Self {
        Self { blocked: strip.word(first), first }
    }

    /// The cells from a column on, that first.
    #[inline]
    const fn from(self, column: i32) -> u64 {
        self.blocked >> (column - self.first)
    }
}

impl Row for Window {
    #[inline]
    fn is_blocked(self, column: i32) -> bool {
        self.from(column) & 1 == 1
    }

    #[inline]
    fn first_blocked(self, from: i32, to: i32) -> i32 {
        to.min(from + self.from(from).trailing_zeros() as i32)
    }

    #[inline]
    fn first_free(self, from: i32, to: i32) -> i32 {
        to.min(from + self.from(from).trailing_ones() as i32)
    }

    #[inline]
    fn run_start(self, end: i32, to: i32) -> i32 {
        // The two-step shift keeps a shift of 64 out.
        let before = self.blocked << 1 << (63 - (end - self.first));
        to.max(end - before.leading_zeros() as i32)
    }
}
