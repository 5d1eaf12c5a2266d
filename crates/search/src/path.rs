//! Paths.

use std::fmt;

use mediant_grid::Vertex;

/// A path: its waypoints and its length.
///
/// Two consecutive waypoints are joined by one move of N(k), taken once or several times in a row, or in
/// any-angle paths by a straight legal segment. A path from a vertex to itself has that vertex as its only
/// waypoint.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    waypoints: Vec<Vertex>,
    cost: f64,
}

impl Path {
    /// The path along these waypoints; its cost is the sum of the lengths of the segments between them.
    #[must_use]
    pub fn new(waypoints: Vec<Vertex>) -> Self {
        // Not `sum`, which yields −0 for no segments.
        let cost = waypoints.windows(2).fold(0.0, |cost, ends| cost + ends[0].distance(ends[1]));
        Self { waypoints, cost }
    }

    /// The waypoints, start and goal included.
    #[must_use]
    pub fn waypoints(&self) -> &[Vertex] {
        &self.waypoints
    }

    /// The waypoints, without a copy.
    #[must_use]
    pub fn into_waypoints(self) -> Vec<Vertex> {
        self.waypoints
    }

    /// The Euclidean length in cells, recomputed from the waypoints rather than taken from the search's
    /// fixed-point sum.
    #[must_use]
    pub const fn cost(&self) -> f64 {
        self.cost
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
        let mut last = None;
        // A segment without length has no direction.
        let segments = self.waypoints.windows(2).filter(|ends| ends[0] != ends[1]);
        segments.fold(0.0, |sum, ends| {
            let x = f64::from(ends[1].x) - f64::from(ends[0].x);
            let y = f64::from(ends[1].y) - f64::from(ends[0].y);
            let turn = last.replace((x, y)).map_or(0.0, |(a, b)| (a * y - b * x).atan2(a * x + b * y));
            sum + turn.abs().to_degrees()
        })
    }
}

/// The waypoints, joined by arrows.
impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, waypoint) in self.waypoints.iter().enumerate() {
            write!(f, "{}{waypoint}", if at == 0 { "" } else { " → " })?;
        }
        Ok(())
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
