//! Block-based jumps: axial jumps by words of 64 vertices.

use std::sync::Arc;

use mediant_grid::{GridGraph, Identity, Placement, Vertex, VertexId};
use mediant_moves::KError;

use super::{
    axial::AxialStops,
    dead_ends::{DeadEnds, NearGoal, REACH},
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
    /// How far dead ends reach; 0 if there are none.
    reach: u32,
}

/// On maps with more jump points than one for so many vertices, as in noise, dead ends make searches hardly
/// shorter, and there would be many to find.
const VERTICES_A_JUMP_POINT: u64 = 4;
/// On larger maps it takes longer to find the dead ends than some hundred searches would save.
const MOST_VERTICES: u64 = 1 << 22;

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
        let (axial, diagonals) = (AxialStops::new(graph), DiagonalStops::new(graph, pruning));
        let vertices = graph.vertex_count() as u64;
        let pays = vertices <= MOST_VERTICES && VERTICES_A_JUMP_POINT * axial.jump_points() <= vertices;
        Ok(Self::with_dead_ends(graph, pruning, (axial, diagonals), if pays { REACH } else { 0 }))
    }

    /// The finder with dead ends that reach so far; 0 for none.
    pub(super) fn with_dead_ends<P: Placement>(
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        (mut axial, diagonals): (AxialStops, DiagonalStops),
        reach: u32,
    ) -> Self {
        let reach = if graph.has_closed_gaps() { 0 } else { reach };
        let table = pruning.table().filter(|_| reach > 0);
        let are_marked = table.is_some_and(|table| {
            let dead_ends = DeadEnds { graph, pruning, table, diagonals: &diagonals, reach };
            let quarters = (0..4).step_by(8 / graph.steps().len());
            axial.mark(quarters, |axial, at, quarter| dead_ends.holds(axial, at, quarter))
        });
        let reach = if are_marked { reach } else { 0 };
        Self { identity: graph.identity(), axial: Arc::new(axial), diagonals: Arc::new(diagonals), reach }
    }

    #[cfg(test)]
    pub(super) fn axial(&self) -> &AxialStops {
        &self.axial
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

    fn near_goal(&self, goal: Vertex) -> NearGoal {
        if self.reach == 0 {
            return NearGoal::EVERYWHERE;
        }
        let steps = [0, 1, 2, 3].map(|quarter| self.axial.legal_steps(goal, quarter));
        NearGoal::new(goal, steps, self.reach)
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
        let is_near = context.near.holds(from.at, quarter);
        let scan = self.axial.scan(from.at, quarter, goal_steps, is_near);
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
