//! The check that a path holds on a map.

use std::fmt;

use mediant_grid::{FreeSpace, Obstruction, Placement, Vertex};

use super::Path;
use crate::query::End;

/// Why a path does not hold on a map, and where: see [`Path::check`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[non_exhaustive]
pub enum BrokenPath {
    /// It has no waypoint.
    #[error("the path has no waypoint")]
    Empty,
    /// A waypoint is outside the map.
    #[error("waypoint {index} of the path, {at}, is outside the map: the path is that of a larger map")]
    Outside {
        /// Which one, from 0.
        index: usize,
        /// The waypoint.
        at: Vertex,
        /// The number of waypoints up to which the path holds.
        holds: usize,
    },
    /// Its start or goal is blocked.
    #[error("the {end} of the path, {at}, is blocked now: choose a free vertex")]
    Blocked {
        /// Which end.
        end: End,
        /// The vertex.
        at: Vertex,
        /// The number of waypoints up to which the path holds: 0 where the start is blocked.
        holds: usize,
    },
    /// A segment is not legal.
    #[error("segment {index} of the path, from {from} to {to}, does not hold: {by}")]
    Segment {
        /// Which one, from 0: it begins at the waypoint of this number.
        index: usize,
        /// Where it begins.
        from: Vertex,
        /// Where it ends.
        to: Vertex,
        /// The first thing on it, from its start, that is in the way.
        by: Obstruction,
    },
    /// The path passes a closed gap, or starts or ends in a quadrant of one in which it may not.
    #[error("the path crosses a closed gap at waypoint {index}: {}", Way(*before, *at, *after))]
    Gap {
        /// Which waypoint, from 0; the last one, where the path stands still there.
        index: usize,
        /// The waypoint.
        at: Vertex,
        /// The waypoint before; `None` at the start.
        before: Option<Vertex>,
        /// The waypoint after; `None` at the goal.
        after: Option<Vertex>,
    },
}

/// A waypoint between its neighbors.
struct Way(Option<Vertex>, Vertex, Option<Vertex>);

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(before, at, after) = self;
        match before {
            Some(before) => write!(f, "{before} → {at}")?,
            None => write!(f, "start at {at}")?,
        }
        after.map_or(Ok(()), |after| write!(f, " → {after}"))
    }
}

impl BrokenPath {
    /// The number of waypoints, counted from the start, up to which the path still holds: it can be followed
    /// to the last of them, though not beyond. 0 if it cannot be entered: if there is no waypoint, or the
    /// start is blocked or outside the map.
    #[must_use]
    pub const fn holds_up_to(&self) -> usize {
        match self {
            Self::Empty => 0,
            Self::Blocked { holds, .. } | Self::Outside { holds, .. } => *holds,
            Self::Segment { index, .. } | Self::Gap { index, .. } => *index + 1,
        }
    }
}

impl Path {
    /// Checks that the path obeys the rules of motion on this map, at any angle: that it still holds, for
    /// instance after the map was edited. It asks for sight along each segment, so it costs far less than a
    /// search. [`is_over`](Self::is_over) asks whether its segments are moves of N(k). Whether there is a
    /// shorter path, only a search tells.
    ///
    /// First it looks whether all waypoints are on the map and both ends are free, then at one segment after
    /// another from the start. Standing still, at a waypoint that repeats the one before, is allowed.
    /// Whatever is found first, [`BrokenPath::holds_up_to`] tells how far the path can still be followed.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_grid::{AsciiMap, Centers, CornerRule, FreeSpace, Obstruction, Rectangle};
    /// use mediant_search::{BrokenPath, Path};
    /// let map = AsciiMap::parse("
    ///     ....
    ///     ....
    /// ")?;
    /// let space = FreeSpace::<Centers>::new(Arc::new(map.grid), CornerRule::Never);
    /// let path = Path::new(vec![(0, 0).into(), (3, 0).into(), (3, 1).into()]);
    /// assert_eq!(path.check(&space), Ok(()));
    ///
    /// let at = Rectangle { x: 2, y: 0, width: 1, height: 1 };
    /// let edited = FreeSpace::<Centers>::new(
    ///     Arc::new(space.grid().with_rectangle(at, |_, _| true)), CornerRule::Never);
    /// let broken = path.check(&edited).unwrap_err();
    /// assert!(matches!(broken, BrokenPath::Segment { index: 0, by: Obstruction::Cell { x: 2, y: 0 }, .. }));
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    ///
    /// # Errors
    /// A [`BrokenPath`] for what is found first.
    pub fn check<P: Placement>(&self, space: &FreeSpace<P>) -> Result<(), BrokenPath> {
        check(space, &self.waypoints)
    }
}

/// [`Path::check`], for waypoints.
pub(crate) fn check<P: Placement>(space: &FreeSpace<P>, waypoints: &[Vertex]) -> Result<(), BrokenPath> {
    let (Some(&start), Some(&goal)) = (waypoints.first(), waypoints.last()) else {
        return Err(BrokenPath::Empty);
    };
    if let Some((index, &at)) = waypoints.iter().enumerate().find(|&(_, &at)| space.id(at).is_none()) {
        return Err(BrokenPath::Outside { index, at, holds: holds_up_to(space, &waypoints[..index]) });
    }
    let ends = [(End::Start, start), (End::Goal, goal)];
    if let Some((end, at)) = ends.into_iter().find(|&(_, at)| !space.is_free(at)) {
        return Err(BrokenPath::Blocked { end, at, holds: holds_up_to(space, waypoints) });
    }
    // A path that stays where it is does not leave any quadrant.
    match follow(space, waypoints)? {
        None => Ok(()),
        before => turn(space, (before, goal, None), waypoints.len() - 1),
    }
}

/// The number of waypoints, which are all on the map, to which a path can be followed that goes on from
/// there.
fn holds_up_to<P: Placement>(space: &FreeSpace<P>, waypoints: &[Vertex]) -> usize {
    match follow(space, waypoints) {
        _ if waypoints.first().is_none_or(|&start| !space.is_free(start)) => 0,
        Ok(_) => waypoints.len(),
        Err(broken) => broken.holds_up_to(),
    }
}

/// Looks at one segment after another. Returns the last waypoint that differs from the end of the path. All
/// waypoints are on the map, so that no difference of coordinates overflows.
fn follow<P: Placement>(space: &FreeSpace<P>, waypoints: &[Vertex]) -> Result<Option<Vertex>, BrokenPath> {
    let mut before = None;
    for (ends, index) in waypoints.windows(2).zip(0..) {
        let (from, to) = (ends[0], ends[1]);
        if from == to {
            continue;
        }
        turn(space, (before, from, Some(to)), index)?;
        if let Some(by) = space.obstruction(from, to) {
            return Err(BrokenPath::Segment { index, from, to, by });
        }
        before = Some(from);
    }
    Ok(before)
}

fn turn<P: Placement>(
    space: &FreeSpace<P>,
    (before, at, after): (Option<Vertex>, Vertex, Option<Vertex>),
    index: usize,
) -> Result<(), BrokenPath> {
    if space.may_turn(before, at, after) { Ok(()) } else { Err(BrokenPath::Gap { index, at, before, after }) }
}
