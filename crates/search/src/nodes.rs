//! What a search remembers of each vertex, without clearing it between searches.

use mediant_grid::{Centers, GridGraph, VertexId};
use mediant_moves::Cost;

use crate::parent::ParentPointer;

/// A search node: 16 bytes in the store, so that four share a cache line, and its [`ParentPointer`], `N`.
#[derive(Clone, Copy, Debug)]
pub struct Node<N = ()> {
    /// The cost of the best known path from the start.
    pub g: Cost,
    /// The node's slot in the open list, or [`CLOSED`](Self::CLOSED).
    pub slot: u32,
    /// The generation in the high bits, the index of the last move of the best known path in the low ones.
    mark: u32,
    /// Leads to the parent.
    pub pointer: N,
}

const _: () = assert!(size_of::<<() as ParentPointer>::Words>() == 16);
const _: () = assert!(Node::<()>::MOVE_BITS >= GridGraph::<Centers>::MAX_K);

impl<N> Node<N> {
    /// The slot of a node that is in no open list.
    pub const CLOSED: u32 = u32::MAX;
    /// The bits of a move's index: enough for the 4,096 moves of k = 12.
    const MOVE_BITS: u32 = 12;
    /// The last generation. After it, once in a million searches, the store is cleared and the count begins
    /// anew.
    const LAST_GENERATION: u32 = u32::MAX >> Self::MOVE_BITS;

    /// The index of the move by which the best known path arrives; 0 for the start.
    #[must_use]
    #[inline]
    pub const fn arrived_by(&self) -> usize {
        (self.mark & ((1 << Self::MOVE_BITS) - 1)) as usize
    }
}

/// One [`Node`] for each vertex. A node that a search knows carries the generation of that search, so earlier
/// ones need not be cleared.
///
/// Nodes are stored as words: an array of zeros takes memory only where it is written, on systems that hand
/// out zeros on demand. So the memory follows what searches touch, not the map, and a planner is made at
/// once.
#[derive(Clone, Debug)]
pub struct NodeStore<N: ParentPointer = ()> {
    /// For each node the lower and the upper half of g, the slot, the mark, and the pointer.
    nodes: Box<[N::Words]>,
    generation: u32,
}

impl<N: ParentPointer> NodeStore<N> {
    /// A store for vertex ids below `len`, in which no node is known.
    #[must_use]
    pub fn new(len: usize) -> Self {
        Self { nodes: vec![N::UNKNOWN; len].into_boxed_slice(), generation: 1 }
    }

    /// Forgets all nodes, in constant time (but for one call in a million).
    pub fn start_search(&mut self) {
        if self.generation == Node::<N>::LAST_GENERATION {
            self.nodes = vec![N::UNKNOWN; self.nodes.len()].into_boxed_slice();
            self.generation = 0;
        }
        self.generation += 1;
    }

    /// The node of a vertex, if this search knows it.
    #[must_use]
    #[inline]
    pub fn get(&self, id: VertexId) -> Option<Node<N>> {
        let words = &self.nodes[id.index()];
        let &[low, high, slot, mark, ..] = words.as_ref() else { return None };
        let g = Cost::from_bits(u64::from(high) << 32 | u64::from(low));
        if mark >> Node::<N>::MOVE_BITS != self.generation {
            return None;
        }
        Some(Node { g, slot, mark, pointer: N::read(words) })
    }

    /// Makes a path of cost `g` that arrives by the move `arrived_by` the best known one to a vertex.
    #[inline]
    pub fn set_path(&mut self, id: VertexId, g: Cost, arrived_by: usize, pointer: N) {
        debug_assert!(
            arrived_by < 1 << Node::<N>::MOVE_BITS,
            "no move of any graph has the index {arrived_by}"
        );
        let words = &mut self.nodes[id.index()];
        pointer.write(words);
        if let [low, high, _, mark, ..] = words.as_mut() {
            (*low, *high) = (g.to_bits() as u32, (g.to_bits() >> 32) as u32);
            *mark = self.generation << Node::<N>::MOVE_BITS | arrived_by as u32;
        }
    }

    /// Records the slot of a vertex in the open list.
    #[inline]
    pub fn set_slot(&mut self, id: VertexId, slot: u32) {
        if let [_, _, known, ..] = self.nodes[id.index()].as_mut() {
            *known = slot;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_are_forgotten_between_searches_also_when_the_generations_run_out() {
        let mut store = NodeStore::<()>::new(3);
        store.start_search();
        store.set_path(VertexId(1), Cost::from_bits(7), 4_095, ());
        assert_eq!(
            store.get(VertexId(1)).map(|node| (node.g, node.arrived_by())),
            Some((Cost::from_bits(7), 4_095))
        );
        store.start_search();
        assert!(store.get(VertexId(1)).is_none());

        // A new store knows nothing either.
        assert!(NodeStore::<()>::new(1).get(VertexId(0)).is_none());

        // A node of generation 1 must not come back to life when the count begins anew at 1.
        let mut store = NodeStore::<()>::new(3);
        store.set_path(VertexId(0), Cost::ZERO, 0, ());
        store.generation = Node::<()>::LAST_GENERATION - 1;
        store.start_search();
        assert_eq!(store.generation, Node::<()>::LAST_GENERATION);
        store.set_path(VertexId(2), Cost::ZERO, 0, ());
        store.start_search();
        assert_eq!(store.generation, 1);
        assert!((0..3).all(|id| store.get(VertexId(id)).is_none()));
    }
}
