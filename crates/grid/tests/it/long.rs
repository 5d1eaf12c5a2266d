//! Maps with longer sides than engines without costs take: what a free space has on them.

use std::sync::Arc;

use mediant_grid::{
    Centers, Change, Connectivity, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, Interrupt, Placement,
    Rules, Vertex, sight::line_of_sight_under,
};
use mediant_oracle::{Rng, random_vertex, seeds, segment_is_legal};

/// Sides beyond [`Grid::MAX_SIDE`], one beyond the numbers of 16 bits, too.
const SIZES: [(u32, u32); 4] = [(40_000, 20), (20, 40_000), (100_000, 3), (2, 70_001)];

fn long((width, height): (u32, u32), blocked: impl FnMut(u32, u32) -> bool) -> Arc<Grid> {
    Arc::new(Grid::long(width, height, &Interrupt::NEVER, blocked).expect("a size that long maps have"))
}

/// A map where one in `few` cells is blocked, none of them far from others on the long way.
fn random(rng: &mut Rng, size: (u32, u32), few: u32) -> Arc<Grid> {
    long(size, |_, _| rng.below(few) == 0)
}

/// The map with rows and columns exchanged.
fn turned(grid: &Grid) -> Arc<Grid> {
    long((grid.height(), grid.width()), |x, y| grid.is_blocked(y as i32, x as i32))
}

/// A part of a map, from a cell on.
fn part(grid: &Grid, (left, top): (i32, i32), side: u32) -> Grid {
    let cell = |x: u32, y: u32| grid.is_blocked(left + x as i32, top + y as i32);
    Grid::from_fn(side, side, cell).expect("a usual size")
}

#[test]
fn cells_and_bits_are_where_they_belong() {
    for size in SIZES {
        let pattern = |x: u32, y: u32| (x ^ y).wrapping_mul(0x9e37_79b9) >> 30 == 0;
        let grid = long(size, pattern);
        assert!(grid.is_long() && !part(&grid, (0, 0), 5).is_long());
        let mut free = 0;
        for (x, y) in (0..size.1).flat_map(|y| (0..size.0).map(move |x| (x, y))) {
            let (column, row) = (x as i32, y as i32);
            let found = [grid.rows().get(column, row), grid.columns().get(row, column)];
            assert_eq!(found, [pattern(x, y); 2], "({x}, {y})");
            free += u64::from(!pattern(x, y));
        }
        assert_eq!(grid.free_cells(), free);
        for (x, y) in [(-1, 0), (0, -1), (size.0 as i32, 0), (0, size.1 as i32), (i32::MAX, i32::MIN)] {
            assert!(grid.is_blocked(x, y));
        }
    }
}

#[test]
fn sight_is_that_of_the_brute_force() {
    let mut seen = [0; 2];
    for seed in seeds(12) {
        let mut rng = Rng::new(seed);
        let size = SIZES[(seed % 4) as usize];
        let (sparse, dense) = (random(&mut rng, size, 100_000), random(&mut rng, size, 6));
        let turned = [&sparse, &dense].map(|grid| turned(grid));
        for rules in Rules::ALL {
            for query in 0..24 {
                let (grid, turned) = [(&sparse, &turned[0]), (&dense, &turned[1])][query % 2];
                let from = random_vertex(&mut rng, grid, rules.placement());
                // Across the whole map on the one, near by on the other.
                let to = match query % 2 {
                    0 if query == 0 => random_vertex(&mut rng, grid, rules.placement()),
                    _ => Vertex::new(from.x + rng.below(9) as i32 - 4, from.y + rng.below(9) as i32 - 4),
                };
                let about = format!("seed {seed}: {from} → {to} on {size:?}, {rules}");
                let is_legal = segment_is_legal(grid, rules, from, to);
                assert_eq!(line_of_sight_under(grid, rules, from, to), is_legal, "{about}");
                let [turned_from, turned_to] = [from, to].map(|at| Vertex::new(at.y, at.x));
                assert_eq!(line_of_sight_under(turned, rules, turned_from, turned_to), is_legal, "{about}");
                seen[usize::from(is_legal)] += 1;
            }
        }
    }
    assert!(seen.iter().all(|&seen| seen > 50), "{seen:?}");
}

/// Long segments, of which it is known by counting what they cross.
#[test]
fn the_longest_segments_are_judged_to_the_last_cell() {
    for (length, wall) in [(40_000_i32, 39_998), (100_000, 33_000), (1 << 20, 1_048_570), (1 << 20, 700_001)]
    {
        // A staircase of two rows: the line from (0, 0) to (length − 1, 1) changes its row in the middle.
        let row = i32::from(2 * wall >= length);
        for (blocked_row, is_free) in [(row, false), (1 - row, true)] {
            let blocked = |x: u32, y: u32| (x as i32, y as i32) == (wall, blocked_row);
            let grid = long((length as u32, 2), blocked);
            let ends = [Vertex::new(0, 0), Vertex::new(length - 1, 1)];
            let rules = Rules::Center(CornerRule::Never);
            let seen = line_of_sight_under(&grid, rules, ends[0], ends[1]);
            assert_eq!(seen, is_free, "{length}, {wall}");
            assert_eq!(line_of_sight_under(&grid, rules, ends[1], ends[0]), is_free, "{length}, {wall}");
            let turned = turned(&grid);
            let [a, b] = ends.map(|at| Vertex::new(at.y, at.x));
            assert_eq!(line_of_sight_under(&turned, rules, a, b), is_free, "{length}, {wall}");
        }
    }
}

/// A number for each cell, the same for those that are joined: found by steps from cell to cell.
fn flood(grid: &Grid, connectivity: Connectivity) -> Vec<Option<u32>> {
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    let index = |x: i32, y: i32| (y * width + x) as usize;
    let mut found = vec![None; (width * height) as usize];
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        if grid.is_blocked(x, y) || found[index(x, y)].is_some() {
            continue;
        }
        let (label, mut open) = (index(x, y) as u32, vec![(x, y)]);
        found[index(x, y)] = Some(label);
        while let Some((x, y)) = open.pop() {
            for (dx, dy) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))) {
                let to = (x + dx, y + dy);
                let meets = connectivity == Connectivity::Eight || dx == 0 || dy == 0;
                if meets && grid.is_free(to.0, to.1) && found[index(to.0, to.1)].is_none() {
                    found[index(to.0, to.1)] = Some(label);
                    open.push(to);
                }
            }
        }
    }
    found
}

fn check_components<P: Placement>(space: &FreeSpace<P>, connectivity: Connectivity, about: &str) {
    let (grid, components) = (space.grid(), space.components());
    let mut names = std::collections::HashMap::new();
    for (label, number) in flood(grid, connectivity).into_iter().zip(0..) {
        let at = Vertex::new(number % grid.width() as i32, number / grid.width() as i32);
        let component = components.of(at);
        assert_eq!(component.is_some(), label.is_some(), "{at}: {about}");
        if let (Some(component), Some(label)) = (component, label) {
            assert_eq!(*names.entry(label).or_insert(component), component, "{at}: {about}");
        }
    }
    let different: std::collections::HashSet<_> = names.values().collect();
    assert_eq!((different.len(), components.count() as usize), (names.len(), names.len()), "{about}");
}

#[test]
fn components_and_gaps_follow_edits_at_the_far_end() {
    for seed in seeds(8) {
        let mut rng = Rng::new(seed);
        let size = SIZES[(seed % 4) as usize];
        let mut grid = random(&mut rng, size, 4);
        let mut four = FreeSpace::<Corners>::new(Arc::clone(&grid), DiagonalGap::Closed);
        let mut eight = FreeSpace::<Centers>::new(Arc::clone(&grid), CornerRule::Always);
        for edit in 0..2 {
            let about = format!("seed {seed}, edit {edit} on {size:?}");
            let cells: Vec<_> = (0..40)
                .map(|_| {
                    let near_the_end = |side: u32, rng: &mut Rng| side - 1 - rng.below(side.min(200));
                    (near_the_end(size.0, &mut rng), near_the_end(size.1, &mut rng), rng.chance(50))
                })
                .collect();
            let change = Change::new(Arc::clone(&grid)).edit_cells(cells.iter().copied());
            (four, eight) = (four.after(&change), eight.after(&change));
            let mut blocked: std::collections::HashMap<_, _> =
                cells.iter().map(|&(x, y, blocked)| ((x, y), blocked)).collect();
            let cell = |x: u32, y: u32| {
                blocked.remove(&(x, y)).unwrap_or_else(|| grid.is_blocked(x as i32, y as i32))
            };
            let anew = long(size, cell);
            assert_eq!((&**four.grid(), four.grid().id()), (&*anew, anew.id()), "{about}");
            grid = Arc::clone(four.grid());
            check_components(&four, Connectivity::Four, &about);
            check_components(&eight, Connectivity::Eight, &about);
            for _ in 0..3000 {
                let at = random_vertex(&mut rng, &grid, mediant_grid::PlacementKind::Corner);
                assert_eq!(four.is_closed_gap(at), grid.is_gap(at), "{at}: {about}");
                let id = four.id(at).expect("on the map");
                assert_eq!(four.vertex(id), at, "{about}");
            }
        }
    }
}
