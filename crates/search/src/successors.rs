//! Which successors a search gives a node: the point in which the grid graph engines differ.

use std::fmt::Debug;

use mediant_grid::{GridGraph, Placement, Step, Vertex, VertexId};
use mediant_moves::Cost;

use crate::Guarantee;

/// A node that is about to be expanded.
#[derive(Clone, Copy, Debug)]
pub struct ExpandedNode {
    /// The vertex.
    pub id: VertexId,
    /// Where it is.
    pub at: Vertex,
    /// The index of the move with which the best known path arrives; `None` at the start.
    pub by: Option<usize>,
}

impl ExpandedNode {
    /// The successor by one move.
    #[must_use]
    #[inline]
    pub fn step<P: Placement>(&self, graph: &GridGraph<P>, by: usize) -> Successor {
        let step = graph.step(by);
        Successor { id: step.target(self.id), at: self.at + step.vector(), cost: step.cost, by }
    }
}

/// A vertex that a node leads to.
#[derive(Clone, Copy, Debug)]
pub struct Successor {
    /// The vertex.
    pub id: VertexId,
    /// Where it is.
    pub at: Vertex,
    /// What the way from the node to it costs.
    pub cost: Cost,
    /// The index of the last move on that way.
    pub by: usize,
}

/// How a search expands its nodes. `P` is the placement.
pub trait Successors<P: Placement>: Debug {
    /// What a node keeps to know its parent.
    type ParentPointer: ParentPointer;

    /// Whether the successors of a node depend on the move by which it was reached. (Under closed gaps they always do.)
    const DEPEND_ON_ARRIVAL: bool = true;

    /// Calls `visit` with each successor of a node. How many vertices it looked at while it scanned runs.
    fn for_each(
        &self,
        graph: &GridGraph<P>,
        node: ExpandedNode,
        goal: Vertex,
        visit: impl FnMut(Successor),
    ) -> u32;

    /// Whether of two equally cheap ways to a vertex the one whose last move is `new` replaces the one with `known`. A closed node
    /// is then expanded again.
    #[inline]
    fn prefers(&self, graph: &GridGraph<P>, new: usize, known: usize) -> bool {
        let _ = (graph, new, known);
        false
    }

    /// Called when a search found no path although there is one. Turns the pruning off and returns true if the search is to be
    /// repeated without it; [`end_unpruned_retry`](Self::end_unpruned_retry) is called afterwards. Only a pruning rule that is not
    /// complete needs this.
    fn begin_unpruned_retry(&mut self) -> bool {
        false
    }

    /// Turns the pruning on again.
    fn end_unpruned_retry(&mut self) {}

    /// What is promised of the paths.
    fn guarantee(&self, graph: &GridGraph<P>) -> Guarantee {
        Guarantee::Optimal(graph.k())
    }
}

/// How a node knows its parent: engines that take one move at a time need to keep nothing.
pub trait ParentPointer: Copy + Debug {
    /// For nodes that were never reached.
    const NONE: Self;

    /// What to keep of a parent.
    fn to(parent: VertexId) -> Self;

    /// The parent of the node (`id`, `at`) that was reached by the move `step`.
    fn parent<P: Placement>(
        self,
        graph: &GridGraph<P>,
        step: &Step,
        id: VertexId,
        at: Vertex,
    ) -> (VertexId, Vertex);
}

/// The parent is one move away.
impl ParentPointer for () {
    const NONE: Self = ();

    #[inline]
    fn to(_: VertexId) -> Self {}

    #[inline]
    fn parent<P: Placement>(
        self,
        _: &GridGraph<P>,
        step: &Step,
        id: VertexId,
        at: Vertex,
    ) -> (VertexId, Vertex) {
        (step.source(id), at + -step.vector())
    }
}

/// The parent itself.
impl ParentPointer for VertexId {
    const NONE: Self = Self(0);

    #[inline]
    fn to(parent: VertexId) -> Self {
        parent
    }

    #[inline]
    fn parent<P: Placement>(
        self,
        graph: &GridGraph<P>,
        _: &Step,
        _: VertexId,
        _: Vertex,
    ) -> (VertexId, Vertex) {
        (self, graph.vertex(self))
    }
}
