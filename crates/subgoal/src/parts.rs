//! Bytes in parts: a part is the number of its words and the words, `u32` or `u64`, all little endian, and
//! zeros up to a multiple of 8 bytes.

use mediant_grid::{Interrupt, Interrupted};

/// Writes parts.
pub(crate) struct Writer<'i> {
    pub(crate) bytes: Vec<u8>,
    pub(crate) interrupt: &'i Interrupt,
}

impl Writer<'_> {
    pub(crate) fn part32(&mut self, words: impl ExactSizeIterator<Item = u32>) -> Result<(), Interrupted> {
        self.bytes.extend((words.len() as u64).to_le_bytes());
        let is_odd = words.len() % 2 == 1;
        for (number, word) in words.enumerate() {
            self.interrupt.check_every(1 << 16, number, Interrupted::WRITING)?;
            self.bytes.extend(word.to_le_bytes());
        }
        if is_odd {
            self.bytes.extend([0; 4]);
        }
        Ok(())
    }

    /// Pairs of words of 32 bits.
    pub(crate) fn pairs32<T>(&mut self, of: &[T], pair: impl Fn(&T) -> [u32; 2]) -> Result<(), Interrupted> {
        self.part32((0..2 * of.len()).map(|index| pair(&of[index / 2])[index % 2]))
    }

    pub(crate) fn part64(&mut self, words: &[u64]) -> Result<(), Interrupted> {
        self.bytes.extend((words.len() as u64).to_le_bytes());
        for (number, word) in words.iter().enumerate() {
            self.interrupt.check_every(1 << 16, number, Interrupted::WRITING)?;
            self.bytes.extend(word.to_le_bytes());
        }
        Ok(())
    }
}

/// Reads parts; `None` where there is none.
pub(crate) struct Reader<'b> {
    pub(crate) bytes: &'b [u8],
}

impl<'b> Reader<'b> {
    fn take(&mut self, width: usize) -> Option<&'b [u8]> {
        let (&count, rest) = self.bytes.split_first_chunk()?;
        let length = usize::try_from(u64::from_le_bytes(count)).ok()?.checked_mul(width)?;
        let (part, rest) = rest.split_at_checked(length)?;
        self.bytes = rest.get((length.next_multiple_of(8) - length)..)?;
        Some(part)
    }

    pub(crate) fn part32(&mut self) -> Option<impl ExactSizeIterator<Item = u32> + 'b> {
        let (words, _) = self.take(size_of::<u32>())?.as_chunks();
        Some(words.iter().map(|&word| u32::from_le_bytes(word)))
    }

    pub(crate) fn part64(&mut self) -> Option<Box<[u64]>> {
        let (words, _) = self.take(size_of::<u64>())?.as_chunks();
        Some(words.iter().map(|&word| u64::from_le_bytes(word)).collect())
    }

    /// Reads the pairs that [`pairs32`](Writer::pairs32) wrote; a word without another is left out.
    pub(crate) fn pairs32<T>(&mut self, of: impl Fn([u32; 2]) -> T) -> Option<Box<[T]>> {
        let (words, _) = self.take(size_of::<u32>())?.as_chunks();
        let (pairs, _) = words.as_chunks();
        Some(pairs.iter().map(|pair: &[[u8; 4]; 2]| of(pair.map(u32::from_le_bytes))).collect())
    }
}
