//! The lists of single jump points.

use mediant_grid::{GridGraph, Placement, Vertex};

use super::{
    super::{
        block_finder::BlockFinder,
        finder::{JumpContext, JumpRules, in_order},
        to_goal::ToGoal,
    },
    words::{Head, Jump, MOST_STEPS, Route},
};
use crate::{
    canonical::{Pruning, pattern_at},
    successors::ExpandedNode,
};

/// Finds the jumps of single jump points.
pub(in super::super) struct Recorder<'r, P: Placement> {
    pub(in super::super) graph: &'r GridGraph<P>,
    pub(in super::super) pruning: &'r Pruning<P>,
    pub(in super::super) blocks: &'r BlockFinder,
}

impl<P: Placement> Recorder<'_, P> {
    /// Adds the list of a node; `None`, with nothing added, if it has none or a word cannot say it.
    pub(super) fn record(&self, node: &ExpandedNode, by: usize, words: &mut Vec<u32>) -> Option<()> {
        let start = words.len();
        let recorded = self.add(node, by, words);
        if recorded.is_none() {
            words.truncate(start);
        }
        recorded
    }

    fn add(&self, node: &ExpandedNode, by: usize, words: &mut Vec<u32>) -> Option<()> {
        let table = self.pruning.table()?;
        let moves = table.successors(by, pattern_at(self.graph, node.at));
        let (start, head) = (words.len(), Head::new(moves));
        words.resize(start + head.length(), 0);
        for mut left in in_order(moves) {
            while left != 0 {
                let index = left.trailing_zeros() as usize;
                left &= left - 1;
                let jump = |jump: Jump| jump.word().map(|word| words.push(word));
                let length = self.jumps(node, index, jump).filter(|&length| length <= MOST_STEPS)?;
                let rank = head.rank(index);
                words[start + 1 + rank / 2] |= length << (16 * (rank & 1));
            }
        }
        let jumps = (words.len() - start - head.length()) as u32;
        words[start] = Head { jumps, ..head }.word().filter(|_| moves != 0)?;
        Some(())
    }

    /// Calls `visit` with the jumps by a move, until it says `None`. Returns how often the move can be
    /// repeated.
    fn jumps(
        &self,
        node: &ExpandedNode,
        index: usize,
        mut visit: impl FnMut(Jump) -> Option<()>,
    ) -> Option<u32> {
        let (context, diagonals_may_force) = (self.context(node), self.pruning.diagonals_may_force());
        let alone = Route::number(index, None);
        if index & 1 == 0 {
            let quarter = context.quarter(index);
            let jump = |steps, holds| visit(Jump { route: alone, steps, then_steps: 0, holds });
            self.axial((node.at, quarter), jump)?;
            return Some(self.blocks.axial_stops().legal_steps(node.at, quarter));
        }
        let (step, beside) = (self.graph.step(index), context.beside(index));
        let mut scan = self.blocks.diagonal_stops().scan(node.at, index);
        let mut is_ended = false;
        loop {
            // With all the stops near the goal: where jumps pass dead ends, they find nothing there.
            let (steps, leads) = scan.next(|_| Some([!0; 2]));
            if leads == [false; 2] && !context.can_enter(node, index, steps) {
                return Some(steps - 1);
            }
            if is_ended {
                // The move can be repeated beyond the last jump point.
                continue;
            }
            let at = node.at + step.vector() * steps as i32;
            if diagonals_may_force && self.pruning.has_forced_at(pattern_at(self.graph, at), index) {
                let holds = Jump::NEAR_GOAL | Jump::ELSEWHERE;
                visit(Jump { route: alone, steps, then_steps: 0, holds })?;
                is_ended = true;
                continue;
            }
            for (turn, (even, leads)) in (0..).zip(beside.into_iter().zip(leads)) {
                if leads {
                    let route = Route::number(index, Some(turn));
                    let jump = |then_steps, holds| visit(Jump { route, steps, then_steps, holds });
                    self.axial((at, context.quarter(even)), jump)?;
                }
            }
        }
    }

    /// Calls `visit` with how far axial jumps lead to a jump point, and where they do: if they lead anywhere,
    /// they do near the goal, too, if not as far.
    fn axial(
        &self,
        (from, quarter): (Vertex, usize),
        mut visit: impl FnMut(u32, u32) -> Option<()>,
    ) -> Option<()> {
        let axial = self.blocks.axial_stops();
        let near = axial.scan(from, quarter, true);
        if !near.found {
            return Some(());
        }
        let far = axial.scan(from, quarter, false);
        if far.found && far.steps == near.steps {
            return visit(near.steps, Jump::NEAR_GOAL | Jump::ELSEWHERE);
        }
        visit(near.steps, Jump::NEAR_GOAL)?;
        if far.found { visit(far.steps, Jump::ELSEWHERE) } else { Some(()) }
    }

    /// The context of jumps without a goal.
    fn context(&self, node: &ExpandedNode) -> JumpContext<'_, P> {
        let (graph, pruning, to_goal) = (self.graph, self.pruning, ToGoal::default());
        JumpContext { graph, pruning, goal: node.at, rules: &JumpRules::PLAIN, stepwise: false, to_goal }
    }
}
