//! Levels that follow an edit of the map.
//!
//! A graph with levels is made by decisions: which subgoals an edge leads to, and whether a level leaves a
//! subgoal out. A [`LevelRecord`] holds, for each subgoal, what was decided, and two boxes around all that
//! these decisions looked at. After an edit only the decisions are made again that looked at something that
//! has changed. The graph is the same as a new one, to the last bit.
//!
//! # Why edges follow
//!
//! The edges from a subgoal to larger numbers come from one sweep, which reads cells. The box is around all
//! vertices whose cells it reads ([`VisibilitySweep::bounds`](mediant_grid::sight::VisibilitySweep::bounds)).
//! If none of these cells changed, the sweep on the new map reads the same cells and does the same; so it
//! finds the same subgoals in the same order, and the filter of directly reachable ones picks the same.
//! Numbers shift, but keep their order, and nothing else depends on them.
//!
//! # Why levels follow
//!
//! The levels ask one subgoal after another. At each time each subgoal has a list of arcs: that of its edges,
//! changed by the subgoals among them that were contracted before, in their order. So any list at any time
//! follows from the edges and from the decisions about its own subgoals alone ([`Replay`]): nothing else must
//! be done again to know it. A list is *touched* from the time on at which it may differ from that of the
//! earlier map: from the beginning, if an edge changed or a cell beside the subgoal; or since a subgoal was
//! contracted that offers it other arcs than before.
//!
//! A decision depends on the lists that its searches for witnesses read. The box of a subgoal holds the
//! vertices of these. If none of them is touched, the same searches read the same lists, so the decision is
//! the same. Else it is made again, in the order of levels and numbers; it touches the lists to which it now
//! offers something else, and nothing before it.

mod record;
mod repair;
mod replay;
#[cfg(test)]
mod tests;
mod touches;

use self::replay::Replay;
use crate::{arc::NONE, bounds::Bounds};

/// The decisions from which the levels of a [`SubgoalGraph`](crate::SubgoalGraph) at corners came about, so
/// that it can follow an edit of the map.
#[derive(Clone, Debug)]
pub struct LevelRecord {
    edges: Edges,
    /// The cells that the sweep of each subgoal read.
    seen: Box<[Bounds]>,
    /// The lists that the searches for witnesses of each subgoal read.
    read: Box<[Bounds]>,
    /// The level that left each subgoal out, counted from 0; [`NONE`] for none.
    level: Box<[u32]>,
    /// The first shortcut of each subgoal, and the number of all.
    first: Box<[u32]>,
    /// The shortcuts of the subgoals that were left out, as pairs of their arcs.
    shortcuts: Box<[(u32, u32)]>,
}

impl LevelRecord {
    /// The memory used, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let Self { edges, seen, read, level, first, shortcuts } = self;
        size_of_val(&*edges.first)
            + size_of_val(&*edges.to)
            + size_of_val(&**seen)
            + size_of_val(&**read)
            + size_of_val(&**level)
            + size_of_val(&**first)
            + size_of_val(&**shortcuts)
    }

    fn shortcuts(&self, id: u32) -> &[(u32, u32)] {
        let [first, end] = [id, id + 1].map(|id| self.first[id as usize] as usize);
        &self.shortcuts[first..end]
    }
}

/// The edges at each subgoal: first those from smaller numbers, in their order, then those to larger numbers
/// as they were found.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Edges {
    /// The first edge of each subgoal, and the number of all.
    first: Box<[u32]>,
    to: Box<[u32]>,
}

impl Edges {
    /// The edges of subgoals, of each those to larger numbers.
    fn new<I: IntoIterator<Item = u32>>(count: usize, onward: impl Fn(u32) -> I) -> Self {
        let mut first = vec![0_u32; count + 1];
        for from in 0..count as u32 {
            for to in onward(from) {
                first[from as usize + 1] += 1;
                first[to as usize + 1] += 1;
            }
        }
        for id in 0..count {
            first[id + 1] += first[id];
        }
        let mut next = first.clone();
        let mut to = vec![0; first[count] as usize];
        let mut put = |at: u32, other: u32| {
            let next = &mut next[at as usize];
            to[*next as usize] = other;
            *next += 1;
        };
        for from in 0..count as u32 {
            for to in onward(from) {
                put(to, from);
                put(from, to);
            }
        }
        Self { first: first.into(), to: to.into() }
    }

    /// All edges of a subgoal.
    fn of(&self, id: u32) -> &[u32] {
        let [first, end] = [id, id + 1].map(|id| self.first[id as usize] as usize);
        &self.to[first..end]
    }

    /// Its edges to larger numbers.
    fn onward(&self, id: u32) -> &[u32] {
        let all = self.of(id);
        &all[all.partition_point(|&to| to < id)..]
    }
}
