//! Links of blocks of vertices to the subgoals that they see, about four bytes each.
//!
//! They are found by subgoals, and read by blocks. So each block has a list of words. A word is an entry of
//! the index, with a number of its mask that is not final: in the order in which masks were met.

use std::{
    collections::HashMap,
    hash::{BuildHasherDefault, Hasher},
};

use super::{EMPTY, build::FULL};

/// A link of a block and a slot: the vertices of the block that are joined to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub(super) block: u32,
    pub(super) slot: u32,
    pub(super) mask: u64,
}

/// The links of all blocks.
#[derive(Debug)]
pub(super) struct BlockLinks {
    pub(super) masks: MetMasks,
    lists: Vec<List>,
    words: Words,
    /// The number of links.
    pub(super) total: usize,
}

/// The links of a block.
#[derive(Clone, Copy, Debug, Default)]
struct List {
    /// Its first and last chunk.
    first: u32,
    last: u32,
    /// The number of words.
    length: u32,
    /// The slot of the first link.
    first_slot: u32,
    /// One more than the slot of the last link.
    end: u32,
}

/// The lower half of a word: the mask's number is in the next word.
const LONG: u32 = u16::MAX as u32;

/// A link as a list has it.
#[derive(Clone, Copy, Debug)]
pub(super) struct ListedLink {
    /// The difference of its slot from that of the link before.
    pub(super) after: u16,
    /// The number of its mask among those that were [met](MetMasks).
    pub(super) mask: u32,
}

impl BlockLinks {
    /// No links of so many blocks.
    pub(super) fn new(blocks: usize) -> Self {
        let (lists, words) = (vec![List::default(); blocks], Words::default());
        Self { masks: MetMasks::new(), lists, words, total: 0 }
    }

    /// Adds a link; the slots of each block ascend.
    pub(super) fn add(&mut self, Link { block, slot, mask }: Link) {
        let list = &mut self.lists[block as usize];
        let mut after = if list.length == 0 { 0 } else { slot + 1 - list.end };
        if list.length == 0 {
            list.first_slot = slot;
        }
        list.end = slot + 1;
        while after > u32::from(u16::MAX) {
            self.words.push(list, u32::from(u16::MAX) << 16 | u32::from(EMPTY));
            after -= u32::from(u16::MAX);
        }
        let number = self.masks.meet(mask);
        self.words.push(list, after << 16 | number.min(LONG));
        if number >= LONG {
            self.words.push(list, number);
        }
        self.total += 1;
    }

    /// The number of blocks.
    pub(super) const fn blocks(&self) -> usize {
        self.lists.len()
    }

    /// The slot of the first link of a block.
    pub(super) fn first_slot(&self, block: usize) -> u32 {
        self.lists[block].first_slot
    }

    /// The links of a block.
    pub(super) fn of(&self, block: usize) -> impl Iterator<Item = ListedLink> + '_ {
        let mut words = self.words.of(self.lists[block]);
        std::iter::from_fn(move || {
            let word = words.next()?;
            let mask = if word & LONG == LONG { words.next()? } else { word & LONG };
            Some(ListedLink { after: (word >> 16) as u16, mask })
        })
    }
}

/// The words of all lists, in chunks, each of which is followed by another one of its list.
#[derive(Debug, Default)]
struct Words {
    /// In pieces of [`PIECE`] chunks, which are not moved when there are more.
    pieces: Vec<Vec<[u32; CHUNK + 1]>>,
}

/// The words of a chunk; one more is the number of the next chunk.
const CHUNK: usize = 15;
const PIECE: usize = 1 << 19;

impl Words {
    fn push(&mut self, list: &mut List, word: u32) {
        let at = list.length as usize % CHUNK;
        if at == 0 {
            let new = self.add_chunk();
            if list.length == 0 {
                list.first = new;
            } else {
                self.chunk(list.last)[CHUNK] = new;
            }
            list.last = new;
        }
        self.chunk(list.last)[at] = word;
        list.length += 1;
    }

    fn add_chunk(&mut self) -> u32 {
        if self.pieces.last().is_none_or(|piece| piece.len() == PIECE) {
            // The first one grows, so that few links take little.
            self.pieces.push(Vec::with_capacity(if self.pieces.is_empty() { 0 } else { PIECE }));
        }
        let before = (self.pieces.len() - 1) * PIECE;
        let piece = self.pieces.last_mut().map_or(0, |piece| {
            piece.push([0; CHUNK + 1]);
            piece.len() - 1
        });
        (before + piece) as u32
    }

    fn chunk(&mut self, number: u32) -> &mut [u32; CHUNK + 1] {
        &mut self.pieces[number as usize / PIECE][number as usize % PIECE]
    }

    fn of(&self, list: List) -> impl Iterator<Item = u32> + '_ {
        let mut chunk = list.first as usize;
        (0..list.length as usize).map(move |number| {
            let words = &self.pieces[chunk / PIECE][chunk % PIECE];
            let at = number % CHUNK;
            if at == CHUNK - 1 {
                chunk = words[CHUNK] as usize;
            }
            words[at]
        })
    }
}

/// The masks that were met, and how often.
#[derive(Debug)]
pub(super) struct MetMasks {
    numbers: HashMap<u64, u32, BuildHasherDefault<MaskHasher>>,
    /// By number: the full one, the empty one of entries that only come further, and the others.
    met: Vec<(usize, u64)>,
}

impl MetMasks {
    fn new() -> Self {
        Self { numbers: HashMap::default(), met: vec![(0, FULL), (0, 0)] }
    }

    /// The number of a mask, which is met once more.
    fn meet(&mut self, mask: u64) -> u32 {
        if mask == FULL {
            return 0;
        }
        let new = self.met.len() as u32;
        let number = *self.numbers.entry(mask).or_insert(new);
        if number == new {
            self.met.push((0, mask));
        }
        self.met[number as usize].0 += 1;
        number
    }

    /// The masks by their numbers.
    pub(super) fn all(&self) -> impl Iterator<Item = u64> + '_ {
        self.met.iter().map(|&(_, mask)| mask)
    }

    /// The masks of links that are not full, each with how often it was met.
    pub(super) fn counted(&self) -> Vec<(usize, u64)> {
        self.met[2..].to_vec()
    }
}

/// Hashes masks fast: they are looked up once a link.
#[derive(Debug, Default)]
struct MaskHasher(u64);

impl Hasher for MaskHasher {
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(byte.into());
        }
    }

    fn write_u64(&mut self, word: u64) {
        let product = u128::from(self.0 ^ word) * 0x9E37_79B9_7F4A_7C15;
        self.0 = product as u64 ^ (product >> 64) as u64;
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests;
