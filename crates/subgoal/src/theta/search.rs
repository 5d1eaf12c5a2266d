//! The search itself.

use mediant_grid::{FreeSpace, Vertex};
use mediant_moves::Cost;
use mediant_search::{NodeEvent, Observer, SearchTree, segment_cost};

use super::descent::Descent;
use crate::{SubgoalGraph, SubgoalPlacement, contract::NONE};

/// Where paths bend, or begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    pub(super) at: Vertex,
    g: Cost,
    /// The bend before it; [`NONE`] at the start.
    before: u32,
}

impl Bend {
    /// A bend, and those before it.
    pub(super) fn back(bends: &[Self], last: u32) -> impl Iterator<Item = Self> {
        let bend = |number: u32| bends.get(number as usize).copied();
        std::iter::successors(bend(last), move |later| bend(later.before))
    }
}

/// Scratch memory for the subgoals that a shortcut leads over.
#[derive(Clone, Debug, Default)]
pub(super) struct Middles {
    pending: Vec<(u32, u32, u32)>,
    vertices: Vec<Vertex>,
}

/// Whether a straight segment between two vertices keeps the rules of motion. Of them only the start and the goal of a path are gaps.
pub(super) fn may_join<P: SubgoalPlacement>(space: &FreeSpace<P>, from: Vertex, to: Vertex) -> bool {
    space.may_turn(None, from, Some(to)) && space.may_turn(Some(from), to, None) && space.sees(from, to)
}

/// One search.
pub(super) struct Search<'s, P: SubgoalPlacement, O> {
    pub(super) space: &'s FreeSpace<P>,
    pub(super) graph: &'s SubgoalGraph<P>,
    /// A parent is the number of the bend that a subgoal hangs on.
    pub(super) labels: &'s mut SearchTree,
    pub(super) descent: &'s Descent,
    pub(super) bends: &'s mut Vec<Bend>,
    pub(super) middles: &'s mut Middles,
    pub(super) observer: &'s mut O,
    pub(super) goal: Vertex,
}

/// A subgoal that is being expanded.
#[derive(Clone, Copy)]
struct Node {
    id: u32,
    at: Vertex,
    g: Cost,
    /// The bend that it hangs on.
    hook: u32,
    /// The bend at it, once something hangs there.
    own: Option<u32>,
}

impl<P: SubgoalPlacement, O: Observer> Search<'_, P, O> {
    /// Expands subgoals until the goal is the best of them. The last bend before it.
    pub(super) fn run(&mut self, start: Vertex, links: &[(u32, Cost)]) -> Option<u32> {
        self.labels.start_search();
        self.bends.clear();
        let first = self.bend(start, Cost::ZERO, NONE);
        for &(id, _) in links {
            let at = self.vertex(id);
            self.reach(id, at, segment_cost(start.to(at)), first);
        }
        loop {
            let (f, id, g, swaps) = self.labels.pop()?;
            self.observer.percolated(swaps);
            let (hook, ()) = self.labels.parent(id)?;
            let at = self.vertex(id);
            if id == self.goal_id() {
                return Some(hook);
            }
            let parent = Some(self.bends[hook as usize].at).filter(|&parent| parent != at);
            self.observer.expanded(NodeEvent { at, parent, g, f });
            self.expand(Node { id, at, g, hook, own: None });
        }
    }

    fn expand(&mut self, mut node: Node) {
        let (graph, descent) = (self.graph, self.descent);
        for arc in graph.up(node.id) {
            self.generate(&mut node, arc.to, arc.mid);
        }
        for arc in descent.below(node.id) {
            self.generate(&mut node, arc.to, arc.mid);
        }
    }

    /// Goes on from a subgoal by an arc.
    fn generate(&mut self, node: &mut Node, to: u32, mid: u32) {
        if self.labels.is_closed(to) {
            return;
        }
        let (at, hook) = (self.vertex(to), self.bends[node.hook as usize]);
        let known = self.labels.cost(to).unwrap_or(Cost::MAX);
        // The way over the subgoal is, by the triangle inequality, no cheaper.
        let straight = hook.g + segment_cost(hook.at.to(at));
        if straight >= known {
            return;
        }
        let (g, hook) = if may_join(self.space, hook.at, at) {
            (straight, node.hook)
        } else if mid == NONE {
            debug_assert!(may_join(self.space, node.at, at), "{} – {at} is no edge", node.at);
            (node.g + segment_cost(node.at.to(at)), self.own(node))
        } else {
            self.over_middles(node, to, mid)
        };
        if g < known {
            self.reach(to, at, g, hook);
        }
    }

    /// Goes on by a shortcut, over the subgoals in the middle: what the way costs in the end, and the last bend.
    fn over_middles(&mut self, node: &mut Node, to: u32, mid: u32) -> (Cost, u32) {
        let Middles { mut pending, mut vertices } = std::mem::take(self.middles);
        vertices.clear();
        self.graph.unpack((node.id, to, mid), &mut pending, &mut |at| vertices.push(at));
        let (mut hook, mut at, mut g) = (node.hook, node.at, node.g);
        for &next in &vertices {
            if !may_join(self.space, self.bends[hook as usize].at, next) {
                hook = if at == node.at { self.own(node) } else { self.bend(at, g, hook) };
            }
            let bend = self.bends[hook as usize];
            (at, g) = (next, bend.g + segment_cost(bend.at.to(next)));
        }
        *self.middles = Middles { pending, vertices };
        (g, hook)
    }

    /// The bend at a subgoal that is being expanded.
    fn own(&mut self, node: &mut Node) -> u32 {
        let own = node.own.unwrap_or_else(|| self.bend(node.at, node.g, node.hook));
        *node.own.insert(own)
    }

    fn bend(&mut self, at: Vertex, g: Cost, before: u32) -> u32 {
        self.bends.push(Bend { at, g, before });
        self.bends.len() as u32 - 1
    }

    /// Makes a cheaper way to a subgoal, which is not closed, or to the goal known.
    fn reach(&mut self, id: u32, at: Vertex, g: Cost, hook: u32) {
        let h = segment_cost(at.to(self.goal));
        let parent = Some(self.bends[hook as usize].at).filter(|&parent| parent != at);
        let event = NodeEvent { at, parent, g, f: g + h };
        if self.labels.cost(id).is_some() {
            self.observer.updated(event);
        } else {
            self.observer.generated(event);
        }
        let (_, swaps) = self.labels.reach(id, g, h, hook, ());
        self.observer.percolated(swaps);
    }

    fn vertex(&self, id: u32) -> Vertex {
        if id == self.goal_id() { self.goal } else { self.graph.subgoals.vertex(id) }
    }

    /// The number of the goal, after those of the subgoals.
    const fn goal_id(&self) -> u32 {
        self.graph.subgoals() as u32
    }
}
