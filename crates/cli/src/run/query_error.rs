//! Ends errors in words.

use mediant::{PlacementKind, Point, Vertex, errors::QueryError, grid::Grid};

use crate::{map::NamedMap, terminal::numbers::rounded};

/// A query error in words; for a blocked end they name the nearest free vertex, and the radius if that is the
/// reason. Under `--world` they say it in meters, too.
pub(crate) fn explain(error: QueryError, map: &NamedMap, placement: PlacementKind) -> String {
    let QueryError::Blocked { end, at } = error else { return error.to_string() };
    let vertex = at.floor();
    let reason = if map.radius > 0.0 && placement.is_free(&map.ground, vertex) {
        let meters = map.frame.map(|frame| rounded(map.radius * frame.resolution()));
        let meters = meters.map_or_else(String::new, |meters| format!(" ({meters} m)"));
        format!("the {end} {at} is too near to an obstacle for a radius of {:.4} cells{meters}", map.radius)
    } else {
        error.to_string()
    };
    let free = nearest_free(&map.grid, placement, vertex);
    let nearest = free.map_or_else(String::new, |free| format!("; the nearest one is {free}"));
    let Some(frame) = map.frame else { return reason + &nearest };
    let in_world = |at: Point| {
        let (x, y) = frame.point_of(placement, at);
        format!("({x:.3}, {y:.3}) m")
    };
    let nearest_in_world =
        free.map_or_else(String::new, |free| format!(", the nearest one at {}", in_world(free.into())));
    format!("{reason}{nearest}; in the world the {end} is at {}{nearest_in_world}", in_world(at))
}

/// The free vertex nearest to `at`, of equally near ones the first row by row; `None` if there is none
/// nearby.
fn nearest_free(grid: &Grid, placement: PlacementKind, at: Vertex) -> Option<Vertex> {
    /// The greatest distance, in each coordinate.
    const REACH: i32 = 64;
    let around =
        (-REACH..=REACH).flat_map(|dy| (-REACH..=REACH).map(move |dx| Vertex::new(at.x + dx, at.y + dy)));
    around.filter(|&v| placement.is_free(grid, v)).min_by_key(|&v| at.to(v).norm_squared())
}
