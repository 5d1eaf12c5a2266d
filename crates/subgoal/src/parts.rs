//! Bytes in parts: a part is the number of its words and the words, `u32`, `u64` or bytes, all little endian,
//! and zeros up to a multiple of 8 bytes.

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

    pub(crate) fn part8(&mut self, bytes: impl ExactSizeIterator<Item = u8>) {
        self.bytes.extend((bytes.len() as u64).to_le_bytes());
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(8), 0);
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

    pub(crate) fn part8(&mut self) -> Option<Box<[u8]>> {
        Some(self.take(1)?.into())
    }

    pub(crate) fn part64(&mut self) -> Option<Box<[u64]>> {
        let (words, _) = self.take(size_of::<u64>())?.as_chunks();
        Some(words.iter().map(|&word| u64::from_le_bytes(word)).collect())
    }
}
