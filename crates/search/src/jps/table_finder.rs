//! Jumps that are looked up in a table (JPS+).

use std::sync::Arc;

use mediant_grid::{Identity, Placement};

use super::{
    finder::{GoalLegs, JumpContext, JumpFinder},
    table::JumpTable,
};
use crate::successors::{ExpandedNode, Successor};

/// Looks all jumps up.
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
        if context.stepwise {
            return context.step_axial(from, index, goal_steps, scanned);
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
        visit: &mut impl FnMut(Successor),
    ) {
        if context.stepwise {
            return context.step_diagonal(self, from, index, scanned, visit);
        }
        let step = context.graph.step(index);
        let to_goal = GoalLegs::new(context, from.at, index);
        let (mut here, mut gone) = (*from, 0);
        loop {
            let (steps, found) = self.jump(here.id, step, index);
            if let Some(legs) = to_goal.filter(|legs| (gone + 1..=gone + steps).contains(&legs.diagonal)) {
                let corner = context.after(from, step, index, legs.diagonal);
                let beside = context.graph.step(legs.index);
                if legs.axial == 0 || self.jump(corner.id, beside, legs.index).0 >= legs.axial {
                    // No path to the goal that begins with this jump is shorter.
                    let goal = context.after(&corner, beside, legs.index, legs.axial);
                    let cost = step.cost * legs.diagonal + beside.cost * legs.axial;
                    return visit(goal.reached(cost, if legs.axial == 0 { index } else { legs.index }));
                }
            }
            if !found {
                return;
            }
            gone += steps;
            here = context.after(&here, step, index, steps);
            let cost = step.cost * gone;
            let forced = context.pruning.diagonals_may_force()
                && context.pruning.local_rule(context.graph, &here, index).forced;
            if forced || context.keeps_intermediate {
                return visit(here.reached(cost, index));
            }
            context.jump_beside(self, &here, cost, None, scanned, visit);
        }
    }
}
