//! What an engine prepared.

use std::{path::PathBuf, sync::Arc};

use mediant::{Counters, Guarantee, Index as Prepared, K, Outcome, Planners, Setup};
use numpy::{PyArray1, PyArray2};
use pyo3::{
    prelude::*,
    types::{PyBytes, PyDict, PyTuple},
};

use crate::{
    answer::{self, Answer},
    arguments::Points,
    arrays::PathPoints,
    background::{Interruption, detached, is_watched, on_thread},
    batch::{self, Batch, Paths},
    errors::{raised, wrong_type},
    grid::Grid,
    keywords::{Keywords, Takes},
};

/// What an engine prepared of a grid: paths in microseconds.
///
/// `Grid.prepare`, `Grid.load` and pickle make it. It never changes; all threads can share it, and each query
/// runs with the GIL released.
///
/// Attributes
/// ----------
/// grid : Grid
///     The grid that it belongs to.
/// engine : str
///     The engine.
/// k : int or "any"
///     The neighborhood.
/// placement : {"center", "corner"}
///     Where the vertices are.
/// rule : {"never", "one", "always", "open", "closed"}
///     The rule at corners of cells, or at gaps.
/// setup : str
///     All of it and the options in one text: the same text, the same answers.
/// origin : {"prepared", "loaded", "repaired", "unchanged"}
///     How it came about.
/// guarantee : str
///     What is guaranteed of its paths.
/// bound : float or None
///     How much longer than the shortest at any angle its paths can be, as a factor; None if nothing is proven.
/// memory_bytes : int
///     The memory that it uses beyond the grid.
///
/// Examples
/// --------
/// >>> import mediant
/// >>> index = mediant.Grid.from_rows(["....", ".##.", "...."]).prepare()
/// >>> index
/// <mediant.Index subgoal:3:never of 3 × 4 cells>
/// >>> index.path((0, 0), (2, 3)).tolist()
/// [[0, 0], [0, 3], [2, 3]]
#[pyclass(frozen, module = "mediant")]
pub(crate) struct Index {
    grid: Grid,
    planners: Arc<Planners>,
}

impl Index {
    pub(crate) fn new(grid: Grid, index: Prepared) -> Self {
        Self { grid, planners: Arc::new(Planners::new(index)) }
    }

    fn setup(&self) -> Setup {
        self.planners.index().setup()
    }

    fn guarantee(&self) -> (Guarantee, Option<f64>) {
        self.planners.with(|planner| (planner.guarantee(), planner.bound()))
    }
}

/// A query on planners, as it was asked.
pub(crate) struct Asked<'a, 'py> {
    pub(crate) planners: &'a Arc<Planners>,
    pub(crate) start: &'a Bound<'py, PyAny>,
    pub(crate) goal: &'a Bound<'py, PyAny>,
    pub(crate) keywords: Keywords,
}

impl Asked<'_, '_> {
    /// Answers it with the GIL released.
    fn outcome(&self, counts: bool) -> PyResult<(Outcome, Option<Counters>)> {
        let (start, goal) = (Points::read("start", self.start)?, Points::read("goal", self.goal)?);
        let is_watched = self.keywords.timeout().is_some() || is_watched(self.planners.index());
        let interruption = is_watched.then(Interruption::default);
        let request = self.keywords.request(&start, &goal, interruption.as_ref());
        let answer = self.start.py().detach(|| {
            if counts {
                let find = |planner: &mut mediant::Planner| planner.find_counted(request);
                return self.planners.with(find).map(|(outcome, counters)| (outcome, Some(counters)));
            }
            self.planners.find(request).map(|outcome| (outcome, None))
        });
        if let Some(error) = interruption.and_then(|interruption| interruption.take()) {
            return Err(error);
        }
        answer.map_err(raised)
    }

    /// `path`.
    pub(crate) fn path<'py>(
        &self,
        py: Python<'py>,
        points: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyArray2<i32>>>> {
        let points = PathPoints::read(points)?;
        let placement = self.planners.index().setup().rules.placement();
        let outcome = answer::whole(py, self.outcome(false)?.0, points, placement)?;
        outcome.path().map(|path| points.array(py, path, placement)).transpose()
    }

    /// `distance`.
    pub(crate) fn distance(&self, py: Python<'_>) -> PyResult<f64> {
        let placement = self.planners.index().setup().rules.placement();
        let outcome = answer::whole(py, self.outcome(false)?.0, PathPoints::Waypoints, placement)?;
        Ok(answer::distance(&outcome))
    }

    /// `find`.
    pub(crate) fn find(
        &self,
        py: Python<'_>,
        points: Option<&Bound<'_, PyAny>>,
        counters: bool,
    ) -> PyResult<Answer> {
        let points = PathPoints::read(points)?;
        let setup = self.planners.index().setup();
        let (outcome, counters) = self.outcome(counters)?;
        let is_optimal = setup.optimal_over().is_some();
        Answer::new(py, &outcome, points, setup.rules.placement(), (is_optimal, counters))
    }
}

#[pymethods]
impl Index {
    /// The grid that it belongs to.
    #[getter]
    fn grid(&self) -> Grid {
        self.grid.clone()
    }

    /// The engine.
    #[getter]
    fn engine(&self) -> &'static str {
        self.setup().engine.kind().name()
    }

    /// The neighborhood: a number, or "any".
    #[getter]
    fn k<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match self.setup().k {
            K::Finite(k) => Ok(k.get().into_pyobject(py)?.into_any()),
            K::Any => Ok("any".into_pyobject(py)?.into_any()),
        }
    }

    /// Where the vertices are.
    #[getter]
    fn placement(&self) -> String {
        self.setup().rules.placement().to_string()
    }

    /// The rule at corners of cells, or at gaps.
    #[getter]
    fn rule(&self) -> String {
        self.setup().rule_name()
    }

    /// The engine, k, rule and options in one text.
    #[getter(setup)]
    fn setup_text(&self) -> String {
        self.setup().to_string()
    }

    /// How it came about.
    #[getter]
    fn origin(&self) -> &'static str {
        match self.planners.index().origin() {
            mediant::Origin::Loaded => "loaded",
            mediant::Origin::Repaired => "repaired",
            mediant::Origin::Unchanged => "unchanged",
            _ => "prepared",
        }
    }

    /// What is guaranteed of its paths.
    #[getter(guarantee)]
    fn guarantee_text(&self) -> String {
        match self.guarantee().0 {
            Guarantee::Optimal(k) => format!("shortest over k = {k}"),
            Guarantee::AtMost(k) => format!("at most as long as the shortest over k = {k}"),
            Guarantee::OptimalAnyAngle => "shortest at any angle".to_owned(),
            Guarantee::Suboptimal => "none".to_owned(),
        }
    }

    /// How much longer than the shortest path at any angle its paths can be.
    #[getter]
    fn bound(&self) -> Option<f64> {
        self.guarantee().1
    }

    /// The memory that it uses beyond the grid, in bytes.
    #[getter]
    fn memory_bytes(&self) -> u64 {
        self.planners.index().memory_bytes()
    }

    /// A shortest path.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     (row, column); or several of each, shape (n, 2): the shortest path from any start to any goal.
    /// points : {"waypoints", "vertices", "cells"}
    ///     What the array has: see `Grid.find`.
    /// **wishes
    ///     ``nearest``, ``tolerance``, ``snap`` and limits: see `Grid.find`.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray or None
    ///     Shape (n, 2), int32; None if there is no path.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     For a start or goal that is blocked or outside the map.
    /// LimitReached
    ///     If a limit stopped the search.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["....", ".##.", "...."]).prepare()
    /// >>> index.path((0, 0), (2, 2), points="cells").tolist()
    /// [[0, 0], [1, 0], [2, 0], [2, 1], [2, 2]]
    #[pyo3(signature = (start, goal, *, points = None, **wishes))]
    fn path<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        points: Option<&Bound<'py, PyAny>>,
        wishes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Option<Bound<'py, PyArray2<i32>>>> {
        let keywords = Keywords::read("path", wishes, Takes::WISHES)?;
        Asked { planners: &self.planners, start, goal, keywords }.path(py, points)
    }

    /// The length of a shortest path.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     As in `path`.
    /// **wishes
    ///     As in `path`.
    ///
    /// Returns
    /// -------
    /// float
    ///     In cells; ``inf`` if there is no path.
    ///
    /// Raises
    /// ------
    /// QueryError, LimitReached
    ///     As `path`.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["....", ".##.", "...."]).prepare().distance((0, 0), (2, 3))
    /// 5.0
    #[pyo3(signature = (start, goal, **wishes))]
    fn distance<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        wishes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<f64> {
        let keywords = Keywords::read("distance", wishes, Takes::WISHES)?;
        Asked { planners: &self.planners, start, goal, keywords }.distance(py)
    }

    /// The whole answer to a query.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     As in `path`.
    /// points : {"waypoints", "vertices", "cells"}
    ///     What arrays of paths have: see `Grid.find`.
    /// counters : bool
    ///     Whether to count the events of the search, which makes it slower.
    /// **wishes
    ///     As in `path`.
    ///
    /// Returns
    /// -------
    /// Answer
    ///     Path, length, and what stopped the search.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     As `path`.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["..#.", "..#."]).prepare("astar")
    /// >>> answer = index.find((0, 0), (0, 3), nearest=True, counters=True)
    /// >>> answer.status, answer.path.tolist(), answer.counters["expanded"] > 0
    /// ('nearest', [[0, 0], [0, 1]], True)
    #[pyo3(signature = (start, goal, *, points = None, counters = false, **wishes))]
    fn find<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        points: Option<&Bound<'py, PyAny>>,
        counters: bool,
        wishes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Answer> {
        let keywords = Keywords::read("find", wishes, Takes::WISHES)?;
        Asked { planners: &self.planners, start, goal, keywords }.find(py, points, counters)
    }

    /// The shortest paths of many queries, on all cores.
    ///
    /// Parameters
    /// ----------
    /// starts, goals : array_like of int
    ///     (row, column) points, shape (n, 2); one single point stands for all queries.
    /// points : {"waypoints", "vertices", "cells"}
    ///     What the arrays have: see `Grid.find`.
    /// threads : int, optional
    ///     The number of threads; by default one for each core. The answers are the same on any number.
    /// progress : callable, optional
    ///     Called now and then with the number of queries that were answered and of all.
    /// invalid : {"raise", "none"}
    ///     What to do with a query whose start or goal is blocked or outside the map: raise an error, or
    ///     answer it with no path.
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
    #[pyo3(signature = (starts, goals, *, points = None, threads = None, progress = None, invalid = None, **wishes))]
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
        let keywords = Keywords::read("paths", wishes, Takes::WISHES)?;
        let ends = (Points::read("starts", starts)?, Points::read("goals", goals)?);
        let batch = Batch::read(threads, progress, invalid)?;
        batch::paths(py, &self.planners, ends, PathPoints::read(points)?, (keywords, &batch))
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
    ///     Shape (n,), float64: in cells; ``inf`` where no path leads, ``nan`` where an end is invalid or a limit
    ///     stopped the search.
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
    #[pyo3(signature = (starts, goals, *, threads = None, progress = None, invalid = None, **wishes))]
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
        let keywords = Keywords::read("distances", wishes, Takes::WISHES)?;
        let ends = (Points::read("starts", starts)?, Points::read("goals", goals)?);
        let batch = Batch::read(threads, progress, invalid)?;
        batch::distances(py, &self.planners, ends, (keywords, &batch))
    }

    /// The lengths of the shortest paths from each start to each goal, on all cores.
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
        let ends = (Points::read("starts", starts)?, Points::read("goals", goals)?);
        batch::table(py, &self.planners, ends, &Batch::read(threads, progress, None)?)
    }

    /// The same index for queries with other options of its engine, such as another heuristic or smoothing.
    ///
    /// Parameters
    /// ----------
    /// **options
    ///     As in `Grid.prepare`. Those that are left out have their defaults.
    ///
    /// Returns
    /// -------
    /// Index
    ///     It shares what is prepared with this one.
    ///
    /// Raises
    /// ------
    /// OptionError
    ///     For options that the engine does not take, or that decide what is prepared, if this index has others.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["...", "..."]).prepare("astar")
    /// >>> index.with_options(heuristic="euclidean").setup
    /// 'astar:3:never,euclidean'
    #[pyo3(signature = (**options))]
    fn with_options(&self, options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let keywords = Keywords::read("with_options", options, Takes::OPTIONS)?;
        let index = self.planners.index().clone();
        let engine = keywords.configured(index.setup().engine.kind())?;
        let index = index.with_options(engine).map_err(raised)?.with_smoothing(keywords.smoothing);
        Ok(Self::new(self.grid.clone(), index))
    }

    /// The index for an edited grid.
    ///
    /// Clusters and segments (``hpa``, ``chpa``) are repaired where the grids differ; the other engines' indexes
    /// are prepared anew. `origin` says which it was. This index stays as it is.
    ///
    /// Parameters
    /// ----------
    /// grid : Grid
    ///     The edited grid.
    ///
    /// Returns
    /// -------
    /// Index
    ///     The same as one prepared anew.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", "####", "...."])
    /// >>> opened = grid.edit((1, 2), [[False]])
    /// >>> grid.prepare("hpa").repair(opened).path((0, 0), (2, 0)) is not None
    /// True
    fn repair(&self, py: Python<'_>, grid: &Bound<'_, PyAny>) -> PyResult<Self> {
        let Ok(changed) = grid.cast::<Grid>() else { return Err(wrong_type("grid", "a Grid", grid)) };
        let (changed, index) = (changed.get().clone(), self.planners.index().clone());
        let map = changed.map().clone();
        let work = move || {
            let space = map.space(index.setup().motion())?;
            crate::background::in_pool(None, || index.repair(&space))
        };
        Ok(Self::new(changed, on_thread(py, work, |_| Ok(()))?.map_err(raised)?))
    }

    /// Writes the index to a file, for `Grid.load`. An older file there is replaced as a whole.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     The file.
    ///
    /// Raises
    /// ------
    /// OptionError
    ///     For an engine whose index is not saved.
    /// FileError
    ///     If the operating system refuses.
    ///
    /// Examples
    /// --------
    /// >>> import pathlib, tempfile
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    /// >>> file = pathlib.Path(tempfile.mkdtemp()) / "map.index"
    /// >>> grid.prepare().save(file)
    /// >>> grid.load(file).distance((0, 0), (2, 3))
    /// 5.0
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| self.planners.index().save(path)).map_err(raised)
    }

    /// The bytes of the index's file, for `Grid.index_from_bytes`.
    ///
    /// Returns
    /// -------
    /// bytes
    ///     With a checksum; the map is not among them.
    ///
    /// Raises
    /// ------
    /// OptionError
    ///     For an engine whose index is not saved.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    /// >>> grid.index_from_bytes(grid.prepare().to_bytes()).engine
    /// 'subgoal'
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = py.detach(|| self.planners.index().to_bytes()).map_err(raised)?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// By the grid, the setup and the saved bytes, for pickle. An engine that saves nothing is prepared anew.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, index) = (slf.py(), slf.get());
        let bytes = match index.setup().index_version() {
            Ok(_) => Some(index.to_bytes(py)?),
            Err(_) => None,
        };
        let state = (index.grid.clone(), index.setup_text(), bytes).into_pyobject(py)?;
        Ok((slf.get_type().getattr("_of_state")?, state))
    }

    /// The index of a state that `__reduce__` gave.
    #[staticmethod]
    fn _of_state(
        py: Python<'_>,
        grid: &Bound<'_, Grid>,
        setup: &str,
        bytes: Option<Vec<u8>>,
    ) -> PyResult<Self> {
        let setup: Setup = setup.parse().map_err(|error: mediant::TextError| raised(error))?;
        let grid = grid.get().clone();
        let map = grid.map().clone();
        let work = move || match bytes {
            None => setup.prepare(&setup.space(&map)?),
            Some(bytes) => {
                let index = map.index_from_bytes(bytes)?;
                Ok(index.with_options(setup.engine)?.with_smoothing(setup.smoothing))
            }
        };
        let index = detached(py, u64::MAX, work)?.map_err(raised)?;
        Ok(Self::new(grid, index))
    }

    fn __repr__(&self) -> String {
        let map = self.grid.map();
        format!("<mediant.Index {} of {} × {} cells>", self.setup(), map.height(), map.width())
    }
}
