//! Maps: which cells are blocked.

use std::{fmt, path::Path as FilePath, str::FromStr, sync::Arc};

use mediant_formats::{
    MapOptions, ReadError, Tiles, WorldFrame, map_size_with, read_map, read_map_interruptible, read_map_with,
};
use mediant_grid::{Grid, GridError, MapId, Rectangle, Vertex};
use mediant_search::Limits;

use crate::{error::Error, memory_check, recent::Recent};

/// The memory that an edit takes for each of its cells at most, in bytes, and how many need not be asked for.
const BYTES_OF_AN_EDIT: u64 = 4;
const FEW_CELLS: u64 = 1 << 14;

/// A map: a rectangle of cells, each free or blocked. Cell (x, y) is the one in column x from the left and
/// row y from the top, both from 0. Everything outside is blocked.
///
/// A map never changes; [`edit`](Self::edit) makes another one. Clones share it, and what their paths
/// [prepared](Self::path) last. The first paths on the edited map follow what was prepared, by work that
/// follows the edit.
///
/// ```
/// use mediant::Map;
///
/// let map = Map::from_rows([
///     "...#....",
///     ".#.#.##.",
///     ".#...#..",
/// ])?;
/// let path = map.path((0, 0), (7, 0))?.expect("there is a way");
/// assert_eq!(path.waypoints()[0], (0, 0).into());
/// assert!((path.cost() - 11.0).abs() < 1e-9);
/// # Ok::<(), mediant::Error>(())
/// ```
///
/// As text it has a row a line, `.` for free cells and `#` for blocked ones. A text is read as
/// [`from_rows`](Self::from_rows) reads rows; white space around a row counts for nothing, nor do blank lines
/// before the first row and after the last one.
///
/// ```
/// use mediant::Map;
///
/// let map: Map = "
///     ...#
///     .#..
/// ".parse()?;
/// assert_eq!((map.width(), map.to_string()), (4, "...#\n.#..".to_owned()));
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Map {
    grid: Arc<Grid>,
    recent: Arc<Recent>,
}

impl Map {
    /// Reads a map file: a `MovingAI` map (`.`, `G` and `S` are free cells, `@`, `O`, `T`, `W` and `#`
    /// blocked ones), a PNG, PGM or PBM picture (pixels darker than half are blocked), or the YAML file of a
    /// ROS map (as nav2 reads it since 2025; unknown cells are blocked). [`open_with`](Self::open_with) has
    /// options, and the map's place in the world.
    ///
    /// # Errors
    /// [`Error::Read`] for a file that is missing, cannot be read, or is no map.
    pub fn open(path: impl AsRef<FilePath>) -> Result<Self, Error> {
        Ok(read_map(path, &MapOptions::default())?.grid.into())
    }

    /// Reads a map file as [`open`](Self::open) does, with options, and with its place in the world if it is
    /// a ROS map.
    ///
    /// ```no_run
    /// use mediant::{Map, files::{MapOptions, Unknown}};
    ///
    /// let options = MapOptions { unknown: Unknown::Free, ..MapOptions::default() };
    /// let (map, world) = Map::open_with("depot.yaml", &options)?;
    /// let start = world.and_then(|world| world.cell_at(1.5, -2.0));
    /// # let _ = (map, start);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`open`](Self::open).
    pub fn open_with(
        path: impl AsRef<FilePath>,
        options: &MapOptions,
    ) -> Result<(Self, Option<WorldFrame>), Error> {
        let source = read_map(path, options)?;
        Ok((source.grid.into(), source.frame))
    }

    /// Reads a map as [`open_with`](Self::open_with) does, unless the deadline or the flag of the limits
    /// stops it before it is done.
    ///
    /// # Errors
    /// As for [`open`](Self::open), and [`Error::Stopped`].
    pub fn open_within(
        path: impl AsRef<FilePath>,
        options: &MapOptions,
        limits: impl Into<Limits>,
    ) -> Result<(Self, Option<WorldFrame>), Error> {
        let source = read_map_interruptible(path, options, limits.into().interrupt())?;
        Ok((source.grid.into(), source.frame))
    }

    /// Reads a map as [`open_with`](Self::open_with) does, where its files are not on a disk: `read` gives
    /// the bytes of the file with a path. It is asked for the map, and for the picture that the YAML file of
    /// a ROS map names.
    ///
    /// ```
    /// use mediant::{Map, files::MapOptions};
    ///
    /// let text = "type octile\nheight 1\nwidth 3\nmap\n.@.\n";
    /// let (map, _) = Map::open_in("hall.map", &MapOptions::default(), |_| Ok(text.into()))?;
    /// assert!(map.is_blocked((1, 0)));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// Errors of `read`, and [`Error::Read`] for a file that is no map.
    pub fn open_in(
        path: impl AsRef<FilePath>,
        options: &MapOptions,
        read: impl FnMut(&FilePath) -> Result<Vec<u8>, ReadError>,
    ) -> Result<(Self, Option<WorldFrame>), Error> {
        let source = read_map_with(path, options, read)?;
        Ok((source.grid.into(), source.frame))
    }

    /// The width and the height, in cells, that the header of a map states: what a map of a file would have,
    /// before it is made. `read` is that of [`open_in`](Self::open_in).
    ///
    /// # Errors
    /// Errors of `read`, and [`Error::Read`] for a header that is wrong.
    pub fn size_in(
        path: impl AsRef<FilePath>,
        read: impl FnMut(&FilePath) -> Result<Vec<u8>, ReadError>,
    ) -> Result<(u32, u32), Error> {
        Ok(map_size_with(path, read)?)
    }

    /// The map with these rows from top to bottom, all of the same length: `.`, `G` and `S` are free cells,
    /// `#`, `@`, `O`, `T` and `W` blocked ones, small letters as capitals, as in the files of `MovingAI`.
    /// [`from_rows_with`](Self::from_rows_with) takes other characters.
    ///
    /// # Errors
    /// [`Error::Tile`] for another character; [`Error::Grid`] for no rows, rows of different lengths, or
    /// sides longer than [`Grid::MAX_SIDE`].
    pub fn from_rows<R: AsRef<str>>(rows: impl IntoIterator<Item = R>) -> Result<Self, Error> {
        Self::from_rows_with(rows, &Tiles::default())
    }

    /// The map with these rows of these characters.
    ///
    /// ```
    /// use mediant::{Map, files::Tiles};
    ///
    /// let hall = Map::from_rows_with(["#   #", "# # #"], &Tiles::new(Some(" "), Some("#"))?)?;
    /// assert!(hall.is_blocked((2, 1)) && hall.is_free((1, 1)));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`from_rows`](Self::from_rows).
    pub fn from_rows_with<R: AsRef<str>>(
        rows: impl IntoIterator<Item = R>,
        tiles: &Tiles,
    ) -> Result<Self, Error> {
        Ok(tiles.grid(rows)?.into())
    }

    /// The map of `width` × `height` cells, all of which are free.
    ///
    /// # Errors
    /// [`Error::Grid`] for a side of 0 or longer than [`Grid::MAX_SIDE`].
    pub fn new(width: u32, height: u32) -> Result<Self, Error> {
        Self::from_fn(width, height, |_, _| false)
    }

    /// The map of `width` × `height` cells for which `blocked(x, y)` says which are blocked. It is asked once
    /// for each cell, row by row.
    ///
    /// # Errors
    /// [`Error::Grid`] for a side of 0 or longer than [`Grid::MAX_SIDE`].
    pub fn from_fn(width: u32, height: u32, blocked: impl FnMut(u32, u32) -> bool) -> Result<Self, Error> {
        Ok(Grid::from_fn(width, height, blocked)?.into())
    }

    /// The map of `width` columns with these cells, row by row; true is blocked.
    ///
    /// # Errors
    /// [`Error::Grid`] for a number of cells that is no multiple of the width, or sides of 0 or longer than
    /// [`Grid::MAX_SIDE`].
    pub fn from_bits(width: u32, blocked: impl IntoIterator<Item = bool>) -> Result<Self, Error> {
        let blocked = memory_check::collected("the cells", blocked)?;
        let columns = width.max(1) as usize;
        let (height, rest) = (blocked.len() / columns, blocked.len() % columns);
        if rest != 0 {
            return Err(GridError::Ragged { row: height, found: rest, expected: columns }.into());
        }
        Grid::check_size(u64::from(width), height as u64)?;
        Self::from_fn(width, height as u32, |x, y| blocked[y as usize * columns + x as usize])
    }

    /// This map with one cell blocked (true) or free (false). The map itself stays as it is. For more cells
    /// at once there are [`edit`](Self::edit) and [`edit_cells`](Self::edit_cells).
    ///
    /// ```
    /// use mediant::Map;
    ///
    /// let open = Map::new(3, 1)?;
    /// let walled = open.set((1, 0), true)?;
    /// assert!(open.path((0, 0), (2, 0))?.is_some() && walled.path((0, 0), (2, 0))?.is_none());
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::EditCell`] for a cell outside the map.
    pub fn set(&self, cell: impl Into<Vertex>, blocked: bool) -> Result<Self, Error> {
        self.edit_cells([(cell, blocked)])
    }

    /// This map with other cells in a rectangle: `blocked(x, y)` is asked once for each of its cells, row by
    /// row. Cells of the rectangle beyond the map are left out.
    ///
    /// # Errors
    /// [`Error::Edit`] for a rectangle that lies outside the map as a whole.
    pub fn edit(&self, at: Rectangle, blocked: impl FnMut(u32, u32) -> bool) -> Result<Self, Error> {
        self.check_edit(at)?;
        Ok(self.after(|change| change.edit(at, blocked)))
    }

    /// Checks that a rectangle does not lie outside the map as a whole, and that there is room for the list
    /// of what changes in it.
    pub(crate) fn check_edit(&self, at: Rectangle) -> Result<(), Error> {
        let size = self.id().size();
        if at.x >= size.0 || at.y >= size.1 {
            return Err(Error::Edit { at, size });
        }
        let cells = u64::from(at.width.min(size.0 - at.x)) * u64::from(at.height.min(size.1 - at.y));
        // Small edits are made within microseconds.
        if cells < FEW_CELLS { Ok(()) } else { memory_check::check("the edit", cells * BYTES_OF_AN_EDIT) }
    }

    /// This map with other scattered cells: of each its column and row, and whether it is blocked. The last
    /// word on a cell counts.
    ///
    /// ```
    /// use mediant::Map;
    /// let map = Map::from_rows(["...", "..."])?.edit_cells([((0, 0), true), ((2, 1), true)])?;
    /// assert!(map.is_blocked((0, 0)) && map.is_blocked((2, 1)));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::EditCell`] for a cell outside the map.
    pub fn edit_cells<C: Into<Vertex>>(
        &self,
        cells: impl IntoIterator<Item = (C, bool)>,
    ) -> Result<Self, Error> {
        let cells = self.check_cells(cells)?;
        Ok(self.after(|change| change.edit_cells(cells)))
    }

    /// Cells with their columns and rows, which are on the map.
    pub(crate) fn check_cells<C: Into<Vertex>, T>(
        &self,
        cells: impl IntoIterator<Item = (C, T)>,
    ) -> Result<Vec<(u32, u32, T)>, Error> {
        let mut known = Vec::new();
        for (cell, value) in cells {
            let Vertex { x, y } = cell.into();
            match (u32::try_from(x), u32::try_from(y)) {
                (Ok(x), Ok(y)) if x < self.width() && y < self.height() => known.push((x, y, value)),
                _ => return Err(Error::EditCell { cell: Vertex { x, y }, size: self.id().size() }),
            }
        }
        Ok(known)
    }

    /// The number of columns.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.grid.width()
    }

    /// The number of rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.grid.height()
    }

    /// Whether a cell is blocked; those outside the map are.
    ///
    /// ```
    /// use mediant::Map;
    /// let map = Map::from_rows([".#"])?;
    /// assert!(map.is_free((0, 0)) && map.is_blocked((1, 0)) && map.is_blocked((2, 0)));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    #[must_use]
    pub fn is_blocked(&self, cell: impl Into<Vertex>) -> bool {
        let Vertex { x, y } = cell.into();
        self.grid.is_blocked(x, y)
    }

    /// Whether a cell is free; those outside the map are not.
    #[must_use]
    pub fn is_free(&self, cell: impl Into<Vertex>) -> bool {
        !self.is_blocked(cell)
    }

    /// The identity of the map: the same for all maps with the same cells.
    #[must_use]
    pub fn id(&self) -> MapId {
        self.grid.id()
    }

    pub(crate) fn recent(&self) -> &Arc<Recent> {
        &self.recent
    }

    /// A map with what is kept of it.
    pub(crate) fn with_recent(grid: Arc<Grid>, recent: Recent) -> Self {
        Self { grid, recent: Arc::new(recent) }
    }

    /// The bit-packed grid, for the typed crates.
    #[must_use]
    pub const fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }
}

/// Maps with the same cells are one map.
impl PartialEq for Map {
    fn eq(&self, other: &Self) -> bool {
        self.grid == other.grid
    }
}

impl Eq for Map {}

impl From<Grid> for Map {
    fn from(grid: Grid) -> Self {
        Arc::new(grid).into()
    }
}

impl From<Arc<Grid>> for Map {
    fn from(grid: Arc<Grid>) -> Self {
        Self { grid, recent: Arc::default() }
    }
}

/// The rows, each on a line, the last one without a line end: what [`FromStr`] reads.
impl fmt::Display for Map {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut row = String::with_capacity(self.width() as usize);
        for y in 0..self.height() {
            let cells = (0..self.width()).map(|x| if self.is_blocked((x, y)) { '#' } else { '.' });
            row.clear();
            row.extend(cells);
            write!(f, "{}{row}", if y == 0 { "" } else { "\n" })?;
        }
        Ok(())
    }
}

impl FromStr for Map {
    type Err = Error;

    /// # Errors
    /// As for [`Map::from_rows`].
    fn from_str(text: &str) -> Result<Self, Error> {
        Self::from_rows(text.trim().lines().map(str::trim))
    }
}
