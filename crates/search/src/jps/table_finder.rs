//! Jumps by the lists of a jump table (JPS+).

use std::sync::Arc;

use mediant_grid::{GridGraph, Identity, Placement, Vertex};

use super::{
    dead_ends::NearGoal,
    finder::{JumpContext, JumpFinder},
    table::JumpTable,
};
use crate::successors::{ExpandedNode, KnownPath, LookUp, Successor};

/// Looks the jumps from jump points up. Where they are not known, it makes them as the
/// [`BlockFinder`](super::BlockFinder) does.
impl<P: Placement> JumpFinder<P> for Arc<JumpTable> {
    const LOOKS_UP: bool = true;

    fn identity(&self) -> Option<Identity> {
        Some(JumpTable::identity(self))
    }

    fn near_goal(&self, goal: Vertex) -> NearGoal {
        JumpFinder::<P>::near_goal(self.blocks(), goal)
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
        self.blocks().axial(context, from, index, goal_steps, scanned)
    }

    fn diagonal(
        &self,
        context: &JumpContext<'_, P>,
        from: &ExpandedNode,
        index: usize,
        scanned: &mut u32,
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) {
        self.blocks().diagonal(context, from, index, scanned, visit);
    }

    #[inline]
    fn goal_in_sight(
        &self,
        context: &JumpContext<'_, P>,
        node: &ExpandedNode,
        scanned: &mut u32,
    ) -> Option<Successor> {
        self.blocks().goal_in_sight(context, node, scanned)
    }

    #[inline]
    fn known_successors(
        &self,
        search: (&GridGraph<P>, &NearGoal, Vertex),
        node: (&ExpandedNode, usize),
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) -> LookUp {
        self.lists().visit(search, self.blocks(), node, visit)
    }
}
