//! An interval of a line that a vertex sees.

use super::interval::{IntervalEnd, Ray};

/// An interval of a line that is seen. Its ends differ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) line: i32,
    pub(super) left: Edge,
    pub(super) right: Edge,
}

impl Piece {
    /// Its first and last column of vertices; it may have none.
    #[inline]
    pub(super) const fn columns(&self) -> (i32, i32) {
        (self.left.end.here.ceil(), self.right.end.here.floor())
    }
}

/// An end of an interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) end: IntervalEnd,
    /// Whether the end follows a vertical wall. Then it stays in its column, and becomes a ray where the wall
    /// ends.
    pub(super) is_wall: bool,
}

impl Edge {
    pub(super) const fn ray(end: IntervalEnd) -> Self {
        Self { end, is_wall: false }
    }

    pub(super) const fn wall(x: i32) -> Self {
        Self { end: IntervalEnd::standing(x), is_wall: true }
    }

    /// The end on the line that is `lines` lines further on, if nothing is in the way.
    #[inline]
    pub(super) const fn after(&self, lines: i32) -> Self {
        Self { end: self.end.moved_to(self.end.after(lines)), ..*self }
    }

    /// The ray through the end, from a root at `x`, `n` away, both in parts of a cell.
    #[inline]
    pub(super) fn as_ray(&self, x: i32, n: i32) -> Ray {
        if self.is_wall { Ray::through(self.end.here.floor(), x, n) } else { self.end.ray }
    }
}

/// Whether the interval still has a length: a ray at one end may have met the wall at the other.
#[inline]
pub(super) const fn widens([left, right]: [Edge; 2]) -> bool {
    left.end.here.floor() < right.end.here.ceil()
}
