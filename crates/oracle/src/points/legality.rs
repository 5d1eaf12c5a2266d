//! The rules of motion for segments between points anywhere, by brute force.

use mediant_grid::{DiagonalGap, Grid};

use super::{PARTS_PER_CELL, Parts, vertex_at};
use crate::{
    geometry::{Contact, Rectangle, Segment},
    is_gap,
    legality::{free_quadrants, is_blocked},
};

/// Whether a point is free: it touches a free cell.
///
/// Inside a cell that is this cell, on an edge one of the two beside it, on a corner one of the four around
/// it. Cells outside the map are blocked.
#[must_use]
pub fn point_is_free(grid: &Grid, point: Parts) -> bool {
    let touched = |n: i64| {
        let cell = n.div_euclid(PARTS_PER_CELL);
        let is_on_line = n.rem_euclid(PARTS_PER_CELL) == 0;
        if is_on_line { cell - 1..=cell } else { cell..=cell }
    };
    touched(point.1).any(|y| touched(point.0).any(|x| !is_blocked(grid, x, y)))
}

/// Whether the straight segment between two points, by itself, is legal. At its ends
/// [`turn_at_point_is_legal`] decides about closed gaps.
///
/// Both ends must be [free](point_is_free). The segment may not meet the open interior of a blocked cell, and
/// no part of positive length may run along the edge between two blocked cells (outside counts as blocked).
/// Under [`DiagonalGap::Closed`] no gap may lie strictly between the ends.
///
/// A segment of length 0 is legal at a free point. Time is proportional to the area of the bounding box.
///
/// ```
/// use mediant_grid::{AsciiMap, DiagonalGap};
/// use mediant_oracle::segment_between_points_is_legal;
///
/// let grid = AsciiMap::parse("
///     .#
///     ..
/// ")?.grid;
/// let is_legal = |a, b| segment_between_points_is_legal(&grid, DiagonalGap::Open, a, b);
/// assert!(is_legal((512, 512), (1024, 1024)), "from the center of a cell to a corner");
/// assert!(!is_legal((512, 512), (1536, 1535)), "through the inside of the blocked cell");
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[must_use]
pub fn segment_between_points_is_legal(grid: &Grid, gap: DiagonalGap, a: Parts, b: Parts) -> bool {
    // Free ends lie in the map, so that no sum below can overflow.
    if !point_is_free(grid, a) || !point_is_free(grid, b) {
        return false;
    }
    let segment = Segment { from: [a.0, a.1], by: [b.0 - a.0, b.1 - a.1] };
    a == b || cells_between(a, b).all(|(x, y)| is_legal_around(grid, gap, &segment, (x, y)))
}

/// Whether a segment keeps to the rules in cell (x, y), along its left and its upper edge, and at their
/// common vertex.
fn is_legal_around(grid: &Grid, gap: DiagonalGap, segment: &Segment, (x, y): (i64, i64)) -> bool {
    let blocked = |x: i64, y: i64| is_blocked(grid, x, y);
    let contact = |width: i64, height: i64| {
        let low = [x * PARTS_PER_CELL, y * PARTS_PER_CELL];
        segment.contact(&Rectangle { low, high: [low[0] + width, low[1] + height] })
    };
    let crosses_cell = || contact(PARTS_PER_CELL, PARTS_PER_CELL) == Contact::Inside;
    let runs_along_left = || contact(0, PARTS_PER_CELL) == Contact::Rim;
    let runs_along_top = || contact(PARTS_PER_CELL, 0) == Contact::Rim;
    if blocked(x, y)
        && (crosses_cell()
            || (blocked(x - 1, y) && runs_along_left())
            || (blocked(x, y - 1) && runs_along_top()))
    {
        return false;
    }
    let corner = (x * PARTS_PER_CELL, y * PARTS_PER_CELL);
    gap == DiagonalGap::Open || !is_gap_at(grid, corner) || !lies_within(segment, corner)
}

/// Whether a point lies on a segment of positive length, strictly between its ends.
fn lies_within(segment: &Segment, point: Parts) -> bool {
    let point = [point.0, point.1];
    let to = [0, 1].map(|axis| segment.from[axis] + segment.by[axis]);
    let is_on = segment.contact(&Rectangle { low: point, high: point }) != Contact::Nothing;
    is_on && point != segment.from && point != to
}

/// The cells whose left or upper edge or inside the segment between two points may meet.
fn cells_between(a: Parts, b: Parts) -> impl Iterator<Item = (i64, i64)> {
    let range = |a: i64, b: i64| a.min(b).div_euclid(PARTS_PER_CELL)..=a.max(b).div_euclid(PARTS_PER_CELL);
    range(a.1, b.1).flat_map(move |y| range(a.0, b.0).map(move |x| (x, y)))
}

/// Whether a point is a vertex at which two blocked cells meet diagonally while the two others are free.
fn is_gap_at(grid: &Grid, point: Parts) -> bool {
    vertex_at(point).is_some_and(|vertex| is_gap(grid, vertex))
}

/// Whether a path under [`DiagonalGap::Closed`] may come from `before` to `at` and go on to `after`, given
/// that both segments are legal. `None` stands for the start or end of the path at `at`.
///
/// There is no restriction unless `at` is exactly a gap. There a path must stay in one closed free quadrant,
/// and a path that starts or ends there in the quadrant of the vertex's own cell (x, y), which must be free.
/// A path that consists of `at` alone is legal.
#[must_use]
pub fn turn_at_point_is_legal(grid: &Grid, before: Option<Parts>, at: Parts, after: Option<Parts>) -> bool {
    let Some(vertex) = vertex_at(at).filter(|&vertex| is_gap(grid, vertex)) else { return true };
    if before.is_none() && after.is_none() {
        return true;
    }
    let is_end = before.is_none() || after.is_none();
    let is_in = |other: Parts, (sx, sy): (i64, i64)| {
        // Compared rather than subtracted: `other` may be anywhere.
        other.0.cmp(&at.0) as i64 * sx >= 0 && other.1.cmp(&at.1) as i64 * sy >= 0
    };
    free_quadrants(grid, vertex).any(|signs| {
        let holds = |other: Option<Parts>| other.is_none_or(|other| is_in(other, signs));
        holds(before) && holds(after) && (!is_end || signs == (1, 1))
    })
}
