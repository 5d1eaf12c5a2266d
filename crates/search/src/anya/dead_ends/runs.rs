//! Runs of cells that are dead ends.

use mediant_grid::{BitMatrix, BitRow, MatrixEdit};

/// The stage that an interrupted call names.
pub(super) const DURING: &str = "finding dead ends";

/// A matrix that is found, or the next version of one that is repaired.
pub(super) trait Matrix {
    fn size(&self) -> (i32, i32);
    fn row(&self, y: i32) -> BitRow<'_>;
    fn set_run(&mut self, y: i32, first: i32, end: i32, value: bool);
    fn set_run_of_column(&mut self, x: i32, first: i32, end: i32, value: bool);
}

macro_rules! matrix {
    ($($matrix:ident)*) => {
        $(impl Matrix for $matrix {
            fn size(&self) -> (i32, i32) {
                (self.width() as i32, self.height() as i32)
            }

            #[inline]
            fn row(&self, y: i32) -> BitRow<'_> {
                $matrix::row(self, y)
            }

            fn set_run(&mut self, y: i32, first: i32, end: i32, value: bool) {
                $matrix::set_run(self, y, first, end, value);
            }

            fn set_run_of_column(&mut self, x: i32, first: i32, end: i32, value: bool) {
                $matrix::set_run_of_column(self, x, first, end, value);
            }
        })*
    };
}

matrix! { BitMatrix MatrixEdit }

/// The kind of run of each cell of a dead end, a bit each.
#[derive(Clone, Debug)]
pub(super) struct Kinds<M = BitMatrix> {
    /// Whether the run is part of a column, in rows.
    pub(super) vertical: M,
    /// The same in columns.
    pub(super) vertical_columns: M,
    /// Whether its door is below it, or to the right.
    pub(super) beyond: M,
}

/// A run of cells of a row, or of a column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct CellRun {
    pub(super) is_vertical: bool,
    /// Its row or column.
    pub(super) line: i32,
    pub(super) first: i32,
    pub(super) end: i32,
}

impl CellRun {
    pub(super) const fn first_cell(self) -> (i32, i32) {
        if self.is_vertical { (self.line, self.first) } else { (self.first, self.line) }
    }

    /// Whether it begins at a place of a line.
    pub(super) const fn is_at(self, line: i32, first: i32) -> bool {
        self.line == line && self.first == first && self.first < self.end
    }

    /// Its cells.
    pub(super) fn cells(self) -> impl Iterator<Item = (i32, i32)> {
        let Self { is_vertical, line, first, end } = self;
        (first..end).map(move |at| if is_vertical { (line, at) } else { (at, line) })
    }

    /// Sets its bits in rows of the map.
    pub(super) fn set(self, rows: &mut impl Matrix, value: bool) {
        let Self { is_vertical, line, first, end } = self;
        if is_vertical {
            rows.set_run_of_column(line, first, end, value);
        } else {
            rows.set_run(line, first, end, value);
        }
    }

    /// Sets its bits in rows of the map, and in the rows that are blocked there or in others.
    pub(super) fn set_in(self, rows: &mut BitMatrix, other: &BitMatrix, both: &mut BitMatrix, value: bool) {
        let Self { is_vertical, line, first, end } = self;
        rows.set_run_in_union((other, both), (is_vertical, line), (first, end), value);
    }

    /// Sets its bits, where what is a row here is a column there.
    pub(super) fn set_across(self, lines: &mut impl Matrix, value: bool) {
        Self { is_vertical: !self.is_vertical, ..self }.set(lines, value);
    }
}
