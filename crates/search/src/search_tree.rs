//! What a search on a graph of numbered nodes knows of each.

use mediant_grid::VertexId;
use mediant_moves::Cost;

use crate::{Entry, OpenList};

/// SearchTree of the nodes of an abstract graph, with the open list; forgotten in constant time. [`NodeStore`](crate::NodeStore) is their counterpart for the vertices of a
/// grid graph, whose parents are found by the move.
///
/// `W` is what a label keeps of the way from the parent.
#[derive(Clone, Debug)]
pub struct SearchTree<W = ()> {
    labels: Box<[Label<W>]>,
    generation: u32,
    open: OpenList,
}

#[derive(Clone, Copy, Debug, Default)]
struct Label<W> {
    cost: Cost,
    generation: u32,
    slot: u32,
    parent: u32,
    way: W,
}

impl<W: Copy + Default> SearchTree<W> {
    /// The parent of a first node.
    pub const NONE: u32 = u32::MAX;
    /// The slot of what is not on the open list any more.
    const CLOSED: u32 = u32::MAX;

    /// SearchTree for nodes below `count`, of which none is known.
    #[must_use]
    pub fn new(count: usize) -> Self {
        Self {
            labels: vec![Label::default(); count].into_boxed_slice(),
            generation: 0,
            open: OpenList::default(),
        }
    }

    /// Forgets all, in constant time but for once in 2³² calls.
    pub fn start_search(&mut self) {
        self.open.clear();
        self.generation = self.generation.wrapping_add(1);
        if self.generation == 0 {
            self.labels.fill(Label::default());
            self.generation = 1;
        }
    }

    /// The cost of the best known way.
    #[must_use]
    #[inline]
    pub fn cost(&self, id: u32) -> Option<Cost> {
        let label = &self.labels[id as usize];
        (label.generation == self.generation).then_some(label.cost)
    }

    /// Whether it is known and not on the open list.
    #[must_use]
    #[inline]
    pub fn is_closed(&self, id: u32) -> bool {
        let label = &self.labels[id as usize];
        label.generation == self.generation && label.slot == Self::CLOSED
    }

    /// The node before a known one, and the way from it; `None` at a first one.
    #[must_use]
    #[inline]
    pub fn parent(&self, id: u32) -> Option<(u32, W)> {
        let label = &self.labels[id as usize];
        (label.parent != Self::NONE).then_some((label.parent, label.way))
    }

    /// What is kept of the best known way to a known node.
    #[must_use]
    #[inline]
    pub fn way(&self, id: u32) -> W {
        self.labels[id as usize].way
    }

    /// f of the best open node.
    #[must_use]
    #[inline]
    pub fn least(&self) -> Option<Cost> {
        self.open.get(0).map(Entry::f)
    }

    /// Takes the best open node off the list: f, its number, the cost of the way to it, and how many swaps that took.
    #[inline]
    pub fn pop(&mut self) -> Option<(Cost, u32, Cost, u32)> {
        let Self { labels, open, .. } = self;
        let (entry, swaps) = open.pop(|id, slot| labels[id.index()].slot = slot)?;
        let label = &mut labels[entry.id().index()];
        label.slot = Self::CLOSED;
        Some((entry.f(), entry.id().0, label.cost, swaps))
    }

    /// Makes a way to a node known, which is cheaper than any before, and the node open. Whether it is the first, and how many swaps of the open list it took.
    #[inline]
    pub fn reach(&mut self, id: u32, cost: Cost, h: Cost, parent: u32, way: W) -> (bool, u32) {
        let Self { labels, open, generation } = self;
        let label = &mut labels[id as usize];
        let is_first = label.generation != *generation;
        let (is_open, known, slot) = (!is_first && label.slot != Self::CLOSED, label.cost, label.slot);
        *label = Label { cost, generation: *generation, slot, parent, way };
        let moved = |id: VertexId, slot| labels[id.index()].slot = slot;
        let swaps = if is_open {
            open.decrease(slot, known - cost, moved)
        } else {
            open.push(Entry::new(cost + h, h, VertexId(id)), moved)
        };
        (is_first, swaps)
    }

    /// Makes a way to a node known, which is cheaper than any before, without making the node open. One that is open stays where it was on the list.
    #[inline]
    pub fn note(&mut self, id: u32, cost: Cost, parent: u32, way: W) {
        let label = &mut self.labels[id as usize];
        let slot = if label.generation == self.generation { label.slot } else { Self::CLOSED };
        *label = Label { cost, generation: self.generation, slot, parent, way };
    }
}
