//! Random edits of maps.

use std::sync::Arc;

use mediant_grid::{Change, Grid, Rectangle};

use crate::{Rng, generate::noise};

/// A random edit of a map: mostly of one cell; else a rectangle of one kind or of noise, a room with a door,
/// scattered cells, two edits in one, or seldom the whole map.
#[must_use]
pub fn random_change(rng: &mut Rng, map: &Arc<Grid>) -> Change {
    let change = Change::new(Arc::clone(map));
    match rng.below(16) {
        0..7 => one_cell(rng, change),
        7..9 => {
            let (at, blocked) = (random_rectangle(rng, map), rng.below(2) == 0);
            change.edit(at, |_, _| blocked)
        }
        9..11 => {
            let (at, percent) = (random_rectangle(rng, map), rng.below(60));
            change.edit(at, |_, _| rng.below(100) < percent)
        }
        11 => room(rng, change),
        12..14 => scattered(rng, change),
        14 => {
            let first = one_cell(rng, change);
            scattered(rng, first)
        }
        _ => {
            let percent = rng.below(50);
            let other = noise(rng, map.width(), map.height(), percent);
            let all = Rectangle::new(0, 0, map.width(), map.height());
            change.edit(all, |x, y| other.is_blocked(x as i32, y as i32))
        }
    }
}

/// Opens or closes a cell.
fn one_cell(rng: &mut Rng, change: Change) -> Change {
    let map = change.after();
    let (x, y) = (rng.below(map.width()), rng.below(map.height()));
    let blocked = map.is_blocked(x as i32, y as i32);
    change.edit_cells([(x, y, !blocked)])
}

fn scattered(rng: &mut Rng, change: Change) -> Change {
    let (width, height) = (change.after().width(), change.after().height());
    let count = 1 + rng.below(12);
    let cells: Vec<_> =
        (0..count).map(|_| (rng.below(width), rng.below(height), rng.below(2) == 0)).collect();
    change.edit_cells(cells)
}

/// A rectangle of walls with a free inside, and an open or a closed door.
fn room(rng: &mut Rng, change: Change) -> Change {
    let at = random_rectangle(rng, change.after());
    let is_wall =
        |x: u32, y: u32| x == at.x || y == at.y || x + 1 == at.x + at.width || y + 1 == at.y + at.height;
    let change = change.edit(at, is_wall);
    let door = (at.x, at.y + rng.below(at.height));
    change.edit(Rectangle::new(door.0, door.1, 1, 1), |_, _| rng.below(3) == 0)
}

/// A rectangle of up to 20 columns and rows, part of which may lie beyond the map.
fn random_rectangle(rng: &mut Rng, map: &Grid) -> Rectangle {
    let [width, height] = [map.width(), map.height()].map(|side| 1 + rng.below(side.min(20)));
    Rectangle::new(rng.below(map.width()), rng.below(map.height()), width, height)
}
