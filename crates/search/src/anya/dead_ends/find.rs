//! Finds the dead ends of a map.

use mediant_grid::{BitMatrix, Corners, DiagonalGap, FreeSpace, Interrupt, Interrupted};

use super::runs::{CellRun, DURING, Kinds, Matrix};

/// The most cells of a dead end. Rooms are made of longer runs: single doors lead to them, so they are parts,
/// and one run opens them. As dead ends they would be opened run by run for each query that ends there; on
/// arena2 that took a third of the instructions of a query.
const LONGEST: i32 = 8;

/// The search for the dead ends of a map.
pub(super) struct DeadEndSearch<M = BitMatrix> {
    pub(super) rows: M,
    pub(super) columns: M,
    pub(super) kinds: Kinds<M>,
    /// Whether paths may pass gaps.
    pub(super) gaps_are_open: bool,
}

impl DeadEndSearch {
    pub(super) fn new(space: &FreeSpace<Corners>) -> Self {
        let grid = space.grid();
        let (rows, columns) = (grid.rows().clone(), grid.columns().clone());
        let empty = BitMatrix::from_words(grid.width(), grid.height(), false, |_, _| 0);
        let kinds = Kinds {
            vertical: empty.clone(),
            vertical_columns: BitMatrix::from_words(grid.height(), grid.width(), false, |_, _| 0),
            beyond: empty,
        };
        let gaps_are_open = space.rule() == DiagonalGap::Open;
        Self { rows, columns, kinds, gaps_are_open }
    }

    /// Blocks dead ends until there are none: those of rows, then those of columns, and again, but only along
    /// lines where something has changed.
    pub(super) fn block_all(&mut self, interrupt: &Interrupt) -> Result<(), Interrupted> {
        let (mut rows, mut columns) =
            (vec![true; self.rows.height() as usize], vec![true; self.columns.height() as usize]);
        loop {
            self.block_along(false, &mut rows, &mut columns, interrupt)?;
            if !columns.contains(&true) {
                return Ok(());
            }
            self.block_along(true, &mut columns, &mut rows, interrupt)?;
        }
    }

    /// Blocks the dead ends along the lines that have changed, and marks the lines across that change by it.
    fn block_along(
        &mut self,
        is_vertical: bool,
        changed: &mut [bool],
        across: &mut [bool],
        interrupt: &Interrupt,
    ) -> Result<(), Interrupted> {
        for (line, changed) in (0..).zip(changed) {
            if !std::mem::take(changed) {
                continue;
            }
            interrupt.check(DURING)?;
            let mut at = 0;
            while let Some(run) = self.run_from(is_vertical, line, at) {
                self.block_chain(run, across, interrupt)?;
                at = run.end;
            }
        }
        Ok(())
    }

    /// Blocks a run if it is a dead end, then the one behind its door if that is one now, and so on.
    fn block_chain(
        &mut self,
        mut run: CellRun,
        across: &mut [bool],
        interrupt: &Interrupt,
    ) -> Result<(), Interrupted> {
        let mut blocked = 0_usize;
        while let Some((side, (first, end))) = self.door(run) {
            blocked += 1;
            interrupt.check_every(1 << 12, blocked, DURING)?;
            self.block(run, side);
            // Across the line only the runs that the door leads to go on.
            across[first as usize..end as usize].fill(true);
            let Some(next) = self.run_at(run.is_vertical, run.line + side, first) else { break };
            run = next;
        }
        Ok(())
    }
}

impl<M: Matrix> DeadEndSearch<M> {
    const fn lines(&self, is_vertical: bool) -> &M {
        if is_vertical { &self.columns } else { &self.rows }
    }

    /// The first run of free cells of a line from `from` on.
    fn run_from(&self, is_vertical: bool, line: i32, from: i32) -> Option<CellRun> {
        let lines = self.lines(is_vertical);
        let (row, (length, _)) = (lines.row(line), lines.size());
        let first = row.first_free(from, length);
        (first < length).then(|| CellRun { is_vertical, line, first, end: row.first_blocked(first, length) })
    }

    /// The run of free cells of a line with the cell `at`; the next one if that cell is blocked.
    pub(super) fn run_at(&self, is_vertical: bool, line: i32, at: i32) -> Option<CellRun> {
        let start = self.lines(is_vertical).row(line).run_start(at, 0);
        self.run_from(is_vertical, line, start)
    }

    /// Blocks a dead end whose door is on one side.
    pub(super) fn block(&mut self, run: CellRun, side: i32) {
        run.set(&mut self.rows, true);
        run.set_across(&mut self.columns, true);
        if run.is_vertical {
            run.set(&mut self.kinds.vertical, true);
            run.set_across(&mut self.kinds.vertical_columns, true);
        }
        if side > 0 {
            run.set(&mut self.kinds.beyond, true);
        }
    }

    /// The door of a dead end: on which side it is, and from where to where; `None` for other runs, and for
    /// those that are too long.
    pub(super) fn door(&self, run: CellRun) -> Option<(i32, (i32, i32))> {
        let CellRun { is_vertical, line, first, end } = run;
        if end - first > LONGEST {
            return None;
        }
        let row = self.lines(is_vertical).row(line);
        let mut door = None;
        for side in [-1, 1] {
            let beside = row.below(side);
            let start = beside.first_free(first, end);
            if start == end {
                continue;
            }
            let stop = beside.first_blocked(start, end);
            if door.is_some() || beside.first_free(stop, end) < end {
                return None;
            }
            door = Some((side, (start, stop)));
        }
        let gap = |outer: i32, inner: i32| {
            let is_gap = |side| row.below(side).is_blocked(inner) && !row.below(side).is_blocked(outer);
            is_gap(-1) || is_gap(1)
        };
        door.filter(|_| !self.gaps_are_open || !gap(first - 1, first) && !gap(end, end - 1))
    }
}
