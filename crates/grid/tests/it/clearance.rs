//! Distances to obstacles against their definition: the nearest of all blocked cells, in integers.

use std::sync::Arc;

use mediant_grid::{Change, Clearance, Fit, Grid, Interrupt, Outside, SizeError, Vertex};
use mediant_oracle::{Rng, caves, noise, on_all_cores, random_change, rooms, seeds, suite_grid};

pub(crate) const KINDS: [(Fit, Outside); 4] = [
    (Fit::Centers, Outside::Blocked),
    (Fit::Centers, Outside::Open),
    (Fit::WholeCells, Outside::Blocked),
    (Fit::WholeCells, Outside::Open),
];

/// Twice the distance along one axis from a point, in half cells, to the closed cell number `cell`.
fn gap(point: i64, cell: i64) -> i64 {
    (2 * cell - point).max(point - 2 * cell - 2).max(0)
}

/// All that is blocked on a map.
struct Obstacles {
    cells: Vec<[i64; 2]>,
    /// The sides of the map in half cells, if the outside counts.
    sides: Option<[i64; 2]>,
}

impl Obstacles {
    fn new(grid: &Grid, outside: Outside) -> Self {
        let cells = (0..grid.height() as i32).flat_map(|y| (0..grid.width() as i32).map(move |x| (x, y)));
        let blocked = cells.filter(|&(x, y)| grid.is_blocked(x, y));
        let sides = [grid.width(), grid.height()].map(|side| 2 * i64::from(side));
        Self {
            cells: blocked.map(|(x, y)| [x.into(), y.into()]).collect(),
            sides: (outside == Outside::Blocked).then_some(sides),
        }
    }

    /// Four times the squared distance from a point in half cells to the nearest of all.
    fn squared_distance(&self, [x, y]: [i64; 2]) -> Option<i64> {
        let cells = self.cells.iter().map(|&[i, j]| gap(x, i).pow(2) + gap(y, j).pow(2));
        let sides = self.sides.map(|[width, height]| [x, y, width - x, height - y]);
        let sides = sides.into_iter().flatten().map(|distance| distance.max(0).pow(2));
        cells.chain(sides).min()
    }

    /// The same from what a cell is measured by.
    fn squared_distance_of_cell(&self, fit: Fit, x: i32, y: i32) -> Option<i64> {
        let (x, y) = (2 * i64::from(x), 2 * i64::from(y));
        let points: &[[i64; 2]] = match fit {
            Fit::Centers => &[[1, 1]],
            Fit::WholeCells => &[[0, 0], [0, 2], [2, 0], [2, 2]],
        };
        points.iter().filter_map(|[dx, dy]| self.squared_distance([x + dx, y + dy])).min()
    }
}

/// A number is the rounded root of a quarter of an integer: the largest that is not above it.
fn is_root(root: f64, squared: Option<i64>) -> bool {
    squared.map_or(root == f64::INFINITY, |squared| {
        let exact = (squared as f64 / 4.0).sqrt();
        (root == exact || root == exact.next_down()) && (root * root * 4.0 - squared as f64).abs() < 0.25
    })
}

fn check(grid: &Grid, name: &str) {
    let shared = Arc::new(grid.clone());
    for (fit, outside) in KINDS {
        let clearance = Clearance::new(Arc::clone(&shared), fit, outside);
        let obstacles = Obstacles::new(grid, outside);
        let (more, offset) = if fit == Fit::Centers { (0, 1) } else { (1, 0) };
        for y in 0..grid.height() as i32 + more {
            for x in 0..grid.width() as i32 + more {
                let point = [x, y].map(|c| 2 * i64::from(c) + offset);
                let (found, expected) =
                    (clearance.distance(Vertex::new(x, y)), obstacles.squared_distance(point));
                assert!(
                    is_root(found, expected),
                    "{fit:?}, {outside:?}: {found} instead of √{expected:?}/2 at ({x}, {y}); {name}:\n{}",
                    draw(grid)
                );
            }
        }
        for at in [(-1, 0), (0, -1), (i32::MIN, i32::MAX), (grid.width() as i32 + more, 0)] {
            assert_eq!(clearance.distance(at.into()), 0.0);
        }
    }
}

pub(crate) fn draw(grid: &Grid) -> String {
    mediant_grid::draw(grid, mediant_grid::PlacementKind::Center, &[])
}

#[test]
fn distances_are_those_to_the_nearest_of_all_blocked_cells() {
    for seed in seeds(150) {
        let (grid, kind) = suite_grid(seed);
        check(&grid, &format!("{kind}, seed {seed}"));
    }
}

#[test]
fn sides_around_words_and_bands() {
    let mut rng = Rng::new(0);
    let sides = [
        (1, 1),
        (1, 70),
        (70, 1),
        (2, 33),
        (63, 3),
        (64, 32),
        (65, 31),
        (127, 2),
        (128, 5),
        (129, 4),
        (3, 97),
    ];
    for (width, height) in sides {
        for percent in [0, 1, 4, 30, 99, 100] {
            check(&noise(&mut rng, width, height, percent), &format!("noise of {percent} %"));
        }
        check(&caves(&mut rng, width, height), "caves");
    }
}

/// Squares that barely fit in 32 bits.
#[test]
fn the_longest_maps() {
    let long = Grid::MAX_SIDE;
    let blocked = |x: u32, y: u32| (x == 0 && y == 0) || (x == 20_000 && y == 1);
    let (mut points, far) = (0, long as i32);
    for grid in [Grid::from_fn(long, 3, blocked), Grid::from_fn(3, long, |x, y| blocked(y, x))] {
        let grid = grid.expect("a map");
        for (fit, offset) in [(Fit::Centers, 1), (Fit::WholeCells, 0)] {
            let clearance = Clearance::new(Arc::new(grid.clone()), fit, Outside::Open);
            for along in [0, 1, 2, 9_999, 10_000, 10_001, 19_998, 20_002, 26_000, far - 2, far - 1] {
                for across in 0..3 {
                    let (x, y) = if grid.width() == 3 { (across, along) } else { (along, across) };
                    let squared = [(0, 0), (20_000, 1)].map(|(i, j)| {
                        let (i, j) = if grid.width() == 3 { (j, i) } else { (i, j) };
                        let [dx, dy] = [(x, i), (y, j)].map(|(c, cell)| gap(2 * i64::from(c) + offset, cell));
                        dx * dx + dy * dy
                    });
                    let expected = squared.into_iter().min();
                    let found = clearance.distance(Vertex::new(x, y));
                    assert!(
                        is_root(found, expected),
                        "{fit:?}: {found} and not √{expected:?}/2 at ({x}, {y})"
                    );
                    points += 1;
                }
            }
        }
    }
    assert_eq!(points, 132);
}

/// The free cells of a disc's map, and the radii at which they change.
#[test]
fn maps_of_discs_have_the_cells_that_the_disc_keeps_off_from() {
    for seed in seeds(100) {
        let (grid, kind) = suite_grid(seed);
        let shared = Arc::new(grid.clone());
        let mut rng = Rng::new(seed);
        for (fit, outside) in KINDS {
            let clearance = Clearance::new(Arc::clone(&shared), fit, outside);
            let obstacles = Obstacles::new(&grid, outside);
            let cells =
                || (0..grid.height() as i32).flat_map(|y| (0..grid.width() as i32).map(move |x| (x, y)));
            let squares: Vec<_> =
                cells().map(|(x, y)| obstacles.squared_distance_of_cell(fit, x, y)).collect();
            // Radii that are exact multiples of 2⁻¹⁰, so that their squares are exact here too.
            let random = f64::from(rng.below(1 << 12)) / 1024.0;
            for radius in [0.0, 1.0 / 1024.0, 0.5, 0.5 + 1.0 / 1024.0, 1.0, 1.5, 2.0, 2.5, random, 1e9] {
                let expected = cells().zip(&squares).map(|((x, y), squared)| {
                    grid.is_blocked(x, y) || squared.is_some_and(|s| (s as f64) < 4.0 * radius * radius)
                });
                let map = clearance.for_disc(radius).expect("a radius");
                let found = cells().map(|(x, y)| map.is_blocked(x, y));
                assert!(
                    found.eq(expected),
                    "{fit:?}, {outside:?}, radius {radius}, {kind}, seed {seed}:\n{}and not\n{}",
                    draw(&grid),
                    draw(&map)
                );
                assert!(
                    map == Grid::from_fn(map.width(), map.height(), |x, y| map
                        .is_blocked(x as i32, y as i32))
                    .expect("a map")
                );
            }
        }
    }
}

#[test]
fn radii_that_are_none_are_refused() {
    let grid = Arc::new(Grid::from_fn(3, 3, |_, _| false).expect("a map"));
    let clearance = Clearance::new(grid, Fit::Centers, Outside::Blocked);
    for radius in [-1.0, -f64::MIN_POSITIVE, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = clearance.for_disc(radius).expect_err("no radius");
        assert!(matches!(error, SizeError::Radius(_)) && error.to_string().contains("finite"), "{error}");
    }
    assert_eq!(clearance.for_disc(f64::MAX).expect("a radius").free_cells(), 0);
    assert_eq!(clearance.for_disc(f64::from_bits(1)).expect("a radius").free_cells(), 9);
}

/// The change of another map: nothing of the known one is kept. The maps are large enough for a repair of
/// their own changes, which obstacles all around keep small.
#[test]
fn the_change_of_another_map_is_measured_anew() {
    let [own, other] = [0, 1].map(|odd| {
        let is_wall = |x: u32, y: u32| (x + 2 * odd).is_multiple_of(6) && y.is_multiple_of(6);
        Arc::new(Grid::from_fn(90, 80, is_wall).expect("a map"))
    });
    let change = Change::new(other).edit_cells([(45, 45, true)]);
    for (fit, outside) in KINDS {
        let after = Clearance::new(Arc::clone(&own), fit, outside).after(&change);
        let new = Clearance::new(Arc::clone(change.after()), fit, outside);
        for at in (0..80).flat_map(|y| (0..90).map(move |x| Vertex::new(x, y))) {
            assert_eq!(after.distance(at), new.distance(at), "{at}, {fit:?}, {outside:?}");
        }
    }
}

/// On a map without obstacles discs of any size fit if the outside is open, and none of them if it is not.
#[test]
fn the_last_obstacle_goes() {
    let map = Arc::new(Grid::from_fn(90, 80, |x, y| (x, y) == (1, 1)).expect("a map"));
    let change = Change::new(Arc::clone(&map)).edit_cells([(1, 1, false)]);
    for (fit, outside) in KINDS {
        let after = Clearance::new(Arc::clone(&map), fit, outside).after(&change);
        let fits = after.for_disc(f64::MAX).expect("a radius").free_cells() > 0;
        assert_eq!(fits, outside == Outside::Open, "{fit:?}, {outside:?}");
    }
}

/// Chains of edits: the squares of all points, and whether there is any obstacle.
#[test]
fn clearances_follow_edits() {
    on_all_cores(seeds(40), |seed| {
        let rng = &mut Rng::new(seed);
        let first = match seed % 8 {
            0 => suite_grid(seed).0,
            1 => rooms(rng, 90, 70),
            2 => caves(rng, 66, 70),
            3 => noise(rng, 90, 80, 0),
            4 => noise(rng, 120, 70, 1),
            5 => noise(rng, 3, 200, 2),
            6 => noise(rng, 200, 5, 3),
            _ => noise(rng, 65, 64, 20),
        };
        for (fit, outside) in KINDS {
            let mut map = Arc::new(first.clone());
            let mut clearance = Clearance::new(Arc::clone(&map), fit, outside);
            for step in 0..20 {
                let change = random_change(rng, &map);
                clearance = clearance.after(&change);
                map = Arc::clone(change.after());
                let new = Clearance::new(Arc::clone(&map), fit, outside);
                for at in (0..=map.height() as i32)
                    .flat_map(|y| (0..=map.width() as i32).map(move |x| Vertex::new(x, y)))
                {
                    let [one, other] = [&clearance, &new].map(|known| known.distance(at).to_bits());
                    let said =
                        || format!("{fit:?}, {outside:?}, seed {seed}, edit {step}: {:?}", change.cells());
                    assert!(one == other, "{at}, {}", said());
                }
                assert_eq!(clearance.for_disc(f64::MAX).ok(), new.for_disc(f64::MAX).ok());
                assert_eq!(clearance.grid().id(), map.id());
            }
        }
    });
}

#[test]
fn centers_are_as_far_from_the_nearest_blocked_one_as_they_are() {
    for seed in seeds(60) {
        let (grid, kind) = suite_grid(seed);
        let found = grid.squared_center_distances(&Interrupt::NEVER).expect("nothing stops it");
        let cells = || (0..grid.height() as i32).flat_map(|y| (0..grid.width() as i32).map(move |x| (x, y)));
        let blocked: Vec<_> = cells().filter(|&(x, y)| grid.is_blocked(x, y)).collect();
        for ((x, y), &found) in cells().zip(&found) {
            let squared = |&(i, j): &(i32, i32)| ((x - i) * (x - i) + (y - j) * (y - j)) as u32;
            let expected = blocked.iter().map(squared).min().unwrap_or(u32::MAX);
            assert_eq!(found, expected, "({x}, {y}), {kind}, seed {seed}:\n{}", draw(&grid));
        }
    }
}
