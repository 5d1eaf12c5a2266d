//! The library.

mod between_centers;
mod calls;
mod catalog;
mod costs;
mod dead_ends;
mod described;
mod door;
mod edits;
mod exceptions;
mod field;
mod follow;
mod goals;
mod guesses;
mod hierarchies;
mod identity;
mod interrupts;
mod labels;
mod mistakes;
#[cfg(all(target_os = "linux", feature = "parallel"))]
mod no_threads;
mod odd_input;
mod options;
mod panics;
mod planners;
mod points;
mod queries;
mod replan;
mod serialized;
mod subgoals;
mod table;
mod tiles;
mod walking;

use mediant::{
    Error, Index, Map, Planner, Setup,
    options::{EngineOption, Levels, OptionValue},
};
use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Rules};
use mediant_moves::FiniteK;

const NEVER: Rules = Rules::Center(CornerRule::Never);
const OPEN: Rules = Rules::Corner(DiagonalGap::Open);

/// A finite k.
fn k(k: u32) -> FiniteK {
    FiniteK::new(k).expect("k is at least 2")
}

/// The setup with this text.
fn setup(text: &str) -> Setup {
    text.parse().unwrap_or_else(|error| panic!("{error}"))
}

/// A small map, all of whose free cells are connected.
fn map() -> Map {
    let drawing = "
        ......#..
        .##...#..
        .#....#..
        ...#.....
        ...#..#..
    ";
    AsciiMap::parse(drawing).expect("the drawing is a map").grid.into()
}

/// A new index of a setup on a map.
fn index(setup: Setup, map: &Map) -> Result<Index, Error> {
    setup.prepare(&setup.space(map)?)
}

/// The index of a setup on a map, from its bytes.
fn read(setup: Setup, map: &Map, bytes: Vec<u8>) -> Result<Index, Error> {
    let index = setup.space(map)?.index_from_bytes(bytes)?.with_options(setup.engine)?;
    Ok(index.with_smoothing(setup.smoothing))
}

/// The bytes of a new index.
fn build(setup: Setup, map: &Map) -> Result<Vec<u8>, Error> {
    index(setup, map)?.to_bytes()
}

/// The levels of an index.
fn levels(index: &Index) -> Option<Levels> {
    match index.value(EngineOption::ALL.into_iter().find(|option| option.name == "levels")?)? {
        OptionValue::Levels(levels) => Some(levels),
        _ => None,
    }
}

/// A planner on the small map.
fn planner(setup: Setup) -> Planner {
    setup.planner(&map()).unwrap_or_else(|error| panic!("{setup}: {error}"))
}
