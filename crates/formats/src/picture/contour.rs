//! Contour lines of a field, by marching squares.

use mediant_grid::PlacementKind;

use super::{Picture, vertex_colors::range};

/// About so many lines are drawn.
const LINES: f32 = 20.0;

/// A piece of a contour line, in cells of the map.
pub(super) type Piece = [(f64, f64); 2];

/// The pieces of all contour lines, at round values that are equally far apart; none where a pixel covers
/// several cells. A line is drawn between four vertices that all have a value, at corners if the cell between
/// them is free.
pub(super) fn lines(picture: &Picture<'_>) -> Vec<Piece> {
    let Some((least, greatest)) = range(&picture.field) else { return Vec::new() };
    let step = round_step((greatest - least) / LINES);
    if !picture.has_contours || picture.layout().cells > 1 || !step.is_finite() || step <= 0.0 {
        return Vec::new();
    }
    let (columns, _) = picture.vertices();
    let shift = if picture.placement == PlacementKind::Center { 0.5 } else { 0.0 };
    let mut pieces = Vec::new();
    let rows = picture.field.chunks(columns as usize);
    for ((above, below), y) in rows.clone().zip(rows.skip(1)).zip(0..) {
        for ((above, below), x) in above.windows(2).zip(below.windows(2)).zip(0..) {
            // Clockwise from the upper left.
            let values = [above[0], above[1], below[1], below[0]];
            let is_wall = picture.placement == PlacementKind::Corner && picture.grid.is_blocked(x, y);
            if is_wall || values.iter().any(|value| value.is_nan()) {
                continue;
            }
            square(
                values,
                step,
                |(px, py)| (f64::from(x) + shift + px, f64::from(y) + shift + py),
                &mut pieces,
            );
        }
    }
    pieces
}

/// The least of 1, 2, 5, 10, … and their decimal parts that is at least this.
fn round_step(least: f32) -> f32 {
    let mut step = 1e-6_f32;
    while step.is_finite() {
        for factor in [1.0, 2.0, 5.0] {
            if step * factor >= least {
                return step * factor;
            }
        }
        step *= 10.0;
    }
    step
}

/// The lines through a square of four vertices. Of a saddle, the two lines go around the corners that are
/// above the level.
fn square(values: [f32; 4], step: f32, place: impl Fn((f64, f64)) -> (f64, f64), pieces: &mut Vec<Piece>) {
    const CORNERS: [(f64, f64); 4] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let [low, high] =
        [values.into_iter().fold(f32::MAX, f32::min), values.into_iter().fold(f32::MIN, f32::max)];
    let first = (low / step).floor() + 1.0;
    // A cliff would have more lines than can be seen.
    for line in (0..8_u8).map(|i| (first + f32::from(i)) * step).take_while(|&level| level <= high) {
        let mut crossings = [(0.0, 0.0); 4];
        let mut count = 0;
        for side in 0..4 {
            let (a, b) = (values[side], values[(side + 1) % 4]);
            if (a < line) != (b < line) {
                let t = f64::from((line - a) / (b - a));
                let ((ax, ay), (bx, by)) = (CORNERS[side], CORNERS[(side + 1) % 4]);
                crossings[count] = place((ax + t * (bx - ax), ay + t * (by - ay)));
                count += 1;
            }
        }
        let [a, b, c, d] = crossings;
        match count {
            // A line that only meets a vertex has no length.
            2 if a == b => {}
            2 => pieces.push([a, b]),
            4 if values[0] < line => pieces.extend([[a, b], [c, d]]),
            4 => pieces.extend([[d, a], [b, c]]),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use mediant_grid::{AsciiMap, Vertex};
    use mediant_oracle::{Rng, random_grid, seeds};

    use super::*;

    #[test]
    fn steps_are_round() {
        for (least, step) in [(0.9, 1.0), (1.1, 2.0), (2.5, 5.0), (6.0, 10.0), (0.03, 0.05), (1500.0, 2000.0)]
        {
            let found = round_step(least);
            assert!((found - step).abs() < 1e-5 * step, "{found}, not {step}");
        }
        assert!(round_step(f32::NAN).is_infinite() && round_step(f32::INFINITY).is_infinite());
    }

    /// Both ends of each piece are on sides of squares, at places where the value is that of a line.
    #[test]
    fn lines_join_equal_values() {
        let mut count = 0;
        for seed in seeds(40) {
            let (grid, kind) = random_grid(seed);
            let rng = &mut Rng::new(seed);
            let values: Vec<f64> = (0..25 * 25).map(|_| f64::from(rng.below(50))).collect();
            let value = |x: usize, y: usize| values[25 * y + x];
            let field = |at: Vertex| Some(value(at.x as usize, at.y as usize)).filter(|&value| value > 1.0);
            let picture = Picture::new(&grid, PlacementKind::Corner).field(field);
            let Some((least, greatest)) = range(&picture.field) else { continue };
            let step = f64::from(round_step((greatest - least) / LINES));
            for (x, y) in lines(&picture).into_iter().flatten() {
                let (left, top) = (x.floor() as usize, y.floor() as usize);
                let (dx, dy) = (x - x.floor(), y - y.floor());
                assert!(dx == 0.0 || dy == 0.0, "seed {seed}: {kind}, ({x}, {y})");
                let along = |a: f64, b: f64, t: f64| if t > 0.0 { a + t * (b - a) } else { a };
                let next = if dx > 0.0 { value(left + 1, top) } else { value(left, (top + 1).min(24)) };
                let found = along(value(left, top), next, dx.max(dy)) / step;
                assert!((found - found.round()).abs() < 1e-4, "seed {seed}: {kind}, ({x}, {y}): {found}");
                count += 1;
            }
        }
        assert!(count > 1000, "{count}");
    }

    #[test]
    fn lines_go_around_the_high_corners_of_a_saddle() {
        let of = |values| {
            let mut pieces = Vec::new();
            square(values, 1.0, |at| at, &mut pieces);
            pieces.iter_mut().for_each(|ends: &mut Piece| ends.sort_by(|a, b| a.0.total_cmp(&b.0)));
            pieces
        };
        let falling = [[(0.0, 0.5), (0.5, 0.0)], [(0.5, 1.0), (1.0, 0.5)]];
        assert_eq!(of([1.5, 0.5, 1.5, 0.5]), falling);
        let rising = [[(0.5, 0.0), (1.0, 0.5)], [(0.0, 0.5), (0.5, 1.0)]];
        assert_eq!(of([0.5, 1.5, 0.5, 1.5]), rising);
    }

    #[test]
    fn walls_and_vertices_without_value_have_no_lines() {
        let map = AsciiMap::parse("..\n#.").expect("it is a map");
        let picture = Picture::new(&map.grid, PlacementKind::Corner);
        let all = lines(&picture.clone().field(|at| Some(f64::from(at.x))));
        assert!(all.iter().flatten().all(|&(x, y)| x >= 1.0 || y <= 1.0) && !all.is_empty());
        let some = lines(&picture.clone().field(|at| (at.x != 1).then_some(f64::from(at.y))));
        assert!(some.is_empty());
        assert!(lines(&picture.clone().field(|_| Some(3.0))).is_empty());
        assert!(lines(&picture).is_empty());
    }
}
