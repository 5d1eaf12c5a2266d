//! Patches: the pieces of which maps that change are made.

use std::sync::Arc;

use mediant_grid::{Interrupt, Rectangle};

use super::error::PatchError;
use crate::{
    map::{
        Tiles,
        parse::{sides, take_rows},
    },
    text::{Line, Lines, quote_line, words},
};

/// A rectangle of free and blocked cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Patch {
    width: u32,
    /// A byte a cell, as in its file, row by row.
    blocked: Vec<bool>,
}

/// A patch at its place on a map.
///
/// ```
/// use std::sync::Arc;
/// use mediant_formats::{Patch, PlacedPatch};
/// use mediant_grid::{Change, Grid};
///
/// let patch = Arc::new(Patch::new(2, [true, false]));
/// let placed = PlacedPatch { patch, x: 3, y: 1 };
/// let grid = Arc::new(Grid::from_fn(9, 9, |_, _| false)?);
/// let change = Change::new(grid).edit(placed.rectangle(), |x, y| placed.is_blocked(x, y));
/// assert!(change.after().is_blocked(3, 1) && change.after().is_free(4, 1));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlacedPatch {
    /// The patch, which all its places share.
    pub patch: Arc<Patch>,
    /// The column of its first cell.
    pub x: u32,
    /// The row of its first cell.
    pub y: u32,
}

impl Patch {
    /// The patch of these cells, row by row from the top, each true if it is blocked. Cells of a last row
    /// that is not full are left out, and a width of 0 counts as 1.
    #[must_use]
    pub fn new(width: u32, blocked: impl IntoIterator<Item = bool>) -> Self {
        let width = width.max(1);
        let mut blocked: Vec<bool> = blocked.into_iter().collect();
        blocked.truncate(blocked.len() - blocked.len() % width as usize);
        Self { width, blocked }
    }

    /// The number of columns.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        (self.blocked.len() / self.width as usize) as u32
    }

    /// The rows from top to bottom; of each cell whether it is blocked.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[bool]> {
        self.blocked.chunks_exact(self.width as usize)
    }

    /// Parses a file of patches: `type patch`, `patches N`, and for each `patch I`, `height N`, `width N`,
    /// `map` and the rows, whose characters are those of maps ([`Tiles::default`]).
    ///
    /// ```
    /// use mediant_formats::Patch;
    /// let patches = Patch::parse_all(b"type patch\npatches 1\npatch 0\nheight 1\nwidth 2\nmap\n@.\n")?;
    /// assert_eq!(*patches[0], Patch::new(2, [true, false]));
    /// # Ok::<(), mediant_formats::PatchError>(())
    /// ```
    ///
    /// # Errors
    /// [`PatchError`] says what is wrong and where.
    pub fn parse_all(text: &[u8]) -> Result<Vec<Arc<Self>>, PatchError> {
        let mut lines = Lines::new(text);
        header(&mut lines, "type patch")?;
        let (tiles, count) = (Tiles::default(), header_count(&mut lines)?);
        let table = tiles.table().map(|is_free| is_free == Some(false));
        let mut patches = Vec::new();
        while patches.len() < count {
            header(&mut lines, &format!("patch {}", patches.len()))?;
            let (width, height) = sides(&mut lines)?;
            let rows = take_rows(&mut lines, (width, height), &tiles, &Interrupt::NEVER)?;
            let tiles = rows.iter().flat_map(|&start| &text[start..start + width as usize]);
            patches.push(Arc::new(Self::new(width, tiles.map(|&tile| table[usize::from(tile)]))));
        }
        match filled(&mut lines) {
            None => Ok(patches),
            line => Err(wrong(&lines, line, format!("the end of the file after {count} patches"))),
        }
    }
}

impl PlacedPatch {
    /// Its cells on the map.
    #[must_use]
    pub fn rectangle(&self) -> Rectangle {
        Rectangle::new(self.x, self.y, self.patch.width(), self.patch.height())
    }

    /// Whether a cell of [its rectangle](Self::rectangle) is blocked, by the map's column and row; false
    /// elsewhere.
    #[must_use]
    pub fn is_blocked(&self, x: u32, y: u32) -> bool {
        self.cell(x, y) == Some(true)
    }

    /// Whether a cell is blocked, by the map's column and row; `None` for one that is not in the patch.
    #[must_use]
    pub fn cell(&self, x: u32, y: u32) -> Option<bool> {
        let (column, row) = (x.checked_sub(self.x)?, y.checked_sub(self.y)?);
        let Patch { width, blocked } = &*self.patch;
        let at = u64::from(row) * u64::from(*width) + u64::from(column);
        blocked.get(usize::try_from(at).ok()?).copied().filter(|_| column < *width)
    }
}

/// Takes a line of exactly these words.
fn header(lines: &mut Lines<'_>, expected: &str) -> Result<(), PatchError> {
    let line = filled(lines);
    let found = words(line.map_or(b"", |line| line.text)).map(|(_, word)| word);
    if found.eq(expected.split(' ').map(str::as_bytes)) {
        return Ok(());
    }
    Err(wrong(lines, line, format!("`{expected}`")))
}

/// Takes the line with the number of patches.
fn header_count(lines: &mut Lines<'_>) -> Result<usize, PatchError> {
    let line = filled(lines);
    let mut words = words(line.map_or(b"", |line| line.text)).map(|(_, word)| word);
    let number = |word: &[u8]| std::str::from_utf8(word).ok()?.parse().ok();
    match (words.next(), words.next().and_then(number), words.next()) {
        (Some(b"patches"), Some(count), None) => Ok(count),
        _ => Err(wrong(lines, line, "`patches N`".to_owned())),
    }
}

/// The next line that is not empty.
fn filled<'a>(lines: &mut Lines<'a>) -> Option<Line<'a>> {
    lines.find(|line| !line.is_blank())
}

fn wrong(lines: &Lines<'_>, line: Option<Line<'_>>, expected: String) -> PatchError {
    let number = line.map_or(lines.number() + 1, |line| line.number);
    PatchError::Line { line: number, expected, found: quote_line(line) }
}
