//! The types of numbers in binary files, and numbers out of bytes.

use super::{Samples, SurfaceError};

/// The type of a number in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F16,
    F32,
    F64,
}

impl Number {
    /// Its bytes in a file.
    pub(super) const fn bytes(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 | Self::F16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 => 8,
        }
    }

    /// No numbers yet, of the type that holds all of these.
    pub(super) const fn none(self) -> Samples {
        match self {
            Self::U8 => Samples::U8(Vec::new()),
            Self::U16 => Samples::U16(Vec::new()),
            Self::I8 | Self::I16 => Samples::I16(Vec::new()),
            Self::U32 => Samples::U32(Vec::new()),
            Self::I32 => Samples::I32(Vec::new()),
            Self::F16 | Self::F32 => Samples::F32(Vec::new()),
            Self::U64 | Self::I64 | Self::F64 => Samples::F64(Vec::new()),
        }
    }

    /// Adds the numbers of some bytes; `width` is that of the raster, for the place in an error.
    pub(super) fn extend(
        self,
        samples: &mut Samples,
        bytes: &mut [u8],
        big_endian: bool,
        width: u32,
    ) -> Result<(), SurfaceError> {
        if big_endian != cfg!(target_endian = "big") {
            bytes.chunks_exact_mut(self.bytes()).for_each(<[u8]>::reverse);
        }
        let bytes = &*bytes;
        match (samples, self) {
            (Samples::U8(all), _) => push(all, bytes, u8::from_ne_bytes),
            (Samples::U16(all), _) => push(all, bytes, u16::from_ne_bytes),
            (Samples::I16(all), Self::I8) => push(all, bytes, |byte| i16::from(i8::from_ne_bytes(byte))),
            (Samples::I16(all), _) => push(all, bytes, i16::from_ne_bytes),
            (Samples::U32(all), _) => push(all, bytes, u32::from_ne_bytes),
            (Samples::I32(all), _) => push(all, bytes, i32::from_ne_bytes),
            (Samples::F32(all), Self::F16) => push(all, bytes, |half| of_half(u16::from_ne_bytes(half))),
            (Samples::F32(all), _) => push(all, bytes, f32::from_ne_bytes),
            (Samples::F64(all), Self::U64) => {
                exact(all, bytes, width, |word| i128::from(u64::from_ne_bytes(word)))
            }
            (Samples::F64(all), Self::I64) => {
                exact(all, bytes, width, |word| i128::from(i64::from_ne_bytes(word)))
            }
            (Samples::F64(all), _) => push(all, bytes, f64::from_ne_bytes),
        }
    }

    /// The bytes of a number of this type in the order of this machine; the nearest one if there is none.
    #[cfg(feature = "geotiff")]
    pub(super) fn to_bytes(self, number: f64) -> Vec<u8> {
        match self {
            Self::U8 => (number as u8).to_ne_bytes().to_vec(),
            Self::I8 => (number as i8).to_ne_bytes().to_vec(),
            Self::U16 => (number as u16).to_ne_bytes().to_vec(),
            Self::I16 => (number as i16).to_ne_bytes().to_vec(),
            Self::U32 => (number as u32).to_ne_bytes().to_vec(),
            Self::I32 => (number as i32).to_ne_bytes().to_vec(),
            Self::U64 => (number as u64).to_ne_bytes().to_vec(),
            Self::I64 => (number as i64).to_ne_bytes().to_vec(),
            // NaN: a half of any other number would have to be rounded.
            Self::F16 => 0x7e00_u16.to_ne_bytes().to_vec(),
            Self::F32 => (number as f32).to_ne_bytes().to_vec(),
            Self::F64 => number.to_ne_bytes().to_vec(),
        }
    }
}

fn push<const N: usize, T>(
    all: &mut Vec<T>,
    bytes: &[u8],
    number: impl Fn([u8; N]) -> T,
) -> Result<(), SurfaceError> {
    let (words, _) = bytes.as_chunks::<N>();
    all.try_reserve(words.len())?;
    all.extend(words.iter().map(|&word| number(word)));
    Ok(())
}

/// Adds integers of 64 bits, each of which a float must hold exactly.
fn exact(
    all: &mut Vec<f64>,
    bytes: &[u8],
    width: u32,
    number: impl Fn([u8; 8]) -> i128,
) -> Result<(), SurfaceError> {
    let (words, _) = bytes.as_chunks::<8>();
    all.try_reserve(words.len())?;
    for &word in words {
        let number = number(word);
        if number as f64 as i128 != number {
            let (at, width) = (all.len() as u64, u64::from(width));
            return Err(SurfaceError::Inexact { x: at % width, y: at / width, found: number.to_string() });
        }
        all.push(number as f64);
    }
    Ok(())
}

/// A float of 16 bits (IEEE 754), exactly.
fn of_half(half: u16) -> f32 {
    let half = u32::from(half);
    let (sign, exponent, fraction) = (half >> 15 << 31, half >> 10 & 0x1f, half & 0x3ff);
    match exponent {
        // Multiples of 2⁻²⁴.
        0 => f32::from_bits(sign | (fraction as f32 * f32::from_bits(0x3380_0000)).to_bits()),
        0x1f => f32::from_bits(sign | 0xff << 23 | fraction << 13),
        // The exponents of halves are biased by 15, these by 127.
        _ => f32::from_bits(sign | (exponent + 112) << 23 | fraction << 13),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves() {
        // By NumPy: `numpy.array(…, 'float16').view('uint16')`.
        let known = [
            (0x0000, 0.0),
            (0x0001, 5.960_464_5e-8),
            (0x03ff, 6.097_555e-5),
            (0x0400, 6.103_515_6e-5),
            (0x3c00, 1.0),
            (0x3555, 0.333_251_95),
            (0xc000, -2.0),
            (0x7bff, 65504.0),
            (0x7c00, f32::INFINITY),
            (0xfc00, f32::NEG_INFINITY),
        ];
        for (half, expected) in known {
            assert_eq!(of_half(half), expected, "{half:#x}");
        }
        assert!(of_half(0x7e00).is_nan() && of_half(0x8000).is_sign_negative());
    }
}
