//! Amounts of memory.

use std::{fmt, num::NonZeroU64, str::FromStr};

/// An amount of memory, at least one byte. As text a number of bytes, or of one of the units `kB`, `MB` and
/// `GB`, which are thousands, millions and billions of bytes.
///
/// ```
/// use mediant::options::Memory;
/// assert_eq!("8MB".parse::<Memory>().map(Memory::bytes), Ok(8_000_000));
/// assert_eq!("1500000".parse::<Memory>().map(|memory| memory.to_string()), Ok("1500kB".to_owned()));
/// assert!("8 MiB".parse::<Memory>().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Memory(NonZeroU64);

/// The error for a text that is no [`Memory`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected a whole number of bytes from 1 up, also as 500kB, 8MB or 1GB")]
pub struct UnknownMemory {
    /// The text found there.
    pub found: String,
}

/// The units, the largest first.
const UNITS: [(&str, u64); 4] = [("GB", 1_000_000_000), ("MB", 1_000_000), ("kB", 1000), ("", 1)];

impl Memory {
    /// More than any machine has.
    pub(crate) const MAX: Self = Self(NonZeroU64::MAX);

    /// This many bytes; `None` for 0.
    #[must_use]
    pub const fn new(bytes: u64) -> Option<Self> {
        match NonZeroU64::new(bytes) {
            Some(bytes) => Some(Self(bytes)),
            None => None,
        }
    }

    /// The memory that the hub labels of a map may take if the user names none: 64 bytes a cell, but at least
    /// 48 MB and at most 1 GB. That holds the labels of all maps of games, streets and rooms of the MovingAI
    /// sets, and of a street map that was tiled to 4096 × 4096 cells.
    #[must_use]
    pub fn for_labels_of(width: u32, height: u32) -> Self {
        let cells = NonZeroU64::MIN.saturating_add((u64::from(width) * u64::from(height)).saturating_sub(1));
        Self(cells.saturating_mul(BYTES_A_CELL).clamp(LEAST, MOST))
    }

    /// The number of bytes.
    #[must_use]
    pub const fn bytes(self) -> u64 {
        self.0.get()
    }

    /// The number of bytes, as far as this machine can address them.
    pub(crate) fn as_usize(self) -> usize {
        usize::try_from(self.bytes()).unwrap_or(usize::MAX)
    }
}

const BYTES_A_CELL: NonZeroU64 = NonZeroU64::MIN.saturating_add(63);
const LEAST: NonZeroU64 = NonZeroU64::MIN.saturating_add(48_000_000 - 1);
const MOST: NonZeroU64 = NonZeroU64::MIN.saturating_add(1_000_000_000 - 1);

/// In the largest unit of which it is a whole number.
impl fmt::Display for Memory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bytes = self.bytes();
        let fits = UNITS.into_iter().find(|(_, size)| bytes.is_multiple_of(*size));
        let (unit, size) = fits.unwrap_or(("", 1));
        f.pad(&format!("{}{unit}", bytes / size))
    }
}

impl FromStr for Memory {
    type Err = UnknownMemory;

    fn from_str(text: &str) -> Result<Self, UnknownMemory> {
        let parts = UNITS.into_iter().find_map(|(unit, size)| Some((text.strip_suffix(unit)?, size)));
        let bytes = parts.and_then(|(number, size)| {
            // `parse` would also take a sign.
            let is_number = number.bytes().all(|digit| digit.is_ascii_digit());
            number.parse::<u64>().ok().filter(|_| is_number)?.checked_mul(size)
        });
        bytes.and_then(Self::new).ok_or_else(|| UnknownMemory { found: text.to_owned() })
    }
}
