//! A search in steps, and what it did.

use std::{
    path::PathBuf,
    sync::{Arc, Mutex, MutexGuard},
};

use mediant::{Answer, Limits, Path, Planner, PointEnds, Rules, errors::QueryError, search::Observer};
use numpy::PyArray2;
use pyo3::{prelude::*, types::PyDict};

use super::{
    Index,
    trace::{Events, Kind, Watched},
};
use crate::{
    answer::{PyAnswer, Searched},
    arguments::{Points, file, flag, integer, point as asked_point},
    arrays::{PathPoints, points_array},
    background::on_thread,
    errors::{argument, raised},
    keywords::{Keywords, WISHES},
};

/// A search that goes on in steps: `Index.search` makes it.
///
/// Between steps its state can be read. It finds the same path by the same expansions as `Index.find`. It has
/// scratch memory of its own. Ctrl-C ends a step, after which the search can go on.
///
/// Attributes
/// ----------
/// best : numpy.ndarray
///     The best path so far, shape (n, 2), int32: to a goal, if one was found, else to the vertex nearest to
///     a goal among those that were expanded.
/// lower_bound : float
///     No path of the engine's kind from start to goal is shorter, in cells, as far as the search has shown.
/// expansions : int
///     The number of expansions so far.
/// answer : Answer or None
///     The answer, once it is there.
///
/// Examples
/// --------
/// >>> import mediant
/// >>> grid = mediant.Grid.from_rows([".....", ".###.", "....."])
/// >>> search = grid.prepare("astar").search((0, 0), (2, 4))
/// >>> while search.step(2) is None:
/// ...     print(search.expansions, search.lower_bound < 6.01)
/// 2 True
/// 4 True
/// 6 True
/// >>> search.answer.distance
/// 6.0
#[pyclass(frozen, module = "mediant")]
pub(crate) struct Search {
    state: Arc<Mutex<State>>,
    points: PathPoints,
    rules: Rules,
}

struct State {
    planner: Planner,
    /// For the file of a trace: the first start and the first goal.
    ends: PointEnds,
    trace: Option<Events>,
    answer: Option<Answer>,
}

impl State {
    /// Goes on by so many expansions, or until a signal's handler raises.
    fn step(&mut self, expansions: u64) -> Result<Result<Option<Answer>, QueryError>, PyErr> {
        let Self { planner, trace, answer, .. } = self;
        let mut nobody = ();
        let events = trace.as_mut().map_or(&mut nobody as &mut dyn Observer, |events| events);
        let mut watched = Watched::new(events);
        let step = planner.step_observed(expansions, &mut watched);
        if let Some(raised) = watched.raised {
            return Err(raised);
        }
        if let Ok(Some(told)) = &step {
            *answer = Some(told.clone());
        }
        Ok(step)
    }

    /// The search beside its answer, with counters if events are kept.
    fn searched(&self) -> Searched {
        Searched::by(&self.planner, self.trace.as_ref().map(Events::counters))
    }

    /// The events, if they are kept and had room.
    fn events(&self) -> PyResult<&Events> {
        let wrong = || argument("trace", "the search keeps no events: make it with trace=True");
        self.trace.as_ref().ok_or_else(wrong)?.whole()
    }

    /// Writes the events to a file.
    fn write_trace(&self, path: PathBuf, limits: &Limits) -> PyResult<()> {
        self.events()?.write(path, self.planner.index().space(), (self.ends, self.answer.as_ref()), limits)
    }
}

/// The state, unless a step is at work on it.
fn idle(state: &Mutex<State>) -> PyResult<MutexGuard<'_, State>> {
    // A signal's handler may call while the same thread searches, so nobody waits.
    state.try_lock().map_err(|_| argument("search", "a step is at work on it: wait until it has ended"))
}

impl Search {
    /// An answer with its arrays.
    fn told(&self, py: Python<'_>, answer: &Answer, searched: Searched) -> PyResult<PyAnswer> {
        PyAnswer::new(py, answer, self.points, self.rules, searched)
    }

    /// A path with its array.
    fn path<'py>(&self, py: Python<'py>, path: &Path) -> PyResult<Bound<'py, PyAny>> {
        self.points.array(py, path, self.rules)
    }

    fn step_by(&self, py: Python<'_>, expansions: u64) -> PyResult<Option<PyAnswer>> {
        let (step, searched) = py.detach(|| {
            let mut state = idle(&self.state)?;
            Ok::<_, PyErr>((state.step(expansions)?, state.searched()))
        })?;
        step.map_err(raised)?.map(|answer| self.told(py, &answer, searched)).transpose()
    }

    /// The vertices of the events of a kind, in their order.
    fn vertices<'py>(&self, py: Python<'py>, of: Kind) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let flat = py.detach(|| {
            let state = idle(&self.state)?;
            Ok::<Vec<i32>, PyErr>(state.events()?.vertices(of).flat_map(|at| [at.y, at.x]).collect())
        })?;
        points_array(py, &flat)
    }
}

#[pymethods]
impl Search {
    /// The best path so far.
    #[getter]
    fn best<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let best = py.detach(|| Ok::<_, PyErr>(idle(&self.state)?.planner.best()))?;
        best.map(|path| self.path(py, &path)).transpose()
    }

    /// No path is shorter, as far as the search has shown.
    #[getter]
    fn lower_bound(&self) -> PyResult<f64> {
        Ok(idle(&self.state)?.planner.lower_bound())
    }

    /// The number of expansions so far.
    #[getter]
    fn expansions(&self) -> PyResult<u64> {
        Ok(idle(&self.state)?.planner.expansions())
    }

    /// The answer, once it is there.
    #[getter]
    fn answer(&self, py: Python<'_>) -> PyResult<Option<PyAnswer>> {
        let (answer, searched) = {
            let state = idle(&self.state)?;
            (state.answer.clone(), state.searched())
        };
        answer.map(|answer| self.told(py, &answer, searched)).transpose()
    }

    /// Goes on by at most so many expansions.
    ///
    /// Parameters
    /// ----------
    /// expansions : int
    ///     The most expansions; 0 looks whether there is an answer without any.
    ///
    /// Returns
    /// -------
    /// Answer or None
    ///     The answer, once it is there, also of later steps.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     Where the engine gives up.
    ///
    /// Examples
    /// --------
    /// See `Search`.
    #[pyo3(signature = (expansions = None), text_signature = "($self, expansions=1)")]
    fn step(&self, py: Python<'_>, expansions: Option<&Bound<'_, PyAny>>) -> PyResult<Option<PyAnswer>> {
        let expansions = expansions.map_or(Ok(1), |value| integer("expansions", value, 0))?;
        self.step_by(py, expansions)
    }

    /// Goes on until there is an answer.
    ///
    /// Returns
    /// -------
    /// Answer
    ///     The answer.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     Where the engine gives up.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["....", ".##.", "...."]).prepare("jps")
    /// >>> index.search((0, 0), (2, 3)).finish().path.tolist()
    /// [[0, 0], [0, 3], [2, 3]]
    fn finish(&self, py: Python<'_>) -> PyResult<PyAnswer> {
        loop {
            if let Some(answer) = self.step_by(py, u64::MAX)? {
                return Ok(answer);
            }
        }
    }

    /// The path by which the search has reached a vertex, as it found it.
    ///
    /// Parameters
    /// ----------
    /// point : tuple of int
    ///     (row, column).
    ///
    /// Returns
    /// -------
    /// numpy.ndarray or None
    ///     Shape (n, 2), int32: for most engines, to a vertex that was expanded. None for others, and once
    ///     there is an answer.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> search = mediant.Grid.from_rows(["....."]).prepare("dijkstra").search((0, 0), (0, 4))
    /// >>> search.step(3) is None, search.path_to((0, 2)).tolist(), search.path_to((0, 4))
    /// (True, [[0, 0], [0, 2]], None)
    fn path_to<'py>(&self, point: &Bound<'py, PyAny>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let (py, at) = (point.py(), asked_point("point", point)?);
        let path = py.detach(|| Ok::<_, PyErr>(idle(&self.state)?.planner.path_to(at)))?;
        path.map(|path| self.path(py, &path)).transpose()
    }

    /// The vertices that were expanded so far, in their order.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     Shape (n, 2), int32: (row, column). Hub labels expand nothing.
    ///
    /// Raises
    /// ------
    /// ArgumentError
    ///     For a search without ``trace=True``.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["....."]).prepare("astar")
    /// >>> search = index.search((0, 0), (0, 3), trace=True)
    /// >>> search.finish().counters["expanded"], search.expanded().tolist()
    /// (3, [[0, 0], [0, 1], [0, 2]])
    fn expanded<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        self.vertices(py, Kind::Expanded)
    }

    /// The vertices that were reached for the first time so far, in their order.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     Shape (n, 2), int32: (row, column).
    ///
    /// Raises
    /// ------
    /// ArgumentError
    ///     For a search without ``trace=True``.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["....."]).prepare("astar")
    /// >>> search = index.search((0, 2), (0, 4), trace=True)
    /// >>> _ = search.step(1)
    /// >>> search.generated().tolist()
    /// [[0, 2], [0, 3], [0, 1]]
    fn generated<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        self.vertices(py, Kind::Generated)
    }

    /// Writes the events so far, the map and the path to a file, as JSON for the Posthoc visualizer
    /// (https://posthoc.pathfinding.ai). An older file there is replaced as a whole.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     The file.
    ///
    /// Raises
    /// ------
    /// ArgumentError
    ///     For a search without ``trace=True``.
    /// FileError
    ///     If the operating system refuses.
    ///
    /// Examples
    /// --------
    /// >>> import json, pathlib, tempfile
    /// >>> import mediant
    /// >>> search = mediant.Grid.from_rows(["..."]).prepare("astar").search((0, 0), (0, 2), trace=True)
    /// >>> _ = search.finish()
    /// >>> file = pathlib.Path(tempfile.mkdtemp()) / "search.trace.json"
    /// >>> search.write_trace(file)
    /// >>> json.loads(file.read_text())["events"][0]["type"]
    /// 'source'
    fn write_trace(&self, py: Python<'_>, path: &Bound<'_, PyAny>) -> PyResult<()> {
        let (path, state) = (file("path", path)?, Arc::clone(&self.state));
        let write = move |limits: &Limits| idle(&state)?.write_trace(path, limits);
        on_thread(py, Limits::new(), write, |_| Ok(()))?
    }

    fn __repr__(&self) -> PyResult<String> {
        let state = idle(&self.state)?;
        let whether = if state.answer.is_some() { ", answered" } else { "" };
        Ok(format!("<mediant.Search after {} expansions{whether}>", state.planner.expansions()))
    }
}

#[pymethods]
impl Index {
    /// Begins a search that goes on in steps. Nothing is expanded yet.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     As in `path`.
    /// points : {"waypoints", "vertices", "touched"}
    ///     The points of the arrays: see `Grid.find`.
    /// trace : bool
    ///     Whether to keep all events of the search, for `Search.expanded` and `Search.write_trace`, and to
    ///     count them, as ``counters`` in `find` does.
    /// **wishes
    ///     As in `path`. A ``timeout`` begins now; the time between steps counts.
    ///
    /// Returns
    /// -------
    /// Search
    ///     The search.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     As `path`.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["....", ".##.", "...."]).prepare("astar")
    /// >>> search = index.search((0, 0), (2, 3))
    /// >>> search.step(1), search.best.tolist()
    /// (None, [[0, 0]])
    /// >>> search.finish().distance
    /// 5.0
    #[pyo3(
        signature = (start, goal, *, points = None, trace = None, **wishes),
        text_signature = "($self, start, goal, *, points='waypoints', trace=False, nearest=False, snap=False, \
            tolerance=None, max_cost=None, max_expansions=None, timeout=None)"
    )]
    fn search<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        points: Option<&Bound<'py, PyAny>>,
        trace: Option<&Bound<'py, PyAny>>,
        wishes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Search> {
        let keywords = Keywords::read("search", wishes, WISHES)?;
        let keeps_events = trace.map_or(Ok(false), |value| flag("trace", value))?;
        let (start, goal) = (Points::read("start", start)?, Points::read("goal", goal)?);
        let (points, index) = (PathPoints::read(points)?, self.planners.index().clone());
        let first = |ends: &Points| ends.as_slice().first().copied().unwrap_or_default();
        let ends = PointEnds::new(first(&start), first(&goal));
        let query = keywords.timed_request(&start, &goal);
        let planner = py.detach(|| -> Result<Planner, mediant::Error> {
            let mut planner = index.try_planner()?;
            planner.begin(query)?;
            Ok(planner)
        });
        let (trace, rules) = (keeps_events.then(Events::default), index.setup().rules());
        let state = State { planner: planner.map_err(raised)?, ends, trace, answer: None };
        Ok(Search { state: Arc::new(Mutex::new(state)), points, rules })
    }
}
