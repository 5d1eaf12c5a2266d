//! The search nodes of a grid graph, which are not cleared between searches.

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
///
/// Jumps touch few vertices, far apart, each on a page of its own on a large map. So where nodes store their
/// parent, and the map is large, a block of 16 nodes has a place only from the first path to one of them on.
#[derive(Clone, Debug)]
pub struct NodeStore<N: ParentPointer = ()> {
    /// For each node the lower and the upper half of g, the slot, the mark, and the pointer: by id, or block
    /// by block. The first block is of no node and stays unknown.
    nodes: Vec<N::Words>,
    /// For each block of ids its place among those of `nodes`, 0 if it has none yet; empty if nodes are
    /// stored by id.
    blocks: Box<[u32]>,
    /// Vertex ids are below this.
    len: usize,
    generation: u32,
}

/// The nodes of a block.
const BLOCK: usize = 16;
/// The most vertices of a map whose nodes are stored by id, whatever they are.
const MOST_BY_ID: usize = 1 << 22;

impl<N: ParentPointer> NodeStore<N> {
    /// A store for vertex ids below `len`, in which no node is known.
    #[must_use]
    pub fn new(len: usize) -> Self {
        if N::IS_FOR_JUMPS && len > MOST_BY_ID { Self::in_blocks(len) } else { Self::by_id(len) }
    }

    /// The bytes that a store for vertex ids below `len` takes when it is made; usize::MAX for more.
    #[must_use]
    pub const fn bytes(len: usize) -> usize {
        if N::IS_FOR_JUMPS && len > MOST_BY_ID {
            return len.div_ceil(BLOCK).saturating_mul(size_of::<u32>());
        }
        len.saturating_mul(size_of::<N::Words>())
    }

    fn by_id(len: usize) -> Self {
        Self { nodes: vec![N::UNKNOWN; len], blocks: Box::default(), len, generation: 1 }
    }

    fn in_blocks(len: usize) -> Self {
        let blocks = vec![0; len.div_ceil(BLOCK)].into_boxed_slice();
        Self { nodes: vec![N::UNKNOWN; BLOCK], blocks, len, generation: 1 }
    }

    /// Forgets all nodes, and becomes a store for vertex ids below `len`. The memory is kept if it was one
    /// for as many.
    pub fn fit(&mut self, len: usize) {
        if self.len == len {
            self.start_search();
        } else {
            *self = Self::new(len);
        }
    }

    /// The place of a node among `nodes`.
    #[inline]
    fn place(&self, id: VertexId) -> usize {
        if !N::IS_FOR_JUMPS || self.blocks.is_empty() {
            return id.index();
        }
        place_in_block(&self.blocks, id)
    }

    /// The place of a node that is to be known.
    #[inline]
    fn place_to_write(&mut self, id: VertexId) -> usize {
        let place = self.place(id);
        if N::IS_FOR_JUMPS && place < BLOCK && !self.blocks.is_empty() {
            self.add_block(id);
            return self.place(id);
        }
        place
    }

    /// Gives the block of a node a place.
    #[cold]
    fn add_block(&mut self, id: VertexId) {
        self.blocks[id.index() / BLOCK] = (self.nodes.len() / BLOCK) as u32;
        self.nodes.extend([N::UNKNOWN; BLOCK]);
    }

    /// Forgets all nodes, in constant time (but for one call in a million).
    pub fn start_search(&mut self) {
        if self.generation == Node::<N>::LAST_GENERATION {
            self.nodes = vec![N::UNKNOWN; self.nodes.len()];
            self.generation = 0;
        }
        self.generation += 1;
    }

    /// The node of a vertex, if this search knows it.
    #[must_use]
    #[inline]
    pub fn get(&self, id: VertexId) -> Option<Node<N>> {
        let words = &self.nodes[self.place(id)];
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
        let place = self.place_to_write(id);
        let words = &mut self.nodes[place];
        pointer.write(words);
        if let [low, high, _, mark, ..] = words.as_mut() {
            (*low, *high) = (g.to_bits() as u32, (g.to_bits() >> 32) as u32);
            *mark = self.generation << Node::<N>::MOVE_BITS | arrived_by as u32;
        }
    }

    /// Records the slot of a vertex in the open list.
    #[inline]
    pub fn set_slot(&mut self, id: VertexId, slot: u32) {
        let place = self.place(id);
        if let [_, _, known, ..] = self.nodes[place].as_mut() {
            *known = slot;
        }
    }
}

/// The place of a node that is stored in a block. Apart, so that searches whose nodes are stored by id do not
/// pay for it.
#[cold]
#[inline(never)]
fn place_in_block(blocks: &[u32], id: VertexId) -> usize {
    blocks[id.index() / BLOCK] as usize * BLOCK + id.index() % BLOCK
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

    #[test]
    fn a_store_for_another_map_knows_nothing() {
        let mut store = NodeStore::<()>::new(3);
        store.set_path(VertexId(2), Cost::ZERO, 0, ());
        let place = store.nodes.as_ptr();
        store.fit(3);
        assert_eq!((store.get(VertexId(2)).is_none(), store.nodes.as_ptr()), (true, place));
        store.set_path(VertexId(2), Cost::ZERO, 0, ());
        store.fit(5);
        assert!((0..5).all(|id| store.get(VertexId(id)).is_none()));

        let mut large = NodeStore::<VertexId>::new(MOST_BY_ID + 1);
        large.set_path(VertexId(70), Cost::ZERO, 0, VertexId(0));
        large.fit(MOST_BY_ID + 1);
        assert!(large.get(VertexId(70)).is_none() && large.nodes.len() == 2 * BLOCK);
        large.fit(80);
        assert_eq!((large.nodes.len(), large.blocks.len()), (80, 0));
    }

    #[test]
    fn nodes_in_blocks_are_those_by_id() {
        let ids = || (0..1000).step_by(7).chain([999, 0, 15, 16]).map(VertexId);
        let mut stores = [NodeStore::<VertexId>::by_id(1000), NodeStore::in_blocks(1000)];
        for search in 1..5 {
            for store in &mut stores {
                store.start_search();
                for id in ids().filter(|id| id.0 % search == 0) {
                    assert!(id.0 == 0 || store.get(id).is_none());
                    store.set_path(id, Cost::from_bits(u64::from(id.0)), search as usize, VertexId(search));
                    store.set_slot(id, id.0 + 1);
                }
            }
            let [by_id, in_blocks] = [0, 1].map(|i| {
                let nodes = (0..1000).map(|id| stores[i].get(VertexId(id)));
                nodes.map(|node| format!("{node:?}")).collect::<Vec<_>>()
            });
            assert_eq!(by_id, in_blocks, "search {search}");
            assert!(by_id.iter().filter(|node| *node != "None").count() > 30);
        }
        let few = NodeStore::<VertexId>::new(MOST_BY_ID + 1);
        assert_eq!((few.nodes.len(), NodeStore::<()>::new(MOST_BY_ID + 1).blocks.len()), (BLOCK, 0));
    }
}
