//! Maps with other cells in a rectangle.

use std::sync::Arc;

use mediant_grid::{Change, Grid, Rectangle};
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

/// Random maps and edits by seed: the identity of an edited map is that of the same map made anew, and a
/// change knows its cells: all that differ, and in each of its rectangles some on every side, if they were
/// found by comparing the maps.
#[test]
fn changes_know_their_cells() {
    let mut random = Rng::new(16);
    for case in 0..400 {
        let (width, height) = (1 + random.below(200), 1 + random.below(90));
        let cells: Vec<bool> = (0..width * height).map(|_| random.below(3) == 0).collect();
        let before = Grid::from_fn(width, height, |x, y| cells[(y * width + x) as usize]).expect("a map");
        let before = Arc::new(before);
        let mut change = Change::new(Arc::clone(&before));
        for _ in 0..random.below(4) {
            change = if random.below(2) == 0 {
                let [x, y] = [width, height].map(|side| random.below(side + 3));
                let [w, h] = [width, height].map(|side| random.below(side.min(20) + 3));
                change.edit(Rectangle::new(x, y, w, h), |_, _| random.below(3) == 0)
            } else {
                let count = random.below(6);
                let at = |random: &mut Rng| (random.below(width + 2), random.below(height + 2), true);
                change.edit_cells((0..count).map(|_| at(&mut random)).collect::<Vec<_>>())
            };
        }
        let after = Arc::clone(change.after());
        let anew = Grid::from_fn(width, height, |x, y| after.is_blocked(x as i32, y as i32)).expect("a map");
        assert_eq!(*after, anew, "case {case}");
        let differs =
            |x: u32, y: u32| before.is_free(x as i32, y as i32) != after.is_free(x as i32, y as i32);
        let between = Change::between(Arc::clone(&before), Arc::clone(&after)).expect("the same size");
        for known in [&change, &between] {
            let holds = |x: u32, y: u32| known.cells().iter().any(|at| contains(*at, x, y));
            let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
            assert!(all.into_iter().all(|(x, y)| !differs(x, y) || holds(x, y)), "case {case}: {known:?}");
        }
        for &Rectangle { x, y, width: w, height: h } in between.cells() {
            let some =
                |x0: u32, y0: u32, w: u32, h: u32| (y0..y0 + h).any(|y| (x0..x0 + w).any(|x| differs(x, y)));
            let sides = [(x, y, w, 1), (x, y + h - 1, w, 1), (x, y, 1, h), (x + w - 1, y, 1, h)];
            assert!(sides.iter().all(|&(x, y, w, h)| some(x, y, w, h)), "case {case}: ({x}, {y})");
            assert_eq!((x / 64, y / 64), ((x + w - 1) / 64, (y + h - 1) / 64), "case {case}");
        }
        let back = Change::between(Arc::clone(&after), Arc::clone(&before)).expect("the same size");
        let there_and_back = change.then(back).expect("it goes on where the first ended");
        assert_eq!(there_and_back.after(), &before, "case {case}");
    }
}

fn contains(Rectangle { x: x0, y: y0, width, height }: Rectangle, x: u32, y: u32) -> bool {
    (x0..x0 + width).contains(&x) && (y0..y0 + height).contains(&y)
}

#[test]
fn what_does_not_follow_is_no_change() {
    let [one, other] =
        [(4, 3), (3, 4)].map(|(w, h)| Arc::new(Grid::from_fn(w, h, |_, _| false).expect("a map")));
    assert!(Change::between(Arc::clone(&one), Arc::clone(&other)).is_none());
    assert!(Change::new(Arc::clone(&one)).then(Change::new(other)).is_none());
    let none = Change::new(Arc::clone(&one)).edit(Rectangle::new(9, 9, 2, 2), |_, _| true);
    assert!(none.cells().is_empty() && Arc::ptr_eq(none.after(), &one));
}
