//! Repairs the dead ends of a map by work that follows the edit.

use std::sync::Arc;

use mediant_grid::{Change, Corners, DiagonalGap, FreeSpace, Grid, Interrupt, Interrupted, MatrixEdit};

use super::{
    DeadEnds,
    find::DeadEndSearch,
    repair_parts::LineChange,
    runs::{CellRun, DURING, Kinds},
};

/// One cell of so many may change in a repair. If more do, finding all anew is about as quick.
const MANY: usize = 32;
/// The repairs that are kept for planners which follow.
const KEPT: usize = 8;

/// The changes of a repair, for planners that follow.
#[derive(Debug, Default)]
pub(super) struct Repair {
    /// The cells of rows without dead ends that are blocked now, or are no more.
    pub(super) cells: Box<[(u16, u16, bool)]>,
    /// The runs that shut bridges between parts of rows, and those of columns: each before and after.
    pub(super) bridges: [Box<[[CellRun; 2]]>; 2],
}

impl DeadEnds {
    /// The dead ends of a space after a change, by work that follows the change. They may leave out less than
    /// those that are [found](Self::new) anew, but paths cost the same. After the change of another map, or
    /// of many cells, they are found anew.
    ///
    /// # Errors
    /// [`Interrupted`].
    pub fn repaired(
        &self,
        space: &FreeSpace<Corners>,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let (before, after) = (change.before(), change.after());
        let is_of_these = self.identity.map == Some(before.id())
            && self.identity.rules == space.identity().rules
            && space.grid().id() == after.id();
        let limit = before.width() as usize * before.height() as usize / MANY + 64;
        let changed = if is_of_these { changed_cells(change, limit) } else { None };
        let Some(changed) = changed else { return Self::interruptible(space, interrupt) };
        let mut repair = DeadEndRepair::new(self, before, space);
        repair.open_around(&changed, interrupt)?;
        repair.set(&changed, after);
        repair.block_around(&changed, interrupt)?;
        repair.finish(space, interrupt)
    }

    /// The repairs by which others have become these; `None` if there were too many, or others.
    pub(super) fn repairs_since(&self, others: &Self) -> Option<&[Arc<Repair>]> {
        let last = others.repairs.last()?;
        let at = self.repairs.iter().rposition(|repair| Arc::ptr_eq(repair, last))?;
        Some(&self.repairs[at + 1..])
    }
}

/// The cells of a change that are not what they were, by row and column; `None` if they are more than some.
fn changed_cells(change: &Change, limit: usize) -> Option<Vec<(i32, i32)>> {
    let mut changed = Vec::new();
    for at in change.cells() {
        for y in at.y as i32..(at.y + at.height) as i32 {
            let [before, after] = [change.before(), change.after()].map(|grid| grid.rows().row(y));
            // Each lies in one block of 64 × 64 cells.
            let mut bits = before.word(at.x as i32) ^ after.word(at.x as i32);
            bits &= !0 >> (64 - at.width.clamp(1, 64));
            while bits != 0 {
                changed.push((y, at.x as i32 + bits.trailing_zeros() as i32));
                bits &= bits - 1;
            }
        }
        if changed.len() > limit {
            return None;
        }
    }
    changed.sort_unstable();
    changed.dedup();
    Some(changed)
}

/// The cells around one, itself included, that are on the map: of each the row and the column.
fn around((y, x): (i32, i32), grid: &Grid) -> impl Iterator<Item = (i32, i32)> + use<> {
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    let rows = 0.max(y - 1)..height.min(y + 2);
    rows.flat_map(move |y| (0.max(x - 1)..width.min(x + 2)).map(move |x| (y, x)))
}

/// A repair under way.
struct DeadEndRepair<'d> {
    old: &'d DeadEnds,
    before: &'d Grid,
    search: DeadEndSearch<MatrixEdit>,
    /// The dead ends that are open again.
    open: Vec<CellRun>,
    /// The cells that may not be what they were, by row and column.
    touched: Vec<(i32, i32)>,
}

impl<'d> DeadEndRepair<'d> {
    fn new(old: &'d DeadEnds, before: &'d Grid, space: &FreeSpace<Corners>) -> Self {
        let Kinds { vertical, vertical_columns, beyond } = &old.kinds;
        let kinds = Kinds {
            vertical: vertical.edit(),
            vertical_columns: vertical_columns.edit(),
            beyond: beyond.edit(),
        };
        let (rows, columns) = (old.rows.edit(), old.columns.edit());
        let gaps_are_open = space.rule() == DiagonalGap::Open;
        let search = DeadEndSearch { rows, columns, kinds, gaps_are_open };
        Self { old, before, search, open: Vec::new(), touched: Vec::new() }
    }

    /// Opens the dead ends that touch cells, all that are behind their doors, and so on.
    fn open_around(&mut self, changed: &[(i32, i32)], interrupt: &Interrupt) -> Result<(), Interrupted> {
        for &cell in changed {
            around(cell, self.before).for_each(|cell| self.open_at(cell));
        }
        let mut opened = 0;
        while let Some(&run) = self.open.get(opened) {
            opened += 1;
            interrupt.check_every(1 << 12, opened, DURING)?;
            let beside = CellRun { line: self.old.line_behind_door(run), ..run };
            beside.cells().for_each(|(x, y)| self.open_at((y, x)));
        }
        Ok(())
    }

    /// Opens the dead end of a cell, if it is part of one that is closed.
    fn open_at(&mut self, (y, x): (i32, i32)) {
        let DeadEndSearch { rows, columns, kinds, .. } = &mut self.search;
        let is_closed = rows.row(y).is_blocked(x) && self.before.is_free(x, y);
        if !is_closed {
            return;
        }
        let run = self.old.run_of(self.before, x, y);
        for rows in [rows, &mut kinds.vertical, &mut kinds.beyond] {
            run.set(rows, false);
        }
        for columns in [columns, &mut kinds.vertical_columns] {
            run.set_across(columns, false);
        }
        self.open.push(run);
        self.touched.extend(run.cells().map(|(x, y)| (y, x)));
    }

    /// Gives changed cells their values after the change.
    fn set(&mut self, changed: &[(i32, i32)], after: &Grid) {
        for &(y, x) in changed {
            let is_blocked = after.is_blocked(x, y);
            self.search.rows.set_run(y, x, x + 1, is_blocked);
            self.search.columns.set_run(x, y, y + 1, is_blocked);
        }
        self.touched.extend(changed);
    }

    /// Blocks the dead ends around changed cells, and where some were opened.
    fn block_around(&mut self, changed: &[(i32, i32)], interrupt: &Interrupt) -> Result<(), Interrupted> {
        // Cells, each with the direction of the run that may be a dead end.
        let mut cells: Vec<(bool, i32, i32)> = Vec::new();
        for &CellRun { is_vertical, line, first, end } in &self.open {
            cells.extend((first..end).map(|at| (!is_vertical, at, line)));
            cells.push((is_vertical, line, first));
        }
        for &cell in changed {
            cells.extend(around(cell, self.before).flat_map(|(y, x)| [(true, x, y), (false, y, x)]));
        }
        let mut step = 0;
        while let Some((is_vertical, line, at)) = cells.pop() {
            step += 1;
            interrupt.check_every(1 << 12, step, DURING)?;
            let Some(run) = self.search.run_at(is_vertical, line, at).filter(|run| run.first <= at) else {
                continue;
            };
            let Some((side, (first, end))) = self.search.door(run) else { continue };
            self.search.block(run, side);
            self.touched.extend(run.cells().map(|(x, y)| (y, x)));
            let beside = line + side;
            cells.extend((first..end).map(|at| (!is_vertical, at, beside)));
            cells.push((is_vertical, beside, first));
        }
        Ok(())
    }

    fn finish(mut self, space: &FreeSpace<Corners>, interrupt: &Interrupt) -> Result<DeadEnds, Interrupted> {
        let Self { old, search, touched: cells, .. } = &mut self;
        cells.sort_unstable();
        cells.dedup();
        let rows = &search.rows;
        cells.retain(|&(y, x)| rows.row(y).is_blocked(x) != old.rows.row(y).is_blocked(x));
        let DeadEndSearch { rows, columns, kinds, gaps_are_open } = self.search;
        let Kinds { vertical, vertical_columns, beyond } = kinds;
        let kinds = Kinds {
            vertical: vertical.finish(),
            vertical_columns: vertical_columns.finish(),
            beyond: beyond.finish(),
        };
        let (rows, columns, mut cells) = (rows.finish(), columns.finish(), self.touched);
        let changed = cells.iter().map(|&(y, x)| (x as u16, y as u16, rows.row(y).is_blocked(x))).collect();
        let [of_rows, of_columns] = &self.old.parts;
        let lines = LineChange { before: &self.old.rows, after: &rows, cells: &cells };
        let (of_rows, in_rows) = of_rows.repaired(lines, gaps_are_open, false, interrupt)?;
        for cell in &mut cells {
            *cell = (cell.1, cell.0);
        }
        cells.sort_unstable();
        let lines = LineChange { before: &self.old.columns, after: &columns, cells: &cells };
        let (of_columns, in_columns) = of_columns.repaired(lines, gaps_are_open, true, interrupt)?;
        let kept = &self.old.repairs[self.old.repairs.len().saturating_sub(KEPT - 1)..];
        let repair = Repair { cells: changed, bridges: [in_rows, in_columns] };
        let repairs = kept.iter().cloned().chain([Arc::new(repair)]).collect();
        let parts = [of_rows, of_columns];
        Ok(DeadEnds { identity: space.identity(), rows, columns, kinds, parts, repairs })
    }
}
