//! One function for all kinds of maps.

use std::path::Path;

use mediant_grid::Grid;

use crate::{
    ImageOptions, MapFile, Raster, RosMap, WorldFrame,
    read::{ReadError, read_regular},
    text::{Lines, quote, words},
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
    /// The kind of a file: by its first bytes, else by the end of its name, else by a line `image: …`.
    #[must_use]
    pub fn of(bytes: &[u8], path: impl AsRef<Path>) -> Option<Self> {
        let extension = path.as_ref().extension().and_then(|extension| extension.to_str());
        let first = Lines::new(bytes).next().and_then(|line| words(line.text).next());
        if Raster::is_picture(bytes) {
            return Some(Self::Picture);
        }
        if first.is_some_and(|(_, word)| word == b"type") {
            return Some(Self::MovingAi);
        }
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("map") => Some(Self::MovingAi),
            Some("png" | "pgm" | "pbm" | "pnm") => Some(Self::Picture),
            Some("yaml" | "yml") => Some(Self::Ros),
            _ => Lines::new(bytes).any(|line| line.text.starts_with(b"image:")).then_some(Self::Ros),
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

/// Reads a map of any [kind](MapFormat). The options are for pictures; of a MovingAI map nothing depends on
/// them.
///
/// # Errors
/// [`ReadError`] for a file that is missing, cannot be read, or is no map; the same of the picture that a
/// YAML file names.
pub fn read_map(path: impl AsRef<Path>, options: &ImageOptions) -> Result<MapSource, ReadError> {
    let path = path.as_ref();
    let bytes = read_regular(path)?;
    let format = MapFormat::of(&bytes, path)
        .ok_or_else(|| ReadError::NoMap { path: path.to_owned(), found: quote(&bytes) })?;
    let (grid, frame, tiles) = match format {
        MapFormat::MovingAi => {
            let map = MapFile::from_bytes(bytes)
                .map_err(|source| ReadError::Map { path: path.to_owned(), source })?;
            (map.to_grid(), None, Some(map))
        }
        MapFormat::Picture => {
            let raster = Raster::parse(&bytes)
                .map_err(|source| ReadError::Raster { path: path.to_owned(), source })?;
            (raster.to_grid(options), None, None)
        }
        MapFormat::Ros => {
            let map = RosMap::from_yaml(path, &bytes)?;
            (map.to_grid(options), Some(map.frame()), None)
        }
    };
    Ok(MapSource { grid, frame, format, tiles })
}
