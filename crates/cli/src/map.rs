//! Maps and scenarios that the arguments name: from files, or bundled.

use std::{path::Path, sync::Arc};

use mediant_formats::{MapFile, Scenario};
use mediant_grid::Grid;

use crate::{builtin::Builtin, draw::theme::Theme, failure::Failure};

/// A map with the name that reports give it.
pub(crate) struct Map {
    /// The file's name, without its folders.
    pub(crate) name: String,
    pub(crate) file: MapFile,
    pub(crate) grid: Arc<Grid>,
    pub(crate) theme: Theme,
}

impl Map {
    /// Reads a map file, or parses the bundled map that `builtin:NAME` names.
    pub(crate) fn load(path: &Path) -> Result<Self, Failure> {
        match Builtin::of_path(path) {
            Some(builtin) => Self::bundled(builtin?),
            None => Ok(Self::new(file_name(path), MapFile::read(path)?, Theme::Plain)),
        }
    }

    /// Parses a bundled map.
    pub(crate) fn bundled(builtin: &Builtin) -> Result<Self, Failure> {
        Ok(Self::new(builtin.map_name(), builtin.map()?, builtin.theme))
    }

    fn new(name: String, file: MapFile, theme: Theme) -> Self {
        Self { name, grid: Arc::new(file.to_grid()), file, theme }
    }
}

impl Map {
    /// The map as the library searches it.
    pub(crate) fn to_library(&self) -> mediant::Map {
        mediant::Map::from(Arc::clone(&self.grid))
    }
}

/// Reads a scenario file, or parses that of the bundled map that `builtin:NAME` names. Returns the name that
/// reports give it, too.
pub(crate) fn load_scenario(path: &Path) -> Result<(String, Scenario), Failure> {
    match Builtin::of_path(path) {
        None => Ok((file_name(path), Scenario::read(path)?)),
        Some(builtin) => {
            let builtin = builtin?;
            Ok((builtin.scenario_name(), builtin.scenario()?))
        }
    }
}

/// The last part of a path. It may hold control characters.
pub(crate) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
