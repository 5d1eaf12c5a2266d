//! The catalog of engines.

mod catalog;
mod hierarchies;
mod options;
mod subgoals;

use std::sync::Arc;

use mediant::{EngineError, Index, Planner, Setup, SharedRules, Space};
use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Grid, Rules};
use mediant_moves::FiniteK;

const NEVER: Rules = Rules::Center(CornerRule::Never);
const OPEN: Rules = Rules::Corner(DiagonalGap::Open);

/// Pruning rules do not depend on a map: each is computed once for all tests.
static RULES: SharedRules = SharedRules::new();

/// A finite k.
fn k(k: u32) -> FiniteK {
    FiniteK::new(k).expect("k is at least 2")
}

/// The setup with this text.
fn setup(text: &str) -> Setup {
    text.parse().unwrap_or_else(|error| panic!("{error}"))
}

/// A small map, all of whose free cells are connected.
fn grid() -> Arc<Grid> {
    let drawing = "
        ......#..
        .##...#..
        .#....#..
        ...#.....
        ...#..#..
    ";
    Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid)
}

/// The index of a setup on a map: a new one, or the one in these bytes.
fn index(setup: Setup, grid: &Arc<Grid>, bytes: Option<&[u8]>) -> Result<Index, EngineError> {
    let space = Space::new(setup, grid)?;
    match bytes {
        None => Index::new(setup, &space, &RULES),
        Some(bytes) => Index::from_bytes(setup, &space, &RULES, bytes),
    }
}

/// The bytes of a new index.
fn build(setup: Setup, grid: &Arc<Grid>) -> Result<Vec<u8>, EngineError> {
    index(setup, grid, None)?.to_bytes()
}

/// A planner on the small map.
fn planner(setup: Setup) -> Planner {
    Planner::new(setup, &grid(), &RULES).unwrap_or_else(|error| panic!("{setup}: {error}"))
}

/// A planner on an index.
fn planner_on(index: &Index) -> Planner {
    index.planner().unwrap_or_else(|error| panic!("{}: {error}", index.setup()))
}
