//! The answers to many queries.

use numpy::PyArray1;
use pyo3::{
    exceptions::PyIndexError,
    prelude::*,
    types::{PyList, PySlice, PyTuple},
};

use crate::errors::{argument, wrong_type};

/// The answers of `Index.paths`, in the order of the queries: a sequence of arrays or None, in flat arrays.
///
/// Attributes
/// ----------
/// points : numpy.ndarray
///     The points of all paths, one after the other: shape (m, 2), int32; float64 where ends are between
///     vertices, and at any angle between centers.
/// offsets : numpy.ndarray
///     Shape (n + 1,), int64: path i has the points from ``offsets[i]`` up to ``offsets[i + 1]``. Where there
///     is no path the two are equal.
/// distances : numpy.ndarray
///     Shape (n,), float64: lengths in cells; ``inf`` where no path leads, ``nan`` where a limit stopped the
///     search or an end is invalid.
/// statuses : numpy.ndarray
///     Shape (n,), uint8: 0 found, 1 unreachable, 2 nearest, 3 stopped, 4 invalid.
///
/// Examples
/// --------
/// >>> import mediant
/// >>> index = mediant.Grid.from_rows(["..#.", "..#."]).prepare()
/// >>> paths = index.paths([(0, 0), (0, 0)], [(1, 1), (0, 3)])
/// >>> len(paths), paths[0].tolist(), paths[1]
/// (2, [[0, 0], [1, 1]], None)
/// >>> paths.offsets.tolist(), paths.statuses.tolist()
/// ([0, 2, 2], [0, 1])
#[pyclass(frozen, module = "mediant")]
pub(crate) struct Paths {
    /// The points of all paths, shape (m, 2).
    #[pyo3(get)]
    pub(crate) points: Py<PyAny>,
    /// Where each path begins in the points, and where the last one ends.
    #[pyo3(get)]
    pub(crate) offsets: Py<PyArray1<i64>>,
    /// The lengths in cells.
    #[pyo3(get)]
    pub(crate) distances: Py<PyArray1<f64>>,
    /// The status of each query, as a number.
    #[pyo3(get)]
    pub(crate) statuses: Py<PyArray1<u8>>,
}

#[pymethods]
impl Paths {
    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.distances.bind(py).len()
    }

    fn __getitem__<'py>(&self, index: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let py = index.py();
        let count = self.__len__(py)? as isize;
        if let Ok(slice) = index.cast::<PySlice>() {
            let range = slice.indices(count)?;
            let numbers = (0..range.slicelength as isize).map(|at| range.start + at * range.step);
            let paths: Vec<_> = numbers.map(|at| self.path(py, at)).collect::<PyResult<_>>()?;
            return Ok(PyList::new(py, paths)?.into_any());
        }
        let index: isize =
            index.extract().map_err(|_| wrong_type("index", "an integer or a slice", index))?;
        let at = if index < 0 { index + count } else { index };
        if !(0..count).contains(&at) {
            return Err(PyIndexError::new_err(format!("path {index} of {count}")));
        }
        Ok(self.path(py, at)?.into_pyobject(py)?)
    }

    fn __iter__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let builtins = slf.py().import("builtins")?;
        let numbers = builtins.getattr("range")?.call1((slf.len()?,))?;
        builtins.getattr("map")?.call1((slf.getattr("__getitem__")?, numbers))
    }

    /// By the four arrays, for pickle.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, paths) = (slf.py(), slf.get());
        let arrays = (&paths.points, &paths.offsets, &paths.distances, &paths.statuses).into_pyobject(py)?;
        Ok((slf.get_type().getattr("_of_arrays")?, arrays))
    }

    /// The answers with these arrays.
    #[staticmethod]
    fn _of_arrays(
        points: Bound<'_, PyAny>,
        offsets: Bound<'_, PyArray1<i64>>,
        distances: Bound<'_, PyArray1<f64>>,
        statuses: Bound<'_, PyArray1<u8>>,
    ) -> PyResult<Self> {
        let count = distances.len()?;
        if offsets.len()? != count + 1 || statuses.len()? != count {
            return Err(argument("offsets", "expected one more than there are distances and statuses"));
        }
        Ok(Self {
            points: points.unbind(),
            offsets: offsets.unbind(),
            distances: distances.unbind(),
            statuses: statuses.unbind(),
        })
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<mediant.Paths of {} queries>", self.__len__(py)?))
    }
}

impl Paths {
    /// One of the paths.
    fn path<'py>(&self, py: Python<'py>, at: isize) -> PyResult<Option<Bound<'py, PyAny>>> {
        let offset = |at: isize| -> PyResult<isize> { self.offsets.bind(py).get_item(at)?.extract() };
        let (first, end) = (offset(at)?, offset(at + 1)?);
        let points = || self.points.bind(py).get_item(PySlice::new(py, first, end, 1));
        (first < end).then(points).transpose()
    }
}
