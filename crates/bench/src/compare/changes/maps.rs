//! The maps of the study: noise, rooms, and maps of the benchmark sets.

use std::sync::Arc;

use mediant::Map;
use mediant_grid::{Grid, GridError};
use mediant_oracle::{Rng, noise};
use mediant_sets::Archive;

use crate::{Problem, ProblemError};

/// Maps of games and of a city: the set and the name.
const BENCHMARKS: [(&str, &str); 6] = [
    ("dao", "arena2"),
    ("dao", "brc202d"),
    ("bg512", "AR0700SR"),
    ("wc3maps512", "icecrown"),
    ("sc1", "Cauldron"),
    ("street", "Paris_1_512"),
];

/// From one wall of the rooms to the next.
pub(super) const PITCH: u32 = 16;

/// Rooms of 15 × 15 cells with walls one cell thick, most of which have a door of one cell.
///
/// # Errors
/// [`GridError`] for a side that no map has.
pub fn rooms(rng: &mut Rng, side: u32) -> Result<Grid, GridError> {
    let across = side / PITCH + 1;
    let doors: Vec<[u32; 4]> = (0..across * across)
        .map(|_| [rng.below(10), 1 + rng.below(15), rng.below(10), 1 + rng.below(15)])
        .collect();
    let is_wall = |x: u32, y: u32| {
        let [has_left, left, has_top, top] = doors[(y / PITCH * across + x / PITCH) as usize];
        let [(is_left, x), (is_top, y)] = [x, y].map(|at| (at.is_multiple_of(PITCH), at % PITCH));
        let is_door = is_left && has_left < 8 && y == left || is_top && has_top < 8 && x == top;
        (is_left || is_top) && !is_door
    };
    Grid::from_fn(side, side, is_wall)
}

/// A made map: its kind and the cells of a side. Noise has 20 % of its cells blocked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Noise,
    Rooms,
}

impl Kind {
    pub(super) const ALL: [Self; 2] = [Self::Noise, Self::Rooms];

    pub(super) fn map(self, side: u32) -> Result<Map, GridError> {
        let rng = &mut Rng::new(super::SEED);
        Ok(Map::from(match self {
            Self::Noise => noise(rng, side, side, 20),
            Self::Rooms => rooms(rng, side)?,
        }))
    }

    /// The name of the map of a side.
    pub(super) fn name(self, side: u32) -> String {
        let kind = match self {
            Self::Noise => "noise",
            Self::Rooms => "rooms",
        };
        format!("{kind}-{side}")
    }
}

/// The maps of games and of a city that are there, with their names.
pub(super) fn benchmarks(archive: &Archive) -> Result<Vec<(String, Map)>, ProblemError> {
    let mut maps = Vec::new();
    for (set, name) in BENCHMARKS {
        if let Some(problem) = Problem::load(archive, set, name, 20)? {
            maps.push((name.to_owned(), Map::from(Arc::clone(problem.grid()))));
        }
    }
    Ok(maps)
}

/// The sets of these maps.
pub(super) fn sets() -> Vec<&'static str> {
    let mut sets: Vec<&str> = BENCHMARKS.iter().map(|(set, _)| *set).collect();
    sets.dedup();
    sets
}
