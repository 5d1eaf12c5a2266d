//! Dead ends: parts of a map that no shortest path between vertices elsewhere enters.
//!
//! **A dead end** is a short run of free cells, along a row or a column and as long as it can be, that one
//! *door* leads into: its long sides are blocked but for one stretch, and no gap that paths may pass is at
//! its corners. The door is a segment of a grid line. A path that enters by it and leaves by it again is no
//! shorter, in any norm, than the one that keeps to the segment instead, which is as free. So without the run
//! the same taut paths lead from vertex to vertex, except to those at its cells. Then the run may count as
//! blocked, and others may have one door left: the search goes on until there are none. Rooms and the ways
//! around obstacles remain.
//!
//! **No corner is added** by blocking the run: beyond its door the wall is straight, or goes on from where
//! the run ended. So every place at which a path turns is one of the map itself, and every gap is, too.
//!
//! **For a query** the runs with a cell at the start or the goal are opened again, all that are behind their
//! doors, and so on. Nothing else is needed: let C be an opened run and X one that is not. If X was blocked
//! after C and touches it, at a side or at a gap, then it was there when C was blocked, and so behind the
//! only door of C, and would be open. So the cells around X are as they were when it was blocked, and the
//! argument above holds for X, now as then.
//!
//! **Parts.** What is left may still be parts that single doors join (module `parts`): between rows, as
//! where a corridor leads down from a room, or between columns. Of these a query needs those between its
//! ends; if it starts or ends in dead ends, between all that are behind their doors. So no open dead end
//! touches another part, and the doors between the parts are as they were. The others are shut: the bridge
//! from each part to its parent is shut but where both are needed, and so is the one from the uppermost part
//! that is needed.
//!
//! The least path needs no part of rows that is shut, and no part of columns that is: it would be shorter
//! along the door. So a cell is left out if it shuts a bridge of either kind. Where two runs that shut
//! bridges cross, or one ends at a part that is shut, that may make corners which the map has not. No least
//! path needs them, and a path that turns there is legal on the map.
//!
//! **Which cells were a run** is known by two bits a cell. When a run of a row was blocked, the cells at its
//! ends were blocked, on the map or earlier as parts of columns: so it is the longest run of free cells of
//! the row that are no parts of columns, and the other way around. The third bit of a cell is whether the
//! search may enter it. One of the bits is kept in rows and in columns: 0.6 bytes a cell in all, 8 bytes for
//! each run of a part other than the first, and some 16 for each row and column. Each planner has rows of its
//! own for what is open for its query, and for the parts of each kind ([`Opened`]).
//!
//! **After an edit** of the map (module `repair`) the runs that touch a changed cell are opened as a query
//! opens them: with all that are behind their doors. So for each run that stays blocked, the cells around it
//! are as they were when it was blocked, but for those that were blocked later: the same runs in the same
//! order, without those that were opened, are dead ends of the new map. Then dead ends are looked for around
//! the cells that changed or were opened, and these come last in the order. So what queries rely on is true
//! again, and a repair leaves out about as much as a new search. Its work follows the change and the opened
//! runs, most often some dozen cells. Of the parts the bridges stay that are certain to be bridges still
//! (module `repair_parts`): after many edits the parts are fewer than new ones, and their memory is larger.

mod find;
mod opened;
mod parts;
mod repair;
mod repair_parts;
mod runs;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use mediant_grid::{BitMatrix, Corners, FreeSpace, Grid, Identity, Interrupt, Interrupted, uninterrupted};

use self::{
    find::DeadEndSearch,
    parts::Parts,
    repair::Repair,
    runs::{CellRun, Kinds},
};

pub(super) use self::opened::Opened;

/// The dead ends of a map, which planners share: parts that no shortest path between vertices elsewhere
/// enters, such as bays, alcoves and all that lies behind a single door.
///
/// They are found in some nanoseconds a cell (in noise some twenty), and take five bits a cell and some 8
/// bytes for each run of cells in rooms that single doors lead to. A planner takes three bits a cell more.
#[derive(Clone, Debug)]
pub struct DeadEnds {
    identity: Identity,
    /// The rows of the map with all dead ends blocked, but with all parts open.
    rows: BitMatrix,
    /// The same in columns.
    columns: BitMatrix,
    kinds: Kinds,
    /// The parts of the map without dead ends: of its rows, and of its columns.
    parts: [Parts; 2],
    /// The last repairs, or that of no cell by which these were found.
    repairs: Vec<Arc<Repair>>,
}

impl DeadEnds {
    /// Finds the dead ends of a map.
    #[must_use]
    pub fn new(space: &FreeSpace<Corners>) -> Self {
        uninterrupted(|never| Self::interruptible(space, never))
    }

    /// [`new`](Self::new), which an interrupt can stop; it asks for each row and column, and every few
    /// thousand runs.
    ///
    /// # Errors
    /// [`Interrupted`].
    pub fn interruptible(space: &FreeSpace<Corners>, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        let mut search = DeadEndSearch::new(space);
        search.block_all(interrupt)?;
        let DeadEndSearch { rows, columns, kinds, gaps_are_open } = search;
        let parts = |lines, is_vertical| Parts::new(lines, is_vertical, gaps_are_open, interrupt);
        let parts = [parts(&rows, false)?, parts(&columns, true)?];
        let repairs = vec![Arc::default()];
        Ok(Self { identity: space.identity(), rows, columns, kinds, parts, repairs })
    }

    /// The dead end that a free cell of the map is part of. It must be of one.
    fn run_of(&self, grid: &Grid, x: i32, y: i32) -> CellRun {
        let Kinds { vertical, vertical_columns, .. } = &self.kinds;
        if vertical.row(y).is_blocked(x) {
            let column = vertical_columns.row(x);
            let (first, end) = (column.blocked_start(y, 0), column.first_free(y, grid.height() as i32));
            return CellRun { is_vertical: true, line: x, first, end };
        }
        let (free, vertical) = (grid.rows().row(y), vertical.row(y));
        let first = free.run_start(x, vertical.run_start(x, 0));
        let end = free.first_blocked(x, vertical.first_blocked(x, grid.width() as i32));
        CellRun { is_vertical: false, line: y, first, end }
    }

    /// The line on the side of a dead end where its door is.
    fn line_behind_door(&self, run: CellRun) -> i32 {
        let (x, y) = run.first_cell();
        run.line + if self.kinds.beyond.row(y).is_blocked(x) { 1 } else { -1 }
    }

    /// Their identity: the map and the rule of motion, for every k.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.identity
    }

    /// The memory of a map's dead ends without its parts, in bytes.
    #[must_use]
    pub fn bytes(space: &FreeSpace<Corners>) -> usize {
        3 * size_of_val(space.grid().rows().words()) + 2 * size_of_val(space.grid().columns().words())
    }

    /// The memory that they take, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let Self { rows, columns, kinds, parts, .. } = self;
        let Kinds { vertical, vertical_columns, beyond } = kinds;
        let matrices = [rows, columns, vertical, vertical_columns, beyond];
        matrices.iter().map(|matrix| size_of_val(matrix.words())).sum::<usize>()
            + parts.iter().map(Parts::memory_bytes).sum::<usize>()
    }

    /// The scratch memory that a planner takes more if it leaves them out, in bytes.
    #[must_use]
    pub fn scratch_bytes(&self) -> usize {
        3 * size_of_val(self.rows.words())
    }
}
