//! How runs are followed: the point in which the engines of the jump point family differ.

use std::{fmt::Debug, sync::Arc};

use mediant_grid::{Grid, GridGraph, Placement, Rules, Step, Vector, Vertex};
use mediant_moves::{Cost, FiniteK, KError};

use super::{JumpTable, axial::AxialStops, diagonals::DiagonalBits};
use crate::{
    ExpandedNode, Successor,
    canonical::{LocalRule, Pruning},
};

/// What a run is followed on, and where to.
pub struct JumpContext<'c, P: Placement> {
    pub(crate) graph: &'c GridGraph<P>,
    pub(crate) pruning: &'c Pruning<P>,
    pub(crate) goal: Vertex,
    /// Whether all runs are walked: closed gaps make some hard to foresee, and a finder may know another map.
    pub(crate) stepwise: bool,
    /// The longest run.
    pub(crate) limit: u32,
    /// Whether a slanted run ends at the first vertex that has anything to either side.
    pub(crate) keeps_intermediate: bool,
}

/// Finds the jump points of runs.
///
/// A *axial* run repeats an even move until its first vertex with a turn; a *diagonal* one repeats an odd move, and from each of its
/// vertices sends out the straight runs of the two even moves beside it. Neither leads to anything else on open ground.
pub trait JumpFinder<P: Placement>: Debug {
    /// Whether it was made for this grid graph.
    fn fits(&self, graph: &GridGraph<P>) -> bool;

    /// After how many steps the straight run of move `index` from a vertex comes to a jump point or to the goal; `None` if to
    /// neither. The goal is `goal_steps` ahead, if it lies ahead at all. Adds to `scanned` the vertices that it looks at.
    fn axial(
        &self,
        context: &JumpContext<'_, P>,
        from: &ExpandedNode,
        index: usize,
        goal_steps: Option<u32>,
        scanned: &mut u32,
    ) -> Option<u32>;

    /// What the vertex `here` allows to a slanted run of move `index`.
    #[inline]
    fn local_rule(&self, context: &JumpContext<'_, P>, here: &ExpandedNode, index: usize) -> LocalRule {
        context.pruning.local_rule(context.graph, here, index)
    }

    /// Calls `visit` with all that the slanted run of move `index` from a vertex leads to.
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

    /// Whether a path that came to `from` may step on by move `index`.
    #[inline]
    fn may_step(&self, from: &ExpandedNode, index: usize) -> bool {
        self.graph.may_step(from.at, from.by, index, self.goal)
    }

    #[inline]
    fn is_exempt(&self, at: Vertex, by: usize) -> bool {
        self.pruning.is_exempt(self.graph, at, by, self.goal)
    }

    /// After how many steps of move `v` from a vertex the goal comes, if it lies ahead.
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

    /// A straight run, vertex by vertex, but where the nearest obstacle is so far that several have no turn.
    #[inline]
    fn step_axial(
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

    /// A slanted run, vertex by vertex.
    #[inline]
    fn step_diagonal<J: JumpFinder<P> + ?Sized>(
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

    /// The two straight runs from a vertex of a slanted run. Whether the slanted run must end there for their sake.
    #[inline]
    fn jump_beside<J: JumpFinder<P> + ?Sized>(
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

/// Vertex by vertex, for every k.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepwiseFinder;

impl<P: Placement> JumpFinder<P> for StepwiseFinder {
    fn fits(&self, _: &GridGraph<P>) -> bool {
        true
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

/// Straight runs by words of 64 vertices, for k ≤ 3.
#[derive(Clone, Debug)]
pub struct BlockFinder {
    grid: Arc<Grid>,
    k: FiniteK,
    rules: Rules,
    axial: AxialStops,
    diagonals: DiagonalBits,
}

impl BlockFinder {
    /// The finder of a grid graph.
    ///
    /// # Errors
    /// [`KError::TooLarge`] above k = 3.
    pub fn new<P: Placement>(graph: &GridGraph<P>, pruning: &Pruning<P>) -> Result<Self, KError> {
        let (k, max) = (graph.k().get(), JumpTable::MAX_K);
        if k > max {
            return Err(KError::TooLarge { k, max });
        }
        let (grid, k, rules) = (Arc::clone(graph.grid()), graph.k(), graph.rules());
        Ok(Self {
            grid,
            k,
            rules,
            axial: AxialStops::new(graph),
            diagonals: DiagonalBits::new(graph, pruning),
        })
    }

    /// Its size.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.axial.memory_bytes() + self.diagonals.memory_bytes()
    }
}

impl<P: Placement> JumpFinder<P> for BlockFinder {
    fn fits(&self, graph: &GridGraph<P>) -> bool {
        (self.k, self.rules) == (graph.k(), graph.rules()) && Arc::ptr_eq(&self.grid, graph.grid())
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
    fn local_rule(&self, context: &JumpContext<'_, P>, here: &ExpandedNode, index: usize) -> LocalRule {
        if context.stepwise {
            return context.pruning.local_rule(context.graph, here, index);
        }
        if context.pruning.diagonals_may_force() {
            let rule = context.pruning.local_rule(context.graph, here, index);
            return LocalRule { beside: self.diagonals.at(here.at, index).1, ..rule };
        }
        let (ahead, beside) = self.diagonals.at(here.at, index);
        LocalRule { forced: false, ahead, steps: 0, beside }
    }
}

/// All runs from a table.
impl<P: Placement> JumpFinder<P> for Arc<JumpTable> {
    fn fits(&self, graph: &GridGraph<P>) -> bool {
        self.check(graph).is_ok()
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
        let (steps, found) = self.run(from.id, context.graph.step(index), index);
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
            let (steps, found) = self.run(here.id, step, index);
            if let Some(legs) = to_goal.filter(|legs| (gone + 1..=gone + steps).contains(&legs.diagonal)) {
                let elbow = context.after(from, step, index, legs.diagonal);
                let beside = context.graph.step(legs.index);
                if legs.axial == 0 || self.run(elbow.id, beside, legs.index).0 >= legs.axial {
                    // Nothing can be nearer to the goal by legs of this node.
                    let goal = context.after(&elbow, beside, legs.index, legs.axial);
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

/// The one legs to the goal, on an empty grid, that begins with a given odd move.
#[derive(Clone, Copy)]
struct GoalLegs {
    diagonal: u32,
    /// The even move that follows.
    index: usize,
    axial: u32,
}

impl GoalLegs {
    #[inline]
    fn new<P: Placement>(context: &JumpContext<'_, P>, from: Vertex, index: usize) -> Option<Self> {
        let (d, u) = (from.to(context.goal), context.graph.step(index).vector());
        context.beside(index).into_iter().find_map(|beside| {
            let v = context.graph.step(beside).vector();
            // Adjacent moves span a square of area 1, so this is Cramer's rule without its denominator.
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
