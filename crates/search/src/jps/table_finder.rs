//! Axial jumps that are looked up in a table (JPS+).

use std::sync::Arc;

use mediant_grid::{Identity, Placement, VertexId};

use super::{
    finder::{JumpContext, JumpFinder},
    table::JumpTable,
};
use crate::successors::{ExpandedNode, Successor};

/// Looks axial jumps up.
impl<P: Placement> JumpFinder<P> for Arc<JumpTable> {
    fn identity(&self) -> Option<Identity> {
        Some(JumpTable::identity(self))
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
        let (steps, found) = self.jump(from.id, context.graph.step(index), index);
        match goal_steps {
            Some(goal_steps) if goal_steps <= steps => Some(goal_steps),
            _ => found.then_some(steps),
        }
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
        let stops = (self.diagonals(), false);
        context.diagonal_by_stops(self, stops, from, index, scanned, visit);
    }
}
