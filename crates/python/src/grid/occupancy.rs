//! Grids of robots: from the cells of an occupancy message, with a place in the world.

use mediant::{
    Map,
    files::{Unknown, WorldFrame},
};
use numpy::{PyArrayDescrMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::{exceptions::PyTypeError, prelude::*};

use super::Grid;
use crate::{
    arguments::{integer, number, numpy_function, word},
    arrays::map_of_bools,
    errors::{argument, instead, wrong_type},
};

#[pymethods]
impl Grid {
    /// The grid of an occupancy message of ROS.
    ///
    /// Its row 0 is the lowest; -1 is unknown, and 0 to 100 say by how many percent a cell is occupied. A
    /// cell is free up to ``free``, else occupied from ``occupied`` on. Numbers between them are unknown, and
    /// so are all below 0 or above 100.
    ///
    /// Parameters
    /// ----------
    /// occupancy : array_like of int
    ///     The cells: in one row, as in ``message.data``, from the lowest row on; or with shape (rows,
    ///     columns), the lowest row first.
    /// width, height : int, optional
    ///     The number of columns and of rows, ``message.info.width`` and ``message.info.height``. Cells in
    ///     one row need the width.
    /// resolution : float
    ///     The side of a cell in meters, ``message.info.resolution``.
    /// origin : tuple of float
    ///     The lower left corner of the map: x and y in meters, and its turn in radians, which may be left
    ///     out.
    /// occupied, free : float
    ///     The thresholds, in percent.
    /// unknown : {"blocked", "free"}
    ///     Whether unknown cells are blocked or free.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     With its place in the `world`. Its row 0 is the highest, as in every grid: the last one of the
    ///     message.
    ///
    /// Raises
    /// ------
    /// ArgumentError
    ///     For cells that do not fill the rows, thresholds outside 0 to 100, and a resolution or an origin
    ///     that places no map.
    /// MapError
    ///     For a side of 0, or of more than 32768 cells.
    /// TypeError
    ///     For cells that are no integers.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> cells = [0, 0, 100, -1, 10, 70]
    /// >>> grid = mediant.Grid.from_occupancy(cells, 3, 2, resolution=0.5, origin=(1, 2))
    /// >>> grid.to_numpy().tolist()
    /// [[True, False, True], [False, False, True]]
    /// >>> grid.world.vertex_at(1.25, 2.25)
    /// (1, 0)
    #[staticmethod]
    #[pyo3(
        signature = (occupancy, width = None, height = None, *, resolution, origin = None, occupied = None,
            free = None, unknown = None),
        text_signature = "(occupancy, width=None, height=None, *, resolution, origin=(0.0, 0.0, 0.0), \
            occupied=65, free=25, unknown='blocked')"
    )]
    #[expect(clippy::too_many_arguments, reason = "the keywords of a call in Python")]
    fn from_occupancy(
        occupancy: &Bound<'_, PyAny>,
        width: Option<&Bound<'_, PyAny>>,
        height: Option<&Bound<'_, PyAny>>,
        resolution: &Bound<'_, PyAny>,
        origin: Option<&Bound<'_, PyAny>>,
        occupied: Option<&Bound<'_, PyAny>>,
        free: Option<&Bound<'_, PyAny>>,
        unknown: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let rows = rows(occupancy, side("width", width)?, side("height", height)?)?;
        let occupied = percent("occupied", occupied, 65.0)?;
        let free = percent("free", free, 25.0)?;
        let unknown = unknown.map_or(Ok(Unknown::Blocked), |unknown| word("unknown", unknown))?;
        let blocks_unknown = unknown == Unknown::Blocked;
        let meets = |method: &str, limit: f64| rows.call_method1(method, (limit,));
        let both =
            |a: Bound<'_, PyAny>, b: Bound<'_, PyAny>| a.call_method1("__and__", (b,)).map(Bound::unbind);
        let py = rows.py();
        let is_free = both(meets("__ge__", 0.0)?, meets("__le__", free)?)?.into_bound(py);
        let is_taken = both(meets("__ge__", occupied)?, meets("__le__", 100.0)?)?.into_bound(py);
        let is_not_free = is_free.call_method0("__invert__")?;
        let blocked = if blocks_unknown { is_not_free } else { both(is_taken, is_not_free)?.into_bound(py) };
        let map = map_of_bools("occupancy", blocked.cast::<PyUntypedArray>()?)?;
        let world = frame(&map, resolution, origin)?;
        Ok(Self::new(map, Some(world)))
    }
}

/// The place of a map in the world; the origin is (0, 0) if it is left out.
pub(super) fn frame(
    map: &Map,
    resolution: &Bound<'_, PyAny>,
    origin: Option<&Bound<'_, PyAny>>,
) -> PyResult<WorldFrame> {
    use mediant::files::WorldError;
    let resolution = number("resolution", resolution)?;
    let origin = origin.map_or(Ok([0.0; 3]), place)?;
    WorldFrame::new(resolution, origin, map.width(), map.height()).map_err(|error| match error {
        WorldError::Origin { .. } => argument("origin", &error.to_string()),
        error => argument("resolution", &error.to_string()),
    })
}

/// x and y in meters, and a turn in radians that may be left out.
pub(crate) fn place(origin: &Bound<'_, PyAny>) -> PyResult<[f64; 3]> {
    let expected = "(x, y) in meters, or (x, y, yaw) with the turn in radians";
    let wrong = |cause| instead(origin.py(), cause, wrong_type("origin", expected, origin));
    let mut numbers = Vec::new();
    for item in origin.try_iter().map_err(wrong)? {
        numbers.push(number("origin", &item?)?);
        if numbers.len() > 3 {
            break;
        }
    }
    match numbers[..] {
        [x, y] => Ok([x, y, 0.0]),
        [x, y, yaw] => Ok([x, y, yaw]),
        _ => Err(argument("origin", &format!("expected {expected}, found another number of items"))),
    }
}

/// A number of columns or rows.
fn side(name: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<Option<usize>> {
    let Some(value) = value.filter(|value| !value.is_none()) else { return Ok(None) };
    Ok(Some(usize::try_from(integer(name, value, 0)?).unwrap_or(usize::MAX)))
}

/// A threshold, in percent.
fn percent(name: &str, value: Option<&Bound<'_, PyAny>>, default: f64) -> PyResult<f64> {
    let Some(value) = value else { return Ok(default) };
    let found = number(name, value)?;
    if (0.0..=100.0).contains(&found) {
        return Ok(found);
    }
    Err(argument(name, &format!("expected a percentage from 0 to 100, found {found}")))
}

/// The cells as an array of rows and columns, the highest row first.
fn rows<'py>(
    occupancy: &Bound<'py, PyAny>,
    width: Option<usize>,
    height: Option<usize>,
) -> PyResult<Bound<'py, PyAny>> {
    let (py, name) = (occupancy.py(), "occupancy");
    let wrong = |cause| instead(py, cause, wrong_type(name, "an array of integers", occupancy));
    let ma = py.import("numpy.ma")?;
    // Masked cells are unknown, as the usual converters of messages have it.
    let array = if occupancy.is_instance(&ma.getattr("MaskedArray")?)? {
        ma.call_method1("filled", (occupancy, -1)).map_err(wrong)?
    } else {
        numpy_function(py, "asarray")?.call1((occupancy,)).map_err(wrong)?
    };
    let array = array
        .cast_into::<PyUntypedArray>()
        .map_err(|_| wrong_type(name, "an array of integers", occupancy))?;
    // NumPy makes an empty list one of floats.
    let is_empty_list = array.is_empty() && array.dtype().kind() == b'f';
    if !matches!(array.dtype().kind(), b'i' | b'u') && !is_empty_list {
        let wrong = format!("{name}: expected integers from -1 to 100, found {}", array.dtype());
        return Err(PyTypeError::new_err(wrong));
    }
    let (rows, columns) = match (array.shape(), width) {
        (&[rows, columns], _) => (rows, columns),
        (&[cells], Some(width)) if width > 0 && cells % width == 0 => (cells / width, width),
        (&[cells], Some(width)) => {
            return Err(argument("width", &format!("{cells} cells do not fill rows of {width} cells")));
        }
        (&[_], None) => return Err(argument(name, "cells in one row need width=, the message.info.width")),
        (shape, _) => {
            return Err(argument(
                name,
                &format!("expected one row or rows and columns, found shape {shape:?}"),
            ));
        }
    };
    for (side, given, found) in [("width", width, columns), ("height", height, rows)] {
        if given.is_some_and(|given| given != found) {
            return Err(argument(side, &format!("the cells are {columns} columns and {rows} rows")));
        }
    }
    let table = array.call_method1("reshape", ((rows, columns),))?;
    numpy_function(py, "flipud")?.call1((table,))
}
