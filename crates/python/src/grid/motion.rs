//! Free vertices, lines of sight and legal paths of a grid, under rules of motion.

use mediant::Path;
use pyo3::{prelude::*, types::PyDict};

use super::Grid;
use crate::{
    arguments::{path_points, point as place},
    errors::broken,
    keywords::{Keywords, MOTION},
};

#[pymethods]
impl Grid {
    /// Whether a path may begin or end on a vertex.
    ///
    /// Parameters
    /// ----------
    /// point : tuple of int
    ///     (row, column).
    /// **motion
    ///     ``k`` (or ``neighbors``), ``placement``, ``corners`` and ``gap``, as in `find`.
    ///
    /// Returns
    /// -------
    /// bool
    ///     False outside the map.
    ///
    /// Notes
    /// -----
    /// At corners under ``gap="closed"`` a vertex on a gap is free, too, as one of its four cells is. But a
    /// path starts or ends there only through the vertex's own cell, and if that is blocked, not at all:
    /// `find` says "unreachable" then.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows([".#"]).is_free((0, 1))
    /// False
    #[pyo3(
        signature = (point, **motion),
        text_signature = "($self, point, *, k=None, neighbors=None, placement=None, corners=None, gap=None)"
    )]
    fn is_free(&self, point: &Bound<'_, PyAny>, motion: Option<&Bound<'_, PyDict>>) -> PyResult<bool> {
        let at = place("point", point)?;
        Ok(self.moved("is_free", point.py(), motion)?.is_free(at))
    }

    /// Whether there is a path from one vertex to another, in constant time.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     (row, column).
    /// **motion
    ///     As in `find`.
    ///
    /// Returns
    /// -------
    /// bool
    ///     False if one of them is blocked or outside the map.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows([".#."]).connected((0, 0), (0, 2))
    /// False
    #[pyo3(
        signature = (start, goal, **motion),
        text_signature = "($self, start, goal, *, k=None, neighbors=None, placement=None, corners=None, gap=None)"
    )]
    fn connected(
        &self,
        start: &Bound<'_, PyAny>,
        goal: &Bound<'_, PyAny>,
        motion: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<bool> {
        let (start_at, goal_at) = (place("start", start)?, place("goal", goal)?);
        Ok(self.moved("connected", start.py(), motion)?.connected(start_at, goal_at))
    }

    /// Whether the straight line between two vertices obeys the rules of motion.
    ///
    /// The line is judged for itself. A closed gap that it passes is in its way, one at which it begins or
    /// ends is not; whether a path may begin, turn or end there, `check` says of the whole path.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     (row, column).
    /// **motion
    ///     As in `find`.
    ///
    /// Returns
    /// -------
    /// bool
    ///     Whether it is free.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["...", ".#.", "..."])
    /// >>> grid.sees((0, 0), (0, 2)), grid.sees((0, 0), (2, 2))
    /// (True, False)
    #[pyo3(
        signature = (start, goal, **motion),
        text_signature = "($self, start, goal, *, k=None, neighbors=None, placement=None, corners=None, gap=None)"
    )]
    fn sees(
        &self,
        start: &Bound<'_, PyAny>,
        goal: &Bound<'_, PyAny>,
        motion: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<bool> {
        let (start_at, goal_at) = (place("start", start)?, place("goal", goal)?);
        Ok(self.moved("sees", start.py(), motion)?.sees(start_at, goal_at))
    }

    /// Checks that a path obeys the rules of motion here, for instance after an edit. It costs far less than
    /// a search. It looks at lines of sight, and at closed gaps where the path begins, turns or ends; not
    /// whether each line is a move of N(k).
    ///
    /// Parameters
    /// ----------
    /// path : array_like of int
    ///     Waypoints, shape (n, 2).
    /// **motion
    ///     As in `find`.
    ///
    /// Raises
    /// ------
    /// BrokenPathError
    ///     If it does not hold. It says where, and up to which waypoint it can be followed.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", "...."])
    /// >>> try:
    /// ...     grid.edit((0, 2), [[True]]).check(grid.path((0, 0), (0, 3)))
    /// ... except mediant.BrokenPathError as error:
    /// ...     print(error, error.holds_up_to)
    /// segment 0 of the path, from (0, 0) to (0, 3), does not hold: cell (0, 2) is blocked 1
    #[pyo3(
        signature = (path, **motion),
        text_signature = "($self, path, *, k=None, neighbors=None, placement=None, corners=None, gap=None)"
    )]
    fn check(&self, path: &Bound<'_, PyAny>, motion: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
        let waypoints = Path::through(path_points("path", path)?);
        self.moved("check", path.py(), motion)?.check(&waypoints).map_err(broken)
    }

    /// Whether a path obeys the rules of motion here, as `check` has it.
    ///
    /// Parameters
    /// ----------
    /// path : array_like of int
    ///     Waypoints, shape (n, 2).
    /// **motion
    ///     As in `find`.
    ///
    /// Returns
    /// -------
    /// bool
    ///     `check` says why not.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", "...."])
    /// >>> grid.holds([(0, 0), (0, 3)])
    /// True
    #[pyo3(
        signature = (path, **motion),
        text_signature = "($self, path, *, k=None, neighbors=None, placement=None, corners=None, gap=None)"
    )]
    fn holds(&self, path: &Bound<'_, PyAny>, motion: Option<&Bound<'_, PyDict>>) -> PyResult<bool> {
        let waypoints = Path::through(path_points("path", path)?);
        Ok(self.moved("holds", path.py(), motion)?.check(&waypoints).is_ok())
    }

    /// The engine that we would prepare for many paths, and why.
    ///
    /// Parameters
    /// ----------
    /// **motion
    ///     As in `find`.
    ///
    /// Returns
    /// -------
    /// tuple of str
    ///     The engine's name, and a sentence.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["...", "..."]).engine(k="any")[0]
    /// 'subgoal'
    #[pyo3(
        signature = (**motion),
        text_signature = "($self, *, k=None, neighbors=None, placement=None, corners=None, gap=None)"
    )]
    fn engine(
        &self,
        py: Python<'_>,
        motion: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<(&'static str, &'static str)> {
        let choice = self.moved("engine", py, motion)?.engine();
        Ok((choice.engine.name(), choice.why))
    }
}

impl Grid {
    /// The grid with the motion of a call's keywords.
    pub(super) fn moved(
        &self,
        function: &str,
        py: Python<'_>,
        motion: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<mediant::Space> {
        self.space(py, Keywords::read(function, motion, MOTION)?.motion()?)
    }
}
