//! Many paths on an index.

use numpy::PyArray1;
use pyo3::{prelude::*, types::PyDict};

use super::Index;
use crate::{
    arrays::PathPoints,
    batch::{self, Batch, NearestArrays, Queries},
    keywords::{Keywords, WISHES},
    paths::Paths,
};

#[pymethods]
impl Index {
    /// The shortest paths of many queries, on all cores.
    ///
    /// Parameters
    /// ----------
    /// starts, goals : array_like of int
    ///     (row, column) points, shape (n, 2); one single point stands for all queries.
    /// points : {"waypoints", "vertices", "touched"}
    ///     The points of the arrays: see `Grid.find`.
    /// threads : int, optional
    ///     The number of threads; by default one for each core. The answers are the same on any number.
    /// progress : callable, optional
    ///     Called now and then with the number of queries that were answered and of all.
    /// invalid : {"raise", "none"}
    ///     For a query whose start or goal is blocked or outside the map: raise an error, or answer it with
    ///     no path.
    /// **wishes
    ///     Of each query: see `Grid.find`.
    ///
    /// Returns
    /// -------
    /// Paths
    ///     A sequence of arrays or None, in the order of the queries.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     For the first query that is invalid.
    /// ArgumentError
    ///     For arrays of other shapes, or different lengths.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["....", ".##.", "...."]).prepare()
    /// >>> [path.tolist() for path in index.paths((0, 0), [(0, 3), (2, 0)])]
    /// [[[0, 0], [0, 3]], [[0, 0], [2, 0]]]
    #[pyo3(
        signature = (starts, goals, *, points = None, threads = None, progress = None, invalid = None, **wishes),
        text_signature = "($self, starts, goals, *, points='waypoints', threads=None, progress=None, invalid='raise', \
            nearest=False, snap=False, tolerance=None, max_cost=None, max_expansions=None, timeout=None)"
    )]
    #[expect(clippy::too_many_arguments, reason = "the keywords of a call in Python")]
    fn paths<'py>(
        &self,
        py: Python<'py>,
        starts: &Bound<'py, PyAny>,
        goals: &Bound<'py, PyAny>,
        points: Option<&Bound<'py, PyAny>>,
        threads: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
        invalid: Option<&Bound<'py, PyAny>>,
        wishes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Paths> {
        let queries = Queries::pairs(starts, goals, Keywords::read("paths", wishes, WISHES)?)?;
        let batch = Batch::read(threads, progress, invalid)?;
        batch::paths(py, &self.planners, queries, PathPoints::read(points)?, &batch)
    }

    /// The lengths of the shortest paths of many queries, on all cores.
    ///
    /// Parameters
    /// ----------
    /// starts, goals : array_like of int
    ///     As in `paths`.
    /// threads, progress, invalid
    ///     As in `paths`.
    /// **wishes
    ///     As in `paths`.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     Shape (n,), float64: in cells; ``inf`` where no path leads, ``nan`` where an end is invalid or a
    ///     limit stopped the search. Hub labels measure without the paths: see `distance`.
    ///
    /// Raises
    /// ------
    /// QueryError, ArgumentError
    ///     As `paths`.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["....", ".##.", "...."]).prepare()
    /// >>> index.distances((0, 0), [(0, 3), (2, 3)]).tolist()
    /// [3.0, 5.0]
    #[pyo3(
        signature = (starts, goals, *, threads = None, progress = None, invalid = None, **wishes),
        text_signature = "($self, starts, goals, *, threads=None, progress=None, invalid='raise', nearest=False, \
            snap=False, tolerance=None, max_cost=None, max_expansions=None, timeout=None)"
    )]
    #[expect(clippy::too_many_arguments, reason = "the keywords of a call in Python")]
    fn distances<'py>(
        &self,
        py: Python<'py>,
        starts: &Bound<'py, PyAny>,
        goals: &Bound<'py, PyAny>,
        threads: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
        invalid: Option<&Bound<'py, PyAny>>,
        wishes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let queries = Queries::pairs(starts, goals, Keywords::read("distances", wishes, WISHES)?)?;
        batch::distances(py, &self.planners, queries, &Batch::read(threads, progress, invalid)?)
    }

    /// The lengths of the shortest paths from each start to each goal, on all cores.
    ///
    /// With hub labels (`levels`) it takes far less time than a query for each pair.
    ///
    /// Parameters
    /// ----------
    /// starts, goals : array_like of int
    ///     (row, column) points, shapes (n, 2) and (m, 2).
    /// threads, progress
    ///     As in `paths`.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     Shape (n, m), float64: in cells; ``inf`` where no path leads.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     For an end that is blocked or outside the map.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["....", ".##.", "...."]).prepare()
    /// >>> index.table([(0, 0), (0, 1)], [(0, 3), (2, 0)]).tolist()
    /// [[3.0, 2.0], [2.0, 3.0]]
    #[pyo3(signature = (starts, goals, *, threads = None, progress = None))]
    fn table<'py>(
        &self,
        py: Python<'py>,
        starts: &Bound<'py, PyAny>,
        goals: &Bound<'py, PyAny>,
        threads: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let queries = Queries::table(starts, goals)?;
        batch::table(py, &self.planners, queries, &Batch::read(threads, progress, None)?)
    }
    /// The nearest goal of each start, on all cores.
    ///
    /// With hub labels (`levels`) a start takes one to two queries, also for a thousand goals; on another
    /// index a search for all goals.
    ///
    /// Parameters
    /// ----------
    /// starts, goals : array_like of int
    ///     (row, column) points, shapes (n, 2) and (m, 2).
    /// threads, progress
    ///     As in `paths`.
    /// invalid : {"raise", "none"}
    ///     For a start or goal that is blocked or outside the map: raise an error, or give that start no
    ///     goal, and that goal to no start.
    ///
    /// Returns
    /// -------
    /// numbers : numpy.ndarray
    ///     Shape (n,), int64: the number of the goal to which the path is shortest, with labels the first of
    ///     several; -1 where no path leads to any, or the start is invalid.
    /// distances : numpy.ndarray
    ///     Shape (n,), float64: the lengths of these paths in cells; ``inf`` where no path leads to any goal,
    ///     ``nan`` where the start is invalid.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     For the first goal, then for the first start that is invalid.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["....", ".##.", "...."]).prepare()
    /// >>> numbers, distances = index.nearest([(0, 0), (2, 2)], [(0, 3), (2, 3)])
    /// >>> numbers.tolist(), distances.tolist()
    /// ([0, 1], [3.0, 1.0])
    #[pyo3(
        signature = (starts, goals, *, threads = None, progress = None, invalid = None),
        text_signature = "($self, starts, goals, *, threads=None, progress=None, invalid='raise')"
    )]
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        starts: &Bound<'py, PyAny>,
        goals: &Bound<'py, PyAny>,
        threads: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
        invalid: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<NearestArrays<'py>> {
        batch::nearest(py, &self.planners, starts, goals, &Batch::read(threads, progress, invalid)?)
    }
}
