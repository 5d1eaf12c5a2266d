//! Reads PGM and PBM: the header, and binary pixels.
//!
//! The formats are those of the Netpbm manual pages `pbm` and `pgm`: the two letters of the kind, the width,
//! the height and (PGM) the largest sample, with white space and comments between them; then one byte of
//! white space, and the rows from the top. Files hold one picture here.

use mediant_grid::Interrupt;

use super::{
    READING, Raster, RasterError,
    cursor::{Cursor, Pixels, is_space},
    error::check_sides,
    plain,
    samples::Samples,
};
use crate::text::quote;

/// The kind of a file, by its first two bytes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    PlainBitmap,
    PlainGray,
    Bitmap,
    Gray,
    Colours,
}

/// The kind of a file of the Netpbm family; `None` for others.
pub(super) fn kind(bytes: &[u8]) -> Option<Kind> {
    let kind = match bytes.get(..2)? {
        b"P1" => Kind::PlainBitmap,
        b"P2" => Kind::PlainGray,
        b"P4" => Kind::Bitmap,
        b"P5" => Kind::Gray,
        b"P3" | b"P6" | b"P7" => Kind::Colours,
        _ => return None,
    };
    bytes.get(2).is_none_or(|&byte| is_space(byte) || byte == b'#').then_some(kind)
}

/// The sides that the header of a file of this kind states.
pub(super) fn size(kind: Kind, bytes: &[u8]) -> Result<(u32, u32), RasterError> {
    let (width, height) = sides(kind, &mut Cursor { bytes, at: 2 })?;
    check_sides(width, height)
}

/// The sides and the largest shade that the header of a PGM states; `None` for a PBM.
#[cfg(feature = "surface")]
pub(super) fn gray(kind: Kind, bytes: &[u8]) -> Result<Option<super::gray::Stated>, RasterError> {
    let mut cursor = Cursor { bytes, at: 2 };
    let sides = sides(kind, &mut cursor)?;
    match kind {
        Kind::PlainBitmap | Kind::Bitmap => Ok(None),
        _ => Ok(Some((sides, cursor.maxval()?))),
    }
}

/// The sides, which stand first in the header.
fn sides(kind: Kind, cursor: &mut Cursor<'_>) -> Result<(u64, u64), RasterError> {
    if kind == Kind::Colours {
        return Err(RasterError::Colours { found: quote(&cursor.bytes[..2.min(cursor.bytes.len())]) });
    }
    let width = cursor.header_number("the width")?;
    Ok((width, cursor.header_number("the height")?))
}

/// Reads a file of this kind, if its sides pass a check.
pub(super) fn read(
    kind: Kind,
    bytes: &[u8],
    check: impl Fn(u64, u64) -> Result<(u32, u32), RasterError>,
    interrupt: &Interrupt,
) -> Result<Raster, RasterError> {
    let mut cursor = Cursor { bytes, at: 2 };
    let (width, height) = sides(kind, &mut cursor)?;
    let (width, height) = check(width, height)?;
    let white = if matches!(kind, Kind::PlainBitmap | Kind::Bitmap) { 1 } else { cursor.maxval()? };
    let sides = (width, height);
    let shades = match kind {
        Kind::PlainBitmap => plain::bits(&mut cursor, sides, interrupt)?,
        Kind::PlainGray => plain::samples(&mut cursor, sides, white, interrupt)?,
        Kind::Bitmap => bits(cursor.pixels()?, sides, interrupt)?,
        _ => samples(cursor.pixels()?, sides, white, interrupt)?,
    };
    Ok(Raster { width, height, white, shades, opacities: None, lumas: None })
}

/// Rows of bits, each padded to whole bytes, highest bit first; 1 is black.
fn bits(
    pixels: Pixels<'_>,
    (width, height): (u32, u32),
    interrupt: &Interrupt,
) -> Result<Samples, RasterError> {
    let row_bytes = width.div_ceil(8);
    let pixels = pixels.exactly(u64::from(row_bytes) * u64::from(height))?;
    let mut shades = Samples::up_to(1);
    for row in pixels.chunks_exact(row_bytes as usize) {
        interrupt.check(READING)?;
        shades.extend((0..width as usize).map(|x| u32::from(row[x / 8] >> (7 - x % 8) & 1 == 0)))?;
    }
    Ok(shades)
}

/// Rows of samples, of two bytes where the largest needs them, the higher byte first.
fn samples(
    pixels: Pixels<'_>,
    (width, height): (u32, u32),
    white: u32,
    interrupt: &Interrupt,
) -> Result<Samples, RasterError> {
    let sample_bytes = if white > 0xff { 2 } else { 1 };
    let pixels = pixels.exactly(u64::from(width) * u64::from(height) * sample_bytes)?;
    let mut shades = Samples::up_to(white);
    for (y, row) in (0..).zip(pixels.chunks_exact(width as usize * sample_bytes as usize)) {
        interrupt.check(READING)?;
        if white > 0xff {
            let pair = |pair: &[u8]| u32::from(u16::from_be_bytes([pair[0], pair[1]]));
            check_samples(row.chunks_exact(2).map(pair), y, white)?;
            shades.extend(row.chunks_exact(2).map(pair))?;
        } else {
            check_samples(row.iter().copied().map(u32::from), y, white)?;
            shades.extend(row.iter().copied().map(u32::from))?;
        }
    }
    Ok(shades)
}

/// Checks that no sample of row y is more than the largest that the header states.
fn check_samples(samples: impl Iterator<Item = u32>, y: u32, white: u32) -> Result<(), RasterError> {
    // Of samples of whole bytes none can be.
    if white == 0xff || white == 0xffff {
        return Ok(());
    }
    let Some((x, sample)) = samples.enumerate().find(|&(_, sample)| sample > white) else {
        return Ok(());
    };
    let place = format!("pixel ({x}, {y})");
    Err(RasterError::Sample { place, max: white, found: sample.to_string() })
}
