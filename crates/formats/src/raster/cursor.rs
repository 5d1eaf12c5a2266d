//! A place in a file of the Netpbm family, and the words from there on.

use super::RasterError;
use crate::text::quote;

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
    pub(super) fn header_number(&mut self, expected: &'static str) -> Result<u64, RasterError> {
        self.skip_space();
        match self.digits() {
            Some(number) => Ok(number),
            None => Err(self.header_error(self.at, expected)),
        }
    }

    /// The largest sample.
    pub(super) fn maxval(&mut self) -> Result<u32, RasterError> {
        const EXPECTED: &str = "a maxval, the largest sample, of 1 to 65535";
        self.skip_space();
        let start = self.at;
        match self.header_number(EXPECTED)? {
            number @ 1..=0xffff => Ok(number as u32),
            _ => Err(self.header_error(start, EXPECTED)),
        }
    }

    /// The bytes after the header of a binary file, and its one byte of white space or comment.
    pub(super) fn pixels(mut self) -> Result<Pixels<'a>, RasterError> {
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

/// The bytes of the pixels, as far as the file has them.
#[derive(Clone, Copy)]
pub(super) struct Pixels<'a> {
    bytes: &'a [u8],
    /// Whether the one byte of white space before them is the first of CR LF, or of what looks like it.
    after_cr: bool,
}

impl<'a> Pixels<'a> {
    /// The pixels, if the file has as many bytes and at most white space after them.
    pub(super) fn exactly(self, expected: u64) -> Result<&'a [u8], RasterError> {
        let (unit, bytes) = ("bytes", self.bytes);
        // On 32 bits too: what is longer than `usize` can say is longer than the file.
        let parts = usize::try_from(expected).ok().and_then(|expected| bytes.split_at_checked(expected));
        let (pixels, rest) = parts.ok_or(RasterError::Short { unit, expected, found: bytes.len() as u64 })?;
        if self.after_cr && !rest.is_empty() {
            return Err(RasterError::LineEnds);
        }
        if rest.iter().all(|&byte| is_space(byte)) {
            return Ok(pixels);
        }
        Err(RasterError::Long { unit, expected, found: format!("{} more", rest.len()) })
    }
}
