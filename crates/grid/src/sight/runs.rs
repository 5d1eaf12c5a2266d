//! Runs of free cells in a row, read 64 cells at a time.

use crate::{BitMatrix, BitRow};

/// The runs of free cells of a row.
pub trait Runs: Copy {
    /// [`BitRow::is_blocked`].
    fn is_blocked(self, column: i32) -> bool;

    /// [`BitRow::first_blocked`].
    fn first_blocked(self, from: i32, to: i32) -> i32;

    /// [`BitRow::first_free`].
    fn first_free(self, from: i32, to: i32) -> i32;

    /// [`BitRow::run_start`].
    fn run_start(self, end: i32, to: i32) -> i32;
}

/// The row, of those of a map, that a path enters when it leaves horizontal line `line` downwards (`down` =
/// 1) or upwards (−1). Beyond the first and the last line that is a row of the blocked frame.
#[inline]
pub fn row_ahead(rows: &BitMatrix, line: i32, down: i32) -> BitRow<'_> {
    rows.row(line + (down - 1) / 2)
}

impl Runs for BitRow<'_> {
    #[inline]
    fn is_blocked(self, column: i32) -> bool {
        self.is_blocked(column)
    }

    #[inline]
    fn first_blocked(self, from: i32, to: i32) -> i32 {
        self.first_blocked(from, to)
    }

    #[inline]
    fn first_free(self, from: i32, to: i32) -> i32 {
        self.first_free(from, to)
    }

    #[inline]
    fn run_start(self, end: i32, to: i32) -> i32 {
        self.run_start(end, to)
    }
}

/// 64 cells of a row, loaded once. It answers for columns among them only.
#[derive(Clone, Copy, Debug)]
pub struct Window {
    blocked: u64,
    first: i32,
}

impl Window {
    /// The number of columns.
    pub const WIDTH: i32 = 64;

    /// The cells from column `first` on.
    #[inline]
    pub fn new(row: BitRow<'_>, first: i32) -> Self {
        Self { blocked: row.word(first), first }
    }

    /// The cells from a column on, lowest bit first.
    #[inline]
    const fn from(self, column: i32) -> u64 {
        self.blocked >> (column - self.first)
    }
}

impl Runs for Window {
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
