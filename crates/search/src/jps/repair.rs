//! The planes of block-based jumps after an edit of the map, by work that follows what the edit alters.
//!
//! A bit of the [planes of axial jumps](super::axial) depends on the cells around its vertex alone. So it can
//! change only in the *zones*: the vertices around which the pattern of cells changes.
//!
//! The bits of a vertex in a [diagonal plane](super::diagonals) depend on these cells as well, and on whether
//! the two axial jumps from there come to a jump point. The answer of a jump from p to its next vertex q
//! depends on how jumps find q, and if they pass it, on the answer from q. So where the answer from p
//! changes, either q is found otherwise, or the answer from q changes. All such p are found from the vertices
//! that are found otherwise, by going back against the jumps, 64 vertices at a time, as long as the answer
//! changes.
//!
//! Whether a jump point p is a [dead end](super::dead_ends) follows from the patterns of vertices within the
//! reach of p, from the jump points within it, and from whether jumps from vertices within it come to jump
//! points. A dead end stays one where they cease to: if they came to one of its own jump points, that lies
//! within the reach, and if that has changed, so has its pattern. So all dead ends within reach of a zone, or
//! of a vertex from which jumps come to a jump point and did not, are looked at again, and few others: these
//! vertices are kept as tiles. None of this depends on which of them are dead ends. Once that is known, jumps
//! that pass dead ends have changes of their own, which begin where one begins or ceases to be.
//!
//! A dead end that is not known to be one costs a search some time, and no path. So other jump points are
//! looked at only close to the zones. But for these, the result is equal to new planes, bit by bit.
//!
//! Where a change alters much, new planes are made sooner. They look at the same dead ends, and no others: to
//! look for all takes as long as the rest of them twice.

use mediant_grid::{BitMatrix, Change, Grid, GridGraph, Interrupt, Interrupted, Placement, Vertex};

use super::{
    DURING,
    axial::{Answers, AxialStops, JumpPoint, LineWord},
    cell_rows::EndRows,
    dead_ends::{DeadEndRows, find::DeadEndFinder},
    diagonals::{DiagonalEdit, DiagonalStops},
    planes::{JumpPlanes, PlaneRows},
    stop_rows::Leads,
    zone::Zone,
};
use crate::canonical::{PatternTable, Pruning};

mod tiles;

use self::tiles::{Near, Tiles};

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
    /// The time that it may still take, in tenths of nanoseconds as it is reckoned: that of new planes.
    left: u64,
}

/// The time for a vertex of a zone, in tenths of nanoseconds.
const OF_ZONE: u64 = 1200;
/// The time for a vertex from which the answer changes.
const OF_VERTEX: u64 = 500;
/// For a change of more zones these vertices are counted before any is looked at.
const FEW_ZONES: usize = 16;
/// The time of new planes for a vertex and a direction of diagonal jumps, and where these have forced
/// successors, which are looked for vertex by vertex. (The dead ends that are looked at are the same.)
const NEW: u64 = 8;
const NEW_WITH_FORCED: u64 = 54;
/// The distance from a zone up to which new dead ends are looked for.
const NEAR: i32 = 4;
/// The tiles of vertices near a zone, and of those from which a dead end may be within reach, have sides of
/// 2^n vertices.
const NEAR_TILE: u32 = 2;
const REACH_TILE: u32 = 3;

impl<'r, P: Placement> Repair<'r, P> {
    /// On the grid graph after the change, by its table of successors.
    pub(super) fn new(
        graph: &'r GridGraph<P>,
        table: &'r PatternTable,
        (axial, diagonals, reach): (&'r AxialStops, &'r DiagonalStops, u32),
        interrupt: &'r Interrupt,
    ) -> Self {
        let new = if table.diagonals_may_force() { NEW_WITH_FORCED } else { NEW };
        let left = graph.vertex_count() as u64 * (graph.steps().len() as u64 / 2) * new;
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
        self.spend(work)?;
        let (mut axial, mut found) = self.axial.with_zones(self.graph, &zones, self.interrupt)?;
        found.retain(|(_, quarter)| quarter.is_multiple_of(8 / self.graph.steps().len()));
        let mut words = words_of(&axial, &found);
        let is_counted = zones.len() > FEW_ZONES;
        if is_counted {
            axial.for_each_other_answer(self.axial, &words, |_, answers| {
                self.spend(OF_VERTEX * others(answers))
            })?;
        }
        if self.reach > 0 {
            if self.graph.has_closed_gaps() {
                // Then there are no dead ends.
                return Err(Stop::TooMuch);
            }
            let points = self.jump_points(&axial, &zones, &words)?;
            if !points.is_empty() {
                axial = axial.with_jump_points(&points);
                let points = points.into_iter().map(|JumpPoint { at, quarter, .. }| (at, quarter));
                found.extend(points.filter(|&(at, quarter)| {
                    let [was, is] = self.axial.findings(&axial, at, quarter);
                    was != is
                }));
                words = words_of(&axial, &found);
            }
        }
        let mut edit = self.diagonals.edit()?;
        for &zone in &zones {
            self.interrupt.check(DURING)?;
            self.set_zone(&axial, (change.before(), zone), &mut edit);
        }
        let before = self.axial;
        axial.for_each_other_answer(before, &words, |line, [was, is]| {
            let bits = was.any ^ is.any | was.live ^ is.live;
            if !is_counted {
                self.spend(OF_VERTEX * others([was, is]))?;
            }
            self.interrupt.check(DURING)?;
            self.set_line(&axial, (line, bits, is), &mut edit);
            Ok::<(), Stop>(())
        })?;
        Ok((axial, edit.finish(), Altered { zones, found }))
    }

    /// New planes, where only those dead ends are looked for that the change may alter: as in
    /// [`follow`](Self::follow).
    pub(super) fn anew(self, pruning: &Pruning<P>, change: &Change) -> Result<JumpPlanes, Interrupted> {
        if self.reach == 0 && JumpPlanes::should_have_dead_ends(self.graph, self.axial) {
            // They were looked for, and there were none.
            return JumpPlanes::new(self.graph, pruning, self.interrupt);
        }
        let mut axial = AxialStops::new(self.graph, self.interrupt)?;
        if self.reach == 0 || !JumpPlanes::should_have_dead_ends(self.graph, &axial) {
            return JumpPlanes::with_dead_ends(self.graph, pruning, axial, 0, self.interrupt);
        }
        axial.take_dead_ends(self.axial);
        let rows = PlaneRows::new(self.graph, self.interrupt)?;
        let mut dead_ends = DeadEndRows::new(P::vertices(change.after()));
        let points = self.jump_points_of_all(&axial, change, &rows, &mut dead_ends)?;
        let axial = axial.with_jump_points(&points);
        let known = (axial, dead_ends, self.reach);
        JumpPlanes::with_known_dead_ends(self.graph, pruning, known, &rows, self.interrupt)
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
        &self,
        axial: &AxialStops,
        zones: &[Zone],
        words: &[usize],
    ) -> Result<Vec<JumpPoint>, Interrupted> {
        let reach = self.reach as i32;
        // The vertices within reach of a zone, or of a vertex from which jumps lead on and did not.
        let mut tiles = Tiles::new(self.map, REACH_TILE);
        zones.iter().for_each(|zone| tiles.add(zone.grown(reach, reach)));
        axial.for_each_other_answer(self.axial, words, |line, [was, is]| {
            let bits = is.any & !was.any;
            if bits != 0 {
                let [first, last] =
                    [bits.trailing_zeros(), 63 - bits.leading_zeros()].map(|bit| line.vertex(bit));
                tiles.add(Zone::around(first, last).grown(reach, reach));
            }
            self.interrupt.check(DURING)
        })?;
        let mut points = Vec::new();
        for zone in tiles.zones() {
            self.interrupt.check(DURING)?;
            for quarter in self.quarters() {
                axial.for_each_jump_point((zone, quarter), true, |point| points.push(point));
            }
        }
        for zone in Near::new(zones, NEAR, (self.map, NEAR_TILE)).zones() {
            for quarter in self.quarters() {
                axial.for_each_jump_point((zone, quarter), false, |point| {
                    if !point.is_dead_end {
                        points.push(point);
                    }
                });
            }
        }
        self.changed(axial, points, None)
    }

    /// The same by all jump points of the map, where it alters much. Adds the dead ends to `dead_ends`.
    fn jump_points_of_all(
        &self,
        axial: &AxialStops,
        change: &Change,
        rows: &PlaneRows,
        dead_ends: &mut DeadEndRows,
    ) -> Result<Vec<JumpPoint>, Interrupted> {
        let (zones, reach) = (Zone::of_change::<P>(change), self.reach as i32);
        let near = Near::new(&zones, NEAR, (self.map, NEAR_TILE));
        let mut tiles = Tiles::new(self.map, REACH_TILE);
        zones.iter().for_each(|zone| tiles.add(zone.grown(reach, reach)));
        let ends = EndRows::on(change.before(), self.graph, self.interrupt)?;
        let before = Leads::new(&ends, &DeadEndRows::default(), self.interrupt)?;
        let mut new = vec![0; ends.per_row];
        for y in (0..=self.map.last.y).step_by(1 << REACH_TILE) {
            self.interrupt.check(DURING)?;
            let last = y + (1 << REACH_TILE) - 1;
            new.fill(0);
            (y..=last.min(self.map.last.y)).for_each(|y| rows.leads.add_new(&before, y as usize, &mut new));
            for (bits, x) in new.iter().zip((0..).step_by(64)).filter(|(bits, _)| **bits != 0) {
                let [from, to] = [bits.trailing_zeros(), 63 - bits.leading_zeros()].map(|bit| x + bit as i32);
                let zone = Zone { first: Vertex::new(from, y), last: Vertex::new(to, last) };
                tiles.add(zone.grown(reach, reach));
            }
        }
        let mut points = Vec::new();
        for quarter in self.quarters() {
            self.interrupt.check(DURING)?;
            axial.for_each_jump_point_of_map(quarter, |point| {
                let is_looked_at = if point.is_dead_end {
                    dead_ends.add(point.at, quarter);
                    tiles.hold(point.at)
                } else {
                    near.holds(point.at)
                };
                if is_looked_at {
                    points.push(point);
                }
            });
        }
        let changed = self.changed(axial, points, Some(rows))?;
        for &JumpPoint { at, quarter, is_dead_end } in &changed {
            if is_dead_end {
                dead_ends.add(at, quarter);
            } else {
                dead_ends.remove(at, quarter);
            }
        }
        Ok(changed)
    }

    /// The ones of these jump points that are dead ends and were none, or the other way.
    fn changed(
        &self,
        axial: &AxialStops,
        points: Vec<JumpPoint>,
        rows: Option<&PlaneRows>,
    ) -> Result<Vec<JumpPoint>, Interrupted> {
        let finder = DeadEndFinder { graph: self.graph, table: self.table, rows, reach: self.reach };
        let mut changed = Vec::new();
        for (number, point) in points.into_iter().enumerate() {
            self.interrupt.check_every(64, number, DURING)?;
            let is_dead_end = finder.holds(axial, point.at, point.quarter);
            if is_dead_end != point.is_dead_end {
                changed.push(JumpPoint { is_dead_end, ..point });
            }
        }
        Ok(changed)
    }

    /// Sets the bits of the diagonal planes that change because from some vertices of a line jumps lead
    /// elsewhere.
    fn set_line(
        &self,
        axial: &AxialStops,
        (line, bits, answers): (LineWord, u64, Answers),
        edit: &mut DiagonalEdit<'_>,
    ) {
        let (even, last) = (self.even(line.quarter), self.graph.steps().len() - 1);
        // The jump is the first one beside the next odd move, and the second one beside the last.
        let [next, previous] = [even + 1, even + last].map(|odd| odd & last);
        let beside = [(0, next, even + 2), (1, previous, even + last - 1)];
        let bits = bits & line.within(self.map);
        let may_force = self.table.diagonals_may_force();
        for (i, index, other) in beside {
            let (plane, other) = (edit.plane(index), self.quarter(other & last));
            line.for_each(bits, |at, bit| {
                let answer = answers.of(bit);
                edit.change(plane.place(at), |known| {
                    let [stops, first, second] = known;
                    // A vertex that the diagonal jump cannot enter stops it, and no jump leads on from there.
                    let is_known = !may_force && (!stops | first | second);
                    let is_forced = if is_known {
                        false
                    } else {
                        let here = self.here(self.graph.grid(), at).by(index);
                        if !here.enters {
                            return known;
                        }
                        here.forced
                    };
                    let leads_beside = if i == 0 { second } else { first };
                    // If that jump passed dead ends to a jump point, it was said to stop this one.
                    let passes = || self.reach == 0 || stops && axial.scan(at, other, false).found;
                    let stops = is_forced || answer.live || leads_beside && passes();
                    if i == 0 { [stops, answer.any, second] } else { [stops, first, answer.any] }
                });
            });
        }
    }

    /// Sets those bits of a zone in the diagonal planes that the pattern of cells decides.
    fn set_zone(&self, axial: &AxialStops, (before, zone): (&Grid, Zone), edit: &mut DiagonalEdit<'_>) {
        for at in zone.vertices() {
            let [was, is] = [before, self.graph.grid()].map(|grid| self.here(grid, at));
            if was.pattern == is.pattern {
                continue;
            }
            for index in (1..self.graph.steps().len()).step_by(2) {
                let here = is.by(index);
                if here == was.by(index) {
                    continue;
                }
                let beside = [index - 1, (index + 1) % self.graph.steps().len()];
                edit.change(edit.plane(index).place(at), |_| {
                    if !here.enters {
                        return [true, false, false];
                    }
                    let scan =
                        |even, with_dead_ends| axial.scan(at, self.quarter(even), with_dead_ends).found;
                    let any = beside.map(|even| scan(even, true));
                    let is_live = |i: usize| any[i] && (self.reach == 0 || scan(beside[i], false));
                    [here.forced || is_live(0) || is_live(1), any[0], any[1]]
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

/// The number of vertices of a word from which the answer is another one.
fn others([was, is]: [Answers; 2]) -> u64 {
    (was.any ^ is.any | was.live ^ is.live).count_ones().into()
}

/// The words that hold vertices as jumps in a direction find them, in order.
fn words_of(axial: &AxialStops, found: &[(Vertex, usize)]) -> Vec<usize> {
    let mut words: Vec<_> = found.iter().map(|&(at, quarter)| axial.word_of(at, quarter)).collect();
    // Most of them follow one another.
    words.dedup();
    words.sort_unstable();
    words.dedup();
    words
}

#[cfg(test)]
mod tests;
