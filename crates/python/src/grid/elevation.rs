//! Elevations of cells.

use mediant::{Error, Ground, Walking, WalkingBounds, errors::SetupError, files::WorldFrame};
use pyo3::{prelude::*, types::PyTuple};

use super::{Grid, making::frame_of};
use crate::{
    costs,
    errors::raised,
    walking::{array_of, friction_of, pace_in_python, pace_of, walking_of},
    world::placed,
};

/// The bounds of elevations and of frictions.
type Bounds = ((f64, f64), (f64, f64));

#[pymethods]
impl Grid {
    /// The grid of elevations, over which paths are those that take the least time to walk.
    ///
    /// The time of a path is that of the pace by the slope, uphill other than downhill. So a way and the way
    /// back differ, and a `field` leads from its sources or to them. Between four centers the ground is
    /// bilinear, and each piece of a move has its own slope; straight and diagonal moves take the time that
    /// they take in `r.walk` of GRASS. Vertices are the centers of cells, and k is from 2 to 8.
    ///
    /// A cell is blocked where the elevations or the frictions are masked, ``nan`` or ``nodata``, and where a
    /// raster says by its attributes that it has no data.
    ///
    /// Parameters
    /// ----------
    /// elevation : array_like
    ///     The elevation of the center of each cell, shape (rows, columns), in the unit of ``cell_size``:
    ///     numbers of any type. A masked array; a DataArray of xarray with two dimensions; or a dataset of
    ///     rasterio, or one band of it, ``rasterio.band(dataset, 1)``. Of the last two ``nodata`` and
    ///     ``cell_size`` are read, too.
    /// pace : {"tobler", "langmuir"} or array_like
    ///     The time of a unit of horizontal length by the slope. The two with a name are seconds a meter:
    ///     Tobler's hiking function, and the rule of Langmuir with the numbers of `r.walk`. Others are a
    ///     table of shape (n, 2): slopes in increasing order, below 0 downhill, each with its time, linear
    ///     between them.
    /// friction : array_like, optional
    ///     The time of a unit of length in each cell beyond that of the pace, from 0 on: an array or a raster
    ///     of the same shape.
    /// nodata : float or iterable of float, optional
    ///     Cells with this elevation, or with one of these, are blocked.
    /// cell_size : float or tuple of float, optional
    ///     The side of a cell, or its height and its width. It can be left out if the raster says it.
    /// transform : affine.Affine or tuple of float, optional
    ///     In place of ``cell_size``: ``dataset.transform`` of rasterio, or its six numbers.
    /// world : World, optional
    ///     The place in the world of a map of this shape.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     With `elevation`. It has the queries, indexes, tables and fields of all grids, by A* and
    ///     Dijkstra's algorithm, and no edits.
    ///
    /// Raises
    /// ------
    /// MapError
    ///     For an elevation that is infinite, for a friction that is negative or infinite, for times that are
    ///     too far apart, and for a side of 0, or of more than 32768 cells.
    /// ArgumentError
    ///     For a raster of which the size of a cell is not known, for coordinates in degrees, for a friction
    ///     of another shape, and for a pace that is no positive number on a slope of the map.
    /// OptionError
    ///     For a pace of another name.
    /// TypeError
    ///     For an array that holds no numbers.
    ///
    /// Examples
    /// --------
    /// >>> import numpy as np
    /// >>> import mediant
    /// >>> ridge = np.array([[0, 0, 12, 0, 0], [0, 0, 12, 0, 0], [0, 0, 3, 0, 0]])
    /// >>> land = mediant.Grid.from_elevation(ridge, cell_size=10)
    /// >>> land
    /// <mediant.Grid of 3 × 5 cells, 0 blocked, elevations 0 to 12, cells of 10 × 10>
    /// >>> land.path((0, 0), (0, 4)).tolist()
    /// [[0, 0], [2, 2], [0, 4]]
    /// >>> hour = land.field((0, 0), heading="from", limit=3600)
    /// >>> round(hour.get((0, 4))), hour.path_to((0, 4)).tolist()
    /// (56, [[0, 0], [2, 2], [0, 4]])
    #[staticmethod]
    #[pyo3(
        signature = (elevation, *, pace = None, friction = None, nodata = None, cell_size = None,
            transform = None, world = None),
        text_signature = "(elevation, *, pace='tobler', friction=None, nodata=None, cell_size=None, \
            transform=None, world=None)"
    )]
    fn from_elevation<'py>(
        elevation: &Bound<'py, PyAny>,
        pace: Option<&Bound<'py, PyAny>>,
        friction: Option<&Bound<'py, PyAny>>,
        nodata: Option<&Bound<'py, PyAny>>,
        cell_size: Option<&Bound<'py, PyAny>>,
        transform: Option<&Bound<'py, PyAny>>,
        world: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Self> {
        let pace = pace.map_or(Ok(mediant::Pace::Tobler), pace_of)?;
        let read = elevation.py().import("mediant._rasters")?.getattr("read_elevation")?;
        let (heights, frictions, size): (Bound<'py, PyAny>, Option<Bound<'py, PyAny>>, Bound<'py, PyAny>) =
            read.call1((elevation, friction, nodata, cell_size, transform))?.extract()?;
        let size = costs::cell_size(Some(&size))?;
        let walking = walking_of((&heights, frictions.as_ref()), size, &pace, None)?;
        let world = world.map_or(Ok(None), |world| placed(world, walking.map()))?;
        Ok(Self::new(walking, world))
    }

    /// The elevations of the cells; None if they have none.
    #[getter]
    fn elevation<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.walking().map(|walking| array_of(py, walking, |at| walking.elevation(at))).transpose()
    }

    /// The frictions of the cells; None if they have none.
    #[getter]
    fn friction<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.walking().map_or(Ok(None), |walking| friction_of(py, walking))
    }

    /// The pace over elevation; None without one.
    #[getter]
    fn pace<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.walking().map(|walking| pace_in_python(py, walking.pace())).transpose()
    }

    /// The grid of elevations of a state that `__reduce__` gave.
    #[staticmethod]
    fn _of_walking<'py>(
        elevation: &Bound<'py, PyAny>,
        friction: Option<&Bound<'py, PyAny>>,
        world: Option<(f64, [f64; 3])>,
        bounds: Bounds,
        cell_size: (f64, f64),
        pace: &Bound<'py, PyAny>,
    ) -> PyResult<Self> {
        let bounds = WalkingBounds { elevation: bounds.0, friction: bounds.1 };
        let walking = walking_of((elevation, friction), cell_size, &pace_of(pace)?, Some(bounds))?;
        let world = frame_of(world, walking.map().height(), walking.map().width())?;
        Ok(Self::new(walking, world))
    }
}

impl Grid {
    pub(super) fn walking(&self) -> Option<&Walking> {
        self.ground().walking()
    }

    /// The error for an edit where cells have elevations.
    pub(super) fn without_elevation(&self) -> PyResult<()> {
        match self.ground() {
            Ground::Walking(_) => Err(raised(Error::from(SetupError::WithCosts {
                what: "edit of elevations",
                instead: "make the grid anew by Grid.from_elevation, with nan for blocked cells",
            }))),
            _ => Ok(()),
        }
    }
}

/// The arguments of [`Grid::_of_walking`].
pub(super) fn state_of<'py>(
    py: Python<'py>,
    walking: &Walking,
    world: Option<WorldFrame>,
) -> PyResult<Bound<'py, PyTuple>> {
    let WalkingBounds { elevation, friction } = walking.ground_bounds();
    let (width, height) = walking.cell_size();
    let world = world.map(|frame| (frame.resolution(), frame.origin()));
    let heights = array_of(py, walking, |at| walking.elevation(at))?;
    let pace = pace_in_python(py, walking.pace())?;
    let (bounds, size): (Bounds, _) = ((elevation, friction), (height, width));
    (heights, friction_of(py, walking)?, world, bounds, size, pace).into_pyobject(py)
}
