//! Block-based jumps: axial jumps by words of 64 vertices.

use std::sync::Arc;

use mediant_grid::{GridGraph, Identity, Placement, VertexId};
use mediant_moves::KError;

use super::{
    axial::AxialStops,
    diagonals::DiagonalStops,
    finder::{JumpContext, JumpFinder},
    table::{JumpError, JumpTable},
};
use crate::{
    canonical::Pruning,
    successors::{ExpandedNode, Successor},
};

/// Makes jumps by words of 64 vertices, for k ≤ 3. Takes two and a half bytes a vertex, which clones share.
#[derive(Clone, Debug)]
pub struct BlockFinder {
    identity: Identity,
    axial: Arc<AxialStops>,
    diagonals: Arc<DiagonalStops>,
}

impl BlockFinder {
    /// Prepares the finder of a grid graph, by the pruning rule of that grid graph.
    ///
    /// # Errors
    /// [`JumpError::Mismatch`] for a rule that was prepared for another grid graph; [`JumpError::K`] above
    /// k = 3.
    pub fn new<P: Placement>(graph: &GridGraph<P>, pruning: &Pruning<P>) -> Result<Self, JumpError> {
        pruning.check(graph)?;
        Ok(Self::prepare(graph, pruning)?)
    }

    /// [`new`](Self::new) with a pruning rule that is that of the grid graph.
    pub(super) fn prepare<P: Placement>(graph: &GridGraph<P>, pruning: &Pruning<P>) -> Result<Self, KError> {
        let (k, max) = (graph.k().get(), JumpTable::MAX_K);
        if k > max {
            return Err(KError::TooLarge { k, max });
        }
        Ok(Self {
            identity: graph.identity(),
            axial: Arc::new(AxialStops::new(graph)),
            diagonals: Arc::new(DiagonalStops::new(graph, pruning)),
        })
    }

    /// The memory that the finder of a grid graph uses, in bytes.
    #[must_use]
    pub fn bytes<P: Placement>(graph: &GridGraph<P>) -> usize {
        AxialStops::bytes(graph).saturating_add(DiagonalStops::bytes(graph))
    }

    /// The memory used, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.axial.memory_bytes() + self.diagonals.memory_bytes()
    }
}

impl<P: Placement> JumpFinder<P> for BlockFinder {
    fn identity(&self) -> Option<Identity> {
        Some(self.identity)
    }

    #[inline]
    fn axial(
        &self,
        context: &JumpContext<'_, P>,
        from: &ExpandedNode,
        index: usize,
        goal_steps: Option<u32>,
        scanned: &mut u32,
    ) -> Option<u32> {
        if context.stepwise {
            return context.step_axial(from, index, goal_steps, scanned);
        }
        let quarter = index >> (context.graph.k().get() - 2);
        let scan = self.axial.scan(from.at, quarter, goal_steps);
        *scanned += scan.scanned;
        scan.found.then_some(scan.steps)
    }

    #[inline]
    fn diagonal(
        &self,
        context: &JumpContext<'_, P>,
        from: &ExpandedNode,
        index: usize,
        scanned: &mut u32,
        visit: &mut impl FnMut(Successor) -> Option<VertexId>,
    ) {
        if context.stepwise {
            return context.step_diagonal(self, from, index, scanned, visit);
        }
        let next = self.diagonals.stops(context, from, index);
        context.diagonal_by_stops(self, from, index, next, scanned, visit);
    }
}
