//! How a shortest path over N(3) bends at centers, where corners are never cut.

use mediant_grid::{Grid, Vector, Vertex};

/// The bends at a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct OctileBends {
    /// Which of the cells that touch it diagonally are blocked: down right, down left, up left, up right.
    blocked: u32,
}

impl OctileBends {
    /// The bends at a cell of a map.
    pub(crate) fn at(grid: &Grid, at: Vertex) -> Self {
        let cells = [(1, 1), (-1, 1), (-1, -1), (1, -1)];
        let blocked = |(x, y): (i32, i32)| u32::from(grid.is_blocked(at.x + x, at.y + y));
        Self { blocked: cells.into_iter().rev().fold(0, |bits, cell| 2 * bits + blocked(cell)) }
    }

    /// How a shortest path may leave that arrives by `v`, along which the cell is directly h_3-reachable.
    #[inline]
    pub(crate) fn after(self, v: Vector) -> OctileDepartures {
        OctileDepartures { allowed: ALLOWED[(self.blocked & 15) as usize][(direction(v) & 15) as usize] }
    }

    /// The blocked cells that touch it diagonally, a bit for each.
    pub(crate) const fn bits(self) -> u32 {
        self.blocked
    }

    /// The cell with these bits.
    pub(crate) const fn from_bits(blocked: u32) -> Self {
        Self { blocked }
    }

    /// Whether a shortest path can arrive in one direction and leave in another, if the subgoals at both ends
    /// are directly h_3-reachable.
    ///
    /// The moves of such an edge can be taken in any order, so any move of the first edge may come last, and
    /// any move of the second edge first. The widest angle between two of them decides. Below 90° every bend
    /// is allowed. Above 90°, and at 90° between diagonal moves, none is: there is a shorter path, over cells
    /// that are free because no corner is cut. At 90° between axial moves the shorter path leads over the
    /// cell between them; the bend is allowed if that cell is blocked.
    const fn allow(self, from: i32, to: i32) -> bool {
        // Angles are in half octants; the bend is from −8 to 7.
        let bend = ((to - from + 8) & 15) - 8;
        let widest = bend.abs() + (from & 1) + (to & 1);
        if widest != 4 {
            return widest < 4;
        }
        // The outermost move of the first edge, and the direction of the cell between the two moves.
        let first = from - bend.signum() * (from & 1);
        let inside = first + bend.signum() * 6;
        first & 3 == 0 && self.blocked >> ((inside & 15) / 4) & 1 == 1
    }
}

/// The directions in which a path may leave.
#[derive(Clone, Copy, Debug)]
pub struct OctileDepartures {
    /// A bit for each half octant.
    allowed: u16,
}

/// By the blocked cells and the direction of arrival: the directions in which a path may leave.
const ALLOWED: [[u16; 16]; 16] = {
    let mut allowed = [[0; 16]; 16];
    let mut i = 0;
    while i < 16 * 16 * 16 {
        let (blocked, from, to) = (i / 256, i / 16 % 16, i % 16);
        if (OctileBends { blocked: blocked as u32 }).allow(from as i32, to as i32) {
            allowed[blocked][from] |= 1 << to;
        }
        i += 1;
    }
    allowed
};

impl OctileDepartures {
    /// Every direction.
    pub(crate) const ALL: Self = Self { allowed: !0 };

    /// Whether the path may leave by `w`, along which a subgoal is directly h_3-reachable.
    #[inline]
    pub(crate) fn allows(self, w: Vector) -> bool {
        self.allows_class(Self::class(w))
    }

    /// The class of an edge: its half octant.
    pub(crate) fn class(w: Vector) -> u32 {
        (direction(w) & 15) as u32
    }

    /// Whether the path may leave along an edge of one of these classes, a bit for each.
    #[inline]
    pub(crate) const fn allows_any(self, classes: u32) -> bool {
        self.allowed as u32 & classes != 0
    }

    /// Whether the path may leave along an edge of a class.
    #[inline]
    pub(crate) const fn allows_class(self, class: u32) -> bool {
        self.allowed >> class & 1 == 1
    }
}

/// A direction in half octants, from the x axis towards the y axis, modulo 16: even along a move of N(3), odd
/// between two moves.
#[inline]
fn direction(v: Vector) -> i32 {
    let (x, y) = v.abs();
    let within = i32::from(y > 0) + i32::from(y >= x) + i32::from(y > x) + i32::from(x == 0);
    // Without branches: a processor cannot predict the quadrant.
    let (left, up) = (i32::from(v.x < 0), i32::from(v.y < 0));
    let base = 8 * left + 16 * (up & !left);
    base + (1 - 2 * (left ^ up)) * within
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use mediant_grid::{Centers, CornerRule, FreeSpace, Placement, uninterrupted};
    use mediant_moves::{FiniteK, K};
    use mediant_oracle::{Explicit, random_grid};
    use mediant_search::parts::Metric;

    use super::OctileBends;
    use crate::{
        placement::{BuildContext, EdgeCriterion, EdgeFinder, EdgeKind},
        subgoals::Subgoals,
    };

    /// For every bend that is refused there is a shorter path.
    #[test]
    fn refused_turns_are_on_no_shortest_path() {
        let (mut refused, mut passed) = (0, 0);
        for seed in 0..60 {
            let (grid, _) = random_grid(seed);
            let k = K::Finite(FiniteK::N8);
            let space = FreeSpace::<Centers>::new(Arc::new(grid.clone()), CornerRule::Never);
            let metric = Metric::new(k).expect("a small k");
            let (subgoals, tables) = uninterrupted(|never| {
                let marks = Centers::subgoals(&space, never)?;
                let tables = Centers::tables(&space, &marks, never)?;
                Ok((Subgoals::new(marks, never)?, tables))
            });
            let context = BuildContext {
                space: &space,
                subgoals: &subgoals,
                tables: &tables,
                metric,
                k,
                criterion: EdgeCriterion::Direct,
            };
            let explicit = Explicit::new(&grid, Centers::rules(CornerRule::Never), k.finite());
            for id in 0..subgoals.len() as u32 {
                let at = subgoals.vertex(id);
                let bends = OctileBends::at(&grid, at);
                let mut edges = Vec::new();
                Centers::edges_from(context, &mut (), at, EdgeKind::Query, |id, cost| {
                    edges.push((subgoals.vertex(id), cost));
                });
                for &(before, first) in &edges {
                    let costs = explicit.costs_from(before);
                    for &(after, second) in &edges {
                        let shortest = costs.to(after).expect("there is a path over the subgoal");
                        let is_shortest = shortest > (first + second).to_f64() - 1e-6;
                        let may_pass = bends.after(before.to(at)).allows(at.to(after));
                        assert!(may_pass || !is_shortest, "seed {seed}: {before:?}, {at:?}, {after:?}");
                        refused += u32::from(!may_pass);
                        passed += u32::from(is_shortest);
                    }
                }
            }
        }
        assert!(refused > 1000 && passed > 1000, "{refused} refused, {passed} passed");
    }
}
