//! Many paths in a grid.

use mediant::Limits;
use pyo3::{prelude::*, types::PyDict};

use super::Grid;
use crate::{
    arrays::PathPoints,
    batch::{self, Batch, Queries},
    errors::raised,
    keywords::{ALL, Keywords},
    paths::Paths,
};

#[pymethods]
impl Grid {
    /// The shortest paths of many queries, on all cores, by the engine that `path` takes.
    ///
    /// The first call with some motion prepares a little; the grid keeps it for the next ones. For more than
    /// about a thousand paths `prepare` an index, which has the same call.
    ///
    /// Parameters
    /// ----------
    /// starts, goals : array_like of int
    ///     (row, column) points, shape (n, 2); one single point stands for all queries.
    /// points : {"waypoints", "vertices", "touched"}
    ///     The points of the arrays: see `find`.
    /// threads, progress, invalid
    ///     As in `Index.paths`.
    /// **how
    ///     Motion, the engine and its options, and the wishes of each query: see `find`. A ``timeout`` is
    ///     that of each query; what the grid prepares does not count.
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
    /// OptionError
    ///     For keywords that do not fit together.
    /// ArgumentError
    ///     For arrays of other shapes, or different lengths.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    /// >>> [path.tolist() for path in grid.paths((0, 0), [(0, 3), (2, 0)])]
    /// [[[0, 0], [0, 3]], [[0, 0], [2, 0]]]
    #[pyo3(
        signature = (starts, goals, *, points = None, threads = None, progress = None, invalid = None, **how),
        text_signature = "($self, starts, goals, *, points='waypoints', threads=None, progress=None, invalid='raise', \
            k=None, neighbors=None, placement=None, corners=None, gap=None, nearest=False, snap=False, \
            tolerance=None, max_cost=None, max_expansions=None, timeout=None, engine='auto', heuristic=None, \
            levels=None, memory=None, side=None, landmarks=None, smooth=None)"
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
        how: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Paths> {
        let keywords = Keywords::read("paths", how, ALL)?;
        let (points, batch) = (PathPoints::read(points)?, Batch::read(threads, progress, invalid)?);
        let planners = self.planners_within(py, &keywords, Limits::new())?.map_err(raised)?;
        batch::paths(py, &planners, Queries::pairs(starts, goals, keywords)?, points, &batch)
    }
}
