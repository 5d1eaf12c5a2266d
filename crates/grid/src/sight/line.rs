//! Line of sight: whether a whole straight segment obeys the rules of motion, in integers.

use mediant_moves::Vector;

use crate::{Demand, DiagonalGap, Grid, Placement, Rules, Vertex};

/// How the first octant lies on the map: which axis is the long one, and the signs along both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// Whether the segment is longer down than across, so that the transposed map has its runs of bits.
    pub(crate) transposed: bool,
    /// The sign along the long axis.
    pub(crate) long: i32,
    /// The sign along the short axis.
    pub(crate) short: i32,
}

impl Frame {
    /// The frame of a displacement, and the displacement in it.
    pub(crate) const fn of(d: Vector) -> (Self, Vector) {
        let transposed = d.y.unsigned_abs() > d.x.unsigned_abs();
        let (u, v) = if transposed { (d.y, d.x) } else { (d.x, d.y) };
        let frame = Self { transposed, long: if u < 0 { -1 } else { 1 }, short: if v < 0 { -1 } else { 1 } };
        (frame, Vector::new(u.abs(), v.abs()))
    }

    /// The offset on the map (or on the transposed map) of cell (i, j) of the octant.
    pub(crate) fn cell<P: Placement>(self, i: i32, j: i32) -> (i32, i32) {
        (P::cell(self.long, i), P::cell(self.short, j))
    }
}

/// Whether the straight segment from one vertex to another obeys the rules of motion (DESIGN, 'Rules of motion'). A
/// segment that leaves the map does not; one of length 0 does when its vertex is free.
///
/// Under [`DiagonalGap::Closed`] the segment may not pass a gap; whether it may start or end at one is a matter of the
/// path (see [`GridGraph::for_each_successor`](crate::GridGraph::for_each_successor)).
///
/// Each row (or column, whichever the segment crosses fewer of) is tested by masked words.
#[must_use]
pub fn line_of_sight<P: Placement>(grid: &Grid, rule: P::Rule, from: Vertex, to: Vertex) -> bool {
    if !P::is_free(grid, from) || !P::is_free(grid, to) {
        return false;
    }
    if from == to {
        return true;
    }
    let (frame, d) = Frame::of(from.to(to));
    let (matrix, u, v) =
        if frame.transposed { (grid.columns(), from.y, from.x) } else { (grid.rows(), from.x, from.y) };
    if d.y == 0 && P::rules(rule).is_corner() {
        // A whole run of edges at once.
        let (low, high) = (u.min(u + frame.long * d.x), u.max(u + frame.long * d.x));
        let gap = P::closes_gaps(rule) && matrix.any_gap(v, low + 1, high - 1);
        return !gap && !matrix.any_edge(v, low, high - 1);
    }
    P::sweep(rule, d, |demand| match demand {
        Demand::Free { row, first, last } => {
            let (a, y) = frame.cell::<P>(first, row);
            let (b, _) = frame.cell::<P>(last, row);
            !matrix.any(v + y, u + a.min(b), u + a.max(b))
        }
        Demand::EitherFree(cells) => cells.iter().any(|&(i, j)| {
            let (x, y) = frame.cell::<P>(i, j);
            !matrix.get(u + x, v + y)
        }),
    })
}

/// [`line_of_sight`] with the rules as a value.
#[must_use]
pub fn line_of_sight_under(grid: &Grid, rules: Rules, from: Vertex, to: Vertex) -> bool {
    match rules {
        Rules::Center(corners) => line_of_sight::<crate::Centers>(grid, corners, from, to),
        Rules::Corner(gap) => line_of_sight::<crate::Corners>(grid, gap, from, to),
    }
}

impl Rules {
    const fn is_corner(self) -> bool {
        matches!(self, Self::Corner(DiagonalGap::Open | DiagonalGap::Closed))
    }
}
