//! Rows and columns of bits exchanged, 64 × 64 at a time.

use crate::{
    BitMatrix,
    interrupt::{Interrupt, Interrupted},
};

/// Exchanges rows and columns: bit x of word y becomes bit y of word x.
///
/// Halves, quarters, … of the square are exchanged across its diagonal.
#[doc(hidden)]
pub const fn transpose(square: &mut [u64; 64]) {
    let (mut width, mut low) = (32, u32::MAX as u64);
    while width > 0 {
        let mut y = 0;
        while y < 64 {
            let other = y + width;
            let differ = (square[y] >> width ^ square[other]) & low;
            square[y] ^= differ << width;
            square[other] ^= differ;
            // The next y without the bit `width`.
            y = (other + 1) & !width;
        }
        width /= 2;
        low ^= low << width;
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
