//! What is open for a query.

use std::sync::Arc;

use mediant_grid::{BitMatrix, Grid, Vertex};

use super::{DeadEnds, Run, parts::Part};

/// A map without its dead ends, but with those that the query needs: the scratch memory of a planner.
#[derive(Clone, Debug)]
pub(in super::super) struct Opened {
    dead_ends: Arc<DeadEnds>,
    /// The rows of the map as far as the query needs it.
    rows: BitMatrix,
    /// The dead ends that are open for the query, and the bridges that are open for it.
    open: Vec<Run>,
    /// The run that shuts the bridge of the uppermost part for the query.
    shut: Option<Run>,
    /// The parts that the query needs, which are not open yet.
    needed: Vec<u32>,
}

impl Opened {
    /// All dead ends of the map, and all parts but part 0, are closed.
    pub(in super::super) fn new(dead_ends: Arc<DeadEnds>) -> Self {
        let mut rows = dead_ends.rows.clone();
        dead_ends.parts.all().iter().for_each(|part| part.inner.set(&mut rows, true));
        Self { dead_ends, rows, open: Vec::new(), shut: None, needed: Vec::new() }
    }

    /// The rows of the map without what is closed.
    pub(in super::super) const fn rows(&self) -> &BitMatrix {
        &self.rows
    }

    /// Opens the dead ends that paths between two vertices may need, and closes all others.
    pub(in super::super) fn open(&mut self, grid: &Grid, ends: [Vertex; 2]) {
        if let Some(run) = self.shut.take() {
            run.set(&mut self.rows, false);
        }
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
        self.open_bridges();
    }

    /// Opens the bridges between the parts that are needed, and shuts the one from the uppermost of them to
    /// its parent.
    fn open_bridges(&mut self) {
        self.needed.sort_unstable();
        self.needed.dedup();
        // Parents have smaller numbers.
        while let Some(number) = self.needed.pop()
            && number != 0
        {
            let Part { parent, inner, outer } = self.dead_ends.parts.part(number);
            inner.set(&mut self.rows, false);
            self.open.push(inner);
            if self.needed.is_empty() {
                if !self.rows.row(outer.line).is_blocked(outer.first) {
                    outer.set(&mut self.rows, true);
                    self.shut = Some(outer);
                }
            } else if let Err(at) = self.needed.binary_search(&parent) {
                self.needed.insert(at, parent);
            }
        }
        self.needed.clear();
    }

    /// Opens the dead end of a cell, if it is part of one that is closed; if it is of none, its part is
    /// needed.
    fn open_at(&mut self, grid: &Grid, x: i32, y: i32) {
        if grid.is_blocked(x, y) {
            return;
        }
        let vertical = self.dead_ends.kinds.vertical.row(y);
        let is_closed = self.rows.row(y).is_blocked(x);
        let run = if vertical.is_blocked(x) {
            if !is_closed {
                return;
            }
            self.vertical_run(x, y)
        } else {
            let part = self.dead_ends.parts.of(x, y);
            if part != 0 || !is_closed {
                self.need(part, (x, y));
                return;
            }
            let free = grid.rows().row(y);
            let first = free.run_start(x, vertical.run_start(x, 0));
            let end = free.first_blocked(x, vertical.first_blocked(x, grid.width() as i32));
            Run { is_vertical: false, line: y, first, end }
        };
        run.set(&mut self.rows, false);
        self.open.push(run);
    }

    /// Notes that the part of a cell is needed. Part 0 counts as that of open dead ends, which have none.
    fn need(&mut self, part: u32, (x, y): (i32, i32)) {
        let is_noted = self.needed.contains(&part);
        let holds = |run: &Run| !run.is_vertical && run.line == y && run.first <= x && x < run.end;
        if !is_noted && (part != 0 || !self.open.iter().any(holds)) {
            self.needed.push(part);
        }
    }

    /// The dead end of a column that a cell is part of.
    fn vertical_run(&self, x: i32, y: i32) -> Run {
        let column = self.dead_ends.kinds.vertical_columns.row(x);
        let mut first = y;
        while first > 0 {
            let ones = column.word(first - 64).leading_ones() as i32;
            first -= ones;
            if ones < 64 {
                break;
            }
        }
        Run { is_vertical: true, line: x, first, end: column.first_free(y, self.rows.height() as i32) }
    }

    /// Opens the closed dead ends on the side of a run where its door is. Those that have their own door
    /// there are not needed, but two bits do not tell.
    fn open_behind_door(&mut self, grid: &Grid, run: Run) {
        let Run { is_vertical, line, first, end } = run;
        let (x, y) = if is_vertical { (line, first) } else { (first, line) };
        let beside = line + if self.dead_ends.kinds.beyond.row(y).is_blocked(x) { 1 } else { -1 };
        if is_vertical {
            self.open_in_column(grid, beside, (first, end));
            return;
        }
        let free = grid.rows().row(beside);
        let mut x = free.first_free(first, end);
        while x < end {
            let is_vertical = self.dead_ends.kinds.vertical.row(beside).is_blocked(x);
            self.open_at(grid, x, beside);
            // The rest of its run is opened with it, or in the same part.
            let next = if is_vertical {
                x + 1
            } else {
                self.dead_ends.kinds.vertical.row(beside).first_blocked(x, end)
            };
            x = free.first_free(next.min(free.first_blocked(x, end).max(x + 1)), end);
        }
    }

    /// Opens the closed dead ends at some cells of a column.
    fn open_in_column(&mut self, grid: &Grid, x: i32, (first, end): (i32, i32)) {
        let free = grid.columns().row(x);
        let mut y = free.first_free(first, end);
        while y < end {
            self.open_at(grid, x, y);
            y = free
                .first_free(self.dead_ends.kinds.vertical_columns.row(x).first_free(y, end).max(y + 1), end);
        }
    }
}
