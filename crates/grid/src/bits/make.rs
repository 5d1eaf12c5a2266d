//! Matrices made bit by bit, or word by word.

use bitvec::{field::BitField, prelude::Lsb0, vec::BitVec};

use super::BitMatrix;
use crate::{
    interrupt::{Interrupt, Interrupted, uninterrupted},
    room::room_for,
};

impl BitMatrix {
    /// A matrix in a frame of blocked bits; `blocked(x, y)` is asked once for each bit within, row by row.
    pub(crate) fn from_bits(
        width: u32,
        height: u32,
        interrupt: &Interrupt,
        mut blocked: impl FnMut(u32, u32) -> bool,
    ) -> Result<Self, Interrupted> {
        room_for::<u64>(Self::words_of(width, height), "making the map")?;
        let mut matrix = Self::filled(width, height, true);
        // The bits beyond the last column stay those of the frame.
        let mut row: BitVec<usize, Lsb0> = BitVec::repeat(true, matrix.words_per_row as usize * 64);
        for y in 0..height {
            interrupt.check("making the map")?;
            for x in 0..width {
                row.set(x as usize, blocked(x, y));
            }
            let start = matrix.index(0, y as i32).0 as usize / 64;
            for (word, bits) in matrix.words.make_mut()[start..].iter_mut().zip(row.chunks_exact(64)) {
                *word = bits.load_le();
            }
        }
        Ok(matrix)
    }

    /// A matrix in a frame of this value. `word(x, y)` returns the 64 bits of row y from column x on, lowest
    /// first; those beyond the last column are ignored.
    ///
    /// Hidden: it is for matrices as large as a map, or twice as wide. All bits must fit in 32-bit positions.
    #[doc(hidden)]
    #[must_use]
    pub fn from_words(width: u32, height: u32, frame: bool, word: impl FnMut(i32, i32) -> u64) -> Self {
        uninterrupted(|never| Self::from_words_interruptible((width, height), frame, (never, ""), word))
    }

    /// [`from_words`](Self::from_words), which asks before each row, and says what it is for.
    #[doc(hidden)]
    pub fn from_words_interruptible(
        (width, height): (u32, u32),
        frame: bool,
        (interrupt, during): (&Interrupt, &'static str),
        mut word: impl FnMut(i32, i32) -> u64,
    ) -> Result<Self, Interrupted> {
        room_for::<u64>(Self::words_of(width, height), during)?;
        let mut matrix = Self::filled(width, height, frame);
        for y in 0..height as i32 {
            interrupt.check(during)?;
            for x in (0..width).step_by(64) {
                let within = !0_u64 >> (64 - (width - x).min(64));
                let at = matrix.index(x as i32, y).0 as usize / 64;
                let bits = &mut matrix.words.make_mut()[at];
                *bits = *bits & !within | word(x as i32, y) & within;
            }
        }
        Ok(matrix)
    }
}
