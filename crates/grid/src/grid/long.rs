//! Maps with longer sides than engines take, for costs of cells.

use super::{Grid, GridError};
use crate::{BitMatrix, interrupt::Interrupt};

impl Grid {
    /// The longest side of a [long](Self::long) map, in cells.
    pub const MAX_LONG_SIDE: u32 = 1 << 20;

    /// [`from_fn_interruptible`](Self::from_fn_interruptible) for a map whose cells have costs: its sides may
    /// have up to [`MAX_LONG_SIDE`](Self::MAX_LONG_SIDE) cells, as long as all bits have numbers of 32 bits.
    ///
    /// If a side is longer than [`MAX_SIDE`](Self::MAX_SIDE), the map is for a
    /// [`FreeSpace`](crate::FreeSpace) alone: vertices, components, gaps, [`line_of_sight`] and edits are
    /// exact on it. Engines without costs, [`VisibilitySweep`] and [`Clearance`](crate::Clearance) count in
    /// 32 bits, and must not be given it: ask [`is_long`](Self::is_long).
    ///
    /// ```
    /// use mediant_grid::{Grid, Interrupt};
    ///
    /// let strip = Grid::long(100_000, 3, &Interrupt::NEVER, |x, y| (x, y) == (99_999, 2))?;
    /// assert!(strip.is_long() && strip.is_blocked(99_999, 2) && strip.is_free(99_998, 2));
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    ///
    /// # Errors
    /// [`GridError::LongSize`], before anything is allocated; [`GridError::Interrupted`].
    ///
    /// [`line_of_sight`]: crate::sight::line_of_sight
    /// [`VisibilitySweep`]: crate::sight::VisibilitySweep
    pub fn long(
        width: u32,
        height: u32,
        interrupt: &Interrupt,
        blocked: impl FnMut(u32, u32) -> bool,
    ) -> Result<Self, GridError> {
        Self::check_long_size(u64::from(width), u64::from(height))?;
        Ok(Self::of(BitMatrix::from_bits(width, height, interrupt, blocked)?, interrupt)?)
    }

    /// Checks that a [long](Self::long) map may have these sides.
    ///
    /// # Errors
    /// [`GridError::LongSize`] if not.
    pub const fn check_long_size(width: u64, height: u64) -> Result<(), GridError> {
        let max = Self::MAX_LONG_SIDE as u64;
        let is_side = width > 0 && height > 0 && width <= max && height <= max;
        // The rows, the columns, and the corners, which closed gaps are bits of.
        if is_side && bits(width, height) <= MAX && bits(height, width) <= MAX {
            let (width, height) = (width + 1, height + 1);
            if bits(width, height) <= MAX && width * height <= MAX {
                return Ok(());
            }
        }
        Err(GridError::LongSize { width, height })
    }

    /// Whether a side is longer than [`MAX_SIDE`](Self::MAX_SIDE): whether it is for costs of cells alone.
    #[must_use]
    pub const fn is_long(&self) -> bool {
        self.width() > Self::MAX_SIDE || self.height() > Self::MAX_SIDE
    }
}

/// The most bits of a matrix. Some numbers are left, so that reads just before the first bit, which wrap, are
/// reads beyond the last one.
const MAX: u64 = (1 << 32) - (1 << 12);

/// The bits of a matrix, frame included: see [`BitMatrix`].
const fn bits(width: u64, height: u64) -> u64 {
    (width / 64 + 1) * 64 * (height + 2) + 128
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_whose_bits_have_no_numbers_are_refused() {
        for (width, height) in
            [(1 << 20, 1), (1, 1 << 20), (65_280, 65_536), (1 << 20, 4000), (4000, 1 << 20)]
        {
            assert!(Grid::check_long_size(width, height).is_ok(), "{width} × {height}");
        }
        let max = u64::MAX;
        for (width, height) in [
            (0, 9),
            (9, 0),
            ((1 << 20) + 1, 1),
            (1, (1 << 20) + 1),
            (65_536, 65_536),
            (1 << 20, 4096),
            (max, max),
        ] {
            let error = GridError::LongSize { width, height };
            assert_eq!(Grid::check_long_size(width, height), Err(error), "{width} × {height}");
        }
    }

    /// The bits that are counted are those of the matrix.
    #[test]
    fn bits_are_counted_as_they_are_laid_out() {
        for (width, height) in [(1, 1), (63, 5), (64, 7), (65, 64), (40_000, 3)] {
            let grid = Grid::long(width, height, &Interrupt::NEVER, |_, _| false).expect("a small map");
            let found = [grid.rows(), grid.columns()].map(|matrix| matrix.words().len() as u64 * 64);
            let (width, height) = (width.into(), height.into());
            assert_eq!(found, [bits(width, height), bits(height, width)]);
        }
    }
}
