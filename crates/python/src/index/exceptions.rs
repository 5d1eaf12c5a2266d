//! Cells that count otherwise for one query.

use mediant::{Answer, Error, Exceptions, Stopped};
use pyo3::{prelude::*, types::PyDict};

use super::Index;
use crate::{
    answer::{PyAnswer, Searched},
    arguments::{Points, flag},
    arrays::PathPoints,
    background::Interruption,
    errors::raised,
    grid::cells_on,
    keywords::{Keywords, WISHES},
};

#[pymethods]
impl Index {
    /// The whole answer to a query for which some cells count otherwise than on the map.
    ///
    /// It is the answer of the grid with these cells edited. The index is repaired for the query, by work
    /// that follows the cells; where it would be prepared anew instead, an engine that prepares next to
    /// nothing answers. This index stays as it is.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     As in `path`.
    /// blocked : array_like of int, optional
    ///     A cell (row, column), or several with shape (n, 2), that count as blocked: other agents in the
    ///     way.
    /// free : array_like of int, optional
    ///     Cells that count as free. One that is among `blocked`, too, is free.
    /// free_ends : bool
    ///     Whether starts and goals count as free, whatever else is said of their cells: the map has the cell
    ///     of an agent as blocked. Between corners this is the cell (row, column) of a vertex none of whose
    ///     cells is free, on the right and lower edge of the map the cell before it.
    /// points : {"waypoints", "vertices", "touched"}
    ///     The points of the arrays: see `Grid.find`.
    /// counters : bool
    ///     Whether to count the events of the search.
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
    /// MapError
    ///     For a cell outside the map.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows([".....", "#..#.", "....."]).prepare()
    /// >>> index.find_except((1, 3), (1, 0), free_ends=True).distance
    /// 3.0
    /// >>> index.find_except((1, 3), (1, 0), free_ends=True, blocked=[(1, 1)]).distance > 3
    /// True
    #[pyo3(
        signature = (start, goal, *, blocked = None, free = None, free_ends = None, points = None, counters = None, **wishes),
        text_signature = "($self, start, goal, *, blocked=None, free=None, free_ends=False, points='waypoints', \
            counters=False, nearest=False, snap=False, tolerance=None, max_cost=None, max_expansions=None, \
            timeout=None)"
    )]
    #[expect(clippy::too_many_arguments, reason = "the keywords of a call in Python")]
    fn find_except<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        blocked: Option<&Bound<'py, PyAny>>,
        free: Option<&Bound<'py, PyAny>>,
        free_ends: Option<&Bound<'py, PyAny>>,
        points: Option<&Bound<'py, PyAny>>,
        counters: Option<&Bound<'py, PyAny>>,
        wishes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<PyAnswer> {
        let keywords = Keywords::read("find_except", wishes, WISHES)?;
        let (start, goal) = (Points::read("start", start)?, Points::read("goal", goal)?);
        let is_set = |name, value: Option<&_>| value.map_or(Ok(false), |value| flag(name, value));
        let (points, counts) = (PathPoints::read(points)?, is_set("counters", counters)?);
        let map = self.grid.map();
        let cells = |name, value: Option<&Bound<'py, PyAny>>| match value.filter(|value| !value.is_none()) {
            Some(value) => cells_on(name, value, map),
            None => Ok(Vec::new()),
        };
        let mut exceptions = Exceptions::new().blocked(cells("blocked", blocked)?).free(cells("free", free)?);
        if is_set("free_ends", free_ends)? {
            exceptions = exceptions.free_ends();
        }
        py.detach(|| self.planners.try_make_ready()).map_err(raised)?;
        let interruption = Interruption::default();
        let query = keywords.query(&start, &goal, Some(&interruption));
        let answered = py.detach(|| {
            self.planners.with(|planner| {
                if !counts {
                    let found = planner.find_except(query, &exceptions)?;
                    let searched = Searched::of(found.guarantee, found.searched_by);
                    return Ok((found.answer, searched));
                }
                let mut other = planner.except(&query, &exceptions)?;
                let planner = other.as_mut().unwrap_or(planner);
                let (answer, counters) = planner.find_counted(query)?;
                Ok::<_, Error>((answer, Searched::by(planner, Some(counters))))
            })
        });
        if let Some(error) = interruption.take() {
            return Err(error);
        }
        let (answer, rest) = match answered {
            Err(Error::Stopped { by, .. }) => {
                let start = start.as_slice().first().copied().unwrap_or_default();
                (Answer::Stopped(Stopped::before_search(by, start)), Searched::NOT)
            }
            answered => answered.map_err(raised)?,
        };
        PyAnswer::new(py, &answer, points, self.setup().rules(), rest)
    }
}
