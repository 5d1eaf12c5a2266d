//! Integer vectors of the plane: displacements and moves.

use core::ops::{Add, Mul, Neg, Sub};

use crate::sqrt::sqrt;

/// An integer vector: a displacement between two vertices or, when [`is_move`](Self::is_move), a move.
///
/// Vectors are ordered by `x`, then `y`, for use in sorted containers. For the order by angle see
/// [`precedes`](Self::precedes). Sums, products and turns overflow as those of `i32` do.
///
/// ```
/// use mediant_moves::Vector;
/// let (u, v) = (Vector::new(1, 2), Vector::new(1, 1));
/// assert!(u.is_move() && u.precedes(v));
/// assert_eq!(u + v, Vector::new(2, 3));
/// assert_eq!(u.det(v), -1);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Vector {
    /// The component to the right, in cells.
    pub x: i32,
    /// The component downwards, in cells. (Upwards in the papers, which makes no difference: every
    /// neighborhood is symmetric.)
    pub y: i32,
}

impl Vector {
    /// The vector (0, 0).
    pub const ZERO: Self = Self { x: 0, y: 0 };

    /// The vector (x, y).
    #[must_use]
    pub const fn new(x: i32, y: i32) -> Self {
        Self { x, y }
    }

    /// det(u, v) = `u.x·v.y − u.y·v.x` (Kramm 2018, Eq. 1), exact for all inputs.
    ///
    /// Two moves of one quadrant with |det| = 1 are adjacent in some neighborhood (Kramm 2018, Proposition
    /// 4).
    #[must_use]
    pub const fn det(self, other: Self) -> i128 {
        self.x as i128 * other.y as i128 - self.y as i128 * other.x as i128
    }

    /// The scalar product, exact for all inputs.
    #[must_use]
    pub const fn dot(self, other: Self) -> i128 {
        self.x as i128 * other.x as i128 + self.y as i128 * other.y as i128
    }

    /// u ⪯ v for two vectors of the first quadrant: u is no further from the Y axis than v, clockwise in the
    /// papers' drawing (Rivera 2017, 'Pathfinding in 4- and 8-neighbor Grids': `x·y' ≤ x'·y`).
    #[must_use]
    pub const fn precedes(self, other: Self) -> bool {
        self.det(other) <= 0
    }

    /// x² + y², exact for all inputs.
    #[must_use]
    pub const fn norm_squared(self) -> u64 {
        let (x, y) = (self.x.unsigned_abs() as u64, self.y.unsigned_abs() as u64);
        x * x + y * y
    }

    /// The Euclidean length, within one unit in the last place (correctly rounded below 2⁵³ squared).
    #[must_use]
    pub fn norm(self) -> f64 {
        sqrt(self.norm_squared() as f64)
    }

    /// The greatest common divisor of |x| and |y|; 0 for the zero vector.
    #[must_use]
    pub const fn gcd(self) -> u32 {
        let (mut a, mut b) = (self.x.unsigned_abs(), self.y.unsigned_abs());
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a
    }

    /// Whether this is a move: a vector with gcd 1, which is no multiple of a shorter integer vector.
    #[must_use]
    pub const fn is_move(self) -> bool {
        self.gcd() == 1
    }

    /// |x| and |y|.
    #[must_use]
    pub const fn abs(self) -> (u32, u32) {
        (self.x.unsigned_abs(), self.y.unsigned_abs())
    }

    /// A quarter turn that takes (0, 1) to (1, 0): from each quadrant to the next one in the order of
    /// [`Neighborhood`](crate::Neighborhood).
    #[must_use]
    pub const fn turned(self) -> Self {
        Self { x: self.y, y: -self.x }
    }

    /// This vector turned by `quarters` quarter turns.
    #[must_use]
    pub const fn turned_by(self, quarters: u32) -> Self {
        match quarters & 3 {
            0 => self,
            1 => self.turned(),
            2 => Self { x: -self.x, y: -self.y },
            _ => Self { x: -self.y, y: self.x },
        }
    }

    /// The quadrant 0…3 that this vector lies in, in the order of [`Neighborhood`](crate::Neighborhood), with
    /// the axis on which the quadrant begins but not the one on which it ends; `None` for the zero vector.
    #[must_use]
    pub const fn quadrant(self) -> Option<u32> {
        match (self.x, self.y) {
            (0, 0) => None,
            (0.., 1..) => Some(0),
            (1.., ..=0) => Some(1),
            (..=0, ..=-1) => Some(2),
            _ => Some(3),
        }
    }
}

impl Add for Vector {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y)
    }
}

impl Sub for Vector {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y)
    }
}

impl Neg for Vector {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

impl Mul<i32> for Vector {
    type Output = Self;
    fn mul(self, times: i32) -> Self {
        Self::new(self.x * times, self.y * times)
    }
}

impl From<(i32, i32)> for Vector {
    fn from((x, y): (i32, i32)) -> Self {
        Self { x, y }
    }
}
