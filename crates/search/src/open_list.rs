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
    pub(crate) const fn cheaper_by(self, gain: Cost) -> Self {
        let f = self.f().to_bits().saturating_sub(gain.to_bits());
        Self((f as u128) << 64 | self.0 as u64 as u128)
    }
}

/// Searches that seldom lower an entry keep no slots of so many entries at the top of the heap up to date: an
/// entry to be lowered is looked for there. So short searches write one slot for each entry, the first one.
pub(crate) const TOP: usize = 63;

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

    /// [`push`](Self::push) where the first `top` slots are not kept up to date. Also returns the entry's
    /// slot, of which `moved` is not told.
    #[inline]
    pub(crate) fn push_loosely(
        &mut self,
        top: usize,
        entry: Entry,
        mut moved: impl FnMut(VertexId, u32),
    ) -> (u32, u32) {
        self.heap.push(entry);
        self.rise(top, self.heap.len() - 1, entry, &mut moved)
    }

    /// [`pop`](Self::pop) where the first `top` slots are not kept up to date.
    #[inline]
    pub(crate) fn pop_loosely(
        &mut self,
        top: usize,
        mut moved: impl FnMut(VertexId, u32),
    ) -> Option<(Entry, u32)> {
        let last = self.heap.pop()?;
        let Some(&first) = self.heap.first() else { return Some((last, 0)) };
        let (swaps, slot) = self.sink(top, 0, last, &mut moved);
        if self.heap.len() >= top {
            moved(last.id(), slot);
        }
        Some((first, swaps))
    }

    /// The slot of the entry of a vertex, whose slot was `known` when last told. The first `top` slots are
    /// not kept up to date.
    #[inline]
    pub(crate) fn slot_of(&self, top: usize, id: VertexId, known: u32) -> u32 {
        if known as usize >= top {
            return known;
        }
        let at = self.heap.iter().take(top).position(|entry| entry.id() == id);
        at.map_or(known, |slot| slot as u32)
    }

    /// Puts `entry` into the free slot `slot` or as far above it as it belongs.
    #[inline]
    fn sift_up(&mut self, slot: usize, entry: Entry, moved: &mut impl FnMut(VertexId, u32)) -> u32 {
        let (swaps, slot) = self.rise(0, slot, entry, moved);
        moved(entry.id(), slot);
        swaps
    }

    /// Puts `entry` into the free slot `slot` or as far below it as it belongs.
    #[inline]
    fn sift_down(&mut self, slot: usize, entry: Entry, moved: &mut impl FnMut(VertexId, u32)) -> u32 {
        let (swaps, slot) = self.sink(0, slot, entry, moved);
        moved(entry.id(), slot);
        swaps
    }

    /// [`sift_up`](Self::sift_up), which tells of other entries that it moves to slot `from` or beyond.
    /// Returns the number of swaps and the slot of `entry`.
    #[inline]
    fn rise(
        &mut self,
        from: usize,
        mut slot: usize,
        entry: Entry,
        moved: &mut impl FnMut(VertexId, u32),
    ) -> (u32, u32) {
        let mut swaps = 0;
        while slot > 0 {
            let above = (slot - 1) / 2;
            let other = self.heap[above];
            if other <= entry {
                break;
            }
            self.heap[slot] = other;
            if slot >= from {
                moved(other.id(), slot as u32);
            }
            slot = above;
            swaps += 1;
        }
        self.heap[slot] = entry;
        (swaps, slot as u32)
    }

    /// [`sift_down`](Self::sift_down), which tells of other entries that it moves from slot `from` or beyond.
    /// Returns the number of swaps and the slot of `entry`.
    #[inline]
    fn sink(
        &mut self,
        from: usize,
        mut slot: usize,
        entry: Entry,
        moved: &mut impl FnMut(VertexId, u32),
    ) -> (u32, u32) {
        let mut swaps = 0;
        let heap = self.heap.as_mut_slice();
        while let Some(&left) = heap.get(2 * slot + 1) {
            // Which child is less is not predictable, so the code must not branch on it.
            let right = heap.get(2 * slot + 2).copied().unwrap_or(left);
            let beyond = right < left;
            let other = select_unpredictable(beyond, right, left);
            if entry <= other {
                break;
            }
            heap[slot] = other;
            let below = 2 * slot + 1 + usize::from(beyond);
            if below >= from {
                moved(other.id(), slot as u32);
            }
            slot = below;
            swaps += 1;
        }
        heap[slot] = entry;
        (swaps, slot as u32)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use mediant_oracle::Rng;

    use super::*;

    #[test]
    fn with_slots_kept_loosely_entries_move_as_they_do_with_exact_ones() {
        for seed in 0..20 {
            let mut rng = Rng::new(seed);
            let (mut exact, mut loose) = (OpenList::default(), OpenList::default());
            let (mut exact_slots, mut loose_slots) = (BTreeMap::new(), BTreeMap::new());
            let (mut lowered_at_top, mut lowered_below) = (0, 0);
            for id in 0..1500 {
                let case = format!("seed {seed}, vertex {id}");
                let cost = |n: u32| Cost::from_bits(u64::from(n) << 16);
                let entry = Entry::new(cost(rng.below(1000) + 1000), cost(rng.below(50)), VertexId(id));
                let swaps = exact.push(entry, |id, slot| _ = exact_slots.insert(id, slot));
                let known = &mut loose_slots;
                let (also, slot) = loose.push_loosely(TOP, entry, |id, slot| _ = known.insert(id, slot));
                loose_slots.insert(VertexId(id), slot);
                assert_eq!(swaps, also, "{case}");

                let lowered = VertexId(rng.below(id + 1));
                if let (Some(&slot), Some(&known)) = (exact_slots.get(&lowered), loose_slots.get(&lowered)) {
                    assert_eq!(loose.slot_of(TOP, lowered, known), slot, "{case}");
                    *(if (slot as usize) < TOP { &mut lowered_at_top } else { &mut lowered_below }) += 1;
                    let gain = cost(rng.below(500));
                    let swaps = exact.decrease(slot, gain, |id, slot| _ = exact_slots.insert(id, slot));
                    let known = &mut loose_slots;
                    let also = loose.decrease(slot, gain, |id, slot| _ = known.insert(id, slot));
                    assert_eq!(swaps, also, "{case}");
                }
                if rng.below(3) == 0 {
                    let popped = exact.pop(|id, slot| _ = exact_slots.insert(id, slot));
                    let known = &mut loose_slots;
                    let also = loose.pop_loosely(TOP, |id, slot| _ = known.insert(id, slot));
                    assert_eq!(popped, also, "{case}");
                    let id = popped.map(|(entry, _)| entry.id());
                    exact_slots.retain(|&other, _| Some(other) != id);
                    loose_slots.retain(|&other, _| Some(other) != id);
                }
                assert_eq!(exact.heap, loose.heap, "{case}");
            }
            assert!(lowered_at_top > 20 && lowered_below > 100, "{lowered_at_top}, {lowered_below}");
        }
    }
}
