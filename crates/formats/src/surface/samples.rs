//! The numbers of a raster, in the type of its file.

use mediant_grid::Interrupt;

use super::{READING, SurfaceError};

/// The numbers of a raster, row by row from the top, in the type in which its file has them.
///
/// Types that are not among these come in the next one that holds all their numbers: truth values as `U8`,
/// integers of 8 bits with a sign as `I16`, floats of 16 bits as `F32`, integers of 64 bits as `F64`. Of the
/// last those are refused that `F64` does not hold exactly.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Samples {
    /// Integers of 0 to 255.
    U8(Vec<u8>),
    /// Integers of 0 to 65,535.
    U16(Vec<u16>),
    /// Integers of 16 bits with a sign.
    I16(Vec<i16>),
    /// Integers of 32 bits.
    U32(Vec<u32>),
    /// Integers of 32 bits with a sign.
    I32(Vec<i32>),
    /// Floats of 32 bits.
    F32(Vec<f32>),
    /// Floats of 64 bits.
    F64(Vec<f64>),
}

/// One expression for the numbers of whatever type.
macro_rules! each {
    ($samples:expr, $all:ident => $value:expr) => {
        match $samples {
            $crate::Samples::U8($all) => $value,
            $crate::Samples::U16($all) => $value,
            $crate::Samples::I16($all) => $value,
            $crate::Samples::U32($all) => $value,
            $crate::Samples::I32($all) => $value,
            $crate::Samples::F32($all) => $value,
            $crate::Samples::F64($all) => $value,
        }
    };
}
pub(super) use each;

macro_rules! from_vectors {
    ($($variant:ident => $number:ty),*) => {
        $(impl From<Vec<$number>> for Samples {
            fn from(all: Vec<$number>) -> Self {
                Self::$variant(all)
            }
        })*
    };
}

from_vectors!(U8 => u8, U16 => u16, I16 => i16, U32 => u32, I32 => i32, F32 => f32, F64 => f64);

impl Samples {
    /// The number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        each!(self, all => all.len())
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number at a place, row by row; `None` beyond the last. A number that stands for 'no data' is one
    /// here, too.
    #[must_use]
    #[inline]
    #[allow(clippy::useless_conversion, reason = "one expression for all types")]
    pub fn get(&self, at: usize) -> Option<f64> {
        each!(self, all => all.get(at).map(|&number| f64::from(number)))
    }

    /// Whether the numbers are floats, which have a NaN.
    pub(super) const fn are_floats(&self) -> bool {
        matches!(self, Self::F32(_) | Self::F64(_))
    }

    /// The bytes of one number.
    pub(super) const fn number_bytes(&self) -> usize {
        match self {
            Self::U8(_) => 1,
            Self::U16(_) | Self::I16(_) => 2,
            Self::U32(_) | Self::I32(_) | Self::F32(_) => 4,
            Self::F64(_) => 8,
        }
    }

    /// Adds the bytes of some of the numbers, the lowest byte of each first.
    pub(super) fn push_little_endian(&self, places: std::ops::Range<usize>, bytes: &mut Vec<u8>) {
        each!(self, all => {
            let some = all.get(places).unwrap_or_default();
            bytes.extend(some.iter().flat_map(|number| number.to_le_bytes()));
        });
    }

    /// The numbers row by row, of numbers column by column.
    pub(super) fn transposed(
        &self,
        (width, height): (usize, usize),
        interrupt: &Interrupt,
    ) -> Result<Self, SurfaceError> {
        Ok(each!(self, all => rows_of_columns(all, (width, height), interrupt)?.into()))
    }
}

/// Columns at a time: a line of the processor's cache holds about as many numbers of each row.
const COLUMNS: usize = 16;

fn rows_of_columns<T: Copy + Default>(
    columns: &[T],
    (width, height): (usize, usize),
    interrupt: &Interrupt,
) -> Result<Vec<T>, SurfaceError> {
    let mut rows: Vec<T> = Vec::new();
    rows.try_reserve_exact(columns.len())?;
    rows.resize(columns.len(), T::default());
    for left in (0..width).step_by(COLUMNS) {
        interrupt.check(READING)?;
        for y in 0..height {
            for x in left..width.min(left + COLUMNS) {
                rows[y * width + x] = columns[x * height + y];
            }
        }
    }
    Ok(rows)
}
