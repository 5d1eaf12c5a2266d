//! The neighborhood: k = 2, 3, 4, … ∞.

use core::{fmt, num::ParseIntError, str::FromStr};

use crate::{FiniteK, KError};

/// The neighborhood N(k) of a path's moves: 2^k moves for a finite k, every direction for k = ∞.
///
/// k is no number of directions: k = 3 has 8 moves, k = 8 has 256. [`K::N8`](Self::N8) and
/// [`from_neighbors`](Self::from_neighbors) name a neighborhood by its moves.
///
/// [`new`](Self::new) and `try_from` take k as a number. Its text form is the number, or `any` for k = ∞, for
/// which `inf`, `infinity` and `∞` are read, too.
///
/// ```
/// use mediant_moves::{FiniteK, K};
/// assert_eq!((K::new(5), K::try_from(5), "5".parse()), (Ok(K::N32), Ok(K::N32), Ok(K::N32)));
/// assert_eq!(["any", "inf", "∞"].map(str::parse), [Ok(K::ANY); 3]);
/// assert_eq!(K::from_neighbors(8), Ok(K::N8));
/// assert_eq!(K::N16.finite(), Some(FiniteK::N16));
/// assert_eq!(K::ANY.finite(), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum K {
    /// The 2^k moves of N(k).
    Finite(FiniteK),
    /// Every direction: any-angle paths.
    Any,
}

impl K {
    /// k = 2, the 4-connected neighborhood.
    pub const N4: Self = Self::Finite(FiniteK::N4);
    /// k = 3, the 8-connected neighborhood.
    pub const N8: Self = Self::Finite(FiniteK::N8);
    /// k = 4, sixteen moves.
    pub const N16: Self = Self::Finite(FiniteK::N16);
    /// k = 5, thirty-two moves.
    pub const N32: Self = Self::Finite(FiniteK::N32);
    /// k = 6, sixty-four moves.
    pub const N64: Self = Self::Finite(FiniteK::N64);
    /// k = ∞, every direction.
    pub const ANY: Self = Self::Any;

    /// The finite neighborhood with this k; [`K::ANY`](Self::ANY) is the infinite one.
    ///
    /// # Errors
    /// [`KError::TooSmall`] for k < 2.
    pub const fn new(k: u32) -> Result<Self, KError> {
        match FiniteK::new(k) {
            Ok(k) => Ok(Self::Finite(k)),
            Err(error) => Err(error),
        }
    }

    /// The neighborhood of so many moves: 4 are k = 2, 8 are k = 3, 16 are k = 4.
    ///
    /// # Errors
    /// As for [`FiniteK::from_neighbors`].
    pub const fn from_neighbors(moves: u64) -> Result<Self, KError> {
        match FiniteK::from_neighbors(moves) {
            Ok(k) => Ok(Self::Finite(k)),
            Err(error) => Err(error),
        }
    }

    /// The finite k; `None` at k = ∞.
    #[must_use]
    pub const fn finite(self) -> Option<FiniteK> {
        match self {
            Self::Finite(k) => Some(k),
            Self::Any => None,
        }
    }
}

impl From<FiniteK> for K {
    fn from(k: FiniteK) -> Self {
        Self::Finite(k)
    }
}

/// Makes integers of all widths a k.
macro_rules! try_from_integers {
    ($($integer:ty),+) => {
        $(impl TryFrom<$integer> for K {
            type Error = KError;

            /// # Errors
            /// [`KError::TooSmall`] below 2, [`KError::TooLarge`] above [`u32::MAX`].
            fn try_from(k: $integer) -> Result<Self, KError> {
                FiniteK::try_from(k).map(Self::Finite)
            }
        })+
    };
}

try_from_integers!(u8, u16, u32, u64, usize, i8, i16, i32, i64, isize);

impl fmt::Display for K {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finite(k) => k.fmt(f),
            Self::Any => f.pad("any"),
        }
    }
}

impl FromStr for K {
    type Err = ParseKError;

    fn from_str(text: &str) -> Result<Self, ParseKError> {
        if ["any", "inf", "infinity", "∞"].iter().any(|name| text.eq_ignore_ascii_case(name)) {
            return Ok(Self::Any);
        }
        let k: u32 = text.parse().map_err(|_: ParseIntError| ParseKError::Form)?;
        FiniteK::new(k).map(Self::Finite).map_err(ParseKError::K)
    }
}

/// Why a text is not a [`K`]. `{:?}` shows the text of the error, too.
#[derive(Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ParseKError {
    /// Neither a number nor `any`.
    Form,
    /// A number that is not a valid k.
    K(KError),
}

impl fmt::Display for ParseKError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Self::K(error) = self {
            write!(f, "{error}; ")?;
        }
        f.write_str("choose a number from 2 up, or any")
    }
}

impl fmt::Debug for ParseKError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl core::error::Error for ParseKError {}
