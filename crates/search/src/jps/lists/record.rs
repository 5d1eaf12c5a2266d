//! The lists of single jump points.

use mediant_grid::{GridGraph, Placement};

use super::{
    super::{
        block_finder::BlockFinder,
        dead_ends::NearGoal,
        finder::{JumpContext, JumpFinder, JumpRules, in_order},
        to_goal::{ToGoal, cross},
    },
    Group, Jump,
};
use crate::{
    canonical::{Pruning, pattern_at},
    successors::{ExpandedNode, KnownPath},
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
        let last = self.groups(node, by, words);
        match last {
            Some(last) => words[last] |= Group::LAST,
            None => words.truncate(start),
        }
        last.map(|_| ())
    }

    /// Adds the groups of a list. Returns the place of the last one.
    fn groups(&self, node: &ExpandedNode, by: usize, words: &mut Vec<u32>) -> Option<usize> {
        let table = self.pruning.table()?;
        let moves = table.successors(by, pattern_at(self.graph, node.at));
        let mut last = None;
        for mut left in in_order(moves) {
            while left != 0 {
                let index = left.trailing_zeros() as usize;
                left &= left - 1;
                let jumps = self.jumps(node, index);
                let (length, count) = (self.length(node, index), jumps.len() as u32);
                last = Some(words.len());
                words.push(Group { index, length, count }.word()?);
                for jump in jumps {
                    words.push(jump.word()?);
                }
            }
        }
        last
    }

    /// The jumps by a move.
    fn jumps(&self, node: &ExpandedNode, index: usize) -> Vec<Jump> {
        let mut elsewhere = self.jumps_that_hold(node, index, Jump::ELSEWHERE).into_iter().peekable();
        let mut jumps = Vec::new();
        // Where a jump leads anywhere, it does near the goal, too, if not as far.
        for near in self.jumps_that_hold(node, index, Jump::NEAR_GOAL) {
            match elsewhere.next_if(|jump| jump.is_along(near)) {
                Some(far) if far.then_steps == near.then_steps => {
                    jumps.push(Jump { holds: near.holds | far.holds, ..near });
                }
                far => jumps.extend([near].into_iter().chain(far)),
            }
        }
        jumps.extend(elsewhere);
        jumps
    }

    /// The jumps by a move, all near the goal or all elsewhere.
    fn jumps_that_hold(&self, node: &ExpandedNode, index: usize, holds: u32) -> Vec<Jump> {
        let near = if holds == Jump::NEAR_GOAL { NearGoal::EVERYWHERE } else { NearGoal::NOWHERE };
        let has_other_nodes = self.pruning.diagonals_may_force();
        let rules = JumpRules { near, has_other_nodes, ..JumpRules::PLAIN };
        let (context, graph) = (self.context(node, &rules), self.graph);
        let mut jumps = Vec::new();
        if index & 1 == 0 {
            if let Some(steps) = self.blocks.axial(&context, node, index, None, &mut 0) {
                jumps.push(Jump { steps, then: Jump::NO_TURN, then_steps: 0, holds });
            }
            return jumps;
        }
        let beside = context.beside(index);
        self.blocks.diagonal(&context, node, index, &mut 0, &mut |next| {
            let (d, v) = (node.at.to(next.at), graph.step(index).vector());
            jumps.push(match beside.iter().position(|&even| even == next.by) {
                Some(then) => {
                    let steps = cross(graph.step(next.by).vector(), d).unsigned_abs();
                    Jump { steps, then: then as u32, then_steps: cross(v, d).unsigned_abs(), holds }
                }
                None => {
                    Jump { steps: d.x.abs().max(d.y.abs()) as u32, then: Jump::NO_TURN, then_steps: 0, holds }
                }
            });
            KnownPath::NONE
        });
        jumps
    }

    /// The context of jumps without a goal.
    fn context<'c>(&'c self, node: &ExpandedNode, rules: &'c JumpRules) -> JumpContext<'c, P> {
        let (graph, pruning, to_goal) = (self.graph, self.pruning, ToGoal::default());
        JumpContext { graph, pruning, goal: node.at, rules, stepwise: false, to_goal }
    }

    /// The number of times that a move can be repeated.
    fn length(&self, node: &ExpandedNode, index: usize) -> u32 {
        let context = self.context(node, &JumpRules::PLAIN);
        if index & 1 == 0 {
            return self.blocks.axial_stops().legal_steps(node.at, context.quarter(index));
        }
        let mut scan = self.blocks.diagonal_stops().scan(node.at, index);
        loop {
            let (steps, leads) = scan.next(|_| None);
            if leads == [false; 2] && !context.can_enter(node, index, steps) {
                return steps - 1;
            }
        }
    }
}
