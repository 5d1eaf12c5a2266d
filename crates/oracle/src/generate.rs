//! Maps from a seed. Every generator clamps the sides to 1…[`Grid::MAX_SIDE`].

use mediant_grid::{Grid, PlacementKind, Vertex};

use crate::{Rng, legality::vertex_is_free};

/// A map in the making.
struct Canvas {
    width: u32,
    height: u32,
    blocked: Vec<bool>,
}

impl Canvas {
    fn new(width: u32, height: u32, mut blocked: impl FnMut(u32, u32) -> bool) -> Self {
        let (width, height) = (width.clamp(1, Grid::MAX_SIDE), height.clamp(1, Grid::MAX_SIDE));
        let cells = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Self { width, height, blocked: cells.map(|(x, y)| blocked(x, y)).collect() }
    }

    /// The index of a cell, `None` outside.
    fn index(&self, x: u32, y: u32) -> Option<usize> {
        (x < self.width && y < self.height).then(|| y as usize * self.width as usize + x as usize)
    }

    /// Whether a cell is blocked; the outside is.
    fn is_blocked(&self, x: u32, y: u32) -> bool {
        self.index(x, y).is_none_or(|i| self.blocked[i])
    }

    /// Frees a cell; has no effect outside.
    fn free(&mut self, x: u32, y: u32) {
        if let Some(i) = self.index(x, y) {
            self.blocked[i] = false;
        }
    }

    fn into_grid(self) -> Grid {
        Grid::from_fn(self.width, self.height, |x, y| self.is_blocked(x, y)).expect("the sides are clamped")
    }
}

/// Noise: each cell is blocked with a probability of `percent` / 100, independently.
pub fn noise(rng: &mut Rng, width: u32, height: u32, percent: u32) -> Grid {
    Canvas::new(width, height, |_, _| rng.chance(percent)).into_grid()
}

/// Open ground with few obstacles: a wall, two cells thick, along the middle three quarters of the rising
/// diagonal, and within an eighth of the side on both sides of it single blocked cells, one in `one_in` on
/// average. Jumps are long there, and many of them lead to the same places.
pub fn sparse(rng: &mut Rng, side: u32, one_in: u32) -> Grid {
    let is_blocked = |x: u32, y: u32| {
        let beside = (x + y).abs_diff(side - 1);
        let is_wall = beside == 0 || x + y == side;
        (is_wall && (side / 8..side - side / 8).contains(&y))
            || (beside <= side / 8 && rng.below(one_in) == 0)
    };
    Canvas::new(side, side, is_blocked).into_grid()
}

/// Rooms of 1 × 1 to 5 × 5 cells, all of one size, with walls one cell thick, most of which have a door.
pub fn rooms(rng: &mut Rng, width: u32, height: u32) -> Grid {
    let side = 1 + rng.below(5);
    let pitch = side + 1;
    let is_wall = |n: u32| n % pitch == side;
    let mut canvas = Canvas::new(width, height, |x, y| is_wall(x) || is_wall(y));
    for y in (0..canvas.height).step_by(pitch as usize) {
        for x in (0..canvas.width).step_by(pitch as usize) {
            if rng.chance(85) {
                canvas.free(x + side, y + rng.below(side));
            }
            if rng.chance(85) {
                canvas.free(x + rng.below(side), y + side);
            }
        }
    }
    canvas.into_grid()
}

/// A maze of corridors one cell wide, carved by depth-first search. A few more walls are removed, so that
/// there are loops.
pub fn maze(rng: &mut Rng, width: u32, height: u32) -> Grid {
    let mut canvas = Canvas::new(width, height, |_, _| true);
    let mut trail = vec![(0, 0)];
    canvas.free(0, 0);
    while let Some(&(x, y)) = trail.last() {
        let ahead = [(1, 0), (-1, 0), (0, 1), (0, -1)].map(|(dx, dy)| {
            let step = |times: i32| (x as i32 + times * dx, y as i32 + times * dy);
            (step(1), step(2))
        });
        let is_uncarved = |&&(_, (x, y)): &&((i32, i32), (i32, i32))| {
            let cell = u32::try_from(x).ok().zip(u32::try_from(y).ok());
            cell.and_then(|(x, y)| canvas.index(x, y)).is_some_and(|i| canvas.blocked[i])
        };
        let open: Vec<_> = ahead.iter().filter(is_uncarved).copied().collect();
        match rng.pick(&open) {
            Some(&(wall, cell)) => {
                canvas.free(wall.0 as u32, wall.1 as u32);
                canvas.free(cell.0 as u32, cell.1 as u32);
                trail.push((cell.0 as u32, cell.1 as u32));
            }
            None => _ = trail.pop(),
        }
    }
    for _ in 0..canvas.blocked.len() / 24 {
        let (x, y) = (rng.below(canvas.width), rng.below(canvas.height));
        canvas.free(x, y);
    }
    canvas.into_grid()
}

/// Caves: noise of 35–50 %, smoothed by a cellular automaton in which the majority of a cell's 3 × 3 block
/// decides (outside counts as blocked).
pub fn caves(rng: &mut Rng, width: u32, height: u32) -> Grid {
    let percent = 35 + rng.below(16);
    let mut canvas = Canvas::new(width, height, |_, _| rng.chance(percent));
    for _ in 0..1 + rng.below(3) {
        canvas = Canvas::new(width, height, |x, y| {
            let block = (0..3).flat_map(|dy| (0..3).map(move |dx| (dx, dy)));
            // A coordinate of −1 wraps round to one that is outside as well.
            let is_blocked = |&(dx, dy): &(u32, u32)| {
                canvas.is_blocked((x + dx).wrapping_sub(1), (y + dy).wrapping_sub(1))
            };
            block.filter(is_blocked).count() >= 5
        });
    }
    canvas.into_grid()
}

/// The patterns of [`adversarial`]: a name, and whether cell (x, y) is blocked, given two random parameters.
type Pattern = (&'static str, fn(u32, u32, u32, u32) -> bool);

/// Patterns with the subtle cases.
const PATTERNS: [Pattern; 11] = [
    ("all free", |_, _, _, _| false),
    ("all blocked", |_, _, _, _| true),
    ("one free cell", |x, y, a, b| (x, y) != (a % 5, b % 5)),
    ("one blocked cell", |x, y, a, b| (x, y) == (a % 5, b % 5)),
    ("checkerboard", |x, y, a, _| (x + y + a) % 2 == 0),
    ("dots", |x, y, a, b| x % 2 == a % 2 && y % 2 == b % 2),
    ("falling diagonals", |x, y, a, b| {
        (i64::from(x) - i64::from(y) + i64::from(b)).rem_euclid(i64::from(2 + a % 4)) == 0
    }),
    ("rising diagonals", |x, y, a, b| (x + y + b) % (2 + a % 4) == 0),
    ("comb", |x, y, a, b| x % 2 == a % 2 && y != b % 4),
    ("staggered combs", |x, y, a, _| x % 2 == 1 && (y + 2 * x + a) % 4 != 0),
    ("rings", |x, y, a, b| (x.abs_diff(a % 8).max(y.abs_diff(b % 8))) % 2 == 1 && x != y),
];

/// Maps on which the rules of motion differ: diagonal gaps, corridors one cell wide, combs, checkerboards,
/// all free, all blocked. Each pattern is pure or has a few cells flipped.
pub fn adversarial(rng: &mut Rng, width: u32, height: u32) -> Grid {
    adversarial_with_name(rng, width, height).0
}

fn adversarial_with_name(rng: &mut Rng, width: u32, height: u32) -> (Grid, &'static str) {
    let (name, pattern) = rng.pick(&PATTERNS).copied().unwrap_or(PATTERNS[0]);
    let (a, b) = (rng.below(64), rng.below(64));
    let flips = [0, 0, 5, 20][rng.below(4) as usize];
    (Canvas::new(width, height, |x, y| pattern(x, y, a, b) != rng.chance(flips)).into_grid(), name)
}

/// A map whose kind, size (sides from 1 to 24, small ones more often) and density are drawn from `seed`, with
/// a description of them.
#[must_use]
pub fn random_grid(seed: u64) -> (Grid, String) {
    draw_grid(&mut Rng::new(seed))
}

/// A map of 60 to 200 by 1 to 4 cells, or the reverse, so that runs, rows and lines of sight cross the
/// boundaries of machine words. It is sparse, so that some of them are long.
#[must_use]
pub fn wide_grid(seed: u64) -> (Grid, String) {
    let rng = &mut Rng::new(seed);
    let (long, short) = (60 + rng.below(141), 1 + rng.below(4));
    let (width, height) = if rng.chance(50) { (long, short) } else { (short, long) };
    let percent = [0, 1, 3, 10, 30][rng.below(5) as usize];
    let grid = noise(rng, width, height, percent);
    (grid, format!("noise of {percent} %, {width} × {height} cells"))
}

/// The map of a suite for this seed: one in 20 is a [`wide_grid`], the others are a [`random_grid`].
#[must_use]
pub fn suite_grid(seed: u64) -> (Grid, String) {
    if seed % 20 == 7 { wide_grid(seed) } else { random_grid(seed) }
}

/// [`random_grid`] from a generator that can then be used for further draws.
pub(crate) fn draw_grid(rng: &mut Rng) -> (Grid, String) {
    let mut side = || {
        let longest = [3, 6, 12, 24][rng.below(4) as usize];
        1 + rng.below(longest)
    };
    let (width, height) = (side(), side());
    let (grid, kind) = match rng.below(10) {
        0..=3 => {
            let percent = rng.below(61);
            (noise(rng, width, height, percent), format!("noise of {percent} %"))
        }
        4 => (rooms(rng, width, height), "rooms".to_owned()),
        5 => (maze(rng, width, height), "maze".to_owned()),
        6 => (caves(rng, width, height), "caves".to_owned()),
        _ => {
            let (grid, name) = adversarial_with_name(rng, width, height);
            (grid, name.to_owned())
        }
    };
    (grid, format!("{kind}, {width} × {height} cells"))
}

/// Any vertex of the map, free or not.
pub fn random_vertex(rng: &mut Rng, grid: &Grid, placement: PlacementKind) -> Vertex {
    let extra = u32::from(placement == PlacementKind::Corner);
    let (x, y) = (rng.below(grid.width() + extra), rng.below(grid.height() + extra));
    Vertex::new(x as i32, y as i32)
}

/// A free vertex, each with the same probability; `None` if there is none.
pub fn random_free_vertex(rng: &mut Rng, grid: &Grid, placement: PlacementKind) -> Option<Vertex> {
    let extra = i32::from(placement == PlacementKind::Corner);
    let (columns, rows) = (grid.width() as i32 + extra, grid.height() as i32 + extra);
    let vertices = (0..rows).flat_map(|y| (0..columns).map(move |x| Vertex::new(x, y)));
    let free: Vec<Vertex> = vertices.filter(|&at| vertex_is_free(grid, placement, at)).collect();
    rng.pick(&free).copied()
}
