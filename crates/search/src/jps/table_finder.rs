//! Axial jumps that are looked up in a table (JPS+).

use std::sync::Arc;

use mediant_grid::{Identity, Placement, Vertex, VertexId};

use super::{
    dead_ends::NearGoal,
    finder::{JumpContext, JumpFinder},
    table::JumpTable,
};
use crate::successors::{ExpandedNode, Successor};

/// Looks axial jumps up.
impl<P: Placement> JumpFinder<P> for Arc<JumpTable> {
    fn identity(&self) -> Option<Identity> {
        Some(JumpTable::identity(self))
    }

    fn near_goal(&self, goal: Vertex) -> NearGoal {
        let Some((axial, reach)) = JumpTable::near_goal(self) else { return NearGoal::EVERYWHERE };
        NearGoal::new(goal, axial, *reach)
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
        if let Some((axial, _)) = JumpTable::near_goal(self) {
            let quarter = context.quarter(index);
            if context.rules.near.holds(from.at, quarter) {
                let scan = axial.scan(from.at, quarter, goal_steps, true);
                *scanned += scan.scanned;
                return scan.found.then_some(scan.steps);
            }
        }
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
        let stops = (self.diagonals(), JumpTable::near_goal(self).is_some());
        context.diagonal_by_stops(self, stops, from, index, scanned, visit);
    }
}
