//! The open list: an indexed binary heap.

use std::hint::select_unpredictable;

use mediant_grid::VertexId;
use mediant_moves::Cost;

/// An entry of the open list, ordered by f, then by h (nearer to the goal first), then by vertex id.
///
/// An entry takes 16 bytes. For that h is compared in steps of 2⁻¹⁶ cells, and all values from 2¹⁶ cells on
/// are equal. Vertices that still tie are ordered by id, so the order is total, and the same on every
/// platform.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Entry(u128);

const _: () = assert!(size_of::<Entry>() == 16);

impl Entry {
    /// The entry of a vertex.
    #[must_use]
    #[inline]
    pub const fn new(f: Cost, h: Cost, id: VertexId) -> Self {
        let coarse = h.to_bits() >> 16;
        let coarse = if coarse > u32::MAX as u64 { u32::MAX as u64 } else { coarse };
        Self((f.to_bits() as u128) << 64 | (coarse as u128) << 32 | id.0 as u128)
    }

    /// The entry of a vertex in a search that goes by keys of two parts: ordered by the first one, then by
    /// the second one in whole cells, then by vertex id.
    #[must_use]
    #[inline]
    pub(crate) const fn keyed(first: Cost, second: Cost, id: VertexId) -> Self {
        let cells = second.to_bits() >> Cost::FRACTION_BITS;
        Self((first.to_bits() as u128) << 64 | (cells as u128) << 32 | id.0 as u128)
    }

    /// Its key: all that it is ordered by before its vertex.
    #[must_use]
    #[inline]
    pub(crate) const fn key(self) -> u128 {
        self.0 >> 32
    }

    /// Its f.
    #[must_use]
    #[inline]
    pub const fn f(self) -> Cost {
        Cost::from_bits((self.0 >> 64) as u64)
    }

    /// Its vertex.
    #[must_use]
    #[inline]
    pub const fn id(self) -> VertexId {
        VertexId(self.0 as u32)
    }

    /// The same entry with a path that is cheaper by `gain`.
    #[must_use]
    #[inline]
    const fn cheaper_by(self, gain: Cost) -> Self {
        let f = self.f().to_bits().saturating_sub(gain.to_bits());
        Self((f as u128) << 64 | self.0 as u64 as u128)
    }
}

/// An indexed binary heap, least entry first.
///
/// The caller stores the slot of each vertex: every operation takes a function that it calls with
/// `(id, slot)` for each entry that moves to another slot. It returns the number of swaps ('percolations' in
/// Rivera 2017).
#[derive(Clone, Debug, Default)]
pub struct OpenList {
    heap: Vec<Entry>,
}

impl OpenList {
    /// Removes all entries and keeps the memory.
    pub fn clear(&mut self) {
        self.heap.clear();
    }

    /// The number of entries.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.heap.len()
    }

    /// Whether there is no entry.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.heap.is_empty()
    }

    /// The entry in a slot, if the slot is in use.
    #[must_use]
    pub fn get(&self, slot: u32) -> Option<Entry> {
        self.heap.get(slot as usize).copied()
    }

    /// Adds an entry.
    #[inline]
    pub fn push(&mut self, entry: Entry, mut moved: impl FnMut(VertexId, u32)) -> u32 {
        self.heap.push(entry);
        self.sift_up(self.heap.len() - 1, entry, &mut moved)
    }

    /// Lowers the f of the entry in a slot by `gain`, at most to 0. Does nothing for a slot that is not in
    /// use.
    #[inline]
    pub fn decrease(&mut self, slot: u32, gain: Cost, mut moved: impl FnMut(VertexId, u32)) -> u32 {
        let Some(entry) = self.heap.get(slot as usize) else { return 0 };
        let entry = entry.cheaper_by(gain);
        self.sift_up(slot as usize, entry, &mut moved)
    }

    /// Removes the least entry.
    #[inline]
    pub fn pop(&mut self, mut moved: impl FnMut(VertexId, u32)) -> Option<(Entry, u32)> {
        let last = self.heap.pop()?;
        let Some(&first) = self.heap.first() else { return Some((last, 0)) };
        Some((first, self.sift_down(0, last, &mut moved)))
    }

    /// Puts another entry of the same vertex into a slot. Does nothing for a slot that is not in use.
    #[inline]
    pub fn replace(&mut self, slot: u32, entry: Entry, mut moved: impl FnMut(VertexId, u32)) -> u32 {
        let Some(&known) = self.heap.get(slot as usize) else { return 0 };
        self.sift(slot as usize, known, entry, &mut moved)
    }

    /// Removes the entry in a slot. Does nothing for a slot that is not in use.
    #[inline]
    pub fn remove(&mut self, slot: u32, mut moved: impl FnMut(VertexId, u32)) -> u32 {
        let Some(&known) = self.heap.get(slot as usize) else { return 0 };
        match self.heap.pop() {
            Some(last) if (slot as usize) < self.heap.len() => {
                self.sift(slot as usize, known, last, &mut moved)
            }
            _ => 0,
        }
    }

    /// Puts `entry` where it belongs, from the slot on in which `known` was.
    #[inline]
    fn sift(
        &mut self,
        slot: usize,
        known: Entry,
        entry: Entry,
        moved: &mut impl FnMut(VertexId, u32),
    ) -> u32 {
        if entry < known { self.sift_up(slot, entry, moved) } else { self.sift_down(slot, entry, moved) }
    }

    /// Puts `entry` into the free slot `slot` or as far above it as it belongs.
    #[inline]
    fn sift_up(&mut self, mut slot: usize, entry: Entry, moved: &mut impl FnMut(VertexId, u32)) -> u32 {
        let mut swaps = 0;
        while slot > 0 {
            let above = (slot - 1) / 2;
            let other = self.heap[above];
            if other <= entry {
                break;
            }
            self.heap[slot] = other;
            moved(other.id(), slot as u32);
            slot = above;
            swaps += 1;
        }
        self.heap[slot] = entry;
        moved(entry.id(), slot as u32);
        swaps
    }

    /// Puts `entry` into the free slot `slot` or as far below it as it belongs.
    #[inline]
    fn sift_down(&mut self, mut slot: usize, entry: Entry, moved: &mut impl FnMut(VertexId, u32)) -> u32 {
        let heap = self.heap.as_mut_slice();
        let mut swaps = 0;
        while let Some(&left) = heap.get(2 * slot + 1) {
            // Which child is less is not predictable, so the code must not branch on it.
            let right = heap.get(2 * slot + 2).copied().unwrap_or(left);
            let beyond = right < left;
            let other = select_unpredictable(beyond, right, left);
            if entry <= other {
                break;
            }
            heap[slot] = other;
            moved(other.id(), slot as u32);
            slot = 2 * slot + 1 + usize::from(beyond);
            swaps += 1;
        }
        heap[slot] = entry;
        moved(entry.id(), slot as u32);
        swaps
    }
}
