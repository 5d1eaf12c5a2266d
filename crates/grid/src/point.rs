//! Points of paths: vertices, and places between them.

use std::fmt;

use crate::{Coordinate, Vertex};

/// A point of the plane, in cells. Its coordinates are exact multiples of 1/1024, so equal points are equal,
/// and a whole coordinate is told apart from one that is nearly so. A [`Vertex`] is a point with whole
/// coordinates.
///
/// Pairs and arrays of numbers, integers or floats, are points, and go where a call takes `impl
/// Into<Point>`. A number is rounded to the nearest multiple; one that is too large for every map, or no
/// number, becomes a coordinate outside of every map.
///
/// As text, and by serde, a whole coordinate is an integer and another one the shortest decimal.
///
/// ```
/// use mediant_grid::{Point, Vertex};
///
/// let between = Point::nearest(2.03, 0.5).expect("two numbers");
/// assert_eq!((between.x(), between.y()), (2079.0 / 1024.0, 0.5));
/// assert_eq!((between.vertex(), between.to_string()), (None, "(2.0302734375, 0.5)".to_owned()));
/// let whole = Point::from(Vertex::new(2, 0));
/// assert_eq!((whole.vertex(), whole.to_string()), (Some(Vertex::new(2, 0)), "(2, 0)".to_owned()));
/// assert_eq!(Point::nearest(2.0, 0.0), Some(whole));
/// assert_eq!([Point::from((2.03, 0.5)), Point::from([2, 0])], [between, whole]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Point {
    /// In parts of a cell, as `y`.
    x: i64,
    y: i64,
}

impl Point {
    /// The parts of a cell that coordinates are counted in.
    pub const PARTS: i64 = 1024;

    /// The point with these coordinates in parts of a cell.
    #[must_use]
    pub const fn from_parts(x: i64, y: i64) -> Self {
        Self { x, y }
    }

    /// The coordinates (x, y) in parts of a cell.
    #[must_use]
    pub const fn parts(self) -> (i64, i64) {
        (self.x, self.y)
    }

    /// The nearest point with coordinates in multiples of 1/1024, of two equally near ones the one further
    /// from 0. `None` for a coordinate that is not a number, or beyond those of all vertices.
    #[must_use]
    pub fn nearest(x: f64, y: f64) -> Option<Self> {
        let parts = |cells: f64| {
            let is_in_range = cells >= f64::from(i32::MIN) && cells <= f64::from(i32::MAX);
            is_in_range.then(|| (cells * Self::PARTS as f64).round() as i64)
        };
        Some(Self { x: parts(x)?, y: parts(y)? })
    }

    /// The same point of the map in the other coordinates: of a point between centers, where (0, 0) is the
    /// middle of the first cell, the one between corners, where (0, 0) is the corner of the map.
    #[must_use]
    pub const fn at_corners(self) -> Self {
        let half = Self::PARTS / 2;
        Self { x: self.x.saturating_add(half), y: self.y.saturating_add(half) }
    }

    /// The other way round: [`at_corners`](Self::at_corners).
    #[must_use]
    pub const fn at_centers(self) -> Self {
        let half = Self::PARTS / 2;
        Self { x: self.x.saturating_sub(half), y: self.y.saturating_sub(half) }
    }

    /// The coordinate to the right, in cells.
    #[must_use]
    pub fn x(self) -> f64 {
        // At most 2⁴¹ parts, which an `f64` holds.
        self.x as f64 / Self::PARTS as f64
    }

    /// The coordinate down, in cells.
    #[must_use]
    pub fn y(self) -> f64 {
        self.y as f64 / Self::PARTS as f64
    }

    /// The straight-line distance to another point, in cells.
    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        let [x, y] = [(self.x, other.x), (self.y, other.y)].map(|(a, b)| a.abs_diff(b) as f64);
        (x * x + y * y).sqrt() / Self::PARTS as f64
    }

    /// The square of [`distance`](Self::distance).
    #[must_use]
    pub fn distance_squared(self, other: Self) -> f64 {
        let [x, y] = [(self.x, other.x), (self.y, other.y)].map(|(a, b)| a.abs_diff(b) as f64);
        (x * x + y * y) / (Self::PARTS * Self::PARTS) as f64
    }

    /// The vertex at this point, or the nearest one above and to the left.
    #[must_use]
    pub fn floor(self) -> Vertex {
        let whole = |parts: i64| parts.div_euclid(Self::PARTS);
        (whole(self.x), whole(self.y)).into()
    }

    /// The vertex at this point, or the nearest one below and to the right.
    #[must_use]
    pub fn ceil(self) -> Vertex {
        let whole = |parts: i64| -(-parts).div_euclid(Self::PARTS);
        (whole(self.x), whole(self.y)).into()
    }

    /// The vertex at this point, if its coordinates are whole.
    #[must_use]
    pub fn vertex(self) -> Option<Vertex> {
        let whole = |parts: i64| i32::try_from(parts / Self::PARTS).ok().filter(|_| parts % Self::PARTS == 0);
        Some(Vertex::new(whole(self.x)?, whole(self.y)?))
    }
}

impl From<&Vertex> for Point {
    fn from(vertex: &Vertex) -> Self {
        (*vertex).into()
    }
}

impl From<Vertex> for Point {
    fn from(Vertex { x, y }: Vertex) -> Self {
        Self { x: i64::from(x) * Self::PARTS, y: i64::from(y) * Self::PARTS }
    }
}

impl From<&Self> for Point {
    fn from(point: &Self) -> Self {
        *point
    }
}

impl PartialEq<Vertex> for Point {
    fn eq(&self, other: &Vertex) -> bool {
        *self == Self::from(*other)
    }
}

mod sealed {
    pub trait Sealed {}
}

/// A number that is a coordinate of a [`Point`]: an integer of at most 64 bits, or a float.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no coordinate of a point: give an integer or a float",
    label = "neither an integer of at most 64 bits nor a float"
)]
pub trait PointCoordinate: Copy + sealed::Sealed {
    /// The coordinate in parts of a cell.
    #[doc(hidden)]
    fn parts(self) -> i64;
}

macro_rules! whole {
    ($($integer:ty),+) => {
        $(
            impl sealed::Sealed for $integer {}

            impl PointCoordinate for $integer {
                #[inline]
                fn parts(self) -> i64 {
                    i64::from(Coordinate::saturated(self)) * Point::PARTS
                }
            }
        )+
    };
}

whole!(i8, i16, i32, i64, isize, u8, u16, u32, u64, usize);

macro_rules! decimal {
    ($($float:ty),+) => {
        $(
            impl sealed::Sealed for $float {}

            impl PointCoordinate for $float {
                #[inline]
                fn parts(self) -> i64 {
                    let last = f64::from(i32::MAX);
                    let cells = if self.is_nan() { -last } else { f64::from(self).clamp(-last, last) };
                    (cells * Point::PARTS as f64).round() as i64
                }
            }
        )+
    };
}

decimal!(f32, f64);

impl<X: PointCoordinate, Y: PointCoordinate> From<(X, Y)> for Point {
    #[inline]
    fn from((x, y): (X, Y)) -> Self {
        Self::from_parts(x.parts(), y.parts())
    }
}

impl<C: PointCoordinate> From<[C; 2]> for Point {
    #[inline]
    fn from([x, y]: [C; 2]) -> Self {
        Self::from_parts(x.parts(), y.parts())
    }
}

/// As `(2, 0.5)`.
impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}, {})", self.x(), self.y())
    }
}

#[cfg(test)]
mod tests {
    use super::Point;
    use crate::Vertex;

    #[test]
    fn every_part_of_a_cell_is_kept_and_all_else_rounded() {
        for parts in -3000..3000 {
            let cells = f64::from(parts) / 1024.0;
            for near in [cells, cells + 0.000_4, cells - 0.000_4] {
                let point = Point::nearest(near, 7.0).expect("two numbers");
                assert_eq!((point.x(), point.y()), (cells, 7.0), "{near}");
                assert_eq!(point.vertex().is_some(), parts % 1024 == 0, "{point}");
            }
        }
        assert_eq!(Point::nearest(0.5 / 1024.0, -0.5 / 1024.0).map(|at| (at.x, at.y)), Some((1, -1)));
    }

    #[test]
    fn the_last_vertices_are_points_and_nothing_is_beyond() {
        for (x, y) in [(i32::MIN, i32::MAX), (i32::MAX, 0), (-1, i32::MIN)] {
            let vertex = Vertex::new(x, y);
            assert_eq!(Point::from(vertex).vertex(), Some(vertex));
            assert_eq!(Point::nearest(f64::from(x), f64::from(y)), Some(Point::from(vertex)));
        }
        for cells in [2_147_483_647.5, -2_147_483_649.0, f64::NAN, f64::INFINITY] {
            assert_eq!((Point::nearest(cells, 0.0), Point::nearest(0.0, cells)), (None, None));
        }
    }
}
