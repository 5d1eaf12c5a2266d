//! Paths at any angle between points that need not be vertices.
//!
//! The seen index knows vertices alone. A point looks around by a visibility sweep instead, and the subgoals
//! that it sees are joined by the same labels. The sweep's tables are made at the first such query: a bit a
//! vertex and twice, and two bits for each 8 × 8 cells. They are scratch memory of the planner.

use mediant_grid::{Corners, FreeSpace, sight::Place};
use mediant_search::Path;

use super::{HubLabels, chain::Chains, join::Join};
use crate::{corners::PointSight, placement::SubgoalPlacement};

impl<P: SubgoalPlacement> HubLabels<P> {
    /// A shortest path between two different places that do not see each other; `None` if the labels are
    /// damaged.
    pub(super) fn path_between(
        &self,
        space: &FreeSpace<Corners>,
        (sight, join): (&mut PointSight, &mut Join),
        places: [Place; 2],
    ) -> Option<Path> {
        let subgoals = &self.geometry.subgoals;
        let meeting = join.meeting_of_places(self, places, |from, see| {
            sight.seen_from(space, from, |at| {
                if let Some(id) = subgoals.id(at) {
                    see(id);
                }
            });
        })?;
        let chains = Chains::<P>::new(&self.packed, subgoals, self.k);
        let vertex = |id: u32| subgoals.vertex(id);
        // From the subgoal itself: it does not matter from where the path comes there.
        let way = |id: u32| {
            let mut way = vec![vertex(id)];
            chains.visit(vertex(id), id, meeting.hub, |at| way.push(at)).map(|()| way)
        };
        let (there, back) = (way(meeting.first)?, way(meeting.last)?);
        let bends = there.into_iter().chain(back.into_iter().rev().skip(1)).map(Place::of);
        let [start, goal] = places;
        Some(Path::straightened([start].into_iter().chain(bends).chain([goal])))
    }
}
