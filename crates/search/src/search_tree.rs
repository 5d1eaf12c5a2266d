//! What a search on a graph of numbered nodes knows of each.

use mediant_grid::VertexId;
use mediant_moves::Cost;

use crate::{Entry, OpenList};

/// SearchTree of the nodes of an abstract graph, with the open list; forgotten in constant time. [`NodeStore`](crate::NodeStore) is their counterpart for the vertices of a
/// grid graph, whose parents are found by the move.
///
/// `E` is what a node keeps of the way from the parent.
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
    /// The parent of a first node.
    pub const NONE: u32 = u32::MAX;
    /// The slot of what is not on the open list any more.
    const CLOSED: u32 = u32::MAX;

    /// SearchTree for nodes below `count`, of which none is known.
    #[must_use]
    pub fn new(count: usize) -> Self {
        Self {
            nodes: vec![TreeNode::default(); count].into_boxed_slice(),
            generation: 0,
            open: OpenList::default(),
        }
    }

    /// Forgets all, in constant time but for once in 2³² calls.
    pub fn start_search(&mut self) {
        self.open.clear();
        self.generation = self.generation.wrapping_add(1);
        if self.generation == 0 {
            self.nodes.fill(TreeNode::default());
            self.generation = 1;
        }
    }

    /// The cost of the best known way.
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

    /// The node before a known one, and the way from it; `None` at a first one.
    #[must_use]
    #[inline]
    pub fn parent(&self, id: u32) -> Option<(u32, E)> {
        let node = &self.nodes[id as usize];
        (node.parent != Self::NONE).then_some((node.parent, node.edge))
    }

    /// What is kept of the best known way to a known node.
    #[must_use]
    #[inline]
    pub fn parent_edge(&self, id: u32) -> E {
        self.nodes[id as usize].edge
    }

    /// f of the best open node.
    #[must_use]
    #[inline]
    pub fn least_f(&self) -> Option<Cost> {
        self.open.get(0).map(Entry::f)
    }

    /// Takes the best open node off the list: f, its number, the cost of the way to it, and how many swaps that took.
    #[inline]
    pub fn pop(&mut self) -> Option<(Cost, u32, Cost, u32)> {
        let Self { nodes, open, .. } = self;
        let (entry, swaps) = open.pop(|id, slot| nodes[id.index()].slot = slot)?;
        let node = &mut nodes[entry.id().index()];
        node.slot = Self::CLOSED;
        Some((entry.f(), entry.id().0, node.cost, swaps))
    }

    /// Makes a way to a node known, which is cheaper than any before, and the node open. Whether it is the first, and how many swaps of the open list it took.
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

    /// Makes a way to a node known, which is cheaper than any before, without making the node open. One that is open stays where it was on the list.
    #[inline]
    pub fn set_path(&mut self, id: u32, cost: Cost, parent: u32, edge: E) {
        let node = &mut self.nodes[id as usize];
        let slot = if node.generation == self.generation { node.slot } else { Self::CLOSED };
        *node = TreeNode { cost, generation: self.generation, slot, parent, edge };
    }
}
