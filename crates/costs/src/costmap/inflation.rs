//! Inflation: costs around obstacles, by the distance to the nearest one.
//!
//! nav2 measures distances from the center of a cell to that of the nearest obstacle. For many years its
//! layer (`LegacyInflationLayer` since) spread out from the obstacles in the order of distance, where a cell
//! takes over the obstacle of the neighbor that came first: not always the nearest one. Its layer of 2026
//! measures exactly, and looks costs up by the distance in hundredths of a cell. Here distances are exact,
//! and so is the number that the formula is given. On random maps (`tests/it/costmaps.rs`) the former differs
//! on 0.1 % of the cells, by up to 7 too low, and the latter on 3 %, by 1.

use mediant_grid::{Grid, GridError, Interrupt};

use super::Costmap;
use crate::error::CostsError;

/// The costs around obstacles, in the words of nav2's inflation layer. Lengths are in meters, or in
/// any other unit in which [`resolution`](Self::resolution) is the side of a cell: with 1, in cells.
///
/// With the distance d from a cell's center to that of the nearest obstacle, the cost is
///
/// | cell | cost |
/// |---|---|
/// | the obstacle itself | 254 |
/// | d ≤ `inscribed_radius` | 253 |
/// | up to `inflation_radius`, rounded up to whole cells | ⌊252 · exp(−`cost_scaling_factor` · (d − r))⌋, r = `inscribed_radius` |
/// | beyond | 0 |
///
/// unless the cell has a higher one already. The exponential function is the same on every platform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inflation {
    /// The side of a cell.
    pub resolution: f64,
    /// The radius of the largest disc around the robot's center that its footprint holds.
    pub inscribed_radius: f64,
    /// The distance that costs reach. At least the inscribed radius: nav2 only warns of less, and then leaves
    /// cells free on which the robot cannot be. 0 leaves the costmap as it is.
    pub inflation_radius: f64,
    /// The rate at which costs fall, per unit of length.
    pub cost_scaling_factor: f64,
    /// Whether unknown cells take each cost above 0. Otherwise they only become inscribed.
    pub inflate_unknown: bool,
    /// Whether unknown cells are obstacles, too. They become lethal, as in nav2.
    pub inflate_around_unknown: bool,
}

/// The values of nav2: cells of 0.1, a robot of radius 0.1, inflation up to 0.55, a factor of 10.
impl Default for Inflation {
    fn default() -> Self {
        Self {
            resolution: 0.1,
            inscribed_radius: 0.1,
            inflation_radius: 0.55,
            cost_scaling_factor: 10.0,
            inflate_unknown: false,
            inflate_around_unknown: false,
        }
    }
}

impl Costmap {
    /// This costmap with costs around its lethal cells. The outside of the map is no obstacle.
    ///
    /// Linear in the cells, whatever the radius; with the feature `parallel` of `mediant-grid`, distances are
    /// measured in rayon's current pool. It takes four bytes a cell while it works.
    ///
    /// # Errors
    /// [`CostsError::Setting`] for a resolution that is no positive number, or a radius or a factor that is
    /// negative or not finite; [`CostsError::SmallInflation`]; [`CostsError::Inflated`] for sides beyond
    /// those of a [`Grid`]; [`CostsError::Interrupted`].
    pub fn inflated(&self, inflation: &Inflation, interrupt: &Interrupt) -> Result<Self, CostsError> {
        inflation.check()?;
        let mut costmap = self.clone();
        let costs = Costs::new(inflation, self);
        if costs.reach == 0 {
            return Ok(costmap);
        }
        let squared = self.obstacles(inflation, interrupt)?.squared_center_distances(interrupt)?;
        let least_on_unknown = if inflation.inflate_unknown { 1 } else { Self::INSCRIBED };
        let width = self.width as usize;
        for (row, squared) in costmap.bytes.chunks_exact_mut(width).zip(squared.chunks_exact(width)) {
            interrupt.check("inflating obstacles")?;
            for (byte, &squared) in row.iter_mut().zip(squared) {
                let cost = costs.get(squared);
                let is_known = *byte == Self::UNKNOWN && cost >= least_on_unknown;
                *byte = if is_known { cost } else { cost.max(*byte) };
            }
        }
        Ok(costmap)
    }

    /// The map of the cells around which costs are put.
    fn obstacles(&self, inflation: &Inflation, interrupt: &Interrupt) -> Result<Grid, CostsError> {
        let mut is_obstacle = [false; 256];
        is_obstacle[usize::from(Self::LETHAL)] = true;
        is_obstacle[usize::from(Self::UNKNOWN)] = inflation.inflate_around_unknown;
        let word = |x: u32, y: u32| {
            let from = self.index(x, y);
            let cells = &self.bytes[from..from + (self.width - x).min(64) as usize];
            let bit = |&cell: &u8| u64::from(is_obstacle[usize::from(cell)]);
            cells.iter().rev().fold(0, |word, cell| word << 1 | bit(cell))
        };
        let grid = Grid::from_words_interruptible(self.width, self.height, interrupt, word);
        grid.map_err(|error| match error {
            GridError::Interrupted(error) => error.into(),
            _ => CostsError::Inflated { width: self.width, height: self.height, max: Grid::MAX_SIDE },
        })
    }
}

impl Inflation {
    fn check(&self) -> Result<(), CostsError> {
        if !(self.resolution.is_finite() && self.resolution > 0.0) {
            let (name, value) = ("resolution", self.resolution);
            return Err(CostsError::Setting { name, value, expected: "a positive number" });
        }
        for (name, value) in [
            ("inscribed_radius", self.inscribed_radius),
            ("inflation_radius", self.inflation_radius),
            ("cost_scaling_factor", self.cost_scaling_factor),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(CostsError::Setting { name, value, expected: "a number from 0 on" });
            }
        }
        if self.inflation_radius < self.inscribed_radius {
            let (inflation, inscribed) = (self.inflation_radius, self.inscribed_radius);
            return Err(CostsError::SmallInflation { inflation, inscribed });
        }
        Ok(())
    }

    /// The cost at a squared distance in cells, however far.
    fn cost(&self, squared: u32) -> u8 {
        let distance = f64::from(squared).sqrt() * self.resolution;
        if squared == 0 {
            Costmap::LETHAL
        } else if distance <= self.inscribed_radius {
            Costmap::INSCRIBED
        } else {
            let beyond = distance - self.inscribed_radius;
            (f64::from(Costmap::DEAREST) * libm::exp(-self.cost_scaling_factor * beyond)) as u8
        }
    }
}

/// The costs by squared distances in cells.
struct Costs<'i> {
    inflation: &'i Inflation,
    /// The costs of near cells.
    table: Vec<u8>,
    /// The greatest squared distance with a cost.
    reach: u32,
}

impl<'i> Costs<'i> {
    /// The longest table.
    const LONGEST: u32 = 1 << 20;

    fn new(inflation: &'i Inflation, costmap: &Costmap) -> Self {
        // As a Grid has at most 2¹⁵ cells a side, squares on it are less than the cut.
        let radius = (inflation.inflation_radius / inflation.resolution).ceil().min(f64::from(1 << 16));
        let reach = (radius * radius) as u32;
        let [x, y] = [costmap.width, costmap.height].map(|side| side.saturating_sub(1));
        let farthest = x.saturating_mul(x).saturating_add(y.saturating_mul(y));
        let length = reach.min(farthest).min(Self::LONGEST - 1) + 1;
        let table = (0..length).map(|squared| inflation.cost(squared)).collect();
        // The greatest number stands for no obstacle.
        Self { inflation, table, reach: reach.min(u32::MAX - 1) }
    }

    #[inline]
    fn get(&self, squared: u32) -> u8 {
        match self.table.get(squared as usize) {
            Some(&cost) => cost,
            None if squared <= self.reach => self.inflation.cost(squared),
            None => 0,
        }
    }
}
