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
/// Jumps touch few vertices, far apart: by id each would lie on a page of its own, and a page that is touched
/// for the first time takes longer than all else that a short search does. So the nodes of jumps lie in
/// blocks of eight, one block after another in the order in which searches come to them.
#[derive(Clone, Debug)]
pub struct NodeStore<N: ParentPointer = ()> {
    /// For each node the lower and the upper half of g, the slot, the mark, and the pointer: by id, or block
    /// by block. The first block is of no vertex and stays unknown.
    nodes: Vec<N::Words>,
    /// For each block of ids where its nodes begin, 0 if it has none yet; empty if nodes are stored by id.
    blocks: Box<[u32]>,
    /// Vertex ids are below this.
    len: usize,
    generation: u32,
}

/// The nodes of a block: so few that hardly any are of vertices that no jump comes to.
const BLOCK: usize = 8;
/// The most vertices of a map for whose nodes room is reserved when a store is made. (Nothing is written
/// there.)
const MOST_RESERVED: usize = 1 << 22;

impl<N: ParentPointer> NodeStore<N> {
    /// A store for vertex ids below `len`, in which no node is known.
    #[must_use]
    pub fn new(len: usize) -> Self {
        if !N::IS_FOR_JUMPS {
            return Self { nodes: vec![N::UNKNOWN; len], blocks: Box::default(), len, generation: 1 };
        }
        let mut nodes = Vec::with_capacity(Self::room_for_blocks(len));
        nodes.extend([N::UNKNOWN; BLOCK]);
        Self { nodes, blocks: vec![0; len.div_ceil(BLOCK)].into_boxed_slice(), len, generation: 1 }
    }

    /// For how many nodes there is room in a new store of blocks.
    const fn room_for_blocks(len: usize) -> usize {
        if len > MOST_RESERVED { BLOCK } else { len.next_multiple_of(BLOCK) + BLOCK }
    }

    /// The bytes that a store for vertex ids below `len` takes when it is made; usize::MAX for more.
    #[must_use]
    pub const fn bytes(len: usize) -> usize {
        if !N::IS_FOR_JUMPS {
            return len.saturating_mul(size_of::<N::Words>());
        }
        let blocks = len.div_ceil(BLOCK).saturating_mul(size_of::<u32>());
        blocks.saturating_add(Self::room_for_blocks(len).saturating_mul(size_of::<N::Words>()))
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
        if !N::IS_FOR_JUMPS {
            return id.index();
        }
        self.blocks[id.index() / BLOCK] as usize | (id.index() % BLOCK)
    }

    /// Gives the block of a node a place, and returns that of the node.
    #[cold]
    #[inline(never)]
    fn add_block(&mut self, id: VertexId) -> usize {
        let first = self.nodes.len();
        self.blocks[id.index() / BLOCK] = first as u32;
        self.nodes.extend([N::UNKNOWN; BLOCK]);
        first | (id.index() % BLOCK)
    }

    /// Forgets all nodes, in constant time (but for one call in a million).
    pub fn start_search(&mut self) {
        if self.generation == Node::<N>::LAST_GENERATION {
            *self = Self::new(self.len);
        } else {
            self.generation += 1;
        }
    }

    /// The node of a vertex, if this search knows it.
    #[must_use]
    #[inline]
    pub fn get(&self, id: VertexId) -> Option<Node<N>> {
        self.find(id).1
    }

    /// The node of a vertex, if this search knows it, and its place, by which it is written.
    #[inline]
    pub(crate) fn find(&self, id: VertexId) -> (NodePlace, Option<Node<N>>) {
        let place = self.place(id);
        (NodePlace(place), self.read(place))
    }

    /// The node of a vertex, if this search knows it; it is then in no open list.
    #[inline]
    pub(crate) fn close(&mut self, id: VertexId) -> Option<Node<N>> {
        let place = self.place(id);
        self.set_slot_at(NodePlace(place), Node::<N>::CLOSED);
        self.read(place)
    }

    #[inline]
    fn read(&self, place: usize) -> Option<Node<N>> {
        let words = &self.nodes[place];
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
        let place = NodePlace(self.place(id));
        self.set_path_at((place, id), g, arrived_by, pointer);
    }

    /// [`set_path`](Self::set_path) with the place where the node was found. Returns where it is now.
    #[inline]
    pub(crate) fn set_path_at(
        &mut self,
        (NodePlace(place), id): (NodePlace, VertexId),
        g: Cost,
        arrived_by: usize,
        pointer: N,
    ) -> NodePlace {
        let generation = self.generation;
        let (place, words) = self.words_at(place, id);
        Self::write(generation, words, (g, arrived_by, pointer));
        NodePlace(place)
    }

    /// [`set_path_at`](Self::set_path_at) of a node whose slot in the open list is 0.
    #[inline]
    pub(crate) fn open_at(
        &mut self,
        (NodePlace(place), id): (NodePlace, VertexId),
        path: (Cost, usize, N),
    ) -> NodePlace {
        let generation = self.generation;
        let (place, words) = self.words_at(place, id);
        Self::write(generation, words, path);
        if let [_, _, slot, ..] = words.as_mut() {
            *slot = 0;
        }
        NodePlace(place)
    }

    /// The words of a node at a place, which it is given if it has none yet.
    #[inline]
    fn words_at(&mut self, place: usize, id: VertexId) -> (usize, &mut N::Words) {
        let place = if N::IS_FOR_JUMPS && place < BLOCK { self.add_block(id) } else { place };
        (place, &mut self.nodes[place])
    }

    #[inline]
    fn write(generation: u32, words: &mut N::Words, (g, arrived_by, pointer): (Cost, usize, N)) {
        debug_assert!(
            arrived_by < 1 << Node::<N>::MOVE_BITS,
            "no move of any graph has the index {arrived_by}"
        );
        pointer.write(words);
        if let [low, high, _, mark, ..] = words.as_mut() {
            (*low, *high) = (g.to_bits() as u32, (g.to_bits() >> 32) as u32);
            *mark = generation << Node::<N>::MOVE_BITS | arrived_by as u32;
        }
    }

    /// Records the slot of a vertex in the open list.
    #[inline]
    pub fn set_slot(&mut self, id: VertexId, slot: u32) {
        self.set_slot_at(NodePlace(self.place(id)), slot);
    }

    /// [`set_slot`](Self::set_slot) of the node at a place.
    #[inline]
    pub(crate) fn set_slot_at(&mut self, NodePlace(place): NodePlace, slot: u32) {
        if let [_, _, known, ..] = self.nodes[place].as_mut() {
            *known = slot;
        }
    }
}

/// Where a node is stored.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodePlace(usize);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parent::JumpParent;

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

        let mut jumps = NodeStore::<JumpParent>::new(81);
        jumps.set_path(VertexId(80), Cost::ZERO, 0, JumpParent(VertexId(0)));
        jumps.fit(81);
        assert!(jumps.get(VertexId(80)).is_none());
        assert_eq!((jumps.nodes.len(), jumps.blocks.len()), (2 * BLOCK, 11));
        jumps.fit(MOST_RESERVED + 1);
        assert!(jumps.get(VertexId(80)).is_none());
        assert_eq!((jumps.nodes.len(), jumps.blocks.len()), (BLOCK, MOST_RESERVED / BLOCK + 1));
    }

    #[test]
    fn nodes_in_blocks_are_those_by_id() {
        let ids = || (0..1000).step_by(7).chain([999, 0, 15, 16]).map(VertexId);
        let (mut by_id, mut in_blocks) =
            (NodeStore::<VertexId>::new(1000), NodeStore::<JumpParent>::new(1000));
        for search in 1..5 {
            let touched: Vec<VertexId> = ids().filter(|id| id.0 % search == 0).collect();
            touch(&mut by_id, search, &touched);
            touch(&mut in_blocks, search, &touched);
            let known = all(&by_id);
            assert_eq!(known, all(&in_blocks), "search {search}");
            assert!(known.iter().flatten().count() > 30);
        }
        assert_eq!((by_id.nodes.len(), by_id.blocks.len()), (1000, 0));
        assert!((700..1000 + 2 * BLOCK).contains(&in_blocks.nodes.len()));
    }

    fn touch<N: ParentPointer>(store: &mut NodeStore<N>, search: u32, ids: &[VertexId]) {
        store.start_search();
        for &id in ids {
            assert!(id.0 == 0 || store.get(id).is_none());
            store.set_path(id, Cost::from_bits(u64::from(id.0)), search as usize, N::to(VertexId(search)));
            store.set_slot(id, id.0 + 1);
        }
    }

    /// The cost, slot, move and parent of a node.
    type Known = (Cost, u32, usize, Option<VertexId>);

    fn all<N: ParentPointer>(store: &NodeStore<N>) -> Vec<Option<Known>> {
        let known = |node: Node<N>| (node.g, node.slot, node.arrived_by(), node.pointer.stored());
        (0..1000).map(|id| store.get(VertexId(id)).map(known)).collect()
    }
}
