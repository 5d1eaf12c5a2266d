//! Vertices by their coordinates, and the ids that engines keep instead.

use std::{fmt, ops::Add};

use mediant_moves::Vector;

/// A vertex of the search graph: the center of cell (x, y) under center placement, its top left corner under
/// corner placement. x counts to the right and y down, from (0, 0).
///
/// ```
/// use mediant_grid::{Vector, Vertex};
/// let (from, to) = (Vertex::new(1, 2), Vertex::new(4, 6));
/// assert_eq!(from.to(to), Vector::new(3, 4));
/// assert_eq!(from + Vector::new(3, 4), to);
/// assert_eq!(from.distance(to), 5.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Vertex {
    /// The column, counted to the right.
    pub x: i32,
    /// The row, counted down.
    pub y: i32,
}

impl Vertex {
    /// The vertex (x, y).
    #[must_use]
    pub const fn new(x: i32, y: i32) -> Self {
        Self { x, y }
    }

    /// The straight-line distance to `other`, in cells. Neither vertex has to be on a map.
    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        let [x, y] = [(self.x, other.x), (self.y, other.y)].map(|(a, b)| f64::from(a.abs_diff(b)));
        (x * x + y * y).sqrt()
    }

    /// The displacement from here to `other`, for vertices less than 2³¹ apart along each axis, as those of a
    /// map are.
    #[must_use]
    #[inline]
    pub const fn to(self, other: Self) -> Vector {
        Vector::new(other.x - self.x, other.y - self.y)
    }
}

impl Add<Vector> for Vertex {
    type Output = Self;
    #[inline]
    fn add(self, d: Vector) -> Self {
        Self::new(self.x + d.x, self.y + d.y)
    }
}

impl From<(i32, i32)> for Vertex {
    fn from((x, y): (i32, i32)) -> Self {
        Self { x, y }
    }
}

impl fmt::Display for Vertex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}, {})", self.x, self.y)
    }
}

/// The number of a vertex in row-major order, for one grid and one placement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct VertexId(pub u32);

impl VertexId {
    /// The number as an array index.
    #[must_use]
    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}
