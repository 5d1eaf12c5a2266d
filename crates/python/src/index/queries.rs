//! One path on an index.

use std::sync::Arc;

use mediant::{Answer, Limits, Planners, PointEnds, errors::QueryError};
use pyo3::{prelude::*, types::PyDict};

use super::Index;
use crate::{
    answer::{self, PyAnswer, Searched},
    arguments::{Points, flag},
    arrays::PathPoints,
    background::{Interruption, is_watched, on_thread},
    errors::raised,
    keywords::{Keywords, WISHES},
};

/// A query on planners, as it was asked.
pub(crate) struct Asked<'a, 'py> {
    pub(crate) planners: &'a Arc<Planners>,
    pub(crate) start: &'a Bound<'py, PyAny>,
    pub(crate) goal: &'a Bound<'py, PyAny>,
    pub(crate) keywords: Keywords,
}

impl Asked<'_, '_> {
    /// The ends.
    fn ends(&self) -> PyResult<(Points, Points)> {
        Ok((Points::read("start", self.start)?, Points::read("goal", self.goal)?))
    }

    /// The query, if no more is asked than a path from one vertex to another.
    fn plain(&self, (start, goal): &(Points, Points)) -> Option<PointEnds> {
        match (start, goal) {
            (Points::One(start), Points::One(goal)) if self.keywords.call.wishes().is_none() => {
                Some(PointEnds::new(*start, *goal))
            }
            _ => None,
        }
    }

    /// Answers it with the GIL released.
    fn answered(&self, ends: &(Points, Points), counts: bool) -> PyResult<(Answer, Searched)> {
        let is_plain = self.plain(ends).is_some();
        let is_watched =
            self.keywords.call.wishes().timeout.is_some() || is_watched(self.planners.index(), is_plain);
        let ready = if is_watched && !self.planners.is_ready() {
            let planners = Arc::clone(self.planners);
            on_thread(self.start.py(), Limits::new(), move |_| planners.try_make_ready(), |_| Ok(()))?
        } else {
            self.start.py().detach(|| self.planners.try_make_ready())
        };
        ready.map_err(raised)?;
        let interruption = is_watched.then(Interruption::default);
        let query = self.keywords.query(&ends.0, &ends.1, interruption.as_ref());
        let answer = self.start.py().detach(|| {
            self.planners.with(|planner| {
                let (answer, counters) = if counts {
                    let (answer, counters) = planner.find_counted(query)?;
                    (answer, Some(counters))
                } else {
                    (planner.find(query)?, None)
                };
                Ok::<_, QueryError>((answer, Searched::by(planner, counters)))
            })
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
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let points = PathPoints::read(points)?;
        let rules = self.planners.index().setup().rules();
        let answer = answer::whole(py, self.answered(&self.ends()?, false)?.0, points, rules)?;
        answer.path().map(|path| points.array(py, path, rules)).transpose()
    }

    /// `distance`. It makes no path where it needs none.
    pub(crate) fn distance(&self, py: Python<'_>) -> PyResult<f64> {
        let (ends, index) = (self.ends()?, self.planners.index());
        if let Some(ends) = self.plain(&ends).filter(|_| !is_watched(index, true)) {
            py.detach(|| self.planners.try_make_ready()).map_err(raised)?;
            let distance = py.detach(|| self.planners.with(|planner| planner.distance(ends)));
            return Ok(distance.map_err(raised)?.unwrap_or(f64::INFINITY));
        }
        let setup = index.setup();
        let (answer, searched) = self.answered(&ends, false)?;
        let answer = answer::whole(py, answer, PathPoints::Waypoints, setup.rules())?;
        Ok(answer.distance(searched.guarantee))
    }

    /// `find`.
    pub(crate) fn find(
        &self,
        py: Python<'_>,
        points: Option<&Bound<'_, PyAny>>,
        counters: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<PyAnswer> {
        let points = PathPoints::read(points)?;
        let counters = counters.map_or(Ok(false), |value| flag("counters", value))?;
        let setup = self.planners.index().setup();
        let (answer, searched) = self.answered(&self.ends()?, counters)?;
        PyAnswer::new(py, &answer, points, setup.rules(), searched)
    }
}

#[pymethods]
impl Index {
    /// A shortest path.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     (row, column), at any angle also of floats; or several of each, shape (n, 2): the shortest path
    ///     from any start to any goal.
    /// points : {"waypoints", "vertices", "touched"}
    ///     The points of the array: see `Grid.find`.
    /// **wishes
    ///     ``nearest``, ``tolerance``, ``snap`` and limits: see `Grid.find`.
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
    /// LimitReached
    ///     If a limit stopped the search.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["....", ".##.", "...."]).prepare()
    /// >>> index.path((0, 0), (2, 2), points="touched").tolist()
    /// [[0, 0], [1, 0], [2, 0], [2, 1], [2, 2]]
    #[pyo3(
        signature = (start, goal, *, points = None, **wishes),
        text_signature = "($self, start, goal, *, points='waypoints', nearest=False, snap=False, tolerance=None, \
            max_cost=None, max_expansions=None, timeout=None)"
    )]
    fn path<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        points: Option<&Bound<'py, PyAny>>,
        wishes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let keywords = Keywords::read("path", wishes, WISHES)?;
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
    ///     In cells; ``inf`` if there is no path. Hub labels measure without the path: the length may differ
    ///     from that of the path by a factor of 1 + 2**-31.
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
    #[pyo3(
        signature = (start, goal, **wishes),
        text_signature = "($self, start, goal, *, nearest=False, snap=False, tolerance=None, max_cost=None, \
            max_expansions=None, timeout=None)"
    )]
    fn distance<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        wishes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<f64> {
        let keywords = Keywords::read("distance", wishes, WISHES)?;
        Asked { planners: &self.planners, start, goal, keywords }.distance(py)
    }

    /// The whole answer to a query.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     As in `path`.
    /// points : {"waypoints", "vertices", "touched"}
    ///     The points of arrays of paths: see `Grid.find`.
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
    #[pyo3(
        signature = (start, goal, *, points = None, counters = None, **wishes),
        text_signature = "($self, start, goal, *, points='waypoints', counters=False, nearest=False, snap=False, \
            tolerance=None, max_cost=None, max_expansions=None, timeout=None)"
    )]
    fn find<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        points: Option<&Bound<'py, PyAny>>,
        counters: Option<&Bound<'py, PyAny>>,
        wishes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<PyAnswer> {
        let keywords = Keywords::read("find", wishes, WISHES)?;
        Asked { planners: &self.planners, start, goal, keywords }.find(py, points, counters)
    }
}
