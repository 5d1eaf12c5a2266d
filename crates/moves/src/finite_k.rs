//! The finite neighborhoods: k = 2, 3, 4, …

use core::fmt;

/// The k of a 2^k neighborhood: 2 (4-connected), 3 (8-connected), 4 (16 moves), …
///
/// Distances and bounds exist for every `FiniteK`. Sets of moves exist up to [`FiniteK::MAX_MOVES`]; beyond,
/// coordinates do not fit in an `i32`. Integers of every width are a `FiniteK` by `try_from`.
///
/// ```
/// use mediant_moves::FiniteK;
/// assert_eq!(FiniteK::new(3)?.moves(), Some(8));
/// assert_eq!(FiniteK::try_from(3_usize)?, FiniteK::N8);
/// assert!(FiniteK::new(1).is_err() && FiniteK::try_from(-3).is_err());
/// # Ok::<(), mediant_moves::KError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FiniteK(u32);

impl FiniteK {
    /// k = 2, the 4-connected neighborhood.
    pub const N4: Self = Self(2);
    /// k = 3, the 8-connected neighborhood.
    pub const N8: Self = Self(3);
    /// k = 4, sixteen moves.
    pub const N16: Self = Self(4);
    /// k = 5, thirty-two moves.
    pub const N32: Self = Self(5);
    /// k = 6, sixty-four moves.
    pub const N64: Self = Self(6);
    /// The largest k whose moves have `i32` coordinates: Fib(45) = 1,836,311,903 is the radius of N(47), and
    /// Fib(46) exceeds `i32::MAX` (Rivera 2017, Theorem 1, with Fib(0) = Fib(1) = 1).
    pub const MAX_MOVES: Self = Self(47);

    /// The neighborhood with this k.
    ///
    /// # Errors
    /// [`KError::TooSmall`] for k < 2.
    pub const fn new(k: u32) -> Result<Self, KError> {
        if k < 2 { Err(KError::TooSmall { k: k as i64 }) } else { Ok(Self(k)) }
    }

    /// The neighborhood of so many moves, a power of two from 4 up: 8 moves are k = 3.
    ///
    /// ```
    /// use mediant_moves::FiniteK;
    /// assert_eq!(FiniteK::from_neighbors(8), Ok(FiniteK::N8));
    /// let error = FiniteK::from_neighbors(6).unwrap_err();
    /// assert_eq!(error.to_string(), "no 2^k neighborhood has 6 moves: choose 4 or 8");
    /// ```
    ///
    /// # Errors
    /// [`KError::Neighbors`] for any other number; it names the nearest ones.
    pub const fn from_neighbors(moves: u64) -> Result<Self, KError> {
        if moves < 4 || !moves.is_power_of_two() {
            return Err(KError::Neighbors { moves });
        }
        Ok(Self(moves.trailing_zeros()))
    }

    /// k as a number.
    #[must_use]
    pub const fn get(self) -> u32 {
        self.0
    }

    /// The number of rounds of inserting mediants that lead from the 4-connected quadrant to this one: i = k
    /// − 2, the index of Q(i) in Kramm 2018 and of 𝒩^i in Rivera 2017.
    #[must_use]
    pub const fn depth(self) -> u32 {
        self.0 - 2
    }

    /// |N(k)| = 2^k (Rivera 2017, Proposition 2); `None` from k = 64 on.
    #[must_use]
    pub const fn moves(self) -> Option<u64> {
        1_u64.checked_shl(self.0)
    }

    /// The largest coordinate of a move of N(k): Fib(k − 2) (Rivera 2017, Theorem 1).
    ///
    /// # Errors
    /// [`KError::TooLarge`] above [`FiniteK::MAX_MOVES`].
    pub const fn radius(self) -> Result<i32, KError> {
        if self.0 > Self::MAX_MOVES.0 {
            return Err(KError::TooLarge { k: self.0 as u64, max: Self::MAX_MOVES.0 });
        }
        let (mut fib, mut next, mut i) = (1_i64, 1_i64, 0);
        while i < self.depth() {
            (fib, next) = (next, fib + next);
            i += 1;
        }
        Ok(fib as i32)
    }
}

const _: () = {
    assert!(matches!(FiniteK::MAX_MOVES.radius(), Ok(1_836_311_903)));
    assert!(1_836_311_903_i64 + 1_134_903_170 > i32::MAX as i64);
};

impl fmt::Display for FiniteK {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// Makes integers of all widths a k, or the error of one that is none.
macro_rules! try_from_integers {
    ($($integer:ty),+) => {
        $(impl TryFrom<$integer> for FiniteK {
            type Error = KError;

            /// # Errors
            /// [`KError::TooSmall`] below 2, [`KError::TooLarge`] above [`u32::MAX`].
            fn try_from(k: $integer) -> Result<Self, KError> {
                match (u32::try_from(k), u64::try_from(k)) {
                    (Ok(k), _) => Self::new(k),
                    (_, Ok(k)) => Err(KError::TooLarge { k, max: u32::MAX }),
                    // It is negative, so that 64 bits with a sign hold it.
                    _ => Err(KError::TooSmall { k: i64::try_from(k).unwrap_or(i64::MIN) }),
                }
            }
        })+
    };
}

try_from_integers!(u8, u16, u32, u64, usize, i8, i16, i32, i64, isize);

/// Why a k cannot be used. `{:?}` shows the text, too, since that is what a program prints that ends with it.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum KError {
    /// There is no 2^k neighborhood below k = 2.
    TooSmall {
        /// The k that was asked for.
        k: i64,
    },
    /// The moves of this neighborhood do not fit in the integers or tables that would hold them.
    TooLarge {
        /// The k that was asked for.
        k: u64,
        /// The largest k that fits.
        max: u32,
    },
    /// No neighborhood has this number of moves.
    Neighbors {
        /// The number of moves that was asked for.
        moves: u64,
    },
}

impl fmt::Display for KError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooSmall { k } => {
                write!(f, "k = {k} is too small: the smallest 2^k neighborhood is the 4-connected one, k = 2")
            }
            Self::TooLarge { k, max } => write!(f, "k = {k} is too large: at most k = {max} fits here"),
            Self::Neighbors { moves } => {
                write!(f, "no 2^k neighborhood has {moves} moves: choose ")?;
                match (moves.checked_ilog2().unwrap_or(0), moves.checked_next_power_of_two()) {
                    (0 | 1, _) => f.write_str("4, 8 or another power of two"),
                    (below, Some(above)) => write!(f, "{} or {above}", 1_u64 << below),
                    (below, None) => write!(f, "{}", 1_u64 << below),
                }
            }
        }
    }
}

impl fmt::Debug for KError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl core::error::Error for KError {}
