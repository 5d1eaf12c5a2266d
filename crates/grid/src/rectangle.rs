//! Rectangles of cells: where a map changes.

use std::fmt;

/// A rectangle of cells. The part of it that lies beyond a map is ignored.
///
/// ```
/// use mediant_grid::Rectangle;
///
/// // Three columns from column 4 on, two rows from row 1 on.
/// let door = Rectangle::new(4, 1, 3, 2);
/// assert_eq!(door, Rectangle::spanning((4, 1), (6, 2)));
/// assert_eq!(door.to_string(), "3 × 2 cells at (4, 1)");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Rectangle {
    /// Its first column.
    pub x: u32,
    /// Its first row.
    pub y: u32,
    /// The number of columns.
    pub width: u32,
    /// The number of rows.
    pub height: u32,
}

impl Rectangle {
    /// The rectangle whose top left cell is (x, y), of `width` columns and `height` rows.
    #[must_use]
    pub const fn new(x: u32, y: u32, width: u32, height: u32) -> Self {
        Self { x, y, width, height }
    }

    /// The rectangle between two opposite corner cells, both of which belong to it, in either order. It has
    /// at most [`u32::MAX`] columns and rows.
    #[must_use]
    pub fn spanning(one: (u32, u32), other: (u32, u32)) -> Self {
        let side = |a: u32, b: u32| (a.min(b), a.abs_diff(b).saturating_add(1));
        let ((x, width), (y, height)) = (side(one.0, other.0), side(one.1, other.1));
        Self { x, y, width, height }
    }

    /// Its cells, row by row.
    pub(crate) fn cells(self) -> impl Iterator<Item = (u32, u32)> {
        let Self { x, y, width, height } = self;
        (y..y + height).flat_map(move |y| (x..x + width).map(move |x| (x, y)))
    }

    /// The smallest rectangle around two, neither of which is empty or reaches beyond the largest map.
    pub(crate) fn around(self, other: Self) -> Self {
        let span = |a: u32, a_length: u32, b: u32, b_length: u32| {
            let first = a.min(b);
            (first, (a + a_length).max(b + b_length) - first)
        };
        let (x, width) = span(self.x, self.width, other.x, other.width);
        let (y, height) = span(self.y, self.height, other.y, other.height);
        Self { x, y, width, height }
    }
}

/// As `3 × 2 cells at (4, 1)`.
impl fmt::Display for Rectangle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { x, y, width, height } = self;
        f.pad(&format!("{width} × {height} cells at ({x}, {y})"))
    }
}
