//! Distances of cells from blocked ones, center from center: those of robots' costmaps.

use super::{
    Outside,
    sites::{Measure, Sites},
    transform::squared_distances,
};
use crate::{
    Grid,
    interrupt::{Interrupt, Interrupted},
};

impl Grid {
    /// The squared distance in cells from the center of each cell to the center of the nearest blocked one,
    /// row by row: 0 for blocked cells, [`u32::MAX`] where no cell is blocked. The outside of the map is no
    /// obstacle.
    ///
    /// Costmaps of robots measure so. A [`Clearance`](super::Clearance) measures to the nearest point of a
    /// blocked cell, which is nearer by ½ to √½.
    ///
    /// Exact, and in linear time; with the feature `parallel` in rayon's current pool.
    ///
    /// ```
    /// use mediant_grid::{Grid, Interrupt};
    ///
    /// let grid = Grid::from_fn(4, 2, |x, y| (x, y) == (1, 0))?;
    /// assert_eq!(*grid.squared_center_distances(&Interrupt::NEVER)?, [1, 0, 1, 4, 2, 1, 2, 5]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Interrupted`]; it asks before each row.
    pub fn squared_center_distances(&self, interrupt: &Interrupt) -> Result<Box<[u32]>, Interrupted> {
        let measure = Measure::CentersToCenters;
        squared_distances(Sites { rows: self.rows(), measure, outside: Outside::Open }, interrupt)
    }
}
