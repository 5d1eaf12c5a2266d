//! An open list whose least entries stand in order before its heap.

use mediant_grid::VertexId;
use mediant_moves::Cost;

use crate::{
    nodes::NodeStore,
    open_list::{Entry, OpenList, TOP},
    parent::ParentPointer,
};

/// So many entries may stand before the heap.
const FRONT: usize = 64;

/// An [`OpenList`] for searches by jumps. These go to the goal: a new entry is often one of the least, and
/// one of the next to be removed. So the least entries stand in order before the heap, and others enter it.
///
/// Entries are removed in the same order as from a heap alone, since no two are equal. But there are other
/// swaps in the heap: where somebody counts them, all entries are in the [heap](Self::gather).
///
/// Nodes have slots as for [`OpenList`], with those of the [`TOP`] of the heap not kept up to date. Those
/// whose entries stand before the heap have any slot.
#[derive(Clone, Debug)]
pub(crate) struct OpenFront {
    pub(crate) heap: OpenList,
    /// The first `count` of these are entries that are less than all in the heap, the least one last.
    front: [Entry; FRONT],
    count: usize,
}

impl Default for OpenFront {
    fn default() -> Self {
        let none = Entry::new(Cost::ZERO, Cost::ZERO, VertexId(0));
        Self { heap: OpenList::default(), front: [none; FRONT], count: 0 }
    }
}

impl OpenFront {
    /// Removes all entries and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.heap.clear();
        self.count = 0;
    }

    /// The least entry.
    #[inline]
    pub(crate) fn least(&self) -> Option<Entry> {
        match self.count {
            0 => self.heap.get(0),
            count => Some(self.front[(count - 1) % FRONT]),
        }
    }

    /// Puts all entries into the heap.
    pub(crate) fn gather<N: ParentPointer>(&mut self, nodes: &mut NodeStore<N>) {
        while let Some(last) = self.count.checked_sub(1) {
            self.count = last;
            self.heap.push(self.front[last % FRONT], |id, slot| nodes.set_slot(id, slot));
        }
    }

    /// Adds the entry of a node whose slot is 0.
    #[inline]
    pub(crate) fn push<N: ParentPointer>(&mut self, entry: Entry, nodes: &mut NodeStore<N>) {
        let mut place = self.count;
        let greatest = if place > 0 { Some(self.front[0]) } else { self.heap.get(0) };
        if place >= FRONT || !self.heap.is_empty() && greatest.is_some_and(|greatest| entry > greatest) {
            return self.push_behind(entry, nodes);
        }
        self.count = place + 1;
        while let Some(before) = place.checked_sub(1)
            && self.front[before] < entry
        {
            self.front[place] = self.front[before];
            place = before;
        }
        self.front[place] = entry;
    }

    /// [`push`](Self::push) where the entry belongs into the heap, or there is no room before it.
    #[inline(never)]
    fn push_behind<N: ParentPointer>(&mut self, entry: Entry, nodes: &mut NodeStore<N>) {
        if self.count < FRONT {
            return self.push_to_heap(entry, nodes);
        }
        // The greater half makes room.
        for place in (0..FRONT / 2).rev() {
            self.push_to_heap(self.front[place], nodes);
        }
        self.front.copy_within(FRONT / 2.., 0);
        self.count -= FRONT / 2;
        self.push(entry, nodes);
    }

    fn push_to_heap<N: ParentPointer>(&mut self, entry: Entry, nodes: &mut NodeStore<N>) {
        let (_, slot) = self.heap.push_loosely(TOP, entry, |id, slot| nodes.set_slot(id, slot));
        nodes.set_slot(entry.id(), slot);
    }

    /// Removes the least entry.
    #[inline]
    pub(crate) fn pop<N: ParentPointer>(&mut self, nodes: &mut NodeStore<N>) -> Option<Entry> {
        let Some(last) = self.count.checked_sub(1) else { return self.pop_from_heap(nodes) };
        self.count = last;
        Some(self.front[last % FRONT])
    }

    #[inline(never)]
    fn pop_from_heap<N: ParentPointer>(&mut self, nodes: &mut NodeStore<N>) -> Option<Entry> {
        self.heap.pop_loosely(TOP, |id, slot| nodes.set_slot(id, slot)).map(|(entry, _)| entry)
    }

    /// Lowers the f of the entry of a node, whose slot is `known`, by `gain`. Returns its f.
    #[inline(never)]
    pub(crate) fn decrease<N: ParentPointer>(
        &mut self,
        (id, known): (VertexId, u32),
        gain: Cost,
        nodes: &mut NodeStore<N>,
    ) -> Option<Cost> {
        let entry = if let Some(place) = self.front[..self.count].iter().position(|entry| entry.id() == id) {
            let entry = self.front[place];
            self.front.copy_within(place + 1..self.count, place);
            self.count -= 1;
            entry
        } else {
            let slot = self.heap.slot_of(TOP, id, known);
            let entry = self.heap.get(slot)?;
            self.heap.remove(slot, |id, slot| nodes.set_slot(id, slot));
            entry
        };
        let entry = entry.cheaper_by(gain);
        self.push(entry, nodes);
        Some(entry.f())
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use mediant_oracle::Rng;

    use super::*;
    use crate::parent::JumpParent;

    const COUNT: u32 = 1500;

    fn cost(n: u32) -> Cost {
        Cost::from_bits(u64::from(n) << 16)
    }

    /// Nodes of which some are in no open list, as one that an earlier search closed.
    fn nodes() -> NodeStore<JumpParent> {
        let mut nodes = NodeStore::new(COUNT as usize);
        (0..COUNT).map(VertexId).for_each(|id| nodes.set_path(id, Cost::ZERO, 0, JumpParent(id)));
        nodes
    }

    fn slot(nodes: &NodeStore<JumpParent>, id: VertexId) -> u32 {
        nodes.get(id).map_or(u32::MAX, |node| node.slot)
    }

    #[test]
    fn entries_are_removed_as_from_a_heap() {
        for seed in 0..20 {
            let rng = &mut Rng::new(seed);
            let (mut heap, mut slots) = (OpenList::default(), BTreeMap::new());
            let (mut list, mut nodes) = (OpenFront::default(), nodes());
            let (mut before, mut behind) = (0, 0);
            for id in 0..COUNT {
                let case = format!("seed {seed}, vertex {id}");
                let entry = Entry::new(cost(rng.below(1000) + 1000), cost(rng.below(50)), VertexId(id));
                heap.push(entry, |id, slot| _ = slots.insert(id, slot));
                nodes.set_slot(entry.id(), 0);
                list.push(entry, &mut nodes);

                let lowered = VertexId(rng.below(id + 1));
                if let Some(&at) = slots.get(&lowered) {
                    let is_before = list.front[..list.count].iter().any(|entry| entry.id() == lowered);
                    *(if is_before { &mut before } else { &mut behind }) += 1;
                    let gain = cost(rng.below(500));
                    heap.decrease(at, gain, |id, slot| _ = slots.insert(id, slot));
                    let known = slot(&nodes, lowered);
                    let f = list.decrease((lowered, known), gain, &mut nodes);
                    let expected = slots.get(&lowered).and_then(|&at| heap.get(at)).map(Entry::f);
                    assert_eq!(f, expected, "{case}");
                }
                // It grows beyond its front and shrinks again, in the end to nothing.
                let is_last = id == COUNT - 1;
                let pops = if is_last { COUNT } else { rng.below(4) * u32::from(id % 300 > 200) };
                for _ in 0..pops {
                    assert_eq!(list.least(), heap.get(0), "{case}");
                    let popped = heap.pop(|id, slot| _ = slots.insert(id, slot)).map(|(entry, _)| entry);
                    assert_eq!(list.pop(&mut nodes), popped, "{case}");
                    popped.map(|entry| slots.remove(&entry.id()));
                }
            }
            assert!(before > 20 && behind > 100, "seed {seed}: {before}, {behind}");
        }
    }

    #[test]
    fn all_entries_go_into_the_heap() {
        let (mut list, mut nodes) = (OpenFront::default(), nodes());
        for id in 0..200 {
            nodes.set_slot(VertexId(id), 0);
            list.push(Entry::new(cost(id * 37 % 101), Cost::ZERO, VertexId(id)), &mut nodes);
        }
        let least = list.least();
        assert!(list.count > 0 && !list.heap.is_empty());
        list.gather(&mut nodes);
        assert_eq!((list.heap.len(), list.heap.get(0), list.least()), (200, least, least));
        for id in (0..200).map(VertexId) {
            let slot = list.heap.slot_of(TOP, id, slot(&nodes, id));
            assert_eq!(list.heap.get(slot).map(Entry::id), Some(id));
        }
        list.clear();
        assert_eq!((list.least(), list.pop(&mut nodes)), (None, None));
    }
}
