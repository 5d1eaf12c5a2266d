//! Paths at any angle between points that need not be vertices.
//!
//! The subgoals that such a point may see are looked up, as of a vertex: those that the vertices around see,
//! and a few more ([`SeenIndex`](crate::seen)). Some of them it does not see. But a shortest path leads over
//! few of them, so a line of sight is tested for the two alone over which the path leads that was found. If
//! it is not free, the subgoal is left out, and another path is found.
//!
//! On maps of noise the index does not know what may be seen. There a point looks around by a visibility
//! sweep. The sweep's tables are made at the first such query: a bit a vertex and twice, and two bits for
//! each 8 × 8 cells. They are scratch memory of the planner.

use mediant_grid::{Corners, FreeSpace, Vertex, sight::Place};
use mediant_search::{Path, parts::push_waypoint};

use super::{
    HubLabels,
    chain::Chains,
    join::{Join, Meeting},
};
use crate::{corners::PointSight, placement::SubgoalPlacement};

impl<P: SubgoalPlacement> HubLabels<P> {
    /// Where a shortest path between two different places that do not see each other turns; `None` if the
    /// labels are damaged.
    pub(super) fn meeting_between(
        &self,
        space: &FreeSpace<Corners>,
        (sight, join): (&mut Option<PointSight>, &mut Join),
        places: [Place; 2],
    ) -> Option<Meeting> {
        let subgoals = &self.geometry.subgoals;
        join.meeting_of_places(self, space, places, |from, see| {
            let sight = sight.get_or_insert_with(|| PointSight::new(space, subgoals.marks()));
            sight.seen_from(space, from, |at| {
                if let Some(id) = subgoals.id(at) {
                    see(id);
                }
            });
        })
    }

    /// The path over a meeting point; `None` if the labels are damaged. The bends are written to `bends`;
    /// `chain` is scratch memory.
    pub(super) fn path_between(
        &self,
        [start, goal]: [Place; 2],
        meeting: Meeting,
        [bends, chain]: &mut [Vec<Vertex>; 2],
    ) -> Option<Path> {
        let chains = Chains::<P>::new(&self.packed, &self.geometry.subgoals, self.k);
        let steps = chains.first_steps(meeting, |end, at| [start, goal][end].to(Place::of(at)))?;
        bends.clear();
        bends.push(steps[0].at());
        chain.clear();
        chain.push(steps[1].at());
        chains.visit_both(steps, |at| push_waypoint(bends, at), |at| chain.push(at))?;
        // The last of the chain is the hub, at which the path is already.
        chain.iter().rev().skip(1).for_each(|&at| push_waypoint(bends, at));
        // Where the path goes straight on at its first or last subgoal, it does not turn there.
        let mut bends = &bends[..];
        if let [first, second, ..] = *bends
            && goes_on(start, first, second)
        {
            bends = &bends[1..];
        }
        if let [.., second, first] = *bends
            && goes_on(goal, first, second)
        {
            bends = &bends[..bends.len() - 1];
        }
        if let [only] = *bends {
            return Some(Path::straightened([start, Place::of(only), goal]));
        }
        let between = bends.iter().map(|&at| Place::of(at));
        Some(Path::through([start].into_iter().chain(between).chain([goal])))
    }
}

/// Whether a path from a place over two vertices goes straight on at the first.
fn goes_on(from: Place, first: Vertex, second: Vertex) -> bool {
    let (v, w) = (from.to(Place::of(first)), first.to(second));
    v.det(w) == 0 && v.dot(w) > 0
}
