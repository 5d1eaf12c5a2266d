//! Where a map is in the world.

use mediant::{Vertex, files::WorldFrame};
use pyo3::prelude::*;

use crate::{
    arguments::{Points, number, word},
    arrays::rows_array,
};

/// Where a map is in the world: `Grid.world`.
///
/// Grids of ROS maps and of occupancy messages have one, and those of arrays with a ``resolution``.
///
/// Attributes
/// ----------
/// resolution : float
///     The side of a cell, in meters.
/// origin : tuple of float
///     The lower left corner of the map: x and y in meters, and its turn in radians.
///
/// Examples
/// --------
/// >>> import pathlib, tempfile
/// >>> import mediant
/// >>> folder = pathlib.Path(tempfile.mkdtemp())
/// >>> _ = (folder / "room.pgm").write_text("P2 4 3 255 " + "254 " * 12)
/// >>> _ = (folder / "room.yaml").write_text(
/// ...     "image: room.pgm\nresolution: 0.5\norigin: [1, 2, 0]\nnegate: 0\n"
/// ...     "occupied_thresh: 0.65\nfree_thresh: 0.25\n")
/// >>> world = mediant.Grid.open(folder / "room.yaml").world
/// >>> world.vertex_at(1.25, 2.25)
/// (2, 0)
/// >>> world.point_of([(2, 0), (0, 3)]).tolist()
/// [[1.25, 2.25], [2.75, 3.25]]
#[pyclass(frozen, module = "mediant")]
pub(crate) struct World {
    pub(crate) frame: WorldFrame,
}

#[pymethods]
impl World {
    /// The side of a cell, in meters.
    #[getter]
    const fn resolution(&self) -> f64 {
        self.frame.resolution()
    }

    /// The lower left corner of the map: x and y in meters, and its turn in radians.
    #[getter]
    fn origin(&self) -> (f64, f64, f64) {
        self.frame.origin().into()
    }

    /// The vertex at a place of the world.
    ///
    /// Parameters
    /// ----------
    /// x, y : float
    ///     The place, in meters.
    /// placement : {"center", "corner"}
    ///     Whether to name the cell that the place is in, or the corner of cells that is nearest to it.
    ///
    /// Returns
    /// -------
    /// tuple of int or None
    ///     (row, column); None for a place outside the map.
    ///
    /// Examples
    /// --------
    /// See `World`.
    #[pyo3(signature = (x, y, *, placement = None), text_signature = "($self, x, y, *, placement='center')")]
    fn vertex_at(
        &self,
        x: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        placement: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Option<(i32, i32)>> {
        let at = self.frame.vertex_at(kind(placement)?, number("x", x)?, number("y", y)?);
        Ok(at.map(|at| (at.y, at.x)))
    }

    /// The places of vertices in the world.
    ///
    /// Parameters
    /// ----------
    /// points : array_like of int
    ///     A point (row, column), or several with shape (n, 2), such as a path.
    /// placement : {"center", "corner"}
    ///     Where the vertices are.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     x and y in meters; shape (2,) or (n, 2), float64.
    ///
    /// Examples
    /// --------
    /// See `World`.
    #[pyo3(
        signature = (points, *, placement = None),
        text_signature = "($self, points, *, placement='center')"
    )]
    fn point_of<'py>(
        &self,
        points: &Bound<'py, PyAny>,
        placement: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, placement) = (points.py(), kind(placement)?);
        let read = Points::read("points", points)?;
        let place = |&at: &Vertex| <[f64; 2]>::from(self.frame.point_of(placement, at));
        let flat: Vec<f64> = read.as_slice().iter().flat_map(place).collect();
        let array = rows_array(py, flat, 2)?;
        match read {
            Points::One(_) => array.call_method1("reshape", (2,)),
            Points::Several(_) => Ok(array),
        }
    }

    fn __repr__(&self) -> String {
        format!("<mediant.World {} m a cell, origin {:?}>", self.frame.resolution(), self.frame.origin())
    }
}

fn kind(value: Option<&Bound<'_, PyAny>>) -> PyResult<mediant::PlacementKind> {
    value.map_or(Ok(mediant::PlacementKind::Center), |value| word("placement", value))
}
