//! Dead ends: parts of a map that no shortest path between vertices elsewhere enters.
//!
//! **A dead end** is a run of free cells, along a row or a column and as long as it can be, that one *door*
//! leads into: its long sides are blocked but for one stretch, and no gap that paths may pass is at its
//! corners. The door is a segment of a grid line. A path that enters by it and leaves by it again is no
//! shorter, in any norm, than the one that keeps to the segment instead, which is as free. So without the run
//! the same taut paths lead from vertex to vertex, except to those at its cells. Then the run may count as
//! blocked, and others may have one door left: [`DeadEnds`] goes on until there are none. What is left of a
//! map are the ways around its obstacles.
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
//! **Parts.** What is left may still be parts that single doors join (module `parts`). Of these a query needs
//! those between its ends; if it starts or ends in dead ends, between all that are behind their doors. So no
//! open dead end touches another part, and the doors between the parts are as they were. The others are shut:
//! the bridge from each part to its parent is shut but where both are needed, and so is the one from the
//! uppermost part that is needed.
//!
//! **Which cells were a run** is known by two bits a cell. When a run of a row was blocked, the cells at its
//! ends were blocked, on the map or earlier as parts of columns: so it is the longest run of free cells of
//! the row that are no parts of columns, and the other way around. The third bit of a cell is whether the
//! search may enter it. One of the bits is kept in rows and in columns: 0.5 bytes a cell in all, and 8 bytes
//! for each run of a part other than the first.

use mediant_grid::{BitMatrix, Corners, DiagonalGap, FreeSpace, Grid, Vertex};

use super::parts::{Part, Parts};

/// The dead ends of a map.
#[derive(Clone, Debug)]
pub(super) struct DeadEnds {
    /// The rows of the map with all dead ends blocked, except those that are open.
    rows: BitMatrix,
    kinds: Kinds,
    /// The dead ends that are open for the query, and the bridges that are open for it.
    open: Vec<Run>,
    /// What is left of the map without dead ends, in parts.
    parts: Parts,
    /// The run that shuts the bridge of the uppermost part for the query.
    shut: Option<Run>,
    /// The parts that the query needs, which are not open yet.
    needed: Vec<u32>,
}

/// Of which kind of run the cells of dead ends are.
#[derive(Clone, Debug)]
struct Kinds {
    /// Whether the run is part of a column, in rows.
    vertical: BitMatrix,
    /// The same in columns.
    vertical_columns: BitMatrix,
    /// Whether its door is below it, or to the right.
    beyond: BitMatrix,
}

/// A run of cells of a row, or of a column.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) is_vertical: bool,
    /// Its row or column.
    pub(super) line: i32,
    pub(super) first: i32,
    pub(super) end: i32,
}

impl Run {
    /// Sets its bits in rows of the map.
    fn set(self, rows: &mut BitMatrix, value: bool) {
        let Self { is_vertical, line, first, end } = self;
        if is_vertical {
            rows.set_run_of_column(line, first, end, value);
        } else {
            rows.set_run(line, first, end, value);
        }
    }

    /// Sets its bits, where what is a row here is a column there.
    fn set_across(self, lines: &mut BitMatrix, value: bool) {
        Self { is_vertical: !self.is_vertical, ..self }.set(lines, value);
    }
}

impl DeadEnds {
    /// The dead ends of a map, all of them closed.
    pub(super) fn new(space: &FreeSpace<Corners>) -> Self {
        let mut search = DeadEndSearch::new(space);
        search.block_all();
        let DeadEndSearch { mut rows, kinds, gaps_are_open, .. } = search;
        let parts = Parts::new(&rows, gaps_are_open);
        parts.all().iter().for_each(|part| part.inner.set(&mut rows, true));
        Self { rows, kinds, open: Vec::new(), parts, shut: None, needed: Vec::new() }
    }

    /// The bytes that they take when they are made.
    pub(super) fn bytes(space: &FreeSpace<Corners>) -> usize {
        3 * size_of_val(space.grid().rows().words()) + size_of_val(space.grid().columns().words())
    }

    /// The rows of the map without the dead ends that are closed.
    pub(super) const fn rows(&self) -> &BitMatrix {
        &self.rows
    }

    /// Opens the dead ends that paths between two vertices may need, and closes all others.
    pub(super) fn open(&mut self, grid: &Grid, ends: [Vertex; 2]) {
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
            let Part { parent, inner, outer } = self.parts.part(number);
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
        let vertical = self.kinds.vertical.row(y);
        let is_closed = self.rows.row(y).is_blocked(x);
        let run = if vertical.is_blocked(x) {
            if !is_closed {
                return;
            }
            self.vertical_run(x, y)
        } else {
            let part = self.parts.of(x, y);
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
        let column = self.kinds.vertical_columns.row(x);
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
        let beside = line + if self.kinds.beyond.row(y).is_blocked(x) { 1 } else { -1 };
        if is_vertical {
            self.open_in_column(grid, beside, (first, end));
            return;
        }
        let free = grid.rows().row(beside);
        let mut x = free.first_free(first, end);
        while x < end {
            let is_vertical = self.kinds.vertical.row(beside).is_blocked(x);
            self.open_at(grid, x, beside);
            // The rest of its run is opened with it, or in the same part.
            let next =
                if is_vertical { x + 1 } else { self.kinds.vertical.row(beside).first_blocked(x, end) };
            x = free.first_free(next.min(free.first_blocked(x, end).max(x + 1)), end);
        }
    }

    /// Opens the closed dead ends at some cells of a column.
    fn open_in_column(&mut self, grid: &Grid, x: i32, (first, end): (i32, i32)) {
        let free = grid.columns().row(x);
        let mut y = free.first_free(first, end);
        while y < end {
            self.open_at(grid, x, y);
            y = free.first_free(self.kinds.vertical_columns.row(x).first_free(y, end).max(y + 1), end);
        }
    }
}

/// The search for the dead ends of a map.
struct DeadEndSearch {
    rows: BitMatrix,
    columns: BitMatrix,
    kinds: Kinds,
    /// Whether paths may pass gaps.
    gaps_are_open: bool,
}

impl DeadEndSearch {
    fn new(space: &FreeSpace<Corners>) -> Self {
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
    fn block_all(&mut self) {
        let (mut rows, mut columns) =
            (vec![true; self.rows.height() as usize], vec![true; self.columns.height() as usize]);
        loop {
            self.block_along(false, &mut rows, &mut columns);
            if !columns.contains(&true) {
                return;
            }
            self.block_along(true, &mut columns, &mut rows);
        }
    }

    /// Blocks the dead ends along the lines that have changed, and marks the lines across that change by it.
    fn block_along(&mut self, is_vertical: bool, changed: &mut [bool], across: &mut [bool]) {
        for (line, changed) in (0..).zip(changed) {
            if !std::mem::take(changed) {
                continue;
            }
            let mut at = 0;
            while let Some(run) = self.run_from(is_vertical, line, at) {
                self.block_chain(run, across);
                at = run.end;
            }
        }
    }

    const fn lines(&self, is_vertical: bool) -> &BitMatrix {
        if is_vertical { &self.columns } else { &self.rows }
    }

    /// The first run of free cells of a line from `from` on.
    fn run_from(&self, is_vertical: bool, line: i32, from: i32) -> Option<Run> {
        let lines = self.lines(is_vertical);
        let (row, length) = (lines.row(line), lines.width() as i32);
        let first = row.first_free(from, length);
        (first < length).then(|| Run { is_vertical, line, first, end: row.first_blocked(first, length) })
    }

    /// Blocks a run if it is a dead end, then the one behind its door if that is one now, and so on.
    fn block_chain(&mut self, mut run: Run, across: &mut [bool]) {
        while let Some((side, (first, end))) = self.door(run) {
            run.set(&mut self.rows, true);
            run.set_across(&mut self.columns, true);
            if run.is_vertical {
                run.set(&mut self.kinds.vertical, true);
                run.set_across(&mut self.kinds.vertical_columns, true);
            }
            if side > 0 {
                run.set(&mut self.kinds.beyond, true);
            }
            // Across the line only the runs that the door leads to go on.
            across[first as usize..end as usize].fill(true);
            let line = run.line + side;
            let start = self.lines(run.is_vertical).row(line).run_start(first, 0);
            let Some(next) = self.run_from(run.is_vertical, line, start) else { return };
            run = next;
        }
    }

    /// The door of a dead end: on which side it is, and from where to where; `None` for other runs.
    fn door(&self, run: Run) -> Option<(i32, (i32, i32))> {
        let Run { is_vertical, line, first, end } = run;
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use mediant_grid::AsciiMap;

    use super::*;

    fn space(drawing: &str, gap: DiagonalGap) -> FreeSpace<Corners> {
        FreeSpace::new(Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid), gap)
    }

    /// The map with `x` for closed dead ends.
    fn draw(dead_ends: &DeadEnds, grid: &Grid) -> String {
        let cell = |x, y| match (grid.is_blocked(x, y), dead_ends.rows.row(y).is_blocked(x)) {
            (true, _) => '#',
            (false, true) => 'x',
            (false, false) => '.',
        };
        let (width, height) = (grid.width() as i32, grid.height() as i32);
        let lines = (0..height).map(|y| (0..width).map(|x| cell(x, y)).collect());
        lines.collect::<Vec<String>>().join("\n")
    }

    /// A room behind a corridor is open only if a path starts or ends there; what is before it is then open
    /// only if it is needed.
    #[test]
    fn parts_that_are_not_on_the_way_are_shut() {
        let space = space(".....\n.#.#.\n.....\n#.###\n...##\n.#.##\n...##", DiagonalGap::Closed);
        let mut dead_ends = DeadEnds::new(&space);
        let closed = ".....\n.#.#.\n.....\n#x###\nxxx##\n.#.##\n...##";
        assert_eq!(draw(&dead_ends, space.grid()), closed);
        dead_ends.open(space.grid(), [Vertex::new(0, 0), Vertex::new(2, 7)]);
        assert!(!draw(&dead_ends, space.grid()).contains('x'));
        dead_ends.open(space.grid(), [Vertex::new(0, 6), Vertex::new(2, 7)]);
        assert_eq!(draw(&dead_ends, space.grid()), ".....\n.#.#.\n.....\n#x###\n...##\n.#.##\n...##");
        dead_ends.open(space.grid(), [Vertex::new(0, 0), Vertex::new(5, 3)]);
        assert_eq!(draw(&dead_ends, space.grid()), closed);
    }

    /// A bay on the left, an edge that is rough, and a gap.
    const BAYS: &str = "
        ##..####...
        #...####...
        ........#..
        ..##.......
        ..##....#..
        ...........
    ";

    #[test]
    fn only_the_ways_around_obstacles_are_left() {
        let space = space(BAYS, DiagonalGap::Open);
        let mut dead_ends = DeadEnds::new(&space);
        let closed = "##xx####xxx\n#xxx####..x\nx.......#.x\nx.##......x\nx.##....#.x\nx.........x";
        assert_eq!(draw(&dead_ends, space.grid()), closed);
        // From a corner of the bay to a place that is in no dead end, and then elsewhere.
        dead_ends.open(space.grid(), [Vertex::new(4, 0), Vertex::new(5, 4)]);
        let open = "##..####xxx\n#...####..x\nx.......#.x\nx.##......x\nx.##....#.x\nx.........x";
        assert_eq!(draw(&dead_ends, space.grid()), open);
        dead_ends.open(space.grid(), [Vertex::new(5, 3), Vertex::new(5, 4)]);
        assert_eq!(draw(&dead_ends, space.grid()), closed);
    }

    /// Where paths may pass a gap, what is behind it is no dead end.
    #[test]
    fn an_open_gap_leads_on() {
        let blocked = |gap| {
            let space = space("..##\n..##\n##..\n##..", gap);
            draw(&DeadEnds::new(&space), space.grid())
        };
        assert_eq!(blocked(DiagonalGap::Open), "xx##\nx.##\n##.x\n##xx");
        assert_eq!(blocked(DiagonalGap::Closed), "xx##\nx.##\n##xx\n##x.");
    }
}
