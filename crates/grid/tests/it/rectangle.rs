//! Maps with other cells in a rectangle.

use mediant_grid::{Grid, Rectangle};
use mediant_oracle::{Rng, random_grid};

#[test]
fn other_cells_in_a_rectangle_make_the_grid_that_has_them() {
    for seed in 0..300 {
        let (grid, mut rng) = (random_grid(seed).0, Rng::new(seed));
        // Some rectangles reach beyond the map, or lie there, and some are empty.
        let mut number = |most: u32| if rng.below(8) == 0 { u32::MAX } else { rng.below(most + 3) };
        let (width, height) = (grid.width(), grid.height());
        let at =
            Rectangle { x: number(width), y: number(height), width: number(width), height: number(height) };
        let is_new = |x: u32, y: u32| (x * 7 + y * 13 + seed as u32).is_multiple_of(3);
        let is_in = |first: u32, length: u32, i: u32| i >= first && i - first < length;
        let expected = Grid::from_fn(width, height, |x, y| {
            let is_inside = is_in(at.x, at.width, x) && is_in(at.y, at.height, y);
            if is_inside { is_new(x, y) } else { grid.is_blocked(x as i32, y as i32) }
        });
        assert_eq!(Ok(grid.with_rectangle(at, is_new)), expected, "{at:?}, seed {seed}");
    }
}
