//! Indexes: the preparation of an engine.

mod batches;
mod exceptions;
mod queries;
mod saved;
mod search;
mod trace;

use std::sync::Arc;

use mediant::{Guarantee, Index as Prepared, K, Planners, Setup, options::Levels};
use pyo3::prelude::*;

pub(crate) use self::{queries::Asked, search::Search};
use crate::grid::Grid;

/// The preparation of an engine on a grid: paths in microseconds.
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
/// levels : int, "all", "contracted", "labels" or None
///     The levels of its subgoal graph or clusters, or what it has instead: a contraction hierarchy or hub
///     labels. None for an index without any.
/// searched_by : str
///     The engine that searches: `engine`, but for subgoals of a map on which they would be slow, as on
///     noise. Nothing is kept of them there, and the best engine that prepares little searches. Its paths
///     are as good.
/// setup : str
///     All of it and the options in one text: the same text, the same answers.
/// origin : {"prepared", "loaded", "repaired", "unchanged"}
///     The way in which it came about.
/// is_finished : bool
///     Whether nothing of it is that of an earlier map: False for subgoals that were repaired, until
///     `finish`.
/// guarantee : str
///     The guarantee of its paths.
/// bound : float or None
///     An upper bound on its paths' lengths, as a multiple of the shortest at any angle; None if nothing is
///     proven.
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
        match self.setup().k() {
            K::Finite(k) => Ok(k.get().into_pyobject(py)?.into_any()),
            K::Any => Ok("any".into_pyobject(py)?.into_any()),
        }
    }

    /// Where the vertices are.
    #[getter]
    fn placement(&self) -> String {
        self.setup().rules().placement().to_string()
    }

    /// The rule at corners of cells, or at gaps.
    #[getter]
    fn rule(&self) -> String {
        self.setup().rule_name()
    }

    /// The levels of its subgoal graph or clusters, or what it has instead.
    #[getter]
    fn levels<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Ok(match self.planners.index().levels() {
            Some(Levels::Number(number)) => Some(number.get().into_pyobject(py)?.into_any()),
            Some(levels) => Some(levels.to_string().into_pyobject(py)?.into_any()),
            None => None,
        })
    }

    /// The engine that searches.
    #[getter]
    fn searched_by(&self) -> &'static str {
        self.planners.index().searched_by().name()
    }

    /// The engine, k, rule and options in one text.
    #[getter(setup)]
    fn setup_text(&self) -> String {
        self.setup().to_string()
    }

    /// The way in which it came about.
    #[getter]
    fn origin(&self) -> &'static str {
        self.planners.index().origin().name()
    }

    /// Whether nothing of it is that of an earlier map.
    #[getter]
    fn is_finished(&self) -> bool {
        self.planners.index().is_finished()
    }

    /// The guarantee of its paths.
    #[getter(guarantee)]
    fn guarantee_text(&self) -> String {
        match self.guarantee().0 {
            Guarantee::Optimal(k) => format!("shortest over k = {k}"),
            Guarantee::Cheapest(k) => format!("cheapest over k = {k}"),
            Guarantee::AtMostCheapest(k) => format!("at most as dear as the cheapest over k = {k}"),
            Guarantee::AtMost(k) => format!("at most as long as the shortest over k = {k}"),
            Guarantee::OptimalAnyAngle => "shortest at any angle".to_owned(),
            Guarantee::Suboptimal => "none".to_owned(),
        }
    }

    /// An upper bound on its paths' lengths, as a multiple of the shortest at any angle.
    #[getter]
    fn bound(&self) -> Option<f64> {
        self.guarantee().1
    }

    /// The memory that it uses beyond the grid, in bytes.
    #[getter]
    fn memory_bytes(&self) -> u64 {
        self.planners.index().memory_bytes()
    }

    fn __repr__(&self) -> String {
        let map = self.grid.map();
        format!("<mediant.Index {} of {} × {} cells>", self.setup(), map.height(), map.width())
    }
}
