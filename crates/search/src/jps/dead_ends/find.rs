//! Finds the dead ends of a grid graph.

use mediant_grid::{GridGraph, Interrupt, Interrupted, Placement, Vertex};

use super::{
    super::{axial::AxialStops, planes::PlaneRows},
    DeadEndRows,
};
use crate::canonical::{PatternTable, pattern_at};

/// The most jump points one behind the other in a dead end.
const DEPTH: u32 = 4;

/// Finds the dead ends of a grid graph.
pub(crate) struct DeadEndFinder<'g, P: Placement> {
    pub(crate) graph: &'g GridGraph<P>,
    pub(crate) table: &'g PatternTable,
    /// From where jumps come to a jump point, and where they can go; `None` where only few dead ends are
    /// looked for.
    pub(crate) rows: Option<&'g PlaneRows>,
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
        let forced = self.forced(at, by);
        // That a jump leads too far mostly shows before any is followed from one jump point to the next.
        let mut leads_on = false;
        let may_end = self.all_end((at, forced), reach, |from, index, reach| {
            let Some(steps) = self.first(axial, from, index) else { return true };
            leads_on = true;
            depth > 0 && steps <= reach
        });
        let follow = |from, index, reach| self.axial_ends(axial, from, index, reach, depth);
        may_end && (!leads_on || self.all_end((at, forced), reach, follow))
    }

    /// Whether jumps by these moves end within `reach`, where `axial_ends` says it of axial jumps.
    fn all_end(
        &self,
        (at, moves): (Vertex, u8),
        reach: u32,
        mut axial_ends: impl FnMut(Vertex, usize, u32) -> bool,
    ) -> bool {
        // A diagonal jump makes many axial ones: it comes last.
        for which in [0x55, 0xaa] {
            let mut left = moves & which;
            while left != 0 {
                let index = left.trailing_zeros() as usize;
                let ends = if index % 2 == 1 {
                    self.diagonal_ends(at, index, reach, &mut axial_ends)
                } else {
                    axial_ends(at, index, reach)
                };
                if !ends {
                    return false;
                }
                left &= left - 1;
            }
        }
        true
    }

    fn diagonal_ends(
        &self,
        from: Vertex,
        index: usize,
        reach: u32,
        axial_ends: &mut impl FnMut(Vertex, usize, u32) -> bool,
    ) -> bool {
        let beside = [index - 1, (index + 1) % self.graph.steps().len()];
        let v = self.graph.step(index).vector();
        let (mut at, mut gone) = (from, 0);
        while self.can_step(at, at + v, index) {
            (at, gone) = (at + v, gone + 1);
            // A forced successor of a diagonal move would be one more case.
            if gone > reach || self.table.diagonals_may_force() && self.forced(at, index) != 0 {
                return false;
            }
            if !beside.into_iter().all(|even| axial_ends(at, even, reach - gone)) {
                return false;
            }
        }
        true
    }

    /// Whether a diagonal jump can go on from one vertex to the next.
    #[inline]
    fn can_step(&self, from: Vertex, to: Vertex, index: usize) -> bool {
        match self.rows {
            Some(rows) => rows.enters.can_enter(index, to),
            None => self.table.successors(index, pattern_at(self.graph, from)) >> index & 1 == 1,
        }
    }

    fn axial_ends(&self, axial: &AxialStops, from: Vertex, index: usize, reach: u32, depth: u32) -> bool {
        let (mut at, mut gone) = (from, 0);
        while let Some(steps) = self.first(axial, at, index) {
            (at, gone) = (self.after(at, index, steps), gone + steps);
            if depth == 0 || gone > reach {
                return false;
            }
            if !self.ends(axial, at, index, reach - gone, depth - 1) {
                return false;
            }
        }
        true
    }

    /// After how many steps an axial jump comes to a jump point.
    #[inline]
    fn first(&self, axial: &AxialStops, from: Vertex, index: usize) -> Option<u32> {
        let quarter = self.quarter(index);
        if self.rows.is_some_and(|rows| !rows.leads.any(quarter, from)) {
            return None;
        }
        let scan = axial.scan(from, quarter, true);
        scan.found.then_some(scan.steps)
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
