//! Components where tiles of 64 × 64 cells meet, and after small changes within them, against flooding.
//!
//! Maps of noise seldom have regions that meet at the corner of a tile alone. Here they have nothing else.

use std::sync::Arc;

use mediant_grid::{Change, Components, Connectivity, Grid, Rectangle};
use mediant_oracle::{Rng, on_all_cores, seeds};

use crate::legality::{flood, same_partition};

const BOTH: [Connectivity; 2] = [Connectivity::Four, Connectivity::Eight];

fn check(components: &Components, grid: &Grid, connectivity: Connectivity, message: &str) {
    same_partition(components, &flood(grid, connectivity), &format!("{message}, {connectivity:?}"));
}

/// The four cells at a point where four tiles meet, in all states and after all changes from one to another.
/// The last tiles are two columns wide and one row high.
#[test]
fn tiles_meet_at_their_corners() {
    let corners = [(64, 64), (128, 64), (64, 128), (128, 128)];
    on_all_cores(0..64, |case| {
        let ((x, y), state) = (corners[case as usize / 16], case as u32 % 16);
        let cells = [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)];
        let is_free = |state: u32, i: usize| state >> i & 1 == 1;
        let free = |cell| cells.iter().position(|&other| other == cell).is_some_and(|i| is_free(state, i));
        let map = Arc::new(Grid::from_fn(130, 129, |x, y| !free((x, y))).expect("a map"));
        for connectivity in BOTH {
            let components = Components::new(&map, connectivity);
            let message = format!("corner ({x}, {y}), free cells {state:04b}");
            check(&components, &map, connectivity, &message);
            for next in 0..16 {
                let edits = (0..4).map(|i| (cells[i].0, cells[i].1, !is_free(next, i)));
                let change = Change::new(Arc::clone(&map)).edit_cells(edits);
                let after = components.after(&change);
                check(&after, change.after(), connectivity, &format!("{message}, then {next:04b}"));
            }
        }
    });
}

/// A map whose free cells all lie along the borders of tiles, so that each touches another tile or its
/// corner; and edits of single cells there, many at a corner.
#[test]
fn components_along_the_borders_of_tiles_follow_edits() {
    on_all_cores(seeds(8), |seed| {
        let mut rng = Rng::new(seed);
        let (width, height, percent) = (129 + rng.below(70), 129 + rng.below(70), 20 + rng.below(60));
        let is_near = |at: u32| matches!(at % 64, 0 | 1 | 62 | 63);
        let grid =
            Grid::from_fn(width, height, |x, y| !(is_near(x) || is_near(y)) || rng.below(100) < percent);
        let mut map = Arc::new(grid.expect("a map"));
        let mut components = BOTH.map(|connectivity| Components::new(&map, connectivity));
        for step in 0..25 {
            let along = if rng.below(3) == 0 { rng.below(60) } else { 0 };
            let (right, down) = if rng.below(2) == 0 { (along, 0) } else { (0, along) };
            let mut near_corner =
                |beyond: u32, side: u32| (64 * (1 + rng.below(2)) + beyond + rng.below(4) - 2).min(side - 1);
            let at = (near_corner(right, width), near_corner(down, height));
            let blocked = map.is_free(at.0 as i32, at.1 as i32);
            let change = Change::new(map).edit_cells([(at.0, at.1, blocked)]);
            map = Arc::clone(change.after());
            for (components, connectivity) in components.iter_mut().zip(BOTH) {
                *components = components.after(&change);
                check(components, &map, connectivity, &format!("seed {seed}, edit {step} at {at:?}"));
            }
        }
    });
}

/// Boxes of up to 7 × 7 cells change within a tile. Most such changes join and part nothing, and write the
/// labels of a few rows alone. Half of the maps are nearly free: many rows are one run of 64 cells.
#[test]
fn components_follow_small_changes_within_a_tile() {
    on_all_cores(seeds(12), |seed| {
        let mut rng = Rng::new(seed);
        let percent = if seed % 2 == 0 { 2 } else { 20 + rng.below(40) };
        let (width, height) = (64 + rng.below(2) * rng.below(64), 10 + rng.below(56));
        let grid = Grid::from_fn(width, height, |_, _| rng.below(100) < percent);
        let mut map = Arc::new(grid.expect("a map"));
        let mut components = BOTH.map(|connectivity| Components::new(&map, connectivity));
        for step in 0..25 {
            let [wide, high] = [0; 2].map(|_| 1 + rng.below(7));
            let at = Rectangle {
                x: rng.below(64 - wide + 1),
                y: rng.below(height - high + 1),
                width: wide,
                height: high,
            };
            let blocked = [0, 20, 50, 100][rng.below(4) as usize];
            let change = Change::new(map).edit(at, |_, _| rng.below(100) < blocked);
            map = Arc::clone(change.after());
            for (components, connectivity) in components.iter_mut().zip(BOTH) {
                *components = components.after(&change);
                check(components, &map, connectivity, &format!("seed {seed}, edit {step} of {at:?}"));
            }
        }
    });
}
