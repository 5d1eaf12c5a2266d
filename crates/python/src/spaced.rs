//! Points along a path, evenly spaced.

use mediant::Path;
use pyo3::{exceptions::PyMemoryError, prelude::*};

use crate::{
    arguments::{number, path_points},
    arrays::rows_array,
    errors::argument,
};

/// The most points: of 16 GiB.
const MOST_POINTS: f64 = (1_u64 << 30) as f64;

/// Points along a path, evenly spaced.
///
/// Parameters
/// ----------
/// path : array_like of int
///     Waypoints, shape (n, 2): a path that was found, or any other.
/// spacing : float
///     Their distance from each other, in cells as measured along the path. For meters divide them by
///     `World.resolution`.
///
/// Returns
/// -------
/// numpy.ndarray
///     Shape (m, 2), float64: (row, column), fractions of cells among them. The first one is the start, the
///     last one the end of the path: the last step is shorter unless the length is a multiple of the spacing.
///
/// Raises
/// ------
/// ArgumentError
///     For a spacing of 0 or less, and one so small that there are more than 2**30 points.
///
/// Examples
/// --------
/// >>> import mediant
/// >>> mediant.spaced([(0, 0), (0, 2), (1, 2)], 1.25).tolist()
/// [[0.0, 0.0], [0.0, 1.25], [0.5, 2.0], [1.0, 2.0]]
#[pyfunction]
#[pyo3(signature = (path, spacing), text_signature = "(path, spacing)")]
pub(crate) fn spaced<'py>(
    path: &Bound<'py, PyAny>,
    spacing: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let (py, path) = (path.py(), Path::through(path_points("path", path)?));
    let spacing = number("spacing", spacing)?;
    let points = path.spaced(spacing).map_err(|error| argument("spacing", &error.to_string()))?;
    let count = path.cost() / spacing;
    if count > MOST_POINTS {
        return Err(argument("spacing", &format!("{count:e} points: at most 2^30 fit; give a larger one")));
    }
    let mut flat = Vec::new();
    flat.try_reserve_exact(2 * (count as usize + 3))
        .map_err(|_| PyMemoryError::new_err("there is no room for the points"))?;
    py.detach(|| points.for_each(|(x, y)| flat.extend([y, x])));
    rows_array(py, flat, 2)
}
