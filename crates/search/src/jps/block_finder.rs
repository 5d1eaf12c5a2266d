//! Block-based jumps: axial jumps by words of 64 vertices.

use std::sync::Arc;

use mediant_grid::{
    Change, Grid, GridGraph, Identity, Interrupt, Interrupted, Placement, Vertex, uninterrupted,
};
use mediant_moves::KError;

use super::{
    axial::AxialStops,
    dead_ends::NearGoal,
    diagonals::DiagonalStops,
    error::JumpError,
    finder::{JumpContext, JumpFinder, quarter},
    planes::JumpPlanes,
    repair::{Altered, Repair, Stop},
    to_goal::ToGoal,
};
use crate::{
    canonical::Pruning,
    successors::{ExpandedNode, KnownPath, Successor},
};

/// Its name in errors.
const FINDER: &str = "the finder of jumps";

/// Makes jumps by words of 64 vertices, for k ≤ 3. Takes two and a half bytes a vertex, which clones share.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BlockFinder {
    pub(super) identity: Identity,
    axial: Arc<AxialStops>,
    diagonals: Arc<DiagonalStops>,
    /// How far dead ends reach; 0 if there are none.
    reach: u32,
    /// Whether dead ends are looked for.
    looks_for_dead_ends: bool,
}

impl BlockFinder {
    /// Prepares the finder of a grid graph, by the pruning rule of that grid graph.
    ///
    /// # Errors
    /// [`JumpError::Mismatch`] for a rule that was prepared for another grid graph; [`JumpError::K`] above
    /// k = 3.
    pub fn new<P: Placement>(graph: &GridGraph<P>, pruning: &Pruning<P>) -> Result<Self, JumpError> {
        Self::interruptible(graph, pruning, &Interrupt::NEVER)
    }

    /// [`new`](Self::new), which an interrupt can stop; it asks for each row.
    ///
    /// # Errors
    /// As for [`new`](Self::new), and [`JumpError::Interrupted`].
    pub fn interruptible<P: Placement>(
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, JumpError> {
        pruning.check(graph)?;
        JumpPlanes::check_k(graph)?;
        Ok(Self::with_planes(graph, JumpPlanes::new(graph, pruning, interrupt)?))
    }

    /// [`interruptible`](Self::interruptible) for few searches: dead ends are not looked for, now or in a
    /// [repair](Self::repaired). On maps of 281 × 209 and of 1024 × 1024 cells changes took 0.62 and 0.48 of
    /// the instructions, and searches 1.1 and 1.6 times as many.
    ///
    /// # Errors
    /// As for [`interruptible`](Self::interruptible).
    pub fn for_few_searches<P: Placement>(
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, JumpError> {
        pruning.check(graph)?;
        JumpPlanes::check_k(graph)?;
        let planes = JumpPlanes::without_dead_ends(graph, pruning, interrupt)?;
        Ok(Self { looks_for_dead_ends: false, ..Self::with_planes(graph, planes) })
    }

    /// Whether it is [for few searches](Self::for_few_searches).
    #[must_use]
    pub const fn is_for_few_searches(&self) -> bool {
        !self.looks_for_dead_ends
    }

    /// [`new`](Self::new) with a pruning rule that is that of the grid graph.
    pub(super) fn prepare<P: Placement>(graph: &GridGraph<P>, pruning: &Pruning<P>) -> Result<Self, KError> {
        JumpPlanes::check_k(graph)?;
        let planes = uninterrupted(|never| JumpPlanes::new(graph, pruning, never));
        Ok(Self::with_planes(graph, planes))
    }

    pub(super) fn with_planes<P: Placement>(graph: &GridGraph<P>, planes: JumpPlanes) -> Self {
        let JumpPlanes { axial, diagonals, reach, .. } = planes;
        let (axial, diagonals) = (Arc::new(axial), Arc::new(diagonals));
        Self { identity: graph.identity(), axial, diagonals, reach, looks_for_dead_ends: true }
    }

    /// The finder of the grid graph after a change of the map, by the pruning rule of that grid graph. It
    /// works as long as the change alters where jumps lead, and prepares a new finder where that would be
    /// quicker.
    ///
    /// It leads to the same costs as a new one. Whether it looks for dead ends was decided when it was made.
    ///
    /// # Errors
    /// [`JumpError::Mismatch`] if the change is not from the map of this finder to that of the grid graph, or
    /// if the rule was prepared for another one, and [`JumpError::Interrupted`].
    pub fn repaired<P: Placement>(
        &self,
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Self, JumpError> {
        match self.followed(graph, pruning, change, interrupt)? {
            Some((finder, _)) => Ok(finder),
            None => {
                let planes = self.planes_after(graph, pruning, change, interrupt)?;
                let looks_for_dead_ends = self.looks_for_dead_ends;
                Ok(Self { looks_for_dead_ends, ..Self::with_planes(graph, planes) })
            }
        }
    }

    /// New planes of the grid graph after a change, by what these know of dead ends.
    pub(super) fn planes_after<P: Placement>(
        &self,
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<JumpPlanes, Interrupted> {
        if !self.looks_for_dead_ends {
            return JumpPlanes::without_dead_ends(graph, pruning, interrupt);
        }
        let stops = (&*self.axial, &*self.diagonals, self.reach);
        match pruning.table() {
            Some(table) => Repair::new(graph, table, stops, interrupt).anew(pruning, change),
            None => JumpPlanes::new(graph, pruning, interrupt),
        }
    }

    /// [`repaired`](Self::repaired), with what the change alters; `None` where a new finder would be prepared
    /// sooner.
    pub(super) fn followed<P: Placement>(
        &self,
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<(Self, Altered)>, JumpError> {
        pruning.check(graph)?;
        let on = |grid: &Grid| Identity { map: Some(grid.id()), ..self.identity };
        self.identity.check(FINDER, ("the map before the change", on(change.before())))?;
        on(change.after()).check("the map after the change", ("the grid graph", graph.identity()))?;
        if change.before().id() == change.after().id() {
            return Ok(Some((self.clone(), Altered::default())));
        }
        let stops = (&*self.axial, &*self.diagonals, self.reach);
        let follow = |table| Repair::new(graph, table, stops, interrupt).follow(change);
        match pruning.table().map_or(Err(Stop::TooMuch), follow) {
            Ok((axial, diagonals, altered)) => {
                let (axial, diagonals) = (Arc::new(axial), Arc::new(diagonals));
                let after = Self { identity: graph.identity(), axial, diagonals, ..self.clone() };
                Ok(Some((after, altered)))
            }
            Err(Stop::TooMuch) => Ok(None),
            Err(Stop::Interrupted(interrupted)) => Err(interrupted.into()),
        }
    }

    pub(super) fn axial_stops(&self) -> &AxialStops {
        &self.axial
    }

    pub(super) fn diagonal_stops(&self) -> &DiagonalStops {
        &self.diagonals
    }

    /// The goal as the successor of a node from which a path can make the first leg to it, if it can make the
    /// second one, too.
    #[inline]
    pub(super) fn goal_beyond_turn<P: Placement>(
        &self,
        graph: &GridGraph<P>,
        node: &ExpandedNode,
        to_goal: &ToGoal,
    ) -> Option<Successor> {
        let ToGoal { index, steps, then: (even, then_steps) } = *to_goal;
        let step = graph.step(index);
        let (turn, cost) = (node.after(step, index, steps), step.cost * steps);
        if then_steps == 0 {
            return Some(turn.reached(cost, index));
        }
        if self.axial.legal_steps(turn.at, quarter(graph, even)) < then_steps {
            return None;
        }
        let beside = graph.step(even);
        let goal = turn.after(beside, even, then_steps);
        Some(goal.reached(cost + beside.cost * then_steps, even))
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
        NearGoal::new(goal, &self.axial, self.reach)
    }

    #[inline(always)]
    fn axial(
        &self,
        context: &JumpContext<'_, P>,
        from: &ExpandedNode,
        index: usize,
        _: Option<u32>,
        scanned: &mut u32,
    ) -> Option<u32> {
        // A goal straight ahead would have been in sight.
        let quarter = context.quarter(index);
        let is_near = context.rules.near.holds(from.at, quarter);
        let scan = self.axial.scan(from.at, quarter, is_near);
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
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) {
        let stops = (&*self.diagonals, self.reach > 0);
        context.diagonal_by_stops(self, stops, from, index, scanned, visit);
    }

    #[inline]
    fn goal_in_sight(
        &self,
        context: &JumpContext<'_, P>,
        node: &ExpandedNode,
        scanned: &mut u32,
    ) -> Option<Successor> {
        let ToGoal { index, steps, .. } = context.to_goal;
        *scanned += steps;
        let can_make = if index & 1 == 1 {
            let can_enter = |steps| context.can_enter(node, index, steps);
            steps <= context.rules.limit && self.diagonals.can_make(node.at, index, steps, can_enter)
        } else {
            self.axial.legal_steps(node.at, context.quarter(index)) >= steps
        };
        if can_make { self.goal_beyond_turn(context.graph, node, &context.to_goal) } else { None }
    }
}
