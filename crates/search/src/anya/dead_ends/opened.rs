//! The dead ends and parts that are open for a query.

use std::sync::Arc;

use mediant_grid::{BitMatrix, Grid, Vertex};

use super::{
    DeadEnds,
    parts::{Part, Parts},
    runs::CellRun,
};

/// A map without its dead ends, but with those that the query needs: the scratch memory of a planner.
#[derive(Clone, Debug)]
pub(in super::super) struct Opened {
    dead_ends: Arc<DeadEnds>,
    /// The rows of the map as far as the query needs it.
    rows: BitMatrix,
    /// The dead ends that are open for the query.
    open: Vec<CellRun>,
    of_rows: OpenParts,
    of_columns: OpenParts,
}

/// The parts of a map that are open for a query: those of its rows, or those of its columns.
#[derive(Clone, Debug)]
struct OpenParts {
    /// The rows of the map without the runs that shut bridges.
    rows: BitMatrix,
    /// The runs that open or shut a bridge for the query, and whether they were blocked before.
    bridges: Vec<(CellRun, bool)>,
    /// The parts that the query needs, which are not open yet.
    needed: Vec<u32>,
}

impl Opened {
    /// All dead ends of the map, and all parts but part 0, are closed.
    pub(in super::super) fn new(dead_ends: Arc<DeadEnds>) -> Self {
        let mut rows = dead_ends.rows.clone();
        let [of_rows, of_columns] = dead_ends.parts.each_ref().map(|parts| {
            parts.shut(&mut rows);
            let mut rows = dead_ends.rows.clone();
            parts.shut(&mut rows);
            OpenParts { rows, bridges: Vec::new(), needed: Vec::new() }
        });
        Self { dead_ends, rows, open: Vec::new(), of_rows, of_columns }
    }

    /// Continues with other dead ends, and keeps the memory if their map has the same size.
    pub(in super::super) fn follow(&mut self, dead_ends: Arc<DeadEnds>) {
        // The next query closes what is open.
        if Arc::ptr_eq(&self.dead_ends, &dead_ends) {
            return;
        }
        let Self { rows, open, of_rows, of_columns, .. } = self;
        open.clear();
        rows.clone_from(&dead_ends.rows);
        for (opened, parts) in [of_rows, of_columns].into_iter().zip(&dead_ends.parts) {
            parts.shut(rows);
            opened.rows.clone_from(&dead_ends.rows);
            parts.shut(&mut opened.rows);
            opened.bridges.clear();
        }
        self.dead_ends = dead_ends;
    }

    /// The rows of the map without what is closed.
    pub(in super::super) const fn rows(&self) -> &BitMatrix {
        &self.rows
    }

    /// Opens the dead ends that paths between two vertices may need, and closes all others.
    pub(in super::super) fn open(&mut self, grid: &Grid, ends: [Vertex; 2]) {
        self.of_rows.restore(&self.of_columns.rows, &mut self.rows);
        self.of_columns.restore(&self.of_rows.rows, &mut self.rows);
        for run in self.open.drain(..) {
            run.set(&mut self.rows, true);
        }
        for Vertex { x, y } in ends {
            for (x, y) in [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)] {
                self.open_at(grid, x, y);
            }
        }
        let mut opened = 0;
        while let Some(&run) = self.open.get(opened) {
            self.open_behind_door(grid, run);
            opened += 1;
        }
        let [of_rows, of_columns] = &self.dead_ends.parts;
        self.of_rows.open(of_rows, &self.of_columns.rows, &mut self.rows);
        self.of_columns.open(of_columns, &self.of_rows.rows, &mut self.rows);
    }

    /// Opens the dead end of a cell, if it is part of one that is closed; if it is of none, its part is
    /// needed.
    fn open_at(&mut self, grid: &Grid, x: i32, y: i32) {
        if !self.dead_ends.rows.row(y).is_blocked(x) {
            let [of_rows, of_columns] = &self.dead_ends.parts;
            self.of_rows.need(of_rows.of(x, y));
            self.of_columns.need(of_columns.of(y, x));
        } else if grid.is_free(x, y) && self.rows.row(y).is_blocked(x) {
            let run = if self.dead_ends.kinds.vertical.row(y).is_blocked(x) {
                self.vertical_run(x, y)
            } else {
                self.horizontal_run(grid, x, y)
            };
            run.set(&mut self.rows, false);
            self.open.push(run);
        }
    }

    /// The dead end of a row that a cell is part of.
    fn horizontal_run(&self, grid: &Grid, x: i32, y: i32) -> CellRun {
        let (free, vertical) = (grid.rows().row(y), self.dead_ends.kinds.vertical.row(y));
        let first = free.run_start(x, vertical.run_start(x, 0));
        let end = free.first_blocked(x, vertical.first_blocked(x, grid.width() as i32));
        CellRun { is_vertical: false, line: y, first, end }
    }

    /// The dead end of a column that a cell is part of.
    fn vertical_run(&self, x: i32, y: i32) -> CellRun {
        let column = self.dead_ends.kinds.vertical_columns.row(x);
        let first = column.blocked_start(y, 0);
        CellRun { is_vertical: true, line: x, first, end: column.first_free(y, self.rows.height() as i32) }
    }

    /// Opens the closed dead ends on the side of a run where its door is. Dead ends with a door of their own
    /// there are not needed, but two bits do not tell.
    fn open_behind_door(&mut self, grid: &Grid, run: CellRun) {
        let CellRun { is_vertical, line, first, end } = run;
        let (x, y) = run.first_cell();
        let beside = line + if self.dead_ends.kinds.beyond.row(y).is_blocked(x) { 1 } else { -1 };
        if is_vertical {
            self.open_in_column(grid, beside, (first, end));
        } else {
            self.open_in_row(grid, beside, (first, end));
        }
    }

    /// Opens the closed dead ends at some cells of a row, and notes the parts of others.
    fn open_in_row(&mut self, grid: &Grid, y: i32, (first, end): (i32, i32)) {
        let free = grid.rows().row(y);
        let mut x = free.first_free(first, end);
        while x < end {
            self.open_at(grid, x, y);
            let DeadEnds { rows, kinds, parts, .. } = &*self.dead_ends;
            let next = if !rows.row(y).is_blocked(x) {
                let next = rows.row(y).first_blocked(x, end);
                parts[1].for_each_across(y, (x, next), |part| self.of_columns.need(part));
                next
            } else if kinds.vertical.row(y).is_blocked(x) {
                x + 1
            } else {
                free.first_blocked(x, kinds.vertical.row(y).first_blocked(x, end))
            };
            x = free.first_free(next, end);
        }
    }

    /// Opens the closed dead ends at some cells of a column, and notes the parts of others.
    fn open_in_column(&mut self, grid: &Grid, x: i32, (first, end): (i32, i32)) {
        let free = grid.columns().row(x);
        let mut y = free.first_free(first, end);
        while y < end {
            let DeadEnds { columns, kinds, parts, .. } = &*self.dead_ends;
            let next = if columns.row(x).is_blocked(y) {
                let next = kinds.vertical_columns.row(x).first_free(y, end).max(y + 1);
                self.open_at(grid, x, y);
                next
            } else {
                let next = columns.row(x).first_blocked(y, end);
                self.of_columns.need(parts[1].of(y, x));
                parts[0].for_each_across(x, (y, next), |part| self.of_rows.need(part));
                next
            };
            y = free.first_free(next, end);
        }
    }
}

impl OpenParts {
    /// Notes that a part is needed.
    fn need(&mut self, part: u32) {
        if !self.needed.contains(&part) {
            self.needed.push(part);
        }
    }

    /// Opens the bridges between the parts that are needed, and shuts the one from the uppermost of them to
    /// its parent. `both` are the rows that are free here and in the `other` rows.
    fn open(&mut self, parts: &Parts, other: &BitMatrix, both: &mut BitMatrix) {
        self.needed.sort_unstable();
        // Parents have smaller numbers.
        while let Some(number) = self.needed.pop()
            && number != 0
        {
            let Part { parent, inner, outer } = parts.part(number);
            self.set(inner, false, other, both);
            if self.needed.is_empty() {
                let (x, y) = outer.first_cell();
                if !self.rows.row(y).is_blocked(x) {
                    self.set(outer, true, other, both);
                }
            } else if let Err(at) = self.needed.binary_search(&parent) {
                self.needed.insert(at, parent);
            }
        }
        self.needed.clear();
    }

    fn set(&mut self, run: CellRun, value: bool, other: &BitMatrix, both: &mut BitMatrix) {
        run.set_in(&mut self.rows, other, both, value);
        self.bridges.push((run, !value));
    }

    /// Makes all bridges what they were before the query.
    fn restore(&mut self, other: &BitMatrix, both: &mut BitMatrix) {
        for (run, before) in self.bridges.drain(..) {
            run.set_in(&mut self.rows, other, both, before);
        }
    }
}
