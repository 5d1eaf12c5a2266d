//! The cells that a segment between points meets, in order.

use crate::Point;

/// The cells that the straight segment between two points touches at any angle, from its start to its end,
/// as (x, y): those whose open interior it meets, and along a grid line those on both sides, of each step
/// first the one above or to the left. A segment of length 0 touches the cell of its point, the one below
/// and to the right if it is on a line. Points are less than 2²⁰ cells apart along each axis and from (0,
/// 0); cells of others are not told.
///
/// ```
/// use mediant_grid::sight::point_cells;
/// let cells = |from: (f64, f64), to: (f64, f64)| point_cells(from.into(), to.into());
/// assert_eq!(cells((0.5, 0.5), (2.5, 0.75)), [(0, 0), (1, 0), (2, 0)]);
/// assert_eq!(cells((1.5, 1.5), (0.5, 0.5)), [(1, 1), (0, 0)]);
/// assert_eq!(cells((0.5, 1.0), (1.5, 1.0)), [(0, 0), (0, 1), (1, 0), (1, 1)]);
/// ```
#[must_use]
pub fn point_cells(from: Point, to: Point) -> Vec<(i32, i32)> {
    const FAR: u64 = (Point::PARTS as u64) << 20;
    let ((ax, ay), (bx, by)) = (from.parts(), to.parts());
    if [ax, ay, bx, by].iter().any(|at| at.unsigned_abs() >= FAR) {
        return Vec::new();
    }
    // Rows are crossed one after another; of a segment that stays in a column those are columns.
    if ax == bx {
        let turned = cells((ay, ax), (by, bx));
        turned.into_iter().map(|(row, column)| (column, row)).collect()
    } else {
        cells((ax, ay), (bx, by))
    }
}

/// The same for a segment that does not go straight down or up, in parts of a cell.
fn cells((ax, ay): (i64, i64), (bx, by): (i64, i64)) -> Vec<(i32, i32)> {
    const ONE: i64 = Point::PARTS;
    let (floor, ceil) = (|x: i64, one: i64| x.div_euclid(one), |x: i64, one: i64| -(-x).div_euclid(one));
    let (is_down, down, length) = (by > ay, (by - ay).signum(), (by - ay).abs());
    // Columns of the cells between two places, in the order of the segment.
    let between = |low: i64, high: i64| {
        let columns = low as i32..high as i32;
        let (forward, backward) = if bx >= ax { (columns, 0..0) } else { (0..0, columns) };
        forward.chain(backward.rev())
    };
    if down == 0 {
        let (low, high) = (floor(ax.min(bx), ONE), ceil(ax.max(bx), ONE));
        let high = if ax == bx { low + 1 } else { high };
        let row = floor(ay, ONE) as i32;
        let is_line = ay % ONE == 0 && ax != bx;
        let rows = if is_line { row - 1..row + 1 } else { row..row + 1 };
        return between(low, high).flat_map(|column| rows.clone().map(move |row| (column, row))).collect();
    }
    let (first, last) =
        if is_down { (floor(ay, ONE), ceil(by, ONE) - 1) } else { (ceil(ay, ONE) - 1, floor(by, ONE)) };
    // In parts times the length, which 64 bits hold.
    let along = |y: i64| ax * length + (y - ay).abs() * (bx - ax);
    let (mut found, mut row, mut here) = (Vec::new(), first, ax * length);
    loop {
        let border = if is_down { row + 1 } else { row } * ONE;
        let next = if row == last { bx * length } else { along(border) };
        let (low, high) = (here.min(next), here.max(next));
        let columns = between(floor(low, ONE * length), ceil(high, ONE * length));
        found.extend(columns.map(|column| (column, row as i32)));
        if row == last {
            return found;
        }
        (row, here) = (row + down, next);
    }
}
