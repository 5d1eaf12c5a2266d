//! Which jump lists an edit of the map makes wrong.
//!
//! A list says where jumps from its jump point lead. An axial jump is altered only if it comes to a vertex
//! that axial jumps find otherwise than before. A diagonal jump is altered only if it comes to a vertex
//! around which the pattern of cells changes, or from which one of the two axial jumps beside it is altered.
//! So all stale lists are found by going back against the jumps: along rows and columns from the vertices
//! that are found otherwise, and from there along diagonals, as long as the jumps can pass. (Where the change
//! alters whether they can, the vertex before is looked at, too: the cells between belong to the patterns of
//! both.)
//!
//! Each vertex that is found otherwise is gone back from until the next one, which goes on from there. What
//! that comes to is put together by rows, and all the rest is done 64 vertices at a time: diagonals are gone
//! back, and a word says which vertices have lists.
//!
//! More lists may be found than are stale: those that are made again and are the same stay where they are.

use mediant_grid::{Footprint, GridGraph, Interrupt, Placement, Vector, Vertex};

use super::{
    super::{
        DURING,
        axial::{AxialStops, Finding, JumpPointRule},
        repair::{Altered, Stop},
        stop_rows::{carried, holds},
        zone::Zone,
    },
    JumpLists,
};
use crate::canonical::{PatternTable, pattern_at};

/// A vertex and the even move by which a path arrives there: the number of a place, and a bit in it.
pub(super) type Arrival = (usize, u32);

/// Finds stale lists.
pub(super) struct Stale<'s, P: Placement> {
    pub(super) lists: &'s JumpLists,
    pub(super) graph: &'s GridGraph<P>,
    pub(super) table: &'s PatternTable,
    /// Where axial jumps stop before the change, and after it.
    pub(super) axial: [&'s AxialStops; 2],
    pub(super) interrupt: &'s Interrupt,
    /// The number of vertices, and of words of diagonals, that it may still look at.
    pub(super) left: usize,
}

/// 64 vertices of a row, by the number of their word, and some of them.
#[derive(Clone, Copy, Debug)]
struct Mark {
    y: i32,
    word: i32,
    bits: u64,
}

/// From most vertices that are found otherwise it goes back at least so far.
const LEAST_STEPS: usize = 4;
/// Marks are put in order by a map of all words, if there is one of them for so many words.
const WORDS_A_MARK: usize = 16;

impl<P: Placement> Stale<'_, P> {
    /// All stale lists, and places near the change where lists may begin to be. In order, each once.
    pub(super) fn find(mut self, altered: &Altered) -> Result<Vec<Arrival>, Stop> {
        let moves = self.graph.steps().len();
        let mut found = Vec::new();
        let mut zones = Vec::new();
        for zone in &altered.zones {
            for y in zone.first.y..=zone.last.y {
                for word in zone.first.x >> 6..=zone.last.x >> 6 {
                    let (from, to) = ((zone.first.x - 64 * word).max(0), (zone.last.x - 64 * word).min(63));
                    mark(&mut zones, Mark { y, word, bits: !0 << from & !0 >> (63 - to) });
                }
            }
        }
        let zones = self.joined(zones);
        self.spend(zones.len() + altered.found.len() * LEAST_STEPS)?;
        self.left += altered.found.len() * LEAST_STEPS;
        for (number, &mark) in zones.iter().enumerate() {
            self.interrupt.check_every(64, number, DURING)?;
            self.add_changed(mark, &mut found);
        }
        // The vertices from which an even move comes to one that is found otherwise.
        let mut reached = [const { Vec::new() }; 4];
        for (number, &(at, quarter)) in altered.found.iter().enumerate() {
            self.interrupt.check_every(64, number, DURING)?;
            self.go_back((at, quarter), &mut reached[quarter], &mut found)?;
        }
        let reached = reached.map(|marks| self.joined(marks));
        for even in (0..moves).step_by(2) {
            let marks = &reached[self.quarter(even)];
            self.interrupt.check(DURING)?;
            marks.iter().for_each(|&mark| self.add(mark, even, &mut found));
        }
        for odd in (1..moves).step_by(2) {
            self.interrupt.check(DURING)?;
            let beside = [odd - 1, (odd + 1) % moves].map(|even| &*reached[self.quarter(even)]);
            let marks = [&zones, beside[0], beside[1]].concat();
            if !marks.is_empty() {
                let marks = self.joined(marks);
                self.sweep(odd, marks, &mut found)?;
            }
        }
        found.sort_unstable();
        found.dedup();
        Ok(found)
    }

    fn spend(&mut self, work: usize) -> Result<(), Stop> {
        self.left = self.left.checked_sub(work).ok_or(Stop::TooMuch)?;
        Ok(())
    }

    /// The direction of an even move.
    fn quarter(&self, even: usize) -> usize {
        even >> (self.graph.k().get() - 2)
    }

    /// Marks by rows and words, one for each word.
    fn joined(&self, mut marks: Vec<Mark>) -> Vec<Mark> {
        let (width, height) = P::vertices(self.graph.grid());
        let per_row = width.div_ceil(64) as usize;
        let words = per_row * height as usize;
        if marks.len() * WORDS_A_MARK < words {
            marks.sort_unstable_by_key(|mark| (mark.y, mark.word));
            marks.dedup_by(|next, mark| {
                let is_same = (next.y, next.word) == (mark.y, mark.word);
                if is_same {
                    mark.bits |= next.bits;
                }
                is_same
            });
            return marks;
        }
        let mut map = vec![0; words];
        for &Mark { y, word, bits } in &marks {
            map[y as usize * per_row + word as usize] |= bits;
        }
        marks.clear();
        for (y, row) in (0..).zip(map.chunks_exact(per_row)) {
            let row = (0..).zip(row).filter(|&(_, &bits)| bits != 0);
            marks.extend(row.map(|(word, &bits)| Mark { y, word, bits }));
        }
        marks
    }

    /// Goes back along a row or column from a vertex that axial jumps find otherwise. Marks the vertices from
    /// which they come there.
    fn go_back(
        &mut self,
        (from, quarter): (Vertex, usize),
        reached: &mut Vec<Mark>,
        found: &mut Vec<Arrival>,
    ) -> Result<(), Stop> {
        let (even, map) = (quarter << (self.graph.k().get() - 2), Zone::map::<P>(self.graph.grid()));
        let [was, is] = self.axial;
        let findings = |at| was.findings(is, at, quarter);
        let ends = findings(from);
        if ends[0] == ends[1] {
            // A dead end as before, near the change.
            return Ok(());
        }
        let arrival = self.lists.arrival(self.graph, from, even);
        found.extend(arrival.filter(|&arrival| ends[1] == Finding::JumpPoint || self.lists.has(arrival)));
        // Otherwise lists say of jumps that end before it how often their move can be repeated, as before.
        let is_blocked = |ends: [Finding; 2]| ends.map(|end| end == Finding::Blocked);
        let is_wall = |ends| matches!(is_blocked(ends), [true, false] | [false, true]);
        let back = -self.graph.step(even).vector();
        let (is_wall_there, mut at, mut is_reached) = (is_wall(ends), from + back, true);
        while map.holds(at) {
            self.spend(1)?;
            let here = Mark { y: at.y, word: at.x >> 6, bits: 1 << (at.x & 63) };
            if is_reached {
                mark(reached, here);
            } else {
                self.add(here, even, found);
            }
            let ends = findings(at);
            is_reached &= ends.iter().any(|end| !matches!(end, Finding::Blocked | Finding::JumpPoint));
            // The vertex here may be one from which to go back, as far.
            let goes_on = ends[0] != ends[1] && (is_wall(ends) || !is_wall_there);
            if goes_on || is_blocked(ends) == [true; 2] || !is_reached && !is_wall_there {
                break;
            }
            at = at + back;
        }
        Ok(())
    }

    /// Adds the vertices near the change that have lists, or may need one.
    fn add_changed(&self, Mark { y, word, bits }: Mark, found: &mut Vec<Arrival>) {
        let rule = JumpPointRule::of(self.graph);
        for (by, lists) in self.lists_of(64 * word, y) {
            let v = self.graph.step(by).vector();
            let ends = rule.ends_in_row::<P>(self.graph.grid().rows(), (64 * word, y), v);
            let left = bits & (ends.jump & !ends.dead | lists.bits);
            found.extend(bits_of(left).map(|bit| lists.arrival(bit)));
        }
    }

    /// The lists of 64 vertices of a row, for each even move by which a path arrives.
    fn lists_of(&self, x: i32, y: i32) -> impl Iterator<Item = (usize, RowLists)> {
        let first = self.lists.arrival(self.graph, Vertex::new(x, y), 0);
        let of = |place: usize| self.lists.places.get(place).map_or(0, |place| place.bits());
        first.into_iter().flat_map(move |(place, shift)| {
            (0..self.graph.steps().len()).step_by(2).map(move |by| {
                let place = place + by / 2 * self.lists.per_move;
                let bits = of(place) >> shift | of(place + 1) << 1 << (63 - shift);
                (by, RowLists { place, shift, bits })
            })
        })
    }

    /// Whether a path that arrives at a vertex by one move goes on by another. (Where the pattern changes,
    /// all lists are looked at.)
    fn goes_on(&self, at: Vertex, by: usize, index: usize) -> bool {
        self.table.successors(by, pattern_at(self.graph, at)) >> index & 1 == 1
    }

    /// Adds the lists of vertices from which the diagonal jump by an odd move comes to one of the marks.
    fn sweep(&mut self, odd: usize, mut marks: Vec<Mark>, found: &mut Vec<Arrival>) -> Result<(), Stop> {
        let v = self.graph.step(odd).vector();
        let step = (v, Footprint::new::<P>(self.graph.rule(), v));
        if v.y == 0 {
            if v.x > 0 {
                // Each word after the one that the jump enters next.
                marks.reverse();
            }
            return self.sweep_rows(odd, &step, (&marks, found));
        }
        let mut rows: Vec<&[Mark]> = marks.chunk_by(|one, next| one.y == next.y).collect();
        if v.y > 0 {
            rows.reverse();
        }
        let mut rest = rows.into_iter().peekable();
        let (mut row, mut before): (Vec<Mark>, Vec<Mark>) = (Vec::new(), Vec::new());
        while let Some(&&[Mark { mut y, .. }, ..]) = rest.peek() {
            loop {
                if let Some(marks) = rest.next_if(|marks| marks[0].y == y) {
                    if row.is_empty() {
                        row.extend_from_slice(marks);
                    } else {
                        join(&mut row, marks);
                    }
                }
                self.spend(row.len())?;
                y -= v.y;
                before.clear();
                for &mark in &row {
                    let bits = mark.bits & self.enters(&step, mark);
                    let parts = if v.x > 0 {
                        [(mark.word - 1, bits << 63), (mark.word, bits >> 1)]
                    } else {
                        [(mark.word, bits << 1), (mark.word + 1, bits >> 63)]
                    };
                    for (word, bits) in parts {
                        let bits = bits & self.in_row(y, word);
                        match before.last_mut() {
                            _ if bits == 0 => {}
                            Some(last) if last.word == word => last.bits |= bits,
                            _ => before.push(Mark { y, word, bits }),
                        }
                    }
                }
                std::mem::swap(&mut row, &mut before);
                if row.is_empty() {
                    break;
                }
                row.iter().for_each(|&mark| self.add(mark, odd, found));
            }
        }
        Ok(())
    }

    /// The same for jumps along rows (k = 2).
    fn sweep_rows(
        &mut self,
        odd: usize,
        step: &(Vector, Footprint),
        (marks, found): (&[Mark], &mut Vec<Arrival>),
    ) -> Result<(), Stop> {
        let is_forward = step.0.x > 0;
        // Back is towards the low bits.
        let turned = |bits: u64| if is_forward { bits } else { bits.reverse_bits() };
        for marks in marks.chunk_by(|one, next| one.y == next.y) {
            let mut rest = marks.iter().peekable();
            while let Some(&&mark) = rest.peek() {
                let (mut at, mut carry) = (mark, 0);
                loop {
                    self.spend(1)?;
                    let marked =
                        rest.next_if(|mark| mark.word == at.word).map_or(0, |mark| turned(mark.bits));
                    let enters = turned(self.enters(step, at));
                    let bits = carried::<true>((marked & enters) >> 1 | carry << 63, enters >> 1);
                    carry = (marked | bits) & enters & 1;
                    at.bits = turned(bits) & self.in_row(at.y, at.word);
                    self.add(at, odd, found);
                    at.word -= step.0.x;
                    if carry == 0 || self.in_row(at.y, at.word) == 0 {
                        break;
                    }
                }
            }
        }
        Ok(())
    }

    /// Of 64 vertices those that a move can enter.
    fn enters(&self, (v, step): &(Vector, Footprint), Mark { y, word, .. }: Mark) -> u64 {
        holds(self.graph.grid().rows(), (64 * word - v.x, y - v.y), &step.free, &step.either)
    }

    /// Of 64 vertices of a row those on the map.
    fn in_row(&self, y: i32, word: i32) -> u64 {
        let (width, height) = P::vertices(self.graph.grid());
        let left = i64::from(width) - 64 * i64::from(word);
        if word < 0 || left <= 0 || !(0..height as i32).contains(&y) {
            return 0;
        }
        !0 >> (64 - left.min(64))
    }

    /// Adds the lists of 64 vertices that hold jumps by a move.
    fn add(&self, Mark { y, word, bits }: Mark, index: usize, found: &mut Vec<Arrival>) {
        for (by, lists) in self.lists_of(64 * word, y) {
            let held = bits_of(bits & lists.bits)
                .filter(|&bit| self.goes_on(Vertex::new(64 * word + bit as i32, y), by, index));
            found.extend(held.map(|bit| lists.arrival(bit)));
        }
    }
}

/// The lists of 64 vertices of a row: the place of the first of them, and its bit there.
#[derive(Clone, Copy, Debug)]
struct RowLists {
    place: usize,
    shift: u32,
    bits: u64,
}

impl RowLists {
    fn arrival(self, bit: u32) -> Arrival {
        let bit = self.shift + bit;
        (self.place + bit as usize / 64, bit % 64)
    }
}

/// The numbers of the bits that are set.
fn bits_of(mut left: u64) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let bit = (left != 0).then(|| left.trailing_zeros());
        left &= left.wrapping_sub(1);
        bit
    })
}

fn mark(marks: &mut Vec<Mark>, new: Mark) {
    match marks.last_mut() {
        Some(last) if (last.y, last.word) == (new.y, new.word) => last.bits |= new.bits,
        _ => marks.push(new),
    }
}

/// Adds marks of the same row. Both are in order.
fn join(row: &mut Vec<Mark>, marks: &[Mark]) {
    let mut at = 0;
    for &mark in marks {
        while row.get(at).is_some_and(|known| known.word < mark.word) {
            at += 1;
        }
        match row.get_mut(at) {
            Some(known) if known.word == mark.word => known.bits |= mark.bits,
            _ => row.insert(at, mark),
        }
    }
}
