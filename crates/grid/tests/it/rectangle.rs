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

/// Random maps and edits by seed: the identity of an edited map is that of the same map made anew, and two
/// maps are compared as cell by cell.
#[test]
fn edits_keep_identity_and_comparison_right() {
    let mut random = Rng::new(16);
    for case in 0..400 {
        let (width, height) = (1 + random.below(140), 1 + random.below(9));
        let cells: Vec<bool> = (0..width * height).map(|_| random.below(3) == 0).collect();
        let before = Grid::from_fn(width, height, |x, y| cells[(y * width + x) as usize]).expect("a map");
        let side = |random: &mut Rng, length| (random.below(length + 3), random.below(length + 3));
        let ((x, w), (y, h)) = (side(&mut random, width), side(&mut random, height));
        let at = Rectangle { x, y, width: w, height: h };
        let after = before.with_rectangle(at, |_, _| random.below(3) == 0);
        let anew = Grid::from_fn(width, height, |x, y| after.is_blocked(x as i32, y as i32)).expect("a map");
        assert_eq!(after, anew, "case {case}");
        assert!(after.equals_outside(&before, at), "case {case}: {at:?}");

        let differs =
            |x: u32, y: u32| before.is_free(x as i32, y as i32) != after.is_free(x as i32, y as i32);
        let all =
            || (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).filter(|&(x, y)| differs(x, y));
        let bounds = |of: fn((u32, u32)) -> u32| {
            let first = all().map(of).min().unwrap_or(0);
            (first, all().map(of).max().map_or(0, |last| last + 1 - first))
        };
        let ((x, width), (y, height)) = (bounds(|(x, _)| x), bounds(|(_, y)| y));
        let expected = Rectangle { x, y, width, height };
        assert_eq!(after.difference(&before), Some(expected), "case {case}");
        // One column or row less, and they differ outside.
        if width > 0 {
            let less = [
                Rectangle { x: x + 1, width: width - 1, ..expected },
                Rectangle { width: width - 1, ..expected },
                Rectangle { y: y + 1, height: height - 1, ..expected },
                Rectangle { height: height - 1, ..expected },
            ];
            assert!(less.iter().all(|&less| !after.equals_outside(&before, less)), "case {case}");
        }
    }
}

#[test]
fn maps_of_other_sizes_have_no_difference() {
    let [one, other] = [(4, 3), (3, 4)].map(|(w, h)| Grid::from_fn(w, h, |_, _| false).expect("a map"));
    assert_eq!(one.difference(&other), None);
    assert!(!one.equals_outside(&other, Rectangle { x: 0, y: 0, width: 9, height: 9 }));
}
