//! Distance fields.

use mediant::{DirectionCode, ErrorCode, Ground, PlacementKind, Point, Vertex, names};
use mediant_formats::Picture;
use pyo3::{
    prelude::*,
    types::{PyBytes, PyTuple},
};

use crate::{
    arguments::{point as place, word},
    arrays::{PathPoints, png_of, rows_array},
    errors::{exception, raised, wrong_type},
};

/// The distance of every vertex to the nearest of one or several sources, with the paths to it.
///
/// `Grid.field` makes it. Where cells have costs it has the least costs in place of distances: what GIS calls
/// a cost distance. Over elevation a field has a heading: it has the times of the ways to the nearest source,
/// or of those from it.
///
/// Attributes
/// ----------
/// shape : tuple of int
///     The number of rows and columns of vertices: those of the map, at corners one more each.
///
/// Examples
/// --------
/// >>> import mediant
/// >>> field = mediant.Grid.from_rows(["....", ".##.", "...."]).field([(0, 0), (2, 3)])
/// >>> field.distances().round(1).tolist()
/// [[0.0, 1.0, 2.0, 2.0], [1.0, inf, inf, 1.0], [2.0, 2.0, 1.0, 0.0]]
/// >>> field.path_from((0, 3)).tolist()
/// [[0, 3], [2, 3]]
#[pyclass(frozen, module = "mediant")]
pub(crate) struct Field {
    inner: mediant::Field,
    placement: PlacementKind,
    ground: Ground,
    heading: Heading,
}

/// Whether paths lead to the sources of a field or from them.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Heading {
    To,
    From,
}

names!(Heading: To => "to", From => "from");

impl Heading {
    /// That of an argument; the usual one if it was left out.
    pub(crate) fn read(value: Option<&Bound<'_, PyAny>>, usual: Self) -> PyResult<Self> {
        value.map_or(Ok(usual), |value| word("heading", value))
    }
}

impl Field {
    pub(crate) const fn new(
        inner: mediant::Field,
        placement: PlacementKind,
        ground: Ground,
        heading: Heading,
    ) -> Self {
        Self { inner, placement, ground, heading }
    }

    /// Refuses the paths of the other heading, where a way and the way back differ.
    fn check_heading(&self, heading: Heading) -> PyResult<()> {
        if self.ground.walking().is_none() || self.heading == heading {
            return Ok(());
        }
        let (known, needed) = match heading {
            Heading::To => ("path_to", "to"),
            Heading::From => ("path_from", "from"),
        };
        let text = format!(
            "over elevation a way and the way back differ: this field has {known}; make one with \
             heading='{needed}'"
        );
        Err(exception("MismatchError", &text, ErrorCode::Mismatch.name()))
    }

    /// The distances of all vertices, of a field that is not needed any more.
    pub(crate) fn into_distances(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        let width = self.inner.width() as usize;
        let lengths = py.detach(|| self.inner.into_lengths());
        rows_array(py, lengths, width)
    }

    /// All vertices, row by row.
    fn vertices(&self) -> impl Iterator<Item = Vertex> {
        let (width, height) = (self.inner.width() as i32, self.inner.height() as i32);
        (0..height).flat_map(move |y| (0..width).map(move |x| Vertex::new(x, y)))
    }
}

#[pymethods]
impl Field {
    /// The number of rows and columns of vertices.
    #[getter]
    fn shape(&self) -> (u32, u32) {
        (self.inner.height(), self.inner.width())
    }

    /// The distances of all vertices to the nearest source.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     The shape of the field, float64, in cells, or costs where cells have costs; ``inf`` where no path
    ///     leads, or none within the limit.
    ///     At a number k they are sums of rounded moves, the same numbers as those of `Grid.distance` and
    ///     tables; they differ from the length of a path's lines by less than 1 in 2³³.
    ///
    /// Examples
    /// --------
    /// See `Field`.
    pub(crate) fn distances<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let lengths = py.detach(|| self.inner.lengths());
        rows_array(py, lengths, self.inner.width() as usize)
    }

    /// The directions in which the shortest paths leave the vertices; of a field from its sources over
    /// elevation those back along the paths to them.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     The shape of the field and 2, float64: (row, column) vectors of length 1; 0 at sources, ``nan``
    ///     where no path leads.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["..."]).field((0, 2)).flow()[0].tolist()
    /// [[0.0, 1.0], [0.0, 1.0], [0.0, 0.0]]
    pub(crate) fn flow<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let direction = |at: Vertex| match self.inner.direction(at) {
            Some((dx, dy)) => [dy, dx],
            None if self.inner.get(at).is_some() => [0.0, 0.0],
            None => [f64::NAN, f64::NAN],
        };
        let flat: Vec<f64> = py.detach(|| self.vertices().flat_map(direction).collect());
        self.planes(&rows_array(py, flat, 2)?)
    }

    /// The vertices to which the shortest paths lead next: one move away. At any angle the next corner of an
    /// obstacle on the path, or the source: mostly where the path first bends, but it may also go straight on
    /// there, where its line only touches the corner. `path_from` has waypoints at bends alone. Of a field
    /// from its sources over elevation it is the vertex before, on the path from the source.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     The shape of the field and 2, int32: (row, column); a source's own at sources, -1 where no path
    ///     leads. float64 where a path leads to a point between vertices.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["..."]).field((0, 2)).next()[0].tolist()
    /// [[0, 1], [0, 2], [0, 2]]
    fn next<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let next = |at: Vertex| match self.inner.next(at) {
            Some(next) => next,
            None if self.inner.get(at).is_some() => at.into(),
            None => Vertex::new(-1, -1).into(),
        };
        let all: Vec<Point> = py.detach(|| self.vertices().map(next).collect());
        let whole: Option<Vec<Vertex>> = all.iter().map(|at| at.vertex()).collect();
        self.planes(&match whole {
            Some(whole) => rows_array(py, whole.iter().flat_map(|at| [at.y, at.x]).collect(), 2)?,
            None => rows_array(py, all.iter().flat_map(|at| [at.y(), at.x()]).collect(), 2)?,
        })
    }

    /// The distance of a vertex to the nearest source.
    ///
    /// Parameters
    /// ----------
    /// point : tuple of int
    ///     (row, column).
    ///
    /// Returns
    /// -------
    /// float
    ///     In cells, the number that `distances` has there; ``inf`` where no path leads, and outside the map.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows([".#.", "..."]).field((0, 0), k=2).get((0, 2))
    /// 4.0
    fn get(&self, point: &Bound<'_, PyAny>) -> PyResult<f64> {
        Ok(self.inner.get(place("point", point)?).unwrap_or(f64::INFINITY))
    }

    /// The shortest path from a vertex to the nearest source.
    ///
    /// Parameters
    /// ----------
    /// point : tuple of int
    ///     (row, column).
    /// points : {"waypoints", "vertices", "touched"}
    ///     The points of the array: see `Grid.find`.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray or None
    ///     Shape (n, 2), int32; None where no path leads, or the point is blocked or outside the map.
    ///
    /// Raises
    /// ------
    /// MismatchError
    ///     Over elevation, for a field from its sources: it has `path_to`.
    ///
    /// Examples
    /// --------
    /// See `Field`.
    #[pyo3(signature = (point, *, points = None), text_signature = "($self, point, *, points='waypoints')")]
    fn path_from<'py>(
        &self,
        point: &Bound<'py, PyAny>,
        points: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let (py, points) = (point.py(), PathPoints::read(points)?);
        self.check_heading(Heading::To)?;
        let path = self.inner.path_from(place("point", point)?);
        path.map(|path| points.array(py, &path, self.inner.identity().rules)).transpose()
    }

    /// The shortest path from the nearest source to a vertex: `path_from` the other way.
    ///
    /// Parameters
    /// ----------
    /// point : tuple of int
    ///     (row, column).
    /// points : {"waypoints", "vertices", "touched"}
    ///     The points of the array: see `Grid.find`.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray or None
    ///     As of `path_from`.
    ///
    /// Raises
    /// ------
    /// MismatchError
    ///     Over elevation, for a field to its sources.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["...", "..."]).field((0, 0)).path_to((1, 2)).tolist()
    /// [[0, 0], [0, 1], [1, 2]]
    #[pyo3(signature = (point, *, points = None), text_signature = "($self, point, *, points='waypoints')")]
    fn path_to<'py>(
        &self,
        point: &Bound<'py, PyAny>,
        points: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let (py, points) = (point.py(), PathPoints::read(points)?);
        self.check_heading(Heading::From)?;
        let path = self.inner.path_to(place("point", point)?);
        path.map(|path| points.array(py, &path, self.inner.identity().rules)).transpose()
    }

    /// The source that is nearest to a vertex.
    ///
    /// Parameters
    /// ----------
    /// point : tuple of int
    ///     (row, column).
    ///
    /// Returns
    /// -------
    /// tuple of int or None
    ///     (row, column) of the source, of one between vertices floats; None where no path leads.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> field = mediant.Grid.from_rows(["....."]).field([(0, 0), (0, 4)])
    /// >>> field.nearest_source((0, 3))
    /// (0, 4)
    fn nearest_source<'py>(&self, point: &Bound<'py, PyAny>) -> PyResult<Option<Bound<'py, PyTuple>>> {
        let source = self.inner.nearest_source(place("point", point)?);
        let pair = |at: Point| match at.vertex() {
            Some(at) => (at.y, at.x).into_pyobject(point.py()),
            None => (at.y(), at.x()).into_pyobject(point.py()),
        };
        source.map(pair).transpose()
    }

    /// The numbers of the nearest sources: to which of them each vertex belongs.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     The shape of the field, int32: the index of the source in the list that the field was made of; -1
    ///     where no path leads. Of several that are equally near it is one of them; where cells have costs,
    ///     the first.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["..#...."]).field([(0, 0), (0, 6)]).allocation().tolist()
    /// [[0, 0, -1, 1, 1, 1, 1]]
    fn allocation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let number = |number: Option<u32>| number.map_or(-1, |number| number as i32);
        let numbers = py.detach(|| self.inner.allocation().into_iter().map(number).collect());
        rows_array::<i32>(py, numbers, self.inner.width() as usize)
    }

    /// The directions to the nearest sources as numbers that GIS programs read.
    ///
    /// Parameters
    /// ----------
    /// code : {"arcgis", "degrees", "grass"}
    ///     ``"arcgis"`` are the back links of ArcGIS, for k = 2 and 3: 1 to 8 clockwise from east, 0 at a
    ///     source. ``"degrees"`` are its back directions: degrees clockwise from north, above 0 to 360, 0 at
    ///     a source. ``"grass"`` are the movement directions of GRASS: degrees counterclockwise from east,
    ///     above 0 to 360; sources have none.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     The shape of the field, float64: the direction to the vertex that `next` has; ``nan`` where no
    ///     path leads, and where the code has no number.
    ///
    /// Raises
    /// ------
    /// OptionError
    ///     For a code that is none of these.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> field = mediant.Grid.from_rows(["..", ".#"]).field((0, 0))
    /// >>> field.directions("arcgis").tolist(), field.directions("grass").tolist()
    /// ([[0.0, 5.0], [7.0, nan]], [[nan, 180.0], [90.0, nan]])
    fn directions<'py>(&self, code: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let (py, code) = (code.py(), word::<Code>("code", code)?.into());
        let numbers = py.detach(|| self.inner.directions(code));
        rows_array(py, numbers, self.inner.width() as usize)
    }

    /// For each vertex the sum of its distances in two fields: the best path from a source of one to a source
    /// of the other that leads over it. The vertices with little more than the least are a corridor.
    ///
    /// Parameters
    /// ----------
    /// other : Field
    ///     Of the same grid and motion; over elevation of the other heading.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     The shape of the field, float64; ``inf`` where a vertex is not in both fields.
    ///
    /// Raises
    /// ------
    /// MismatchError
    ///     For fields of different grids or motions, and over elevation for two of the same heading.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", "...."])
    /// >>> corridor = grid.field((0, 0)).corridor(grid.field((0, 3)))
    /// >>> corridor.round(2).tolist()
    /// [[3.0, 3.0, 3.0, 3.0], [4.41, 3.83, 3.83, 4.41]]
    fn corridor<'py>(&self, other: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let Ok(field) = other.cast::<Self>() else { return Err(wrong_type("other", "a Field", other)) };
        let (py, field) = (other.py(), &field.get().inner);
        let sums = py.detach(|| self.inner.corridor(field)).map_err(raised)?;
        rows_array(py, sums, self.inner.width() as usize)
    }

    /// The distances as a DataArray of xarray, with the coordinates of another one.
    ///
    /// Parameters
    /// ----------
    /// like : xarray.DataArray
    ///     The raster that the grid was made of, or another one of the shape of the field.
    ///
    /// Returns
    /// -------
    /// xarray.DataArray
    ///     Named ``"distance"``, where paths have costs ``"cost"``; ``inf`` where no path leads.
    ///
    /// Raises
    /// ------
    /// ArgumentError
    ///     For a raster of another shape.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> costs = xarray.open_dataarray("friction.nc")  # doctest: +SKIP
    /// >>> field = mediant.Grid.from_costs(costs).field((0, 0))  # doctest: +SKIP
    /// >>> field.to_xarray(costs).plot()  # doctest: +SKIP
    fn to_xarray<'py>(&self, like: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let py = like.py();
        let name = if matches!(self.ground, Ground::Map(_)) { "distance" } else { "cost" };
        let make = py.import("mediant._rasters")?.getattr("like_raster")?;
        make.call1((self.distances(py)?, like, name))
    }

    /// The distances as a picture, for notebooks.
    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let picture = Picture::new(self.ground.map().grid(), self.placement);
        png_of(py, picture.field(|at| self.inner.get(at)))
    }

    fn __repr__(&self) -> String {
        format!("<mediant.Field of {} × {} vertices>", self.inner.height(), self.inner.width())
    }
}

/// A code of directions.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Code {
    ArcGis,
    Degrees,
    Grass,
}

names!(Code: ArcGis => "arcgis", Degrees => "degrees", Grass => "grass");

impl From<Code> for DirectionCode {
    fn from(code: Code) -> Self {
        match code {
            Code::ArcGis => Self::ArcGisBackLink,
            Code::Degrees => Self::ArcGisDegrees,
            Code::Grass => Self::Grass,
        }
    }
}

impl Field {
    /// An array of points, one for each vertex, in the shape of the field.
    fn planes<'py>(&self, array: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        array.call_method1("reshape", ((self.inner.height(), self.inner.width(), 2),))
    }
}
