//! Clearances at centers: how far one can go along a row, column or diagonal before a subgoal or an obstacle.

use mediant_grid::{BitIndex, BitMatrix, Grid, Interrupt, Interrupted, Vertex, load};

use crate::placement::EdgeTables;

/// The stage that an interrupted call names.
const DURING: &str = "finding subgoals";

/// Obstacles and subgoals along each row, column and diagonal, as bits, which stop a walk from a center. The
/// first stop ahead or behind is found a word at a time.
#[derive(Clone, Debug)]
pub struct ClearanceBits {
    /// Blocked cells and subgoals, row by row.
    rows: BitMatrix,
    /// The same with rows and columns exchanged.
    columns: BitMatrix,
    /// The diagonals down to the right, and those up to the right.
    diagonals: [BitMatrix; 2],
}

/// The clearance of a cell along a diagonal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DiagonalClearance {
    /// The number of cells that can be passed before a subgoal or an illegal move.
    pub(crate) free: i32,
    /// Whether the next cell can be reached and is a subgoal.
    pub(crate) meets_subgoal: bool,
}

impl EdgeTables for ClearanceBits {
    fn memory_bytes(&self) -> usize {
        let Self { rows, columns, diagonals: [down, up] } = self;
        [rows, columns, down, up].into_iter().map(|bits| size_of_val(bits.words())).sum()
    }
}

impl ClearanceBits {
    /// The clearance bits of a map with these subgoals.
    pub(crate) fn new(grid: &Grid, subgoals: &BitMatrix, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        let stops = |cells: &BitMatrix, marks: &BitMatrix| {
            let size = (cells.width(), cells.height());
            BitMatrix::from_words_interruptible(size, true, (interrupt, DURING), |x, y| {
                let at = cells.index(x, y);
                load(cells.words(), at) | load(marks.words(), at)
            })
        };
        let (cells, turned) = (grid.rows(), grid.columns());
        Ok(Self {
            rows: stops(cells, subgoals)?,
            columns: stops(turned, &convex_corners(turned, interrupt)?)?,
            diagonals: diagonals(cells, subgoals, interrupt)?,
        })
    }

    /// Blocked cells and subgoals along an axis, and the place of a cell there.
    pub(crate) const fn along(&self, is_row: bool, at: Vertex) -> (&BitMatrix, BitIndex) {
        if is_row {
            (&self.rows, self.rows.index(at.x, at.y))
        } else {
            (&self.columns, self.columns.index(at.y, at.x))
        }
    }

    /// The clearance of a cell along the diagonal `(x, y)`, each of which is ±1.
    pub(crate) fn diagonal(&self, from: Vertex, (x, y): (i32, i32)) -> DiagonalClearance {
        let bits = &self.diagonals[usize::from(x != y)];
        let row = diagonal_row(from, x * y, bits.height());
        let at = bits.index(2 * from.x, row as i32);
        let passed =
            if x > 0 { zeros_after(bits.words(), at.offset(1)) } else { zeros_before(bits.words(), at) };
        DiagonalClearance { free: passed / 2, meets_subgoal: passed % 2 == 1 }
    }
}

/// The number of zeros from `at` on.
#[inline]
pub(crate) fn zeros_after(words: &[u64], mut at: BitIndex) -> i32 {
    let mut passed = 0;
    loop {
        let word = load(words, at);
        if word != 0 {
            return passed + word.trailing_zeros() as i32;
        }
        passed += 64;
        at = at.offset(64);
    }
}

/// The number of zeros before `at`.
#[inline]
pub(crate) fn zeros_before(words: &[u64], mut at: BitIndex) -> i32 {
    let mut passed = 0;
    loop {
        at = at.offset(-64);
        let word = load(words, at);
        if word != 0 {
            return passed + word.leading_zeros() as i32;
        }
        passed += 64;
    }
}

/// The free cells at convex corners of obstacles (Uras, Koenig & Hernández 2013): a diagonal neighbor is
/// blocked, and the two cells beside both are free.
pub(crate) fn convex_corners(cells: &BitMatrix, interrupt: &Interrupt) -> Result<BitMatrix, Interrupted> {
    let size = (cells.width(), cells.height());
    BitMatrix::from_words_interruptible(size, false, (interrupt, DURING), |x, y| {
        let word = |dx, dy| load(cells.words(), cells.index(x + dx, y + dy));
        let [up, down, left, right] = [word(0, -1), word(0, 1), word(-1, 0), word(1, 0)];
        let corner = |beside: u64, above: u64, diagonal: u64| diagonal & !beside & !above;
        !word(0, 0)
            & (corner(left, up, word(-1, -1))
                | corner(right, up, word(1, -1))
                | corner(left, down, word(-1, 1))
                | corner(right, down, word(1, 1)))
    })
}

/// The row in which a cell's diagonal is stored. Two diagonals that together are as long as the map is high
/// share a row. They meet at the edge of the map, where no move is legal.
const fn diagonal_row(at: Vertex, slope: i32, height: u32) -> u32 {
    (at.y - slope * at.x).rem_euclid(height as i32) as u32
}

/// The diagonals down and up to the right. Each cell has two bits in its diagonal's row: whether it is a
/// subgoal, and whether the move to the next cell on the right is illegal.
fn diagonals(
    cells: &BitMatrix,
    marks: &BitMatrix,
    interrupt: &Interrupt,
) -> Result<[BitMatrix; 2], Interrupted> {
    let (width, height) = (cells.width(), cells.height());
    // One of the four cells at its lower right corner is blocked.
    let stop = (interrupt, DURING);
    let illegal = BitMatrix::from_words_interruptible((width, height), true, stop, |x, y| {
        let word = |dx, dy| load(cells.words(), cells.index(x + dx, y + dy));
        word(0, 0) | word(1, 0) | word(0, 1) | word(1, 1)
    })?;
    let diagonal = |slope: i32| {
        let above = i32::from(slope < 0);
        BitMatrix::from_words_interruptible((2 * width, height), true, stop, |column, row| {
            let first = column / 2;
            let cells = (first..(first + 32).min(width as i32))
                .map(|x| (x, (row + slope * x).rem_euclid(height as i32)));
            cells.fold(0, |bits, (x, y)| {
                let pair = u64::from(marks.get(x, y)) | u64::from(illegal.get(x, y - above)) << 1;
                bits | pair << (2 * (x - first))
            })
        })
    };
    Ok([diagonal(1)?, diagonal(-1)?])
}
