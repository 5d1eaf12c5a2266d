//! Maps from files and from the program itself.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use mediant_formats::{MapFile, ReadError, Scenario};
use mediant_grid::{Grid, Vertex};

use crate::{draw::theme::Theme, failure::Failure};

/// A map with the name that reports give it.
pub(crate) struct Map {
    /// The file's name, without its folders.
    pub(crate) name: String,
    pub(crate) file: MapFile,
    pub(crate) grid: Arc<Grid>,
    pub(crate) theme: Theme,
}

impl Map {
    /// Reads a map file, or the bundled map that `builtin:NAME` names.
    pub(crate) fn load(path: &Path) -> Result<Self, Failure> {
        match Builtin::named_by(path) {
            Some(builtin) => builtin?.map(),
            None => Ok(Self::new(file_name(path), MapFile::read(path)?, Theme::Plain)),
        }
    }

    fn new(name: String, file: MapFile, theme: Theme) -> Self {
        Self { name, grid: Arc::new(file.to_grid()), file, theme }
    }
}

/// The last part of a path; it may hold control characters.
pub(crate) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// A map that the program brings along, with its scenario and the query of its demo.
#[derive(Debug)]
pub(crate) struct Builtin {
    pub(crate) name: &'static str,
    map: &'static str,
    scenario: &'static str,
    theme: Theme,
    /// The demo's query, in corner vertices that are free cells as well.
    pub(crate) start: Vertex,
    pub(crate) goal: Vertex,
    /// What the demo says of it.
    pub(crate) caption: &'static str,
}

macro_rules! bundled {
    ($name:literal) => {
        (
            include_str!(concat!("../../../benchdata/maps/", $name, ".map")),
            include_str!(concat!("../../../benchdata/maps/", $name, ".map.scen")),
        )
    };
}

const fn builtin(
    name: &'static str,
    (map, scenario): (&'static str, &'static str),
    theme: Theme,
    (start, goal): ((i32, i32), (i32, i32)),
    caption: &'static str,
) -> Builtin {
    let (start, goal) = (Vertex::new(start.0, start.1), Vertex::new(goal.0, goal.1));
    Builtin { name, map, scenario, theme, start, goal, caption }
}

static BUILTINS: [Builtin; 4] = [
    builtin(
        "archipelago",
        bundled!("archipelago"),
        Theme::Sea,
        ((1, 1), (60, 34)),
        "a course between the islands",
    ),
    builtin("cave", bundled!("cave"), Theme::Cave, ((2, 5), (62, 33)), "a way through the cave"),
    builtin("maze", bundled!("maze"), Theme::Hedges, ((2, 2), (66, 31)), "a way through the maze"),
    builtin("town", bundled!("town"), Theme::Town, ((0, 34), (70, 3)), "a walk across town"),
];

impl Builtin {
    /// The bundled map that a path of the form `builtin:NAME` names; `None` for any other path.
    fn named_by(path: &Path) -> Option<Result<&'static Self, Failure>> {
        let name = path.to_str()?.strip_prefix("builtin:")?;
        Some(Self::named(name))
    }

    /// The bundled map of this name.
    pub(crate) fn named(name: &str) -> Result<&'static Self, Failure> {
        BUILTINS.iter().find(|builtin| builtin.name == name).ok_or_else(|| {
            let known = BUILTINS.each_ref().map(|builtin| builtin.name).join(", ");
            Failure::NoSuchMap { name: name.to_owned(), known }
        })
    }

    /// The name of the next bundled map, in a circle.
    pub(crate) fn next(&self) -> &'static str {
        let place = BUILTINS.iter().position(|builtin| builtin.name == self.name);
        BUILTINS[place.map_or(0, |i| (i + 1) % BUILTINS.len())].name
    }

    /// Parsed.
    pub(crate) fn map(&self) -> Result<Map, Failure> {
        let name = format!("{}.map", self.name);
        let file = MapFile::parse(self.map.as_bytes()).map_err(|source| {
            let path = PathBuf::from(&name);
            ReadError::Map { path, source }
        })?;
        Ok(Map::new(name, file, self.theme))
    }
}

/// Reads a scenario file, or that of the bundled map that `builtin:NAME` names. With the name that reports give it.
pub(crate) fn load_scenario(path: &Path) -> Result<(String, Scenario), Failure> {
    match Builtin::named_by(path) {
        None => Ok((file_name(path), Scenario::read(path)?)),
        Some(builtin) => {
            let builtin = builtin?;
            let name = format!("{}.map.scen", builtin.name);
            let scenario = Scenario::parse(builtin.scenario.as_bytes()).map_err(|source| {
                let path = PathBuf::from(&name);
                ReadError::Scenario { path, source }
            })?;
            Ok((name, scenario))
        }
    }
}

/// Whether the path names a bundled map rather than a file.
pub(crate) fn is_builtin(path: &Path) -> bool {
    path.to_str().is_some_and(|path| path.starts_with("builtin:"))
}
