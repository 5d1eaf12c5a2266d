//! What a search knows of each subgoal.

use mediant_grid::VertexId;
use mediant_moves::Cost;
use mediant_search::{Entry, OpenList};

use crate::{contract::NONE, graph::Hop};

/// Labels of subgoals, forgotten in constant time.
#[derive(Clone, Debug)]
pub(crate) struct Labels {
    labels: Box<[Label]>,
    generation: u32,
    open: OpenList,
}

#[derive(Clone, Copy, Debug, Default)]
struct Label {
    cost: Cost,
    generation: u32,
    slot: u32,
    parent: u32,
    mid: u32,
    hop: Hop,
}

impl Labels {
    /// The slot of what is not on the open list any more.
    const CLOSED: u32 = u32::MAX;

    pub(crate) fn new(count: usize) -> Self {
        Self {
            labels: vec![Label::default(); count].into_boxed_slice(),
            generation: 0,
            open: OpenList::default(),
        }
    }

    /// Forgets all, in constant time but for once in 2³² calls.
    pub(crate) fn start_search(&mut self) {
        self.open.clear();
        self.generation = self.generation.wrapping_add(1);
        if self.generation == 0 {
            self.labels.fill(Label::default());
            self.generation = 1;
        }
    }

    /// The cost of the best known way.
    #[inline]
    pub(crate) fn cost(&self, id: u32) -> Option<Cost> {
        let label = self.labels[id as usize];
        (label.generation == self.generation).then_some(label.cost)
    }

    /// Whether it was taken off the open list, and not put on it again.
    #[inline]
    pub(crate) fn is_closed(&self, id: u32) -> bool {
        let label = self.labels[id as usize];
        label.generation == self.generation && label.slot == Self::CLOSED
    }

    /// The subgoal before it and that which the way between them leads over; `None` at the first.
    pub(crate) fn parent(&self, id: u32) -> Option<(u32, u32)> {
        let label = self.labels[id as usize];
        (label.parent != NONE).then_some((label.parent, label.mid))
    }

    /// f of the best open subgoal.
    #[inline]
    pub(crate) fn least(&self) -> Option<Cost> {
        self.open.get(0).map(Entry::f)
    }

    /// Takes the best open subgoal off the list: f, its number, the cost of the way to it, and how many swaps that took.
    #[inline]
    pub(crate) fn pop(&mut self) -> Option<(Cost, u32, Cost, u32)> {
        let Self { labels, open, .. } = self;
        let (entry, swaps) = open.pop(|id, slot| labels[id.index()].slot = slot)?;
        let label = &mut labels[entry.id().index()];
        label.slot = Self::CLOSED;
        Some((entry.f(), entry.id().0, label.cost, swaps))
    }

    /// Makes a way to a subgoal known, which is cheaper than any before. Whether it is the first, and how many swaps of the open list it took.
    #[inline]
    pub(crate) fn reach(&mut self, id: u32, cost: Cost, h: Cost, (parent, mid): (u32, u32)) -> (bool, u32) {
        let Self { labels, open, generation } = self;
        let label = &mut labels[id as usize];
        let is_first = label.generation != *generation;
        let (is_open, known, slot) = (!is_first && label.slot != Self::CLOSED, label.cost, label.slot);
        *label = Label { cost, generation: *generation, parent, mid, slot, hop: Hop::default() };
        let moved = |id: VertexId, slot| labels[id.index()].slot = slot;
        let swaps = if is_open {
            open.decrease(slot, known - cost, moved)
        } else {
            open.push(Entry::new(cost + h, h, VertexId(id)), moved)
        };
        (is_first, swaps)
    }

    /// Sets the last step of the best known way.
    #[inline]
    pub(crate) fn set_hop(&mut self, id: u32, hop: Hop) {
        self.labels[id as usize].hop = hop;
    }

    /// The last step of the best known way.
    #[inline]
    pub(crate) fn hop(&self, id: u32) -> Hop {
        self.labels[id as usize].hop
    }
}
