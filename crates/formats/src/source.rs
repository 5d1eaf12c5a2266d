//! One function for all kinds of maps.

use std::path::Path;

use mediant_grid::{Grid, Interrupt};

use crate::{
    MapFile, MapOptions, Raster, RosMap, WorldFrame, foreign,
    read::{ReadError, read_regular_interruptible},
    text::{Lines, words},
};

/// The kinds of files that are maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MapFormat {
    /// A MovingAI map, [`MapFile`].
    MovingAi,
    /// A picture, [`Raster`].
    Picture,
    /// The YAML file of a ROS map, [`RosMap`].
    Ros,
}

impl MapFormat {
    /// The kind of a file: by its first bytes, else by the end of its name, else by a line `image: …`, also
    /// in braces. `None` for files of other kinds, whatever their names.
    #[must_use]
    pub fn of(bytes: &[u8], path: impl AsRef<Path>) -> Option<Self> {
        let extension = path.as_ref().extension().and_then(|extension| extension.to_str());
        let first = Lines::new(bytes).find(|line| !line.is_blank());
        let first = first.and_then(|line| words(line.text).next());
        if Raster::is_picture(bytes) {
            return Some(Self::Picture);
        }
        if foreign::kind(bytes).is_some() {
            return None;
        }
        if first.is_some_and(|(_, word)| word == b"type") {
            return Some(Self::MovingAi);
        }
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("map") => Some(Self::MovingAi),
            Some("png" | "pgm" | "pbm" | "pnm") => Some(Self::Picture),
            Some("yaml" | "yml") => Some(Self::Ros),
            _ => {
                let mut lines = Lines::new(bytes).map(|line| line.text.trim_ascii_start());
                let names_image = |line: &[u8]| {
                    line.strip_prefix(b"{").unwrap_or(line).trim_ascii_start().starts_with(b"image:")
                };
                lines.any(names_image).then_some(Self::Ros)
            }
        }
    }
}

/// A map that was read from a file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MapSource {
    /// Which cells are blocked.
    pub grid: Grid,
    /// Where the cells are in the world, if the file says so: a ROS map does.
    pub frame: Option<WorldFrame>,
    /// The kind of the file.
    pub format: MapFormat,
    /// The file itself, with its characters, if it is a MovingAI map.
    pub tiles: Option<MapFile>,
}

/// Reads a map of any [kind](MapFormat). Of a MovingAI map only `tiles` counts, of a picture `threshold`,
/// `invert` and `unknown`, of a ROS map `threshold`, `unknown` and `ros`.
///
/// # Errors
/// [`ReadError`] for a file that is missing, cannot be read, or is no map; the same of the picture that a
/// YAML file names.
pub fn read_map(path: impl AsRef<Path>, options: &MapOptions) -> Result<MapSource, ReadError> {
    read_map_interruptible(path, options, &Interrupt::NEVER)
}

/// [`read_map`], which an interrupt can stop; it asks for each mebibyte of a file and each row of the map.
///
/// # Errors
/// As for [`read_map`], and [`ReadError::Interrupted`].
pub fn read_map_interruptible(
    path: impl AsRef<Path>,
    options: &MapOptions,
    interrupt: &Interrupt,
) -> Result<MapSource, ReadError> {
    source(path.as_ref(), options, |path| read_regular_interruptible(path, interrupt), interrupt)
}

/// Reads a map as [`read_map`] does, from wherever its files are: `read` gives the bytes of the file with a
/// path. It is asked for the map, and for the picture that a YAML file names, beside it.
///
/// ```
/// use mediant_formats::{MapOptions, ReadError, read_map_with};
/// let files = [("room.pgm", "P2 2 1 255  254 0"), ("room.yaml", "image: room.pgm\nresolution: 1\n\
///     origin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n")];
/// let map = read_map_with("room.yaml", &MapOptions::default(), |path| {
///     let file = files.iter().find(|(name, _)| path.as_os_str() == *name);
///     let bytes = file.map(|(_, text)| text.as_bytes().to_vec());
///     bytes.ok_or_else(|| ReadError::Missing { path: path.to_owned() })
/// })?;
/// assert!(map.grid.is_free(0, 0) && map.grid.is_blocked(1, 0));
/// # Ok::<(), ReadError>(())
/// ```
///
/// # Errors
/// Errors of `read`, and [`ReadError`] for a file that is no map.
pub fn read_map_with(
    path: impl AsRef<Path>,
    options: &MapOptions,
    read: impl FnMut(&Path) -> Result<Vec<u8>, ReadError>,
) -> Result<MapSource, ReadError> {
    source(path.as_ref(), options, read, &Interrupt::NEVER)
}

fn source(
    path: &Path,
    options: &MapOptions,
    mut read: impl FnMut(&Path) -> Result<Vec<u8>, ReadError>,
    interrupt: &Interrupt,
) -> Result<MapSource, ReadError> {
    let bytes = read(path)?;
    let format = format_of(path, &bytes)?;
    let (grid, frame, tiles) = match format {
        MapFormat::MovingAi => {
            let map = MapFile::from_bytes_interruptible(bytes, options.tiles.clone(), interrupt)
                .map_err(|error| ReadError::of_map(path, error))?;
            (map.to_grid_interruptible(interrupt)?, None, Some(map))
        }
        MapFormat::Picture => {
            let raster = Raster::parse_interruptible(&bytes, interrupt)
                .map_err(|error| ReadError::of_raster(path, error))?;
            (raster.to_grid_interruptible(options, interrupt)?, None, None)
        }
        MapFormat::Ros => {
            let map = RosMap::from_yaml(path, &bytes, read, interrupt)?;
            (map.to_grid_interruptible(options, interrupt)?, Some(map.frame()), None)
        }
    };
    Ok(MapSource { grid, frame, format, tiles })
}

/// The width and the height, in cells, that the header of a map of any kind states: before the map is made,
/// so that one that is too large can be refused. `read` is that of [`read_map_with`].
///
/// ```
/// use mediant_formats::map_size_with;
/// let header = |_: &std::path::Path| Ok(b"P5 30000 8000 255 ".to_vec());
/// assert_eq!(map_size_with("hall.pgm", header)?, (30_000, 8_000));
/// # Ok::<(), mediant_formats::ReadError>(())
/// ```
///
/// # Errors
/// Errors of `read`, and [`ReadError`] for a header that is wrong, or states sides that no map has.
pub fn map_size_with(
    path: impl AsRef<Path>,
    mut read: impl FnMut(&Path) -> Result<Vec<u8>, ReadError>,
) -> Result<(u32, u32), ReadError> {
    let path = path.as_ref();
    let bytes = read(path)?;
    let of_picture =
        |path: &Path, bytes: &[u8]| Raster::size(bytes).map_err(|error| ReadError::of_raster(path, error));
    match format_of(path, &bytes)? {
        MapFormat::MovingAi => MapFile::size(&bytes).map_err(|error| ReadError::of_map(path, error)),
        MapFormat::Picture => of_picture(path, &bytes),
        MapFormat::Ros => {
            let (_, image, bytes) = RosMap::files(path, &bytes, read)?;
            of_picture(&image, &bytes).map_err(|error| error.of_image(path))
        }
    }
}

/// The kind of a file that is to be a map.
fn format_of(path: &Path, bytes: &[u8]) -> Result<MapFormat, ReadError> {
    MapFormat::of(bytes, path)
        .ok_or_else(|| ReadError::NoMap { path: path.to_owned(), found: foreign::kind_or_quote(bytes) })
}
