//! Canonical A* as Rivera 2017 states it: complete, but not optimal for k ≥ 4.
//!
//! Rule variant: a node that was reached by an odd-indexed move is bidimensional (its successors are that
//! move and its two neighbors), one that was reached by an even-indexed move is unidimensional (that move
//! alone). 'A cell is a jump point if it is one on the 8-neighborhood'. The paper does not say what the
//! successors of a jump point are, beyond 'forced successors are required to preserve completeness'; here
//! they are all legal moves, as at the start.
//!
//! With no other jump points than those at which an arrival on the 8-neighborhood has a forced successor, the
//! search is not complete, contrary to Theorem 4: on random maps, k = 5 to 7, it missed 3 of 1,000 paths. The
//! reason: a vertex on the way along an axis may be reached more cheaply by a move that leads into the wall
//! beside it. The vertex keeps that move, and the way along the axis ends there. So all legal moves are also
//! taken
//! - at every vertex that touches a convex corner of an obstacle, and
//! - at every vertex where the arriving move cannot be repeated.
//!
//! Even so, 7 of 3,600 queries of four benchmark sets found no path at k = 7 (none at k = 4 and 5). For these
//! the search is repeated with all moves everywhere.

use std::ops::Deref;

use mediant_grid::{GridGraph, Placement, Vertex};

use super::{clearance::is_convex_corner, order::natural, pattern_table::pattern_at};
use crate::{
    best_first::BestFirst,
    guarantee::Guarantee,
    heuristic::Heuristic,
    successors::{ExpandedNode, KnownPath, Successor, Successors},
};

/// Canonical A* with the published rule.
pub type PaperCanonical<G, H> = BestFirst<G, H, PaperMoves>;

/// The moves that the published rule leaves.
#[derive(Clone, Debug)]
pub struct PaperMoves {
    /// For each pattern of cells around a vertex, whether it is a jump point of the 8-neighborhood.
    jump_points: Box<[bool]>,
    /// Whether all legal moves are taken at every vertex.
    is_unpruned: bool,
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>, H: Heuristic> PaperCanonical<G, H> {
    /// A planner with scratch memory for `graph`.
    #[must_use]
    pub fn new(graph: G, heuristic: H) -> Self {
        let is_jump_point = |pattern| {
            // The grid points around the vertex whose four cells the pattern holds.
            [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().any(|(x, y)| {
                let cells = [(-1, -1), (0, -1), (-1, 0), (0, 0)].map(|(dx, dy)| (x + dx, y + dy));
                cells.iter().all(|&(dx, dy)| P::pattern_holds(dx, dy))
                    && is_convex_corner(cells.map(|(dx, dy)| P::pattern_is_blocked(pattern, dx, dy)))
            })
        };
        let jump_points = (0..P::PATTERNS).map(is_jump_point).collect();
        Self::with_successors(graph, heuristic, PaperMoves { jump_points, is_unpruned: false })
    }

    /// Continues with another grid graph. The search that was begun last is forgotten. The scratch memory is
    /// kept if the grid graph has as many vertices.
    pub fn follow(&mut self, graph: G) {
        self.follow_graph(graph);
    }
}

impl<P: Placement> Successors<P> for PaperMoves {
    type ParentPointer = ();

    #[inline]
    fn for_each(
        &self,
        graph: &GridGraph<P>,
        node: ExpandedNode,
        goal: Vertex,
        mut visit: impl FnMut(Successor) -> KnownPath,
    ) -> u32 {
        let is_jump_point =
            self.is_unpruned || self.jump_points.get(pattern_at(graph, node.at)).is_none_or(|&is| is);
        let is_legal = |by: usize| graph.sees(node.at, node.at + graph.step(by).vector());
        let visit = |by: usize| {
            visit(node.step(graph, by));
        };
        match node.by.filter(|&by| !is_jump_point && !graph.has_closed_gaps() && is_legal(by)) {
            None => graph.for_each_successor(node.at, node.by, goal, visit),
            Some(by) => {
                natural(by, graph.steps().len()).filter(|&next| next == by || is_legal(next)).for_each(visit);
            }
        }
        0
    }

    fn begin_unpruned_retry(&mut self) -> bool {
        self.is_unpruned = true;
        true
    }

    fn end_unpruned_retry(&mut self) {
        self.is_unpruned = false;
    }

    fn guarantee(&self, _: &GridGraph<P>) -> Guarantee {
        Guarantee::Suboptimal
    }
}
