//! Points of every kind from a seed, and maps whose vertices are points of another map.

use mediant_grid::{Grid, PlacementKind, Vertex};

use super::{PARTS_PER_CELL, Parts, point_is_free, point_of};
use crate::{Rng, is_gap, random_free_vertex, random_vertex};

/// Kinds of points, by their place among cells. The rules of motion differ between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PointKind {
    /// Any multiple of 1/1024, most often inside a cell.
    Anywhere,
    /// The center of a cell.
    Center,
    /// On a line between two columns of cells.
    OnColumn,
    /// On a line between two rows of cells.
    OnRow,
    /// 1/1024 beside a line between columns or rows; beyond the border this is outside the map.
    BesideLine,
    /// A vertex of corner placement.
    Vertex,
    /// One of the eight points around a vertex at 1/1024 in x, in y or in both.
    BesideVertex,
    /// A vertex at which two blocked cells meet diagonally, or any vertex on a map without such gaps.
    Gap,
    /// One of the eight points around a gap, or around any vertex on a map without gaps.
    BesideGap,
}

impl PointKind {
    /// All kinds.
    pub const ALL: [Self; 9] = [
        Self::Anywhere,
        Self::Center,
        Self::OnColumn,
        Self::OnRow,
        Self::BesideLine,
        Self::Vertex,
        Self::BesideVertex,
        Self::Gap,
        Self::BesideGap,
    ];
}

/// A point of this kind, free or not.
pub fn random_point(rng: &mut Rng, grid: &Grid, kind: PointKind) -> Parts {
    let parts = PARTS_PER_CELL as u32;
    let mut anywhere =
        || (i64::from(rng.below(grid.width() * parts + 1)), i64::from(rng.below(grid.height() * parts + 1)));
    let (x, y) = anywhere();
    let vertex = point_of(random_vertex(rng, grid, PlacementKind::Corner));
    match kind {
        PointKind::Anywhere => (x, y),
        PointKind::Center => {
            let at = point_of(random_vertex(rng, grid, PlacementKind::Center));
            (at.0 + PARTS_PER_CELL / 2, at.1 + PARTS_PER_CELL / 2)
        }
        PointKind::OnColumn => (vertex.0, y),
        PointKind::OnRow => (x, vertex.1),
        PointKind::BesideLine => {
            let by = if rng.chance(50) { 1 } else { -1 };
            if rng.chance(50) { (vertex.0 + by, y) } else { (x, vertex.1 + by) }
        }
        PointKind::Vertex => vertex,
        PointKind::BesideVertex => beside(rng, vertex),
        PointKind::Gap => random_gap(rng, grid).unwrap_or(vertex),
        PointKind::BesideGap => {
            let at = random_gap(rng, grid).unwrap_or(vertex);
            beside(rng, at)
        }
    }
}

/// A free point, of each kind with the same probability if the map has free points of this kind; `None` if no
/// cell is free.
pub fn random_free_point(rng: &mut Rng, grid: &Grid) -> Option<Parts> {
    let cell = random_free_vertex(rng, grid, PlacementKind::Center)?;
    let kind = *rng.pick(&PointKind::ALL)?;
    let draws = (0..DRAWS).map(|_| random_point(rng, grid, kind));
    let center = point_of(cell);
    let center = (center.0 + PARTS_PER_CELL / 2, center.1 + PARTS_PER_CELL / 2);
    Some(draws.into_iter().find(|&at| point_is_free(grid, at)).unwrap_or(center))
}

/// Draws of a point before the center of a free cell is taken: enough on all but nearly blocked maps.
const DRAWS: u32 = 200;

/// One of the eight points around a point, at 1 part in x, in y or in both.
fn beside(rng: &mut Rng, (x, y): Parts) -> Parts {
    let around = (0..9).map(|n| (x + n % 3 - 1, y + n / 3 - 1)).filter(|&at| at != (x, y));
    rng.pick(&around.collect::<Vec<_>>()).copied().unwrap_or((x, y))
}

/// A gap of the map, each with the same probability; `None` if there is none.
fn random_gap(rng: &mut Rng, grid: &Grid) -> Option<Parts> {
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    let vertices = (1..height).flat_map(|y| (1..width).map(move |x| Vertex::new(x, y)));
    let gaps: Vec<Vertex> = vertices.filter(|&at| is_gap(grid, at)).collect();
    rng.pick(&gaps).copied().map(point_of)
}

/// The map with `times` × `times` cells for each cell, so that vertex (x, y) of it is the point
/// (x / `times`, y / `times`) of the given map. Costs between vertices are `times` those between the points.
///
/// # Panics
/// If a side exceeds [`Grid::MAX_SIDE`], or `times` is 0.
#[must_use]
pub fn magnified(grid: &Grid, times: u32) -> Grid {
    let is_blocked = |x: u32, y: u32| grid.is_blocked((x / times) as i32, (y / times) as i32);
    Grid::from_fn(grid.width() * times, grid.height() * times, is_blocked).expect("a map of a valid size")
}
