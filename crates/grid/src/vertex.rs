//! Vertices by their coordinates, and the ids that engines keep instead.

use std::{fmt, num::TryFromIntError, ops::Add};

use mediant_moves::Vector;

/// A vertex of the search graph: the center of cell (x, y) under center placement, its top left corner under
/// corner placement. x counts to the right and y down, from (0, 0).
///
/// Pairs and arrays of integers of any width are vertices, and go where a call takes `impl Into<Vertex>`. A
/// number that is too large for an `i32` becomes the nearest one, which is outside of every map as it was.
///
/// ```
/// use mediant_grid::{Vector, Vertex};
/// let (from, to) = (Vertex::new(1, 2), Vertex::new(4, 6));
/// assert_eq!(from.to(to), Vector::new(3, 4));
/// assert_eq!(from + Vector::new(3, 4), to);
/// assert_eq!(from.distance(to), 5.0);
///
/// let (column, row) = (4_usize, 6_u32);
/// assert_eq!([Vertex::from((column, row)), Vertex::from([4, 6])], [to; 2]);
/// assert_eq!((<[i32; 2]>::from(to), <(usize, usize)>::try_from(to)), ([4, 6], Ok((4, 6))));
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

mod sealed {
    pub trait Sealed {}
}

/// An integer of any width up to 64 bits: what a coordinate of a [`Vertex`] is made of.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no coordinate of a vertex: give an integer",
    label = "not an integer of at most 64 bits"
)]
pub trait Coordinate: Copy + sealed::Sealed {
    /// The number, or the nearest one that an `i32` holds.
    #[must_use]
    fn saturated(self) -> i32;
}

macro_rules! coordinates {
    ($($integer:ty),+) => {
        $(
            impl sealed::Sealed for $integer {}

            impl Coordinate for $integer {
                #[inline]
                fn saturated(self) -> i32 {
                    #[allow(unused_comparisons, reason = "not all integers have a sign")]
                    let nearest = if self < 0 { i32::MIN } else { i32::MAX };
                    i32::try_from(self).unwrap_or(nearest)
                }
            }
        )+
    };
}

coordinates!(i8, i16, i32, i64, isize, u8, u16, u32, u64, usize);

impl<X: Coordinate, Y: Coordinate> From<(X, Y)> for Vertex {
    #[inline]
    fn from((x, y): (X, Y)) -> Self {
        Self { x: x.saturated(), y: y.saturated() }
    }
}

impl<C: Coordinate> From<[C; 2]> for Vertex {
    #[inline]
    fn from([x, y]: [C; 2]) -> Self {
        Self { x: x.saturated(), y: y.saturated() }
    }
}

/// The items of a loop over `&path` go into every call, too.
impl From<&Self> for Vertex {
    #[inline]
    fn from(vertex: &Self) -> Self {
        *vertex
    }
}

impl From<Vertex> for (i32, i32) {
    fn from(Vertex { x, y }: Vertex) -> Self {
        (x, y)
    }
}

impl From<Vertex> for [i32; 2] {
    fn from(Vertex { x, y }: Vertex) -> Self {
        [x, y]
    }
}

impl TryFrom<Vertex> for (u32, u32) {
    type Error = TryFromIntError;

    /// # Errors
    /// That of a negative coordinate.
    fn try_from(Vertex { x, y }: Vertex) -> Result<Self, TryFromIntError> {
        Ok((x.try_into()?, y.try_into()?))
    }
}

impl TryFrom<Vertex> for (usize, usize) {
    type Error = TryFromIntError;

    /// # Errors
    /// That of a negative coordinate.
    fn try_from(Vertex { x, y }: Vertex) -> Result<Self, TryFromIntError> {
        Ok((x.try_into()?, y.try_into()?))
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
