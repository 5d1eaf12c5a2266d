//! Points, headings and turns along a path.

use mediant_grid::Point;

use super::{Path, steps::Segment};

/// A step shorter than this part of the spacing is left out before the end of a path.
const SHORTEST_STEP: f64 = 1e-9;

/// A bend of a path: see [`Path::turns`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// The point at which the path bends.
    pub at: Point,
    /// By how much, in radians, from −π to π and never 0: positive to the right, as seen on the map with y
    /// down, negative to the left. A path that turns back turns by π.
    pub angle: f64,
}

/// A spacing of points that is no positive number: see [`Path::points`].
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("points cannot be {spacing} cells apart: give a number above 0")]
pub struct SpacingError {
    /// The spacing, in cells.
    pub spacing: f64,
}

impl Segment {
    /// The point at this distance from its start, for a segment with a length.
    fn point(&self, distance: f64) -> (f64, f64) {
        let t = distance / self.length();
        let along = |from: f64, by: i64| from + t * (by as f64 / Point::PARTS as f64);
        (along(self.from.x(), self.by().0), along(self.from.y(), self.by().1))
    }

    /// Its direction in radians.
    fn heading(&self) -> f64 {
        let (x, y) = self.by();
        (y as f64).atan2(x as f64)
    }

    /// The angle from its direction to that of another one: from −π to π, positive to the right.
    fn turn_to(&self, next: &Self) -> f64 {
        let (det, dot) = self.det_and_dot(next);
        (det as f64).atan2(dot as f64)
    }
}

fn point(at: Point) -> (f64, f64) {
    (at.x(), at.y())
}

impl Path {
    /// The point on the path at this distance from its start, in cells, measured along the path. Before the
    /// start there is the start, beyond the end the end. `None` for a distance that is not a number, and on
    /// a path without waypoints.
    #[must_use]
    pub fn point_at(&self, distance: f64) -> Option<(f64, f64)> {
        let (start, end) = (self.start()?, self.goal()?);
        if distance.is_nan() {
            return None;
        }
        if distance <= 0.0 {
            return Some(point(start));
        }
        let mut before = 0.0;
        for segment in self.segments() {
            let after = before + segment.length();
            if distance < after {
                return Some(segment.point(distance - before));
            }
            before = after;
        }
        Some(point(end))
    }

    /// Points along the path, `spacing` cells apart as measured along it: at 0, `spacing`, 2 `spacing`, …
    /// from the start, and then its end. So start and end are always among them, and the last step is shorter
    /// than the others unless the length is a multiple of `spacing`; a step below a billionth of `spacing`
    /// is left out. A path of length 0 has one point, one without waypoints none.
    ///
    /// The points are made one by one. For a small spacing there are many of them: at least the length
    /// divided by `spacing`.
    ///
    /// ```
    /// use mediant_search::Path;
    /// let path = Path::new(vec![(0, 0).into(), (2, 0).into(), (2, 1).into()]);
    /// let points: Vec<_> = path.spaced(1.25)?.collect();
    /// assert_eq!(points, [(0.0, 0.0), (1.25, 0.0), (2.0, 0.5), (2.0, 1.0)]);
    /// # Ok::<(), mediant_search::SpacingError>(())
    /// ```
    ///
    /// # Errors
    /// [`SpacingError`] for a spacing that is 0, negative or not a number.
    pub fn spaced(&self, spacing: f64) -> Result<impl Iterator<Item = (f64, f64)>, SpacingError> {
        if spacing.is_nan() || spacing <= 0.0 {
            return Err(SpacingError { spacing });
        }
        let last = self.length - SHORTEST_STEP * spacing;
        let mut segments = self.segments();
        let (mut segment, mut before) = (segments.next(), 0.0);
        let mut steps = 0_u64;
        let inner = std::iter::from_fn(move || {
            steps += 1;
            let distance = steps as f64 * spacing;
            loop {
                let on = segment.filter(|_| distance < last)?;
                if distance < before + on.length() {
                    return Some(on.point(distance - before));
                }
                before += on.length();
                segment = segments.next();
            }
        });
        let first = self.start().map(point);
        let last = self.goal().filter(|_| self.length > 0.0).map(point);
        Ok(first.into_iter().chain(inner).chain(last))
    }

    /// The direction of each segment, in radians, above −π and up to π, with y down: 0 is to the right, π/2
    /// down, π to the left, −π/2 up. So it grows clockwise, as seen on the map. Segments without length have
    /// none. Robots whose y axis points up take the negative.
    pub fn headings(&self) -> impl Iterator<Item = f64> {
        self.segments().map(|segment| segment.heading())
    }

    /// The bends of the path: the waypoints between segments of different directions, each with the angle.
    /// A waypoint at which it goes straight on is no bend.
    ///
    /// ```
    /// use std::f64::consts::FRAC_PI_2;
    /// use mediant_search::{Path, Turn};
    /// let path = Path::new(vec![(0, 0).into(), (3, 0).into(), (3, 4).into()]);
    /// assert!(path.headings().eq([0.0, FRAC_PI_2]));
    /// assert!(path.turns().eq([Turn { at: (3, 0).into(), angle: FRAC_PI_2 }]));
    /// ```
    pub fn turns(&self) -> impl Iterator<Item = Turn> {
        let pairs = self.segments().zip(self.segments().skip(1));
        let bends = pairs.filter(|(segment, next)| !segment.continues_in(next));
        bends.map(|(segment, next)| Turn { at: next.from, angle: segment.turn_to(&next) })
    }

    /// The number of [turns](Self::turns).
    #[must_use]
    pub fn bends(&self) -> usize {
        self.turns().count()
    }

    /// The path smoothness PS of Hammoud & Lupin 2023, Eq. 1, in degrees: the sum of 180° − φ over the
    /// waypoints between start and goal, where φ is the angle between the two segments that meet there. 0 for
    /// a straight path; the more the path turns, the greater.
    ///
    /// ```
    /// use mediant_search::Path;
    /// let path = Path::new(vec![(0, 0).into(), (3, 0).into(), (5, 2).into()]);
    /// assert_eq!(path.smoothness(), 45.0);
    /// ```
    #[must_use]
    pub fn smoothness(&self) -> f64 {
        self.turns().fold(0.0, |sum, turn| sum + turn.angle.abs().to_degrees())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(waypoints: &[(i32, i32)], degrees: f64) {
        let path = Path::new(waypoints.iter().map(|&at| at.into()).collect());
        let back = Path::new(waypoints.iter().rev().map(|&at| at.into()).collect());
        for found in [path.smoothness(), back.smoothness()] {
            assert!((found - degrees).abs() <= 1e-12 * degrees, "{found}° of {waypoints:?}");
            assert!(found.is_sign_positive());
        }
    }

    #[test]
    fn smoothness_adds_up_the_turns() {
        check(&[], 0.0);
        check(&[(4, 4)], 0.0);
        check(&[(4, 4), (9, 5)], 0.0);
        // A right angle, to either side and however long the segments are.
        check(&[(0, 0), (5, 0), (5, 1)], 90.0);
        check(&[(0, 0), (1, 0), (1, -7)], 90.0);
        check(&[(0, 0), (2, 1), (1, 3)], 90.0);
        check(&[(0, 0), (5, 0), (7, 2)], 45.0);
        check(&[(0, 0), (5, 0), (4, 1)], 135.0);
        // There and back.
        check(&[(0, 0), (5, 2), (0, 0)], 180.0);
        // Waypoints on a straight line, or twice on the same place, turn nothing.
        check(&[(0, 0), (2, 1), (4, 2), (10, 5)], 0.0);
        check(&[(0, 0), (5, 0), (5, 0), (5, 1), (5, 4)], 90.0);
        check(&[(3, 3), (3, 3)], 0.0);
        // Turns do not cancel: around a square.
        check(&[(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)], 270.0);
        check(&[(0, 0), (1, 0), (1, 1), (2, 1), (2, 2)], 270.0);
        check(&[(0, 0), (1, 0), (3, 1)], 1.0_f64.atan2(2.0).to_degrees());
        // The ends of the coordinates.
        check(&[(i32::MIN, 0), (i32::MAX, 0), (i32::MAX, i32::MIN)], 90.0);
    }
}
