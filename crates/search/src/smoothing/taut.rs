//! Smoothing by pulling a path taut.

use std::ops::Range;

use mediant_grid::{FreeSpace, Placement, Point, Vector, Vertex, sight::PolygonCells};
use mediant_moves::Cost;

use super::linear::{follow_sight, is_hidden, smooth_legal, without_repetitions};
use crate::{
    path::{between, check},
    segment::segment_cost,
};

/// Pulls a path taut, like a string: first [`smooth`](super::smooth), then waypoint by waypoint, until none
/// can be left out or moved.
///
/// For each waypoint b of the new path, between a and c:
/// - a and c do not see each other, nor do a and the waypoint after c.
/// - No vertex on one of the two segments at b sees the far end of the other one, and the two vertices next
///   to b on the segments do not see each other.
/// - Replacing b by one of the eight vertices around it makes no legal path that is shorter by 2⁻²⁹ cells or
///   more.
/// - At corners: b is the corner of an obstacle that lies within the turn. So the path is locally shortest:
///   no path that passes the obstacles on the same sides is shorter.
///
/// (At centers a path keeps its distance from obstacles. There the string is drawn around vertices beside
/// obstacles, if sight allows. Such a string need not exist, and it need not be the shortest.)
///
/// The new path is legal, not longer than the smoothed one, and has the same ends. Pulled again, it does not
/// change. A path that is not legal in this free space is returned unchanged.
///
/// **Pulling ends**, because each step makes the path shorter or leaves out a waypoint on a straight line,
/// and there are finitely many paths up to a given length. Rounding does not spoil this: a string within a
/// triangle is convex and lies inside the old path, so it is shorter; and where lengths are compared, in
/// integers, the difference must exceed the rounding.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace};
/// use mediant_search::pull_taut;
/// let map = AsciiMap::parse("
///     ......
///     .###..
///     ......
/// ")?;
/// let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
/// let path = [(0, 0), (0, 3), (6, 3)].map(Into::into);
/// assert_eq!(pull_taut(&space, &path), [(0, 0), (1, 2), (6, 3)].map(Into::into));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[must_use]
pub fn pull_taut<P: Placement>(space: &FreeSpace<P>, waypoints: &[Vertex]) -> Vec<Vertex> {
    let corners = without_repetitions(waypoints);
    if check(space, corners.iter().map(Point::from)).is_err() {
        return waypoints.to_vec();
    }
    pull(space, smooth_legal(space, &corners))
}

/// [`pull_taut`], for the bends of a path as [`Planner::bends_to`](crate::Planner::bends_to) gives them.
pub(super) fn pull_bends<P: Placement>(space: &FreeSpace<P>, bends: &[Vertex]) -> Vec<Vertex> {
    pull(space, follow_sight(space, bends))
}

fn pull<P: Placement>(space: &FreeSpace<P>, path: Vec<Vertex>) -> Vec<Vertex> {
    let mut string = Taut { space, path, cover: PolygonCells::default() };
    let mut index = 1;
    while index + 1 < string.path.len() {
        if string.pull(index) {
            // Results for the three waypoints before may depend on a waypoint that is gone.
            index = index.saturating_sub(3).max(1);
        } else {
            index += 1;
        }
    }
    string.path
}

/// A path that is being pulled.
struct Taut<'t, P: Placement> {
    space: &'t FreeSpace<P>,
    path: Vec<Vertex>,
    cover: PolygonCells,
}

impl<P: Placement> Taut<'_, P> {
    /// Pulls at a waypoint between two others. Returns whether the path changed.
    fn pull(&mut self, index: usize) -> bool {
        let [a, b, c] = [index - 1, index, index + 1].map(|index| self.path[index]);
        if a == c {
            self.path.drain(index..index + 2);
            return true;
        }
        // Where corners are not cut, there may be sight past a staircase of which no single step can be left
        // out.
        for after in index + 1..self.path.len().min(index + 3) {
            let to = self.path[after];
            if self.turns_well(index..after, &[])
                && !is_hidden(self.space, a, b, to)
                && self.space.sees(a, to)
            {
                self.path.drain(index..after);
                return true;
            }
        }
        let Some(instead) = self.instead_of(index, a, b, c) else { return false };
        self.path.splice(index..=index, instead);
        true
    }

    /// Waypoints that make the path shorter in place of b.
    fn instead_of(&mut self, index: usize, a: Vertex, b: Vertex, c: Vertex) -> Option<Vec<Vertex>> {
        let space = self.space;
        let fits = |taut: &Self, instead: &[Vertex]| taut.turns_well(index..index + 1, instead);
        let side = a.to(c).det(a.to(b)).signum();
        if side == 0 {
            return None;
        }
        let string = self.string(a, b, c, side);
        if string != [b] && fits(self, &string) && self.is_seen(a, &string, c) {
            return Some(string);
        }
        let sees = |from, to| !is_hidden(space, from, b, to) && space.sees(from, to);
        let mut one = between(a, b).map(|p| (p, p, c)).chain(between(b, c).rev().map(|q| (q, a, q)));
        if let Some((p, ..)) = one.find(|&(p, from, to)| fits(self, &[p]) && sees(from, to)) {
            return Some(vec![p]);
        }
        if let (Some(p), Some(q)) = (between(a, b).next_back(), between(b, c).next())
            && fits(self, &[p, q])
            && sees(p, q)
        {
            return Some(vec![p, q]);
        }
        self.best_neighbor(index, a, b, c).map(|at| vec![at])
    }

    /// The string from a to c, without its ends, that results when a–b–c is pulled until obstacles in the
    /// triangle stop it: the convex hull, on the side of b, of these obstacles, or at centers of the vertices
    /// around them.
    ///
    /// At corners no segment of it meets an obstacle, since all obstacles that it could meet are among these.
    /// Nor does it pass a gap or bend at one: more than a quarter of the plane around such a vertex would
    /// have to be free on one side.
    fn string(&mut self, a: Vertex, b: Vertex, c: Vertex, side: i128) -> Vec<Vertex> {
        let low = Vertex::new(a.x.min(b.x).min(c.x), a.y.min(b.y).min(c.y));
        let high = Vertex::new(a.x.max(b.x).max(c.x), a.y.max(b.y).max(c.y));
        self.cover.set::<P>(low, high, &[[a, b], [b, c], [c, a]]);
        let is_within = |p: &Vertex| {
            a.to(c).det(a.to(*p)) * side > 0
                && a.to(b).det(a.to(*p)) * side <= 0
                && b.to(c).det(b.to(*p)) * side <= 0
        };
        let corners: Vec<Vertex> =
            self.cover.extremes::<P>(self.space.grid()).filter(is_within).chain([c]).collect();
        let mut string = vec![a];
        let mut last = a;
        while last != c {
            // The outermost direction, and in it the farthest corner.
            let outer = |best: Vertex, &p: &Vertex| {
                let (v, w) = (last.to(best), last.to(p));
                let turn = v.det(w) * side;
                if turn > 0 || (turn == 0 && w.norm_squared() > v.norm_squared()) { p } else { best }
            };
            last = corners.iter().filter(|&&p| p != last).fold(c, outer);
            string.push(last);
        }
        string.pop();
        string.remove(0);
        string
    }

    /// Whether there is sight between consecutive vertices of a, `string`, c. At corners there always is.
    fn is_seen(&self, a: Vertex, string: &[Vertex], c: Vertex) -> bool {
        let mut last = a;
        string.iter().chain([&c]).all(|&next| self.space.sees(std::mem::replace(&mut last, next), next))
    }

    /// The best of the eight vertices around a waypoint, if it makes the path shorter.
    fn best_neighbor(&self, index: usize, a: Vertex, b: Vertex, c: Vertex) -> Option<Vertex> {
        let length = |at: Vertex| segment_cost(a.to(at)) + segment_cost(at.to(c));
        // Each of the four lengths is rounded by 2⁻³³ at most.
        let limit = length(b).to_bits().saturating_sub(4);
        let around = (-1..=1).flat_map(|y| (-1..=1).map(move |x| b + Vector::new(x, y)));
        let mut shorter: Vec<(Cost, Vertex)> = around
            .filter(|&at| at != a && at != c)
            .map(|at| (length(at), at))
            .filter(|(length, _)| length.to_bits() <= limit)
            .collect();
        shorter.sort_unstable();
        let fits = |at: Vertex| {
            self.turns_well(index..index + 1, &[at]) && self.space.sees(a, at) && self.space.sees(at, c)
        };
        shorter.into_iter().map(|(_, at)| at).find(|&at| fits(at))
    }

    /// Whether the path keeps the rule of closed gaps with other vertices in place of some waypoints.
    fn turns_well(&self, places: Range<usize>, instead: &[Vertex]) -> bool {
        let space = self.space;
        if !space.has_closed_gaps() {
            return true;
        }
        let at = |index: usize| self.path.get(index).copied();
        let mut around = vec![places.start.checked_sub(2).and_then(at), at(places.start - 1)];
        around.extend(instead.iter().copied().map(Some));
        around.extend([at(places.end), at(places.end + 1)]);
        around.windows(3).all(|turn| turn[1].is_none_or(|at| space.may_turn(turn[0], at, turn[2])))
    }
}
