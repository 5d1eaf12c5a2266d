//! Maps on whose grounds agents stand: land, water and trees are maps of their own.

use std::path::Path;

use mediant::{Map, Vertex};
use mediant_formats::{Ground, MapFile, ReadError};

/// The set whose scenarios were made on other maps than those it holds, and whose starts may be in water or
/// among trees: each query is answered on the ground of its start.
pub(crate) const OTHER_MAPS: &str = "wc3maps512";

/// A map file whose queries are answered on the grounds of their starts, or, as in most sets, on the whole
/// map.
pub(crate) struct Grounds {
    file: MapFile,
    by_ground: bool,
}

impl Grounds {
    /// Reads the map of a set.
    pub(crate) fn read(path: &Path, set: &str) -> Result<Self, ReadError> {
        Ok(Self { file: MapFile::read(path)?, by_ground: set == OTHER_MAPS })
    }

    /// Whether the scenarios were made on other maps.
    pub(crate) const fn are_of_other_maps(&self) -> bool {
        self.by_ground
    }

    /// The ground of a query that starts in this cell; `None` for the whole map.
    pub(crate) fn ground(&self, start: Vertex) -> Option<Ground> {
        if self.by_ground { self.file.ground(start.x, start.y) } else { None }
    }

    /// The map of a ground.
    pub(crate) fn map(&self, ground: Option<Ground>) -> Map {
        ground.map_or_else(|| self.file.to_grid(), |ground| self.file.ground_grid(ground)).into()
    }
}
