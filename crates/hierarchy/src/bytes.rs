//! Reading numbers from bytes that may be anything.

use crate::HierarchyError;

/// Little-endian `u32`, one after the other.
pub(crate) struct Numbers<'b> {
    words: std::slice::Iter<'b, [u8; 4]>,
}

impl<'b> Numbers<'b> {
    pub(crate) fn of(bytes: &'b [u8]) -> Result<Self, HierarchyError> {
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

    pub(crate) fn end(mut self) -> Result<(), HierarchyError> {
        if self.words.next().is_none() { Ok(()) } else { Err(HierarchyError::Bytes("they are too many")) }
    }
}
