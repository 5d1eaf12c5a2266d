//! Which subgoals are contracted before their neighbors.

use super::overlay_arc::OverlayArc;

/// The priorities of the subgoals: the lower, the earlier a subgoal is contracted.
///
/// A priority is three times the number of shortcuts, less the number of arcs removed, plus twice the depth:
/// the number of subgoals on the longest chain contracted below it. The weights were found by measurement;
/// figures are in `docs/measurements/subgoal.md`.
///
/// Finding shortcuts is the work of a contraction. So a priority is exact only when it was just found. When a
/// neighbor is contracted, it becomes a guess that is rather too low. A subgoal with too low a priority is
/// looked at again before it is contracted, one with too high a priority is not. The guess: with the arc to
/// the neighbor go as many of the shortcuts as an arc has in the mean, and all new arcs need none.
pub(super) struct Priorities {
    /// Beside what else is known: they are compared far more often than they change.
    priorities: Vec<i64>,
    subgoals: Vec<Known>,
}

#[derive(Clone, Copy, Default)]
struct Known {
    /// The number of shortcuts, or a guess.
    added: u32,
    /// How many of them an arc had in the mean when they were found.
    added_per_arc: u32,
    depth: u32,
    /// The depth when the priority was found.
    known_depth: u32,
}

impl Known {
    fn weigh(&self, removed: usize) -> i64 {
        3 * i64::from(self.added) - removed as i64 + 2 * i64::from(self.known_depth)
    }
}

impl Priorities {
    pub(super) fn new(count: usize) -> Self {
        Self { priorities: vec![0; count], subgoals: vec![Known::default(); count] }
    }

    /// Sets the priority of a subgoal whose contraction adds and removes so many arcs.
    pub(super) fn set(&mut self, id: u32, added: usize, removed: usize) {
        let known = &mut self.subgoals[id as usize];
        known.added = added as u32;
        // A shortcut has an arc at each end.
        known.added_per_arc = (2 * added).checked_div(removed).unwrap_or(0) as u32;
        known.known_depth = known.depth;
        self.priorities[id as usize] = known.weigh(removed);
    }

    /// Lowers the priority of a subgoal that has so many arcs, now that one of its neighbors is contracted.
    pub(super) fn lower(&mut self, id: u32, arcs: usize) {
        let known = &mut self.subgoals[id as usize];
        known.added = known.added.saturating_sub(known.added_per_arc);
        let priority = &mut self.priorities[id as usize];
        *priority = known.weigh(arcs).min(*priority);
    }

    /// Notes that a subgoal is contracted before its neighbors.
    pub(super) fn deepen(&mut self, id: u32, around: &[OverlayArc]) {
        let depth = self.subgoals[id as usize].depth + 1;
        for arc in around {
            let neighbor = &mut self.subgoals[arc.to as usize];
            neighbor.depth = neighbor.depth.max(depth);
        }
    }

    /// Whether a subgoal comes before all its neighbors.
    pub(super) fn is_least(&self, id: u32, around: &[OverlayArc]) -> bool {
        let rank = |id: u32| (self.priorities[id as usize], scatter(id));
        let own = rank(id);
        around.iter().all(|arc| own < rank(arc.to))
    }
}

/// Another number for each subgoal, so that of equal neighbors in a row not just the first comes before both
/// others.
const fn scatter(id: u32) -> u32 {
    // An odd factor, so no two numbers become equal: 2³² divided by the golden ratio.
    id.wrapping_mul(0x9E37_79B1)
}
