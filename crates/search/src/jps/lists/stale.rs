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
//! Diagonals are gone back 64 vertices at a time. Which of them have lists is then said by a word.
//!
//! More lists may be found than are stale: those that are made again and are the same stay where they are.

use mediant_grid::{Footprint, GridGraph, Interrupt, Placement, Vector, Vertex};

use super::{
    super::{
        DURING,
        axial::{AxialStops, Finding},
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

/// Vertices where a diagonal jump is altered if it comes there, for each odd move.
type Marks = [Vec<Mark>; 4];

impl<P: Placement> Stale<'_, P> {
    /// All stale lists, and places near the change where lists may begin to be. In order, each once.
    pub(super) fn find(mut self, altered: &Altered) -> Result<Vec<Arrival>, Stop> {
        let (mut found, mut marks) = (Vec::new(), Marks::default());
        let moves = self.graph.steps().len();
        for zone in &altered.zones {
            self.interrupt.check(DURING)?;
            for at in zone.vertices() {
                (0..moves).step_by(2).for_each(|by| self.add_changed(at, by, &mut found));
                marks.iter_mut().take(moves / 2).for_each(|marks| mark(marks, at));
            }
        }
        for (number, &(at, quarter)) in altered.found.iter().enumerate() {
            self.interrupt.check_every(64, number, DURING)?;
            let even = quarter << (self.graph.k().get() - 2);
            self.add_changed(at, even, &mut found);
            self.go_back((at, quarter), even, (&mut found, &mut marks))?;
        }
        for (i, marks) in marks.into_iter().enumerate() {
            if !marks.is_empty() {
                self.interrupt.check(DURING)?;
                self.sweep(2 * i + 1, marks, &mut found)?;
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

    /// Goes back along a row or column from a vertex that axial jumps find otherwise.
    fn go_back(
        &mut self,
        (from, quarter): (Vertex, usize),
        even: usize,
        (found, marks): (&mut Vec<Arrival>, &mut Marks),
    ) -> Result<(), Stop> {
        let (last, map) = (self.graph.steps().len() - 1, Zone::map::<P>(self.graph.grid()));
        let back = -self.graph.step(even).vector();
        let [was, is] = self.axial;
        let findings = |at| was.findings(is, at, quarter);
        // Otherwise lists say of jumps that end before it how often their move can be repeated, as before.
        let is_wall = findings(from).iter().filter(|&&end| end == Finding::Blocked).count() == 1;
        let (mut at, mut is_reached) = (from + back, true);
        while map.holds(at) {
            self.spend(1)?;
            self.add(at, even, found);
            if is_reached {
                for odd in [even + 1, even + last] {
                    mark(&mut marks[(odd & last) / 2], at);
                }
            }
            let ends = findings(at);
            is_reached &= ends.iter().any(|end| !matches!(end, Finding::Blocked | Finding::JumpPoint));
            if ends == [Finding::Blocked; 2] || !is_reached && !is_wall {
                break;
            }
            at = at + back;
        }
        Ok(())
    }

    /// Adds a vertex that has a list, or may need one.
    fn add_changed(&self, at: Vertex, by: usize, found: &mut Vec<Arrival>) {
        let Some(arrival) = self.lists.arrival(self.graph, at, by) else { return };
        let findings = || self.axial[1].findings(self.axial[1], at, by >> (self.graph.k().get() - 2));
        if self.lists.has(arrival) || findings()[0] == Finding::JumpPoint {
            found.push(arrival);
        }
    }

    /// Adds the lists of a vertex that hold jumps by a move.
    fn add(&self, at: Vertex, index: usize, found: &mut Vec<Arrival>) {
        for by in (0..self.graph.steps().len()).step_by(2) {
            let arrival = self.lists.arrival(self.graph, at, by).filter(|&arrival| self.lists.has(arrival));
            found.extend(arrival.filter(|_| self.goes_on(at, by, index)));
        }
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
            // Each word after the one that the jump enters next.
            sort(&mut marks, [1, -v.x]);
            return self.sweep_rows(odd, &step, (&joined(marks), found));
        }
        sort(&mut marks, [-v.y, 1]);
        let marks = joined(marks);
        let mut rest = marks.iter().peekable();
        let (mut row, mut before): (Vec<Mark>, Vec<Mark>) = (Vec::new(), Vec::new());
        while let Some(&&Mark { mut y, .. }) = rest.peek() {
            loop {
                let known = row.len();
                row.extend(std::iter::from_fn(|| rest.next_if(|mark| mark.y == y)));
                if known > 0 && row.len() > known {
                    sort(&mut row, [1, 1]);
                    row = joined(row);
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
                row.iter().for_each(|&mark| self.add_word(mark, odd, found));
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
                    self.add_word(at, odd, found);
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
    fn add_word(&self, Mark { y, word, bits }: Mark, index: usize, found: &mut Vec<Arrival>) {
        let first = Vertex::new(64 * word, y);
        for by in (0..self.graph.steps().len()).step_by(2) {
            let Some((place, shift)) = self.lists.arrival(self.graph, first, by) else { continue };
            let of = |place: usize| self.lists.places.get(place).map_or(0, |place| place.bits());
            let mut left = bits & (of(place) >> shift | of(place + 1) << 1 << (63 - shift));
            while left != 0 {
                let bit = left.trailing_zeros();
                left &= left - 1;
                if self.goes_on(Vertex::new(first.x + bit as i32, y), by, index) {
                    let bit = shift + bit;
                    found.push((place + bit as usize / 64, bit % 64));
                }
            }
        }
    }
}

/// Sorts marks by their rows, then by their words; −1 for descending.
fn sort(marks: &mut [Mark], [down, right]: [i32; 2]) {
    marks.sort_unstable_by_key(|mark| (down * mark.y, right * mark.word));
}

fn mark(marks: &mut Vec<Mark>, at: Vertex) {
    let (word, bits) = (at.x >> 6, 1 << (at.x & 63));
    match marks.last_mut() {
        Some(last) if (last.y, last.word) == (at.y, word) => last.bits |= bits,
        _ => marks.push(Mark { y: at.y, word, bits }),
    }
}

/// One mark for each word, from marks in order.
fn joined(mut marks: Vec<Mark>) -> Vec<Mark> {
    marks.dedup_by(|next, mark| {
        let is_same = (next.y, next.word) == (mark.y, mark.word);
        if is_same {
            mark.bits |= next.bits;
        }
        is_same
    });
    marks
}
