//! Costs by a function, without a list of them: of cells of any size, and in the units of earlier costs.

use std::sync::Arc;

use mediant_costs::{CostSurface, CostUnits};
use mediant_search::Limits;

use crate::{costs::Costs, error::Error, map::Map, memory_check};

impl Map {
    /// This map with the costs that `cost(x, y)` has for its free cells, whose width and height are a cell's
    /// size: [`costs`](Self::costs) and [`Costs::with_cell_size`] in one, without a second list of the costs.
    /// Each is asked for twice. Of the limits the deadline and the flag count.
    ///
    /// ```
    /// use mediant::{Limits, Map};
    ///
    /// let heights = [[10.0, 12.0, 19.0], [11.0, 15.0, 30.0]];
    /// let cost = |x: u32, y: u32| heights[y as usize][x as usize] / 10.0;
    /// let costs = Map::new(3, 2)?.costs_by((30.0, 20.0), Limits::new(), cost)?;
    /// assert_eq!((costs.bounds(), costs.cell_size()), ((1.0, 3.0), (30.0, 20.0)));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`costs`](Self::costs) and [`Costs::with_cell_size`], and [`Error::Stopped`].
    pub fn costs_by(
        &self,
        cell_size: (f64, f64),
        limits: impl Into<Limits>,
        cost: impl Fn(u32, u32) -> f64,
    ) -> Result<Costs, Error> {
        memory_check::check("the costs", self.bytes_of_costs())?;
        Costs::of(self, cell_size, limits.into().interrupt(), cost)
    }

    /// The costs that had these [units](Costs::units), from the same costs of the same map: a copy that was
    /// sent elsewhere, equal to the first one. Of the limits the deadline and the flag count.
    ///
    /// ```
    /// use mediant::{Limits, Map};
    ///
    /// let costs = Map::new(3, 1)?.costs([0.5, 1.5, 2.5])?.edit_cells([((2, 0), Some(0.7))])?;
    /// let cost = |x: u32, y: u32| costs.cost((x as i32, y as i32)).unwrap_or_default();
    /// assert_eq!(costs.map().costs_in(costs.units(), Limits::new(), cost)?, costs);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`costs_by`](Self::costs_by); [`Error::Costs`], too, for a cost that is not between the bounds.
    pub fn costs_in(
        &self,
        units: CostUnits,
        limits: impl Into<Limits>,
        cost: impl Fn(u32, u32) -> f64,
    ) -> Result<Costs, Error> {
        memory_check::check("the costs", self.bytes_of_costs())?;
        let (grid, limits) = (self.grid(), limits.into());
        let cost = |x: u32, y: u32| grid.is_free(x as i32, y as i32).then(|| cost(x, y));
        let surface = CostSurface::in_units((self.width(), self.height()), units, limits.interrupt(), cost)?;
        Ok(Costs::of_parts(Arc::clone(grid).into(), Arc::new(surface)))
    }

    /// The memory of costs of its cells, without the frame.
    fn bytes_of_costs(&self) -> u64 {
        u64::from(self.width()) * u64::from(self.height()) * size_of::<u32>() as u64
    }
}

impl Costs {
    /// The units in which they are kept, and their bounds: see [`Map::costs_in`].
    #[must_use]
    pub fn units(&self) -> CostUnits {
        self.surface().units()
    }
}
