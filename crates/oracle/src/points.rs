//! Any-angle paths between points anywhere in free space, from their definitions.
//!
//! Coordinates are those of corner placement: (0, 0) is the map's corner, and cell (x, y) reaches from (x, y)
//! to (x + 1, y + 1). A point is given in whole [parts](Parts) of a cell, so that all geometry is exact.

mod legality;
mod random;
mod search;
mod validate;

use mediant_grid::{DiagonalGap, Grid, Rules, Vertex};

pub use legality::{point_is_free, segment_between_points_is_legal, turn_at_point_is_legal};
pub use random::{PointKind, magnified, random_free_point, random_point};
pub use search::{PointCosts, PointVisibility};
pub use validate::{PointFault, validate_between_points};

use crate::describe;

/// The number of parts that a cell is wide and high: coordinates of points are multiples of 1/1024.
pub const PARTS_PER_CELL: i64 = 1024;

/// A point (x, y) in corner placement, in parts of a cell: (512, 1024) is (0.5, 1).
pub type Parts = (i64, i64);

/// A vertex of corner placement as a point.
fn point_of(vertex: Vertex) -> Parts {
    (i64::from(vertex.x) * PARTS_PER_CELL, i64::from(vertex.y) * PARTS_PER_CELL)
}

/// The vertex of corner placement at this point, if it is one; it may lie outside the map.
fn vertex_at((x, y): Parts) -> Option<Vertex> {
    let whole = |n: i64| i32::try_from(n / PARTS_PER_CELL).ok().filter(|_| n % PARTS_PER_CELL == 0);
    Some(Vertex::new(whole(x)?, whole(y)?))
}

/// The Euclidean distance between two points, in cells.
fn distance(a: Parts, b: Parts) -> f64 {
    // The differences are exact up to 2⁵³ parts, far beyond a map.
    let along = |a: i64, b: i64| (a as f64 - b as f64) / PARTS_PER_CELL as f64;
    along(a.0, b.0).hypot(along(a.1, b.1))
}

/// [`describe`](crate::describe) for a query between two points. `s` and `g` mark their cells.
#[must_use]
pub fn describe_points(grid: &Grid, gap: DiagonalGap, start: Parts, goal: Parts, seed: u64) -> String {
    let cell = |(x, y): Parts| {
        let whole = |n: i64| i32::try_from(n.div_euclid(PARTS_PER_CELL)).unwrap_or(i32::MAX);
        Vertex::new(whole(x), whole(y))
    };
    let map = describe(grid, Rules::Corner(gap), cell(start), cell(goal), seed);
    format!("from {start:?} to {goal:?} in 1/{PARTS_PER_CELL} of a cell; their cells: {map}")
}
