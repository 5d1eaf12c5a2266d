//! How a line of sight becomes moves of N(k).
//!
//! On an empty grid an optimal path over N(k) needs at most two different moves. Sorted by move it is
//! straight, or it bends once: at one of two *elbows*, depending on which move comes first. The first elbow
//! is taken whose two legs are free. If neither's are, the path follows the line of sight.

use mediant_grid::{FreeSpace, Placement, Vector, Vertex};
use mediant_moves::{Decomposition, FiniteK, decompose};

/// Extends a path over N(k) to a vertex that its last waypoint sees, at the cost h_k. An empty path begins
/// there.
pub fn follow_line<P: Placement>(waypoints: &mut Vec<Vertex>, space: &FreeSpace<P>, k: FiniteK, to: Vertex) {
    let Some(&from) = waypoints.last() else { return waypoints.push(to) };
    if from == to {
        return;
    }
    let Some(parts) = decompose(from.to(to), k) else { return };
    let elbows = elbows(from, parts);
    if elbows.contains(&to) {
        return push_waypoint(waypoints, to);
    }
    match elbows.into_iter().find(|&elbow| legs_are_free(space, from, elbow, to)) {
        Some(elbow) => {
            push_waypoint(waypoints, elbow);
            push_waypoint(waypoints, to);
        }
        None => along_line(waypoints, parts),
    }
}

/// Whether the path with a bend at `elbow` is free.
#[must_use]
pub fn legs_are_free<P: Placement>(space: &FreeSpace<P>, from: Vertex, elbow: Vertex, to: Vertex) -> bool {
    leg_is_free(space, None, from, elbow, Some(to)) && leg_is_free(space, Some(from), elbow, to, None)
}

/// Whether a straight part of a path is free, also where it joins the vertices before and after it.
#[must_use]
pub fn leg_is_free<P: Placement>(
    space: &FreeSpace<P>,
    before: Option<Vertex>,
    from: Vertex,
    to: Vertex,
    after: Option<Vertex>,
) -> bool {
    space.may_turn(before, from, Some(to)) && space.may_turn(Some(from), to, after) && space.sees(from, to)
}

/// The two vertices at which an optimal path of an empty grid can bend that bends at most once.
#[must_use]
pub fn elbows(start: Vertex, parts: Decomposition) -> [Vertex; 2] {
    [(parts.v, parts.alpha), (parts.w, parts.beta)].map(|(v, times)| {
        let times = times as i32;
        start + Vector::new(v.x * times, v.y * times)
    })
}

/// Follows a line of sight by moves that sweep no more cells than the line does (Kramm 2018, Lemma 13): the
/// leaves of the decomposition tree. They are a Christoffel word in v and w, so the path keeps as close to
/// the line as it can on one side.
pub fn along_line(waypoints: &mut Vec<Vertex>, parts: Decomposition) {
    let (alpha, beta) = (u64::from(parts.alpha), u64::from(parts.beta));
    let (mut a, mut b) = (0, 0);
    while let Some(&from) = waypoints.last().filter(|_| a + b < alpha + beta) {
        let is_below = (b + 1) * alpha <= a * beta;
        let step = if is_below { parts.w } else { parts.v };
        (a, b) = (a + u64::from(!is_below), b + u64::from(is_below));
        push_waypoint(waypoints, from + step);
    }
}

/// Adds a waypoint; it replaces the last one if the path goes straight on there.
#[inline]
pub fn push_waypoint(waypoints: &mut Vec<Vertex>, to: Vertex) {
    if let [.., before, last] = waypoints[..] {
        let (v, w) = (before.to(last), last.to(to));
        if v.det(w) == 0 && v.dot(w) > 0 {
            waypoints.pop();
        }
    }
    waypoints.push(to);
}
