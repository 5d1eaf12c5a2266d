//! Paths in a grid, and what engines prepare of it.

use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering},
};

use mediant::{
    Answer, Demand, Error, Limit, Limits, Stopped,
    search::{Progress, Stage},
};
use pyo3::{prelude::*, types::PyDict};

use super::Grid;
use crate::{
    answer::{self, PyAnswer},
    arguments::{Points, bytes, file},
    arrays::PathPoints,
    background::{detached, in_pool, on_thread},
    batch::{callback, read_threads},
    errors::raised,
    index::{Asked, Index},
    keywords::{ALL, Keywords, OPTIONS, PREPARATION, call_error},
};

#[pymethods]
impl Grid {
    /// A shortest path; where cells have costs, a cheapest one.
    ///
    /// The first call with some motion prepares a little; the grid keeps it for the next ones. For many paths
    /// `prepare` an index.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     (row, column); or several of each, shape (n, 2): the shortest path from any start to any goal. At
    ///     any angle also floats: any point of the free space, rounded to a multiple of 1/1024 of a cell.
    /// points : {"waypoints", "vertices", "touched"}
    ///     The points of the array: see `find`.
    /// **how
    ///     Motion, wishes, the engine and its options: see `find`.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray or None
    ///     Shape (n, 2), int32, through points between vertices float64; None if there is no path.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     For a start or goal that is blocked or outside the map.
    /// OptionError
    ///     For keywords that do not fit together.
    /// LimitReached
    ///     If a limit stopped the search.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    /// >>> grid.path((0, 0), (2, 3)).tolist()
    /// [[0, 0], [0, 3], [2, 3]]
    /// >>> grid.path((0, 0), (3, 4), k="any").tolist()
    /// [[0, 0], [1, 3], [3, 4]]
    /// >>> grid.path((0.5, 0.25), (2, 3), k="any").tolist()
    /// [[0.5, 0.25], [2.0, 1.0], [2.0, 3.0]]
    #[pyo3(
        signature = (start, goal, *, points = None, **how),
        text_signature = "($self, start, goal, *, points='waypoints', k=None, neighbors=None, placement=None, \
            corners=None, gap=None, nearest=False, snap=False, tolerance=None, max_cost=None, \
            max_expansions=None, timeout=None, engine='auto', heuristic=None, levels=None, memory=None, \
            side=None, landmarks=None, smooth=None)"
    )]
    fn path<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        points: Option<&Bound<'py, PyAny>>,
        how: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let keywords = Keywords::read("path", how, ALL)?;
        let planners = match self.planners(py, &keywords)? {
            Ok(planners) => planners,
            Err(error) => return Err(self.unprepared(&keywords, start, &error, points)?.1),
        };
        Asked { planners: &planners, start, goal, keywords }.path(py, points)
    }

    /// The length of a shortest path.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     As in `path`.
    /// **how
    ///     As in `find`.
    ///
    /// Returns
    /// -------
    /// float
    ///     In cells; ``inf`` if there is no path. At a number k it is the same number as in `distances`, a
    ///     `Field`, and tables, whatever the engine, if the engine's paths are shortest. Where cells have
    ///     costs it is the least cost.
    ///
    /// Raises
    /// ------
    /// QueryError, OptionError, LimitReached
    ///     As `path`.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    /// >>> [round(grid.distance((0, 0), (2, 2), k=k), 3) for k in (2, 3, 4)]
    /// [4.0, 4.0, 4.0]
    #[pyo3(
        signature = (start, goal, **how),
        text_signature = "($self, start, goal, *, k=None, neighbors=None, placement=None, corners=None, gap=None, \
            nearest=False, snap=False, tolerance=None, max_cost=None, max_expansions=None, timeout=None, \
            engine='auto', heuristic=None, levels=None, memory=None, side=None, landmarks=None, smooth=None)"
    )]
    fn distance<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        how: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<f64> {
        let keywords = Keywords::read("distance", how, ALL)?;
        let planners = match self.planners(py, &keywords)? {
            Ok(planners) => planners,
            Err(error) => return Err(self.unprepared(&keywords, start, &error, None)?.1),
        };
        Asked { planners: &planners, start, goal, keywords }.distance(py)
    }

    /// The whole answer to a query.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     As in `path`.
    /// points : {"waypoints", "vertices", "touched"}
    ///     The points of arrays of paths: the waypoints, joined by straight lines; each vertex at which a
    ///     move ends, the walk of an agent; or each cell that the path touches, which is no walk: passing
    ///     between four cells it touches all of them, and along a grid line those on both sides.
    /// counters : bool
    ///     Whether to count the events of the search, which makes it slower.
    /// k : int or "any"
    ///     The neighborhood, of 2**k directions: 2 is 4 directions, 3 (the default) 8, 4 is 16, up to 12;
    ///     "any" is every direction. k = 3 has 8 moves, k = 8 has 256.
    /// neighbors : int, optional
    ///     The neighborhood by its number of moves, in place of `k`: 4, 8, 16, … 4096.
    /// placement : {"center", "corner"}
    ///     Whether paths lead between centers of cells (the default for a number k) or corners of cells (the
    ///     default for "any"). Corner (row, column) is the top left one of cell (row, column).
    /// corners : {"never", "one", "always"}
    ///     At centers: where a move touches a corner of cells, both of the cells beside it must be free (the
    ///     default), one of them, or none. Without ``placement`` it means centers, also where the default is
    ///     corners.
    /// gap : {"open", "closed"}
    ///     At corners: whether a path may pass where two blocked cells touch diagonally. It may by default.
    ///     Without ``placement`` it means corners, also where the default is centers.
    /// nearest : bool
    ///     If there is no path: the path to the reachable vertex that is nearest to the goal.
    /// tolerance : float
    ///     The path may end within this many cells of the goal, exactly so many included.
    /// snap : bool
    ///     Moves a start or goal that is blocked to the nearest free vertex.
    /// max_cost : float, optional
    ///     The greatest length of a path, in cells, or its cost where cells have costs; a path that is
    ///     exactly as long is within it. An engine that guarantees nothing may miss a path that is nearly as
    ///     long.
    /// max_expansions : int, optional
    ///     The greatest number of expansions of the search.
    /// timeout : float, optional
    ///     The most seconds that the call may take, with what it prepares.
    /// engine : str, optional
    ///     The engine; by default one that prepares the grid in milliseconds, or a small grid in
    ///     microseconds.
    /// **options
    ///     Options of the engine: see `prepare`.
    ///
    /// Returns
    /// -------
    /// Answer
    ///     Path, length, and what stopped the search.
    ///
    /// Raises
    /// ------
    /// QueryError, OptionError
    ///     As `path`.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["..#.", "..#."])
    /// >>> grid.find((0, 0), (0, 3)).status
    /// 'unreachable'
    /// >>> answer = grid.find((0, 0), (0, 3), nearest=True)
    /// >>> answer.status, answer.path.tolist()
    /// ('nearest', [[0, 0], [0, 1]])
    /// >>> answer = grid.find((0, 0), (1, 1), max_cost=1)
    /// >>> answer.status, answer.stopped_by
    /// ('stopped', 'cost')
    #[pyo3(
        signature = (start, goal, *, points = None, counters = None, **how),
        text_signature = "($self, start, goal, *, points='waypoints', counters=False, k=None, neighbors=None, \
            placement=None, corners=None, gap=None, nearest=False, snap=False, tolerance=None, \
            max_cost=None, max_expansions=None, timeout=None, engine='auto', heuristic=None, levels=None, \
            memory=None, side=None, landmarks=None, smooth=None)"
    )]
    fn find<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        points: Option<&Bound<'py, PyAny>>,
        counters: Option<&Bound<'py, PyAny>>,
        how: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<PyAnswer> {
        let keywords = Keywords::read("find", how, ALL)?;
        let planners = match self.planners(py, &keywords)? {
            Ok(planners) => planners,
            Err(error) => return Ok(self.unprepared(&keywords, start, &error, points)?.0),
        };
        Asked { planners: &planners, start, goal, keywords }.find(py, points, counters)
    }

    /// The setup of a call: the engine, k, rule and options in one text. The same text, the same answers.
    ///
    /// Parameters
    /// ----------
    /// **how
    ///     As in `find`.
    ///
    /// Returns
    /// -------
    /// str
    ///     Of the engine that `path`, `distance` and `find` take.
    ///
    /// Raises
    /// ------
    /// OptionError
    ///     For keywords that do not fit together.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    /// >>> grid.setup(), grid.setup(k="any")
    /// ('canonical:3:never', 'anya:any:open')
    #[pyo3(
        signature = (**how),
        text_signature = "($self, *, k=None, neighbors=None, placement=None, corners=None, gap=None, nearest=False, \
            snap=False, tolerance=None, max_cost=None, max_expansions=None, timeout=None, engine='auto', \
            heuristic=None, levels=None, memory=None, side=None, landmarks=None, smooth=None)"
    )]
    fn setup(&self, how: Option<&Bound<'_, PyDict>>) -> PyResult<String> {
        let keywords = Keywords::read("setup", how, ALL)?;
        Ok(self.ground().setup(&keywords.call).map_err(call_error)?.to_string())
    }

    /// Prepares an index for many paths.
    ///
    /// Parameters
    /// ----------
    /// engine : str, optional
    ///     The engine; by default the one that `Grid.engine` names.
    /// k, placement, corners, gap
    ///     Motion, as in `find`.
    /// threads : int, optional
    ///     The number of threads; by default one for each core.
    /// progress : callable, optional
    ///     Called now and then with the stage (``"edges"``, ``"hierarchy"``, ``"sight"``, ``"labels"`` or
    ///     ``"vertices"``), and the number of subgoals that it has finished and of all, in the last stage of
    ///     blocks of vertices: a hierarchy leaves the last ones as they are. Only the engines on subgoals
    ///     report progress.
    /// heuristic : {"hk", "euclidean", "zero"}, optional
    ///     The heuristic of the search.
    /// levels : int, "all", "contracted" or "labels", optional
    ///     Of subgoal graphs and clusters. ``subgoal`` has hub labels by default if they fit in `memory`,
    ///     else a contraction hierarchy; `Index.levels` says which.
    /// memory : int or str, optional
    ///     The memory that the hub labels of ``subgoal`` may take: a number of bytes, or a text as ``"8MB"``.
    ///     The rest of it goes to labels of vertices, with which queries are faster on most
    ///     maps. By default they may take 64 bytes a cell, but at least 48 MB and at most 1 GB, and vertices
    ///     have none.
    /// side : int, optional
    ///     The side of a cluster or segment, in cells.
    /// smooth : {"linear", "taut"}, optional
    ///     Shortens paths after the search; they are at any angle then.
    ///
    /// Returns
    /// -------
    /// Index
    ///     For this grid and motion.
    ///
    /// Raises
    /// ------
    /// OptionError
    ///     For an engine that does not take the motion or the options, or a map too large for its index.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    /// >>> grid.prepare().engine, grid.prepare("jps", k=4).k
    /// ('subgoal', 4)
    #[pyo3(
        signature = (engine = None, *, threads = None, progress = None, **preparation),
        text_signature = "($self, engine=None, *, threads=None, progress=None, k=None, neighbors=None, placement=None, \
            corners=None, gap=None, heuristic=None, levels=None, memory=None, side=None, landmarks=None, \
            smooth=None)"
    )]
    fn prepare<'py>(
        &self,
        py: Python<'py>,
        engine: Option<&Bound<'py, PyAny>>,
        threads: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
        preparation: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Index> {
        let keywords = Keywords::read("prepare", preparation, PREPARATION)?.with("engine", engine)?;
        let (threads, progress) = (read_threads(threads)?, callback(progress)?);
        let space = self.space(py, keywords.motion()?)?;
        let (setup, _) = space.setup(&keywords.call, Demand::Paths(u64::MAX)).map_err(raised)?;
        let told = Arc::new(Told::default());
        let teller = Arc::clone(&told);
        let work = move |limits: &Limits| {
            let tell = |progress| teller.tell(progress);
            in_pool(threads, || space.within(limits).prepare_with_progress(setup.engine, &tell))
        };
        let index = on_thread(py, Limits::new(), work, |_| match (&progress, told.last()) {
            (Some(progress), Some(last)) => progress.call1(last).map(drop),
            _ => Ok(()),
        })?;
        let index = index.map_err(raised)?.with_smoothing(setup.smoothing);
        if let (Some(progress), Some(last)) = (&progress, told.last()) {
            progress.call1(last)?;
        }
        Ok(Index::new(self.clone(), index))
    }

    /// Reads an index that `Index.save` wrote for the same map. The file says for which motion it is.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     The file.
    /// **options
    ///     Options of the engine, as in `prepare`.
    ///
    /// Returns
    /// -------
    /// Index
    ///     The same as one prepared anew.
    ///
    /// Raises
    /// ------
    /// MissingFileError
    ///     For a file that does not exist.
    /// MismatchError
    ///     For an index of another map.
    /// IndexFileError
    ///     For a file that is damaged, no index, or one of another version.
    ///
    /// Examples
    /// --------
    /// See `Index.save`.
    #[pyo3(
        signature = (path, **options),
        text_signature = "($self, path, *, heuristic=None, levels=None, memory=None, side=None, landmarks=None, \
            smooth=None)"
    )]
    fn load(
        &self,
        py: Python<'_>,
        path: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Index> {
        let (path, keywords) = (file("path", path)?, Keywords::read("load", options, OPTIONS)?);
        let ground = self.ground().clone();
        let work = move |limits: &Limits| ground.load(path, limits);
        let index = detached(py, u64::MAX, Limits::new(), work)?.map_err(raised)?;
        self.with_options(index, &keywords)
    }

    /// The index of bytes that `Index.to_bytes` gave for the same map.
    ///
    /// Parameters
    /// ----------
    /// data : bytes
    ///     The bytes.
    /// **options
    ///     Options of the engine, as in `prepare`.
    ///
    /// Returns
    /// -------
    /// Index
    ///     The same as one prepared anew.
    ///
    /// Raises
    /// ------
    /// MismatchError, IndexFileError
    ///     As `load`.
    ///
    /// Examples
    /// --------
    /// See `Index.to_bytes`.
    #[pyo3(
        signature = (data, **options),
        text_signature = "($self, data, *, heuristic=None, levels=None, memory=None, side=None, landmarks=None, \
            smooth=None)"
    )]
    fn index_from_bytes(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Index> {
        let keywords = Keywords::read("index_from_bytes", options, OPTIONS)?;
        let (ground, data) = (self.ground().clone(), bytes("data", data)?);
        let work = move |limits: &Limits| ground.index_from_bytes(data, limits);
        let index = detached(py, u64::MAX, Limits::new(), work)?.map_err(raised)?;
        self.with_options(index, &keywords)
    }
}

impl Grid {
    /// The answer to a query whose preparation a limit stopped, and the same as an exception.
    fn unprepared(
        &self,
        keywords: &Keywords,
        start: &Bound<'_, PyAny>,
        error: &Error,
        points: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<(PyAnswer, PyErr)> {
        let by = if let Error::Stopped { by, .. } = error { *by } else { Limit::Timeout };
        let start_at = Points::read("start", start)?.as_slice().first().copied().unwrap_or_default();
        let answer = Answer::Stopped(Stopped::before_search(by, start_at));
        let (points, rules) = (PathPoints::read(points)?, keywords.motion()?.rules);
        answer::before_search(start.py(), &answer, points, rules, error)
    }

    /// An index that was read, with the options of a call.
    fn with_options(&self, index: mediant::Index, keywords: &Keywords) -> PyResult<Index> {
        let call = &keywords.call;
        let index = if call.has_options() { index.with_call(call).map_err(raised)? } else { index };
        Ok(Index::new(self.clone(), index))
    }
}

/// The last progress of a preparation.
#[derive(Default)]
struct Told {
    /// 0 before the first stage.
    stage: AtomicUsize,
    done: AtomicUsize,
    total: AtomicUsize,
}

impl Told {
    fn tell(&self, progress: Progress) {
        self.done.store(progress.done, Ordering::Relaxed);
        self.total.store(progress.total, Ordering::Relaxed);
        self.stage.store(progress.stage as usize + 1, Ordering::Relaxed);
    }

    fn last(&self) -> Option<(&'static str, usize, usize)> {
        let stage = self.stage.load(Ordering::Relaxed).checked_sub(1)?;
        let name = Stage::ALL.get(stage)?.name();
        Some((name, self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed)))
    }
}
