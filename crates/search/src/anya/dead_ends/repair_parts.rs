//! Repairs the parts of a map by work that follows the change.
//!
//! A bridge stays one as long as this holds: what hangs on it touches the rest of the map nowhere but at its
//! door. So each cell that is free again gets the part of a neighbor, and where it touches cells of others,
//! all bridges on the way from the one part to the others are given up: these parts are *joined*, and never
//! shut. Where a cell of a door is blocked, the bridge stays if the door is still one segment. If nothing is
//! left of it, the part is *cut off*. When a run that is free again leads from such a part to another, it is
//! its new bridge: doors may close and open.
//!
//! No bridge is found otherwise. Neither is one that a new wall makes, nor one on a way around that is
//! blocked again.

use mediant_grid::{BitMatrix, BitRow, Interrupt, Interrupted, VersionEdit};

use super::{
    parts::{Lines, Link, Part, PartRun, Parts},
    runs::{CellRun, DURING},
};

/// Rows of a map before and after a change, or its columns.
#[derive(Clone, Copy)]
pub(super) struct LineChange<'c> {
    pub(super) before: &'c BitMatrix,
    pub(super) after: &'c BitMatrix,
    /// The cells that are not what they were, line by line: of each the line, and where it is there.
    pub(super) cells: &'c [(i32, i32)],
}

/// The runs that shut bridges, before and after a repair.
type Bridges = Box<[[CellRun; 2]]>;

/// A free run after the change, of which cells have changed, or cells beside it.
#[derive(Clone, Copy)]
struct Run {
    line: i32,
    first: i32,
    end: i32,
    /// `None` until it is known.
    part: Option<u32>,
    /// Whether any of its cells was blocked before.
    is_new: bool,
}

/// A repair under way.
struct PartRepair<'c> {
    old: &'c Parts,
    change: LineChange<'c>,
    gaps_are_open: bool,
    is_vertical: bool,
    parts: VersionEdit<Part>,
    /// The stretches of lines in which runs have changed: from where to where.
    stretches: Vec<(i32, i32, i32)>,
    /// The runs in these stretches, in order.
    runs: Vec<Run>,
    /// The parts whose bridges may be others.
    renewed: Vec<u32>,
}

impl Parts {
    /// The parts of a map's lines after a change, and the bridges that are others.
    pub(super) fn repaired(
        &self,
        change: LineChange<'_>,
        gaps_are_open: bool,
        is_vertical: bool,
        interrupt: &Interrupt,
    ) -> Result<(Self, Bridges), Interrupted> {
        let (parts, none) = (self.parts.edit(), Vec::new);
        let (stretches, runs, renewed) = (none(), Vec::new(), Vec::new());
        let mut repair =
            PartRepair { old: self, change, gaps_are_open, is_vertical, parts, stretches, runs, renewed };
        interrupt.check(DURING)?;
        repair.find_bridges();
        repair.find_runs();
        interrupt.check(DURING)?;
        repair.renew_bridges();
        repair.name_new_runs();
        interrupt.check(DURING)?;
        repair.join_at_new_runs();
        Ok(repair.finish())
    }
}

/// The first stretch from `from` on, and before `to`, in which two rows are both free: from where to where.
fn door_from([a, b]: [BitRow<'_>; 2], from: i32, to: i32) -> Option<(i32, i32)> {
    let mut x = from;
    while x < to {
        let free = b.first_free(a.first_free(x, to), to);
        if free < to && !a.is_blocked(free) {
            return Some((free, a.first_blocked(free, b.first_blocked(free, to))));
        }
        x = free;
    }
    None
}

/// Whether there is a gap at one of the vertices between two rows from `first` to `last`.
fn has_gap([a, b]: [BitRow<'_>; 2], first: i32, last: i32) -> bool {
    (first..=last).step_by(64).any(|x| {
        let [nw, ne, sw, se] = [a.word(x - 1), a.word(x), b.word(x - 1), b.word(x)];
        let gaps = (nw ^ ne) & !(nw ^ se) & !(ne ^ sw);
        gaps & !0 >> (63 - (last - x).min(63)) != 0
    })
}

impl PartRepair<'_> {
    fn part(&self, number: u32) -> Part {
        self.parts.words()[number as usize - 1]
    }

    fn set_part(&mut self, number: u32, part: Part) {
        self.parts.set(number as usize - 1, part);
        self.renewed.push(number);
    }

    /// The uppermost of the parts that are joined with one.
    fn joined(&self, mut number: u32) -> u32 {
        while number != 0 && self.part(number).link == Link::Joined {
            number = self.part(number).parent;
        }
        number
    }

    /// Joins two parts, and all on the way between them. Returns the uppermost one of these.
    fn join(&mut self, mut a: u32, mut b: u32) -> u32 {
        // Parents have smaller numbers.
        while a != b {
            let lower = a.max(b);
            let part = self.part(lower);
            if part.link != Link::Joined {
                let (inner, outer) = Default::default();
                self.set_part(lower, Part { link: Link::Joined, inner, outer, ..part });
            }
            (a, b) = (a.min(b), part.parent);
        }
        a
    }

    /// Whether a part is another one, or hangs on it.
    fn hangs_on(&self, mut number: u32, other: u32) -> bool {
        while number > other {
            number = self.part(number).parent;
        }
        number == other
    }

    /// The bridges at runs that the change alters.
    fn find_bridges(&mut self) {
        let LineChange { before, cells, .. } = self.change;
        let width = before.width() as i32;
        let mut last = (-1, -1);
        for &(line, x) in cells {
            let row = before.row(line);
            for x in 0.max(x - 1)..width.min(x + 2) {
                if row.is_blocked(x) || last == (line, row.run_start(x, 0)) {
                    continue;
                }
                let (first, end) = (row.run_start(x, 0), row.first_blocked(x, width));
                last = (line, first);
                let number = self.old.of(x, line);
                if number != 0 && self.old.part(number).inner.is_at(line, first) {
                    self.renewed.push(number);
                }
                for beside in [line - 1, line + 1] {
                    if beside < 0 || beside == before.height() as i32 {
                        continue;
                    }
                    let runs = self.old.lines.get(beside);
                    let from = runs.partition_point(|run| i32::from(run.end) <= first);
                    for run in runs[from..].iter().take_while(|run| i32::from(run.first) < end) {
                        let part = self.old.part(run.part);
                        if part.inner.is_at(beside, i32::from(run.first)) && part.outer.is_at(line, first) {
                            self.renewed.push(run.part);
                        }
                    }
                }
            }
        }
        self.renewed.sort_unstable();
        self.renewed.dedup();
    }

    /// Finds the stretches that the change alters, and the runs there.
    fn find_runs(&mut self) {
        let LineChange { before, after, cells } = self.change;
        let width = before.width() as i32;
        for &(line, x) in cells {
            let [(first, end), (other, other_end)] = [before, after].map(|lines| {
                let row = lines.row(line);
                (row.run_start(x, 0), row.first_blocked(x + 1, width))
            });
            let mut stretch = (line, first.min(other), end.max(other_end));
            while let Some(&last) = self.stretches.last()
                && last.0 == line
                && last.2 >= stretch.1
            {
                stretch = (line, stretch.1.min(last.1), stretch.2.max(last.2));
                self.stretches.pop();
            }
            self.stretches.push(stretch);
        }
        for at in 0..self.stretches.len() {
            let (line, from, to) = self.stretches[at];
            let (old, new) = (before.row(line), after.row(line));
            let mut first = new.first_free(from, to);
            while first < to {
                let end = new.first_blocked(first, to);
                let (mut part, mut x) = (None, old.first_free(first, end));
                while x < end {
                    let number = self.old.of(x, line);
                    part = Some(part.map_or(number, |part| self.join(part, number)));
                    x = old.first_free(old.first_blocked(x, end), end);
                }
                let is_new = old.first_blocked(first, end) < end;
                self.runs.push(Run { line, first, end, part, is_new });
                first = new.first_free(end, to);
            }
        }
    }

    /// Gives bridges the runs that they lead between now, and gives up those that are none any more.
    fn renew_bridges(&mut self) {
        let after = self.change.after;
        for number in self.renewed.clone() {
            let part = self.part(number);
            let Part { parent, link: Link::Bridge, inner, outer } = part else { continue };
            let (first, end) = (inner.first.max(outer.first), inner.end.min(outer.end));
            let [a, b] = [inner, outer].map(|run| after.row(run.line));
            let door = door_from([a, b], first, end);
            let is_one = door.is_none_or(|(_, stop)| door_from([a, b], stop, end).is_none());
            if !is_one || self.gaps_are_open && has_gap([a, b], first, end) {
                self.join(number, parent);
                continue;
            }
            let (link, [inner, outer]) = match door {
                None => (Link::Cut, Default::default()),
                Some((x, _)) => (Link::Bridge, [inner.line, outer.line].map(|line| self.run_at(line, x))),
            };
            self.set_part(number, Part { parent, link, inner, outer });
        }
    }

    /// The run after the change at a cell.
    fn run_at(&self, line: i32, x: i32) -> CellRun {
        let row = self.change.after.row(line);
        let (first, end) = (row.run_start(x, 0), row.first_blocked(x, self.change.after.width() as i32));
        CellRun { is_vertical: self.is_vertical, line, first, end }
    }

    /// The runs that touch one on a side, each with its part.
    fn beside(&self, run: Run, side: i32) -> Vec<(CellRun, Option<u32>)> {
        let after = self.change.after;
        let (line, reach) = (run.line + side, i32::from(self.gaps_are_open));
        if line < 0 || line == after.height() as i32 {
            return Vec::new();
        }
        let (row, to) = (after.row(line), (run.end + reach).min(after.width() as i32));
        let (mut x, mut found) = (row.first_free(0.max(run.first - reach), to), Vec::new());
        while x < to {
            let beside = self.run_at(line, x);
            let at = self.runs.partition_point(|run| (run.line, run.end) <= (line, x));
            let known = self.runs.get(at).filter(|run| run.line == line && run.first <= x);
            found.push((beside, known.map_or_else(|| Some(self.old.of(x, line)), |run| run.part)));
            x = row.first_free(beside.end.min(to), to);
        }
        found
    }

    /// Gives parts to runs all of whose cells are new.
    fn name_new_runs(&mut self) {
        let (mut is_done, mut is_upward, count) = (false, false, self.runs.len());
        while !is_done {
            is_done = true;
            for number in 0..count {
                let at = if is_upward { count - 1 - number } else { number };
                let run = self.runs[at];
                if run.part.is_some() {
                    continue;
                }
                let sides = [-1, 1].map(|side| self.beside(run, side));
                let part = self.bridge_by(run, &sides);
                let part = part.or_else(|| sides.iter().flatten().find_map(|&(_, part)| part));
                if part.is_some() {
                    self.runs[at].part = part;
                    is_done = false;
                }
            }
            is_upward = !is_upward;
        }
        for run in &mut self.runs {
            run.part.get_or_insert(0);
        }
    }

    /// Makes a new run the bridge of a part that was cut off, if it is one. Returns the part.
    fn bridge_by(&mut self, run: Run, [above, below]: &[Vec<(CellRun, Option<u32>)>; 2]) -> Option<u32> {
        for (within, beyond) in [(above, below), (below, above)] {
            let [(outer, Some(beyond))] = beyond[..] else { continue };
            let is_straight = outer.first < run.end && run.first < outer.end;
            let within: Option<Vec<u32>> = within.iter().map(|&(_, part)| part).collect();
            let Some(within) = within.filter(|within| is_straight && !within.is_empty()) else { continue };
            let mut number = within[0];
            while number != 0 && self.part(number).link != Link::Cut {
                number = self.part(number).parent;
            }
            let is_within = |&part: &u32| self.hangs_on(part, number);
            if number == 0 || is_within(&beyond) || !within.iter().all(is_within) {
                continue;
            }
            for part in within {
                self.join(part, number);
            }
            let parent = self.part(number).parent;
            self.join(parent, beyond);
            let inner = self.run_at(run.line, run.first);
            self.set_part(number, Part { parent, link: Link::Bridge, inner, outer });
            return Some(number);
        }
        None
    }

    /// Joins the parts that touch at new cells.
    fn join_at_new_runs(&mut self) {
        for at in 0..self.runs.len() {
            let run = self.runs[at];
            let Run { line, first, part: Some(part), is_new: true, .. } = run else { continue };
            for side in [-1, 1] {
                for (beside, other) in self.beside(run, side) {
                    let other = other.unwrap_or(0);
                    let [a, b] = [part, other].map(|part| self.joined(part));
                    if a == b {
                        continue;
                    }
                    let Part { parent, inner, outer, .. } = self.part(a.max(b));
                    let (inside, outside) = if a > b {
                        ((line, first), (beside.line, beside.first))
                    } else {
                        ((beside.line, beside.first), (line, first))
                    };
                    // The door of a bridge has become wider.
                    let is_bridge = self.joined(parent) == a.min(b)
                        && inner.is_at(inside.0, inside.1)
                        && outer.is_at(outside.0, outside.1);
                    if !is_bridge {
                        self.join(a, b);
                    }
                }
            }
        }
    }

    fn finish(mut self) -> (Parts, Bridges) {
        let mut lines = self.old.lines.clone();
        self.set_lines(&mut lines);
        self.renewed.sort_unstable();
        self.renewed.dedup();
        let bridges = self.renewed.iter().map(|&number| [self.old.part(number), self.part(number)]);
        let bridges = bridges.map(|parts| parts.map(|part| part.inner));
        let bridges = bridges.filter(|[before, after]| before != after).collect();
        (Parts { lines, parts: self.parts.finish() }, bridges)
    }

    /// Puts the runs of the stretches in their lines.
    fn set_lines(&self, lines: &mut Lines) {
        for stretches in self.stretches.chunk_by(|a, b| a.0 == b.0) {
            let (line, ..) = stretches[0];
            let is_in = |x: i32| stretches.iter().any(|&(_, first, end)| first <= x && x < end);
            let old = self.old.lines.get(line);
            let from = self.runs.partition_point(|run| run.line < line);
            let new = self.runs[from..].iter().take_while(|run| run.line == line);
            let new = new.filter_map(|run| {
                let part = run.part.filter(|&part| part != 0)?;
                Some(PartRun { first: run.first as u16, end: run.end as u16, part })
            });
            let mut runs: Vec<PartRun> =
                old.iter().copied().filter(|run| !is_in(i32::from(run.first))).chain(new).collect();
            runs.sort_unstable_by_key(|run| run.first);
            if runs != old {
                lines.set(line, runs);
            }
        }
    }
}
