//! Fixed-point costs: exact sums, the same on every platform.

use core::{
    fmt,
    ops::{Add, AddAssign, Mul, Sub},
};

use crate::Vector;

/// A path cost as an integer multiple of 2⁻³² cells.
///
/// The length of each move is rounded once, to the nearest multiple; paths and heuristics are integer sums of
/// such lengths. So sums are exact and do not depend on their order: two paths that take the same moves in
/// another order compare equal, and ties fall the same way on every platform.
///
/// **Error.** The cost of a move differs from its length by at most [`MAX_MOVE_ERROR`](Self::MAX_MOVE_ERROR)
/// = 2⁻³³; axis moves are exact. No move is shorter than 1, so the relative error of a path's cost is also at
/// most 2⁻³³. A path that is shortest in these costs is therefore at most 1 + 2⁻³¹ times as long as the
/// shortest one.
///
/// **Range.** Below 2³² cells. Sums beyond overflow as those of `u64` do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Cost(u64);

impl Cost {
    /// Binary digits after the point.
    pub const FRACTION_BITS: u32 = 32;
    /// The largest difference between a move's cost and its length, in cells.
    pub const MAX_MOVE_ERROR: f64 = 1.0 / (1_u64 << (Self::FRACTION_BITS + 1)) as f64;
    /// Cost 0.
    pub const ZERO: Self = Self(0);
    /// More than the cost of any path.
    pub const MAX: Self = Self(u64::MAX);

    /// The cost of one move: its length, rounded to the nearest multiple of 2⁻³² (computed in integers).
    #[must_use]
    pub const fn of_move(v: Vector) -> Self {
        let square = (v.norm_squared() as u128) << (2 * Self::FRACTION_BITS);
        let root = square.isqrt();
        // (root + ½)² = root² + root + ¼: the nearest integer is root + 1 exactly when the rest exceeds root.
        Self((root + (square - root * root > root) as u128) as u64)
    }

    /// The cost of `bits` · 2⁻³² cells.
    #[must_use]
    pub const fn from_bits(bits: u64) -> Self {
        Self(bits)
    }

    /// The cost in units of 2⁻³² cells.
    #[must_use]
    pub const fn to_bits(self) -> u64 {
        self.0
    }

    /// The cost in cells, rounded to `f64`.
    #[must_use]
    pub const fn to_f64(self) -> f64 {
        self.0 as f64 / (1_u64 << Self::FRACTION_BITS) as f64
    }
}

impl Add for Cost {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl AddAssign for Cost {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.0 += other.0;
    }
}

impl Sub for Cost {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul<u32> for Cost {
    type Output = Self;
    #[inline]
    fn mul(self, times: u32) -> Self {
        Self(self.0 * u64::from(times))
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.to_f64().fmt(f)
    }
}

#[cfg(feature = "alloc")]
pub use table::CostTable;

#[cfg(feature = "alloc")]
mod table {
    use alloc::{boxed::Box, vec::Vec};

    use super::Cost;
    use crate::{FiniteK, KError, Quadrant, Vector};

    /// The costs of the moves of Q(k − 2), and h_k computed from them: the heuristic of the searches over
    /// N(k).
    ///
    /// h_k is a sum of the same rounded costs as every path. Up to [`CostTable::MAX_K`], the rounding is
    /// smaller than the difference between a move and any detour over its neighbors. So h_k is exactly the
    /// cost of the cheapest path on an empty grid, and therefore admissible and consistent, in integers and
    /// without any tolerance.
    ///
    /// ```
    /// use mediant_moves::{Cost, CostTable, FiniteK, Vector};
    /// let table = CostTable::new(FiniteK::new(4)?)?;
    /// let h = table.distance(Vector::new(-7, 9));
    /// assert_eq!(h, Cost::of_move(Vector::new(1, 1)) * 5 + Cost::of_move(Vector::new(1, 2)) * 2);
    /// # Ok::<(), mediant_moves::KError>(())
    /// ```
    #[derive(Clone, Debug)]
    pub struct CostTable {
        depth: u32,
        costs: Box<[Cost]>,
    }

    impl CostTable {
        /// The largest k for which, in rounded costs, every move is cheaper than each detour over its
        /// neighbors (a test checks that it fails at the next k). Its table takes 512 KiB.
        pub const MAX_K: u32 = 18;

        /// The table for N(k).
        ///
        /// # Errors
        /// [`KError::TooLarge`] above [`MAX_K`](Self::MAX_K).
        pub fn new(k: FiniteK) -> Result<Self, KError> {
            Self::with_costs(k, Cost::of_move)
        }

        /// The table of other costs of the moves of N(k), such as the least on a map whose cells have costs:
        /// [`distance`](Self::distance) is then the cost of the cheapest path by these, provided that no move
        /// costs more than a detour over its neighbors.
        ///
        /// # Errors
        /// [`KError::TooLarge`] above [`MAX_K`](Self::MAX_K).
        pub fn with_costs(k: FiniteK, cost: impl FnMut(Vector) -> Cost) -> Result<Self, KError> {
            if k.get() > Self::MAX_K {
                return Err(KError::TooLarge { k: k.get().into(), max: Self::MAX_K });
            }
            let costs: Vec<Cost> = Quadrant::new(k)?.iter().map(cost).collect();
            Ok(Self { depth: k.depth(), costs: costs.into_boxed_slice() })
        }

        /// The cost of the move at `index` of the quadrant.
        #[must_use]
        pub fn get(&self, index: usize) -> Option<Cost> {
            self.costs.get(index).copied()
        }

        /// h_k(d), for d of any quadrant with coordinates below 2³¹ in magnitude.
        ///
        /// By the rounds of Hormazábal 2017, Algorithm 2, which keep the index of the pair of moves instead
        /// of the moves; the two costs are looked up at the end. (The comparison with all moves at once,
        /// which [`distance`](crate::distance()) uses for small k, made no search faster by more than 1 %.)
        #[must_use]
        #[inline]
        pub fn distance(&self, d: Vector) -> Cost {
            let (mut x, mut y) = d.abs();
            let mut index = 0;
            for _ in 0..self.depth {
                let beyond = x > y;
                index = 2 * index + usize::from(beyond);
                (x, y) = if beyond { (x - y, y) } else { (x, y - x) };
            }
            let pair = &self.costs[index..index + 2];
            pair[0] * y + pair[1] * x
        }

        /// h_k of a displacement that need not be whole, with coordinates below 2¹⁶ in magnitude: in cells,
        /// off by less than 2⁻³⁴.
        #[must_use]
        #[inline]
        pub fn distance_f64(&self, x: f64, y: f64) -> f64 {
            // In fixed point, where the rounds are exact. Truncation moves each coordinate, and so h_k, by
            // less than 2⁻³⁶; the two products and their sum are each rounded by at most 2⁻³⁷.
            const ONE: f64 = (1_u64 << 36) as f64;
            let [mut x, mut y] = [x, y].map(|distance| (distance.abs() * ONE) as u64);
            let mut index = 0;
            for _ in 0..self.depth {
                let beyond = x > y;
                index = 2 * index + usize::from(beyond);
                (x, y) = if beyond { (x - y, y) } else { (x, y - x) };
            }
            let [x, y] = [x, y].map(|times| times as f64 / ONE);
            self.costs[index].to_f64() * y + self.costs[index + 1].to_f64() * x
        }
    }
}
