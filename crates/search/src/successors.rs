//! The successors of a node: the point in which the grid graph engines differ.

use std::fmt::Debug;

use mediant_grid::{GridGraph, Placement, Vertex, VertexId};
use mediant_moves::Cost;

use crate::{guarantee::Guarantee, parent::ParentPointer};

/// A node that is about to be expanded.
#[derive(Clone, Copy, Debug)]
pub struct ExpandedNode {
    /// The id of its vertex.
    pub id: VertexId,
    /// Its vertex.
    pub at: Vertex,
    /// The index of the move with which the best known path arrives; `None` at the start.
    pub by: Option<usize>,
}

impl ExpandedNode {
    /// The successor by one move of the grid graph.
    #[must_use]
    #[inline]
    pub fn step<P: Placement>(&self, graph: &GridGraph<P>, by: usize) -> Successor {
        let step = graph.step(by);
        Successor { id: step.target(self.id), at: self.at + step.vector(), cost: step.cost, by }
    }
}

/// A vertex to which an expanded node leads.
#[derive(Clone, Copy, Debug)]
pub struct Successor {
    /// The id of the vertex.
    pub id: VertexId,
    /// The vertex.
    pub at: Vertex,
    /// The cost of the path from the node to it.
    pub cost: Cost,
    /// The index of the last move on that path.
    pub by: usize,
}

/// The known path to a successor, where the new one does not replace it.
///
/// Two words, so that it is returned in registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KnownPath {
    gain: Cost,
    parent: VertexId,
}

impl KnownPath {
    /// No path is known that is as good as the new one.
    pub const NONE: Self = Self { gain: Cost::ZERO, parent: Self::NO_PARENT };
    /// No map has so many vertices.
    const NO_PARENT: VertexId = VertexId(u32::MAX);

    /// A path that costs less by `gain`, and its parent, if it arrives by the same move as the new one and if
    /// nodes store their parents.
    #[must_use]
    #[inline]
    pub fn new(gain: Cost, parent: Option<VertexId>) -> Self {
        Self { gain, parent: parent.unwrap_or(Self::NO_PARENT) }
    }

    /// How much less it costs than the new one.
    #[must_use]
    #[inline]
    pub const fn gain(self) -> Cost {
        self.gain
    }

    /// Its parent, if it arrives by the same move as the new one, and if nodes store their parents.
    #[must_use]
    #[inline]
    pub fn parent(self) -> Option<VertexId> {
        (self.parent != Self::NO_PARENT).then_some(self.parent)
    }
}

/// The successors of a node, as far as they are known beforehand.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum LookUp {
    /// Nothing.
    Unknown,
    /// All of them were visited.
    Visited,
    /// No other one need be visited.
    Goal(Successor),
}

/// How a search expands its nodes. `P` is the placement.
///
/// A search with successors of one's own: see
/// [`BestFirst::with_successors`](crate::parts::BestFirst::with_successors).
pub trait Successors<P: Placement>: Debug {
    /// The pointer from a node to its parent.
    type ParentPointer: ParentPointer;

    /// Whether the successors of a node depend on the move by which it was reached. (Under closed gaps they
    /// always do.)
    const DEPEND_ON_ARRIVAL: bool = true;

    /// Called before each search, with its goal.
    fn begin(&mut self, graph: &GridGraph<P>, goal: Vertex) {
        let _ = (graph, goal);
    }

    /// Calls `visit` with each successor of a node, on the way to `goal`. `visit` returns the path that is
    /// known to this successor, if the new one does not replace it.
    ///
    /// Returns the number of vertices scanned, for [`Observer::scanned`](crate::Observer::scanned); 0 unless
    /// it jumps.
    fn for_each(
        &self,
        graph: &GridGraph<P>,
        node: ExpandedNode,
        goal: Vertex,
        visit: impl FnMut(Successor) -> KnownPath,
    ) -> u32;

    /// Calls `visit` with each successor of a node, as [`for_each`](Self::for_each) does, if they are known
    /// beforehand. If the goal is one of them, and no path to it is cheaper, it may say so instead.
    #[doc(hidden)]
    #[inline]
    fn look_up(
        &self,
        graph: &GridGraph<P>,
        node: ExpandedNode,
        goal: Vertex,
        visit: impl FnMut(Successor) -> KnownPath,
    ) -> LookUp {
        let _ = (graph, node, goal, visit);
        LookUp::Unknown
    }

    /// Whether a path to a vertex whose last move is `new` replaces the known path, of the same cost, whose
    /// last move is `known`. A closed node is then expanded again.
    #[inline]
    fn prefers(&self, graph: &GridGraph<P>, new: usize, known: usize) -> bool {
        let _ = (graph, new, known);
        false
    }

    /// Called when a search has found no path although there is one. Turns the pruning off and returns true
    /// if the search is to be repeated without it; [`end_unpruned_retry`](Self::end_unpruned_retry) is called
    /// afterwards. Only a pruning rule that is not complete needs this.
    fn begin_unpruned_retry(&mut self) -> bool {
        false
    }

    /// Turns the pruning on again.
    fn end_unpruned_retry(&mut self) {}

    /// The guarantee of the paths, when the heuristic is admissible.
    fn guarantee(&self, graph: &GridGraph<P>) -> Guarantee {
        Guarantee::Optimal(graph.k())
    }
}
