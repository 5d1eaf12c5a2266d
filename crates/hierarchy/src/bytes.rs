//! Reading numbers from bytes that need not be an index.

use crate::HierarchyError;

/// Reads one little-endian `u32` after the other.
pub(crate) struct WordReader<'b> {
    words: std::slice::Iter<'b, [u8; 4]>,
}

impl<'b> WordReader<'b> {
    pub(crate) fn new(bytes: &'b [u8]) -> Result<Self, HierarchyError> {
        match bytes.as_chunks::<4>() {
            (words, []) => Ok(Self { words: words.iter() }),
            _ => Err(HierarchyError::Bytes("their number is not a multiple of four")),
        }
    }

    pub(crate) fn next(&mut self) -> Result<u32, HierarchyError> {
        self.words
            .next()
            .map(|&word| u32::from_le_bytes(word))
            .ok_or(HierarchyError::Bytes("they are too few"))
    }

    /// Checks that at least `count` words are left: to be called before memory for so many is allocated.
    pub(crate) fn check_left(&self, count: usize) -> Result<(), HierarchyError> {
        if self.words.len() < count { Err(HierarchyError::Bytes("they are too few")) } else { Ok(()) }
    }

    /// Checks that all words were read.
    pub(crate) fn end(self) -> Result<(), HierarchyError> {
        if self.words.len() == 0 { Ok(()) } else { Err(HierarchyError::Bytes("they are too many")) }
    }
}
