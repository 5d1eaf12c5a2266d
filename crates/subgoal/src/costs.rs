//! The costs of the arcs, which follow from the subgoals; and whether arcs that were read make a hierarchy at
//! all.

use mediant_grid::{FreeSpace, Interrupt, room_for};
use mediant_moves::Cost;

use crate::{
    arc::{NONE, Step, UpwardArc},
    error::SubgoalError,
    graph::SubgoalGraph,
    placement::SubgoalPlacement,
};

/// The stage that an interrupted call names.
const DURING: &str = "measuring arcs";

/// The subgoals between two questions of an interrupt.
const PIECE: usize = 1 << 10;

impl<P: SubgoalPlacement> SubgoalGraph<P> {
    /// The graph with the costs and steps of its arcs.
    ///
    /// # Errors
    /// [`SubgoalError::Bytes`] if the arcs lead in circles, if a shortcut leads over no subgoal below it, or
    /// if one is longer than any optimal path can be.
    pub(crate) fn with_costs(
        mut self,
        space: &FreeSpace<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, SubgoalError> {
        // An optimal path over N(2) visits each vertex at most once, and paths over other neighborhoods are
        // shorter. Shortcuts are not always optimal, but nearly. Without a bound, crafted bytes in which each
        // shortcut is twice as long as the one below it would make paths without end.
        let most = (space.vertex_count() as u64).saturating_mul(16 << Cost::FRACTION_BITS);
        let order = self.upward_order(interrupt)?;
        // The halves of a shortcut belong to its middle node, which must come before.
        let mut known = vec![false; self.subgoals()];
        for (number, id) in order.into_iter().enumerate() {
            interrupt.check_every(PIECE, number, DURING)?;
            let first = (self.offsets[id as usize] / 2) as usize;
            for number in first..first + self.up(id).len() {
                let UpwardArc { to, middle, .. } = self.arcs[number];
                let arc = UpwardArc::without_cost(to, middle);
                self.arcs[number] = if middle == NONE {
                    let v = self.subgoals.vertex(id).to(self.subgoals.vertex(to));
                    let step = Step::of(v);
                    UpwardArc { cost: self.metric.distance(v).to_bits(), first: step, last: step, ..arc }
                } else {
                    let halves = self.arc(middle, id).zip(self.arc(middle, to));
                    let halves = halves.filter(|_| known[middle as usize]);
                    let (a, b) =
                        halves.ok_or(SubgoalError::Bytes("a shortcut leads over no subgoal below it"))?;
                    let cost = a.cost.checked_add(b.cost).filter(|&cost| cost <= most);
                    let cost = cost.ok_or(SubgoalError::Bytes("a shortcut is too long"))?;
                    UpwardArc { cost, first: a.last.reversed(), last: b.last, ..arc }
                };
            }
            known[id as usize] = !self.is_core(id);
        }
        Ok(self)
    }

    /// All subgoals, each after those that have arcs up to it, and the core at the end.
    fn upward_order(&self, interrupt: &Interrupt) -> Result<Vec<u32>, SubgoalError> {
        let count = self.subgoals() as u32;
        // The number of arcs up to each subgoal whose lower ends are not in the order yet.
        room_for::<[u32; 3]>(count as usize, DURING)?;
        let mut below = vec![0_u32; count as usize];
        for id in 0..count {
            interrupt.check_every(PIECE, id as usize, DURING)?;
            for arc in self.up(id) {
                if self.is_core(id) && !self.is_core(arc.to) {
                    return Err(SubgoalError::Bytes("an arc leads out of the core"));
                }
                if !self.is_core(id) {
                    below[arc.to as usize] += 1;
                }
            }
        }
        let is_lowest = |id: &u32| below[*id as usize] == 0 && !self.is_core(*id);
        let mut order: Vec<u32> = (0..count).filter(is_lowest).collect();
        let mut next = 0;
        while let Some(&id) = order.get(next) {
            interrupt.check_every(PIECE, next, DURING)?;
            next += 1;
            for arc in self.up(id) {
                let below = &mut below[arc.to as usize];
                *below -= 1;
                if *below == 0 && !self.is_core(arc.to) {
                    order.push(arc.to);
                }
            }
        }
        if order.len() + self.core() != count as usize {
            return Err(SubgoalError::Bytes("some subgoals are above one another"));
        }
        order.extend((0..count).filter(|&id| self.is_core(id)));
        Ok(order)
    }
}
