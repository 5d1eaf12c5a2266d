//! Searches for paths that make a shortcut superfluous.

use std::{cmp::Reverse, collections::BinaryHeap};

use mediant_grid::{Interrupted, room_in};

use super::{DURING, Overlay};

/// Searches for paths that avoid a subgoal: witnesses that it needs no shortcut.
#[derive(Default)]
pub(super) struct WitnessSearch {
    nodes: Vec<WitnessNode>,
    generation: u32,
    queue: BinaryHeap<Reverse<(u128, u32)>>,
    /// The targets without a witness, each with the most that one may cost; some of those with one.
    targets: Vec<(u32, u128)>,
    /// The most that a witness of each target may cost, and 0 before them.
    bounds: Vec<u128>,
    /// The number of targets without a witness.
    left: usize,
    /// The largest cost that a witness may have.
    max_cost: u128,
    /// The number of arcs that all searches scanned.
    pub(super) arcs_scanned: u64,
}

/// A node, in 24 bytes: those of a large graph are more than a processor's cache holds.
#[derive(Clone, Copy, Default)]
struct WitnessNode {
    /// The cost in two halves.
    cost: [u64; 2],
    /// The last search that reached it.
    generation: u32,
    /// The number of its bound, while it is a target without a witness; else 0.
    target: u32,
}

impl WitnessNode {
    const fn cost(&self) -> u128 {
        self.cost[0] as u128 | (self.cost[1] as u128) << 64
    }
}

/// The graph of a witness search.
pub(super) struct WitnessGraph<'c, O> {
    pub(super) overlay: &'c mut O,
    /// The subgoals of the current round.
    pub(super) in_round: &'c [bool],
    /// The subgoal that witnesses avoid.
    pub(super) without: u32,
}

impl WitnessSearch {
    /// Starts a search from a subgoal to targets, each with the most that a witness may cost.
    ///
    /// # Errors
    /// If there is no room for the nodes.
    pub(super) fn start(
        &mut self,
        count: usize,
        from: u32,
        targets: impl Iterator<Item = (u32, u128)>,
    ) -> Result<(), Interrupted> {
        let more = count.saturating_sub(self.nodes.len());
        room_in(&mut self.nodes, more, DURING)?;
        self.nodes.resize(count, WitnessNode::default());
        self.generation = self.generation.wrapping_add(1);
        if self.generation == 0 {
            self.nodes.fill(WitnessNode::default());
            self.generation = 1;
        }
        self.queue.clear();
        for (to, _) in self.targets.drain(..) {
            self.nodes[to as usize].target = 0;
        }
        self.targets.extend(targets);
        self.bounds.clear();
        self.bounds.push(0);
        self.max_cost = 0;
        for &(to, bound) in &self.targets {
            self.nodes[to as usize].target = self.bounds.len() as u32;
            self.bounds.push(bound);
            self.max_cost = self.max_cost.max(bound);
        }
        self.left = self.targets.len();
        self.reach(from, 0);
        Ok(())
    }

    fn reach(&mut self, at: u32, cost: u128) {
        let node = &mut self.nodes[at as usize];
        if node.generation != self.generation || cost < node.cost() {
            (node.cost, node.generation) = ([cost as u64, (cost >> 64) as u64], self.generation);
            if node.target != 0 && cost <= self.bounds[node.target as usize] {
                node.target = 0;
                self.left -= 1;
            }
            self.queue.push(Reverse((cost, at)));
        }
    }

    /// Dijkstra's algorithm, until every target has a witness or `limit` arcs are scanned. Skips subgoals
    /// from which the straight line to every target that is left, at the cost `distance`, is too long.
    pub(super) fn run(
        &mut self,
        WitnessGraph { overlay, in_round, without }: WitnessGraph<'_, impl Overlay>,
        limit: u64,
        distance: impl Fn(u32, u32) -> u128,
    ) {
        let limit = self.arcs_scanned.saturating_add(limit);
        while self.left > 0 && self.arcs_scanned < limit {
            let Some(Reverse((cost, at))) = self.queue.pop() else { return };
            if self.left < self.targets.len() {
                let Self { nodes, targets, .. } = self;
                targets.retain(|&(to, _)| nodes[to as usize].target != 0);
                self.max_cost = targets.iter().map(|&(_, bound)| bound).max().unwrap_or(0);
            }
            if cost > self.max_cost {
                return;
            }
            if cost > self.nodes[at as usize].cost() {
                continue;
            }
            self.arcs_scanned += 1;
            if cost > 0 && !self.targets.iter().any(|&(to, bound)| cost + distance(at, to) <= bound) {
                continue;
            }
            let around = overlay.around(at);
            self.arcs_scanned += around.len() as u64;
            for arc in around {
                let cost = cost + arc.cost;
                // Most arcs end here.
                if cost > self.max_cost || arc.to == without {
                    continue;
                }
                // One more for a subgoal that is contracted before the one to avoid.
                let cost = cost + u128::from(arc.to < without && in_round[arc.to as usize]);
                if cost <= self.max_cost {
                    self.reach(arc.to, cost);
                }
            }
        }
    }

    /// Whether a target has a witness.
    pub(super) fn has_witness(&self, to: u32) -> bool {
        self.nodes[to as usize].target == 0
    }
}
