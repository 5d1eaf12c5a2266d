//! The check that a path holds on a map.

use std::fmt;

use mediant_grid::{Corners, FreeSpace, Obstruction, Placement, Point};

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
        at: Point,
        /// The number of waypoints up to which the path holds.
        holds: usize,
    },
    /// A point is no vertex, on a map where all waypoints are: anywhere but at corners.
    #[error("waypoint {index} of the path, {at}, lies between vertices: only paths at corners lead there")]
    Between {
        /// Which one, from 0.
        index: usize,
        /// The point.
        at: Point,
        /// The number of waypoints up to which the path holds.
        holds: usize,
    },
    /// Its start or goal is blocked.
    #[error("the {end} of the path, {at}, is blocked now: choose a free vertex")]
    Blocked {
        /// Which end.
        end: End,
        /// The vertex.
        at: Point,
        /// The number of waypoints up to which the path holds: 0 where the start is blocked.
        holds: usize,
    },
    /// A segment is not legal.
    #[error("segment {index} of the path, from {from} to {to}, does not hold: {by}")]
    Segment {
        /// Which one, from 0: it begins at the waypoint of this number.
        index: usize,
        /// Where it begins.
        from: Point,
        /// Where it ends.
        to: Point,
        /// The first thing on it, from its start, that is in the way.
        by: Obstruction,
    },
    /// The path passes a closed gap, or starts or ends in a quadrant of one in which it may not.
    #[error("the path crosses a closed gap at waypoint {index}: {}", Way(*before, *at, *after))]
    Gap {
        /// Which waypoint, from 0; the last one, where the path stands still there.
        index: usize,
        /// The waypoint.
        at: Point,
        /// The waypoint before; `None` at the start.
        before: Option<Point>,
        /// The waypoint after; `None` at the goal.
        after: Option<Point>,
    },
}

/// A waypoint between its neighbors.
struct Way(Option<Point>, Point, Option<Point>);

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
            Self::Blocked { holds, .. } | Self::Between { holds, .. } | Self::Outside { holds, .. } => *holds,
            Self::Segment { index, .. } | Self::Gap { index, .. } => *index + 1,
        }
    }

    /// The same of a path between corners in the coordinates of [`CenterSpace`](crate::CenterSpace).
    #[must_use]
    pub fn at_centers(self) -> Self {
        let moved = |at: Option<Point>| at.map(Point::at_centers);
        match self {
            Self::Empty => Self::Empty,
            Self::Outside { index, at, holds } => Self::Outside { index, at: at.at_centers(), holds },
            Self::Between { index, at, holds } => Self::Between { index, at: at.at_centers(), holds },
            Self::Blocked { end, at, holds } => Self::Blocked { end, at: at.at_centers(), holds },
            Self::Segment { index, from, to, by } => {
                Self::Segment { index, from: from.at_centers(), to: to.at_centers(), by: by.at_centers() }
            }
            Self::Gap { index, at, before, after } => {
                Self::Gap { index, at: at.at_centers(), before: moved(before), after: moved(after) }
            }
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
        check(space, self.points())
    }
}

/// [`Path::check`], for points.
pub(crate) fn check<P: Placement>(
    space: &FreeSpace<P>,
    points: impl ExactSizeIterator<Item = Point> + DoubleEndedIterator + Clone,
) -> Result<(), BrokenPath> {
    let map = Points { vertices: space, corners: P::at_corners(space) };
    let (Some(start), Some(goal)) = (points.clone().next(), points.clone().next_back()) else {
        return Err(BrokenPath::Empty);
    };
    let is_known = |at: Point| map.is_inside(at) == Some(true);
    if let Some((index, at)) = points.clone().enumerate().find(|&(_, at)| !is_known(at)) {
        let holds = map.holds_up_to(points.take(index));
        return Err(match map.is_inside(at) {
            Some(_) => BrokenPath::Outside { index, at, holds },
            None => BrokenPath::Between { index, at, holds },
        });
    }
    let ends = [(End::Start, start), (End::Goal, goal)];
    if let Some((end, at)) = ends.into_iter().find(|&(_, at)| !map.is_free(at)) {
        return Err(BrokenPath::Blocked { end, at, holds: map.holds_up_to(points) });
    }
    // A path that stays where it is does not leave any quadrant.
    let last = points.len() - 1;
    match map.follow(points)? {
        None => Ok(()),
        before => map.turn((before, goal, None), last),
    }
}

/// A free space that is asked about vertices, and at corners about points between them, too.
struct Points<'s, P: Placement> {
    vertices: &'s FreeSpace<P>,
    corners: Option<&'s FreeSpace<Corners>>,
}

impl<P: Placement> Points<'_, P> {
    /// Whether a point is on the map; `None` for one between vertices where there is none.
    fn is_inside(&self, at: Point) -> Option<bool> {
        match at.vertex() {
            Some(at) => Some(self.vertices.id(at).is_some()),
            None => Some(self.corners?.place(at).is_some()),
        }
    }

    fn is_free(&self, at: Point) -> bool {
        match at.vertex() {
            Some(at) => self.vertices.is_free(at),
            None => self.corners.is_some_and(|corners| corners.point_is_free(at)),
        }
    }

    fn obstruction(&self, from: Point, to: Point) -> Option<Obstruction> {
        match (from.vertex().zip(to.vertex()), self.corners) {
            (Some((from, to)), _) => self.vertices.obstruction(from, to),
            (None, Some(corners)) => corners.point_obstruction(from, to),
            (None, None) => Some(Obstruction::End { at: from }),
        }
    }

    fn may_turn(&self, before: Option<Point>, at: Point, after: Option<Point>) -> bool {
        self.corners.is_none_or(|corners| corners.may_turn_at(before, at, after))
    }

    /// The number of points, which are all on the map, to which a path can be followed that goes on from
    /// there.
    fn holds_up_to(&self, mut points: impl ExactSizeIterator<Item = Point> + Clone) -> usize {
        let count = points.len();
        match self.follow(points.clone()) {
            _ if points.next().is_none_or(|start| !self.is_free(start)) => 0,
            Ok(_) => count,
            Err(broken) => broken.holds_up_to(),
        }
    }

    /// Looks at one segment after another. Returns the last point that differs from the end of the path. All
    /// points are on the map, so that no difference of coordinates overflows.
    fn follow(&self, points: impl Iterator<Item = Point> + Clone) -> Result<Option<Point>, BrokenPath> {
        let mut before = None;
        for ((from, to), index) in points.clone().zip(points.skip(1)).zip(0..) {
            if from == to {
                continue;
            }
            self.turn((before, from, Some(to)), index)?;
            if let Some(by) = self.obstruction(from, to) {
                return Err(BrokenPath::Segment { index, from, to, by });
            }
            before = Some(from);
        }
        Ok(before)
    }

    fn turn(
        &self,
        (before, at, after): (Option<Point>, Point, Option<Point>),
        index: usize,
    ) -> Result<(), BrokenPath> {
        let is_legal = self.may_turn(before, at, after);
        if is_legal { Ok(()) } else { Err(BrokenPath::Gap { index, at, before, after }) }
    }
}
