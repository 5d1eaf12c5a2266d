//! The vertices nearest to a place.

use mediant_grid::{FreeSpace, Placement, Vector, Vertex};
use mediant_moves::Cost;

use crate::metric::Metric;

/// The nearest vertices to `to` that `accepts` accepts, row by row, and their distance. Looks at the vertices
/// around `to`, row by row, as far as the nearest one.
///
/// Along a row, and along the column of `to`, both metrics grow with the distance, and none is less than it.
pub(super) fn nearest<P: Placement>(
    space: &FreeSpace<P>,
    metric: Metric,
    to: Vertex,
    accepts: impl Fn(Vertex) -> bool,
) -> Option<(Cost, Vec<Vertex>)> {
    let (width, height) = P::vertices(space.grid());
    let (width, height) = (width as i32, height as i32);
    let mut best: Option<(Cost, Vec<Vertex>)> = None;
    // Nothing that is farther along an axis, in whole cells, is as near as the best one.
    let mut reach = i32::MAX;
    let away = |from: i32, d: i32| [from - d, from + d].into_iter().take(if d == 0 { 1 } else { 2 });
    for dy in 0..to.y.max(height - 1 - to.y) + 1 {
        if dy > reach {
            break;
        }
        for y in away(to.y, dy).filter(|y| (0..height).contains(y)) {
            for dx in 0..to.x.max(width - 1 - to.x) + 1 {
                if dx > reach {
                    break;
                }
                let columns = away(to.x, dx).filter(|x| (0..width).contains(x));
                let mut found = columns.map(|x| Vertex::new(x, y)).filter(|&at| accepts(at)).peekable();
                if found.peek().is_some() {
                    let cost = metric.distance(Vector::new(dx, dy));
                    match &mut best {
                        Some((least, _)) if *least < cost => {}
                        Some((least, vertices)) if *least == cost => vertices.extend(found),
                        _ => {
                            reach = i32::try_from(cost.to_bits() >> Cost::FRACTION_BITS).unwrap_or(i32::MAX);
                            best = Some((cost, found.collect()));
                        }
                    }
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
