//! Bit-packed matrices inside a frame, read a word at a time.
//!
//! A matrix keeps its bits as `u64` words on every target, because all its readers take 64 cells at once. The
//! `bitvec` crate collects each row of a map bit by bit, in words of `usize`, from which the row is copied: a
//! `BitVec<u64>` exists on 64-bit targets only.

mod edit;
mod make;

use std::fmt;

pub use self::edit::MatrixEdit;
use crate::versions::Versioned;

/// The position of a bit in a [`BitMatrix`], frame included. Not a cell id: rows are padded to whole words.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BitIndex(pub u32);

impl BitIndex {
    /// The bit `offset` positions further on. Wraps where that would leave the matrix; a read there reports
    /// 'blocked'.
    #[must_use]
    #[inline]
    pub const fn offset(self, offset: i32) -> Self {
        Self(self.0.wrapping_add_signed(offset))
    }
}

/// Rows of bits in 64-bit words, 1 = blocked (or marked), inside a frame that makes reading beyond an edge
/// safe without a test.
///
/// The frame of a map is blocked, that of a set of vertices is empty. Each row is followed by at least one
/// bit of the frame, which is also the bit before the next row. One row of the frame lies above the first row
/// and one below the last, and one word before and one after all rows.
#[derive(PartialEq, Eq)]
pub struct BitMatrix {
    words: Versioned<u64>,
    width: u32,
    height: u32,
    words_per_row: u32,
}

impl Clone for BitMatrix {
    fn clone(&self) -> Self {
        Self { words: self.words.clone(), ..*self }
    }

    /// The same in the memory of this one, if it has the same size.
    fn clone_from(&mut self, other: &Self) {
        let Self { words, width, height, words_per_row } = self;
        words.clone_from(&other.words);
        (*width, *height, *words_per_row) = (other.width, other.height, other.words_per_row);
    }
}

/// Shows the sides alone: the bits of a map would fill pages.
impl fmt::Debug for BitMatrix {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "BitMatrix({} × {})", self.width, self.height)
    }
}

impl BitMatrix {
    /// A matrix whose bits, frame included, all have this value.
    fn filled(width: u32, height: u32, value: bool) -> Self {
        let (words, word) = (Self::words_of(width, height), if value { !0 } else { 0 });
        Self { words: vec![word; words].into(), width, height, words_per_row: width / 64 + 1 }
    }

    /// The number of words of a matrix with these sides.
    const fn words_of(width: u32, height: u32) -> usize {
        (height as usize + 2) * (width as usize / 64 + 1) + 2
    }

    /// The number of columns.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The distance between the bits of two vertical neighbors.
    #[doc(hidden)]
    #[must_use]
    pub const fn bits_per_row(&self) -> i32 {
        self.words_per_row as i32 * 64
    }

    /// All words, frame included.
    #[doc(hidden)]
    #[must_use]
    #[inline]
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// The position of column x, row y, for −1 ≤ y ≤ height and −64 ≤ x ≤
    /// [`bits_per_row`](Self::bits_per_row).
    #[doc(hidden)]
    #[must_use]
    #[inline]
    pub const fn index(&self, x: i32, y: i32) -> BitIndex {
        // In 64 bits: the last bit of the largest matrix may be beyond 2³¹.
        BitIndex((64 + (y as i64 + 1) * self.bits_per_row() as i64 + x as i64) as u32)
    }

    /// Row y, for −1 ≤ y ≤ height. Other rows hold no meaningful bits.
    #[must_use]
    #[inline]
    pub fn row(&self, y: i32) -> BitRow<'_> {
        BitRow { words: self.words(), origin: self.index(0, y), bits_per_row: self.bits_per_row() }
    }

    /// The words of a row, with the part of the frame that follows it.
    pub(crate) fn row_words(&self, y: u32) -> &[u64] {
        let start = self.index(0, y as i32).0 as usize / 64;
        &self.words[start..start + self.words_per_row as usize]
    }

    /// Sets the bits of row y from column `first` on, up to column `end`, which is not one of them. All must
    /// lie within the frame.
    ///
    /// Hidden: what reads a matrix may rely on more of its bits than these.
    #[doc(hidden)]
    pub fn set_run(&mut self, y: i32, first: i32, end: i32, blocked: bool) {
        let (run, words) = (self.run(y, first, end), self.words.make_mut());
        run.for_each(|word, bits| set_word(words, word, bits, blocked));
    }

    /// Sets the bits of column x from row `first` on, up to row `end`, which is not one of them. All must lie
    /// within the frame.
    ///
    /// Hidden, as [`set_run`](Self::set_run) is.
    #[doc(hidden)]
    pub fn set_run_of_column(&mut self, x: i32, first: i32, end: i32, blocked: bool) {
        let (run, words) = (self.run_of_column(x, first, end), self.words.make_mut());
        run.for_each(|word, bits| set_word(words, word, bits, blocked));
    }

    /// [`set_run`](Self::set_run) (or, along a column, [`set_run_of_column`](Self::set_run_of_column)) in a
    /// matrix whose union with `other` is kept in `union`. All have the same size.
    ///
    /// Hidden, as these are.
    #[doc(hidden)]
    pub fn set_run_in_union(
        &mut self,
        (other, union): (&Self, &mut Self),
        (is_vertical, line): (bool, i32),
        (first, end): (i32, i32),
        blocked: bool,
    ) {
        let run = if is_vertical { self.run_of_column(line, first, end) } else { self.run(line, first, end) };
        let words = self.words.make_mut();
        let (other, union) = (&other.words[..words.len()], &mut union.words.make_mut()[..words.len()]);
        if blocked {
            run.for_each(|word, bits| {
                words[word] |= bits;
                union[word] |= bits;
            });
        } else {
            run.for_each(|word, bits| {
                words[word] &= !bits;
                union[word] &= !bits | other[word];
            });
        }
    }

    const fn run(&self, y: i32, first: i32, end: i32) -> BitRun {
        BitRun { from: self.index(first, y).0 as usize, to: self.index(end, y).0 as usize, step: 0 }
    }

    const fn run_of_column(&self, x: i32, first: i32, end: i32) -> BitRun {
        let step = self.words_per_row as usize;
        BitRun { from: self.index(x, first).0 as usize, to: self.index(x, end).0 as usize, step }
    }

    /// The bit of column x, row y; true everywhere beyond the edges.
    #[must_use]
    #[inline]
    pub fn get(&self, x: i32, y: i32) -> bool {
        let inside = (x as u32) < self.width && (y as u32) < self.height;
        !inside || load(self.words(), self.index(x, y)) & 1 == 1
    }

    /// Whether any bit of row y from column `first` to column `last` is blocked. All must lie within the
    /// frame or on it.
    #[must_use]
    #[inline]
    pub(crate) fn any(&self, y: i32, first: i32, last: i32) -> bool {
        self.any_of(first, last, |x| load(self.words(), self.index(x, y)))
    }

    /// Whether in some column from `first` to `last` both row y − 1 and row y are blocked.
    #[must_use]
    pub(crate) fn any_edge(&self, y: i32, first: i32, last: i32) -> bool {
        let words = self.words();
        self.any_of(first, last, |x| load(words, self.index(x, y - 1)) & load(words, self.index(x, y)))
    }

    /// Whether there is a gap at one of the corner vertices from `first` to `last` above row y: two blocked
    /// bits meet there diagonally, and the two others are free.
    #[must_use]
    pub(crate) fn any_gap(&self, y: i32, first: i32, last: i32) -> bool {
        self.any_of(first, last, |x| self.gaps(x, y))
    }

    /// The [gaps](Self::any_gap) among the 64 corner vertices above row y from column x on.
    #[must_use]
    pub(crate) fn gaps(&self, x: i32, y: i32) -> u64 {
        let [nw, ne, sw, se] = [(-1, -1), (0, -1), (-1, 0), (0, 0)]
            .map(|(dx, dy)| load(self.words(), self.index(x + dx, y + dy)));
        (nw ^ ne) & !(nw ^ se) & !(ne ^ sw)
    }

    #[inline]
    fn any_of(&self, first: i32, last: i32, word: impl Fn(i32) -> u64) -> bool {
        let mut x = first;
        while last - x >= 64 {
            if word(x) != 0 {
                return true;
            }
            x += 64;
        }
        let keep = !0_u64 >> (63 - (last - x).clamp(0, 63));
        last >= x && word(x) & keep != 0
    }
}

#[inline]
fn set_word(words: &mut [u64], word: usize, bits: u64, blocked: bool) {
    let word = &mut words[word];
    *word = if blocked { *word | bits } else { *word & !bits };
}

/// Bits of a row or of a column.
struct BitRun {
    /// The first bit, and the one after the last.
    from: usize,
    to: usize,
    /// The words between bits of a column; 0 for a row.
    step: usize,
}

impl BitRun {
    /// Calls `visit` with the words and a mask of the bits in each.
    #[inline(always)]
    fn for_each(self, mut visit: impl FnMut(usize, u64)) {
        let Self { from, to, step } = self;
        if step != 0 {
            let bit = 1 << (from % 64);
            let mut word = from / 64;
            while word < to / 64 {
                visit(word, bit);
                word += step;
            }
            return;
        }
        let mut at = from;
        while at < to {
            let next = to.min((at | 63) + 1);
            visit(at / 64, !0_u64 >> (64 - (next - at)) << (at % 64));
            at = next;
        }
    }
}

/// A row of a [`BitMatrix`], scanned for runs of bits 64 at a time.
///
/// Columns count from 0 and may lie on the frame, from −64 on. In a matrix with a blocked frame, a scan for
/// blocked columns ends at the frame at the latest; bounds beyond it are only useful there.
///
/// ```
/// use mediant_grid::Grid;
/// let grid = Grid::from_fn(9, 1, |x, _| x == 5)?;
/// let row = grid.rows().row(0);
/// assert_eq!(row.first_blocked(0, 9), 5);
/// assert_eq!(row.first_free(5, 9), 6);
/// assert_eq!(row.run_start(9, 0), 6);
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct BitRow<'m> {
    words: &'m [u64],
    /// Column 0.
    origin: BitIndex,
    bits_per_row: i32,
}

impl BitRow<'_> {
    /// The row `down` rows further down, or up if `down` is negative; within the frame or on it.
    #[must_use]
    #[inline]
    pub const fn below(self, down: i32) -> Self {
        Self { origin: self.origin.offset(self.bits_per_row.wrapping_mul(down)), ..self }
    }

    /// The 64 bits from column `first` on, lowest first, for −64 ≤ `first`.
    #[must_use]
    #[inline]
    pub fn word(self, first: i32) -> u64 {
        load(self.words, self.origin.offset(first))
    }

    /// Whether a column is blocked.
    #[must_use]
    #[inline]
    pub fn is_blocked(self, column: i32) -> bool {
        let BitIndex(at) = self.origin.offset(column);
        self.words.get(at as usize / 64).is_none_or(|word| word >> (at % 64) & 1 == 1)
    }

    /// The first blocked column from `from` on; `to` if there is none before `to`.
    #[must_use]
    #[inline]
    pub fn first_blocked(self, from: i32, to: i32) -> i32 {
        self.first_of(from, to, |word| word)
    }

    /// The first free column from `from` on; `to` if there is none before `to`. `to` must not lie beyond the
    /// frame.
    #[must_use]
    #[inline]
    pub fn first_free(self, from: i32, to: i32) -> i32 {
        self.first_of(from, to, |word| !word)
    }

    #[inline]
    fn first_of(self, mut from: i32, to: i32, wanted: impl Fn(u64) -> u64) -> i32 {
        while from < to {
            let found = wanted(self.word(from));
            if found != 0 {
                return to.min(from + found.trailing_zeros() as i32);
            }
            from += 64;
        }
        to
    }

    /// Whether the columns from `first` to `last` are free, but for the first one if bit 0 of `walls` is set,
    /// and for the last one if bit 63 is: those must be blocked then. `first` < `last`.
    #[must_use]
    #[inline]
    pub fn is_run(self, first: i32, last: i32, walls: u64) -> bool {
        let beyond = 63 - (last - first);
        let bits = self.word(first) ^ walls & 1;
        if beyond >= 0 {
            (bits << beyond) == walls & 1 << 63
        } else {
            bits == 0 && self.is_long_run(first + 64, last, walls)
        }
    }

    /// The rest of [`is_run`](Self::is_run).
    fn is_long_run(self, mut first: i32, last: i32, walls: u64) -> bool {
        loop {
            let beyond = 63 - (last - first);
            let bits = self.word(first);
            if beyond >= 0 {
                return (bits << beyond) == walls & 1 << 63;
            }
            if bits != 0 {
                return false;
            }
            first += 64;
        }
    }

    /// The first column of the run of free columns that ends just before column `end`, but no column before
    /// `to`. If column `end` − 1 is blocked, `end` itself.
    #[must_use]
    #[inline]
    pub fn run_start(self, end: i32, to: i32) -> i32 {
        self.start_of(end, to, |word| word)
    }

    /// The column where the blocked columns before `end` begin, at the earliest `to`; `end` if there are
    /// none.
    #[must_use]
    #[inline]
    pub fn blocked_start(self, end: i32, to: i32) -> i32 {
        self.start_of(end, to, |word| !word)
    }

    #[inline]
    fn start_of(self, mut end: i32, to: i32, before: impl Fn(u64) -> u64) -> i32 {
        while end > to {
            let found = before(self.word(end - 64));
            if found != 0 {
                return to.max(end - found.leading_zeros() as i32);
            }
            end -= 64;
        }
        to
    }
}

/// The 64 bits from `at` on, lowest first; all blocked if they are not all within the matrix.
#[doc(hidden)]
#[must_use]
#[inline]
pub fn load(words: &[u64], at: BitIndex) -> u64 {
    let (word, shift) = ((at.0 >> 6) as usize, at.0 & 63);
    match words.get(word..word + 2) {
        // The two-step shift keeps a shift of 64 out of the case shift = 0.
        Some(&[low, high]) => low >> shift | high << 1 << (63 - shift),
        _ => !0,
    }
}

#[cfg(test)]
mod tests {
    use crate::Grid;

    /// Scans a row with two blocked columns between all pairs of columns.
    #[test]
    fn scans_stop_at_the_first_and_at_the_bounds() {
        for (a, b) in [(0, 199), (63, 64), (5, 128), (127, 190), (64, 66)] {
            let grid = Grid::from_fn(200, 3, |x, y| y == 1 && (x as i32 == a || x as i32 == b));
            let grid = grid.expect("a valid size");
            let row = grid.rows().row(0).below(1);
            let blocked = |x: i32| !(0..200).contains(&x) || x == a || x == b;
            for from in 0..=200 {
                assert_eq!(row.is_blocked(from), blocked(from));
                for to in (from..=200).step_by(7) {
                    let first = |free: bool| (from..to).find(|&x| blocked(x) != free).unwrap_or(to);
                    assert_eq!(row.first_blocked(from, to), first(false), "{a}, {b}: {from} to {to}");
                    assert_eq!(row.first_free(from, to), first(true), "{a}, {b}: {from} to {to}");
                    let start = (from..to).rev().find(|&x| blocked(x)).map_or(from, |x| x + 1);
                    assert_eq!(row.run_start(to, from), start, "{a}, {b}: {from} to {to}");
                    // One bit each for a wall at the first and at the last column.
                    for ends in (0..4_u64).filter(|_| from < to) {
                        let walls = ends & 1 | ends >> 1 << 63;
                        let is_wall = |x| x == from && ends & 1 == 1 || x == to && ends & 2 == 2;
                        let expected = (from..=to).all(|x| blocked(x) == is_wall(x));
                        assert_eq!(row.is_run(from, to, walls), expected, "{a}, {b}: {from} to {to}, {ends}");
                    }
                }
            }
        }
    }

    /// Runs of many lengths at many offsets within a word, with one blocked cell just inside or just outside.
    #[test]
    fn runs_are_tested_to_their_ends_and_no_further() {
        for blocked in (0..260).step_by(13) {
            let grid = Grid::from_fn(260, 2, |x, _| x == blocked).unwrap();
            let free = Grid::from_fn(260, 2, |x, y| x == blocked && y == 0).unwrap();
            let corner = Grid::from_fn(260, 2, |x, y| x + y == blocked).unwrap();
            let at = blocked as i32;
            for first in [at - 129, at - 128, at - 65, at - 64, at - 63, at - 1, at, at + 1] {
                for last in
                    [first, first + 1, at - 1, at, at + 1, at + 62, at + 63, at + 64, at + 65, at + 128]
                {
                    let run = first.max(1)..=last.min(258);
                    if run.is_empty() {
                        continue;
                    }
                    let (first, last) = (*run.start(), *run.end());
                    assert_eq!(grid.rows().any(1, first, last), run.contains(&at), "{at} in {run:?}");
                    assert_eq!(grid.rows().any_edge(1, first, last), run.contains(&at), "{at} in {run:?}");
                    assert!(!free.rows().any_edge(1, first, last), "{at} in {run:?}");
                    assert_eq!(corner.rows().any_gap(1, first, last), run.contains(&at), "{at} in {run:?}");
                }
            }
        }
    }
}
