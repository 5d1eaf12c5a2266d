//! The search of Sub-Theta*.

use mediant_grid::{FreeSpace, Vertex};
use mediant_moves::Cost;
use mediant_search::{
    NodeEvent, Observer, SearchStatus,
    parts::{SearchTree, segment_cost},
};

use super::descent::Descent;
use crate::{
    arc::{NONE, PackedArc},
    graph::SubgoalGraph,
    placement::SubgoalPlacement,
};

/// A vertex at which paths bend, or begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waypoint {
    pub(super) at: Vertex,
    g: Cost,
    /// The number of the bend before it; [`NONE`] at the start.
    before: u32,
}

impl Waypoint {
    /// A bend, and those before it.
    pub(super) fn back(bends: &[Self], last: u32) -> impl Iterator<Item = Self> {
        let bend = |number: u32| bends.get(number as usize).copied();
        std::iter::successors(bend(last), move |later| bend(later.before))
    }
}

/// Scratch memory for unpacking shortcuts.
#[derive(Clone, Debug, Default)]
pub(super) struct Unpacking {
    pending: Vec<PackedArc>,
    vertices: Vec<Vertex>,
}

/// Whether a straight segment between two vertices keeps the rules of motion. Of the vertices of a path only
/// the start and the goal can be closed gaps.
pub(super) fn may_join<P: SubgoalPlacement>(space: &FreeSpace<P>, from: Vertex, to: Vertex) -> bool {
    space.may_turn(None, from, Some(to)) && space.may_turn(Some(from), to, None) && space.sees(from, to)
}

/// One search.
pub(super) struct SubgoalThetaSearch<'s, P: SubgoalPlacement, O> {
    pub(super) space: &'s FreeSpace<P>,
    pub(super) graph: &'s SubgoalGraph<P>,
    /// The parent of a subgoal is the number of the last bend before it.
    pub(super) tree: &'s mut SearchTree,
    pub(super) descent: &'s Descent,
    pub(super) bends: &'s mut Vec<Waypoint>,
    pub(super) unpacking: &'s mut Unpacking,
    pub(super) observer: &'s mut O,
    pub(super) goal: Vertex,
}

/// A subgoal that is being expanded.
#[derive(Clone, Copy)]
struct Node {
    id: u32,
    at: Vertex,
    g: Cost,
    /// The last bend before it.
    parent: u32,
    /// The bend at the subgoal itself, once a path bends there.
    own_bend: Option<u32>,
}

impl<P: SubgoalPlacement, O: Observer> SubgoalThetaSearch<'_, P, O> {
    /// Puts the subgoals that the start is joined to on the open list.
    pub(super) fn begin(&mut self, start: Vertex, query_edges: &[(u32, Cost)]) {
        self.tree.start_search();
        self.bends.clear();
        let first = self.bend(start, Cost::ZERO, NONE);
        for &(id, _) in query_edges {
            let at = self.vertex(id);
            self.reach(id, at, segment_cost(start.to(at)), first);
        }
    }

    /// Expands subgoals until the goal has the least f, none is open, or the observer pauses. Writes the last
    /// bend before the goal to `last`.
    pub(super) fn run(&mut self, last: &mut Option<u32>) -> SearchStatus {
        loop {
            if let Some((f, _)) = self.tree.best().filter(|&(_, id)| id != self.goal_id())
                && self.observer.pauses(f)
            {
                return SearchStatus::Searching;
            }
            let Some((f, id, g, swaps)) = self.tree.pop() else { return SearchStatus::Unreachable };
            self.observer.percolated(swaps);
            let Some((bend, ())) = self.tree.parent(id) else { return SearchStatus::Unreachable };
            let at = self.vertex(id);
            if id == self.goal_id() {
                *last = Some(bend);
                return SearchStatus::Found;
            }
            let parent = Some(self.bends[bend as usize].at).filter(|&parent| parent != at);
            self.observer.expanded(NodeEvent { at, parent, g, f });
            if !self.space.is_closed_gap(at) {
                self.observer.reached(at, g);
            }
            self.expand(Node { id, at, g, parent: bend, own_bend: None });
        }
    }

    fn expand(&mut self, mut node: Node) {
        let (graph, descent) = (self.graph, self.descent);
        for arc in graph.up(node.id) {
            self.generate(&mut node, arc.to, arc.middle);
        }
        for arc in descent.below(node.id) {
            self.generate(&mut node, arc.to, arc.middle);
        }
    }

    /// Follows an arc from the expanded subgoal.
    fn generate(&mut self, node: &mut Node, to: u32, middle: u32) {
        if self.tree.is_closed(to) {
            return;
        }
        let (at, parent) = (self.vertex(to), self.bends[node.parent as usize]);
        let known = self.tree.cost(to).unwrap_or(Cost::MAX);
        // By the triangle inequality the path over the subgoal is no cheaper.
        let straight = parent.g + segment_cost(parent.at.to(at));
        if straight >= known {
            return;
        }
        let (g, bend) = if may_join(self.space, parent.at, at) {
            (straight, node.parent)
        } else if middle == NONE {
            debug_assert!(may_join(self.space, node.at, at), "{} – {at} is no edge", node.at);
            (node.g + segment_cost(node.at.to(at)), self.own_bend(node))
        } else {
            self.along_shortcut(node, to, middle)
        };
        if g < known {
            self.reach(to, at, g, bend);
        }
    }

    /// Follows the subgoals that a shortcut passes. Returns the cost at its end, and the last bend before.
    fn along_shortcut(&mut self, node: &mut Node, to: u32, middle: u32) -> (Cost, u32) {
        let Unpacking { mut pending, mut vertices } = std::mem::take(self.unpacking);
        vertices.clear();
        let arc = PackedArc { from: node.id, to, middle };
        self.graph.unpack(arc, &mut pending, &mut |at| vertices.push(at));
        let (mut bend, mut at, mut g) = (node.parent, node.at, node.g);
        for &next in &vertices {
            if !may_join(self.space, self.bends[bend as usize].at, next) {
                bend = if at == node.at { self.own_bend(node) } else { self.bend(at, g, bend) };
            }
            let last = self.bends[bend as usize];
            (at, g) = (next, last.g + segment_cost(last.at.to(next)));
        }
        *self.unpacking = Unpacking { pending, vertices };
        (g, bend)
    }

    /// The bend at the expanded subgoal.
    fn own_bend(&mut self, node: &mut Node) -> u32 {
        let own = node.own_bend.unwrap_or_else(|| self.bend(node.at, node.g, node.parent));
        *node.own_bend.insert(own)
    }

    /// Adds a bend.
    fn bend(&mut self, at: Vertex, g: Cost, before: u32) -> u32 {
        self.bends.push(Waypoint { at, g, before });
        self.bends.len() as u32 - 1
    }

    /// Records a cheaper path to a subgoal that is not closed, or to the goal.
    fn reach(&mut self, id: u32, at: Vertex, g: Cost, bend: u32) {
        let h = segment_cost(at.to(self.goal));
        let parent = Some(self.bends[bend as usize].at).filter(|&parent| parent != at);
        let event = NodeEvent { at, parent, g, f: g + h };
        if self.tree.cost(id).is_some() {
            self.observer.updated(event);
        } else {
            self.observer.generated(event);
        }
        let (_, swaps) = self.tree.set_path_and_open(id, g, h, bend, ());
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
