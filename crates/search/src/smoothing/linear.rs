//! Smoothing along the path (Botea, Müller & Schaeffer 2004).

use mediant_grid::{FreeSpace, Placement, PlacementKind, Point, Vertex};

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
    turning(&smooth_legal(space, &corners))
}

/// [`smooth`], for the bends of a path as [`Planner::bends_to`](crate::Planner::bends_to) gives them. Only
/// these are considered, and no segment between two that follow one another is tested.
pub(super) fn smooth_bends<P: Placement>(space: &FreeSpace<P>, bends: &[Vertex]) -> Vec<Vertex> {
    turning(&follow_sight(space, bends))
}

/// The waypoints at which a path turns.
fn turning(all: &[Vertex]) -> Vec<Vertex> {
    let mut path = Vec::with_capacity(all.len());
    all.iter().for_each(|&at| push_waypoint(&mut path, at));
    path
}

/// [`smooth`], for a legal path without repeated waypoints, and with a waypoint at each last vertex in sight.
pub(super) fn smooth_legal<P: Placement>(space: &FreeSpace<P>, waypoints: &[Vertex]) -> Vec<Vertex> {
    follow_sight(space, &vertices(waypoints).collect::<Vec<_>>())
}

/// From the first of the vertices of a legal path, to the last one in sight, and so on.
pub(super) fn follow_sight<P: Placement>(space: &FreeSpace<P>, all: &[Vertex]) -> Vec<Vertex> {
    let mut path: Vec<Vertex> = all.first().copied().into_iter().collect();
    let mut last = 0;
    while last + 1 < all.len() {
        let (at, before) = (all[last], path.len().checked_sub(2).map(|index| path[index]));
        let mut best = last + 1;
        for (&next, index) in all[last + 2..].iter().zip(last + 2..) {
            let hides = || is_hidden(space, at, all[index - 1], next) || !space.sees(at, next);
            if next == at || !space.may_turn(before, at, Some(next)) || hides() {
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

/// Whether the obstacle around which a path turns at a bend is in the way of the segment between the
/// vertices before and after, as far as the blocked cell at the bend shows: a test of one cell that tells
/// most segments that are not in sight. At corners; at centers nothing shows.
pub(super) fn is_hidden<P: Placement>(space: &FreeSpace<P>, from: Vertex, bend: Vertex, to: Vertex) -> bool {
    if P::KIND != PlacementKind::Corner {
        return false;
    }
    let (by, bent) = (from.to(to), from.to(bend));
    let det = i64::from(by.x) * i64::from(bent.y) - i64::from(by.y) * i64::from(bent.x);
    // The line between the two passes the inner side of the bend. It meets the open cell in the quadrant
    // where it is nearest if it passes between the bend and the opposite corner of this cell.
    let side = det.signum() as i32;
    if side == 0 {
        return false;
    }
    let (x, y) = (side * by.y.signum(), -side * by.x.signum());
    let (x, y) = (bend.x + x.min(0), bend.y + y.min(0));
    let spans = |at: i32, a: i32, b: i32| a.min(b) <= at && at < a.max(b);
    if det.abs() < i64::from(by.x.abs()) + i64::from(by.y.abs()) {
        return spans(x, from.x, to.x) && spans(y, from.y, to.y) && space.grid().is_blocked(x, y);
    }
    // Else the cell on the line in the same column, or in the same row where the line is steep.
    let on_line = |at: i32, (u, v): (i32, i32), (du, dv): (i32, i32)| {
        let (times, parts) = (2 * i64::from(at - u) + 1, 2 * i64::from(du.abs()));
        let along = times * i64::from(dv * du.signum());
        // On an edge between cells the line may run along both.
        (along % parts != 0).then(|| v + along.div_euclid(parts) as i32)
    };
    if by.x.abs() >= by.y.abs() {
        let row = || on_line(x, (from.x, from.y), (by.x, by.y));
        spans(x, from.x, to.x) && row().is_some_and(|y| space.grid().is_blocked(x, y))
    } else {
        let column = || on_line(y, (from.y, from.x), (by.y, by.x));
        spans(y, from.y, to.y) && column().is_some_and(|x| space.grid().is_blocked(x, y))
    }
}

/// A path without waypoints that repeat the one before.
pub(super) fn without_repetitions(waypoints: &[Vertex]) -> Vec<Vertex> {
    let mut path = waypoints.to_vec();
    path.dedup();
    path
}
