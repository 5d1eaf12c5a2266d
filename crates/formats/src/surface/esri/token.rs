//! The words of a text that is too long to be held in memory.

use super::super::{READING, SurfaceError, source::Source};
use crate::{read::PIECE, text::quote};
use std::io::Read;

/// Words between white space, one at a time.
pub(super) struct Tokens<'a, 'b> {
    pub(super) source: &'a mut Source<'b>,
    piece: Vec<u8>,
    /// The place in the piece.
    at: usize,
    /// The bytes of the file before the piece.
    before: u64,
    line: u64,
    /// The place in the file of the first byte of the line.
    line_start: u64,
    token: Vec<u8>,
    /// The line of the word, the first byte of that line, and the first byte of the word.
    token_place: [u64; 3],
}

/// No number has more digits than this.
const LONGEST: usize = 1 << 10;

const DIGITS: &str = "write numbers as digits with a decimal point, not a comma, and `nan` for none";

impl<'a, 'b> Tokens<'a, 'b> {
    /// The words from the begin; [`next`](Self::next) takes the first.
    pub(super) fn new(source: &'a mut Source<'b>) -> Self {
        let none = Vec::new();
        let (at, before, line, line_start) = (0, 0, 1, 0);
        let (piece, token) = (none.clone(), none);
        Self { source, piece, at, before, line, line_start, token, token_place: [1, 0, 0] }
    }

    /// The word that was taken last; an empty one at the end of the file.
    pub(super) fn token(&self) -> &[u8] {
        &self.token
    }

    /// The place in the file at which the word begins.
    pub(super) const fn start(&self) -> u64 {
        self.token_place[2]
    }

    /// The next byte of the file, which stays the next one.
    #[inline]
    fn peek(&mut self) -> Result<Option<u8>, SurfaceError> {
        match self.piece.get(self.at) {
            Some(&byte) => Ok(Some(byte)),
            None => self.refill(),
        }
    }

    #[cold]
    fn refill(&mut self) -> Result<Option<u8>, SurfaceError> {
        self.source.interrupt.check(READING)?;
        let is_first = self.before == 0 && self.piece.is_empty();
        self.before += self.piece.len() as u64;
        self.piece.clear();
        (&mut *self.source.reader).take(PIECE as u64).read_to_end(&mut self.piece)?;
        // The byte order mark of UTF-8, which some editors write before a text.
        self.at = if is_first && self.piece.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Ok(self.piece.get(self.at).copied())
    }

    /// Takes the next word.
    pub(super) fn next(&mut self) -> Result<(), SurfaceError> {
        self.token.clear();
        while let Some(byte) = self.peek()? {
            if !byte.is_ascii_whitespace() {
                break;
            }
            self.at += 1;
            if byte == b'\n' {
                self.line += 1;
                self.line_start = self.before + self.at as u64;
            }
        }
        self.token_place = [self.line, self.line_start, self.before + self.at as u64];
        while let Some(byte) = self.peek()? {
            if byte.is_ascii_whitespace() {
                break;
            }
            if self.token.len() == LONGEST {
                return Err(self.error("a number", DIGITS));
            }
            self.token.push(byte);
            self.at += 1;
        }
        Ok(())
    }

    /// The word as a number of digits.
    pub(super) fn digits(&self) -> Option<u64> {
        let text = std::str::from_utf8(&self.token).ok()?;
        text.parse().ok().filter(|_| text.bytes().all(|byte| byte.is_ascii_digit()))
    }

    /// The word as a whole number of 32 bits, without a point.
    #[inline]
    pub(super) fn whole(&self) -> Option<i32> {
        // −0 is a float.
        if self.token == b"-0" {
            return None;
        }
        std::str::from_utf8(&self.token).ok()?.parse().ok()
    }

    /// The word as a float: digits, or one of the names that Rust knows, such as `nan`.
    pub(super) fn float(&self) -> Option<f64> {
        let number: f64 = std::str::from_utf8(&self.token).ok()?.parse().ok()?;
        // Digits beyond all floats are a mistake.
        let is_beyond = number.is_infinite() && self.token.iter().any(u8::is_ascii_digit);
        (!is_beyond).then_some(number)
    }

    /// The word as a float.
    pub(super) fn number(&self, expected: &str) -> Result<f64, SurfaceError> {
        self.float().ok_or_else(|| self.error(expected, DIGITS))
    }

    /// The word, quoted for an error message.
    pub(super) fn quote(&self) -> String {
        if self.token.is_empty() { "the end of the file".to_owned() } else { quote(&self.token) }
    }

    /// An error at the word.
    pub(super) fn error(&self, expected: &str, remedy: &'static str) -> SurfaceError {
        let [line, line_start, start] = self.token_place;
        let column = start - line_start + 1;
        SurfaceError::Text { line, column, expected: expected.to_owned(), found: self.quote(), remedy }
    }
}
