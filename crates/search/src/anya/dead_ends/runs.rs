//! Runs of cells that are dead ends.

use mediant_grid::BitMatrix;

/// The stage that an interrupted call names.
pub(super) const DURING: &str = "finding dead ends";

/// The kind of run of each cell of a dead end, a bit each.
#[derive(Clone, Debug)]
pub(super) struct Kinds {
    /// Whether the run is part of a column, in rows.
    pub(super) vertical: BitMatrix,
    /// The same in columns.
    pub(super) vertical_columns: BitMatrix,
    /// Whether its door is below it, or to the right.
    pub(super) beyond: BitMatrix,
}

/// A run of cells of a row, or of a column.
#[derive(Clone, Copy, Debug)]
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

    /// Sets its bits in rows of the map.
    pub(super) fn set(self, rows: &mut BitMatrix, value: bool) {
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
    pub(super) fn set_across(self, lines: &mut BitMatrix, value: bool) {
        Self { is_vertical: !self.is_vertical, ..self }.set(lines, value);
    }
}
