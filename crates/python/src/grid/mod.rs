//! Grids: maps with their place in the world.

mod agents;
mod batches;
mod costmaps;
mod costs;
mod disc;
mod edits;
mod elevation;
mod fields;
mod making;
mod motion;
mod occupancy;
mod queries;

use std::sync::Arc;

use mediant::{Error, Ground, Limits, Map, Motion, Planners, Space, errors::SetupError, files::WorldFrame};
use pyo3::prelude::*;

pub(crate) use self::{disc::Disc, edits::cells_on, occupancy::place};
use crate::{
    background::{detached, in_pool, on_thread},
    errors::raised,
    keywords::{Keywords, call_error},
};

/// A map: which cells are blocked, and perhaps the costs or the elevations of the others.
///
/// Cell (row, column) is counted from the top left corner.
///
/// A grid never changes: `edit` makes another one. All threads can share it.
///
/// Parameters
/// ----------
/// array : array_like
///     Shape (rows, columns). Of bool: True where a cell is blocked. Of numbers: with at least one of the
///     criteria that follow, and blocked where one of them is met. It is read where it is, and not kept.
/// above : float, optional
///     Cells with a larger value are blocked.
/// below : float, optional
///     Cells with a smaller value are blocked.
/// values : iterable of float, optional
///     Cells with one of these values, in the array's type, are blocked. ``nan`` among them stands for all
///     that are no number.
/// resolution : float, optional
///     The side of a cell in meters. With it the grid has a place in the `world`.
/// origin : tuple of float, optional
///     The lower left corner of the map, below the last row: x and y in meters, and its turn in radians,
///     which may be left out; (0, 0) by default. For cells whose first row is the lowest, give
///     ``array[::-1]``; for those of an occupancy message there is `from_occupancy`.
/// world : World, optional
///     The place in the world of a map of this shape, in place of ``resolution`` and ``origin``.
/// costs : array_like, optional
///     The cost of each free cell, of the shape of the array: positive numbers of any type, whatever is in
///     blocked cells. A move costs its length in each cell that it crosses times the cell's cost. It is read
///     where it is, and not kept. `from_costs` takes costs alone, which say by themselves what is blocked.
/// cell_size : float or tuple of float, optional
///     With ``costs``: the side of a cell, or its height and its width, in the unit of length of which costs
///     are one; 1 by default.
///
/// Attributes
/// ----------
/// shape : tuple of int
///     The number of rows and columns.
/// world : World or None
///     Where the map is in the world, if that was said.
/// id : str
///     A name of the content: the same for grids with the same cells, and costs or elevations.
/// costs : numpy.ndarray or None
///     The costs of the cells, shape (rows, columns), float64: ``nan`` in blocked cells; None if cells have
///     none. A new array each time. Costs that are not integers are rounded by 2**-32 of the greatest.
/// has_costs : bool
///     Whether cells have costs.
/// elevation : numpy.ndarray or None
///     The elevations of the cells of a grid that `from_elevation` made, shape (rows, columns), float64:
///     ``nan`` in blocked cells. A new array each time, rounded by 2**-30 of their range.
/// friction : numpy.ndarray or None
///     The frictions beside the elevations, if there are any.
/// pace : str or numpy.ndarray or None
///     The pace over elevation: its name, or its table of slopes and times.
/// cell_size : tuple of float
///     The height and the width of a cell; (1.0, 1.0) if nothing else was said.
///
/// Raises
/// ------
/// MapError
///     For a side of 0, or of more than 32768 cells; for a cost of a free cell that is no positive number,
///     and for costs that are more than 65536 times as great as others.
/// ArgumentError
///     For an array of another number of dimensions, or with values that are no number; and for a resolution
///     or an origin that places no map, or the world of a map of another shape.
/// TypeError
///     For numbers without a criterion, and for arrays that hold neither numbers nor bool.
///
/// Examples
/// --------
/// >>> import numpy as np
/// >>> import mediant
/// >>> grid = mediant.Grid(np.array([[0, 0, 9], [0, 9, 0]]), above=5)
/// >>> grid
/// <mediant.Grid of 2 × 3 cells, 2 blocked>
/// >>> mediant.Grid(np.array([[1, 2, 3]]), values={1, 3}).to_numpy().tolist()
/// [[True, False, True]]
#[pyclass(frozen, module = "mediant")]
#[derive(Clone)]
pub(crate) struct Grid {
    shared: Arc<Shared>,
}

struct Shared {
    ground: Ground,
    world: Option<WorldFrame>,
}

impl Grid {
    pub(crate) fn new(ground: impl Into<Ground>, world: Option<WorldFrame>) -> Self {
        Self { shared: Arc::new(Shared { ground: ground.into(), world }) }
    }

    pub(crate) fn ground(&self) -> &Ground {
        &self.shared.ground
    }

    pub(crate) fn map(&self) -> &Map {
        self.ground().map()
    }

    /// The error for something that there is not on costs of cells, if these have costs.
    fn without_costs(&self, what: &'static str, instead: &'static str) -> PyResult<()> {
        match self.ground() {
            Ground::Map(_) => Ok(()),
            _ => Err(raised(Error::from(SetupError::WithCosts { what, instead }))),
        }
    }

    /// The number of cells.
    fn cells(&self) -> u64 {
        u64::from(self.map().width()) * u64::from(self.map().height())
    }

    /// The grid with this motion, kept for the next call.
    fn space(&self, py: Python<'_>, motion: Motion) -> PyResult<Space> {
        self.space_within(py, motion, Limits::new())?.map_err(raised)
    }

    fn space_within(&self, py: Python<'_>, motion: Motion, limits: Limits) -> PyResult<Result<Space, Error>> {
        if let Some(space) = self.ground().kept_space(motion) {
            return Ok(Ok(space));
        }
        let ground = self.ground().clone();
        detached(py, self.cells(), limits, move |limits| ground.keep_space(motion, limits))
    }

    /// The planners of a call, kept for the next one. Within, [`Error::Stopped`] by its time limit.
    fn planners(&self, py: Python<'_>, keywords: &Keywords) -> PyResult<Result<Arc<Planners>, Error>> {
        self.planners_within(py, keywords, keywords.preparation())
    }

    /// The planners of a call, whose preparation has limits of its own.
    fn planners_within(
        &self,
        py: Python<'_>,
        keywords: &Keywords,
        limits: Limits,
    ) -> PyResult<Result<Arc<Planners>, Error>> {
        let setup = self.ground().setup(&keywords.call).map_err(call_error)?;
        if let Some(planners) = self.ground().kept_planners(&setup) {
            return Ok(Ok(planners));
        }
        let ground = self.ground().clone();
        let prepare = move |limits: &Limits| ground.keep_planners(&setup, limits);
        let planners = if setup.index_version().is_err() {
            detached(py, self.cells(), limits, prepare)?
        } else {
            on_thread(py, limits, move |limits| in_pool(None, || prepare(limits)), |_| Ok(()))?
        };
        match planners {
            Ok(planners) => Ok(Ok(planners)),
            Err(error) if matches!(error, Error::Stopped { .. }) => Ok(Err(error)),
            Err(error) => Err(raised(error)),
        }
    }
}

impl PartialEq for Grid {
    fn eq(&self, other: &Self) -> bool {
        self.ground() == other.ground() && self.shared.world == other.shared.world
    }
}
