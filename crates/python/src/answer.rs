//! The answer to a query.

use mediant::{
    Answer, Engine, Error, ErrorCode, Guarantee, Limit, Path, Planner, Rules, Stopped, search::Counters,
};
use pyo3::{prelude::*, types::PyDict};

use crate::{arrays::PathPoints, errors::made};

/// The answer of `find`.
///
/// Attributes
/// ----------
/// status : str
///     ``"found"``; ``"unreachable"``: there is no path; ``"nearest"``: there is none, and the path leads to
///     the reachable vertex that is nearest to the goal; ``"stopped"``: a limit stopped the search.
/// path : numpy.ndarray or None
///     The path, shape (n, 2), int32: of a found or nearest answer. Of a path at any angle that leads
///     through points between vertices float64.
/// distance : float
///     Its length in cells, as `Grid.distance` measures it: where cells have costs its cost. ``inf`` if
///     unreachable, ``nan`` if stopped.
/// cost : float
///     The same number by another name.
/// length : float
///     Its length in cells, also where cells have costs.
/// stopped_by : str or None
///     The limit: ``"cost"``, ``"expansions"`` or ``"timeout"``.
/// best : numpy.ndarray or None
///     Of a stopped answer the best so far: a path to a goal, or to the vertex nearest to one.
/// lower_bound : float
///     No path of the engine's kind to the goal that was asked for is shorter: no path over N(k), or at
///     ``k="any"`` and by an engine of any-angle paths no path at all. Of a found path its own length where
///     the engine guarantees that it is shortest, else 0; of a stopped answer what the search has ruled out;
///     ``inf`` where there is no path, also of a nearest answer.
/// any_angle_lower_bound : float or None
///     The certificate of the path, in cells: no path at any angle between its two ends is shorter, though
///     it bends at corners of obstacles. At corners it is the length of the path divided by `Index.bound`,
///     or the straight line if that is longer; between centers the shortest path at any angle, if that was
///     asked for, or the straight line. ``distance / any_angle_lower_bound`` says how far the path can be
///     from the best at most. None without a path.
/// counters : dict or None
///     The numbers of events of the search, if they were asked for.
/// searched_by : str or None
///     The engine that answered: that of the index, or the one that searched in its place
///     (`Index.searched_by`, `Index.is_finished`). None if nothing was searched yet.
///
/// Examples
/// --------
/// >>> import mediant
/// >>> grid = mediant.Grid.from_rows(["...", "##.", "..."])
/// >>> answer = grid.find((0, 0), (2, 0), k=2)
/// >>> answer.status, answer.distance
/// ('found', 6.0)
/// >>> answer = mediant.Grid.from_rows(["......"] * 4).find((0, 0), (3, 4), placement="corner")
/// >>> round(answer.distance, 2), answer.any_angle_lower_bound
/// (5.24, 5.0)
#[pyclass(frozen, module = "mediant", name = "Answer")]
pub(crate) struct PyAnswer {
    /// The status of the query.
    #[pyo3(get)]
    status: &'static str,
    /// The path, shape (n, 2).
    #[pyo3(get)]
    path: Option<Py<PyAny>>,
    /// The length of the path in cells; where cells have costs its cost.
    #[pyo3(get)]
    distance: f64,
    /// The length of the path in cells.
    #[pyo3(get)]
    length: f64,
    /// The limit that stopped the search.
    #[pyo3(get)]
    stopped_by: Option<&'static str>,
    /// The best path so far of a search that was stopped.
    #[pyo3(get)]
    best: Option<Py<PyAny>>,
    /// No path is shorter.
    #[pyo3(get)]
    lower_bound: f64,
    /// No path at any angle is shorter.
    #[pyo3(get)]
    any_angle_lower_bound: Option<f64>,
    /// The numbers of events of the search.
    #[pyo3(get)]
    counters: Option<Py<PyDict>>,
    /// The engine that answered.
    #[pyo3(get)]
    searched_by: Option<&'static str>,
}

/// A search beside its answer: its guarantee, counters and engine.
#[derive(Clone, Copy)]
pub(crate) struct Searched {
    pub(crate) guarantee: Guarantee,
    counters: Option<Counters>,
    by: Option<Engine>,
}

impl Searched {
    /// Nothing was searched.
    pub(crate) const NOT: Self = Self { guarantee: Guarantee::Suboptimal, counters: None, by: None };

    /// By an engine with this guarantee.
    pub(crate) const fn of(guarantee: Guarantee, by: Engine) -> Self {
        Self { guarantee, counters: None, by: Some(by) }
    }

    /// By a planner, last.
    pub(crate) fn by(planner: &Planner, counters: Option<Counters>) -> Self {
        Self { guarantee: planner.guarantee(), counters, by: Some(planner.searched_by()) }
    }
}

#[pymethods]
impl PyAnswer {
    /// The cost of the path; without costs of cells its length.
    #[getter]
    const fn cost(&self) -> f64 {
        self.distance
    }

    fn __repr__(&self) -> String {
        let Self { status, distance, .. } = self;
        format!("<mediant.Answer {status}, distance {distance}>")
    }
}

impl PyAnswer {
    /// The answer of a search with its arrays.
    pub(crate) fn new(
        py: Python<'_>,
        answer: &Answer,
        points: PathPoints,
        rules: Rules,
        Searched { guarantee, counters, by }: Searched,
    ) -> PyResult<Self> {
        let array = |path| points.array(py, path, rules).map(Bound::unbind);
        let distance = answer.distance(guarantee);
        // Elsewhere the distance is the length, rounded as searches do.
        let on_costs = |path: &&Path| path.cost().to_bits() != path.length().to_bits();
        Ok(Self {
            status: answer.status().name(),
            path: answer.path().map(array).transpose()?,
            distance,
            length: answer.path().filter(on_costs).map_or(distance, Path::length),
            stopped_by: answer.stopped_by().map(Limit::name),
            best: answer.best().map(array).transpose()?,
            lower_bound: answer.lower_bound(guarantee),
            any_angle_lower_bound: answer.any_angle_lower_bound(guarantee, rules),
            counters: counters.map(|counters| in_dict(py, counters)).transpose()?,
            searched_by: by.map(Engine::name),
        })
    }
}

/// The path or distance of an answer that a limit did not stop.
///
/// # Errors
/// `LimitReached` with the answer.
pub(crate) fn whole(py: Python<'_>, answer: Answer, points: PathPoints, rules: Rules) -> PyResult<Answer> {
    let Answer::Stopped(Stopped { by, lower_bound, .. }) = &answer else { return Ok(answer) };
    let text = format!(
        "the search was stopped by its limit ({}): no path is shorter, or cheaper, than {lower_bound:.3}; the \
         best so far is in the error's answer",
        by.name()
    );
    let told = PyAnswer::new(py, &answer, points, rules, Searched::NOT)?;
    Err(made(py, "LimitReached", (text, ErrorCode::Stopped.name(), told)))
}

/// The answer to a query whose preparation was stopped, and the exception in its place.
pub(crate) fn before_search(
    py: Python<'_>,
    answer: &Answer,
    points: PathPoints,
    rules: Rules,
    error: &Error,
) -> PyResult<(PyAnswer, PyErr)> {
    let told = || PyAnswer::new(py, answer, points, rules, Searched::NOT);
    let text = format!("{error}: nothing was searched; allow more time, or prepare an index before");
    Ok((told()?, made(py, "LimitReached", (text, ErrorCode::Stopped.name(), told()?))))
}

/// The counters by name.
fn in_dict(py: Python<'_>, counters: Counters) -> PyResult<Py<PyDict>> {
    let dict = PyDict::new(py);
    for (name, count) in [
        ("expanded", counters.expanded),
        ("generated", counters.generated),
        ("updated", counters.updated),
        ("percolations", counters.percolations),
        ("scanned", counters.scanned),
        ("fallbacks", counters.fallbacks),
    ] {
        dict.set_item(name, count)?;
    }
    Ok(dict.unbind())
}
