//! Where a shortest path over N(3) may turn.

use mediant_grid::{Grid, Vector, Vertex};

/// A cell, as far as turns there go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Turns {
    /// Which of the cells that touch it diagonally are blocked: down right, down left, up left, up right.
    blocked: u32,
}

impl Turns {
    /// Those at a cell.
    pub(crate) fn at(grid: &Grid, at: Vertex) -> Self {
        let cells = [(1, 1), (-1, 1), (-1, -1), (1, -1)];
        let blocked = |(x, y): (i32, i32)| u32::from(grid.is_blocked(at.x + x, at.y + y));
        Self { blocked: cells.into_iter().rev().fold(0, |bits, cell| 2 * bits + blocked(cell)) }
    }

    /// Where a path may go on after `v`, over which the cell is directly h_3-reachable.
    #[inline]
    pub(crate) fn after(self, v: Vector) -> Turn {
        let from = direction(v);
        Turn { allowed: (0..16).fold(0, |bits, to| bits | u32::from(self.allow(from, to)) << to) }
    }

    /// Whether a path that comes in one direction and goes on in another, in which subgoals are directly h_3-reachable, can be a shortest one,
    /// where corners are never cut.
    ///
    /// The moves to either can be taken in any order, so that each of the first may be the last before the turn and each of the others the first
    /// after it. By less than 90° any two may follow one another. From one straight move to another the way is shorter over the cell
    /// between, unless that is blocked; between other moves it always is, over cells that are free since no corner is cut.
    const fn allow(self, from: i32, to: i32) -> bool {
        // Half octants, −8 to 7.
        let turn = ((to - from + 8) & 15) - 8;
        let most = turn.abs() + (from & 1) + (to & 1);
        if most != 4 {
            return most < 4;
        }
        // The first move to the outside, and the cell towards which the path turns.
        let first = from - turn.signum() * (from & 1);
        let inside = first + turn.signum() * 6;
        first & 3 == 0 && self.blocked >> ((inside & 15) / 4) & 1 == 1
    }
}

/// The directions in which a path may go on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    /// A bit for each half octant.
    allowed: u32,
}

impl Turn {
    /// Whether it may go on over `w`, directly h_3-reachable.
    #[inline]
    pub(crate) fn allows(self, w: Vector) -> bool {
        self.allowed >> (direction(w) & 15) & 1 == 1
    }
}

/// A direction in half octants from the first axis to the second: even at a move, odd between two.
#[inline]
fn direction(v: Vector) -> i32 {
    let (x, y) = v.abs();
    let within = i32::from(y > 0) + i32::from(y >= x) + i32::from(y > x) + i32::from(x == 0);
    // Without branches: which quadrant comes next cannot be foreseen.
    let (left, up) = (i32::from(v.x < 0), i32::from(v.y < 0));
    let base = 8 * left + 16 * (up & !left);
    base + (1 - 2 * (left ^ up)) * within
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use mediant_grid::{Centers, CornerRule, FreeSpace, Placement};
    use mediant_moves::{FiniteK, K};
    use mediant_oracle::{Explicit, random_grid};

    use super::Turns;
    use crate::{
        SubgoalPlacement,
        norm::Norm,
        placement::{BuildContext, EdgeKind, Edges},
        subgoals::Subgoals,
    };

    /// For every turn that is refused there is a shorter way.
    #[test]
    fn refused_turns_are_on_no_shortest_path() {
        let (mut refused, mut passed) = (0, 0);
        for seed in 0..60 {
            let (grid, _) = random_grid(seed);
            let k = K::Finite(FiniteK::N8);
            let space = FreeSpace::<Centers>::new(Arc::new(grid.clone()), CornerRule::Never);
            let norm = Norm::new(k).expect("a small k");
            let subgoals = Subgoals::new(Centers::prepare(&space));
            let map =
                BuildContext { space: &space, subgoals: &subgoals, norm: &norm, k, edges: Edges::Direct };
            let explicit = Explicit::new(&grid, Centers::rules(CornerRule::Never), k.finite());
            for id in 0..subgoals.len() as u32 {
                let at = subgoals.vertex(id);
                let turns = Turns::at(&grid, at);
                let mut links = Vec::new();
                Centers::links(map, &mut (), at, EdgeKind::All, |id, cost| {
                    links.push((subgoals.vertex(id), cost));
                });
                for &(before, first) in &links {
                    let costs = explicit.costs_from(before);
                    for &(after, second) in &links {
                        let shortest = costs.to(after).expect("there is a way over the subgoal");
                        let is_shortest = shortest > (first + second).to_f64() - 1e-6;
                        let may_pass = turns.after(before.to(at)).allows(at.to(after));
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
