//! Places on a map, and the ids that engines keep instead of them.

use std::{fmt, ops::Add};

use mediant_moves::Vector;

/// A place of the search graph: cell (x, y) under center placement, the top-left corner of cell (x, y) under corner
/// placement. x counts to the right and y down, from (0, 0).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Vertex {
    /// To the right, in cells.
    pub x: i32,
    /// Down, in cells.
    pub y: i32,
}

impl Vertex {
    /// The vertex (x, y).
    #[must_use]
    pub const fn new(x: i32, y: i32) -> Self {
        Self { x, y }
    }

    /// The straight-line distance to `other`, in cells; for any two vertices, also such as lie on no map.
    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        let [x, y] = [(self.x, other.x), (self.y, other.y)].map(|(a, b)| f64::from(a.abs_diff(b)));
        (x * x + y * y).sqrt()
    }

    /// The displacement from here to `other`, for vertices less than 2³¹ apart, as those of a map are.
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

/// The number of a vertex in row-major order, under one placement of one grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct VertexId(pub u32);

impl VertexId {
    /// As an array index.
    #[must_use]
    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}
