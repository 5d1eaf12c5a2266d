//! Where a map is in the world.

use std::hash::{DefaultHasher, Hash, Hasher};

use mediant::{
    Map, Point,
    files::{WorldError, WorldFrame},
};
use pyo3::{prelude::*, types::PyTuple};

use crate::{
    arguments::{Points, integer, number, word},
    arrays::rows_array,
    errors::{argument, instead, raised_for, wrong_type},
    grid::place,
};

/// Where a map is in the world: `Grid.world`.
///
/// Grids of ROS maps and of occupancy messages have one, and those of arrays with a ``resolution``. Others
/// get one that is made by hand: ``Grid(array, world=world)``, `Grid.with_world`.
///
/// Parameters
/// ----------
/// resolution : float
///     The side of a cell, in meters.
/// origin : tuple of float
///     The lower left corner of the map, below the last row: x and y in meters, and its turn in radians,
///     counterclockwise, which may be left out; (0, 0) by default.
/// shape : tuple of int
///     The number of rows and columns of the map: `Grid.shape`.
///
/// Attributes
/// ----------
/// resolution : float
///     The side of a cell, in meters.
/// origin : tuple of float
///     The lower left corner of the map: x and y in meters, and its turn in radians.
/// shape : tuple of int
///     The number of rows and columns of the map.
///
/// Raises
/// ------
/// ArgumentError
///     For a resolution or an origin that places no map.
/// MapError
///     For a shape that no map has.
///
/// Examples
/// --------
/// >>> import mediant
/// >>> mediant.World(0.05, (-1, -0.5), shape=(20, 40)).vertex_at(-0.99, -0.49)
/// (19, 0)
///
/// That of a ROS map:
///
/// >>> import pathlib, tempfile
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
    #[new]
    #[pyo3(
        signature = (resolution, origin = None, *, shape),
        text_signature = "(resolution, origin=(0.0, 0.0, 0.0), *, shape)"
    )]
    fn by_hand(
        resolution: &Bound<'_, PyAny>,
        origin: Option<&Bound<'_, PyAny>>,
        shape: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let resolution = number("resolution", resolution)?;
        let origin = origin.map_or(Ok([0.0; 3]), place)?;
        let [rows, columns] = sides(shape)?;
        let frame = WorldFrame::new(resolution, origin, columns, rows).map_err(|error| match error {
            WorldError::Origin { .. } => argument("origin", &error.to_string()),
            WorldError::Size(error) => raised_for("shape", error),
            error => argument("resolution", &error.to_string()),
        })?;
        Ok(Self { frame })
    }

    /// The number of rows and columns of the map.
    #[getter]
    const fn shape(&self) -> (u32, u32) {
        (self.frame.height(), self.frame.width())
    }

    /// A length in meters, in cells: for radii, limits, tolerances and spacings.
    ///
    /// Parameters
    /// ----------
    /// meters : float
    ///     The length.
    ///
    /// Returns
    /// -------
    /// float
    ///     It divided by the resolution.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.World(0.5, shape=(2, 2)).cells(3)
    /// 6.0
    fn cells(&self, meters: &Bound<'_, PyAny>) -> PyResult<f64> {
        Ok(self.frame.cells(number("meters", meters)?))
    }

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

    /// The point of the map at a place of the world, for a path at any angle.
    ///
    /// Parameters
    /// ----------
    /// x, y : float
    ///     The place, in meters.
    /// placement : {"center", "corner"}
    ///     Whether (0, 0) is the middle of the first cell, or the corner of the map.
    ///
    /// Returns
    /// -------
    /// tuple of float or None
    ///     (row, column), rounded to multiples of 1/1024 of a cell; None for a place outside the map.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> world = mediant.World(0.5, (-1, -2), shape=(6, 8))
    /// >>> world.place_at(-0.75, 0.25, placement="corner"), world.place_at(-0.75, 0.25)
    /// ((1.5, 0.5), (1.0, 0.0))
    #[pyo3(signature = (x, y, *, placement = None), text_signature = "($self, x, y, *, placement='center')")]
    fn place_at(
        &self,
        x: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        placement: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Option<(f64, f64)>> {
        let at = self.frame.place_at(kind(placement)?, number("x", x)?, number("y", y)?);
        Ok(at.map(|at| (at.y(), at.x())))
    }

    /// The places of vertices, or points of the map, in the world.
    ///
    /// Parameters
    /// ----------
    /// points : array_like
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
        let place = |&at: &Point| <[f64; 2]>::from(self.frame.point_of(placement, at));
        let flat: Vec<f64> = read.as_slice().iter().flat_map(place).collect();
        let array = rows_array(py, flat, 2)?;
        match read {
            Points::One(_) => array.call_method1("reshape", (2,)),
            Points::Several(_) => Ok(array),
        }
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| self.frame == other.get().frame)
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        let [x, y, _] = self.frame.origin();
        // Zeros of both signs are equal.
        [self.frame.resolution(), x + 0.0, y + 0.0].map(f64::to_bits).hash(&mut hasher);
        self.shape().hash(&mut hasher);
        hasher.finish()
    }

    /// By its numbers, for pickle.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let frame = slf.get().frame;
        let state = (frame.resolution(), frame.origin(), frame.height(), frame.width());
        Ok((slf.get_type().getattr("_of_state")?, state.into_pyobject(slf.py())?))
    }

    /// The world of a state that `__reduce__` gave.
    #[staticmethod]
    fn _of_state(resolution: f64, origin: [f64; 3], rows: u32, columns: u32) -> PyResult<Self> {
        let frame = WorldFrame::new(resolution, origin, columns, rows);
        Ok(Self { frame: frame.map_err(|error| argument("world", &error.to_string()))? })
    }

    fn __repr__(&self) -> String {
        format!("<mediant.World {} m a cell, origin {:?}>", self.frame.resolution(), self.frame.origin())
    }
}

/// The number of rows and columns.
fn sides(shape: &Bound<'_, PyAny>) -> PyResult<[u32; 2]> {
    let expected = "the number of rows and columns";
    let wrong = |cause| instead(shape.py(), cause, wrong_type("shape", expected, shape));
    let mut sides = Vec::new();
    for item in shape.try_iter().map_err(wrong)?.take(3) {
        sides.push(u32::try_from(integer("shape", &item?, 0)?).unwrap_or(u32::MAX));
    }
    <[u32; 2]>::try_from(sides).map_err(|_| argument("shape", &format!("expected {expected}")))
}

/// The place in the world of a map, as an argument names it; `None` for none.
pub(crate) fn placed(world: &Bound<'_, PyAny>, map: &Map) -> PyResult<Option<WorldFrame>> {
    if world.is_none() {
        return Ok(None);
    }
    let Ok(given) = world.cast::<World>() else { return Err(wrong_type("world", "a World or None", world)) };
    let (frame, size) = (given.get().frame, (map.width(), map.height()));
    if (frame.width(), frame.height()) == size {
        return Ok(Some(frame));
    }
    let (columns, rows) = size;
    let text = format!(
        "expected that of a map of {rows} × {columns} cells, found one of {} × {}",
        frame.height(),
        frame.width()
    );
    Err(argument("world", &text))
}

fn kind(value: Option<&Bound<'_, PyAny>>) -> PyResult<mediant::PlacementKind> {
    value.map_or(Ok(mediant::PlacementKind::Center), |value| word("placement", value))
}
