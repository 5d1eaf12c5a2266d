//! Smoothing along the path (Botea, Müller & Schaeffer 2004).

use mediant_grid::{FreeSpace, Placement, Point, Vertex};

use crate::{
    line_path::push_waypoint,
    path::{check, vertices},
};

/// Replaces parts of a path by straight segments between vertices that see each other (Botea, Müller &
/// Schaeffer 2004, 'Near Optimal Hierarchical Path-Finding', Section 3.3). From the start it follows the path
/// as long as that is in sight, places a waypoint at the last vertex in sight, and continues from there. It
/// checks sight once for each segment of the path, then once for each vertex on it. Where the new path goes
/// straight on at such a vertex, it has no waypoint.
///
/// As in the paper, all vertices on the path are considered, not only its waypoints: on a path over N(k)
/// there is one after each move, and new waypoints may be placed there. The new path is legal, not longer
/// than the old one, and has the same ends. A path that is not legal in this free space is returned
/// unchanged.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace};
/// use mediant_search::smooth;
/// let map = AsciiMap::parse("
///     ....
///     .##.
///     ....
/// ")?;
/// let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
/// let path = [(0, 0), (0, 2), (1, 3), (4, 3)].map(Into::into);
/// assert_eq!(smooth(&space, &path), [(0, 0), (1, 3), (4, 3)].map(Into::into));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[must_use]
pub fn smooth<P: Placement>(space: &FreeSpace<P>, waypoints: &[Vertex]) -> Vec<Vertex> {
    let corners = without_repetitions(waypoints);
    if check(space, corners.iter().map(Point::from)).is_err() {
        return waypoints.to_vec();
    }
    let all = smooth_legal(space, &corners);
    let mut path = Vec::with_capacity(all.len());
    all.into_iter().for_each(|at| push_waypoint(&mut path, at));
    path
}

/// [`smooth`], for a legal path without repeated waypoints, and with a waypoint at each last vertex in sight.
pub(super) fn smooth_legal<P: Placement>(space: &FreeSpace<P>, waypoints: &[Vertex]) -> Vec<Vertex> {
    let all: Vec<Vertex> = vertices(waypoints).collect();
    let mut path: Vec<Vertex> = all.first().copied().into_iter().collect();
    let mut last = 0;
    while last + 1 < all.len() {
        let (at, before) = (all[last], path.len().checked_sub(2).map(|index| path[index]));
        let mut best = last + 1;
        for (&next, index) in all[last + 2..].iter().zip(last + 2..) {
            if next == at || !space.may_turn(before, at, Some(next)) || !space.sees(at, next) {
                break;
            }
            // Not at a gap that the path would reach through the other quadrant.
            if space.may_turn(Some(at), next, all.get(index + 1).copied()) {
                best = index;
            }
        }
        path.push(all[best]);
        last = best;
    }
    path
}

/// A path without waypoints that repeat the one before.
pub(super) fn without_repetitions(waypoints: &[Vertex]) -> Vec<Vertex> {
    let mut path = waypoints.to_vec();
    path.dedup();
    path
}
