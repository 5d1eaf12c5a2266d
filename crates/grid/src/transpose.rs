//! Rows and columns of bits exchanged, 64 × 64 at a time.

use crate::{
    BitMatrix,
    interrupt::{Interrupt, Interrupted},
};

/// Exchanges rows and columns: bit x of word y becomes bit y of word x.
///
/// Halves, quarters, … of the square are exchanged across its diagonal, three sizes at once: eight words lie
/// in registers meanwhile.
#[doc(hidden)]
pub fn transpose(square: &mut [u64; 64]) {
    // As in the midst of what is blocked.
    if matches!(square[0], 0 | u64::MAX) && square.iter().all(|word| *word == square[0]) {
        return;
    }
    for y in 0..8 {
        let words = exchanged([0, 1, 2, 3, 4, 5, 6, 7].map(|i| square[y + 8 * i]), 8);
        for (i, word) in words.into_iter().enumerate() {
            square[y + 8 * i] = word;
        }
    }
    for words in square.as_chunks_mut().0 {
        *words = exchanged(*words, 1);
    }
}

/// Exchanges parts of a square, of which eight words are rows `distance` apart.
#[inline(always)]
fn exchanged(mut words: [u64; 8], distance: usize) -> [u64; 8] {
    exchange::<4>(&mut words, 4 * distance);
    exchange::<2>(&mut words, 2 * distance);
    exchange::<1>(&mut words, distance);
    words
}

/// Exchanges the upper bits, as many as `width`, of the words in each group of `BY` with the lower ones of
/// those in the next group.
#[inline(always)]
fn exchange<const BY: usize>(words: &mut [u64; 8], width: usize) {
    let low = u64::MAX / ((1 << width) + 1);
    for i in 0..4 {
        // The i-th number without the bit `BY`.
        let y = i & (BY - 1) | (i & !(BY - 1)) << 1;
        let differ = (words[y] >> width ^ words[y + BY]) & low;
        words[y] ^= differ << width;
        words[y + BY] ^= differ;
    }
}

impl BitMatrix {
    /// The matrix with rows and columns exchanged, in a frame of blocked bits.
    pub(crate) fn transposed(&self, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        let (width, height) = (self.width(), self.height());
        // 64 columns of the map, as the rows that they become: the squares of 64 rows one after another.
        let mut squares = vec![[0; 64]; height.div_ceil(64) as usize];
        let stop = (interrupt, "exchanging rows and columns of the map");
        Self::from_words_interruptible((height, width), true, stop, |y, x| {
            let (square, row) = (y as usize / 64, x as usize % 64);
            if square == 0 && row == 0 {
                for (square, first) in squares.iter_mut().zip((0..height).step_by(64)) {
                    for (word, y) in square.iter_mut().zip(first..height) {
                        *word = self.row(y as i32).word(x);
                    }
                    transpose(square);
                }
            }
            squares[square][row]
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::Grid;

    /// Sides around the multiples of 64, with a pattern that is its own only under the identity.
    #[test]
    fn columns_are_the_rows_exchanged() {
        for width in [1, 2, 63, 64, 65, 127, 128, 129, 200] {
            for height in [1, 63, 64, 65, 130] {
                let blocked = |x: u32, y: u32| (x * x + 3 * y * x + 7 * y) % 5 < 2;
                let grid = Grid::from_fn(width, height, blocked).expect("a map");
                let (rows, columns) = (grid.rows(), grid.columns());
                assert_eq!((columns.width(), columns.height()), (height, width));
                for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
                    let [row, column] = [rows.get(x as i32, y as i32), columns.get(y as i32, x as i32)];
                    assert_eq!([row, column], [blocked(x, y); 2], "({x}, {y}) of {width} × {height}");
                }
                // All bits of the frame are blocked.
                let free: u64 = columns.words().iter().map(|word| u64::from(word.count_zeros())).sum();
                assert_eq!(free, grid.free_cells(), "{width} × {height}");
            }
        }
    }
}
