//! The dead ends and parts that are open for a query.

use std::sync::Arc;

use mediant_grid::{BitMatrix, Grid, sight::Place};

use super::{
    DeadEnds,
    parts::{Link, Part, Parts},
    repair::Repair,
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

    /// Goes on with other dead ends: by work that follows their difference if these have been repaired to
    /// those by a few repairs, else by a copy. It keeps the memory if their map has the same size.
    pub(in super::super) fn follow(&mut self, dead_ends: Arc<DeadEnds>) {
        // The next query closes what is open.
        if Arc::ptr_eq(&self.dead_ends, &dead_ends) {
            return;
        }
        self.close();
        match dead_ends.repairs_since(&self.dead_ends) {
            Some(repairs) => self.follow_repairs(repairs),
            None => self.copy(&dead_ends),
        }
        self.dead_ends = dead_ends;
    }

    fn copy(&mut self, dead_ends: &DeadEnds) {
        let Self { rows, of_rows, of_columns, .. } = self;
        rows.clone_from(&dead_ends.rows);
        for (opened, parts) in [of_rows, of_columns].into_iter().zip(&dead_ends.parts) {
            parts.shut(rows);
            opened.rows.clone_from(&dead_ends.rows);
            parts.shut(&mut opened.rows);
        }
    }

    fn follow_repairs(&mut self, repairs: &[Arc<Repair>]) {
        let Self { rows, of_rows, of_columns, .. } = self;
        for Repair { cells, bridges: [in_rows, in_columns] } in repairs.iter().map(Arc::as_ref) {
            of_rows.set_all(in_rows.iter().map(|&[before, _]| before), false, &of_columns.rows, rows);
            of_columns.set_all(in_columns.iter().map(|&[before, _]| before), false, &of_rows.rows, rows);
            for &(x, y, is_blocked) in cells {
                let (x, y) = (i32::from(x), i32::from(y));
                for rows in [&mut *rows, &mut of_rows.rows, &mut of_columns.rows] {
                    rows.set_run(y, x, x + 1, is_blocked);
                }
            }
            of_rows.set_all(in_rows.iter().map(|&[_, after]| after), true, &of_columns.rows, rows);
            of_columns.set_all(in_columns.iter().map(|&[_, after]| after), true, &of_rows.rows, rows);
        }
    }

    /// Whether the same is open.
    #[cfg(test)]
    pub(super) fn is_same(&self, other: &Self) -> bool {
        let rows =
            |opened: &Self| [&opened.rows, &opened.of_rows.rows, &opened.of_columns.rows].map(Clone::clone);
        rows(self) == rows(other)
    }

    /// Closes what is open.
    fn close(&mut self) {
        self.of_rows.restore(&self.of_columns.rows, &mut self.rows);
        self.of_columns.restore(&self.of_rows.rows, &mut self.rows);
        for run in self.open.drain(..) {
            run.set(&mut self.rows, true);
        }
    }

    /// The rows of the map without what is closed.
    pub(in super::super) const fn rows(&self) -> &BitMatrix {
        &self.rows
    }

    /// Opens the dead ends that paths between two places may need, and closes all others.
    pub(in super::super) fn open(&mut self, grid: &Grid, ends: [Place; 2]) {
        self.close();
        for end in ends {
            let ((left, right), (above, below)) = (end.columns(), end.lines());
            // The cells that it touches: of a vertex four.
            for (x, y) in [(right - 1, below - 1), (left, below - 1), (right - 1, above), (left, above)] {
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
            let run = self.dead_ends.run_of(grid, x, y);
            run.set(&mut self.rows, false);
            self.open.push(run);
        }
    }

    /// Opens the closed dead ends on the side of a run where its door is. Dead ends with a door of their own
    /// there are not needed, but two bits do not tell.
    fn open_behind_door(&mut self, grid: &Grid, run: CellRun) {
        let CellRun { is_vertical, first, end, .. } = run;
        let beside = self.dead_ends.line_behind_door(run);
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
            let Part { parent, link, inner, outer } = parts.part(number);
            self.set(inner, false, other, both);
            if self.needed.is_empty() && link != Link::Joined {
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

    /// Shuts bridges, or opens them, for all queries.
    fn set_all(
        &mut self,
        runs: impl Iterator<Item = CellRun>,
        value: bool,
        other: &BitMatrix,
        both: &mut BitMatrix,
    ) {
        runs.for_each(|run| run.set_in(&mut self.rows, other, both, value));
    }

    /// Makes all bridges what they were before the query.
    fn restore(&mut self, other: &BitMatrix, both: &mut BitMatrix) {
        for (run, before) in self.bridges.drain(..) {
            run.set_in(&mut self.rows, other, both, before);
        }
    }
}
