//! A search of Theta* or Lazy Theta*.

use std::marker::PhantomData;

use mediant_grid::{GridGraph, Placement, Step, Vertex, VertexId};
use mediant_moves::Cost;

use super::{sight_cache::SightCache, sight_check::SightCheck};
use crate::{
    heuristic::Heuristic,
    nodes::{Node, NodeStore},
    observer::{NodeEvent, Observer},
    open_list::{Entry, OpenList},
    parent::ParentPointer,
    planner::SearchStatus,
    segment::{is_at_least, segment_cost},
};

/// No vertex.
const NOWHERE: VertexId = VertexId(u32::MAX);

/// The other vertices that a node stores.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parents {
    /// The parent on the best known path.
    pub(super) parent: VertexId,
    /// A vertex that it was found not to see. The neighbor that is expanded next often has the same parent,
    /// so this saves a second check.
    hidden_from: VertexId,
}

impl ParentPointer for Parents {
    type Words = [u32; 6];
    const UNKNOWN: [u32; 6] = [0; 6];

    #[inline]
    fn read(words: &[u32; 6]) -> Self {
        Self { parent: VertexId(words[4]), hidden_from: VertexId(words[5]) }
    }

    #[inline]
    fn write(self, words: &mut [u32; 6]) {
        (words[4], words[5]) = (self.parent.0, self.hidden_from.0);
    }

    #[inline]
    fn to(parent: VertexId) -> Self {
        Self { parent, hidden_from: NOWHERE }
    }

    #[inline]
    fn parent<P: Placement>(
        self,
        graph: &GridGraph<P>,
        _: &Step,
        _: VertexId,
        _: Vertex,
    ) -> (VertexId, Vertex) {
        (self.parent, graph.vertex(self.parent))
    }
}

/// One search.
pub(super) struct ThetaSearch<'s, P: Placement, H, S, O> {
    pub(super) graph: &'s GridGraph<P>,
    pub(super) heuristic: H,
    pub(super) nodes: &'s mut NodeStore<Parents>,
    pub(super) open: &'s mut OpenList,
    pub(super) sight: &'s mut SightCache,
    pub(super) observer: &'s mut O,
    pub(super) start: VertexId,
    pub(super) goal: VertexId,
    pub(super) goal_at: Vertex,
    pub(super) check: PhantomData<S>,
}

/// A vertex and the cost of a path to it.
#[derive(Clone, Copy)]
struct PathEnd {
    id: VertexId,
    at: Vertex,
    g: Cost,
}

impl<P: Placement, H: Heuristic, S: SightCheck, O: Observer> ThetaSearch<'_, P, H, S, O> {
    /// Makes the start the only node that is known.
    pub(super) fn begin(&mut self) {
        let at = self.graph.vertex(self.start);
        let h = self.heuristic.estimate(self.graph, at.to(self.goal_at));
        self.nodes.start_search();
        self.open.clear();
        self.nodes.set_path(self.start, Cost::ZERO, 0, Parents::to(self.start));
        self.observer.generated(NodeEvent { at, parent: None, g: Cost::ZERO, f: h });
        self.open.push(Entry::new(h, h, self.start), |id, slot| self.nodes.set_slot(id, slot));
    }

    /// Expands nodes until the goal is the best open node, none is open, or the observer pauses.
    pub(super) fn run(&mut self) -> SearchStatus {
        loop {
            if let Some(next) = self.open.get(0).filter(|next| next.id() != self.goal)
                && self.observer.pauses(next.f())
            {
                return SearchStatus::Searching;
            }
            let Some((entry, swaps)) = self.open.pop(|id, slot| self.nodes.set_slot(id, slot)) else {
                return SearchStatus::Unreachable;
            };
            self.observer.percolated(swaps);
            let id = entry.id();
            self.nodes.set_slot(id, Node::<Parents>::CLOSED);
            let Some(mut node) = self.nodes.get(id) else { continue };
            let here = PathEnd { id, at: self.graph.vertex(id), g: node.g };
            let mut f = entry.f();
            if !S::EAGER && !self.sees_parent(here, &node) {
                self.set_parent_to_neighbor(here);
                let Some(settled) = self.nodes.get(id) else { continue };
                f = settled.g + (f - node.g);
                node = settled;
            }
            if id == self.goal {
                return SearchStatus::Found;
            }
            let parent = (id != self.start).then(|| self.graph.vertex(node.pointer.parent));
            self.observer.expanded(NodeEvent { at: here.at, parent, g: node.g, f });
            if !self.graph.is_closed_gap(here.at) {
                self.observer.reached(here.at, node.g);
            }
            self.expand(PathEnd { g: node.g, ..here }, &node);
        }
    }

    /// Generates the successors of a node. The parent of each is the node's parent, if that sees it or is
    /// assumed to, and otherwise the node.
    #[inline]
    fn expand(&mut self, here: PathEnd, node: &Node<Parents>) {
        let graph = self.graph;
        let by = (here.id != self.start).then(|| node.arrived_by());
        // The start is its own parent.
        let parent = self.nodes.get(node.pointer.parent).map_or(here, |known| PathEnd {
            id: node.pointer.parent,
            at: graph.vertex(node.pointer.parent),
            g: known.g,
        });
        let grandparent = self.parent_of(parent.id);
        let has_closed_gaps = graph.has_closed_gaps();
        graph.for_each_successor(here.at, by, self.goal_at, |index| {
            let step = graph.step(index);
            let (id, at) = (step.target(here.id), here.at + step.vector());
            let known = self.nodes.get(id);
            if known.is_some_and(|known| known.slot == Node::<Parents>::CLOSED) {
                return;
            }
            let straight = parent.at.to(at);
            // By the triangle inequality the path through the node is no cheaper.
            if known.is_some_and(|known| known.g <= parent.g || is_at_least(straight, known.g - parent.g)) {
                return;
            }
            let hidden_from = known.map_or(NOWHERE, |known| known.pointer.hidden_from);
            if (!has_closed_gaps || self.may_be_parent(grandparent, parent.at, at))
                && (!S::EAGER || hidden_from != parent.id && self.sight.sees(graph, parent.id, parent.at, at))
            {
                let to = PathEnd { id, at, g: parent.g + segment_cost(straight) };
                return self.relax(to, index, known, parent.at, Parents { parent: parent.id, hidden_from });
            }
            let hidden = Parents { parent: here.id, hidden_from: parent.id };
            let to = PathEnd { id, at, g: here.g + step.cost };
            match known {
                Some(known) if known.g <= to.g => {
                    let parents = Parents { parent: known.pointer.parent, ..hidden };
                    self.nodes.set_path(id, known.g, known.arrived_by(), parents);
                }
                _ => self.relax(to, index, known, here.at, hidden),
            }
        });
    }

    /// Makes a cheaper path to a vertex, which is not closed, the best known one.
    #[inline]
    fn relax(
        &mut self,
        to: PathEnd,
        by: usize,
        known: Option<Node<Parents>>,
        parent: Vertex,
        parents: Parents,
    ) {
        let PathEnd { id, at, g } = to;
        self.nodes.set_path(id, g, by, parents);
        let event = |f| NodeEvent { at, parent: Some(parent), g, f };
        let moved = |id, slot| self.nodes.set_slot(id, slot);
        let swaps = if let Some(known) = known {
            let gain = known.g - g;
            let f = self.open.get(known.slot).map_or(g, |entry| entry.f() - gain);
            self.observer.updated(event(f));
            self.open.decrease(known.slot, gain, moved)
        } else {
            let h = self.heuristic.estimate(self.graph, at.to(self.goal_at));
            self.observer.generated(event(g + h));
            self.open.push(Entry::new(g + h, h, id), moved)
        };
        self.observer.percolated(swaps);
    }

    /// Whether closed gaps allow the path that comes from `before` to `parent` to go on straight to `at`. The
    /// parent of a gap is always the node that generated it (except at the goal), so that the last move tells
    /// through which quadrant the path came.
    fn may_be_parent(&self, before: Option<Vertex>, parent: Vertex, at: Vertex) -> bool {
        let graph = self.graph;
        graph.may_turn(before, parent, Some(at))
            && (!graph.is_closed_gap(at) || at == self.goal_at && graph.may_turn(Some(parent), at, None))
    }

    /// Whether a node sees its parent, as was assumed.
    fn sees_parent(&mut self, here: PathEnd, node: &Node<Parents>) -> bool {
        let parent = node.pointer.parent;
        here.id == self.start
            || self.graph.step(node.arrived_by()).source(here.id) == parent
            || self.sight.sees(self.graph, parent, self.graph.vertex(parent), here.at)
    }

    /// Makes the closed neighbor through which a node is cheapest its parent, the first of these in the order
    /// of the moves. There is at least one, that by which the node was generated.
    fn set_parent_to_neighbor(&mut self, here: PathEnd) {
        let graph = self.graph;
        let opposite = graph.steps().len() / 2;
        let mut best: Option<(Cost, usize, VertexId)> = None;
        graph.for_each_legal_move(here.at, |index| {
            let step = graph.step(index);
            let (id, at) = (step.target(here.id), here.at + step.vector());
            let Some(node) = self.nodes.get(id).filter(|node| node.slot == Node::<Parents>::CLOSED) else {
                return;
            };
            let g = node.g + step.cost;
            if best.is_none_or(|(least, ..)| g < least)
                && graph.may_turn(self.parent_of(id), at, Some(here.at))
                && (here.id != self.goal || graph.may_turn(Some(at), here.at, None))
            {
                best = Some((g, (index + opposite) % (2 * opposite), id));
            }
        });
        debug_assert!(best.is_some(), "{} was generated by no neighbor", here.at);
        if let Some((g, by, id)) = best {
            self.nodes.set_path(here.id, g, by, Parents::to(id));
        }
    }

    /// The parent of a node; `None` for the start.
    fn parent_of(&self, id: VertexId) -> Option<Vertex> {
        let node = self.nodes.get(id).filter(|_| id != self.start)?;
        Some(self.graph.vertex(node.pointer.parent))
    }
}
