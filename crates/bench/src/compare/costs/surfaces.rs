//! The surfaces of the study: five by a seed, and a map of a game by its terrain.

use mediant::{Costs, FiniteK, Map, Motion, Space};
use mediant_oracle::{Rng, Surface};
use mediant_sets::Archive;

use super::SEED;
use crate::{ProblemError, compare::CompareError};

/// The set and the name of the map by terrain.
pub(super) const TERRAIN: (&str, &str) = ("wc3maps512", "icecrown");

/// A kind of surface, of any side.
pub(super) enum Kind {
    /// By a seed.
    Made(Surface),
    /// The cells of a map: costs row by row, 0 is blocked, and the cells of a row.
    Terrain(Vec<u32>, usize),
}

impl Kind {
    pub(super) const fn name(&self) -> &'static str {
        match self {
            Self::Made(surface) => surface.name(),
            Self::Terrain(..) => "terrain",
        }
    }

    /// The costs of side × side cells, row by row; of a map those of its middle. 0 is blocked.
    pub(super) fn costs(&self, side: u32) -> Vec<u32> {
        match self {
            Self::Made(surface) => surface.costs(side, &mut Rng::new(SEED)),
            Self::Terrain(costs, columns) => {
                let side = side as usize;
                let rows = costs.len() / columns;
                let [left, top] = [*columns, rows].map(|all| all.saturating_sub(side) / 2);
                let cell = |at: usize| {
                    let (x, y) = (left + at % side, top + at / side);
                    if x < *columns && y < rows { costs[y * columns + x] } else { 0 }
                };
                (0..side * side).map(cell).collect()
            }
        }
    }

    /// The surface of side × side cells.
    pub(super) fn surface(&self, side: u32) -> Result<Costs, CompareError> {
        surface(side, &self.costs(side))
    }
}

/// The surface of these costs, row by row; 0 is blocked.
pub(super) fn surface(side: u32, costs: &[u32]) -> Result<Costs, CompareError> {
    let map = Map::from_bits(side, costs.iter().map(|&cost| cost == 0))?;
    Ok(map.costs(costs.iter().copied())?)
}

/// The space of a surface between centers; corners are never cut.
pub(super) fn space(surface: &Costs, k: u32) -> Result<Space, CompareError> {
    let k = FiniteK::new(k).map_err(mediant::Error::from)?;
    Ok(surface.space(Motion::centers(k))?)
}

/// All kinds; without the map if it is not there.
pub(super) fn surfaces(archive: &Archive) -> Result<Vec<Kind>, CompareError> {
    use Surface as S;
    let made = [S::Elevation, S::Patches, S::Friction, S::Rooms, S::Equal].map(Kind::Made);
    let (set, name) = TERRAIN;
    let file = archive.map(set, name).map_err(ProblemError::from)?;
    Ok(file.as_deref().and_then(terrain).into_iter().chain(made).collect())
}

/// Ground costs 1, trees 3, shallow water 4, water 9; all else is blocked.
fn terrain(map: &[u8]) -> Option<Kind> {
    let text = std::str::from_utf8(map).ok()?;
    let rows: Vec<&str> = text.lines().skip_while(|line| line.trim() != "map").skip(1).collect();
    let cost = |tile: char| match tile {
        '.' | 'G' => 1,
        'T' => 3,
        'S' => 4,
        'W' => 9,
        _ => 0,
    };
    let costs = rows.iter().flat_map(|row| row.trim_end().chars().map(cost)).collect();
    Some(Kind::Terrain(costs, rows.first()?.trim_end().len()))
}
