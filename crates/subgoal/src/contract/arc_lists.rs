//! The arcs of all subgoals in one list.

use std::ops::Index;

use mediant_grid::{Interrupted, room_for};

use super::overlay_arc::OverlayArc;

/// A list of arcs for each subgoal. They lie in one list: a list of its own for each would scatter them over
/// the memory, and the system would not get it back.
#[derive(Clone, Debug)]
pub(crate) struct ArcLists {
    places: Vec<Place>,
    arcs: Vec<OverlayArc>,
    /// The number of arcs in lists. The rest of `arcs` is room.
    total: usize,
}

/// The place of a subgoal's arcs in the list.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    first: usize,
    length: u32,
    /// The number of arcs for which there is room.
    room: u32,
}

/// Room that is not worth compacting.
const SMALL: usize = 1 << 12;

/// The length of a list of so many arcs that has little room.
const fn compacted(total: usize) -> usize {
    total + total / 8 + SMALL
}

impl ArcLists {
    /// Empty lists, with room for so many arcs of each subgoal.
    pub(super) fn with_room(counts: impl Iterator<Item = u32>) -> Self {
        let mut end = 0;
        let places = counts.map(|room| {
            let first = end;
            end += room as usize;
            Place { first, length: 0, room }
        });
        let places = places.collect();
        Self { places, arcs: vec![OverlayArc::NONE; end], total: 0 }
    }

    /// The number of subgoals.
    pub(crate) const fn len(&self) -> usize {
        self.places.len()
    }

    /// The number of arcs.
    pub(crate) const fn total(&self) -> usize {
        self.total
    }

    /// The arcs of each subgoal.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[OverlayArc]> {
        (0..self.len()).map(|id| &self[id])
    }

    /// Asks for the memory of the next list: of a longer one, if this one may soon be full, else of one
    /// without the room that is given up.
    pub(super) fn check_room(&self, during: &'static str) -> Result<(), Interrupted> {
        let (length, capacity) = (self.arcs.len(), self.arcs.capacity());
        let is_wide = capacity - length > length / 2 + SMALL;
        room_for::<OverlayArc>(if is_wide { compacted(self.total) } else { 2 * capacity.max(SMALL) }, during)
    }

    /// Sets the arcs of a subgoal that has none, and no room.
    pub(super) fn set(&mut self, id: u32, arcs: &[OverlayArc]) {
        let length = arcs.len() as u32;
        self.places[id as usize] = Place { first: self.arcs.len(), length, room: length };
        self.arcs.extend_from_slice(arcs);
        self.total += arcs.len();
    }

    /// Adds an arc to a subgoal.
    pub(super) fn push(&mut self, id: u32, arc: OverlayArc) {
        let Place { first, length, room } = self.places[id as usize];
        let first = if length < room { first } else { self.make_room(id) };
        self.arcs[first + length as usize] = arc;
        self.places[id as usize].length += 1;
        self.total += 1;
    }

    /// Moves the arcs of a subgoal to where there is room for more. Returns where.
    #[cold]
    fn make_room(&mut self, id: u32) -> usize {
        if self.arcs.len() > 2 * self.total + SMALL {
            self.compact();
        }
        let Place { first, length, .. } = self.places[id as usize];
        let (moved, room) = (self.arcs.len(), length + length / 2 + 4);
        self.arcs.resize(moved + room as usize, OverlayArc::NONE);
        self.arcs.copy_within(first..first + length as usize, moved);
        self.places[id as usize] = Place { first: moved, length, room };
        moved
    }

    /// Gives up all room.
    fn compact(&mut self) {
        let mut arcs = Vec::with_capacity(compacted(self.total));
        for place in &mut self.places {
            let own = &self.arcs[place.first..place.first + place.length as usize];
            *place = Place { first: arcs.len(), length: place.length, room: place.length };
            arcs.extend_from_slice(own);
        }
        self.arcs = arcs;
    }

    /// Forgets the arcs of a subgoal.
    pub(super) fn clear(&mut self, id: u32) {
        self.total -= self.places[id as usize].length as usize;
        self.places[id as usize] = Place::default();
    }

    /// Removes the arc to a subgoal.
    pub(super) fn remove(&mut self, id: u32, to: u32) {
        let Place { first, length, .. } = self.places[id as usize];
        let own = &mut self.arcs[first..first + length as usize];
        if let Some(number) = own.iter().position(|arc| arc.to == to) {
            own[number] = own[own.len() - 1];
            self.places[id as usize].length -= 1;
            self.total -= 1;
        }
    }

    /// Adds a shortcut, unless there is an arc that costs no more; it replaces one that costs more.
    pub(super) fn add(&mut self, id: u32, arc: OverlayArc) {
        let Place { first, length, .. } = self.places[id as usize];
        let mut own = self.arcs[first..first + length as usize].iter_mut();
        match own.find(|known| known.to == arc.to) {
            Some(known) if known.cost <= arc.cost => {}
            Some(known) => *known = arc,
            None => self.push(id, arc),
        }
    }
}

impl Index<usize> for ArcLists {
    type Output = [OverlayArc];

    #[inline]
    fn index(&self, id: usize) -> &[OverlayArc] {
        let Place { first, length, .. } = self.places[id];
        &self.arcs[first..first + length as usize]
    }
}

#[cfg(test)]
mod tests;
