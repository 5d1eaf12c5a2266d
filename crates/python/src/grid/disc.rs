//! A disc among obstacles that change.

use mediant::files::WorldFrame;
use pyo3::{prelude::*, types::PyDict};

use super::{Grid, edits::Patch};
use crate::{
    background::detached,
    errors::raised,
    keywords::{Keywords, MOTION},
};

/// A disc among obstacles that change: `Grid.disc` makes it.
///
/// It never changes: `edit` makes another one. An edit of the grid that `Grid.for_disc` makes gives a new
/// obstacle no margin; this one measures it anew around what changed.
///
/// Attributes
/// ----------
/// grid : Grid
///     Where the center of the disc may be: the grid to search.
/// obstacles : Grid
///     Which cells are blocked by obstacles.
/// radius : float
///     The radius of the disc, in cells.
///
/// Examples
/// --------
/// >>> import mediant
/// >>> disc = mediant.Grid.from_rows(["." * 9] * 9).disc(1.5)
/// >>> disc = disc.edit((4, 4), [[True]])
/// >>> disc.grid.is_free((4, 5)), disc.obstacles.is_free((4, 5))
/// (False, True)
#[pyclass(frozen, module = "mediant")]
pub(crate) struct Disc {
    inner: mediant::Disc,
    world: Option<WorldFrame>,
}

#[pymethods]
impl Disc {
    /// Where the center of the disc may be.
    #[getter]
    fn grid(&self) -> Grid {
        Grid::new(self.inner.map().clone(), self.world)
    }

    /// Which cells are blocked by obstacles.
    #[getter]
    fn obstacles(&self) -> Grid {
        Grid::new(self.inner.obstacles().clone(), self.world)
    }

    /// The radius of the disc, in cells.
    #[getter]
    const fn radius(&self) -> f64 {
        self.inner.radius()
    }

    /// The disc among other obstacles in a rectangle. The work follows the rectangle and the radius, not the
    /// map. This one stays as it is.
    ///
    /// Parameters
    /// ----------
    /// at : tuple of int
    ///     (row, column) of the rectangle's top left cell.
    /// blocked : array_like of bool
    ///     The new cells, shape (rows, columns) of the rectangle; True is blocked.
    ///
    /// Returns
    /// -------
    /// Disc
    ///     The next version.
    ///
    /// Raises
    /// ------
    /// MapError
    ///     For a rectangle that is not wholly on the map.
    ///
    /// Examples
    /// --------
    /// See `Disc`.
    fn edit(&self, at: &Bound<'_, PyAny>, blocked: &Bound<'_, PyAny>) -> PyResult<Self> {
        let patch = Patch::read(self.inner.obstacles(), at, blocked)?;
        let inner = match patch {
            Some(patch) => at.py().detach(|| self.inner.edit(patch.at, |x, y| patch.is_blocked(x, y))),
            None => Ok(self.inner.clone()),
        };
        Ok(Self { inner: inner.map_err(raised)?, world: self.world })
    }

    fn __repr__(&self) -> String {
        let (map, radius) = (self.inner.map(), self.inner.radius());
        format!("<mediant.Disc of radius {radius} on {} × {} cells>", map.height(), map.width())
    }
}

#[pymethods]
impl Grid {
    /// A disc among obstacles that change: this grid, and that of `for_disc`, kept together over edits.
    ///
    /// Parameters
    /// ----------
    /// radius : float, optional
    ///     In cells.
    /// meters : float, optional
    ///     The radius in meters, in place of `radius`, for a grid with a `world`.
    /// **motion
    ///     As in `find`: on every path of this motion the disc keeps its radius.
    ///
    /// Returns
    /// -------
    /// Disc
    ///     The disc.
    ///
    /// Raises
    /// ------
    /// ArgumentError
    ///     As `for_disc`.
    ///
    /// Examples
    /// --------
    /// See `Disc`.
    #[pyo3(
        signature = (radius = None, *, meters = None, **motion),
        text_signature = "($self, radius=None, *, meters=None, k=None, neighbors=None, placement=None, corners=None, \
            gap=None)"
    )]
    fn disc<'py>(
        &self,
        py: Python<'py>,
        radius: Option<&Bound<'py, PyAny>>,
        meters: Option<&Bound<'py, PyAny>>,
        motion: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Disc> {
        let motion = Keywords::read("disc", motion, MOTION)?.motion()?;
        self.without_costs("disc that follows edits", "make the grid anew by for_disc, which keeps costs")?;
        let (map, cells) = (self.map().clone(), self.radius(radius, meters)?);
        let make = move |_: &mediant::Limits| map.disc(cells, motion);
        let inner = detached(py, self.cells(), mediant::Limits::new(), make)?.map_err(raised)?;
        Ok(Disc { inner, world: self.shared.world })
    }
}
