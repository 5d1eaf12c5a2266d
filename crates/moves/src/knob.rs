//! The knob's whole range: k = 2, 3, 4, … ∞.

use core::{fmt, num::ParseIntError, str::FromStr};

use crate::{K, KError};

/// In which directions a path may lead: those of N(k), or every one, k = ∞.
///
/// As text the number, or `any`.
///
/// ```
/// use mediant_moves::{K, Knob};
/// assert_eq!("4".parse(), Ok(Knob::K(K::new(4)?)));
/// assert_eq!("any".parse::<Knob>().map(Knob::finite), Ok(None));
/// # Ok::<(), mediant_moves::KError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Knob {
    /// The moves of N(k).
    K(K),
    /// Every direction: any-angle paths.
    Any,
}

impl Knob {
    /// k, unless it is ∞.
    #[must_use]
    pub const fn finite(self) -> Option<K> {
        match self {
            Self::K(k) => Some(k),
            Self::Any => None,
        }
    }
}

impl From<K> for Knob {
    fn from(k: K) -> Self {
        Self::K(k)
    }
}

impl fmt::Display for Knob {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::K(k) => k.fmt(f),
            Self::Any => f.pad("any"),
        }
    }
}

impl FromStr for Knob {
    type Err = KnobError;

    fn from_str(text: &str) -> Result<Self, KnobError> {
        if text == "any" {
            return Ok(Self::Any);
        }
        let k: u32 = text.parse().map_err(|_: ParseIntError| KnobError::Form)?;
        K::new(k).map(Self::K).map_err(KnobError::K)
    }
}

/// A text that is no [`Knob`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum KnobError {
    /// Neither a number nor `any`.
    Form,
    /// A number that is no k.
    K(KError),
}

impl fmt::Display for KnobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Self::K(error) = self {
            write!(f, "{error}; ")?;
        }
        f.write_str("choose a number from 2 up, or any")
    }
}

impl core::error::Error for KnobError {}
