//! Which characters of a map in text are free cells, and which are blocked.

use std::fmt;

use mediant_grid::{Grid, GridError};

/// Which characters of a map in text are free cells, and which are blocked: those of a MovingAI map, and of
/// rows of text.
///
/// By default `.`, `G` and `S` are free, `@`, `O`, `T`, `W` and `#` blocked, and all others errors. If only
/// the free ones are named, all others are blocked, and the other way round; if both are named, all others
/// are errors. A letter stands for its small form too.
///
/// ```
/// use mediant_formats::Tiles;
/// let water = Tiles::new(Some("W"), None)?;
/// assert_eq!([water.is_free('w'), water.is_free('.')], [Some(true), Some(false)]);
/// assert_eq!(Tiles::default().is_free('x'), None);
/// let grid = Tiles::new(Some("0"), Some("1"))?.grid(["010", "000"])?;
/// assert!(grid.is_blocked(1, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Tiles {
    /// Capital letters; `None` for all that are not blocked.
    free: Option<String>,
    /// Capital letters; `None` for all that are not free.
    blocked: Option<String>,
}

const FREE: &str = ".GS";
const BLOCKED: &str = "@OTW#";

impl Default for Tiles {
    fn default() -> Self {
        Self { free: Some(FREE.to_owned()), blocked: Some(BLOCKED.to_owned()) }
    }
}

/// Characters that cannot be free or blocked tiles.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TilesError {
    /// No character was named.
    #[error("expected the characters of {which} cells, found none; name at least one, or leave them out")]
    Empty {
        /// `free` or `blocked`.
        which: &'static str,
    },
    /// A character that would be both.
    #[error("the character `{tile}` is named as free and as blocked; leave it out of one of them")]
    Both {
        /// The character.
        tile: char,
    },
}

/// A character of which nobody said whether it is free.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "row {row}, column {column}, from 0: expected a tile, {tiles}, found `{tile}`; say which characters are \
     free or blocked, by `free` or `blocked`"
)]
pub struct TileError {
    /// The row, from 0.
    pub row: usize,
    /// The column, from 0.
    pub column: usize,
    /// The character.
    pub tile: char,
    /// The known characters.
    pub tiles: Tiles,
}

/// Rows of text that are no map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RowsError {
    /// No rows, rows of different lengths, or too many.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A character that is no tile.
    #[error(transparent)]
    Tile(#[from] TileError),
}

impl Tiles {
    /// The tiles with these characters. `None` for both are the usual tiles.
    ///
    /// # Errors
    /// [`TilesError`] for a text without characters, and for a character in both.
    pub fn new(free: Option<&str>, blocked: Option<&str>) -> Result<Self, TilesError> {
        let named = |which, tiles: Option<&str>| match tiles {
            Some("") => Err(TilesError::Empty { which }),
            tiles => Ok(tiles.map(str::to_ascii_uppercase)),
        };
        let tiles = Self { free: named("free", free)?, blocked: named("blocked", blocked)? };
        if tiles.free.is_none() && tiles.blocked.is_none() {
            return Ok(Self::default());
        }
        let both = |tile: &char| tiles.blocked.as_ref().is_some_and(|blocked| blocked.contains(*tile));
        match tiles.free.iter().flat_map(|free| free.chars()).find(both) {
            Some(tile) => Err(TilesError::Both { tile }),
            None => Ok(tiles),
        }
    }

    /// Whether a cell with this character is free; `None` if nobody said so.
    #[must_use]
    pub fn is_free(&self, tile: char) -> Option<bool> {
        let tile = tile.to_ascii_uppercase();
        let is_in = |tiles: &Option<String>| tiles.as_ref().is_some_and(|tiles| tiles.contains(tile));
        if is_in(&self.free) {
            Some(true)
        } else if is_in(&self.blocked) {
            Some(false)
        } else {
            // Where only one side was named, the rest is on the other.
            match (&self.free, &self.blocked) {
                (Some(_), None) => Some(false),
                (None, Some(_)) => Some(true),
                _ => None,
            }
        }
    }

    /// The grid with these rows from top to bottom, all of the same length.
    ///
    /// # Errors
    /// [`RowsError`] for no rows, rows of different lengths, sides longer than [`Grid::MAX_SIDE`], and a
    /// character that is neither free nor blocked.
    pub fn grid<R: AsRef<str>>(&self, rows: impl IntoIterator<Item = R>) -> Result<Grid, RowsError> {
        let of_row = |(y, row): (usize, R)| {
            let cells = row.as_ref().chars().enumerate().map(|(x, tile)| match self.is_free(tile) {
                Some(is_free) => Ok(!is_free),
                None => Err(TileError { row: y, column: x, tile, tiles: self.clone() }),
            });
            cells.collect()
        };
        let rows = rows.into_iter().enumerate().map(of_row);
        let rows: Vec<Vec<bool>> = rows.collect::<Result<_, TileError>>()?;
        let expected = rows.first().map_or(0, Vec::len);
        if let Some((row, cells)) = rows.iter().enumerate().find(|(_, cells)| cells.len() != expected) {
            return Err(GridError::Ragged { row, found: cells.len(), expected }.into());
        }
        Grid::check_size(expected as u64, rows.len() as u64)?;
        Ok(Grid::from_fn(expected as u32, rows.len() as u32, |x, y| rows[y as usize][x as usize])?)
    }

    /// For each byte of a MovingAI map whether it is a free tile; `None` for what is no tile.
    pub(crate) fn table(&self) -> [Option<bool>; 256] {
        let mut table = [None; 256];
        for byte in b' '..=b'~' {
            // A space is a tile only for those who say so.
            let named = |tiles: &Option<String>| tiles.as_ref().is_some_and(|tiles| tiles.contains(' '));
            if byte != b' ' || named(&self.free) || named(&self.blocked) {
                table[usize::from(byte)] = self.is_free(char::from(byte));
            }
        }
        table
    }
}

/// In words: `.`, `G`, `S` (free) or `@`, … (blocked).
impl fmt::Display for Tiles {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut tell = |tiles: &Option<String>, what: &str, before: &str| -> fmt::Result {
            let Some(tiles) = tiles else { return Ok(()) };
            f.write_str(before)?;
            for (at, tile) in tiles.chars().enumerate() {
                write!(f, "{}`{tile}`", if at == 0 { "" } else { ", " })?;
            }
            write!(f, " ({what})")
        };
        tell(&self.free, "free", "")?;
        tell(&self.blocked, "blocked", if self.free.is_some() { " or " } else { "" })
    }
}

/// A ground of the MovingAI benchmark. A path stays on the ground where it starts: no step leads from one to
/// another.
///
/// Sturtevant, *Benchmarks for Grid-Based Pathfinding* (2012), Section III: passable terrain, swamp that can
/// be entered from it, water, and trees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ground {
    /// `.`, `G` and `S`.
    Land,
    /// `W`.
    Water,
    /// `T`.
    Trees,
}

impl Ground {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Land, Self::Water, Self::Trees];

    /// The tiles of this ground are free, and all others blocked.
    #[must_use]
    pub fn tiles(self) -> Tiles {
        let free = match self {
            Self::Land => FREE,
            Self::Water => "W",
            Self::Trees => "T",
        };
        Tiles { free: Some(free.to_owned()), blocked: None }
    }

    /// The ground of a cell with this character; `None` for one that nobody can enter.
    #[must_use]
    pub const fn of_tile(tile: u8) -> Option<Self> {
        match tile.to_ascii_uppercase() {
            b'.' | b'G' | b'S' => Some(Self::Land),
            b'W' => Some(Self::Water),
            b'T' => Some(Self::Trees),
            _ => None,
        }
    }
}
