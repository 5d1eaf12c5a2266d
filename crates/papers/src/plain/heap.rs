//! The open list: an indexed binary heap whose ties are a choice, and which counts its swaps.

use mediant_grid::VertexId;
use mediant_moves::Cost;

/// The order of entries of equal f.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ties {
    /// The one nearer to the goal first, in steps of 2⁻¹⁶ cells; then the lower number.
    NearerFirst,
    /// None: the heap compares f alone.
    Unordered,
}

/// An entry; the key is compared, and the vertex is not.
#[derive(Clone, Copy)]
struct Entry {
    key: (u64, u64, u32),
    id: VertexId,
}

/// The heap, least key first.
pub(super) struct Heap {
    ties: Ties,
    entries: Vec<Entry>,
    /// The slot of each vertex that is in the list.
    slots: Vec<u32>,
}

impl Heap {
    /// An empty heap for so many vertices.
    pub(super) fn new(ties: Ties, vertices: usize) -> Self {
        Self { ties, entries: Vec::new(), slots: vec![0; vertices] }
    }

    pub(super) fn clear(&mut self) {
        self.entries.clear();
    }

    /// Adds a vertex that is not in the list. Returns the swaps.
    pub(super) fn push(&mut self, id: VertexId, f: Cost, h: Cost) -> u64 {
        let (f, coarse) = (f.to_bits(), (h.to_bits() >> 16).min(u64::from(u32::MAX)));
        let key = match self.ties {
            Ties::NearerFirst => (f, coarse, id.0),
            Ties::Unordered => (f, 0, 0),
        };
        self.entries.push(Entry { key, id });
        self.rise(self.entries.len() - 1, Entry { key, id })
    }

    /// Lowers the f of a vertex that is in the list. Returns the swaps.
    pub(super) fn decrease(&mut self, id: VertexId, gain: Cost) -> u64 {
        let slot = self.slots[id.0 as usize] as usize;
        let mut entry = self.entries[slot];
        entry.key.0 -= gain.to_bits();
        self.rise(slot, entry)
    }

    /// Removes the least entry: its vertex, and the swaps.
    pub(super) fn pop(&mut self) -> Option<(VertexId, u64)> {
        let last = self.entries.pop()?;
        let Some(first) = self.entries.first().map(|entry| entry.id) else { return Some((last.id, 0)) };
        Some((first, self.sink(last)))
    }

    fn set(&mut self, slot: usize, entry: Entry) {
        self.entries[slot] = entry;
        self.slots[entry.id.0 as usize] = slot as u32;
    }

    fn rise(&mut self, mut slot: usize, entry: Entry) -> u64 {
        let mut swaps = 0;
        while slot > 0 && entry.key < self.entries[(slot - 1) / 2].key {
            self.set(slot, self.entries[(slot - 1) / 2]);
            slot = (slot - 1) / 2;
            swaps += 1;
        }
        self.set(slot, entry);
        swaps
    }

    fn sink(&mut self, entry: Entry) -> u64 {
        let (mut slot, mut swaps) = (0, 0);
        while let Some(left) = self.entries.get(2 * slot + 1) {
            let right = self.entries.get(2 * slot + 2);
            let below = 2 * slot + 1 + usize::from(right.is_some_and(|right| right.key < left.key));
            if entry.key <= self.entries[below].key {
                break;
            }
            self.set(slot, self.entries[below]);
            (slot, swaps) = (below, swaps + 1);
        }
        self.set(slot, entry);
        swaps
    }
}
