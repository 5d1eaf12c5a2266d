//! Hub labels as bytes.
//!
//! First the [`Identity`](mediant_grid::Identity), 32 bytes, and the code of labels, a `u32`; then the parts,
//! and a checksum of all that, 8 bytes. A part is the number of its words and the words, `u32`, `u64` or
//! bytes, all little endian, and zeros up to a multiple of 8 bytes. The parts are: of the [seen
//! index](crate::seen) its blocks, entries and masks; the number of groups of each slot; of each group its
//! subgoal and the number of its labels; the labels, which hold the costs; the byte beside each
//! [label](super::chain). Data that follow from the map and its subgoals are not stored.
//!
//! Reading them takes about as long as copying them.

use std::{marker::PhantomData, sync::Arc};

use mediant_grid::{FreeSpace, Identity, Interrupt, Interrupted, uninterrupted};
use mediant_moves::K;
use mediant_search::parts::Metric;

use super::{Geometry, HubLabels, pack::Packed};
use crate::{
    codec::{DURING, LABELS, after_identity},
    error::SubgoalError,
    hierarchy::Hierarchy,
    placement::SubgoalPlacement,
    seen::SeenIndex,
    subgoals::Subgoals,
};

impl<P: SubgoalPlacement> HubLabels<P> {
    /// The labels without what follows from the map, for [`from_bytes`](Self::from_bytes). The version of the
    /// format is that of [`SubgoalGraph`](crate::SubgoalGraph::VERSION).
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        uninterrupted(|never| self.to_bytes_interruptible(never))
    }

    /// [`to_bytes`](Self::to_bytes), which an interrupt can stop.
    ///
    /// # Errors
    /// [`Interrupted`], with nothing kept.
    pub fn to_bytes_interruptible(&self, interrupt: &Interrupt) -> Result<Vec<u8>, Interrupted> {
        let mut bytes = Vec::with_capacity(self.memory_bytes() + 64);
        bytes.extend(self.identity.to_bytes());
        bytes.extend(LABELS.to_le_bytes());
        // So that words of 64 bits begin at multiples of 8.
        bytes.extend(self.packed.cost_bits.to_le_bytes());
        let mut out = Writer { bytes, interrupt };
        self.geometry.seen.write(&mut out)?;
        self.packed.write(&mut out)?;
        let Writer { mut bytes, .. } = out;
        let sum = checksum(&bytes, interrupt)?;
        bytes.extend(sum.to_le_bytes());
        Ok(bytes)
    }

    /// The labels that [`to_bytes`](Self::to_bytes) wrote for the same free space and k. They answer exactly
    /// as those that were written.
    ///
    /// Damage is found, by a checksum. Bytes that somebody else made up can give wrong paths, but no panic
    /// and no search without end.
    ///
    /// # Errors
    /// [`SubgoalError::Mismatch`] for the labels of another map, rule of motion or k, before anything else is
    /// looked at; another [`SubgoalError`] if they are no hub labels of this free space. Besides the memory
    /// of the map's subgoals, reading allocates a small multiple of the length of `bytes`.
    pub fn from_bytes(space: &FreeSpace<P>, k: impl Into<K>, bytes: &[u8]) -> Result<Self, SubgoalError> {
        Self::from_bytes_interruptible(space, k, bytes, &Interrupt::NEVER)
    }

    /// [`from_bytes`](Self::from_bytes), which an interrupt can stop: it asks for each part of the bytes.
    ///
    /// # Errors
    /// As for [`from_bytes`](Self::from_bytes), and [`SubgoalError::Interrupted`].
    pub fn from_bytes_interruptible(
        space: &FreeSpace<P>,
        k: impl Into<K>,
        bytes: &[u8],
        interrupt: &Interrupt,
    ) -> Result<Self, SubgoalError> {
        let k = k.into();
        let identity = Identity { k: Some(k), ..space.identity() };
        let rest = after_identity(bytes, identity)?;
        P::check(space, k)?;
        let short = SubgoalError::Bytes("they are too few");
        let (rest, sum) = rest.split_last_chunk().ok_or(short.clone())?;
        let (&code, rest) = rest.split_first_chunk().ok_or(short.clone())?;
        let (&cost_bits, rest) = rest.split_first_chunk().ok_or(short)?;
        if u32::from_le_bytes(code) != LABELS {
            return Err(SubgoalError::Bytes("they are no hub labels"));
        }
        if u64::from_le_bytes(*sum) != checksum(&bytes[..bytes.len() - size_of_val(sum)], interrupt)? {
            return Err(SubgoalError::Bytes("they are damaged"));
        }
        let metric = Metric::new(k)?;
        let subgoals = Subgoals::new(P::subgoals(space, interrupt)?, interrupt)?;
        let mut reader = Reader { bytes: rest };
        let wrong = SubgoalError::Bytes("their parts do not fit together");
        let slots = subgoals.len() as u32 * P::SIDES;
        let seen = SeenIndex::read(&mut reader, P::vertices(space.grid()), slots).ok_or(wrong.clone())?;
        interrupt.check(DURING)?;
        let packed = Packed::read(&mut reader, space, &subgoals, u32::from_le_bytes(cost_bits));
        let packed = packed.filter(|_| reader.bytes.is_empty()).ok_or(wrong)?;
        let geometry = Arc::new(Geometry { subgoals, seen });
        let criterion = P::edge_criterion(k, Hierarchy::Contracted);
        Ok(Self { identity, geometry, metric, k, criterion, packed, placement: PhantomData })
    }
}

/// A checksum that every change of a single word changes: each step maps the sums one to one.
fn checksum(bytes: &[u8], interrupt: &Interrupt) -> Result<u64, Interrupted> {
    const ODD: u64 = 0x9E37_79B9_7F4A_7C15;
    let step = |sum: u64, word: u64| (sum ^ word).wrapping_mul(ODD).rotate_left(29);
    let word = |bytes: &[u8]| bytes.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte));
    let (blocks, rest) = bytes.as_chunks::<32>();
    let mut sums = [1_u64, 2, 3, 4];
    // Four sums at once: a processor need not wait for one product before it begins the next.
    for blocks in blocks.chunks(1 << 16) {
        interrupt.check(DURING)?;
        for block in blocks {
            let (words, _) = block.as_chunks::<8>();
            for (sum, &word) in sums.iter_mut().zip(words) {
                *sum = step(*sum, u64::from_le_bytes(word));
            }
        }
    }
    let sum = sums.into_iter().chain(rest.chunks(8).map(word)).fold(bytes.len() as u64, step);
    Ok(step(sum, sum >> 32))
}

/// Writes parts.
pub(crate) struct Writer<'i> {
    bytes: Vec<u8>,
    interrupt: &'i Interrupt,
}

impl Writer<'_> {
    pub(crate) fn part32(&mut self, words: impl ExactSizeIterator<Item = u32>) -> Result<(), Interrupted> {
        self.bytes.extend((words.len() as u64).to_le_bytes());
        let is_odd = words.len() % 2 == 1;
        for (number, word) in words.enumerate() {
            self.interrupt.check_every(1 << 16, number, Interrupted::WRITING)?;
            self.bytes.extend(word.to_le_bytes());
        }
        if is_odd {
            self.bytes.extend([0; 4]);
        }
        Ok(())
    }

    pub(crate) fn part8(&mut self, bytes: &[u8]) {
        self.bytes.extend((bytes.len() as u64).to_le_bytes());
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(8), 0);
    }

    pub(crate) fn part64(&mut self, words: &[u64]) -> Result<(), Interrupted> {
        self.bytes.extend((words.len() as u64).to_le_bytes());
        for (number, word) in words.iter().enumerate() {
            self.interrupt.check_every(1 << 16, number, Interrupted::WRITING)?;
            self.bytes.extend(word.to_le_bytes());
        }
        Ok(())
    }
}

/// Reads parts; `None` where there is none.
pub(crate) struct Reader<'b> {
    bytes: &'b [u8],
}

impl<'b> Reader<'b> {
    fn take(&mut self, width: usize) -> Option<&'b [u8]> {
        let (&count, rest) = self.bytes.split_first_chunk()?;
        let length = usize::try_from(u64::from_le_bytes(count)).ok()?.checked_mul(width)?;
        let (part, rest) = rest.split_at_checked(length)?;
        self.bytes = rest.get((length.next_multiple_of(8) - length)..)?;
        Some(part)
    }

    pub(crate) fn part32(&mut self) -> Option<impl ExactSizeIterator<Item = u32> + 'b> {
        let (words, _) = self.take(size_of::<u32>())?.as_chunks();
        Some(words.iter().map(|&word| u32::from_le_bytes(word)))
    }

    pub(crate) fn part8(&mut self) -> Option<Box<[u8]>> {
        Some(self.take(1)?.into())
    }

    pub(crate) fn part64(&mut self) -> Option<Box<[u64]>> {
        let (words, _) = self.take(size_of::<u64>())?.as_chunks();
        Some(words.iter().map(|&word| u64::from_le_bytes(word)).collect())
    }
}
