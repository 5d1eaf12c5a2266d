//! The subgoals to which ends of a query are joined that need not be vertices.

use mediant_grid::{Corners, FreeSpace, Placement, Vector, Vertex, sight::Place};

use super::{
    HubLabels,
    candidates::{BELOW, Candidates, Joint},
};
use crate::{placement::SubgoalPlacement, seen::CellIndex};

/// The line from a place to a subgoal: its displacement in parts of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line(Vector);

impl Joint for Line {
    #[inline]
    fn cost<P: SubgoalPlacement>(self, index: &HubLabels<P>) -> u64 {
        index.metric.estimate(self.0).to_bits() >> Place::PLACES
    }

    #[inline]
    fn arrival(self) -> Vector {
        self.0
    }
}

impl Candidates<Line> {
    pub(super) fn none() -> Self {
        let (slots, steps, bounds, leading) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { slots, steps, bounds, count: 0, leading }
    }

    /// Forgets what was found, and makes room for so many slots.
    fn clear(&mut self, room: usize) {
        self.count = 0;
        if self.slots.len() < room {
            self.slots.resize(room, 0);
            self.steps.resize(room, Line(Vector::ZERO));
            self.bounds.resize(room, 0.0);
            self.leading.resize(room, 0);
        }
    }

    /// Looks up what a vertex sees.
    pub(super) fn find_at<P: SubgoalPlacement>(
        &mut self,
        index: &HubLabels<P>,
        space: &FreeSpace<Corners>,
        end: Vertex,
    ) {
        self.clear(index.geometry.seen.most + 1);
        self.count = index.geometry.seen.slots(end, &mut self.slots);
        if space.is_closed_gap(end) {
            self.keep_legal(index, space, end);
        }
        self.find_lines(index, Place::of(end));
    }

    /// Looks up what a place between vertices may see: all that it sees, and a few more.
    pub(super) fn find_around<P: SubgoalPlacement>(
        &mut self,
        index: &HubLabels<P>,
        space: &FreeSpace<Corners>,
        cells: &CellIndex,
        end: Place,
        scratch: &mut [Vec<u32>; 2],
    ) {
        let seen = &index.geometry.seen;
        let room = seen.room_around();
        self.clear(room);
        let scratch = scratch.each_mut().map(|list| {
            list.resize(room.max(list.len()), 0);
            &mut list[..]
        });
        self.count = seen.slots_around(vertices_around(space, end), &mut self.slots, scratch);
        let [(left, right), (above, below)] = cells_around(end);
        for cell in (above..=below).flat_map(|y| (left..=right).map(move |x| Vertex::new(x, y))) {
            cells.slots(cell).for_each(|slot| self.add(slot));
        }
        self.find_lines(index, end);
    }

    /// Adds a slot; [`find_lines`](Self::find_lines) is to follow.
    pub(super) fn add(&mut self, slot: u32) {
        let count = self.count;
        if count == self.slots.len() {
            self.clear(2 * count + 1);
        }
        self.slots[count] = slot;
        self.count = count + 1;
    }

    /// Finds the lines from a place to what it may see.
    pub(super) fn find_lines<P: SubgoalPlacement>(&mut self, index: &HubLabels<P>, from: Place) {
        for (slot, line) in self.slots[..self.count].iter().zip(&mut self.steps) {
            *line = Line(from.to(Place::of(index.geometry.subgoals.vertex(slot / P::SIDES))));
        }
    }

    /// Removes all sides of a subgoal.
    pub(super) fn remove<P: SubgoalPlacement>(&mut self, id: u32) {
        let mut kept = 0;
        for i in 0..self.count {
            (self.slots[kept], self.steps[kept]) = (self.slots[i], self.steps[i]);
            kept += usize::from(self.slots[i] / P::SIDES != id);
        }
        self.count = kept;
    }

    /// Finds bounds on the costs of paths to the other end, which is at `other` from here.
    pub(super) fn find_bounds_to(&mut self, other: Vector) {
        for (bound, &Line(to)) in self.bounds[..self.count].iter_mut().zip(&self.steps) {
            *bound = straight(to) + straight(other - to);
        }
    }
}

/// The columns and rows of the cells that a place touches: one of each, or the two beside a line of the grid.
/// On the border of the map some of them are outside.
fn cells_around(at: Place) -> [(i32, i32); 2] {
    [at.columns(), at.lines()].map(|(low, high)| if low == high { (low - 1, low) } else { (low, low) })
}

/// The corners of the box of these cells' vertices that are on the map.
fn vertices_around(space: &FreeSpace<Corners>, at: Place) -> [Vertex; 2] {
    let [(left, right), (above, below)] = cells_around(at);
    let (width, height) = Corners::vertices(space.grid());
    let high = Vertex::new((right + 1).min(width as i32 - 1), (below + 1).min(height as i32 - 1));
    [Vertex::new(left.max(0), above.max(0)), high]
}

/// Whether a place sees a subgoal that it [may see](Candidates::find_around).
pub(super) fn sees<P: SubgoalPlacement>(
    index: &HubLabels<P>,
    space: &FreeSpace<Corners>,
    from: Place,
    id: u32,
) -> bool {
    let to = Place::of(index.geometry.subgoals.vertex(id));
    // Along an edge a path may be stopped at a closed gap, which all vertices see.
    let is_inside = cells_around(from).iter().all(|(low, high)| low == high);
    let slot = id * P::SIDES + if from.x < to.x { 0 } else { P::SIDES - 1 };
    is_inside && index.geometry.seen.joins_all(vertices_around(space, from), slot)
        || space.first_between(from, to).is_none()
}

/// A lower bound on the length of a displacement in parts of a cell, in cells.
#[inline]
fn straight(v: Vector) -> f32 {
    const PART: f32 = 1.0 / Place::parts(1) as f32;
    let (x, y) = (v.x as f32, v.y as f32);
    (x * x + y * y).sqrt() * (BELOW * PART)
}

#[cfg(test)]
mod tests;
