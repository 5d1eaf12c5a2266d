//! The nodes of a search that replans, which are not cleared between searches.

use mediant_grid::{Centers, GridGraph, VertexId};
use mediant_moves::Cost;

/// The values of a vertex, or of one of the two nodes of a closed gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Node {
    /// The distance from the root as it was last settled; [`Cost::MAX`] for none.
    pub(super) g: Cost,
    /// The least sum of a neighbor's g and the cost of the move from there; [`Cost::MAX`] for none.
    pub(super) rhs: Cost,
    /// Its slot in the open list, or [`CLOSED`](Self::CLOSED).
    pub(super) slot: u32,
    /// The move from that neighbor, by its index.
    pub(super) by: usize,
}

const _: () = assert!(Node::MOVE_BITS >= GridGraph::<Centers>::MAX_K);

impl Node {
    /// The slot of a node that is not in the open list.
    pub(super) const CLOSED: u32 = u32::MAX;
    /// A node that the search has not reached.
    pub(super) const UNKNOWN: Self = Self { g: Cost::MAX, rhs: Cost::MAX, slot: Self::CLOSED, by: 0 };
    /// The bits of a move's index: enough for the 4,096 moves of k = 12.
    const MOVE_BITS: u32 = 12;

    /// Its distance, if it is settled.
    #[inline]
    pub(super) fn settled(self) -> Option<Cost> {
        (self.g != Cost::MAX).then_some(self.g)
    }
}

/// The nodes by number. As in [`NodeStore`](crate::parts::NodeStore) a node carries the generation of its
/// search, and an array of zeros takes memory only where it is written.
#[derive(Clone, Debug)]
pub(super) struct Nodes {
    /// Of each node g, rhs, and its generation above its move above its slot.
    words: Vec<[u64; 3]>,
    generation: u32,
    known: usize,
}

impl Nodes {
    /// So many nodes, of which none is known.
    pub(super) fn new(len: usize) -> Self {
        Self { words: vec![[0; 3]; len], generation: 1, known: 0 }
    }

    /// The number of nodes.
    pub(super) const fn len(&self) -> usize {
        self.words.len()
    }

    /// The number of them that the search has reached.
    pub(super) const fn known(&self) -> usize {
        self.known
    }

    /// Forgets all nodes.
    pub(super) fn forget(&mut self) {
        if self.generation == LAST_GENERATION {
            *self = Self { generation: 0, ..Self::new(self.len()) };
        }
        self.generation += 1;
        self.known = 0;
    }

    /// Whether the search has reached a node.
    #[inline]
    pub(super) fn is_known(&self, id: VertexId) -> bool {
        self.words.get(id.index()).is_some_and(|words| generation(words[2]) == self.generation)
    }

    #[inline]
    pub(super) fn get(&self, id: VertexId) -> Node {
        match self.words.get(id.index()) {
            Some(&[g, rhs, rest]) if generation(rest) == self.generation => {
                let by = (rest >> 32) as usize & ((1 << Node::MOVE_BITS) - 1);
                Node { g: Cost::from_bits(g), rhs: Cost::from_bits(rhs), slot: rest as u32, by }
            }
            _ => Node::UNKNOWN,
        }
    }

    /// Stores a node. Returns whether it was not known before.
    #[inline]
    pub(super) fn set(&mut self, id: VertexId, node: Node) -> bool {
        let Some(words) = self.words.get_mut(id.index()) else { return false };
        let is_new = generation(words[2]) != self.generation;
        let mark = u64::from(self.generation) << Node::MOVE_BITS | node.by as u64;
        *words = [node.g.to_bits(), node.rhs.to_bits(), mark << 32 | u64::from(node.slot)];
        self.known += usize::from(is_new);
        is_new
    }

    /// Records the slot of a known node in the open list.
    #[inline]
    pub(super) fn set_slot(&mut self, id: VertexId, slot: u32) {
        if let Some(words) = self.words.get_mut(id.index()) {
            words[2] = words[2] >> 32 << 32 | u64::from(slot);
        }
    }
}

/// The last generation. After it, once in a million searches, the nodes are cleared and the count begins
/// anew.
const LAST_GENERATION: u32 = u32::MAX >> Node::MOVE_BITS;

/// The generation of a node by its last word.
#[inline]
const fn generation(rest: u64) -> u32 {
    (rest >> (32 + Node::MOVE_BITS)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_are_forgotten_also_when_the_generations_run_out() {
        let mut nodes = Nodes::new(2);
        let node = Node { g: Cost::from_bits(3), rhs: Cost::ZERO, slot: 7, by: 4_095 };
        assert!(!nodes.is_known(VertexId(0)) && nodes.get(VertexId(0)) == Node::UNKNOWN);
        assert!(nodes.set(VertexId(1), node) && !nodes.set(VertexId(1), node));
        assert_eq!((nodes.get(VertexId(1)), nodes.known()), (node, 1));
        nodes.set_slot(VertexId(1), 9);
        assert_eq!(nodes.get(VertexId(1)), Node { slot: 9, ..node });
        nodes.generation = LAST_GENERATION - 1;
        nodes.forget();
        assert!(nodes.set(VertexId(0), node));
        nodes.forget();
        assert_eq!((nodes.generation, nodes.known()), (1, 0));
        assert!((0..3).map(VertexId).all(|id| nodes.get(id) == Node::UNKNOWN));
    }
}
