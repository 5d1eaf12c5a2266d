//! The labels of all subgoals while they are made: 16 bytes each.
//!
//! A label is two words. The first has the hub, and above it the part of the cost that is kept; the second
//! has the next subgoal, and above it the rest of the cost. So first words in order are labels in the order
//! of their costs. The lists of many subgoals lie in one piece of memory.

use mediant_grid::{Interrupted, room_for};

use super::{
    merge::Label,
    pack::{cost_bits_of, most_cost},
};

/// The bits of the two words of a label.
#[derive(Clone, Copy, Debug)]
pub(super) struct Form {
    /// The bits of the numbers of subgoals.
    id_bits: u32,
    /// The bits of a cost that are not kept.
    rest_bits: u32,
}

impl Form {
    /// The form for so many subgoals, where the labels that are kept have not the last bits of costs.
    pub(super) fn new(count: usize, rest_bits: u32) -> Self {
        Self { id_bits: u64::BITS - cost_bits_of(count), rest_bits }
    }

    /// The part of a cost that is kept.
    #[inline]
    pub(super) const fn kept(self, cost: u128) -> u64 {
        (cost >> self.rest_bits) as u64
    }

    /// The words of a label; `None` if its cost is too large.
    #[inline]
    pub(super) fn words(self, label: Label) -> Option<[u64; 2]> {
        let bits = u64::BITS - self.id_bits;
        let (kept, rest) = (label.cost() >> self.rest_bits, label.cost() & ((1 << self.rest_bits) - 1));
        let fits = kept <= most_cost(bits).into() && rest >> bits == 0;
        fits.then(|| [self.first_word(label.hub, kept as u64), self.first_word(label.next, rest as u64)])
    }

    /// The word of a subgoal and a part of a cost.
    #[inline]
    pub(super) const fn first_word(self, id: u32, part: u64) -> u64 {
        part << self.id_bits | id as u64
    }

    /// The subgoal of a word.
    #[inline]
    pub(super) const fn id(self, word: u64) -> u32 {
        (word & ((1 << self.id_bits) - 1)) as u32
    }

    /// The part of a cost in a word.
    #[inline]
    pub(super) const fn part(self, word: u64) -> u64 {
        word >> self.id_bits
    }

    /// The cost of a label.
    #[inline]
    pub(super) const fn cost(self, [kept, rest]: [u64; 2]) -> u128 {
        (self.part(kept) as u128) << self.rest_bits | self.part(rest) as u128
    }

    /// The label of two words.
    #[inline]
    pub(super) const fn label(self, words: [u64; 2]) -> Label {
        Label::new(self.id(words[0]), self.id(words[1]), self.cost(words))
    }

    /// The word that queries read: the hub is above the cost.
    #[inline]
    pub(super) const fn packed(self, word: u64) -> u64 {
        word.rotate_right(self.id_bits)
    }

    /// The first word of what queries read.
    #[inline]
    pub(super) const fn unpacked(self, word: u64) -> u64 {
        word.rotate_left(self.id_bits)
    }
}

/// The labels of all subgoals.
#[derive(Debug)]
pub(super) struct LabelLists {
    pub(super) form: Form,
    places: Vec<Place>,
    pieces: Vec<Piece>,
}

/// The place of a subgoal's labels.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    piece: u32,
    first: u32,
    length: u32,
}

/// The labels of several subgoals.
#[derive(Debug)]
struct Piece {
    /// The subgoals that have labels here, in the order in which they were added.
    ids: Vec<u32>,
    words: [Vec<u64>; 2],
}

/// The labels of one subgoal.
#[derive(Clone, Copy, Debug)]
pub(super) struct LabelList<'l> {
    form: Form,
    /// The first and the second words.
    pub(super) words: [&'l [u64]; 2],
}

impl LabelList<'_> {
    /// One of the labels.
    #[inline]
    pub(super) fn get(&self, number: usize) -> Label {
        self.form.label(self.words.map(|words| words[number]))
    }
}

/// The labels of a piece, unless one subgoal has more: 32 MB each half, which systems give back when they are
/// freed.
const MOST: usize = 1 << 22;

impl LabelLists {
    /// No labels of so many subgoals.
    pub(super) fn new(count: usize, form: Form) -> Self {
        Self { form, places: vec![Place::default(); count], pieces: Vec::new() }
    }

    /// The number of subgoals.
    pub(super) const fn len(&self) -> usize {
        self.places.len()
    }

    /// The number of labels.
    pub(super) fn total(&self) -> usize {
        self.places.iter().map(|place| place.length as usize).sum()
    }

    /// The labels of a subgoal.
    #[inline]
    pub(super) fn of(&self, id: u32) -> LabelList<'_> {
        let Place { piece, first, length } = self.places[id as usize];
        let (first, end) = (first as usize, (first + length) as usize);
        // A subgoal without labels has no piece.
        let words = self
            .pieces
            .get(piece as usize)
            .map_or([&[][..]; 2], |piece| piece.words.each_ref().map(|words| &words[first..end]));
        LabelList { form: self.form, words }
    }

    /// Asks for the memory of as many labels again, or of the next piece.
    pub(super) fn check_room(&self, during: &'static str) -> Result<(), Interrupted> {
        let kept = self.pieces.last().map_or(0, |piece| piece.words[0].len());
        let next = if self.pieces.len() > 1 { MOST } else { 2 * kept };
        room_for::<[u64; 2]>(next, during)
    }

    /// Adds the labels of a subgoal that has none yet.
    pub(super) fn add(&mut self, id: u32, words: [&[u64]; 2]) {
        let length = words[0].len();
        if length == 0 {
            return;
        }
        if self.pieces.last().is_none_or(|piece| piece.words[0].len() + length > MOST) {
            // The first one grows, so that few labels take little.
            let room = if self.pieces.is_empty() { 0 } else { MOST.max(length) };
            self.pieces.push(Piece { ids: Vec::new(), words: [(); 2].map(|()| Vec::with_capacity(room)) });
        }
        let number = self.pieces.len() as u32 - 1;
        if let Some(piece) = self.pieces.last_mut() {
            let first = piece.words[0].len() as u32;
            self.places[id as usize] = Place { piece: number, first, length: length as u32 };
            piece.ids.push(id);
            piece.words.iter_mut().zip(words).for_each(|(all, own)| all.extend_from_slice(own));
        }
    }

    /// Drops some labels of a subgoal: those with these numbers, which ascend.
    pub(super) fn drop_some(&mut self, id: u32, numbers: &[u32]) {
        let Place { piece, first, length } = &mut self.places[id as usize];
        let mut dropped = 0;
        for words in &mut self.pieces[*piece as usize].words {
            let own = &mut words[*first as usize..(*first + *length) as usize];
            let mut numbers = numbers.iter().copied().peekable();
            let mut kept = 0;
            for number in 0..own.len() {
                if numbers.next_if_eq(&(number as u32)).is_none() {
                    own[kept] = own[number];
                    kept += 1;
                }
            }
            dropped = own.len() - kept;
        }
        *length -= dropped as u32;
    }

    /// Changes the words of each subgoal's labels, on all cores; stops at the first error.
    pub(super) fn arrange<S, E: Send>(
        &mut self,
        scratch: impl Fn() -> S + Send + Sync,
        arrange: impl Fn(&mut S, u32, [&mut [u64]; 2]) -> Result<(), E> + Send + Sync,
    ) -> Result<(), E> {
        let Self { pieces, places, .. } = self;
        let work = |piece: &mut Piece| {
            let mut scratch = scratch();
            let [kept, rest] = &mut piece.words;
            piece.ids.iter().try_for_each(|&id| {
                let Place { first, length, .. } = places[id as usize];
                let own = first as usize..(first + length) as usize;
                arrange(&mut scratch, id, [&mut kept[own.clone()], &mut rest[own]])
            })
        };
        #[cfg(feature = "parallel")]
        if mediant_grid::threads::are_there() {
            use rayon::prelude::*;
            return pieces.par_iter_mut().try_for_each(work);
        }
        pieces.iter_mut().try_for_each(work)
    }

    /// The first words alone.
    pub(super) fn into_first_words(self) -> FirstWords {
        let Self { form, places, pieces, .. } = self;
        let pieces = pieces.into_iter().map(|Piece { words: [first, _], .. }| first).collect();
        FirstWords { form, places, pieces }
    }
}

/// The first words of all labels.
#[derive(Debug)]
pub(super) struct FirstWords {
    pub(super) form: Form,
    places: Vec<Place>,
    pieces: Vec<Vec<u64>>,
}

impl FirstWords {
    /// The words of each subgoal's labels.
    pub(super) fn iter(&self) -> impl Iterator<Item = &[u64]> {
        self.places.iter().map(|&Place { piece, first, length }| {
            let words = self.pieces.get(piece as usize).map_or(&[][..], |words| &words[..]);
            words.get(first as usize..(first + length) as usize).unwrap_or_default()
        })
    }
}
