//! Distance fields of a grid.

use mediant::Limits;
use pyo3::{prelude::*, types::PyDict};

use super::Grid;
use crate::{
    arguments::{Points, numpy_function, positive},
    background::{Heard, detached, on_thread},
    batch::callback,
    errors::raised_for,
    field::{Field, Heading},
    keywords::{Keywords, MOTION},
};

#[pymethods]
impl Grid {
    /// The distance of every vertex to the nearest source, with the paths to it.
    ///
    /// Parameters
    /// ----------
    /// sources : array_like of int
    ///     A point (row, column), or several with shape (n, 2).
    /// limit : float, optional
    ///     The greatest distance, in cells, or the greatest cost where cells have costs. A vertex at exactly
    ///     that distance is in the field: the distance of a vertex, as a limit, reaches that vertex.
    /// heading : {"to", "from"}
    ///     Whether paths lead to the nearest source or from it: over elevation they take different times.
    /// progress : callable, optional
    ///     Where cells have costs: called now and then, and at the end, with the number of vertices that have
    ///     their cost, and of all that are not blocked. If some cannot be reached, or cost more than the
    ///     limit, it ends with fewer than all. An exception in it ends the call.
    /// **motion
    ///     ``k`` (or ``neighbors``), ``placement``, ``corners`` and ``gap``, as in `find`.
    ///
    /// Returns
    /// -------
    /// Field
    ///     Distances, directions and paths.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     For a source that is blocked or outside the map.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["...", "..."]).field((0, 0)).path_from((1, 2)).tolist()
    /// [[1, 2], [0, 1], [0, 0]]
    #[pyo3(
        signature = (sources, *, limit = None, heading = None, progress = None, **motion),
        text_signature = "($self, sources, *, limit=None, heading='to', progress=None, k=None, neighbors=None, \
            placement=None, corners=None, gap=None)"
    )]
    fn field(
        &self,
        sources: &Bound<'_, PyAny>,
        limit: Option<&Bound<'_, PyAny>>,
        heading: Option<&Bound<'_, PyAny>>,
        progress: Option<&Bound<'_, PyAny>>,
        motion: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Field> {
        self.field_of("field", sources, (limit, progress), Heading::read(heading, Heading::To)?, motion)
    }

    /// The distances of all vertices to the nearest source.
    ///
    /// Parameters
    /// ----------
    /// sources : array_like of int
    ///     As in `field`.
    /// limit, progress
    ///     As in `field`.
    /// heading : {"to", "from"}
    ///     As in `field`.
    /// **motion
    ///     As in `find`.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     Shape (rows, columns), at corners (rows + 1, columns + 1); float64, in cells, or costs where cells
    ///     have costs. ``inf`` where no path leads, or none within the limit.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     As `field`.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows([".#.", "..."]).distances((0, 0), k=2).tolist()
    /// [[0.0, inf, 4.0], [1.0, 2.0, 3.0]]
    #[pyo3(
        signature = (sources, *, limit = None, heading = None, progress = None, **motion),
        text_signature = "($self, sources, *, limit=None, heading='to', progress=None, k=None, neighbors=None, \
            placement=None, corners=None, gap=None)"
    )]
    fn distances<'py>(
        &self,
        sources: &Bound<'py, PyAny>,
        limit: Option<&Bound<'py, PyAny>>,
        heading: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
        motion: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let heading = Heading::read(heading, Heading::To)?;
        self.field_of("distances", sources, (limit, progress), heading, motion)?.into_distances(sources.py())
    }

    /// The vertices that can be reached within a distance.
    ///
    /// Parameters
    /// ----------
    /// sources : array_like of int
    ///     As in `field`.
    /// limit : float
    ///     The greatest distance, in cells, or the greatest cost; a vertex at exactly that distance is
    ///     reached.
    /// heading : {"from", "to"}
    ///     As in `field`.
    /// **motion
    ///     As in `find`.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     The shape of `distances`, bool.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     As `field`.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["....", "...."]).reach((0, 0), 1.5).astype(int).tolist()
    /// [[1, 1, 0, 0], [1, 1, 0, 0]]
    #[pyo3(
        signature = (sources, limit, *, heading = None, **motion),
        text_signature = "($self, sources, limit, *, heading='from', k=None, neighbors=None, placement=None, corners=None, \
            gap=None)"
    )]
    fn reach<'py>(
        &self,
        sources: &Bound<'py, PyAny>,
        limit: &Bound<'py, PyAny>,
        heading: Option<&Bound<'py, PyAny>>,
        motion: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let heading = Heading::read(heading, Heading::From)?;
        let field = self.field_of("reach", sources, (Some(limit), None), heading, motion)?;
        numpy_function(sources.py(), "isfinite")?.call1((field.into_distances(sources.py())?,))
    }

    /// The directions in which the shortest paths lead to the nearest source: one goal for many agents.
    ///
    /// Parameters
    /// ----------
    /// sources : array_like of int
    ///     As in `field`.
    /// limit : float, optional
    ///     As in `field`.
    /// heading : {"to", "from"}
    ///     As in `field`.
    /// **motion
    ///     As in `find`.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     The shape of `distances` and 2, float64: (row, column) vectors of length 1; 0 at sources, ``nan``
    ///     where no path leads.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     As `field`.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["..", ".."]).flow((0, 0)).round(2).tolist()
    /// [[[0.0, 0.0], [0.0, -1.0]], [[-1.0, 0.0], [-0.71, -0.71]]]
    #[pyo3(
        signature = (sources, *, limit = None, heading = None, **motion),
        text_signature = "($self, sources, *, limit=None, heading='to', k=None, neighbors=None, placement=None, \
            corners=None, gap=None)"
    )]
    fn flow<'py>(
        &self,
        sources: &Bound<'py, PyAny>,
        limit: Option<&Bound<'py, PyAny>>,
        heading: Option<&Bound<'py, PyAny>>,
        motion: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let heading = Heading::read(heading, Heading::To)?;
        self.field_of("flow", sources, (limit, None), heading, motion)?.flow(sources.py())
    }
}

impl Grid {
    /// The field of a call, with its limit and its progress.
    fn field_of(
        &self,
        function: &str,
        sources: &Bound<'_, PyAny>,
        (limit, progress): (Option<&Bound<'_, PyAny>>, Option<&Bound<'_, PyAny>>),
        heading: Heading,
        motion: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Field> {
        let py = sources.py();
        let motion = Keywords::read(function, motion, MOTION)?.motion()?;
        let sources = Points::read("sources", sources)?.into_vec();
        let limit =
            limit.filter(|limit| !limit.is_none()).map(|limit| positive("limit", limit)).transpose()?;
        let progress = callback(progress)?;
        let space = self.space(py, motion)?;
        let limit = limit.unwrap_or(f64::INFINITY);
        let work = move |limits: &Limits| match heading {
            Heading::To => space.within(limits).field_within(sources, limit),
            Heading::From => space.within(limits).field_from_within(sources, limit),
        };
        let field = match progress {
            None => detached(py, self.cells(), Limits::new(), work)?,
            Some(progress) => {
                let heard = Heard::default();
                let told = heard.clone();
                let work = move |limits: &Limits| work(&told.hear(limits));
                let field = on_thread(py, Limits::new(), work, |_| heard.tell(&progress))?;
                heard.tell(&progress)?;
                field
            }
        };
        let field = field.map_err(|error| raised_for("source", error))?;
        Ok(Field::new(field, motion.rules.placement(), self.ground().clone(), heading))
    }
}
