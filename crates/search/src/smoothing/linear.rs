//! Smoothing along the path (Botea, Müller & Schaeffer 2004).

use mediant_grid::{FreeSpace, Placement, Vertex};

/// Replaces parts of a path by straight segments between vertices that see each other (Botea, Müller &
/// Schaeffer 2004, 'Near Optimal Hierarchical Path-Finding', Section 3.3). From the start it follows the path
/// as long as that is in sight, places a waypoint at the last vertex in sight, and continues from there. It
/// checks sight once for each segment of the path, then once for each vertex on it.
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
    if is_legal(space, &corners) { smooth_legal(space, &corners) } else { waypoints.to_vec() }
}

/// [`smooth`], for a legal path without repeated waypoints.
pub(super) fn smooth_legal<P: Placement>(space: &FreeSpace<P>, waypoints: &[Vertex]) -> Vec<Vertex> {
    let all = vertices(waypoints);
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

/// Whether a path without repeated waypoints keeps the rules of motion.
pub(super) fn is_legal<P: Placement>(space: &FreeSpace<P>, path: &[Vertex]) -> bool {
    let at = |index: usize| path.get(index).copied();
    let turns = |(index, &vertex): (usize, &Vertex)| {
        space.may_turn(index.checked_sub(1).and_then(at), vertex, at(index + 1))
    };
    path.iter().all(|&at| space.id(at).is_some())
        && path.windows(2).all(|ends| space.sees(ends[0], ends[1]))
        && (path.len() < 2 || path.iter().enumerate().all(turns))
}

/// All vertices on a path.
fn vertices(waypoints: &[Vertex]) -> Vec<Vertex> {
    let mut all: Vec<Vertex> = waypoints.first().copied().into_iter().collect();
    for ends in waypoints.windows(2) {
        all.extend(between(ends[0], ends[1]).chain([ends[1]]));
    }
    all
}

/// The vertices strictly between two others on the straight segment that joins them.
pub(super) fn between(from: Vertex, to: Vertex) -> impl DoubleEndedIterator<Item = Vertex> {
    let d = from.to(to);
    let parts = d.gcd().max(1) as i32;
    (1..parts).map(move |part| Vertex::new(from.x + d.x / parts * part, from.y + d.y / parts * part))
}
