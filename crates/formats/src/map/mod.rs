//! MovingAI maps, `.map`.

pub(crate) mod error;
pub(crate) mod parse;
mod tiles;

use std::{io, path::Path};

use mediant_grid::{Grid, Interrupt, Interrupted, uninterrupted};

pub use error::MapError;
pub use tiles::{Ground, RowsError, TileError, Tiles, TilesError};

use crate::read::{ReadError, grid_of_checked_sides, read_regular};

/// A MovingAI map: a header with height and width, and one character per cell.
///
/// The characters `.`, `G` and `S` are free cells, `@`, `O`, `T`, `W` and `#` blocked ones, small letters as
/// capitals, and others an error; [`Tiles`] say otherwise. Lines end in LF or CRLF. The last row may lack its
/// line end. Empty lines in the header and at the end, spaces at the ends of rows, and the byte order mark of
/// UTF-8 are read past.
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
    /// Where each row begins in the text. Line ends may differ from row to row, so this cannot be computed.
    rows: Vec<usize>,
    tiles: Tiles,
}

impl MapFile {
    /// Parses a map of the usual tiles.
    ///
    /// # Errors
    /// [`MapError`] says what is wrong and where.
    pub fn parse(bytes: &[u8]) -> Result<Self, MapError> {
        Self::from_bytes(bytes.to_vec(), Tiles::default())
    }

    /// Parses a map of these tiles, and keeps the bytes without copying them.
    ///
    /// ```
    /// use mediant_formats::{MapFile, Tiles};
    /// let text = b"type octile\nheight 1\nwidth 3\nmap\n.WW\n".to_vec();
    /// let water = MapFile::from_bytes(text, Tiles::new(Some("W"), None)?)?.to_grid();
    /// assert!(water.is_blocked(0, 0) && water.is_free(1, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`MapError`] says what is wrong and where.
    pub fn from_bytes(text: Vec<u8>, tiles: Tiles) -> Result<Self, MapError> {
        Self::from_bytes_interruptible(text, tiles, &Interrupt::NEVER)
    }

    pub(crate) fn from_bytes_interruptible(
        text: Vec<u8>,
        tiles: Tiles,
        interrupt: &Interrupt,
    ) -> Result<Self, MapError> {
        let (width, rows) = parse::map(&text, &tiles, interrupt)?;
        Ok(Self { text, width, rows, tiles })
    }

    /// Reads and parses a file.
    ///
    /// # Errors
    /// [`ReadError`] for a file that is missing, cannot be read, or is no map.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        Self::from_bytes(read_regular(path)?, Tiles::default())
            .map_err(|error| ReadError::of_map(path, error))
    }

    /// The width and the height that the header states of a map that [`parse`](Self::parse) reads whole.
    ///
    /// # Errors
    /// [`MapError`] for a header that is wrong.
    pub fn size(bytes: &[u8]) -> Result<(u32, u32), MapError> {
        parse::size(bytes)
    }

    /// Makes the map of a grid: `.` for free and `@` for blocked cells, lines that end in LF.
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
        Self { text, width, rows, tiles: Tiles::default() }
    }

    /// The grid of the map.
    #[must_use]
    pub fn to_grid(&self) -> Grid {
        uninterrupted(|never| self.to_grid_interruptible(never))
    }

    pub(crate) fn to_grid_interruptible(&self, interrupt: &Interrupt) -> Result<Grid, Interrupted> {
        self.grid_where(interrupt, |tile| self.is_free(tile))
    }

    /// The grid of a ground: its cells are free, and all others blocked. So no path leads from one ground to
    /// another.
    ///
    /// ```
    /// use mediant_formats::{Ground, MapFile};
    /// let map = MapFile::parse(b"type octile\nheight 2\nwidth 4\nmap\n.WW.\n.wW.\n")?;
    /// let ground = map.ground(1, 0).expect("water");
    /// assert_eq!(ground, Ground::Water);
    /// assert!(map.ground_grid(ground).is_free(1, 1) && map.ground_grid(ground).is_blocked(0, 0));
    /// # Ok::<(), mediant_formats::MapError>(())
    /// ```
    #[must_use]
    pub fn ground_grid(&self, ground: Ground) -> Grid {
        uninterrupted(|never| self.grid_where(never, |tile| Ground::of_tile(tile) == Some(ground)))
    }

    /// The ground of a cell; `None` for one that nobody can enter, and outside the map.
    #[must_use]
    pub fn ground(&self, x: i32, y: i32) -> Option<Ground> {
        let row = *self.rows.get(usize::try_from(y).ok()?)?;
        let x = usize::try_from(x).ok().filter(|&x| x < self.width as usize)?;
        Ground::of_tile(self.text[row + x])
    }

    fn grid_where(&self, interrupt: &Interrupt, is_free: impl Fn(u8) -> bool) -> Result<Grid, Interrupted> {
        let table: Vec<bool> = (0..=u8::MAX).map(is_free).collect();
        grid_of_checked_sides((self.width, self.height()), interrupt, |x, y| {
            !table[usize::from(self.text[self.rows[y as usize] + x as usize])]
        })
    }

    /// The number of columns, 1 to [`Grid::MAX_SIDE`].
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows, 1 to [`Grid::MAX_SIDE`].
    #[must_use]
    pub const fn height(&self) -> u32 {
        // No loss: the parser and the grid allow at most MAX_SIDE rows.
        self.rows.len() as u32
    }

    /// The rows from top to bottom, each of [`width`](Self::width) characters.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[u8]> {
        self.rows.iter().map(|&start| &self.text[start..start + self.width as usize])
    }

    /// Whether a cell of this map with this character is free.
    #[must_use]
    pub fn is_free(&self, tile: u8) -> bool {
        self.tiles.is_free(char::from(tile)) == Some(true)
    }

    /// The text of the file, byte for byte.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        &self.text
    }

    /// Writes the text of the file, byte for byte.
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn write(&self, mut out: impl io::Write) -> io::Result<()> {
        out.write_all(&self.text)
    }
}
