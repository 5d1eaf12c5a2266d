//! Jump lists after an edit of the map, by work that follows what the edit alters.
//!
//! [Stale](super::stale) lists are made again, and jump points that come to be get lists. A list that is no
//! longer than the old one takes its place; others go behind all that are there. When there is no more room,
//! the lists are copied, with room for others, and put together again if many are no longer in use.
//!
//! There is a floor: of the lists that are found, 77 to 99 in 100 do change where 500 scattered cells of
//! 512 × 512 in rooms do, and these are half of all or more. To find a list and to make it again takes about
//! four times as long as to make one among all. So the search for stale lists has a limit, which follows what
//! it takes to make all lists anew, and a first estimate may say that it would be reached. Beyond it, all are
//! made anew on the planes that followed the change. Figures: `docs/measurements/search.md`.

use mediant_grid::{GridGraph, Interrupt, Interrupted, Placement, VersionEdit, Versioned, Vertex, VertexId};

use super::{
    super::{
        DURING,
        axial::{AxialStops, Finding},
        dead_ends::DeadEndRows,
        repair::{Altered, Stop},
        zone::Zone,
    },
    JumpLists, Place, Recorder, list_from,
    stale::{Arrival, Stale},
};
use crate::{canonical::prunes, successors::ExpandedNode};

/// One list of so many may be made again; if more are stale, all are made anew as quickly.
const STALE: usize = 2;
/// So many may be in any case.
const FEW_STALE: usize = 64;
/// So many words are looked at (25 ns) where all lists are made anew in twice the time, for each of these
/// lists,
const WORDS_A_LIST: usize = 3;
/// and one more for so many vertices of the map, which are searched for jump points.
const VERTICES_A_WORD: usize = 64;
/// So many words may be looked at in any case.
const FEW_WORDS: usize = 1 << 10;
/// Lists that are put together get room for one word more of so many.
const ROOM: usize = 4;
const LEAST_ROOM: usize = 256;
/// They stay as they are if one word of so many is no longer in use.
const DEAD: usize = 8;

/// A list that was made, among the words of all; none where there is none now.
struct Made {
    arrival: Arrival,
    words: std::ops::Range<usize>,
}

impl JumpLists {
    /// The place and the bit of a vertex where a path arrives by an even move; `None` beyond the map.
    #[inline]
    pub(super) fn arrival<P: Placement>(
        &self,
        graph: &GridGraph<P>,
        at: Vertex,
        by: usize,
    ) -> Option<Arrival> {
        let id = graph.id(at)?.index();
        Some((by / 2 * self.per_move + id / 64, id as u32 % 64))
    }

    /// Whether there is a list.
    pub(super) fn has(&self, (place, bit): Arrival) -> bool {
        self.places.get(place).is_some_and(|place| place.bits() >> bit & 1 == 1)
    }

    /// New lists on planes that followed a change, where [`new`](Self::new) is told of the dead ends.
    pub(in super::super) fn anew<P: Placement>(
        recorder: &Recorder<'_, P>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let (grid, mut dead_ends) = (recorder.graph.grid(), DeadEndRows::default());
        for quarter in 0..4 {
            recorder.blocks.axial_stops().for_each_jump_point(
                (Zone::map::<P>(grid), quarter),
                true,
                |point| {
                    if dead_ends.is_empty() {
                        dead_ends = DeadEndRows::new(P::vertices(grid));
                    }
                    dead_ends.add(point.at, quarter);
                },
            );
        }
        Self::new(recorder, &dead_ends, interrupt)
    }

    /// The lists after a change, which the planes of the recorder follow, with the axial planes before it.
    /// Whether there are lists at all was decided before.
    pub(in super::super) fn repaired<P: Placement>(
        &self,
        recorder: &Recorder<'_, P>,
        before: &AxialStops,
        altered: &Altered,
        interrupt: &Interrupt,
    ) -> Result<Self, Stop> {
        let lists = self.size.starts;
        let words = recorder.graph.vertex_count() / VERTICES_A_WORD + lists * WORDS_A_LIST;
        let most = [FEW_WORDS.max(words), FEW_STALE.max(lists / STALE)];
        self.repaired_within(most, recorder, (before, altered), interrupt)
    }

    /// The same, by so many words that are looked at and lists that are made again, at most.
    pub(in super::super) fn repaired_within<P: Placement>(
        &self,
        [most_words, most_lists]: [usize; 2],
        recorder: &Recorder<'_, P>,
        (before, altered): (&AxialStops, &Altered),
        interrupt: &Interrupt,
    ) -> Result<Self, Stop> {
        if !prunes(recorder.graph) {
            return Ok(Self::of_no_jumps());
        }
        if self.per_move == 0 {
            return if self.size.most == 0 { Err(Stop::TooMuch) } else { Ok(Self::none(self.size.most)) };
        }
        let stale = Stale {
            lists: self,
            graph: recorder.graph,
            table: recorder.pruning.table().ok_or(Stop::TooMuch)?,
            axial: [before, recorder.blocks.axial_stops()],
            interrupt,
            left: most_words,
        };
        let arrivals = stale.find(altered)?;
        if arrivals.len() > most_lists {
            return Err(Stop::TooMuch);
        }
        let (mut words, mut made) = (Vec::new(), Vec::with_capacity(arrivals.len()));
        for (number, arrival) in arrivals.into_iter().enumerate() {
            interrupt.check_every(64, number, DURING)?;
            let start = words.len();
            self.record(recorder, arrival, &mut words);
            made.push(Made { arrival, words: start..words.len() });
        }
        Ok(self.with(&made, &words))
    }

    /// Adds the list of a vertex where a path arrives by an even move, if it has one.
    fn record<P: Placement>(
        &self,
        recorder: &Recorder<'_, P>,
        (place, bit): Arrival,
        words: &mut Vec<u32>,
    ) -> Option<()> {
        let (graph, by) = (recorder.graph, place / self.per_move * 2);
        let id = VertexId((place % self.per_move) as u32 * 64 + bit);
        let (at, v, axial) = (graph.vertex(id), graph.step(by).vector(), recorder.blocks.axial_stops());
        let [finding, _] = axial.findings(axial, at, by >> (graph.k().get() - 2));
        let is_reached = || graph.id(at + -v).is_some() && graph.sees(at + -v, at);
        if finding != Finding::JumpPoint || !is_reached() {
            return None;
        }
        recorder.record(&ExpandedNode { id, at, by: Some(by) }, by, words)
    }

    /// These lists, where others have been made.
    fn with(&self, made: &[Made], words: &[u32]) -> Self {
        let runs = || made.chunk_by(|one, next| one.arrival.0 == next.arrival.0);
        let starts = |run: &[Made]| {
            let bits = self.places[run[0].arrival.0].bits();
            let after = run.iter().fold(bits, |bits, made| match 1 << made.arrival.1 {
                bit if made.words.is_empty() => bits & !bit,
                bit => bits | bit,
            });
            if after.count_ones() > bits.count_ones() { after.count_ones() as usize } else { 0 }
        };
        let needed = [runs().map(starts).sum(), words.len()];
        let has_room = self.size.starts + needed[0] <= self.starts.len()
            && self.size.words + needed[1] <= self.words.len();
        let Self { routes, width, per_move, size, .. } = *self;
        let mut edit = if has_room {
            let (starts, words) = (self.starts.edit(), self.words.edit());
            Edit { places: self.places.edit(), starts, words, size }
        } else {
            self.together(needed)
        };
        runs().for_each(|run| edit.replace(run, words));
        let Edit { places, starts, words, size } = edit;
        let (places, starts, words) = (places.finish(), starts.finish(), words.finish());
        Self { routes, width, places, per_move, starts, words, size }
    }

    /// An edit of these lists put together, with room for so many more starts and words, and for some edits.
    fn together(&self, needed: [usize; 2]) -> Edit {
        let mut size = self.size;
        let with_room = |used: &[u32], needed: usize| {
            let room = needed + (used.len() / ROOM).max(LEAST_ROOM);
            let mut words = Vec::with_capacity(used.len() + room);
            words.extend_from_slice(used);
            words.resize(used.len() + room, 0);
            Versioned::from(words).into_edit()
        };
        let used = size.starts + size.words;
        let (places, starts, words) = if (used - size.live) * DEAD <= used {
            let (starts, words) = (&self.starts[..size.starts], &self.words[..size.words]);
            (self.places.edit(), with_room(starts, needed[0]), with_room(words, needed[1]))
        } else {
            let (mut places, mut starts, mut words) = (self.places.edit(), Vec::new(), Vec::new());
            let mut known = usize::MAX;
            for (place, _, list) in self.all() {
                if place != known {
                    places.set(place, Place { first: starts.len() as u32, ..self.places[place] });
                    known = place;
                }
                starts.push(words.len() as u32);
                words.extend_from_slice(list);
            }
            (size.starts, size.words) = (starts.len(), words.len());
            (places, with_room(&starts, needed[0]), with_room(&words, needed[1]))
        };
        Edit { places, starts, words, size }
    }
}

/// The next version of lists while it is made.
struct Edit {
    places: VersionEdit<Place>,
    starts: VersionEdit<u32>,
    words: VersionEdit<u32>,
    size: super::Size,
}

impl Edit {
    /// Replaces lists of one place.
    fn replace(&mut self, run: &[Made], words: &[u32]) {
        let number = run[0].arrival.0;
        let place = self.places.words()[number];
        let (mut left, mut first, mut starts) = (place.bits(), place.first as usize, [0; 64]);
        while left != 0 {
            starts[left.trailing_zeros() as usize] = self.starts.words()[first];
            (left, first) = (left & (left - 1), first + 1);
        }
        let mut bits = place.bits();
        for Made { arrival: (_, bit), words: range } in run {
            let (list, start) = (&words[range.clone()], &mut starts[*bit as usize]);
            let had = bits >> bit & 1 == 1;
            let old = if had { list_from(self.words.words(), *start).len() } else { 0 };
            self.size.live -= old + usize::from(had);
            bits &= !(1 << bit);
            if list.is_empty() || self.size.live + list.len() + 2 > self.size.most {
                continue;
            }
            bits |= 1 << bit;
            self.size.live += list.len() + 1;
            if list.len() > old {
                *start = self.size.words as u32;
                self.size.words += list.len();
            }
            for (at, &word) in (*start as usize..).zip(list) {
                self.words.set(at, word);
            }
        }
        let mut place = Place::new(bits, place.first);
        if bits.count_ones() > self.places.words()[number].bits().count_ones() {
            place.first = self.size.starts as u32;
            self.size.starts += bits.count_ones() as usize;
        }
        self.places.set(number, place);
        let (mut left, mut first) = (bits, place.first as usize);
        while left != 0 {
            self.starts.set(first, starts[left.trailing_zeros() as usize]);
            (left, first) = (left & (left - 1), first + 1);
        }
    }
}
