//! The planes of block-based jumps after an edit of the map, by work that follows what the edit alters.
//!
//! A bit of the [planes of axial jumps](super::axial) depends on the cells around its vertex alone. So it can
//! change only in the *zones*: the vertices around which the pattern of cells changes.
//!
//! The bits of a vertex in a [diagonal plane](super::diagonals) depend on these cells as well, and on whether
//! the two axial jumps from there come to a jump point. The answer of a jump from p to its next vertex q
//! depends on how jumps find q, and if they pass it, on the answer from q. So where the answer from p
//! changes, either q is found otherwise, or the answer from q changes. All such p are found from the vertices
//! that are found otherwise, by going back against the jumps as long as the answer changes.
//!
//! Whether a jump point p is a [dead end](super::dead_ends) follows from the patterns of vertices within the
//! reach of p, from the jump points within it, and from whether jumps from vertices within it come to jump
//! points. So all dead ends within reach of a zone, or of a vertex from which the answer changes, are looked
//! at again, and no others. None of this depends on which of them are dead ends. Once that is known, jumps
//! that pass dead ends have changes of their own, which begin where one begins or ceases to be.
//!
//! A dead end that is not known to be one costs a search some time, and no path. So other jump points are
//! looked at only close to the zones. But for these, the result is equal to new planes, bit by bit.

use mediant_grid::{BitMatrix, Change, Grid, GridGraph, Interrupt, Interrupted, Placement, Vertex};

use super::{
    DURING,
    axial::{AxialStops, Difference, Finding, JumpPoint},
    dead_ends::find::DeadEndFinder,
    diagonals::{DiagonalEdit, DiagonalStops},
    zone::Zone,
};
use crate::canonical::PatternTable;

/// Why a repair ended without a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// New planes would be made sooner.
    TooMuch,
    Interrupted(Interrupted),
}

impl From<Interrupted> for Stop {
    fn from(interrupted: Interrupted) -> Self {
        Self::Interrupted(interrupted)
    }
}

/// The part of a map and of its planes that a change alters.
#[derive(Clone, Debug, Default)]
pub(super) struct Altered {
    /// The vertices around which the pattern of cells changes.
    pub(super) zones: Vec<Zone>,
    /// The vertices that axial jumps in a direction find otherwise.
    pub(super) found: Vec<(Vertex, usize)>,
}

/// Repairs planes.
pub(super) struct Repair<'r, P: Placement> {
    graph: &'r GridGraph<P>,
    table: &'r PatternTable,
    interrupt: &'r Interrupt,
    /// The planes before the change.
    axial: &'r AxialStops,
    diagonals: &'r DiagonalStops,
    /// The reach of dead ends; 0 if there are none.
    reach: u32,
    map: Zone,
    /// The work that it may still do.
    left: u64,
}

/// The work for a vertex of a zone, by that for a vertex from which the answer changes (12 ns).
const OF_ZONE: u64 = 12;
/// By how much more the whole takes than the zones, at least. (On the StarCraft map of the competition's
/// sample 18 of 19 repairs were given up in the end; to know it before saves 7 % of the instructions of the
/// changes.)
const BEYOND_ZONES: u64 = 2;
/// Likewise that for a jump point that may be a dead end.
const OF_DEAD_END: u64 = 8;
/// Likewise that for six vertices of new planes without dead ends, and with them.
const NEW: u64 = 2;
const NEW_WITH_DEAD_ENDS: u64 = 4;
/// The distance from a zone up to which new dead ends are looked for.
const NEAR: i32 = 4;

impl<'r, P: Placement> Repair<'r, P> {
    /// On the grid graph after the change, by its table of successors.
    pub(super) fn new(
        graph: &'r GridGraph<P>,
        table: &'r PatternTable,
        (axial, diagonals, reach): (&'r AxialStops, &'r DiagonalStops, u32),
        interrupt: &'r Interrupt,
    ) -> Self {
        let new = if reach > 0 { NEW_WITH_DEAD_ENDS } else { NEW };
        let left = graph.vertex_count() as u64 * new / 6;
        let map = Zone::map::<P>(graph.grid());
        Self { graph, table, interrupt, axial, diagonals, reach, map, left }
    }

    /// The same, however long it takes.
    #[cfg(test)]
    pub(super) fn without_limit(self) -> Self {
        Self { left: u64::MAX, ..self }
    }

    /// The planes after the change, and what it alters.
    pub(super) fn follow(mut self, change: &Change) -> Result<(AxialStops, DiagonalStops, Altered), Stop> {
        let zones = Zone::of_change::<P>(change);
        let work: u64 = zones.iter().map(|zone| zone.count() * OF_ZONE).sum();
        // The rest takes more: it is not begun if it would be given up.
        self.spend(BEYOND_ZONES * work)?;
        self.left += (BEYOND_ZONES - 1) * work;
        let (mut axial, mut differences) = self.axial.with_zones(self.graph, &zones, self.interrupt)?;
        differences.retain(|difference| difference.quarter.is_multiple_of(8 / self.graph.steps().len()));
        let mut points = Vec::new();
        if self.reach > 0 {
            if self.graph.has_closed_gaps() {
                // Then there are no dead ends.
                return Err(Stop::TooMuch);
            }
            points = self.jump_points(&axial, &zones, &differences)?;
            if !points.is_empty() {
                axial = axial.with_jump_points(&points);
            }
        }
        let mut edit = self.diagonals.edit();
        for &zone in &zones {
            self.interrupt.check(DURING)?;
            self.set_zone(&axial, (change.before(), zone), &mut edit);
        }
        let points = points.into_iter().map(|JumpPoint { at, quarter, .. }| (at, quarter));
        let mut found: Vec<_> = differences.into_iter().map(|found| (found.at, found.quarter)).collect();
        found.extend(points.filter(|&(at, quarter)| {
            let [was, is] = self.axial.findings(&axial, at, quarter);
            was != is
        }));
        for (number, &(at, quarter)) in found.iter().enumerate() {
            self.interrupt.check_every(64, number, DURING)?;
            self.set_before(&axial, (at, quarter), &mut edit)?;
        }
        Ok((axial, edit.finish(), Altered { zones, found }))
    }

    /// The directions of axial jumps.
    fn quarters(&self) -> impl Iterator<Item = usize> + use<P> {
        (0..4).step_by(8 / self.graph.steps().len())
    }

    /// The direction of an even move.
    fn quarter(&self, even: usize) -> usize {
        even >> (self.graph.k().get() - 2)
    }

    /// The even move of a direction.
    fn even(&self, quarter: usize) -> usize {
        quarter << (self.graph.k().get() - 2)
    }

    fn spend(&mut self, work: u64) -> Result<(), Stop> {
        self.left = self.left.checked_sub(work).ok_or(Stop::TooMuch)?;
        Ok(())
    }

    /// The jump points that are dead ends now and were none, or the other way; in the zones, where the planes
    /// say of none that it is one, all that are. Far from the zones, those are missing that were none.
    fn jump_points(
        &mut self,
        axial: &AxialStops,
        zones: &[Zone],
        differences: &[Difference],
    ) -> Result<Vec<JumpPoint>, Stop> {
        let finder = DeadEndFinder { graph: self.graph, table: self.table, leads: None, reach: self.reach };
        let (mut changed, mut points) = (Vec::new(), Vec::new());
        let mut differences = differences.iter().peekable();
        for (number, &zone) in zones.iter().enumerate() {
            self.interrupt.check(DURING)?;
            // In rows and in columns jumps lead elsewhere from there.
            let (mut wide, mut high) = (zone, zone);
            while let Some(&Difference { at, quarter, .. }) = differences.next_if(|next| next.zone == number)
            {
                let along = if quarter.is_multiple_of(2) { &mut high } else { &mut wide };
                self.for_each_before(axial, (at, quarter), false, |_, at, _| *along = along.with(at))?;
            }
            let reach = self.reach as i32;
            let [wide, high] = [wide, high].map(|zone| zone.grown(reach, reach).within(self.map));
            let near = zone.grown(NEAR, NEAR).within(self.map);
            for quarter in self.quarters() {
                axial.for_each_jump_point((near, quarter), false, |point| points.push(point));
                for (zone, others) in [(wide, near), (high, wide)] {
                    axial.for_each_jump_point((zone, quarter), true, |point| {
                        if !others.holds(point.at) {
                            points.push(point);
                        }
                    });
                }
            }
            self.spend(points.len() as u64 * OF_DEAD_END)?;
            changed.extend(points.drain(..).filter_map(|point| {
                let is_dead_end = finder.holds(axial, point.at, point.quarter);
                (is_dead_end != point.is_dead_end).then_some(JumpPoint { is_dead_end, ..point })
            }));
        }
        Ok(changed)
    }

    /// The findings of a vertex by jumps, before and after the change. Without dead ends these are jump
    /// points like others.
    fn findings(&self, axial: &AxialStops, at: Vertex, quarter: usize, with_dead_ends: bool) -> [Finding; 2] {
        self.axial.findings(axial, at, quarter).map(|end| match end {
            Finding::DeadEnd if !with_dead_ends => Finding::JumpPoint,
            end => end,
        })
    }

    /// For a vertex that jumps in a direction find otherwise than before: calls `visit` with the vertices in
    /// front of it from which they come to a jump point and did not, or the other way, whether they pass dead
    /// ends or, `with_dead_ends`, do not; and with whether they do so now. It ends where they find the next
    /// vertex otherwise, which has a call of its own.
    fn for_each_before(
        &mut self,
        axial: &AxialStops,
        (found, quarter): (Vertex, usize),
        with_dead_ends: bool,
        mut visit: impl FnMut(&Self, Vertex, Answer),
    ) -> Result<(), Stop> {
        let back = -self.graph.step(self.even(quarter)).vector();
        let mut at = found + back;
        if !self.map.holds(at) {
            return Ok(());
        }
        let [mut before, mut after] =
            [self.axial, axial].map(|axial| answer(axial, at, quarter, with_dead_ends));
        while before != after {
            self.spend(1)?;
            visit(self, at, after);
            match self.findings(axial, at, quarter, with_dead_ends) {
                [was, is] if was != is => break,
                [Finding::Blocked | Finding::JumpPoint, _] => break,
                // Only where dead ends count.
                [Finding::DeadEnd, _] => (before.any, after.any) = (true, true),
                [Finding::Passed, _] => {}
            }
            at = at + back;
            if !self.map.holds(at) {
                break;
            }
        }
        Ok(())
    }

    /// Sets the bits of the diagonal planes that change because jumps in a direction find a vertex otherwise.
    fn set_before(
        &mut self,
        axial: &AxialStops,
        (found, quarter): (Vertex, usize),
        edit: &mut DiagonalEdit<'_>,
    ) -> Result<(), Stop> {
        let (even, last) = (self.even(quarter), self.graph.steps().len() - 1);
        self.for_each_before(axial, (found, quarter), self.reach > 0, |repair, at, known| {
            let here = repair.here(repair.graph.grid(), at);
            // The jump is the first one beside the next odd move, and the second one beside the last.
            let [next, previous] = [even + 1, even + last].map(|odd| odd & last);
            for (i, index, other) in [(0, next, even + 2), (1, previous, even + last - 1)] {
                let here = here.by(index);
                if !here.enters {
                    continue;
                }
                edit.change(at, index, |[stops, first, second]| {
                    let mut any = [first, second];
                    any[i] = known.any;
                    let other = repair.quarter(other & last);
                    // If that jump passed dead ends to a jump point, it was said to stop this one.
                    let passes = || repair.reach == 0 || stops && axial.scan(at, other, false).found;
                    [here.forced || known.live || any[1 - i] && passes(), any[0], any[1]]
                });
            }
        })
    }

    /// Sets those bits of a zone in the diagonal planes that the pattern of cells decides.
    fn set_zone(&self, axial: &AxialStops, (before, zone): (&Grid, Zone), edit: &mut DiagonalEdit<'_>) {
        for at in zone.vertices() {
            let [was, is] = [before, self.graph.grid()].map(|grid| self.here(grid, at));
            for index in (1..self.graph.steps().len()).step_by(2) {
                let here = is.by(index);
                if here == was.by(index) {
                    continue;
                }
                let beside = [index - 1, (index + 1) % self.graph.steps().len()];
                edit.change(at, index, |_| {
                    if !here.enters {
                        return [true, false, false];
                    }
                    let answers = beside.map(|even| answer(axial, at, self.quarter(even), self.reach > 0));
                    let live = answers.iter().any(|answer| answer.live);
                    [here.forced || live, answers[0].any, answers[1].any]
                });
            }
        }
    }

    /// The pattern of cells around a vertex.
    fn here(&self, grid: &Grid, at: Vertex) -> Here<'r> {
        let rows = grid.rows();
        let pattern = P::pattern(rows.words(), rows.index(at.x, at.y), rows.bits_per_row());
        // The pattern tells a gap, whether there is any elsewhere or not.
        let is_gap = P::closes_gaps(self.graph.rule()) && is_gap(rows, at);
        Here { table: self.table, pattern, is_gap, moves: self.graph.steps().len() }
    }
}

/// The pattern of cells around a vertex.
#[derive(Clone, Copy)]
struct Here<'r> {
    table: &'r PatternTable,
    pattern: usize,
    is_gap: bool,
    /// The number of moves of the neighborhood.
    moves: usize,
}

/// The part of the bits of a diagonal jump that the pattern of cells around a vertex tells.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Arrival {
    /// Whether they can enter the vertex.
    enters: bool,
    /// Whether they have a forced successor there.
    forced: bool,
}

impl Here<'_> {
    fn by(self, index: usize) -> Arrival {
        if self.pattern == 0 {
            return Arrival { enters: true, forced: false };
        }
        // A move is legal if the move back is.
        let back = (index + self.moves / 2) & (self.moves - 1);
        let enters = !self.is_gap && self.table.successors(back, self.pattern) >> back & 1 == 1;
        let forced = || self.table.forced(index, self.table.successors(index, self.pattern)) != 0;
        Arrival { enters, forced: enters && self.table.diagonals_may_force() && forced() }
    }
}

/// Whether two blocked cells meet diagonally at a corner, and two free ones.
fn is_gap(rows: &BitMatrix, at: Vertex) -> bool {
    let [a, b, c, d] = [(-1, -1), (0, -1), (-1, 0), (0, 0)].map(|(dx, dy)| rows.get(at.x + dx, at.y + dy));
    a == d && b == c && a != b
}

/// Whether an axial jump comes to a jump point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Answer {
    any: bool,
    /// Whether it does where it passes dead ends.
    live: bool,
}

/// Whether the axial jump from a vertex comes to a jump point. Without dead ends, all of them are others.
fn answer(axial: &AxialStops, at: Vertex, quarter: usize, with_dead_ends: bool) -> Answer {
    let any = axial.scan(at, quarter, true).found;
    Answer { any, live: any && (!with_dead_ends || axial.scan(at, quarter, false).found) }
}

#[cfg(test)]
mod tests;
