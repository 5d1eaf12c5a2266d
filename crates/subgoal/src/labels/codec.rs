//! Hub labels as bytes.
//!
//! First the [`Identity`](mediant_grid::Identity), 32 bytes, and the code of labels, a `u32`; then the parts,
//! and a checksum of all that, 8 bytes. The [parts](crate::parts) are: of the [seen index](crate::seen) its
//! blocks, entries and masks; the number of groups of each slot; of each group its subgoal and the number of
//! its labels; the labels, which hold the costs; for each the label that leads on ([`chain`](super::chain));
//! and the [labels of vertices](super::vertices). Data that follow from the map and its subgoals are not
//! stored.
//!
//! Reading them takes about as long as copying them.

use std::{marker::PhantomData, sync::Arc};

use mediant_grid::{FreeSpace, Identity, Interrupt, Interrupted, room_for, uninterrupted};
use mediant_moves::K;
use mediant_search::parts::Metric;

use super::{Geometry, HubLabels, pack::Packed, vertices::VertexLabels};
use crate::{
    codec::{DURING, LABELS, after_identity},
    error::SubgoalError,
    hierarchy::Hierarchy,
    parts::{Reader, Writer},
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
        room_for::<u8>(self.memory_bytes() + 64, Interrupted::WRITING)?;
        let mut bytes = Vec::with_capacity(self.memory_bytes() + 64);
        bytes.extend(self.identity.to_bytes());
        bytes.extend(LABELS.to_le_bytes());
        // So that words of 64 bits begin at multiples of 8.
        bytes.extend(self.packed.cost_bits.to_le_bytes());
        let mut out = Writer { bytes, interrupt };
        self.geometry.seen.write(&mut out)?;
        self.packed.write(&mut out)?;
        self.vertices.write(&mut out)?;
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
        let packed = packed.ok_or(wrong.clone())?;
        let vertices = VertexLabels::read(&mut reader, seen.len(), (&packed, &subgoals));
        let vertices = vertices.filter(|_| reader.bytes.is_empty()).ok_or(wrong)?;
        let geometry = Arc::new(Geometry { subgoals, seen });
        let criterion = P::edge_criterion(k, Hierarchy::Contracted);
        Ok(Self { identity, geometry, metric, k, criterion, packed, vertices, placement: PhantomData })
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
