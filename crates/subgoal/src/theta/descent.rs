//! The arcs down to a goal.

use mediant_moves::Cost;

use crate::{arc::NONE, graph::SubgoalGraph, placement::SubgoalPlacement};

/// The arcs on paths down to a goal, by the subgoals that they come from. Cleared in constant time.
#[derive(Clone, Debug)]
pub(super) struct Descent {
    heads: Box<[Head]>,
    generation: u32,
    arcs: Vec<Down>,
    pending: Vec<u32>,
}

/// The first arc down from a subgoal, if it was found in this search.
#[derive(Clone, Copy, Debug, Default)]
struct Head {
    first: u32,
    generation: u32,
}

/// An arc down, in a linked list of those from the same subgoal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Down {
    pub(super) to: u32,
    pub(super) middle: u32,
    next: u32,
}

impl Descent {
    pub(super) fn new(count: usize) -> Self {
        let heads = vec![Head::default(); count].into_boxed_slice();
        Self { heads, generation: 0, arcs: Vec::new(), pending: Vec::new() }
    }

    /// Becomes a descent for so many subgoals. The memory is kept if it was one for as many.
    pub(super) fn fit(&mut self, count: usize) {
        // The goal's number follows those of the subgoals: the count must be exact.
        if self.heads.len() != count {
            *self = Self::new(count);
        }
    }

    /// The bytes that it takes when it is made.
    pub(super) const fn bytes(count: usize) -> usize {
        count.saturating_mul(size_of::<Head>())
    }

    /// Finds the arcs down to a goal, given the edges that join it to subgoals. The goal's number follows
    /// those of the subgoals.
    pub(super) fn start_search<P: SubgoalPlacement>(
        &mut self,
        graph: &SubgoalGraph<P>,
        query_edges: &[(u32, Cost)],
    ) {
        self.arcs.clear();
        self.generation = self.generation.wrapping_add(1);
        if self.generation == 0 {
            self.heads.fill(Head::default());
            self.generation = 1;
        }
        for &(id, _) in query_edges {
            self.add(id, self.heads.len() as u32, NONE);
        }
        while let Some(id) = self.pending.pop() {
            // The core stores its arcs in both directions.
            let up = if graph.is_core(id) { &[] } else { graph.up(id) };
            up.iter().for_each(|arc| self.add(arc.to, id, arc.middle));
        }
    }

    fn add(&mut self, from: u32, to: u32, middle: u32) {
        let head = &mut self.heads[from as usize];
        let is_new = head.generation != self.generation;
        let next = if is_new { NONE } else { head.first };
        *head = Head { first: self.arcs.len() as u32, generation: self.generation };
        self.arcs.push(Down { to, middle, next });
        if is_new {
            self.pending.push(from);
        }
    }

    /// The arcs down from a subgoal.
    pub(super) fn below(&self, id: u32) -> impl Iterator<Item = Down> {
        let arc = |number: u32| self.arcs.get(number as usize).copied();
        let head = self.heads[id as usize];
        let first = (head.generation == self.generation).then(|| arc(head.first)).flatten();
        std::iter::successors(first, move |down| arc(down.next))
    }
}
