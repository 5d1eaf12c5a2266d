//! How an edge becomes moves of N(k): those of [`follow_line`], or, where every optimal path of the empty
//! grid is free, the first that comes to hand.

use mediant_grid::{Corners, FreeSpace, Placement, PlacementKind, Vector, Vertex, sight::Place};
use mediant_moves::{FiniteK, K, decompose};
use mediant_search::{
    PointEnds,
    parts::{along_line, elbows, follow_line, leg_is_free, legs_are_free, push_waypoint},
};

use crate::placement::EdgeCriterion;

/// Writes the path between two vertices to `waypoints`, if an optimal path of the empty grid is free: then no
/// search is needed. Returns whether it is.
pub(crate) fn direct_path<P: Placement>(
    space: &FreeSpace<P>,
    k: K,
    start: Vertex,
    goal: Vertex,
    waypoints: &mut Vec<Vertex>,
) -> bool {
    waypoints.clear();
    waypoints.push(start);
    let is_straight = || leg_is_free(space, None, start, goal, None);
    let parts = match k {
        K::Any => None,
        K::Finite(k) => match decompose(start.to(goal), k) {
            None => return false,
            parts => parts,
        },
    };
    for elbow in parts.map(|parts| elbows(start, parts)).into_iter().flatten() {
        if elbow == start || elbow == goal {
            waypoints.push(goal);
            return is_straight();
        }
        if legs_are_free(space, start, elbow, goal) {
            waypoints.extend([elbow, goal]);
            return true;
        }
    }
    match parts {
        None => waypoints.push(goal),
        // At centers a line of sight may touch fewer cells than the moves along it.
        Some(_) if P::KIND == PlacementKind::Center => return false,
        Some(parts) => {
            let is_free = is_straight();
            if is_free {
                along_line(waypoints, parts);
            }
            return is_free;
        }
    }
    is_straight()
}

/// Whether the straight path at any angle between two free points is free; `places` are theirs.
pub(crate) fn sees_between(
    space: &FreeSpace<Corners>,
    PointEnds { start, goal, .. }: PointEnds,
    [from, to]: [Place; 2],
) -> bool {
    start == goal
        || space.first_between(from, to).is_none()
            && space.may_turn_at(None, start, Some(goal))
            && space.may_turn_at(Some(start), goal, None)
}

/// Whether the paths of an edge over either elbow are free.
pub(crate) fn is_free<P: Placement>(space: &FreeSpace<P>, k: K, from: Vertex, to: Vertex) -> bool {
    let parts = k.finite().and_then(|k| decompose(from.to(to), k));
    let elbows = parts.map_or([from; 2], |parts| elbows(from, parts));
    elbows.into_iter().all(|elbow| match () {
        () if elbow == from || elbow == to => leg_is_free(space, None, from, to, None),
        () => legs_are_free(space, from, elbow, to),
    })
}

/// Extends a path over N(k) to a vertex, along an edge; an empty one begins there.
pub(crate) fn extend<P: Placement>(
    waypoints: &mut Vec<Vertex>,
    space: &FreeSpace<P>,
    (k, criterion): (K, EdgeCriterion),
    to: Vertex,
) {
    let Some(&from) = waypoints.last() else { return waypoints.push(to) };
    if from == to {
        return;
    }
    let K::Finite(k) = k else { return push_waypoint(waypoints, to) };
    if criterion == EdgeCriterion::Direct && k == FiniteK::N8 {
        // Both ends are directly reachable, so every optimal path of the empty grid is free.
        let elbow = from + octile_parts(from.to(to)).0;
        if elbow != from && elbow != to {
            push_waypoint(waypoints, elbow);
        }
        return push_waypoint(waypoints, to);
    }
    if criterion == EdgeCriterion::Taut {
        return follow_line(waypoints, space, k, to);
    }
    let Some(parts) = decompose(from.to(to), k) else { return };
    let [elbow, _] = elbows(from, parts);
    if elbow != from {
        push_waypoint(waypoints, elbow);
    }
    if elbow != to {
        push_waypoint(waypoints, to);
    }
}

/// Writes the path over N(2), or else N(3), along edges between directly reachable vertices to `waypoints`:
/// every optimal path of the empty grid is free, so one over an elbow is.
pub(crate) fn over_elbows(waypoints: &mut Vec<Vertex>, is_octile: bool, vertices: &[Vertex]) {
    if is_octile {
        over(waypoints, vertices, octile_parts);
    } else {
        over(waypoints, vertices, axis_parts);
    }
}

/// The same with the two parts of each edge.
#[inline]
fn over(waypoints: &mut Vec<Vertex>, vertices: &[Vertex], parts: impl Fn(Vector) -> (Vector, [i32; 2])) {
    let Some(&first) = vertices.first() else { return waypoints.clear() };
    waypoints.resize(2 * vertices.len(), first);
    // Without branches, which could not be predicted: each waypoint is written, over the one before if the
    // path stands still or goes straight on there.
    let (mut at, mut last, mut before) = (0, first, 0);
    waypoints[0] = first;
    for &to in &vertices[1..] {
        let (elbow, directions) = parts(last.to(to));
        for (to, direction) in [last + elbow, to].into_iter().zip(directions) {
            let direction = if direction == 0 { before } else { direction };
            at += usize::from(direction != before);
            waypoints[at] = to;
            before = direction;
        }
        last = to;
    }
    waypoints.truncate(at + 1);
}

/// Writes the path along straight lines from vertex to vertex to `waypoints`, without those at which it goes
/// straight on. The vertices are some of a map, and no two in a row are the same.
pub(crate) fn over_bends(waypoints: &mut Vec<Vertex>, vertices: &[Vertex]) {
    let Some(&first) = vertices.first() else { return waypoints.clear() };
    waypoints.resize(vertices.len(), first);
    // Without branches, as above.
    let (mut at, mut last, mut before) = (0, first, [0, 0]);
    waypoints[0] = first;
    for &to in &vertices[1..] {
        // Sides of maps have at most 2¹⁵ cells.
        let v = [i64::from(to.x) - i64::from(last.x), i64::from(to.y) - i64::from(last.y)];
        let is_parallel = before[0] * v[1] == before[1] * v[0];
        let goes_on = is_parallel & (before[0] * v[0] + before[1] * v[1] > 0);
        at += usize::from(!goes_on);
        waypoints[at] = to;
        (before, last) = (v, to);
    }
    waypoints.truncate(at + 1);
}

/// The first of the two parts of an optimal path over N(3), and the directions of both as numbers; 0 for a
/// part without length.
#[inline]
fn octile_parts(v: Vector) -> (Vector, [i32; 2]) {
    // −1 for numbers below 0, else 0: what they are where a part has no length does not matter.
    let (below_x, below_y) = (v.x >> 31, v.y >> 31);
    let (sign_x, sign_y) = (below_x | 1, below_y | 1);
    let (x, y) = (v.x.abs(), v.y.abs());
    let (shorter, is_wide) = (x.min(y), x > y);
    let diagonal = Vector::new((shorter ^ below_x) - below_x, (shorter ^ below_y) - below_y);
    // The moves of a quadrant in angular order: an axis move, the diagonal, the other axis move.
    let is_axis_first = is_wide == (below_x != below_y);
    let along_axis = if is_wide { sign_x } else { 3 * sign_y };
    let along_axis = if x == y { 0 } else { along_axis };
    let along_diagonal = if shorter == 0 { 0 } else { sign_x + 3 * sign_y };
    if is_axis_first {
        (v - diagonal, [along_axis, along_diagonal])
    } else {
        (diagonal, [along_diagonal, along_axis])
    }
}

/// The same over N(2).
#[inline]
fn axis_parts(v: Vector) -> (Vector, [i32; 2]) {
    let (x, y) = (v.x.signum(), 3 * v.y.signum());
    if (v.x > 0) == (v.y > 0) { (Vector::new(0, v.y), [y, x]) } else { (Vector::new(v.x, 0), [x, y]) }
}

#[cfg(test)]
mod tests {
    use mediant_grid::{Vector, Vertex};
    use mediant_moves::{FiniteK, decompose};

    use super::{axis_parts, elbows, octile_parts};

    #[test]
    fn the_elbow_is_that_of_the_decomposition() {
        for (x, y) in (-5..=5).flat_map(|x| (-5..=5).map(move |y| (x, y))).filter(|&at| at != (0, 0)) {
            let (v, start) = (Vector::new(x, y), Vertex::new(0, 0));
            for (k, (elbow, _)) in [(FiniteK::N4, axis_parts(v)), (FiniteK::N8, octile_parts(v))] {
                let parts = decompose(v, k).expect("a small displacement");
                let (expected, found) = (elbows(start, parts)[0], start + elbow);
                let ends = [start, start + v];
                let is_straight = ends.contains(&expected) && ends.contains(&found);
                assert!(expected == found || is_straight, "k = {k}, {v:?}: {expected:?}, {found:?}");
            }
        }
    }
}
