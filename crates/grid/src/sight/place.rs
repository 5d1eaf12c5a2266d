//! Points of a map in the parts of a cell that rays are counted in.

use mediant_moves::Vector;

use super::runs::Runs;
use crate::{BitMatrix, Point, Vertex};

/// A point of a map, vertex or not, in parts of a cell, 1/1024 each: at most 2²⁵ of them along each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Parts to the right.
    pub x: i32,
    /// Parts down.
    pub y: i32,
}

impl Place {
    /// The binary places of a coordinate.
    pub const PLACES: u32 = Point::PARTS.trailing_zeros();

    /// The place of a vertex.
    #[inline]
    #[must_use]
    pub const fn of(at: Vertex) -> Self {
        Self { x: Self::parts(at.x), y: Self::parts(at.y) }
    }

    /// So many cells in parts.
    #[inline]
    #[must_use]
    pub const fn parts(cells: i32) -> i32 {
        cells << Self::PLACES
    }

    /// The vertex at this place, or the nearest one above and to the left.
    #[inline]
    #[must_use]
    pub const fn floor(self) -> Vertex {
        Vertex::new(self.x >> Self::PLACES, self.y >> Self::PLACES)
    }

    /// The vertex at this place, if there is one.
    #[inline]
    #[must_use]
    pub fn vertex(self) -> Option<Vertex> {
        let at = self.floor();
        (Self::of(at) == self).then_some(at)
    }

    /// The displacement from here to another place, in parts.
    #[inline]
    #[must_use]
    pub const fn to(self, other: Self) -> Vector {
        Vector::new(other.x - self.x, other.y - self.y)
    }

    /// The columns of vertices at or beside it: the last one at or to the left, and the first one at or to
    /// the right.
    #[inline]
    #[must_use]
    pub const fn columns(self) -> (i32, i32) {
        let left = self.x >> Self::PLACES;
        (left, left + (Self::parts(left) != self.x) as i32)
    }

    /// The same for lines: the last one at or above, and the first one at or below.
    #[inline]
    #[must_use]
    pub const fn lines(self) -> (i32, i32) {
        Self { x: self.y, y: self.x }.columns()
    }
}

impl Place {
    /// The line at it, or the nearest one behind it for what leaves it downwards (`down` = 1) or upwards
    /// (−1): the row of cells that it enters then is the one ahead of this line.
    #[inline]
    #[must_use]
    pub const fn line(self, down: i32) -> i32 {
        let (above, below) = self.lines();
        if down > 0 { above } else { below }
    }

    /// The run of free cells, of a row that touches it, in which it lies: the columns of vertices where the
    /// run starts and ends. They are equal if there is none, or the second one is less.
    #[inline]
    #[must_use]
    pub fn run(self, row: impl Runs) -> (i32, i32) {
        let (left, right) = self.columns();
        (row.run_start(right, 0), row.first_blocked(left, i32::MAX))
    }

    /// Whether a path may stand there: whether one of the cells that it touches is free. A place outside of
    /// the map is not free.
    #[must_use]
    pub fn is_free(self, rows: &BitMatrix) -> bool {
        let ((left, right), (above, below)) = (self.columns(), self.lines());
        // Of equal ones the cells on both sides, else the cell between.
        let first = |(low, high): (i32, i32)| if low == high { low - 1 } else { low };
        (first((above, below))..=above).any(|y| (first((left, right))..=left).any(|x| !rows.get(x, y)))
    }
}

impl From<Vertex> for Place {
    #[inline]
    fn from(at: Vertex) -> Self {
        Self::of(at)
    }
}

impl From<Place> for Point {
    #[inline]
    fn from(Place { x, y }: Place) -> Self {
        Self::from_parts(i64::from(x), i64::from(y))
    }
}
