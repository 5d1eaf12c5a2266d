//! From which vertices axial jumps come to a jump point, 64 vertices of a line at a time: from the last word
//! of a line to its first one, against the jumps.

use mediant_grid::Vertex;

use super::{AxialStops, BitPlane, LineWord, direction, vertex_of};
use crate::jps::stop_rows::carried;

/// Whether an axial jump comes to a jump point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in super::super) struct Answer {
    pub(in super::super) any: bool,
    /// Whether it does where it passes dead ends.
    pub(in super::super) live: bool,
}

/// The same of the jumps from 64 vertices of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) struct Answers {
    pub(in super::super) any: u64,
    pub(in super::super) live: u64,
}

impl Answers {
    /// The answer of a bit.
    pub(in super::super) const fn of(self, bit: u64) -> Answer {
        Answer { any: self.any & bit != 0, live: self.live & bit != 0 }
    }
}

impl AxialStops {
    /// The words of the planes that hold vertices as jumps in a direction find them.
    pub(in super::super) fn word_of(&self, at: Vertex, quarter: usize) -> usize {
        (self.planes[quarter & 3].place(at) >> 6) as usize
    }

    /// Goes back from the last of these words, which are in order, as long as jumps answer otherwise than in
    /// planes of the same size `before`, and likewise from those that it did not come to. Calls `visit` with
    /// the words from which they do, with their answers before and now.
    pub(in super::super) fn for_each_other_answer<E>(
        &self,
        before: &Self,
        words: &[usize],
        mut visit: impl FnMut(LineWord, [Answers; 2]) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut done = usize::MAX;
        for &word in words.iter().rev() {
            if word >= done {
                continue;
            }
            let Some(quarter) = self.planes.iter().position(|plane| plane.holds(word)) else { continue };
            let plane = &self.planes[quarter];
            let mut line = plane.line_word(quarter, word);
            let mut beyond = [before, self].map(|stops| stops.arriving(word + 1));
            loop {
                let [(was, first_was), (is, first_is)] = [(before, beyond[0]), (self, beyond[1])]
                    .map(|(stops, beyond)| stops.answers(line.word, beyond));
                if was != is {
                    visit(line, [was, is])?;
                }
                done = line.word;
                if first_was == first_is || done == plane.words.0 {
                    break;
                }
                let before = plane.line_word(quarter, done - 1);
                if before.place.1 != line.place.1 {
                    // That of another line.
                    break;
                }
                (line, beyond) = (before, [first_was, first_is]);
            }
        }
        Ok(())
    }

    /// The answer of a jump that arrives at the first vertex of a word, whether it goes on from there or not.
    fn arriving(&self, word: usize) -> Answer {
        let found = |mask: u64| {
            let mut words = self.words.get(word..).unwrap_or_default().iter();
            let stop = words.find_map(|&[one, other]| {
                let stops = one | other & mask;
                (stops != 0).then_some(one & other & stops & stops.wrapping_neg())
            });
            stop == Some(0)
        };
        Answer { any: found(!0), live: found(0) }
    }

    /// The answers of a word, and that of a jump that arrives at its first vertex, by that of a jump which
    /// arrives at the first vertex of the next word.
    fn answers(&self, word: usize, beyond: Answer) -> (Answers, Answer) {
        let [one, other] = self.words[word];
        let of = |stops: u64, jump: u64, beyond: bool| {
            let beyond = u64::from(beyond) << 63;
            let arriving = carried::<true>(jump | beyond & !stops, !stops);
            (arriving >> 1 | beyond, arriving & 1 == 1)
        };
        let ((any, first_any), (live, first_live)) =
            (of(one | other, one ^ other, beyond.any), of(one, one & !other, beyond.live));
        (Answers { any, live }, Answer { any: first_any, live: first_live })
    }
}

impl BitPlane {
    const fn holds(&self, word: usize) -> bool {
        self.words.0 <= word && word < self.words.1
    }

    /// A whole word of this plane, which is that of a direction.
    fn line_word(&self, quarter: usize, word: usize) -> LineWord {
        let at = self.vertex(64 * word as u64);
        let place = if quarter.is_multiple_of(2) { (at.y, at.x) } else { (at.x, at.y) };
        LineWord { quarter, word, bits: !0, place }
    }
}

impl LineWord {
    /// The vertex of a bit, which may lie outside of the map.
    pub(in super::super) const fn vertex(self, bit: u32) -> Vertex {
        let ((is_vertical, is_forward), (u, line)) = (direction(self.quarter), self.place);
        vertex_of(is_vertical, (if is_forward { u + bit as i32 } else { u - bit as i32 }, line))
    }
}
