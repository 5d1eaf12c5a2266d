//! The vertices nearest to a place.

use mediant_grid::{Point, Vertex};
use mediant_moves::Cost;

use super::EndSpace;
use crate::metric::Metric;

/// The nearest vertices to `to` that `accepts` accepts, row by row, and their distance. Looks at the vertices
/// around `to`, row by row, as far as the nearest one.
///
/// Along a row, and along the column of `to`, both metrics grow with the distance, and none is less than it.
pub(super) fn nearest(
    space: &impl EndSpace,
    metric: Metric,
    to: Point,
    accepts: impl Fn(Vertex) -> bool,
) -> Option<(Cost, Vec<Vertex>)> {
    let (width, height) = space.size();
    let (width, height) = (width as i32, height as i32);
    let (low, high) = (to.floor(), to.ceil());
    let mut best: Option<(Cost, Vec<Vertex>)> = None;
    // Nothing that is farther along an axis, in whole cells, is as near as the best one.
    let mut reach = i32::MAX;
    // `to` lies at or between both, so one of them once if it is at a vertex.
    let away = |low: i32, high: i32, d: i32| {
        let is_one = d == 0 && low == high;
        [low - d, high + d].into_iter().take(if is_one { 1 } else { 2 })
    };
    for dy in 0..low.y.max(height - 1 - high.y) + 1 {
        if dy > reach {
            break;
        }
        for y in away(low.y, high.y, dy).filter(|y| (0..height).contains(y)) {
            for dx in 0..low.x.max(width - 1 - high.x) + 1 {
                if dx > reach {
                    break;
                }
                let columns = away(low.x, high.x, dx).filter(|x| (0..width).contains(x));
                let mut is_found = false;
                for at in columns.map(|x| Vertex::new(x, y)).filter(|&at| accepts(at)) {
                    is_found = true;
                    let cost = metric.between(at.into(), to);
                    match &mut best {
                        Some((least, _)) if *least < cost => {}
                        Some((least, vertices)) if *least == cost => vertices.push(at),
                        _ => {
                            reach = i32::try_from(cost.to_bits() >> Cost::FRACTION_BITS).unwrap_or(i32::MAX);
                            best = Some((cost, vec![at]));
                        }
                    }
                }
                if is_found {
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
