//! One number a pixel, in as few bytes as the largest needs: in memory, and in the rows of a file.

use std::collections::TryReserveError;

/// Numbers in the order of the pixels, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Samples {
    U8(Vec<u8>),
    U16(Vec<u16>),
    U32(Vec<u32>),
}

impl Samples {
    /// No numbers yet, with room in each for `largest`.
    pub(crate) const fn up_to(largest: u32) -> Self {
        match largest {
            0..=0xff => Self::U8(Vec::new()),
            0x100..=0xffff => Self::U16(Vec::new()),
            _ => Self::U32(Vec::new()),
        }
    }

    pub(crate) fn len(&self) -> usize {
        match self {
            Self::U8(all) => all.len(),
            Self::U16(all) => all.len(),
            Self::U32(all) => all.len(),
        }
    }

    pub(crate) fn get(&self, at: usize) -> Option<u32> {
        match self {
            Self::U8(all) => all.get(at).copied().map(u32::from),
            Self::U16(all) => all.get(at).copied().map(u32::from),
            Self::U32(all) => all.get(at).copied(),
        }
    }

    /// Adds numbers; none may be more than the largest that was named.
    pub(crate) fn extend(
        &mut self,
        numbers: impl ExactSizeIterator<Item = u32>,
    ) -> Result<(), TryReserveError> {
        let more = numbers.len();
        match self {
            Self::U8(all) => {
                all.try_reserve(more)?;
                all.extend(numbers.map(|number| number as u8));
            }
            Self::U16(all) => {
                all.try_reserve(more)?;
                all.extend(numbers.map(|number| number as u16));
            }
            Self::U32(all) => {
                all.try_reserve(more)?;
                all.extend(numbers);
            }
        }
        Ok(())
    }
}

/// part / whole · largest, rounded, half up.
pub(super) fn scaled(part: u32, whole: u32, largest: u32) -> u32 {
    if whole == largest {
        return part;
    }
    let [part, whole, largest] = [part, whole, largest].map(u64::from);
    ((2 * part * largest + whole) / (2 * whole)) as u32
}

/// Adds a sample: one byte, or two where the largest needs them.
pub(super) fn push_sample(row: &mut Vec<u8>, sample: u32, largest: u32) {
    if largest > 0xff {
        row.push((sample >> 8) as u8);
    }
    row.push(sample as u8);
}

/// Adds bits, the first of each byte highest; the last byte is filled with zeros.
pub(super) fn pack_bits(row: &mut Vec<u8>, bits: impl Iterator<Item = bool>) {
    for (x, bit) in bits.enumerate() {
        if x % 8 == 0 {
            row.push(0);
        }
        if let Some(byte) = row.last_mut() {
            *byte |= u8::from(bit) << (7 - x % 8);
        }
    }
}
