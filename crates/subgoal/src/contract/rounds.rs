//! Contraction hierarchies: in rounds, all subgoals whose priority is the least among their neighbors.
//!
//! # The rule
//!
//! The subgoals of a round, the *candidates*, are never neighbors. The shortcuts of each are found on the
//! graph as it is. A candidate whose true priority is not the least waits; the others are contracted in the
//! order of their numbers. So searches need no order, and threads change nothing.
//!
//! # Why it is exact
//!
//! It is as if they were contracted one after another. Before v is contracted, the candidates below v (by
//! number) are gone, and shortcuts stand for the paths over them. So a path that avoids them and v is still
//! there, and is a witness if it is as short as the path over v. A path over candidates below v may be gone.
//! But if it is shorter than the one over v, then that is no shortest path, whatever is contracted, and needs
//! no shortcut. The search for witnesses adds 1, the least difference of costs, for each candidate below v.
//! So what it finds is a witness of one kind or the other. Subgoals that wait are just not gone.
//!
//! # The budget
//!
//! A graph with a hierarchy has small cuts, and the work is in proportion to its edges: witness searches scan
//! 10 to 240 arcs an edge, on all maps of games, streets and rooms that were measured. They may scan
//! [`ARCS_PER_EDGE`]. A map of noise has no small cuts; the graph that remains becomes denser until the
//! budget ends, and is the core. A remainder so small that all its arcs together are no more than the first
//! edges is contracted, too, with shorter searches.

use mediant_grid::{Interrupted, room_for};

use super::{
    Contraction, DURING, SubgoalGeometry,
    evaluate::{Evaluation, Finders},
    priority::Priorities,
};

/// How many arcs one witness search scans to find the first priorities, which need not be exact.
const FIRST_WITNESS_LIMIT: u64 = 100;
/// How many arcs it scans at most in the first rounds.
const WITNESS_LIMIT: u64 = 800;
/// The limit grows as the square root of the part of the graph that is contracted, up to this factor: few
/// subgoals remain at the top of a hierarchy, they have many arcs, and superfluous shortcuts harm most.
const WITNESS_FACTOR: usize = 16;
/// How many arcs all witness searches scan at most, for each edge of the graph.
const ARCS_PER_EDGE: u64 = 256;
/// How many they scan to find the first priorities. Maps with a hierarchy take at most 57, most of them 20 to
/// 45; noise at any angle would take 140.
const FIRST_ARCS_PER_EDGE: u64 = 64;
/// How many arcs may be scanned on the smallest graph: work of a second. Half of it for the first priorities.
const LEAST_BUDGET: u64 = 1 << 26;
/// The most subgoals whose shortcuts are in memory at the same time.
const SLICE: usize = 4096;

impl<G: SubgoalGeometry + Sync> Contraction<G> {
    /// Contracts subgoals, lowest priority first, until none is left or the budget is used up.
    pub(crate) fn contract_by_priority(
        &mut self,
        progress: &mut dyn FnMut(usize),
    ) -> Result<(), Interrupted> {
        let edges = self.edges();
        let budgets = [(FIRST_ARCS_PER_EDGE, LEAST_BUDGET / 2), (ARCS_PER_EDGE, LEAST_BUDGET)]
            .map(|(per_edge, least)| least.max(per_edge.saturating_mul(edges)));
        self.contract_within(budgets, progress)
    }

    /// Contracts until so many arcs are scanned: to find the first priorities, and in all.
    pub(super) fn contract_within(
        &mut self,
        [first_budget, budget]: [u64; 2],
        progress: &mut dyn FnMut(usize),
    ) -> Result<(), Interrupted> {
        let edges = self.edges();
        let finders = Finders::default();
        room_for::<[u64; 12]>(self.arcs.len(), DURING)?;
        let mut priorities = Priorities::new(self.arcs.len());
        let mut check: Vec<u32> = (0..self.arcs.len() as u32).collect();
        let mut arcs_scanned = 0;
        for ids in check.chunks(SLICE) {
            for evaluation in self.evaluate(ids, &finders, FIRST_WITNESS_LIMIT, false)? {
                arcs_scanned += evaluation.arcs_scanned;
                self.set_priority(&mut priorities, &evaluation);
            }
            if arcs_scanned > first_budget {
                return Ok(());
            }
        }
        while !check.is_empty() {
            let left = self.arcs.len() - self.order.len();
            let limit = if arcs_scanned <= budget {
                let factor = (self.arcs.len() / left.max(1)).isqrt().min(WITNESS_FACTOR);
                WITNESS_LIMIT * factor as u64
            } else if (left as u64).pow(2) <= edges {
                FIRST_WITNESS_LIMIT
            } else {
                return Ok(());
            };
            check.sort_unstable();
            check.dedup();
            check.retain(|&id| priorities.is_least(id, &self.arcs[id as usize]));
            let candidates = std::mem::take(&mut check);
            arcs_scanned +=
                self.contract_round(&candidates, (&finders, limit), &mut priorities, &mut check, progress)?;
        }
        Ok(())
    }

    /// Contracts those candidates whose priority is still the least once it is known. Puts those whose
    /// priority may be the least in the next round into `check`. Returns the number of arcs scanned.
    fn contract_round(
        &mut self,
        candidates: &[u32],
        (finders, limit): (&Finders, u64),
        priorities: &mut Priorities,
        check: &mut Vec<u32>,
        progress: &mut dyn FnMut(usize),
    ) -> Result<u64, Interrupted> {
        for &id in candidates {
            self.in_round[id as usize] = true;
        }
        let mut neighbors = Vec::new();
        let mut arcs_scanned = 0;
        // Neighbors of candidates are no candidates. So what one slice changes is not what another looks at,
        // except for witnesses.
        for ids in candidates.chunks(SLICE) {
            self.arcs.check_room(DURING)?;
            self.upward.check_room(DURING)?;
            for evaluation in self.evaluate(ids, finders, limit, true)? {
                let id = evaluation.id;
                arcs_scanned += evaluation.arcs_scanned;
                self.set_priority(priorities, &evaluation);
                let around = &self.arcs[id as usize];
                check.extend(around.iter().map(|arc| arc.to));
                if priorities.is_least(id, around) {
                    priorities.deepen(id, around);
                    neighbors.extend(around.iter().map(|arc| arc.to));
                    self.contract(id, &evaluation.shortcuts);
                } else {
                    check.push(id);
                }
            }
            progress(self.order.len());
        }
        for &id in candidates {
            self.in_round[id as usize] = false;
        }
        for id in neighbors {
            priorities.lower(id, self.arcs[id as usize].len());
        }
        Ok(arcs_scanned)
    }

    /// The number of edges, before a subgoal is contracted.
    fn edges(&self) -> u64 {
        self.arcs.total() as u64 / 2
    }

    fn set_priority(&self, priorities: &mut Priorities, evaluation: &Evaluation) {
        let id = evaluation.id;
        priorities.set(id, evaluation.count, self.arcs[id as usize].len());
    }
}
