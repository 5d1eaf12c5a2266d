//! The map: which cells are blocked.

mod edit;
mod long;

pub(crate) use self::edit::GridEdit;
use crate::{
    BitMatrix, Rectangle, Vertex,
    identity::MapId,
    interrupt::{Interrupt, Interrupted},
};

/// A bit-packed map: which cells are blocked. It keeps a transposed copy, so that runs along a row and along
/// a column are both runs of bits.
///
/// Everything outside the map is blocked. A grid never changes; [`with_rectangle`](Self::with_rectangle)
/// makes another one. It is made of the memory of an earlier version that nobody holds any more, if there is
/// one, by work that follows the edit.
///
/// ```
/// use mediant_grid::Grid;
/// let grid = Grid::from_fn(3, 2, |x, y| (x, y) == (1, 0))?;
/// assert!(grid.is_blocked(1, 0) && grid.is_free(2, 1) && grid.is_blocked(-1, 0));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grid {
    id: MapId,
    rows: BitMatrix,
    columns: BitMatrix,
}

/// Why a grid cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GridError {
    /// A side is 0 or longer than [`Grid::MAX_SIDE`].
    #[error(
        "a map of {width} columns and {height} rows: each side must have 1 to {max} cells",
        max = Grid::MAX_SIDE
    )]
    Size {
        /// The width that was asked for.
        width: u64,
        /// The height that was asked for.
        height: u64,
    },
    /// A side of a [long](Grid::long) map is 0 or longer than [`Grid::MAX_LONG_SIDE`], or it has more cells
    /// than bits have numbers.
    #[error(
        "a map of {width} columns and {height} rows: where cells have costs, each side must have 1 to {max} cells, \
         and both together about 4.2 billion at most, a frame included; cut the map, or take larger cells",
        max = Grid::MAX_LONG_SIDE
    )]
    LongSize {
        /// The width that was asked for.
        width: u64,
        /// The height that was asked for.
        height: u64,
    },
    /// The rows of a map differ in length.
    #[error("row {row} of the map has {found} cells, the first row has {expected}: make all rows as long")]
    Ragged {
        /// The row, from 0.
        row: usize,
        /// Its cells.
        found: usize,
        /// The first row's cells.
        expected: usize,
    },
    /// It was stopped while it was made.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

impl Grid {
    /// The longest side, in cells. Up to here the vertex numbers of both placements and all bit positions fit
    /// in 32 bits, and so does the arithmetic of sight and clearance. (The largest maps need more memory than
    /// a 32-bit target has.) [Long](Self::long) maps, which are for costs of cells, have longer sides.
    pub const MAX_SIDE: u32 = 32_768;

    /// A map of `width` × `height` cells; `blocked(x, y)` is asked once for each, row by row.
    ///
    /// # Errors
    /// [`GridError::Size`] when a side is 0 or exceeds [`MAX_SIDE`](Self::MAX_SIDE); nothing is allocated
    /// then.
    pub fn from_fn(
        width: u32,
        height: u32,
        blocked: impl FnMut(u32, u32) -> bool,
    ) -> Result<Self, GridError> {
        Self::from_fn_interruptible(width, height, &Interrupt::NEVER, blocked)
    }

    /// [`from_fn`](Self::from_fn), which an interrupt can stop; it asks before each row.
    ///
    /// # Errors
    /// As for [`from_fn`](Self::from_fn), and [`GridError::Interrupted`].
    pub fn from_fn_interruptible(
        width: u32,
        height: u32,
        interrupt: &Interrupt,
        blocked: impl FnMut(u32, u32) -> bool,
    ) -> Result<Self, GridError> {
        Self::check_size(u64::from(width), u64::from(height))?;
        Ok(Self::of(BitMatrix::from_bits(width, height, interrupt, blocked)?, interrupt)?)
    }

    /// A map of `width` × `height` cells, 64 at a time: `word(x, y)` returns the cells of row y from column x
    /// on, the first in the lowest bit, 1 = blocked. It is asked once for each row and each 64th column; bits
    /// beyond the last column are ignored.
    ///
    /// ```
    /// use mediant_grid::Grid;
    /// let grid = Grid::from_words(70, 2, |x, y| if (x, y) == (64, 1) { 0b10 } else { 0 })?;
    /// assert!(grid.is_blocked(65, 1) && grid.free_cells() == 139);
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    ///
    /// # Errors
    /// As for [`from_fn`](Self::from_fn).
    pub fn from_words(width: u32, height: u32, word: impl FnMut(u32, u32) -> u64) -> Result<Self, GridError> {
        Self::from_words_interruptible(width, height, &Interrupt::NEVER, word)
    }

    /// [`from_words`](Self::from_words), which an interrupt can stop; it asks before each row.
    ///
    /// # Errors
    /// As for [`from_words`](Self::from_words), and [`GridError::Interrupted`].
    pub fn from_words_interruptible(
        width: u32,
        height: u32,
        interrupt: &Interrupt,
        mut word: impl FnMut(u32, u32) -> u64,
    ) -> Result<Self, GridError> {
        Self::check_size(u64::from(width), u64::from(height))?;
        let (size, stop) = ((width, height), (interrupt, "making the map"));
        let word = |x, y| word(x as u32, y as u32);
        Ok(Self::of(BitMatrix::from_words_interruptible(size, true, stop, word)?, interrupt)?)
    }

    /// The map with these rows, which are of a size that maps have and in a frame of blocked bits.
    pub(crate) fn of(rows: BitMatrix, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        Ok(Self { id: MapId::new(&rows, interrupt)?, columns: rows.transposed(interrupt)?, rows })
    }

    /// A copy of this map with other cells in a rectangle: `blocked(x, y)` is asked once for each cell that
    /// lies both in the rectangle and on the map, row by row.
    ///
    /// ```
    /// use mediant_grid::{Grid, Rectangle};
    /// let closed = Grid::from_fn(3, 3, |x, _| x == 1)?;
    /// let open = closed.with_rectangle(Rectangle { x: 1, y: 2, width: 9, height: 1 }, |_, _| false);
    /// assert!(open.is_free(1, 2) && open.is_blocked(1, 1));
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    #[must_use]
    pub fn with_rectangle(&self, at: Rectangle, mut blocked: impl FnMut(u32, u32) -> bool) -> Self {
        let (mut edit, at) = (self.begin_edit(), self.on_map(at));
        for (x, y) in at.cells() {
            edit.set(x, y, blocked(x, y));
        }
        edit.finish().0
    }

    /// A copy of this map with other scattered cells: of each its column, its row, and whether it is blocked.
    /// The last word on a cell counts. Cells beyond the map are left out.
    ///
    /// ```
    /// use mediant_grid::Grid;
    /// let grid = Grid::from_fn(3, 3, |x, _| x == 1)?.with_cells([(1, 0, false), (0, 2, true), (7, 7, true)]);
    /// assert!(grid.is_free(1, 0) && grid.is_blocked(0, 2));
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    #[must_use]
    pub fn with_cells(&self, cells: impl IntoIterator<Item = (u32, u32, bool)>) -> Self {
        let mut edit = self.begin_edit();
        for (x, y, blocked) in cells {
            if x < self.width() && y < self.height() {
                edit.set(x, y, blocked);
            }
        }
        edit.finish().0
    }

    /// The part of a rectangle that lies on the map.
    pub(crate) fn on_map(&self, Rectangle { x, y, width, height }: Rectangle) -> Rectangle {
        let (x, y) = (x.min(self.width()), y.min(self.height()));
        Rectangle { x, y, width: width.min(self.width() - x), height: height.min(self.height() - y) }
    }

    /// The words of a row that differ from those of a map of the same size: the number of each, from 0, and
    /// its bits that differ.
    fn differing_words(&self, other: &Self, y: u32) -> impl Iterator<Item = (u32, u64)> {
        let words = self.rows.row_words(y).iter().zip(other.rows.row_words(y));
        (0..).zip(words.map(|(one, other)| one ^ other)).filter(|&(_, difference)| difference != 0)
    }

    /// The identity of the map.
    #[must_use]
    #[inline]
    pub const fn id(&self) -> MapId {
        self.id
    }

    /// Checks that a map may have these sides.
    ///
    /// # Errors
    /// [`GridError::Size`] when a side is 0 or exceeds [`MAX_SIDE`](Self::MAX_SIDE).
    pub const fn check_size(width: u64, height: u64) -> Result<(), GridError> {
        let max = Self::MAX_SIDE as u64;
        if width == 0 || height == 0 || width > max || height > max {
            return Err(GridError::Size { width, height });
        }
        Ok(())
    }

    /// The number of columns.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.rows.width()
    }

    /// The number of rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.rows.height()
    }

    /// Whether cell (x, y) is blocked; cells outside the map are.
    #[must_use]
    #[inline]
    pub fn is_blocked(&self, x: i32, y: i32) -> bool {
        self.rows.get(x, y)
    }

    /// Whether cell (x, y) lies on the map and is not blocked.
    #[must_use]
    #[inline]
    pub fn is_free(&self, x: i32, y: i32) -> bool {
        !self.rows.get(x, y)
    }

    /// Whether any cell is free. It is found at the first one.
    #[must_use]
    pub fn has_free_cells(&self) -> bool {
        self.rows.words().iter().any(|word| word.count_zeros() > 0)
    }

    /// The number of free cells.
    #[must_use]
    pub fn free_cells(&self) -> u64 {
        self.rows.words().iter().map(|word| u64::from(word.count_zeros())).sum()
    }

    /// The map by rows: the bit of cell (x, y) at column x, row y.
    #[must_use]
    #[inline]
    pub const fn rows(&self) -> &BitMatrix {
        &self.rows
    }

    /// The map by columns: the bit of cell (x, y) at column y, row x.
    #[must_use]
    #[inline]
    pub const fn columns(&self) -> &BitMatrix {
        &self.columns
    }

    /// Whether corner vertex `at` is a gap: two of its four cells are blocked and meet there diagonally, and
    /// the two others are free. [`DiagonalGap::Closed`](crate::DiagonalGap::Closed) forbids to pass through
    /// gaps.
    #[must_use]
    #[inline]
    pub fn is_gap(&self, at: Vertex) -> bool {
        let blocked = |dx: i32, dy: i32| self.is_blocked(at.x.wrapping_add(dx), at.y.wrapping_add(dy));
        let [nw, ne, sw, se] = [blocked(-1, -1), blocked(0, -1), blocked(-1, 0), blocked(0, 0)];
        nw == se && ne == sw && nw != ne
    }
}
