//! Which of the visible subgoals are directly h_k-reachable.

use mediant_grid::Vector;

use crate::cones::ConeCoordinates;

/// Selects from the subgoals that a vertex sees those that are directly h_k-reachable from it: the
/// Pareto-minimal subgoals of each cone.
///
/// The 2^k moves of N(k), in angular order, bound 2^k cones. A displacement in the cone of v and w is a·v +
/// b·w with integers a, b ≥ 0, and the vertices on optimal paths to it on an empty grid are the a'·v + b'·w
/// with a' ≤ a and b' ≤ b. So a subgoal is directly reachable if no other subgoal of its cone has both
/// coordinates at most as large. In a list sorted by a and then b, these are the subgoals with a smaller b
/// than all before them.
///
/// Knowing the visible subgoals is enough. If another subgoal lies in the parallelogram, hidden by an
/// obstacle, then a corner of that obstacle lies in it too and is visible.
#[derive(Clone, Debug, Default)]
pub(crate) struct DirectFilter {
    /// Sort keys, each with the number of a subgoal.
    entries: Vec<(u64, u32)>,
}

/// Marks the entry of a subgoal in its own cone. A subgoal on a move has a second entry, in the cone before.
const PRIMARY: u64 = 1;

impl DirectFilter {
    pub(crate) fn clear(&mut self) {
        self.entries.clear();
    }

    /// Adds a visible subgoal; `depth` is k − 2.
    pub(crate) fn push(&mut self, to: Vector, depth: u32, id: u32) {
        let coordinates = ConeCoordinates::of(to, depth);
        let ConeCoordinates { cone, a, b } = coordinates;
        self.entries.push((key(cone, a, b) | PRIMARY, id));
        if b == 0 {
            self.entries.push((key(coordinates.cone_before(depth), 0, a), id));
        }
    }

    /// Visits the subgoals that are directly reachable.
    pub(crate) fn for_each_direct(&mut self, mut visit: impl FnMut(u32)) {
        self.entries.sort_unstable();
        let (mut cone, mut least) = (u64::MAX, u64::MAX);
        for &(key, id) in &self.entries {
            if key >> 34 != cone {
                (cone, least) = (key >> 34, u64::MAX);
            }
            let b = key >> 1 & 0xffff;
            if b < least {
                least = b;
                if key & PRIMARY != 0 {
                    visit(id);
                }
            }
        }
    }
}

/// Cone, a and b in one number, which orders by them in this sequence. The lowest bit is free; a and b are at
/// most 2¹⁵, the longest side of a map.
const fn key(cone: u32, a: u32, b: u32) -> u64 {
    (cone as u64) << 34 | (a as u64) << 17 | (b as u64) << 1
}
