//! Canonical A* as Rivera 2017 states it: complete, not optimal for k ≥ 4.
//!
//! Rule variant: a node reached by an odd-indexed move is bidimensional (that move and its two neighbors), one reached by an
//! even-indexed move unidimensional (that move alone). 'A cell is a jump point if it is a jump point on the 8-neighborhood': where any
//! move of N(3) would have a turn. What a jump point leads to the paper leaves open beyond 'it will be considered as
//! bidimensional' and 'forced successors are required to preserve completeness'; here it gets all legal moves, like the start, which
//! favors the published rule.

use std::ops::Deref;

use mediant_grid::{Lattice, Place, Vertex};
use mediant_moves::{K, Neighborhood};

use super::{alternatives::Moves, natural, near::NearTable, pattern};
use crate::{Arrival, BestFirst, Guarantee, Heuristic, Successor, Successors};

/// Canonical A* with the published rule.
pub type PaperCanonical<L, H> = BestFirst<L, H, PaperMoves>;

/// The moves that the published rule leaves.
#[derive(Clone, Debug)]
pub struct PaperMoves {
    /// For each pattern of cells around a vertex, whether it is a jump point of the 8-neighborhood.
    jump_points: Box<[bool]>,
}

impl<P: Place, L: Deref<Target = Lattice<P>>, H: Heuristic> PaperCanonical<L, H> {
    /// A planner with scratch memory for `lattice`.
    #[must_use]
    pub fn new(lattice: L, heuristic: H) -> Self {
        let k = lattice.k().min(K::EIGHT_CONNECTED);
        let table = Neighborhood::new(k).ok().map(|all| (all.len(), Moves::<P>::new(lattice.rule(), all)));
        let table = table.map(|(count, moves)| (count as usize, NearTable::new(&moves)));
        let is_jump_point = |pattern| {
            table.as_ref().is_none_or(|(count, table)| {
                (0..*count).any(|by| table.turns(by, table.successors(by, pattern)) != 0)
            })
        };
        let jump_points = (0..P::PATTERNS).map(is_jump_point).collect();
        Self::with(lattice, heuristic, PaperMoves { jump_points })
    }
}

impl<P: Place> Successors<P> for PaperMoves {
    type Link = ();

    #[inline]
    fn for_each(
        &self,
        lattice: &Lattice<P>,
        node: Arrival,
        goal: Vertex,
        mut visit: impl FnMut(Successor),
    ) -> u32 {
        let is_jump_point = self.jump_points.get(pattern(lattice, node.at)).is_none_or(|&is| is);
        let count = lattice.steps().len();
        let kept = node.by.filter(|_| !is_jump_point && !lattice.has_gaps());
        lattice.for_each_successor(node.at, node.by, goal, |index| {
            if kept.is_none_or(|by| natural(by, count).any(|natural| natural == index)) {
                visit(node.step(lattice, index));
            }
        });
        0
    }

    fn guarantee(&self, _: &Lattice<P>) -> Guarantee {
        Guarantee::Suboptimal
    }
}
