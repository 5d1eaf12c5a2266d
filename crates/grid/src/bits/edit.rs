//! The next version of a matrix while it is made.

use super::{BitIndex, BitMatrix, BitRow, BitRun};
use crate::versions::{VersionEdit, Versioned};

impl BitMatrix {
    /// Begins an edit of this matrix, which stays as it is.
    ///
    /// Hidden, as [`set_run`](Self::set_run) is.
    #[doc(hidden)]
    #[must_use]
    pub fn edit(&self) -> MatrixEdit {
        let &Self { width, height, words_per_row, .. } = self;
        MatrixEdit {
            empty: Self { words: Versioned::default(), width, height, words_per_row },
            words: self.words.edit(),
        }
    }

    /// Begins an edit of a matrix that nobody else needs: in place.
    pub(crate) fn into_edit(mut self) -> MatrixEdit {
        let words = std::mem::take(&mut self.words).into_edit();
        MatrixEdit { empty: self, words }
    }
}

/// The next version of a matrix while it is made.
#[doc(hidden)]
pub struct MatrixEdit {
    /// The matrix without its words.
    empty: BitMatrix,
    words: VersionEdit<u64>,
}

impl MatrixEdit {
    /// Changes the bit of column x, row y to the other value.
    pub(crate) fn flip(&mut self, x: u32, y: u32) {
        let BitIndex(at) = self.empty.index(x as i32, y as i32);
        let word = at as usize / 64;
        self.words.set(word, self.words.words()[word] ^ 1 << (at % 64));
    }

    /// Gives the bits of row y that `mask` names, from column x on, a multiple of 64, these values. Returns
    /// the word before and after.
    pub(crate) fn set_bits(&mut self, (x, y): (u32, u32), mask: u64, bits: u64) -> [u64; 2] {
        let word = self.empty.index(x as i32, y as i32).0 as usize / 64;
        let before = self.words.words()[word];
        let after = before & !mask | bits & mask;
        self.words.set(word, after);
        [before, after]
    }

    /// [`BitMatrix::width`].
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.empty.width
    }

    /// [`BitMatrix::height`].
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.empty.height
    }

    /// [`BitMatrix::row`], as it is now.
    #[must_use]
    #[inline]
    pub fn row(&self, y: i32) -> BitRow<'_> {
        let Self { empty, words } = self;
        BitRow { words: words.words(), origin: empty.index(0, y), bits_per_row: empty.bits_per_row() }
    }

    /// [`BitMatrix::set_run`].
    pub fn set_run(&mut self, y: i32, first: i32, end: i32, blocked: bool) {
        self.set_all(self.empty.run(y, first, end), blocked);
    }

    /// [`BitMatrix::set_run_of_column`].
    pub fn set_run_of_column(&mut self, x: i32, first: i32, end: i32, blocked: bool) {
        self.set_all(self.empty.run_of_column(x, first, end), blocked);
    }

    fn set_all(&mut self, run: BitRun, blocked: bool) {
        run.for_each(|word, bits| {
            let before = self.words.words()[word];
            self.words.set(word, if blocked { before | bits } else { before & !bits });
        });
    }

    /// The next version.
    #[must_use]
    pub fn finish(self) -> BitMatrix {
        BitMatrix { words: self.words.finish(), ..self.empty }
    }
}
