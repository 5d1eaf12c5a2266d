//! Query errors in words.

use mediant_grid::{Centers, Corners, Grid, Placement, PlacementKind, Vertex};
use mediant_search::QueryError;

/// A query error in words; for a blocked end they name the nearest free vertex.
pub(crate) fn explain(error: QueryError, grid: &Grid, placement: PlacementKind) -> String {
    match error {
        QueryError::Blocked { at, .. } => match nearest_free(grid, placement, at) {
            Some(free) => format!("{error}; the nearest one is {free}"),
            None => error.to_string(),
        },
        _ => error.to_string(),
    }
}

/// The free vertex nearest to `at`, of equally near ones the first row by row; `None` if there is none
/// nearby.
fn nearest_free(grid: &Grid, placement: PlacementKind, at: Vertex) -> Option<Vertex> {
    /// How far away it may be, in each coordinate.
    const REACH: i32 = 64;
    let is_free = |v| match placement {
        PlacementKind::Center => Centers::is_free(grid, v),
        PlacementKind::Corner => Corners::is_free(grid, v),
    };
    let around =
        (-REACH..=REACH).flat_map(|dy| (-REACH..=REACH).map(move |dx| Vertex::new(at.x + dx, at.y + dy)));
    around.filter(|&v| is_free(v)).min_by_key(|&v| at.to(v).norm_squared())
}
