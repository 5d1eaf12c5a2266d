//! Costs of cells.

use mediant::{Error, Ground};
use pyo3::prelude::*;

use super::{Grid, edits::cells_on};
use crate::{
    arrays::map_of_bools,
    costs::{array_of, cell_size, costs_of, each, raised_for_costs},
    errors::exception,
    world::placed,
};

#[pymethods]
impl Grid {
    /// The grid of costs that say by themselves which cells are blocked: a raster of friction.
    ///
    /// A cell is blocked where the costs are masked, where they are ``nodata``, and where the raster says by
    /// its attributes that it has no data. All other costs must be positive numbers.
    ///
    /// Parameters
    /// ----------
    /// costs : array_like
    ///     The cost of each cell, shape (rows, columns): numbers of any type. A masked array, such as
    ///     ``dataset.read(1, masked=True)`` of rasterio; or a DataArray of xarray with two dimensions, of
    ///     which ``nodata`` and ``cell_size`` are read, too.
    /// nodata : float or iterable of float, optional
    ///     Cells with this cost, or with one of these, are blocked; ``nan`` stands for all that are no
    ///     number.
    /// cell_size : float or tuple of float, optional
    ///     The side of a cell, or its height and its width, in the unit of length of which costs are one; 1
    ///     by default.
    /// transform : affine.Affine or tuple of float, optional
    ///     In place of ``cell_size``: ``dataset.transform`` of rasterio, or its six numbers.
    /// world : World, optional
    ///     The place in the world of a map of this shape.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     With costs.
    ///
    /// Raises
    /// ------
    /// MapError
    ///     For a cost that is zero, negative, infinite or no number, and is not said to be a wall; for costs
    ///     that are more than 65536 times as great as others; and for a side of 0, or of more than 32768
    ///     cells.
    /// ArgumentError
    ///     For coordinates in degrees, whose cells differ in width from row to row: project the raster first;
    ///     for coordinates that are not evenly spaced, and for a transform that turns the cells.
    /// TypeError
    ///     For an array that holds no numbers.
    ///
    /// Examples
    /// --------
    /// >>> import numpy as np
    /// >>> import mediant
    /// >>> friction = np.array([[1.0, 5.0, 1.0], [1.0, -9999.0, 1.0], [1.0, 1.0, 1.0]])
    /// >>> grid = mediant.Grid.from_costs(friction, nodata=-9999, cell_size=30)
    /// >>> grid
    /// <mediant.Grid of 3 × 3 cells, 1 blocked, costs 1 to 5, cells of 30 × 30>
    /// >>> grid.distance((0, 0), (0, 2)), grid.path((0, 0), (0, 2)).tolist()
    /// (180.0, [[0, 0], [0, 2]])
    #[staticmethod]
    #[pyo3(
        signature = (costs, *, nodata = None, cell_size = None, transform = None, world = None),
        text_signature = "(costs, *, nodata=None, cell_size=None, transform=None, world=None)"
    )]
    fn from_costs<'py>(
        costs: &Bound<'py, PyAny>,
        nodata: Option<&Bound<'py, PyAny>>,
        cell_size: Option<&Bound<'py, PyAny>>,
        transform: Option<&Bound<'py, PyAny>>,
        world: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Self> {
        let read = costs.py().import("mediant._rasters")?.getattr("read")?;
        let (numbers, blocked, size): (Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>) =
            read.call1(("costs", costs, nodata, cell_size, transform))?.extract()?;
        let map = map_of_bools("costs", blocked.cast()?)?;
        let world = world.map_or(Ok(None), |world| placed(world, &map))?;
        Ok(Self::new(costs_of(&numbers, &map, self::cell_size(Some(&size))?)?, world))
    }

    /// The costs of the cells; None if they have none.
    #[getter]
    fn costs<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.ground().costs().map(|costs| array_of(py, costs)).transpose()
    }

    /// Whether cells have costs.
    #[getter]
    fn has_costs(&self) -> bool {
        self.ground().costs().is_some()
    }

    /// The height and the width of a cell.
    #[getter(cell_size)]
    fn size_of_cells(&self) -> (f64, f64) {
        let (width, height) = match self.ground() {
            Ground::Map(_) => (1.0, 1.0),
            Ground::Costs(costs) => costs.cell_size(),
            Ground::Walking(walking) => walking.cell_size(),
        };
        (height, width)
    }

    /// This grid with other costs of some cells, which are free then. This one stays as it is.
    ///
    /// Parameters
    /// ----------
    /// cells : array_like of int
    ///     A cell (row, column), or several with shape (n, 2).
    /// costs : float or array_like
    ///     Their costs: one for all, or one for each, shape (n,). The last word on a cell counts.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     The next version. The work follows the cells, as long as costs stay between the least and the
    ///     greatest one.
    ///
    /// Raises
    /// ------
    /// MapError
    ///     For a cell outside the map, for a cost that is no positive number (`edit_cells` blocks cells), and
    ///     for a grid whose cells have no costs.
    /// ArgumentError
    ///     For another number of costs than of cells.
    ///
    /// Examples
    /// --------
    /// >>> import numpy as np
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_costs(np.ones((2, 3)))
    /// >>> grid.edit_cells((0, 1), True).edit_costs([(0, 1), (1, 1)], [2, 4]).costs.tolist()
    /// [[1.0, 2.0, 1.0], [1.0, 4.0, 1.0]]
    fn edit_costs(&self, cells: &Bound<'_, PyAny>, costs: &Bound<'_, PyAny>) -> PyResult<Self> {
        let at = cells_on("cells", cells, self.map())?;
        let costs = each("costs", costs, at.len())?;
        if self.ground().costs().is_none() {
            let text = "cells: this grid has no costs of cells: make it with costs=, or by Grid.from_costs";
            return Err(exception("MapError", text, "cost"));
        }
        let edit = || self.ground().edit_costs(at.into_iter().zip(costs.into_iter().map(Some)));
        let edited = cells.py().detach(edit).map_err(|error: Error| raised_for_costs(error))?;
        Ok(Self::new(edited, self.shared.world))
    }
}
