//! Small sets of cells around a vertex.

use mediant_grid::CellOffset;

/// A set of cells with offsets from −32 to 31, enough for all that two moves of N(8) can reach: a bit a cell,
/// a word a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Cells([u64; 64]);

impl Default for Cells {
    fn default() -> Self {
        Self([0; 64])
    }
}

impl Cells {
    /// The number of rows, and of cells in a row.
    pub(crate) const SIDE: usize = 64;
    /// The row and the bit of the vertex's own cell.
    pub(crate) const HALF: i32 = 32;

    /// The number of the first row that is not empty, and the rows from there to the last such row.
    pub(crate) fn rows(&self) -> (usize, &[u64]) {
        let first = self.0.iter().position(|&row| row != 0).unwrap_or(0);
        let end = self.0.iter().rposition(|&row| row != 0).map_or(first, |last| last + 1);
        (first, &self.0[first..end])
    }

    pub(crate) fn contains(&self, (x, y): CellOffset) -> bool {
        self.0[(y + Self::HALF) as usize] >> (x + Self::HALF) & 1 == 1
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.iter().all(|&row| row == 0)
    }

    pub(crate) fn count(&self) -> u32 {
        self.0.iter().map(|row| row.count_ones()).sum()
    }

    fn combine(&self, other: &Self, word: impl Fn(u64, u64) -> u64) -> Self {
        Self(std::array::from_fn(|row| word(self.0[row], other.0[row])))
    }

    pub(crate) fn with(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a | b)
    }

    pub(crate) fn common(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a & b)
    }

    pub(crate) fn without(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a & !b)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = CellOffset> {
        let rows = self.0.iter().zip(-Self::HALF..).filter(|&(&row, _)| row != 0);
        rows.flat_map(|(&row, y)| {
            let next = |&rest: &u64| Some(rest & (rest - 1)).filter(|&rest| rest != 0);
            let bits = std::iter::successors(Some(row), next);
            bits.map(move |rest| (rest.trailing_zeros() as i32 - Self::HALF, y))
        })
    }
}

impl Extend<CellOffset> for Cells {
    fn extend<T: IntoIterator<Item = CellOffset>>(&mut self, cells: T) {
        for (x, y) in cells {
            self.0[(y + Self::HALF) as usize] |= 1 << (x + Self::HALF);
        }
    }
}

impl FromIterator<CellOffset> for Cells {
    fn from_iter<T: IntoIterator<Item = CellOffset>>(cells: T) -> Self {
        let mut set = Self::default();
        set.extend(cells);
        set
    }
}
