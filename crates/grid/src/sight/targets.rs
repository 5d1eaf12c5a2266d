//! The targets of a visibility sweep, and its directions.

use crate::BitMatrix;

/// The directions in which a [`VisibilitySweep`](super::VisibilitySweep) looks: any of the four closed
/// quadrants.
///
/// ```
/// use mediant_grid::sight::Quadrants;
/// let below = Quadrants::only(1, 1).union(Quadrants::only(-1, 1));
/// assert!(below.contains(-1, 1) && !below.contains(1, -1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quadrants(u8);

impl Quadrants {
    /// All directions.
    pub const ALL: Self = Self(0b1_1111);
    /// Both ways along the horizontal line alone.
    pub const LINE: Self = Self(0b1_0000);

    /// The quadrant with these signs of x and y (±1).
    #[must_use]
    pub const fn only(x: i32, y: i32) -> Self {
        Self(1 << ((x > 0) as u8 + 2 * (y > 0) as u8))
    }

    /// The directions of both.
    #[must_use]
    pub const fn union(self, others: Self) -> Self {
        Self(self.0 | others.0)
    }

    /// Whether the quadrant with these signs is included.
    #[must_use]
    pub const fn contains(self, x: i32, y: i32) -> bool {
        self.0 & Self::only(x, y).0 != 0
    }

    /// Whether the horizontal line is included, to the right (1) or to the left (−1).
    pub(super) const fn contains_horizontal(self, x: i32) -> bool {
        self.contains(x, 1) || self.contains(x, -1) || self.0 & Self::LINE.0 != 0
    }
}

/// The vertices to look for, as [sets](crate::FreeSpace::vertex_set). There is one set for the directions in
/// which x and y have the same sign and one for those in which they have opposite signs. Along an axis, where
/// one of them is 0, both sets count.
#[derive(Clone, Copy, Debug)]
pub struct Targets<'m> {
    /// Targets in directions in which x and y have the same sign.
    pub same: &'m BitMatrix,
    /// Targets in directions in which x and y have opposite signs.
    pub opposite: &'m BitMatrix,
}

/// The same targets in all directions.
impl<'m> From<&'m BitMatrix> for Targets<'m> {
    fn from(marks: &'m BitMatrix) -> Self {
        Self { same: marks, opposite: marks }
    }
}
