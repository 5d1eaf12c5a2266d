//! Why a text is not a map.

use mediant_grid::{Grid, Interrupted};

use super::Tiles;

/// A text that is not a MovingAI map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// The file is empty.
    #[error(
        "line 1, column 1: expected a MovingAI map, found an empty file; is this the file that you meant?"
    )]
    Empty,
    /// A line of the header is missing, or something else stands in its place.
    #[error("line {line}, column 1: expected {expected}, found {found}; {HEADER_FORM}")]
    Header {
        /// The line, from 1.
        line: usize,
        /// The lines that the header could have there.
        expected: &'static str,
        /// The text found there.
        found: String,
    },
    /// The height or the width is no number, zero, or too large.
    #[error(
        "line {line}, column {column}: expected a {side} of 1 to {max} cells, found {found}; \
         write the number of {counts} that follow, or split the map",
        max = Grid::MAX_SIDE,
        counts = if *side == "height" { "rows" } else { "characters in the rows" }
    )]
    Side {
        /// The line, from 1.
        line: usize,
        /// The column, in bytes from 1.
        column: usize,
        /// `height` or `width`.
        side: &'static str,
        /// The text found there.
        found: String,
    },
    /// A row has fewer cells than the width.
    #[error(
        "line {line}, column {column}: expected a row of {expected} cells, found the end of the line after \
         {found}; complete the row or mend the width in the header"
    )]
    ShortRow {
        /// The line, from 1.
        line: usize,
        /// The first column that is missing, in bytes from 1.
        column: usize,
        /// The width.
        expected: u32,
        /// The number of cells in the row.
        found: usize,
    },
    /// A row has more cells than the width.
    #[error(
        "line {line}, column {column}: expected the end of a row of {expected} cells, found {found} more \
         bytes; shorten the row or mend the width in the header"
    )]
    LongRow {
        /// The line, from 1.
        line: usize,
        /// The first column beyond the width, in bytes from 1.
        column: usize,
        /// The width.
        expected: u32,
        /// The number of bytes beyond it.
        found: usize,
    },
    /// A row has a byte that is no tile.
    #[error(
        "line {line}, column {column}: expected a tile, found {found}; \
         a tile is a printable ASCII character such as `.` (free) or `@` (blocked)"
    )]
    Tile {
        /// The line, from 1.
        line: usize,
        /// The column, in bytes from 1.
        column: usize,
        /// The byte, quoted.
        found: String,
    },
    /// A row has a character of which nobody said whether it is free.
    #[error(
        "line {line}, column {column}: expected a tile, {tiles}, found {found}; \
         say which characters are free or blocked, by `free` or `blocked`"
    )]
    Unknown {
        /// The line, from 1.
        line: usize,
        /// The column, in bytes from 1.
        column: usize,
        /// The character, quoted.
        found: String,
        /// The known characters.
        tiles: Tiles,
    },
    /// The file ends before the last row.
    #[error(
        "line {line}, column 1: expected row {row} of {height}, found the end of the file; \
         is the file cut short, or the height in the header too large?"
    )]
    FewRows {
        /// The line at which the missing row should be, from 1.
        line: usize,
        /// The first missing row, from 1.
        row: usize,
        /// The height.
        height: u32,
    },
    /// The file has text after the last row.
    #[error(
        "line {line}, column 1: expected the end of the file after {height} rows, found {found}; \
         remove what follows or mend the height in the header"
    )]
    ManyRows {
        /// The line, from 1.
        line: usize,
        /// The height.
        height: u32,
        /// The text found there.
        found: String,
    },
    /// An interrupt stopped the reading.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

const HEADER_FORM: &str = "a MovingAI map begins with the lines `type octile`, `height N`, `width N` and \
                           `map`, with its rows below";
