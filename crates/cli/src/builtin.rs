//! The bundled maps, with their scenarios.

use std::path::Path;

use mediant::Vertex;
use mediant_formats::{MapFile, ReadError, Scenario, Tiles};

use crate::{draw::theme::Theme, failure::Failure};

/// The prefix of a file argument that names a bundled map.
const PREFIX: &str = "builtin:";

/// A bundled map, with its scenario and the query of its demo.
#[derive(Debug)]
pub(crate) struct Builtin {
    pub(crate) name: &'static str,
    map: &'static str,
    scenario: &'static str,
    pub(crate) theme: Theme,
    /// The start of the demo's query: a vertex that is free at corners and at centers. So is the goal.
    pub(crate) start: Vertex,
    pub(crate) goal: Vertex,
    /// The caption of the demo.
    pub(crate) caption: &'static str,
}

/// The texts of a map and its scenario in this crate's folder `maps`.
macro_rules! bundled {
    ($name:literal) => {
        (
            include_str!(concat!("../maps/", $name, ".map")),
            include_str!(concat!("../maps/", $name, ".map.scen")),
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
    pub(crate) fn of_path(path: &Path) -> Option<Result<&'static Self, Failure>> {
        Some(Self::of_name(path.to_str()?.strip_prefix(PREFIX)?))
    }

    /// The bundled map that an argument names, with or without `builtin:`.
    pub(crate) fn of_name(name: &str) -> Result<&'static Self, Failure> {
        let name = name.strip_prefix(PREFIX).unwrap_or(name);
        BUILTINS.iter().find(|builtin| builtin.name == name).ok_or_else(|| {
            let known = BUILTINS.each_ref().map(|builtin| builtin.name).join(", ");
            Failure::NoSuchMap { name: name.to_owned(), known }
        })
    }

    /// The name of the next bundled map; that of the first after the last.
    pub(crate) fn next(&self) -> &'static str {
        let position = BUILTINS.iter().position(|builtin| builtin.name == self.name);
        BUILTINS[position.map_or(0, |i| (i + 1) % BUILTINS.len())].name
    }

    /// The map's file name.
    pub(crate) fn map_name(&self) -> String {
        format!("{}.map", self.name)
    }

    /// The scenario's file name.
    pub(crate) fn scenario_name(&self) -> String {
        format!("{}.map.scen", self.name)
    }

    /// Parses the map, of these tiles.
    pub(crate) fn map(&self, tiles: Tiles) -> Result<MapFile, Failure> {
        let map = MapFile::from_bytes(self.map.into(), tiles);
        Ok(map.map_err(|source| ReadError::Map { path: self.map_name().into(), source })?)
    }

    /// Parses the scenario.
    pub(crate) fn scenario(&self) -> Result<Scenario, Failure> {
        let scenario = Scenario::parse(self.scenario.as_bytes());
        Ok(scenario.map_err(|source| ReadError::Scenario { path: self.scenario_name().into(), source })?)
    }
}

/// Whether the path names a bundled map rather than a file.
pub(crate) fn is_builtin(path: &Path) -> bool {
    path.to_str().is_some_and(|path| path.starts_with(PREFIX))
}
