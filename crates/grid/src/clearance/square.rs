//! The map of a square: which cells are free for an agent of n × n cells.

use super::SizeError;
use crate::{Grid, interrupt::Interrupt};

/// The stage that an interrupted call names.
const DURING: &str = "making the map of a square";

impl Grid {
    /// The map of an agent of n × n cells: a cell is free if it and all others of the square are free of
    /// which it is the *top left* one. The outside counts as blocked, so the square stays on the map. All
    /// engines can search it, and its paths are paths of the square's top left cell.
    ///
    /// # Guarantees
    ///
    /// Let the square move along a path that is legal on this map. It may touch blocked cells, and
    ///
    /// * at centers, over N(2), or over N(3) under [`CornerRule::Never`](crate::CornerRule::Never), it never
    ///   meets the interior of one;
    /// * at centers, over any other k, at any angle, or under another rule, the concentric square of n − 1
    ///   cells never does. So who needs n whole cells there takes n + 1;
    /// * at corners, the square of n − 1 cells whose top left corner is the path's point never does.
    ///
    /// Proof. A point of a path between cells has a free cell at most half a cell away along each axis, in
    /// which the smaller square is contained in that cell's square of n cells; at corners the point lies in a
    /// closed free cell (see [`Clearance`](super::Clearance#guarantees)), up to one cell to the right of and
    /// below its top left corner. In the first case the moving square covers parts of the same cells as the
    /// squares at the two ends of a step along an axis, or at the four corners of a diagonal step, do in
    /// full; all of these cells are free on this map.
    ///
    /// ```
    /// use mediant_grid::{AsciiMap, PlacementKind, draw};
    /// let map = AsciiMap::parse("
    ///     ......
    ///     ..#...
    ///     ......
    /// ")?;
    /// let large = map.grid.for_square(2)?;
    /// assert_eq!(draw(&large, PlacementKind::Center, &[]), ".##..#\n.##..#\n######\n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SizeError::Square`] for n = 0. A square larger than the map has no free cell.
    pub fn for_square(&self, n: u32) -> Result<Self, SizeError> {
        self.for_square_interruptible(n, &Interrupt::NEVER)
    }

    /// [`for_square`](Self::for_square), which an interrupt can stop; it asks each time that it has gone
    /// through the map, in words.
    ///
    /// # Errors
    /// As for [`for_square`](Self::for_square), and [`SizeError::Interrupted`].
    pub fn for_square_interruptible(&self, n: u32, interrupt: &Interrupt) -> Result<Self, SizeError> {
        let (width, height) = (self.width(), self.height());
        if n == 0 {
            return Err(SizeError::Square);
        }
        let words = self.rows().bits_per_row() as usize / 64;
        // Whole rows, each with at least one blocked bit of the frame at its end.
        let mut rows: Vec<u64> = (0..height).flat_map(|y| self.rows().row_words(y)).copied().collect();
        if n > width.min(height) {
            rows.fill(!0);
        } else {
            for by in steps(n) {
                interrupt.check(DURING)?;
                rows.chunks_exact_mut(words).for_each(|row| spread_left(row, by));
            }
            for by in steps(n) {
                interrupt.check(DURING)?;
                spread_up(&mut rows, words * by);
            }
        }
        let stop = (interrupt, DURING);
        let rows = crate::BitMatrix::from_words_interruptible((width, height), true, stop, |x, y| {
            rows[y as usize * words + x as usize / 64]
        })?;
        Ok(Self::of(rows, interrupt)?)
    }
}

/// Distances by which bits are spread one after another, so that each reaches n places in all, its own among
/// them.
fn steps(n: u32) -> impl Iterator<Item = usize> {
    let doubled = std::iter::successors(Some(1), |by| Some(2 * by)).take_while(move |by| 2 * by <= n);
    let reach = 1 << n.ilog2();
    doubled.chain((n > reach).then_some(n - reach)).map(|by| by as usize)
}

/// Blocks each column that is `by` columns before a blocked one.
fn spread_left(row: &mut [u64], by: usize) {
    let (words, bits) = (by / 64, by % 64);
    for at in 0..row.len() {
        let [low, high] = [0, 1].map(|next| row.get(at + words + next).copied().unwrap_or(!0));
        row[at] |= low >> bits | high << 1 << (63 - bits);
    }
}

/// Blocks each word's bits that are blocked `by` words later.
fn spread_up(rows: &mut [u64], by: usize) {
    for at in 0..rows.len() {
        let below = rows.get(at + by).copied().unwrap_or(!0);
        rows[at] |= below;
    }
}
