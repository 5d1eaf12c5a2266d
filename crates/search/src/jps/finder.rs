//! How jumps are made: the point in which the engines of the jump point family differ.

use std::fmt::Debug;

use mediant_grid::{GridGraph, Identity, Placement, Step, Vector, Vertex};
use mediant_moves::Cost;

use crate::{
    canonical::{LocalRule, Pruning},
    successors::{ExpandedNode, Successor},
};

/// What the jumps from one node depend on.
pub struct JumpContext<'c, P: Placement> {
    pub(crate) graph: &'c GridGraph<P>,
    pub(crate) pruning: &'c Pruning<P>,
    pub(crate) goal: Vertex,
    /// Whether all jumps are made step by step: near closed gaps finders may be wrong.
    pub(crate) stepwise: bool,
    /// The most steps of a jump.
    pub(crate) limit: u32,
    /// Whether a diagonal jump ends at the first intermediate jump point.
    pub(crate) keeps_intermediate: bool,
}

/// Finds the jump points to which axial and diagonal jumps lead: [`StepwiseFinder`],
/// [`BlockFinder`](crate::parts::BlockFinder), or a shared [`JumpTable`](crate::JumpTable).
///
/// Axial jumps repeat an even-indexed move, diagonal jumps an odd-indexed one. All methods but
/// [`identity`](Self::identity) are for this crate alone.
pub trait JumpFinder<P: Placement>: Debug {
    /// What it belongs to; `None` for what serves every grid graph.
    fn identity(&self) -> Option<Identity>;

    /// The number of steps of the axial jump by move `index` from a vertex to a jump point or to the goal;
    /// `None` if it comes to neither. The goal is `goal_steps` ahead, if it lies ahead at all. Adds to
    /// `scanned` the number of vertices looked at.
    #[doc(hidden)]
    fn axial(
        &self,
        context: &JumpContext<'_, P>,
        from: &ExpandedNode,
        index: usize,
        goal_steps: Option<u32>,
        scanned: &mut u32,
    ) -> Option<u32>;

    /// What is known of the vertex `here` for a diagonal jump by move `index`.
    #[doc(hidden)]
    #[inline]
    fn local_rule(&self, context: &JumpContext<'_, P>, here: &ExpandedNode, index: usize) -> LocalRule {
        context.pruning.local_rule(context.graph, here, index)
    }

    /// Calls `visit` with all successors to which the diagonal jump by move `index` from a vertex leads.
    #[doc(hidden)]
    #[inline]
    fn diagonal(
        &self,
        context: &JumpContext<'_, P>,
        from: &ExpandedNode,
        index: usize,
        scanned: &mut u32,
        visit: &mut impl FnMut(Successor),
    ) {
        context.step_diagonal(self, from, index, scanned, visit);
    }
}

impl<P: Placement> JumpContext<'_, P> {
    /// The even moves beside an odd one.
    #[inline]
    pub(crate) fn beside(&self, index: usize) -> [usize; 2] {
        // The number of moves is a power of two.
        let last = self.graph.steps().len() - 1;
        [index.wrapping_sub(1) & last, (index + 1) & last]
    }

    /// Whether a path that came to `from` may go on by move `index`.
    #[inline]
    fn may_step(&self, from: &ExpandedNode, index: usize) -> bool {
        self.graph.may_step(from.at, from.by, index, self.goal)
    }

    #[inline]
    fn is_exempt(&self, at: Vertex, by: usize) -> bool {
        self.pruning.is_exempt(self.graph, at, by, self.goal)
    }

    /// The number of steps of move `v` from a vertex to the goal, if the goal lies in that direction.
    #[inline]
    pub(crate) fn steps_to_goal(&self, from: Vertex, v: Vector) -> Option<u32> {
        let d = from.to(self.goal);
        if cross(v, d) != 0 || i64::from(v.x) * i64::from(d.x) + i64::from(v.y) * i64::from(d.y) <= 0 {
            return None;
        }
        Some((d.x.unsigned_abs() + d.y.unsigned_abs()) / (v.x.unsigned_abs() + v.y.unsigned_abs()))
    }

    /// The vertex `n` steps of move `index` away.
    #[inline]
    pub(crate) fn after(&self, from: &ExpandedNode, step: &Step, index: usize, n: u32) -> ExpandedNode {
        let v = step.vector();
        let at = Vertex::new(from.at.x + v.x * n as i32, from.at.y + v.y * n as i32);
        ExpandedNode { id: step.target_after(from.id, n), at, by: Some(index) }
    }

    /// An axial jump, step by step; several steps at once where obstacles are so far that none of these
    /// vertices is a jump point.
    #[inline]
    pub(super) fn step_axial(
        &self,
        from: &ExpandedNode,
        index: usize,
        goal_steps: Option<u32>,
        scanned: &mut u32,
    ) -> Option<u32> {
        if !self.may_step(from, index) || !self.pruning.is_legal(self.graph, from, index) {
            return None;
        }
        let step = self.graph.step(index);
        let goal_steps = goal_steps.unwrap_or(u32::MAX).min(self.limit);
        let mut n = 0;
        loop {
            n += 1;
            *scanned += 1;
            let here = self.after(from, step, index, n);
            if n >= goal_steps || self.is_exempt(here.at, index) {
                return Some(n.min(goal_steps));
            }
            let rule = self.pruning.local_rule(self.graph, &here, index);
            if rule.forced {
                return Some(n);
            }
            if rule.steps > 0 {
                n += rule.steps;
                if n >= goal_steps {
                    return Some(goal_steps);
                }
            } else if !rule.ahead || !self.may_step(&here, index) {
                return None;
            }
        }
    }

    /// A diagonal jump, step by step.
    #[inline]
    pub(super) fn step_diagonal<J: JumpFinder<P> + ?Sized>(
        &self,
        finder: &J,
        from: &ExpandedNode,
        index: usize,
        scanned: &mut u32,
        visit: &mut impl FnMut(Successor),
    ) {
        if !self.may_step(from, index) || !self.pruning.is_legal(self.graph, from, index) {
            return;
        }
        let step = self.graph.step(index);
        let to_goal = GoalLegs::new(self, from.at, index);
        let mut here = self.after(from, step, index, 1);
        let mut cost = step.cost;
        for n in 1.. {
            *scanned += 1;
            let legs = to_goal.filter(|legs| legs.diagonal == n);
            let is_goal = legs.is_some_and(|legs| legs.axial == 0);
            let rule = finder.local_rule(self, &here, index);
            if is_goal || n >= self.limit || rule.forced || self.is_exempt(here.at, index) {
                return visit(here.reached(cost, index));
            }
            if (rule.beside || legs.is_some()) && self.jump_beside(finder, &here, cost, legs, scanned, visit)
            {
                return visit(here.reached(cost, index));
            }
            if !rule.ahead || !self.may_step(&here, index) {
                return;
            }
            here = self.after(&here, step, index, 1);
            cost += step.cost;
        }
    }

    /// The two axial jumps from a vertex of a diagonal jump. Returns whether the diagonal jump must end
    /// there, because the vertex is an intermediate jump point that becomes a node.
    #[inline]
    pub(super) fn jump_beside<J: JumpFinder<P> + ?Sized>(
        &self,
        finder: &J,
        from: &ExpandedNode,
        cost: Cost,
        to_goal: Option<GoalLegs>,
        scanned: &mut u32,
        visit: &mut impl FnMut(Successor),
    ) -> bool {
        let mut ends = false;
        for index in self.beside(from.by.unwrap_or(0)) {
            let goal_steps = to_goal.filter(|legs| legs.index == index).map(|legs| legs.axial);
            if let Some(n) = finder.axial(self, from, index, goal_steps, scanned) {
                ends |= self.keeps_intermediate;
                if !ends {
                    let step = self.graph.step(index);
                    visit(self.after(from, step, index, n).reached(cost + step.cost * n, index));
                }
            }
        }
        ends
    }
}

impl ExpandedNode {
    #[inline]
    pub(crate) fn reached(&self, cost: Cost, by: usize) -> Successor {
        Successor { id: self.id, at: self.at, cost, by }
    }
}

#[inline]
fn cross(v: Vector, d: Vector) -> i64 {
    i64::from(v.x) * i64::from(d.y) - i64::from(v.y) * i64::from(d.x)
}

/// Makes jumps vertex by vertex, for every k.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepwiseFinder;

impl<P: Placement> JumpFinder<P> for StepwiseFinder {
    fn identity(&self) -> Option<Identity> {
        None
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
        context.step_axial(from, index, goal_steps, scanned)
    }
}

/// The canonical path to the goal on an empty grid that begins with a given odd move: its two straight legs.
#[derive(Clone, Copy)]
pub(super) struct GoalLegs {
    /// How often the odd move is taken.
    pub(super) diagonal: u32,
    /// The even move that follows.
    pub(super) index: usize,
    /// How often that is taken.
    pub(super) axial: u32,
}

impl GoalLegs {
    /// The legs from a vertex, if the goal lies between the odd move and one of the even moves beside it.
    #[inline]
    pub(super) fn new<P: Placement>(
        context: &JumpContext<'_, P>,
        from: Vertex,
        index: usize,
    ) -> Option<Self> {
        let (d, u) = (from.to(context.goal), context.graph.step(index).vector());
        context.beside(index).into_iter().find_map(|beside| {
            let v = context.graph.step(beside).vector();
            // Adjacent moves span a parallelogram of area 1, so this is Cramer's rule without its
            // denominator.
            let sign = cross(u, v);
            let (diagonal, axial) = (cross(d, v) * sign, cross(u, d) * sign);
            (diagonal > 0 && axial >= 0).then_some(Self {
                diagonal: diagonal as u32,
                index: beside,
                axial: axial as u32,
            })
        })
    }
}
