//! How jumps are made: the point in which the engines of the jump point family differ.

use std::fmt::Debug;

use mediant_grid::{GridGraph, Identity, Placement, Step, Vector, Vertex, VertexId};
use mediant_moves::Cost;

use super::{
    dead_ends::NearGoal,
    diagonals::DiagonalStops,
    to_goal::{GoalLegs, ToGoal, cross, dot},
};
use crate::{
    canonical::Pruning,
    successors::{ExpandedNode, KnownPath, LookUp, Successor},
};

/// The graph, goal and rules for the jumps from one node.
pub struct JumpContext<'c, P: Placement> {
    pub(crate) graph: &'c GridGraph<P>,
    pub(crate) pruning: &'c Pruning<P>,
    pub(crate) goal: Vertex,
    pub(super) rules: &'c JumpRules,
    /// Whether all jumps are made step by step: near closed gaps finders may be wrong.
    pub(crate) stepwise: bool,
    /// For k ≤ 3, how the goal lies from the node.
    pub(super) to_goal: ToGoal,
}

/// The options of all jumps of one search.
#[derive(Clone, Copy, Debug)]
pub(super) struct JumpRules {
    /// Whether all jumps are made step by step.
    pub(super) stepwise: bool,
    /// Whether jumps may be looked up: they lead as far as they can, and to nothing but jump points.
    pub(super) looks_up: bool,
    /// The most steps of a jump.
    pub(super) limit: u32,
    /// Whether a diagonal jump ends at the first intermediate jump point.
    pub(super) keeps_intermediate: bool,
    /// Whether a diagonal jump may end in nodes of its own other than the goal.
    pub(super) has_other_nodes: bool,
    /// Where dead ends count as jump points.
    pub(super) near: NearGoal,
}

impl JumpRules {
    /// The options before a search begins.
    pub(super) const PLAIN: Self = Self {
        stepwise: false,
        looks_up: false,
        limit: u32::MAX,
        keeps_intermediate: false,
        has_other_nodes: false,
        near: NearGoal::EVERYWHERE,
    };
}

/// The even moves of a set for k ≤ 3, and the odd ones: in this order jumps are made. Axial ones first,
/// because what they find may cut the diagonal ones; and apart, because branches between them could not be
/// predicted.
#[inline]
pub(super) const fn in_order(moves: u8) -> [u8; 2] {
    [moves & 0x55, moves & 0xaa]
}

/// Finds the jump points to which axial and diagonal jumps lead: [`StepwiseFinder`],
/// [`BlockFinder`](crate::parts::BlockFinder), or a shared [`JumpTable`](crate::JumpTable).
///
/// Axial jumps repeat an even-indexed move, diagonal jumps an odd-indexed one. All methods but
/// [`identity`](Self::identity) are for this crate alone.
pub trait JumpFinder<P: Placement>: Debug {
    /// Whether it knows successors beforehand.
    #[doc(hidden)]
    const LOOKS_UP: bool = false;

    /// The identity of its grid graph; `None` if it serves every one.
    fn identity(&self) -> Option<Identity>;

    /// Where dead ends count as jump points in a search for this goal.
    #[doc(hidden)]
    fn near_goal(&self, goal: Vertex) -> NearGoal {
        let _ = goal;
        NearGoal::EVERYWHERE
    }

    /// The number of steps of the axial jump by move `index` from a vertex to a jump point or to the goal;
    /// `None` if it comes to neither. The goal is `goal_steps` ahead, if it lies ahead at all; where it is
    /// looked for before, it is not in sight. Adds to `scanned` the number of vertices looked at.
    #[doc(hidden)]
    fn axial(
        &self,
        context: &JumpContext<'_, P>,
        from: &ExpandedNode,
        index: usize,
        goal_steps: Option<u32>,
        scanned: &mut u32,
    ) -> Option<u32>;

    /// Calls `visit` with all successors to which the diagonal jump by move `index` from a vertex leads.
    #[doc(hidden)]
    #[inline]
    fn diagonal(
        &self,
        context: &JumpContext<'_, P>,
        from: &ExpandedNode,
        index: usize,
        scanned: &mut u32,
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) {
        context.step_diagonal(self, from, index, scanned, visit);
    }

    /// The goal as the successor of a node, if it looks for the goal at every node and that is in sight. The
    /// move that leads there first is one of those by which a path goes on. Adds to `scanned` the number of
    /// its steps.
    #[doc(hidden)]
    #[inline]
    fn goal_in_sight(
        &self,
        context: &JumpContext<'_, P>,
        node: &ExpandedNode,
        scanned: &mut u32,
    ) -> Option<Successor> {
        let _ = (context, node, scanned);
        None
    }

    /// Calls `visit` with all successors of a node at which a path arrived by a move, if they are known
    /// beforehand and the goal is not in sight. Of the search it needs to know where dead ends count as jump
    /// points, and the goal.
    #[doc(hidden)]
    #[inline]
    fn known_successors(
        &self,
        search: (&GridGraph<P>, &NearGoal, Vertex),
        node: (&ExpandedNode, usize),
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) -> LookUp {
        let _ = (search, node, visit);
        LookUp::Unknown
    }
}

impl<P: Placement> JumpContext<'_, P> {
    /// The even moves beside an odd one.
    #[inline]
    pub(crate) fn beside(&self, index: usize) -> [usize; 2] {
        beside(self.graph, index)
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
        if cross(v, d) != 0 || dot(v, d) <= 0 {
            return None;
        }
        Some((d.x.unsigned_abs() + d.y.unsigned_abs()) / (v.x.unsigned_abs() + v.y.unsigned_abs()))
    }

    /// The vertex `n` steps of move `index` away.
    #[inline]
    pub(crate) fn after(&self, from: &ExpandedNode, step: &Step, index: usize, n: u32) -> ExpandedNode {
        from.after(step, index, n)
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
        let goal_steps = goal_steps.unwrap_or(u32::MAX).min(self.rules.limit);
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
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) {
        if !self.may_step(from, index) || !self.pruning.is_legal(self.graph, from, index) {
            return;
        }
        let step = self.graph.step(index);
        let to_goal = GoalLegs::new(self.graph, from.at.to(self.goal), (index, self.beside(index)));
        let mut here = self.after(from, step, index, 1);
        let mut cost = step.cost;
        for n in 1.. {
            *scanned += 1;
            let legs = to_goal.filter(|legs| legs.diagonal == n);
            let is_goal = legs.is_some_and(|legs| legs.axial == 0);
            let rule = self.pruning.local_rule(self.graph, &here, index);
            let ends = is_goal || n >= self.rules.limit || rule.forced || self.is_exempt(here.at, index);
            let turn = if ends {
                Turn::Node
            } else {
                self.jump_beside(finder, here.reached(cost, index), legs, scanned, visit)
            };
            if turn == Turn::Node {
                visit(here.reached(cost, index));
            }
            if turn != Turn::Passed || !rule.ahead || !self.may_step(&here, index) {
                return;
            }
            here = self.after(&here, step, index, 1);
            cost += step.cost;
        }
    }

    /// The direction number of an even move.
    #[inline]
    pub(super) fn quarter(&self, index: usize) -> usize {
        quarter(self.graph, index)
    }

    /// A diagonal jump from stop to stop.
    #[inline]
    pub(super) fn diagonal_by_stops<J: JumpFinder<P> + ?Sized>(
        &self,
        finder: &J,
        (stops, passes_dead_ends): (&DiagonalStops, bool),
        from: &ExpandedNode,
        index: usize,
        scanned: &mut u32,
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) {
        let (step, beside) = (self.graph.step(index), self.beside(index));
        let v = step.vector();
        let mut scan = stops.scan(from.at, index);
        loop {
            let (steps, leads) = scan.next(|first| {
                let near =
                    |even| self.rules.near.along_diagonal(from.at + v * first as i32, v, self.quarter(even));
                passes_dead_ends.then(|| beside.map(near))
            });
            if self.rules.has_other_nodes {
                if self.ends_otherwise((from, index), (steps, leads != [false; 2]), visit) {
                    return;
                }
            } else if leads == [false; 2] {
                return;
            }
            let (here, cost) = (self.after(from, step, index, steps), step.cost * steps);
            for (even, leads) in beside.into_iter().zip(leads) {
                if !leads {
                    continue;
                }
                let Some(n) = finder.axial(self, &here, even, None, scanned) else { continue };
                let step = self.graph.step(even);
                let there = self.after(&here, step, even, n);
                let known = visit(there.reached(cost + step.cost * n, even));
                if self.is_cut(known, there.at, even, n) {
                    return;
                }
            }
        }
    }

    /// Whether a diagonal jump can enter a vertex that stops it and from which no axial jump leads on.
    pub(super) fn can_enter(&self, from: &ExpandedNode, index: usize, steps: u32) -> bool {
        self.pruning.diagonals_may_force() && {
            let before = self.after(from, self.graph.step(index), index, steps - 1);
            self.pruning.is_legal(self.graph, &before, index)
        }
    }

    /// Whether a diagonal jump ends before it comes to a stop or there, with or without a node, for another
    /// reason than that it is cut. `leads_on` says whether an axial jump leads on from the stop.
    fn ends_otherwise(
        &self,
        (from, index): (&ExpandedNode, usize),
        (steps, leads_on): (u32, bool),
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) -> bool {
        let step = self.graph.step(index);
        let can_enter = leads_on || self.can_enter(from, index, steps);
        let reached = (steps - u32::from(!can_enter)).min(self.rules.limit);
        if !can_enter && reached < self.rules.limit {
            return true;
        }
        let here = self.after(from, step, index, reached);
        let is_node = reached == self.rules.limit
            || self.rules.keeps_intermediate
            || self.pruning.diagonals_may_force() && self.pruning.local_rule(self.graph, &here, index).forced;
        if is_node {
            visit(here.reached(step.cost * reached, index));
        }
        is_node
    }

    /// The two axial jumps from a vertex of a diagonal jump.
    #[inline]
    fn jump_beside<J: JumpFinder<P> + ?Sized>(
        &self,
        finder: &J,
        from: Successor,
        to_goal: Option<GoalLegs>,
        scanned: &mut u32,
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) -> Turn {
        let mut turn = Turn::Passed;
        let node = ExpandedNode { id: from.id, at: from.at, by: Some(from.by) };
        for index in self.beside(from.by) {
            let goal_steps = to_goal.filter(|legs| legs.index == index).map(|legs| legs.axial);
            let Some(n) = finder.axial(self, &node, index, goal_steps, scanned) else { continue };
            if self.rules.keeps_intermediate {
                turn = Turn::Node;
                continue;
            }
            let step = self.graph.step(index);
            let there = self.after(&node, step, index, n);
            let known = visit(there.reached(from.cost + step.cost * n, index));
            if !self.stepwise && self.is_cut(known, there.at, index, n) {
                return Turn::Cut;
            }
        }
        turn
    }

    #[inline]
    fn is_cut(&self, known: KnownPath, at: Vertex, index: usize, n: u32) -> bool {
        is_cut(self.graph, known, (at, index), n)
    }
}

/// The direction number of an even move.
#[inline]
pub(super) fn quarter<P: Placement>(graph: &GridGraph<P>, index: usize) -> usize {
    index >> (graph.k().get() - 2)
}

/// The even moves beside an odd one.
#[inline]
fn beside<P: Placement>(graph: &GridGraph<P>, index: usize) -> [usize; 2] {
    // The number of moves is a power of two.
    let last = graph.steps().len() - 1;
    [index.wrapping_sub(1) & last, (index + 1) & last]
}

/// Whether a diagonal jump ends at a vertex from which an axial jump of `n` steps by the even move `index`
/// leads to a vertex to which a path is known.
#[inline]
pub(super) fn is_cut<P: Placement>(
    graph: &GridGraph<P>,
    known: KnownPath,
    (at, index): (Vertex, usize),
    n: u32,
) -> bool {
    known.gain() > graph.step(index).cost * (2 * n)
        || known.parent().is_some_and(|parent| last_leg(graph, parent, (at, index)) > n)
}

/// The number of steps of the even move `index` the path from a parent to a vertex ends with.
#[inline]
pub(super) fn last_leg<P: Placement>(
    graph: &GridGraph<P>,
    parent: VertexId,
    (at, index): (Vertex, usize),
) -> u32 {
    let (d, v) = (graph.vertex(parent).to(at), graph.step(index).vector());
    let [before, after] = beside(graph, index);
    // As in `GoalLegs`, with the even move in the place of the odd one.
    let across = cross(v, d);
    let (odd, sign) = if across > 0 { (before, 1) } else { (after, -1) };
    (cross(d, graph.step(odd).vector()) * sign).max(0) as u32
}

/// The answer of a diagonal jump at one of its vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turn {
    /// It goes on.
    Passed,
    /// It ends in a node.
    Node,
    /// It ends, because an earlier path leads through the vertex.
    Cut,
}

impl ExpandedNode {
    /// The vertex `n` steps of move `index` away.
    #[inline]
    pub(super) fn after(&self, step: &Step, index: usize, n: u32) -> Self {
        let v = step.vector();
        let at = Vertex::new(self.at.x + v.x * n as i32, self.at.y + v.y * n as i32);
        Self { id: step.target_after(self.id, n), at, by: Some(index) }
    }

    #[inline]
    pub(crate) fn reached(&self, cost: Cost, by: usize) -> Successor {
        Successor { id: self.id, at: self.at, cost, by }
    }
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
