//! The vertices nearest to a place.

use mediant_grid::{FreeSpace, Placement, Vector, Vertex};
use mediant_moves::Cost;

use crate::metric::Metric;

/// Those vertices of the map that `accepts` accepts and that are nearest to `to`, row by row, and their
/// distance. Looks at the vertices around `to`, row by row, as far as the nearest one.
///
/// Along a row, and along the column of `to`, both metrics grow with the distance, and none is less than it.
pub(super) fn nearest<P: Placement>(
    space: &FreeSpace<P>,
    metric: &Metric,
    to: Vertex,
    accepts: impl Fn(Vertex) -> bool,
) -> Option<(Cost, Vec<Vertex>)> {
    let (width, height) = P::vertices(space.grid());
    let (width, height) = (width as i32, height as i32);
    let mut best: Option<(Cost, Vec<Vertex>)> = None;
    let reach = |best: &Option<(Cost, Vec<Vertex>)>| {
        best.as_ref().map_or(i32::MAX, |(cost, _)| {
            i32::try_from(cost.to_bits() >> Cost::FRACTION_BITS).unwrap_or(i32::MAX)
        })
    };
    for dy in 0..to.y.max(height - 1 - to.y) + 1 {
        if dy > reach(&best) {
            break;
        }
        for y in [to.y - dy, to.y + dy].into_iter().take(if dy == 0 { 1 } else { 2 }) {
            if !(0..height).contains(&y) {
                continue;
            }
            for dx in 0..to.x.max(width - 1 - to.x) + 1 {
                if dx > reach(&best) {
                    break;
                }
                let row = [to.x - dx, to.x + dx].map(|x| Vertex::new(x, y));
                let mut found = row.into_iter().take(if dx == 0 { 1 } else { 2 });
                let mut is_nearest = false;
                for at in found.by_ref().filter(|&at| (0..width).contains(&at.x) && accepts(at)) {
                    is_nearest = true;
                    let cost = metric.distance(Vector::new(dx, dy));
                    match &mut best {
                        Some((least, _)) if *least < cost => {}
                        Some((least, vertices)) if *least == cost => vertices.push(at),
                        _ => best = Some((cost, vec![at])),
                    }
                }
                if is_nearest {
                    break;
                }
            }
        }
    }
    if let Some((_, vertices)) = &mut best {
        vertices.sort_by_key(|at| (at.y, at.x));
    }
    best
}
