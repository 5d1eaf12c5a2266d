//! MovingAI maps, `.map`.

use std::{io, path::Path};

use mediant_grid::Grid;

use crate::{
    ReadError,
    read::read_regular,
    text::{Line, Lines, is_blank, quote, quote_line, words},
};

/// A MovingAI map: a type, a height, a width, and a character a cell.
///
/// Cells `.`, `G` and `S` are free, all others blocked. Lines end in LF or CRLF; the last may lack its end, and empty
/// lines may follow it.
///
/// ```
/// use mediant_formats::MapFile;
/// let text = b"type octile\nheight 2\nwidth 3\nmap\n..T\n@.G\n";
/// let map = MapFile::parse(text)?;
/// assert!(map.to_grid().is_blocked(2, 0) && map.to_grid().is_free(2, 1));
/// assert_eq!(map.as_bytes(), text);
/// # Ok::<(), mediant_formats::MapError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapFile {
    text: Vec<u8>,
    width: u32,
    /// Where each row begins in the text: line ends may differ from row to row.
    rows: Vec<usize>,
}

/// A text that is not a MovingAI map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// No bytes at all.
    #[error(
        "line 1, column 1: expected a MovingAI map, found an empty file; is this the file that you meant?"
    )]
    Empty,
    /// A header line is missing or is another.
    #[error("line {line}, column 1: expected {expected}, found {found}; {HEADER_FORM}")]
    Header {
        /// The line, from 1.
        line: usize,
        /// The lines that may stand there.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// A height or width that is no number, zero, or too large.
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
        /// What stands there.
        found: String,
    },
    /// A row has fewer cells than the width.
    #[error(
        "line {line}, column {column}: expected a row of {expected} cells, found the end of the line after {found}; \
         complete the row or mend the width in the header"
    )]
    ShortRow {
        /// The line, from 1.
        line: usize,
        /// The first column that is missing, in bytes from 1.
        column: usize,
        /// The width.
        expected: u32,
        /// The cells of the row.
        found: usize,
    },
    /// A row has more cells than the width.
    #[error(
        "line {line}, column {column}: expected the end of a row of {expected} cells, found {found} more bytes; \
         shorten the row or mend the width in the header"
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
    /// A byte that is no tile.
    #[error(
        "line {line}, column {column}: expected a tile, found {found}; \
         a tile is a printable ASCII character such as `.` (free) or `@` (blocked)"
    )]
    Tile {
        /// The line, from 1.
        line: usize,
        /// The column, in bytes from 1.
        column: usize,
        /// The byte.
        found: String,
    },
    /// The file ends before the last row.
    #[error(
        "line {line}, column 1: expected row {row} of {height}, found the end of the file; \
         is the file cut short, or the height in the header too large?"
    )]
    FewRows {
        /// The line where the file ends, from 1.
        line: usize,
        /// The first missing row, from 1.
        row: usize,
        /// The height.
        height: u32,
    },
    /// Something follows the last row.
    #[error(
        "line {line}, column 1: expected the end of the file after {height} rows, found {found}; \
         remove what follows or mend the height in the header"
    )]
    ManyRows {
        /// The line, from 1.
        line: usize,
        /// The height.
        height: u32,
        /// What stands there.
        found: String,
    },
}

const HEADER_FORM: &str = "a MovingAI map begins with the lines `type octile`, `height N`, `width N` and `map`, with its rows below";

impl MapFile {
    /// Parses a map.
    ///
    /// # Errors
    /// [`MapError`] says what is wrong and where.
    pub fn parse(bytes: &[u8]) -> Result<Self, MapError> {
        Self::from_bytes(bytes.to_vec())
    }

    /// Parses a map and keeps the bytes, without a copy.
    ///
    /// # Errors
    /// [`MapError`] says what is wrong and where.
    pub fn from_bytes(text: Vec<u8>) -> Result<Self, MapError> {
        if text.is_empty() {
            return Err(MapError::Empty);
        }
        let mut lines = Lines::new(&text);
        let (width, height) = parse_header(&mut lines)?;
        let rows = parse_rows(&mut lines, width, height)?;
        Ok(Self { text, width, rows })
    }

    /// Reads and parses a file.
    ///
    /// # Errors
    /// [`ReadError`] for a file that is missing, cannot be read, or is no map.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        Self::from_bytes(read_regular(path)?)
            .map_err(|source| ReadError::Map { path: path.to_owned(), source })
    }

    /// The map of a grid: `.` for free and `@` for blocked cells, lines that end in LF.
    #[must_use]
    pub fn from_grid(grid: &Grid) -> Self {
        let (width, height) = (grid.width(), grid.height());
        let mut text = format!("type octile\nheight {height}\nwidth {width}\nmap\n").into_bytes();
        let mut rows = Vec::with_capacity(height as usize);
        for y in 0..height as i32 {
            rows.push(text.len());
            text.extend((0..width as i32).map(|x| if grid.is_free(x, y) { b'.' } else { b'@' }));
            text.push(b'\n');
        }
        Self { text, width, rows }
    }

    /// Which cells are blocked: all but `.`, `G` and `S`.
    #[must_use]
    pub fn to_grid(&self) -> Grid {
        Grid::from_fn(self.width, self.height(), |x, y| {
            !is_free(self.text[self.rows[y as usize] + x as usize])
        })
        .expect("a map's sides are checked when it is made")
    }

    /// The number of columns, 1 to [`Grid::MAX_SIDE`].
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows, 1 to [`Grid::MAX_SIDE`].
    #[must_use]
    pub const fn height(&self) -> u32 {
        // Rows are parsed against a height of at most MAX_SIDE.
        self.rows.len() as u32
    }

    /// The characters of the rows from top to bottom, `width` bytes each.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[u8]> {
        self.rows.iter().map(|&start| &self.text[start..start + self.width as usize])
    }

    /// Whether the character of a cell makes it free.
    #[must_use]
    pub const fn is_free_tile(tile: u8) -> bool {
        is_free(tile)
    }

    /// The text of the file, byte for byte.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        &self.text
    }

    /// Writes the text of the file, byte for byte.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, mut out: impl io::Write) -> io::Result<()> {
        out.write_all(&self.text)
    }
}

const fn is_free(tile: u8) -> bool {
    matches!(tile, b'.' | b'G' | b'S')
}

/// The width and the height that the header claims.
fn parse_header(lines: &mut Lines<'_>) -> Result<(u32, u32), MapError> {
    check_line(lines, &[b"type", b"octile"], "`type octile`")?;
    let (mut width, mut height) = (None, None);
    let sides = loop {
        let expected = match (width, height) {
            (Some(width), Some(height)) => break (width, height),
            (None, None) => "`height N` or `width N`",
            (Some(_), None) => "`height N`",
            (None, Some(_)) => "`width N`",
        };
        let line = lines.next();
        let text = line.map_or(&b""[..], |line| line.text);
        let (side, place) = match words(text).next() {
            Some((_, b"height")) if height.is_none() => ("height", &mut height),
            Some((_, b"width")) if width.is_none() => ("width", &mut width),
            _ => return Err(header_error(lines, line, expected)),
        };
        *place = Some(parse_side(lines.number(), text, side)?);
    };
    check_line(lines, &[b"map"], "`map`")?;
    Ok(sides)
}

fn check_line(lines: &mut Lines<'_>, expected: &[&[u8]], named: &'static str) -> Result<(), MapError> {
    let line = lines.next();
    let found = words(line.map_or(b"", |line| line.text)).map(|(_, word)| word);
    if found.eq(expected.iter().copied()) { Ok(()) } else { Err(header_error(lines, line, named)) }
}

fn header_error(lines: &Lines<'_>, line: Option<Line<'_>>, expected: &'static str) -> MapError {
    let number = line.map_or(lines.number() + 1, |line| line.number);
    MapError::Header { line: number, expected, found: quote_line(line) }
}

/// The one number that follows the name of a side.
fn parse_side(line: usize, text: &[u8], side: &'static str) -> Result<u32, MapError> {
    let mut words = words(text).skip(1);
    let (column, word) = words.next().unwrap_or((text.len() + 1, b""));
    let cells = std::str::from_utf8(word).ok().and_then(|word| word.parse::<u32>().ok());
    let Some(cells) = cells.filter(|&cells| Grid::check_size(u64::from(cells), 1).is_ok()) else {
        return Err(MapError::Side { line, column, side, found: quote(word) });
    };
    match words.next() {
        None => Ok(cells),
        Some((column, word)) => {
            Err(MapError::Side { line, column, side, found: format!("also {}", quote(word)) })
        }
    }
}

/// Where each row begins. Grows with the rows that are there.
fn parse_rows(lines: &mut Lines<'_>, width: u32, height: u32) -> Result<Vec<usize>, MapError> {
    let mut rows = Vec::new();
    while rows.len() < height as usize {
        let Some(line) = lines.next() else {
            let line = lines.number() + 1;
            return Err(MapError::FewRows { line, row: rows.len() + 1, height });
        };
        check_row(line, width)?;
        rows.push(line.start);
    }
    match lines.find(|line| !line.text.iter().all(|&byte| is_blank(byte))) {
        None => Ok(rows),
        Some(line) => Err(MapError::ManyRows { line: line.number, height, found: quote(line.text) }),
    }
}

/// Reports the first wrong column of a row.
fn check_row(line: Line<'_>, width: u32) -> Result<(), MapError> {
    let (found, expected) = (line.text.len(), width as usize);
    let tiles = &line.text[..found.min(expected)];
    if let Some(at) = tiles.iter().position(|tile| !tile.is_ascii_graphic()) {
        return Err(MapError::Tile { line: line.number, column: at + 1, found: quote(&tiles[at..=at]) });
    }
    match found {
        _ if found < expected => {
            Err(MapError::ShortRow { line: line.number, column: found + 1, expected: width, found })
        }
        _ if found > expected => Err(MapError::LongRow {
            line: line.number,
            column: expected + 1,
            expected: width,
            found: found - expected,
        }),
        _ => Ok(()),
    }
}
