//! The cells of a segment between points, against a legality test that shares no code with them.

use mediant_grid::{DiagonalGap, Grid, Point, sight::point_cells};
use mediant_oracle::{PARTS_PER_CELL, Rng, seeds, segment_between_points_is_legal};

/// The side of the maps.
const SIDE: i64 = 6;

/// A random point, often at a vertex, on a line or beside one.
fn random_point(rng: &mut Rng) -> (i64, i64) {
    let mut along = || {
        let cells = i64::from(rng.below(SIDE as u32 + 1)) * PARTS_PER_CELL;
        let aside = [0, 0, 512, 1, -1, i64::from(rng.below(1024))][rng.below(6) as usize];
        (cells + aside).clamp(0, SIDE * PARTS_PER_CELL)
    };
    (along(), along())
}

#[test]
fn the_cells_of_a_segment_are_those_that_block_it() {
    let mut along_lines = 0;
    for seed in seeds(1_500) {
        let mut rng = Rng::new(seed);
        let (from, to) = (random_point(&mut rng), random_point(&mut rng));
        let cells = point_cells(Point::from_parts(from.0, from.1), Point::from_parts(to.0, to.1));
        let case = format!("{from:?} to {to:?}, seed {seed}: {cells:?}");
        assert!(cells.windows(2).all(|two| two[0] != two[1]), "{case}");
        let is_on_line = |at: i64, other: i64| at == other && at % PARTS_PER_CELL == 0;
        if from == to || is_on_line(from.0, to.0) || is_on_line(from.1, to.1) {
            along_lines += u32::from(from != to);
            continue;
        }
        for (x, y) in (0..SIDE as i32).flat_map(|y| (0..SIDE as i32).map(move |x| (x, y))) {
            let only =
                Grid::from_fn(SIDE as u32, SIDE as u32, |column, row| (column as i32, row as i32) == (x, y));
            let only = only.expect("a small map");
            let is_blocked = !segment_between_points_is_legal(&only, DiagonalGap::Open, from, to);
            assert_eq!(cells.contains(&(x, y)), is_blocked, "cell ({x}, {y}), {case}");
        }
        // In order: each cell touches the one before.
        let touches = |(a, b): ((i32, i32), (i32, i32))| (a.0 - b.0).abs() <= 1 && (a.1 - b.1).abs() <= 1;
        assert!(cells.iter().copied().zip(cells.iter().copied().skip(1)).all(touches), "{case}");
        let back = point_cells(Point::from_parts(to.0, to.1), Point::from_parts(from.0, from.1));
        assert!(back.iter().rev().eq(&cells), "{case}, back {back:?}");
    }
    assert!(along_lines > 50, "{along_lines}");
}

#[test]
fn along_a_line_the_cells_of_both_sides_are_touched() {
    let cells = |from: (f64, f64), to: (f64, f64)| point_cells(from.into(), to.into());
    assert_eq!(cells((2.5, 1.0), (0.5, 1.0)), [(2, 0), (2, 1), (1, 0), (1, 1), (0, 0), (0, 1)]);
    assert_eq!(cells((1.0, 0.25), (1.0, 1.5)), [(0, 0), (1, 0), (0, 1), (1, 1)]);
    assert_eq!(cells((1.5, 0.25), (1.5, 1.5)), [(1, 0), (1, 1)]);
    assert_eq!(cells((1.5, 1.0), (1.5, 1.0)), [(1, 1)]);
    assert_eq!(point_cells(Point::from_parts(0, 0), Point::from_parts(i64::MAX, 0)), []);
    assert_eq!(point_cells(Point::from_parts(i64::MIN, 0), Point::from_parts(0, 0)), []);
}
