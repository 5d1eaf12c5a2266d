//! How an edge becomes moves of N(k).
//!
//! On an empty grid an optimal path over N(k) needs at most two different moves. Sorted by move it is
//! straight, or it bends once: at one of two *elbows*, depending on which move comes first. The first elbow
//! is taken whose two legs are free. If neither's are, the path follows the line of sight.

use mediant_grid::{FreeSpace, Placement, PlacementKind, Vector, Vertex};
use mediant_moves::{Decomposition, FiniteK, K, decompose};

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

/// Whether the paths of an edge over either elbow are free.
pub(crate) fn is_free<P: Placement>(space: &FreeSpace<P>, k: K, from: Vertex, to: Vertex) -> bool {
    let parts = k.finite().and_then(|k| decompose(from.to(to), k));
    let elbows = parts.map_or([from; 2], |parts| elbows(from, parts));
    elbows.into_iter().all(|elbow| match () {
        () if elbow == from || elbow == to => leg_is_free(space, None, from, to, None),
        () => legs_are_free(space, from, elbow, to),
    })
}

/// Whether the path with a bend at `elbow` is free.
fn legs_are_free<P: Placement>(space: &FreeSpace<P>, from: Vertex, elbow: Vertex, to: Vertex) -> bool {
    leg_is_free(space, None, from, elbow, Some(to)) && leg_is_free(space, Some(from), elbow, to, None)
}

/// Whether a straight part of a path is free, also where it joins the vertices before and after it.
fn leg_is_free<P: Placement>(
    space: &FreeSpace<P>,
    before: Option<Vertex>,
    from: Vertex,
    to: Vertex,
    after: Option<Vertex>,
) -> bool {
    space.may_turn(before, from, Some(to)) && space.may_turn(Some(from), to, after) && space.sees(from, to)
}

/// The two vertices at which an optimal path of an empty grid can bend that bends at most once.
fn elbows(start: Vertex, parts: Decomposition) -> [Vertex; 2] {
    [(parts.v, parts.alpha), (parts.w, parts.beta)].map(|(v, times)| {
        let times = times as i32;
        start + Vector::new(v.x * times, v.y * times)
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
    let K::Finite(k) = k else { return push(waypoints, to) };
    if criterion == EdgeCriterion::Direct && k == FiniteK::N8 {
        // Both ends are directly reachable, so every optimal path of the empty grid is free.
        let elbow = from + octile_elbow(from.to(to));
        if elbow != from && elbow != to {
            push(waypoints, elbow);
        }
        return push(waypoints, to);
    }
    let Some(parts) = decompose(from.to(to), k) else { return };
    let [first, second] = elbows(from, parts);
    let elbow = match criterion {
        EdgeCriterion::Direct => Some(first),
        _ if first == from || first == to => Some(to),
        EdgeCriterion::Taut => {
            [first, second].into_iter().find(|&elbow| legs_are_free(space, from, elbow, to))
        }
    };
    if let Some(elbow) = elbow.filter(|&elbow| elbow != from) {
        push(waypoints, elbow);
    } else if elbow.is_none() {
        along_line(waypoints, parts);
    }
    if waypoints.last() != Some(&to) {
        push(waypoints, to);
    }
}

/// The first of the two [elbows](elbows) over N(3), without a decomposition.
#[inline]
fn octile_elbow(v: Vector) -> Vector {
    let (x, y) = v.abs();
    let shorter = x.min(y) as i32;
    // The moves of a quadrant in angular order: an axis move, the diagonal, the other axis move.
    let begins_on_x = (v.x > 0) != (v.y > 0);
    let diagonal = Vector::new(v.x.signum() * shorter, v.y.signum() * shorter);
    if (x > y) == begins_on_x { v - diagonal } else { diagonal }
}

/// Follows a line of sight by moves that sweep no more cells than the line does (Kramm 2018, Lemma 13): the
/// leaves of the decomposition tree. They are a Christoffel word in v and w, so the path keeps as close to
/// the line as it can on one side.
fn along_line(waypoints: &mut Vec<Vertex>, parts: Decomposition) {
    let (alpha, beta) = (u64::from(parts.alpha), u64::from(parts.beta));
    let (mut a, mut b) = (0, 0);
    while let Some(&from) = waypoints.last().filter(|_| a + b < alpha + beta) {
        let is_below = (b + 1) * alpha <= a * beta;
        let step = if is_below { parts.w } else { parts.v };
        (a, b) = (a + u64::from(!is_below), b + u64::from(is_below));
        push(waypoints, from + step);
    }
}

/// Adds a waypoint; it replaces the last one if the path goes straight on there.
#[inline]
pub(crate) fn push(waypoints: &mut Vec<Vertex>, to: Vertex) {
    if let [.., before, last] = waypoints[..] {
        let (v, w) = (before.to(last), last.to(to));
        if v.det(w) == 0 && v.dot(w) > 0 {
            waypoints.pop();
        }
    }
    waypoints.push(to);
}

#[cfg(test)]
mod tests {
    use mediant_grid::{Vector, Vertex};
    use mediant_moves::{FiniteK, decompose};

    use super::{elbows, octile_elbow};

    #[test]
    fn the_elbow_over_n3_is_that_of_the_decomposition() {
        for (x, y) in (-5..=5).flat_map(|x| (-5..=5).map(move |y| (x, y))).filter(|&at| at != (0, 0)) {
            let (v, start) = (Vector::new(x, y), Vertex::new(0, 0));
            let parts = decompose(v, FiniteK::N8).expect("a small displacement");
            let (expected, found) = (elbows(start, parts)[0], start + octile_elbow(v));
            let ends = [start, start + v];
            let is_straight = ends.contains(&expected) && ends.contains(&found);
            assert!(expected == found || is_straight, "{v:?}: {expected:?}, {found:?}");
        }
    }
}
