//! Cost surfaces of any size, from a seed: for measurements and studies.

use crate::random::Rng;

/// A kind of cost surface. Its costs are small integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// Each cell costs 16 to 159, at random.
    Friction,
    /// Heights by midpoint displacement: a cell costs 10 on level ground, and more the steeper it is, 30 in
    /// the mean.
    Elevation,
    /// Road, grass, forest and swamp: 1, 2, 5 and 10, in patches of some 16 cells.
    Patches,
    /// Rooms of 20 × 20 cells with doors of six; 10 far from walls and 100 beside them, as the inflated maps
    /// of robots.
    Rooms,
    /// 20 % of the cells are blocked, all others cost 1.
    Walls,
    /// All cells cost 7.
    Equal,
}

impl Surface {
    /// All kinds.
    pub const ALL: [Self; 6] =
        [Self::Friction, Self::Elevation, Self::Patches, Self::Rooms, Self::Walls, Self::Equal];

    /// The name for a table.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Friction => "friction",
            Self::Elevation => "elevation",
            Self::Patches => "patches",
            Self::Rooms => "rooms",
            Self::Walls => "walls",
            Self::Equal => "equal",
        }
    }

    /// The costs of side × side cells, row by row; 0 is blocked.
    #[must_use]
    pub fn costs(self, side: u32, rng: &mut Rng) -> Vec<u32> {
        match self {
            Self::Friction => (0..side * side).map(|_| 16 + rng.below(144)).collect(),
            Self::Elevation => elevation(side as usize, rng),
            Self::Patches => patches(side, rng),
            Self::Rooms => rooms(side, rng),
            Self::Walls => (0..side * side).map(|_| u32::from(!rng.chance(20))).collect(),
            Self::Equal => vec![7; (side * side) as usize],
        }
    }
}

/// Heights from about -2 to 2 on side × side cells, row by row, by midpoint displacement: a fractal.
#[must_use]
pub fn heights(side: usize, rng: &mut Rng) -> Vec<f64> {
    let size = (side - 1).next_power_of_two() + 1;
    let mut heights = vec![0.0; size * size];
    let (mut step, mut spread) = (size - 1, 1.0);
    let mut random = |spread: f64| (f64::from(rng.below(1 << 20)) / f64::from(1 << 19) - 1.0) * spread;
    while step > 1 {
        let half = step / 2;
        for y in (half..size).step_by(step) {
            for x in (half..size).step_by(step) {
                let corner = |dx: usize, dy: usize| heights[(y - half + dy) * size + x - half + dx];
                let mean = (corner(0, 0) + corner(step, 0) + corner(0, step) + corner(step, step)) / 4.0;
                heights[y * size + x] = mean + random(spread);
            }
        }
        for y in (0..size).step_by(half) {
            for x in ((y / half + 1) % 2 * half..size).step_by(step) {
                let near =
                    [(x.wrapping_sub(half), y), (x + half, y), (x, y.wrapping_sub(half)), (x, y + half)];
                let on: Vec<f64> = near
                    .iter()
                    .filter(|at| at.0 < size && at.1 < size)
                    .map(|at| heights[at.1 * size + at.0])
                    .collect();
                heights[y * size + x] = on.iter().sum::<f64>() / on.len() as f64 + random(spread);
            }
        }
        (step, spread) = (half, spread * 0.55);
    }
    (0..side * side).map(|at| heights[at / side * size + at % side]).collect()
}

fn elevation(side: usize, rng: &mut Rng) -> Vec<u32> {
    let heights = heights(side, rng);
    let slope = |at: usize| {
        let (x, y) = (at % side, at / side);
        let height = |x: usize, y: usize| heights[y.min(side - 1) * side + x.min(side - 1)];
        let (dx, dy) = (height(x + 1, y) - height(x, y), height(x, y + 1) - height(x, y));
        (dx * dx + dy * dy).sqrt()
    };
    let slopes: Vec<f64> = (0..side * side).map(slope).collect();
    let mean = slopes.iter().sum::<f64>() / slopes.len() as f64;
    slopes.iter().map(|slope| 10 + (20.0 * slope / mean) as u32).collect()
}

/// Each cell is of the kind of the nearest of random places.
fn patches(side: u32, rng: &mut Rng) -> Vec<u32> {
    const PITCH: u32 = 16;
    let columns = side / PITCH + 2;
    let places: Vec<(i32, i32, u32)> = (0..columns * columns)
        .map(|at| {
            let (x, y) = (at % columns * PITCH + rng.below(PITCH), at / columns * PITCH + rng.below(PITCH));
            (x as i32, y as i32, [1, 2, 5, 10][rng.below(4) as usize])
        })
        .collect();
    let cell = |at: u32| {
        let (x, y) = ((at % side + PITCH / 2) as i32, (at / side + PITCH / 2) as i32);
        let (column, row) = (x / PITCH as i32, y / PITCH as i32);
        let near = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (column + dx, row + dy)));
        let near =
            near.filter(|&(x, y)| (0..columns as i32).contains(&x) && (0..columns as i32).contains(&y));
        let near = near.map(|(column, row)| places[row as usize * columns as usize + column as usize]);
        near.min_by_key(|place| (place.0 - x).pow(2) + (place.1 - y).pow(2)).map_or(1, |place| place.2)
    };
    (0..side * side).map(cell).collect()
}

fn rooms(side: u32, rng: &mut Rng) -> Vec<u32> {
    const PITCH: u32 = 21;
    let columns = side / PITCH + 1;
    let doors: Vec<[u32; 2]> = (0..columns * columns).map(|_| [rng.below(15), rng.below(15)]).collect();
    let is_wall = |x: u32, y: u32| {
        let [across, down] = doors[(y / PITCH * columns + x / PITCH) as usize];
        let is_door = |at: u32, door: u32| (door..door + 6).contains(&at);
        x % PITCH == 20 && !is_door(y % PITCH, across) || y % PITCH == 20 && !is_door(x % PITCH, down)
    };
    let cell = |at: u32| {
        let (x, y) = (at % side, at / side);
        if is_wall(x, y) {
            return 0;
        }
        let near = (-6..=6_i32).flat_map(|dy| (-6..=6_i32).map(move |dx| (dx, dy)));
        let walls = near.filter(|&(dx, dy)| {
            let at = (x.wrapping_add_signed(dx), y.wrapping_add_signed(dy));
            at.0 < side && at.1 < side && is_wall(at.0, at.1)
        });
        let nearest = walls.map(|(dx, dy)| dx * dx + dy * dy).min();
        nearest.map_or(10, |square| 10 + (90.0 * (-0.5 * (f64::from(square).sqrt() - 1.0)).exp()) as u32)
    };
    (0..side * side).map(cell).collect()
}
