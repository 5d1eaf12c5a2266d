//! Finds the dead ends of a grid graph.

use mediant_grid::{GridGraph, Interrupt, Interrupted, Placement, Vertex};

use super::{
    super::{axial::AxialStops, stop_rows::Leads},
    DeadEndRows,
};
use crate::canonical::{PatternTable, pattern_at};

/// The most jump points one behind the other in a dead end.
const DEPTH: u32 = 4;

/// Finds the dead ends of a grid graph.
pub(crate) struct DeadEndFinder<'g, P: Placement> {
    pub(crate) graph: &'g GridGraph<P>,
    pub(crate) table: &'g PatternTable,
    /// From where jumps come to a jump point; `None` where only few dead ends are looked for.
    pub(crate) leads: Option<&'g Leads>,
    pub(crate) reach: u32,
}

impl<P: Placement> DeadEndFinder<'_, P> {
    /// Marks all dead ends.
    pub(crate) fn mark(
        &self,
        axial: &mut AxialStops,
        interrupt: &Interrupt,
    ) -> Result<DeadEndRows, Interrupted> {
        let mut rows = DeadEndRows::default();
        for quarter in (0..4).step_by(8 / self.graph.steps().len()) {
            axial.mark(quarter, interrupt, |axial, at| {
                let holds = self.holds(axial, at, quarter);
                if holds {
                    if rows.is_empty() {
                        rows = DeadEndRows::new(P::vertices(self.graph.grid()));
                    }
                    rows.add(at, quarter);
                }
                holds
            })?;
        }
        Ok(rows)
    }

    /// Whether a jump point of the axial jumps in direction `quarter` is a dead end; false outside the map.
    pub(crate) fn holds(&self, axial: &AxialStops, at: Vertex, quarter: usize) -> bool {
        self.graph.is_free(at)
            && self.ends(axial, at, quarter << (self.graph.k().get() - 2), self.reach, DEPTH)
    }

    /// Whether all jumps by forced successors of a jump point, at which a path arrived by move `by`, end
    /// within `reach`.
    fn ends(&self, axial: &AxialStops, at: Vertex, by: usize, reach: u32, depth: u32) -> bool {
        let mut forced = self.forced(at, by);
        while forced != 0 {
            let index = forced.trailing_zeros() as usize;
            let ends = if index % 2 == 1 {
                self.diagonal_ends(axial, at, index, reach, depth)
            } else {
                self.axial_ends(axial, at, index, reach, depth)
            };
            if !ends {
                return false;
            }
            forced &= forced - 1;
        }
        true
    }

    fn diagonal_ends(&self, axial: &AxialStops, from: Vertex, index: usize, reach: u32, depth: u32) -> bool {
        let beside = [index - 1, (index + 1) % self.graph.steps().len()];
        let (mut at, mut gone) = (from, 0);
        let mut successors = self.table.successors(index, pattern_at(self.graph, at));
        while successors >> index & 1 == 1 {
            (at, gone) = (at + self.graph.step(index).vector(), gone + 1);
            successors = self.table.successors(index, pattern_at(self.graph, at));
            // A forced successor of a diagonal move would be one more case.
            if gone > reach || self.table.forced(index, successors) != 0 {
                return false;
            }
            for even in beside {
                let leads = self.leads.is_none_or(|leads| leads.any(self.quarter(even), at));
                if leads && !self.axial_ends(axial, at, even, reach - gone, depth) {
                    return false;
                }
            }
        }
        true
    }

    fn axial_ends(&self, axial: &AxialStops, from: Vertex, index: usize, reach: u32, depth: u32) -> bool {
        let quarter = self.quarter(index);
        let mut gone = 0;
        loop {
            let at = self.after(from, index, gone);
            let scan = axial.scan(at, quarter, true);
            if !scan.found {
                return true;
            }
            gone += scan.steps;
            if depth == 0 || gone > reach {
                return false;
            }
            if !self.ends(axial, self.after(from, index, gone), index, reach - gone, depth - 1) {
                return false;
            }
        }
    }

    /// The forced successors of a path that arrives by a move.
    fn forced(&self, at: Vertex, by: usize) -> u8 {
        self.table.forced(by, self.table.successors(by, pattern_at(self.graph, at)))
    }

    fn quarter(&self, even: usize) -> usize {
        even >> (self.graph.k().get() - 2)
    }

    fn after(&self, from: Vertex, index: usize, steps: u32) -> Vertex {
        from + self.graph.step(index).vector() * steps as i32
    }
}
