//! The memory of a search on an abstract graph, whose nodes are numbered.

use mediant_grid::VertexId;
use mediant_moves::Cost;

use crate::open_list::{Entry, OpenList};

/// The search tree of a search on an abstract graph, with its open list: the cost and the parent of each node
/// that is known. It is cleared in constant time.
///
/// [`NodeStore`](crate::parts::NodeStore) is the counterpart for grid graphs, where the parent is found by
/// the move. `E` is what a node stores of the edge from its parent.
#[derive(Clone, Debug)]
pub struct SearchTree<E = ()> {
    nodes: Box<[TreeNode<E>]>,
    generation: u32,
    open: OpenList,
}

#[derive(Clone, Copy, Debug, Default)]
struct TreeNode<E> {
    cost: Cost,
    generation: u32,
    slot: u32,
    parent: u32,
    edge: E,
}

impl<E: Copy + Default> SearchTree<E> {
    /// The parent of a node at which the search begins.
    pub const NONE: u32 = u32::MAX;
    /// The slot of a node that is not on the open list.
    const CLOSED: u32 = u32::MAX;

    /// A tree for node numbers below `count`, in which no node is known.
    #[must_use]
    pub fn new(count: usize) -> Self {
        Self {
            nodes: vec![TreeNode::default(); count].into_boxed_slice(),
            generation: 0,
            open: OpenList::default(),
        }
    }

    /// The bytes that a tree for node numbers below `count` takes when it is made; usize::MAX for more.
    #[must_use]
    pub const fn bytes(count: usize) -> usize {
        count.saturating_mul(size_of::<TreeNode<E>>())
    }

    /// Forgets all nodes, and becomes a tree for node numbers below `count`. The memory is kept if it has
    /// room for them, and at most twice as much.
    pub fn fit(&mut self, count: usize) {
        if (self.nodes.len() / 2..=self.nodes.len()).contains(&count) {
            self.start_search();
        } else {
            *self = Self::new(count);
        }
    }

    /// Forgets all nodes, in constant time (but for one call in 2³²).
    pub fn start_search(&mut self) {
        self.open.clear();
        self.generation = self.generation.wrapping_add(1);
        if self.generation == 0 {
            self.nodes.fill(TreeNode::default());
            self.generation = 1;
        }
    }

    /// The cost of the best known path to a node; `None` for a node that is not known.
    #[must_use]
    #[inline]
    pub fn cost(&self, id: u32) -> Option<Cost> {
        let node = &self.nodes[id as usize];
        (node.generation == self.generation).then_some(node.cost)
    }

    /// Whether it is known and not on the open list.
    #[must_use]
    #[inline]
    pub fn is_closed(&self, id: u32) -> bool {
        let node = &self.nodes[id as usize];
        node.generation == self.generation && node.slot == Self::CLOSED
    }

    /// The parent of a known node, and the edge from it; `None` at a node where the search began.
    #[must_use]
    #[inline]
    pub fn parent(&self, id: u32) -> Option<(u32, E)> {
        let node = &self.nodes[id as usize];
        (node.parent != Self::NONE).then_some((node.parent, node.edge))
    }

    /// The edge from the parent to a known node.
    #[must_use]
    #[inline]
    pub fn parent_edge(&self, id: u32) -> E {
        self.nodes[id as usize].edge
    }

    /// The least f of the open nodes.
    #[must_use]
    #[inline]
    pub fn least_f(&self) -> Option<Cost> {
        self.open.get(0).map(Entry::f)
    }

    /// The best open node: its f and its number.
    #[must_use]
    #[inline]
    pub fn best(&self) -> Option<(Cost, u32)> {
        self.open.get(0).map(|entry| (entry.f(), entry.id().0))
    }

    /// Takes the best node from the open list. Returns its f, its number, the cost of the best known path to
    /// it, and the number of swaps in the open list.
    #[inline]
    pub fn pop(&mut self) -> Option<(Cost, u32, Cost, u32)> {
        let Self { nodes, open, .. } = self;
        let (entry, swaps) = open.pop(|id, slot| nodes[id.index()].slot = slot)?;
        let node = &mut nodes[entry.id().index()];
        node.slot = Self::CLOSED;
        Some((entry.f(), entry.id().0, node.cost, swaps))
    }

    /// Makes a path, cheaper than all before, the best known one to a node, and puts the node on the open
    /// list or moves it there. Returns whether it is the first path to the node, and the number of swaps in
    /// the open list.
    #[inline]
    pub fn set_path_and_open(&mut self, id: u32, cost: Cost, h: Cost, parent: u32, edge: E) -> (bool, u32) {
        let Self { nodes, open, generation } = self;
        let node = &mut nodes[id as usize];
        let is_first = node.generation != *generation;
        let (is_open, known, slot) = (!is_first && node.slot != Self::CLOSED, node.cost, node.slot);
        *node = TreeNode { cost, generation: *generation, slot, parent, edge };
        let moved = |id: VertexId, slot| nodes[id.index()].slot = slot;
        let swaps = if is_open {
            open.decrease(slot, known - cost, moved)
        } else {
            open.push(Entry::new(cost + h, h, VertexId(id)), moved)
        };
        (is_first, swaps)
    }

    /// Makes a path, cheaper than all before, the best known one to a node, but leaves the open list as it
    /// is.
    #[inline]
    pub fn set_path(&mut self, id: u32, cost: Cost, parent: u32, edge: E) {
        let node = &mut self.nodes[id as usize];
        let slot = if node.generation == self.generation { node.slot } else { Self::CLOSED };
        *node = TreeNode { cost, generation: self.generation, slot, parent, edge };
    }
}
