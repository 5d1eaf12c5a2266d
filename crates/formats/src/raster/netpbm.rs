//! Reads PGM and PBM: the header, and binary pixels.
//!
//! The formats are those of the Netpbm manual pages `pbm` and `pgm`: the two letters of the kind, the width,
//! the height and (PGM) the largest sample, with white space and comments between them; then one byte of
//! white space, and the rows from the top. Files hold one picture here.

use mediant_grid::Interrupt;

use super::{READING, Raster, RasterError, error::check_sides, plain, samples::Samples};
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
    sides(kind, &mut Cursor { bytes, at: 2 })
}

/// The sides, which stand first in the header.
fn sides(kind: Kind, cursor: &mut Cursor<'_>) -> Result<(u32, u32), RasterError> {
    if kind == Kind::Colours {
        return Err(RasterError::Colours { found: quote(&cursor.bytes[..2.min(cursor.bytes.len())]) });
    }
    let width = cursor.header_number("the width")?;
    let height = cursor.header_number("the height")?;
    check_sides(width, height)
}

/// Reads a file of this kind.
pub(super) fn read(kind: Kind, bytes: &[u8], interrupt: &Interrupt) -> Result<Raster, RasterError> {
    let mut cursor = Cursor { bytes, at: 2 };
    let (width, height) = sides(kind, &mut cursor)?;
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
    let pixels = check_length(pixels, u64::from(row_bytes) * u64::from(height))?;
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
    let pixels = check_length(pixels, u64::from(width) * u64::from(height) * sample_bytes)?;
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

/// The bytes of the pixels, as far as the file has them.
#[derive(Clone, Copy)]
struct Pixels<'a> {
    bytes: &'a [u8],
    /// Whether the one byte of white space before them is the first of CR LF, or of what looks like it.
    after_cr: bool,
}

/// The pixels, if the file has as many bytes and at most white space after them.
fn check_length(pixels: Pixels<'_>, expected: u64) -> Result<&[u8], RasterError> {
    let (unit, bytes) = ("bytes", pixels.bytes);
    // On 32 bits too: what is longer than `usize` can say is longer than the file.
    let parts = usize::try_from(expected).ok().and_then(|expected| bytes.split_at_checked(expected));
    let (pixels_alone, rest) =
        parts.ok_or(RasterError::Short { unit, expected, found: bytes.len() as u64 })?;
    if pixels.after_cr && !rest.is_empty() {
        return Err(RasterError::LineEnds);
    }
    if rest.iter().all(|&byte| is_space(byte)) {
        return Ok(pixels_alone);
    }
    Err(RasterError::Long { unit, expected, found: format!("{} more", rest.len()) })
}

/// The white space of these formats.
pub(super) const fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}

/// A place in the file.
pub(super) struct Cursor<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
}

impl<'a> Cursor<'a> {
    pub(super) fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Goes past white space, and past comments: from `#` to the end of the line.
    pub(super) fn skip_space(&mut self) {
        while let Some(byte) = self.peek() {
            match byte {
                b'#' => self.skip_line(),
                _ if is_space(byte) => self.at += 1,
                _ => break,
            }
        }
    }

    fn skip_line(&mut self) {
        let rest = &self.bytes[self.at..];
        let ends = |&byte: &u8| byte == b'\n' || byte == b'\r';
        self.at += rest.iter().position(ends).map_or(rest.len(), |length| length + 1);
    }

    /// The digits from here on as a number, which stops growing where it is beyond all bounds.
    pub(super) fn digits(&mut self) -> Option<u64> {
        let start = self.at;
        let mut number = 0_u64;
        while let Some(digit) = self.peek().filter(u8::is_ascii_digit) {
            number = number.saturating_mul(10).saturating_add(u64::from(digit - b'0'));
            self.at += 1;
        }
        (self.at > start).then_some(number)
    }

    /// The next number of the header.
    fn header_number(&mut self, expected: &'static str) -> Result<u64, RasterError> {
        self.skip_space();
        match self.digits() {
            Some(number) => Ok(number),
            None => Err(self.header_error(self.at, expected)),
        }
    }

    /// The largest sample.
    fn maxval(&mut self) -> Result<u32, RasterError> {
        const EXPECTED: &str = "a maxval, the largest sample, of 1 to 65535";
        self.skip_space();
        let start = self.at;
        match self.header_number(EXPECTED)? {
            number @ 1..=0xffff => Ok(number as u32),
            _ => Err(self.header_error(start, EXPECTED)),
        }
    }

    /// The bytes after the header of a binary file, and its one byte of white space or comment.
    fn pixels(mut self) -> Result<Pixels<'a>, RasterError> {
        match self.peek() {
            Some(b'#') => self.skip_line(),
            Some(byte) if is_space(byte) => self.at += 1,
            _ => return Err(self.header_error(self.at, "white space after the header")),
        }
        let after_cr = self.bytes[..self.at].ends_with(b"\r") && self.peek() == Some(b'\n');
        Ok(Pixels { bytes: &self.bytes[self.at..], after_cr })
    }

    fn header_error(&self, at: usize, expected: &'static str) -> RasterError {
        let (line, column) = self.place(at);
        RasterError::Header { line, column, expected, found: self.word(at) }
    }

    /// The line and the column, from 1.
    pub(super) fn place(&self, at: usize) -> (usize, usize) {
        let before = &self.bytes[..at];
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        let start = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
        (line, at - start + 1)
    }

    /// The word at a place, quoted for an error message.
    pub(super) fn word(&self, at: usize) -> String {
        let rest = &self.bytes[at..];
        match rest.iter().position(|&byte| is_space(byte)) {
            _ if rest.is_empty() => "the end of the file".to_owned(),
            Some(0) => "white space".to_owned(),
            end => quote(&rest[..end.unwrap_or(rest.len())]),
        }
    }
}
