//! Canonical A*: the planner.

use std::{ops::Deref, sync::Arc};

use mediant_grid::{GridGraph, Mismatch, Placement, Vertex};

use super::{
    order::rank,
    pruning::{Pruning, prunes},
};
use crate::{
    best_first::BestFirst,
    heuristic::Heuristic,
    successors::{ExpandedNode, KnownPath, Successor, Successors},
};

/// Canonical A*: optimal over N(k), for every k, both placements and all rules of motion.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Canonical, Ends, Hk, Planner};
///
/// let map = AsciiMap::parse("
///     ....
///     .#..
/// ")?;
/// let graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::new(4)?, CornerRule::Never)?;
/// let answer = Canonical::new(&graph, Hk).solve(Ends::new((0, 0), (3, 1)))?;
/// assert_eq!(answer.path().map(|path| path.cost()), Some(1.0 + 5.0_f64.sqrt()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type Canonical<G, H, P> = BestFirst<G, H, CanonicalMoves<P>>;

/// The moves that the rule does not prune; where it would cost more to find these, all legal moves.
#[derive(Clone, Debug)]
pub struct CanonicalMoves<P: Placement> {
    pub(super) pruning: Arc<Pruning<P>>,
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>, H: Heuristic> Canonical<G, H, P> {
    /// A planner with scratch memory for `graph`, and its own [`Pruning`].
    #[must_use]
    pub fn new(graph: G, heuristic: H) -> Self {
        let pruning = Arc::new(Pruning::new(&*graph));
        Self::with_successors(graph, heuristic, CanonicalMoves { pruning })
    }

    /// A planner that shares its pruning rule with others.
    ///
    /// # Errors
    /// [`Mismatch`] for a rule that was prepared for another map, k or rule of motion.
    pub fn with_pruning(graph: G, pruning: Arc<Pruning<P>>, heuristic: H) -> Result<Self, Mismatch> {
        pruning.check(&graph)?;
        Ok(Self::with_successors(graph, heuristic, CanonicalMoves { pruning }))
    }

    /// Continues with another grid graph, by its pruning rule. The search that was begun last is forgotten.
    /// The scratch memory is kept if the grid graph has as many vertices.
    ///
    /// # Errors
    /// As for [`with_pruning`](Self::with_pruning). Nothing is changed then.
    pub fn follow(&mut self, graph: G, pruning: Arc<Pruning<P>>) -> Result<(), Mismatch> {
        pruning.check(&graph)?;
        self.follow_with(graph, CanonicalMoves { pruning });
        Ok(())
    }
}

impl<P: Placement> Successors<P> for CanonicalMoves<P> {
    type ParentPointer = ();

    #[inline]
    fn for_each(
        &self,
        graph: &GridGraph<P>,
        node: ExpandedNode,
        goal: Vertex,
        mut visit: impl FnMut(Successor) -> KnownPath,
    ) -> u32 {
        let is_pruned = |by: &usize| {
            !self.pruning.is_exempt(graph, node.at, *by, goal)
                && !self.pruning.takes_all_moves(graph, &node, *by)
        };
        let mut visit = |by: usize| {
            visit(node.step(graph, by));
        };
        match node.by.filter(is_pruned) {
            None => graph.for_each_successor(node.at, node.by, goal, visit),
            Some(by) => self.pruning.for_each(graph, &node, by, |next| {
                if graph.may_step(node.at, node.by, next, goal) {
                    visit(next);
                }
            }),
        }
        0
    }

    #[inline]
    fn prefers(&self, graph: &GridGraph<P>, new: usize, known: usize) -> bool {
        prunes(graph) && rank(new) < rank(known)
    }
}
