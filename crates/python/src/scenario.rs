//! Scenarios: queries of a benchmark with the lengths of their shortest paths.

use mediant_formats::{Instance, MapMismatch, Scenario as Inner};
use numpy::{PyArray1, PyArray2};
use pyo3::{prelude::*, types::PyList};

use crate::{
    arguments::{bytes, file},
    arrays::{points_array, rows_array},
    background::detached,
    errors::{exception, raised, wrong_type},
    grid::Grid,
};

/// The queries of a MovingAI scenario, ``.scen``, in the order of the file: `open` reads it.
///
/// Attributes
/// ----------
/// starts : numpy.ndarray
///     Where the paths begin: (row, column), shape (n, 2), int32, as `Grid.paths` takes them.
/// goals : numpy.ndarray
///     Where they end, in the same form.
/// lengths : numpy.ndarray
///     Shape (n,), float64: the lengths of shortest paths in cells that the file states, for eight directions
///     between centers that cut no corners (``k=3``, ``corners="never"``). Files round them. ``nan`` where
///     the file knows none: it has 0 there between two places.
/// buckets : numpy.ndarray
///     Shape (n,), uint32: queries of about the same length share a number.
/// maps : list of str
///     The name of each query's map.
/// shapes : numpy.ndarray
///     The number of rows and columns of each query's map, shape (n, 2), uint32.
///
/// Examples
/// --------
/// >>> import pathlib, tempfile
/// >>> import mediant
/// >>> file = pathlib.Path(tempfile.mkdtemp()) / "yard.map.scen"
/// >>> _ = file.write_text("version 1\n0\tyard.map\t3\t2\t0\t0\t2\t1\t2.41421\n")
/// >>> scenario = mediant.Scenario.open(file)
/// >>> scenario.starts.tolist(), scenario.goals.tolist(), scenario.lengths.tolist()
/// ([[0, 0]], [[1, 2]], [2.41421])
/// >>> grid = mediant.Grid.from_rows(["...", "..."])
/// >>> grid.paths(scenario.starts, scenario.goals).distances.round(5).tolist()
/// [2.41421]
#[pyclass(frozen, module = "mediant")]
pub(crate) struct Scenario {
    inner: Inner,
}

impl Scenario {
    /// The points that `of` finds in the queries.
    fn points<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&Instance) -> mediant::Vertex,
    ) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let flat: Vec<i32> = self.inner.instances().iter().map(of).flat_map(|at| [at.y, at.x]).collect();
        points_array(py, &flat)
    }

    /// The numbers that `of` finds in the queries.
    fn numbers<'py, T: numpy::Element>(
        &self,
        py: Python<'py>,
        of: impl Fn(&Instance) -> T,
    ) -> Bound<'py, PyArray1<T>> {
        PyArray1::from_iter(py, self.inner.instances().iter().map(of))
    }
}

#[pymethods]
impl Scenario {
    /// Reads a scenario from a file.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     The file.
    ///
    /// Returns
    /// -------
    /// Scenario
    ///     Its queries.
    ///
    /// Raises
    /// ------
    /// MissingFileError
    ///     For a file that does not exist. It is a FileNotFoundError, too.
    /// FileError
    ///     For a file that cannot be read, or is no scenario. It says in which line.
    ///
    /// Examples
    /// --------
    /// See `Scenario`.
    #[staticmethod]
    fn open(py: Python<'_>, path: &Bound<'_, PyAny>) -> PyResult<Self> {
        let path = file("path", path)?;
        let read = detached(py, u64::MAX, mediant::Limits::new(), move |_| Inner::read(path))?;
        Ok(Self { inner: read.map_err(raised)? })
    }

    /// Reads a scenario from the bytes of a file.
    ///
    /// Parameters
    /// ----------
    /// data : bytes
    ///     The bytes.
    ///
    /// Returns
    /// -------
    /// Scenario
    ///     Its queries.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     For what is no scenario.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> len(mediant.Scenario.from_bytes(b"version 1\n0 yard.map 3 2 0 0 2 1 2.41421\n"))
    /// 1
    #[staticmethod]
    fn from_bytes(py: Python<'_>, data: &Bound<'_, PyAny>) -> PyResult<Self> {
        let data = bytes("data", data)?;
        let read = py.detach(|| Inner::from_bytes(data));
        let wrong = |error: mediant_formats::ScenarioError| {
            exception("FileError", &format!("data: {error}"), mediant::ErrorCode::ScenarioFormat.name())
        };
        Ok(Self { inner: read.map_err(wrong)? })
    }

    /// Checks that each query was made for a map of this grid's size. Names are not compared.
    ///
    /// Parameters
    /// ----------
    /// grid : Grid
    ///     The map.
    ///
    /// Raises
    /// ------
    /// MismatchError
    ///     For the first query that was made for a map of another size.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> scenario = mediant.Scenario.from_bytes(b"version 1\n0 yard.map 3 2 0 0 2 1 2.41421\n")
    /// >>> scenario.check(mediant.Grid.from_rows(["...", "..."]))
    fn check(&self, grid: &Bound<'_, PyAny>) -> PyResult<()> {
        let Ok(grid) = grid.cast::<Grid>() else { return Err(wrong_type("grid", "a Grid", grid)) };
        let map = grid.get().map();
        self.inner.check_size((map.width(), map.height()), "the grid").map_err(|error| {
            let in_rows = |(width, height)| (height, width);
            let (expected_size, found_size) = (in_rows(error.expected_size), in_rows(error.found_size));
            let error = MapMismatch { expected_size, found_size, ..error };
            exception("MismatchError", &error.to_string(), mediant::ErrorCode::Mismatch.name())
        })
    }

    /// Where the paths begin.
    #[getter]
    fn starts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        self.points(py, |instance| instance.start)
    }

    /// Where the paths end.
    #[getter]
    fn goals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        self.points(py, |instance| instance.goal)
    }

    /// The lengths of shortest paths in cells.
    #[getter]
    fn lengths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.numbers(py, |instance| instance.known_optimal().unwrap_or(f64::NAN))
    }

    /// The bucket of each query.
    #[getter]
    fn buckets<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        self.numbers(py, |instance| instance.bucket)
    }

    /// The name of each query's map.
    #[getter]
    fn maps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        PyList::new(py, self.inner.instances().iter().map(|instance| &*instance.map))
    }

    /// The number of rows and columns of each query's map.
    #[getter]
    fn shapes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let sides = self.inner.instances().iter().flat_map(|instance| [instance.height, instance.width]);
        rows_array(py, sides.collect(), 2)
    }

    fn __len__(&self) -> usize {
        self.inner.instances().len()
    }

    fn __repr__(&self) -> String {
        format!("<mediant.Scenario of {} queries>", self.__len__())
    }
}
