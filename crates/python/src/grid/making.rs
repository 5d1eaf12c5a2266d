//! Grids from arrays, files and rows, and grids as values.

use std::hash::{DefaultHasher, Hash, Hasher};

use mediant::{
    CornerRule, CostUnits, Ground, Limits, Map, PlacementKind, Rules,
    files::{Fraction, MapOptions, RosVersion, Tiles, WorldFrame},
    grid::{Identity, MapId},
};
use mediant_formats::Picture;
use pyo3::{
    prelude::*,
    types::{PyBytes, PyDict, PyString, PyTuple},
};

use super::{Grid, elevation::state_of, occupancy::frame};
use crate::{
    arguments::{file, flag, integer, number, text, word},
    arrays::{Criteria, bits_of, cells_of, map_of, map_of_bits, png_of},
    background::detached,
    costs,
    errors::{argument, instead, raised, raised_for, wrong_type},
    keywords::unknown_keyword,
    walking,
    world::{World, placed},
};

/// The keywords of `Grid`, for an error.
const KEYWORDS: &str = "above, below, values, resolution, origin, world, costs, cell_size";

#[pymethods]
impl Grid {
    #[new]
    #[pyo3(
        signature = (array, *, above = None, below = None, values = None, resolution = None, origin = None,
            world = None, costs = None, cell_size = None, **others),
        text_signature = "(array, *, above=None, below=None, values=None, resolution=None, origin=None, \
            world=None, costs=None, cell_size=None)"
    )]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn of_array<'py>(
        array: &Bound<'py, PyAny>,
        above: Option<Bound<'py, PyAny>>,
        below: Option<Bound<'py, PyAny>>,
        values: Option<Bound<'py, PyAny>>,
        resolution: Option<&Bound<'py, PyAny>>,
        origin: Option<&Bound<'py, PyAny>>,
        world: Option<&Bound<'py, PyAny>>,
        costs: Option<&Bound<'py, PyAny>>,
        cell_size: Option<&Bound<'py, PyAny>>,
        others: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Self> {
        if let Some((name, _)) = others.and_then(|others| others.iter().next()) {
            return Err(unknown_keyword("Grid", &name.to_string(), KEYWORDS));
        }
        let map = map_of(array, &Criteria { above, below, values })?;
        let world = match (resolution, origin) {
            (None, None) => world.map_or(Ok(None), |world| placed(world, &map))?,
            _ if world.is_some_and(|world| !world.is_none()) => {
                return Err(argument("world", "it has a resolution and an origin: leave these out"));
            }
            (None, Some(_)) => {
                return Err(argument("origin", "it needs the side of a cell in meters too: resolution="));
            }
            (Some(resolution), origin) => Some(frame(&map, resolution, origin)?),
        };
        let size = costs::cell_size(cell_size)?;
        match (costs.filter(|costs| !costs.is_none()), cell_size.filter(|size| !size.is_none())) {
            (Some(costs), _) => Ok(Self::new(costs::costs_of(costs, &map, size)?, world)),
            (None, Some(_)) => Err(argument("cell_size", "it goes with costs=: lengths are in cells")),
            (None, None) => Ok(Self::new(map, world)),
        }
    }

    /// Reads a map from a file: a MovingAI ``.map``, a PNG, PGM or PBM picture, or the YAML file of a ROS
    /// map. The content decides which, not the name.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     The file.
    /// threshold : float or str
    ///     Of pictures: pixels darker than this part of white are blocked. Of ROS maps: cells occupied to
    ///     more than 1 - threshold are. From 0 to 1.
    /// invert : bool
    ///     Takes a picture as a negative: light pixels are blocked.
    /// unknown : {"blocked", "free"}
    ///     Whether transparent pixels, and the unknown cells of a ROS map, are blocked or free.
    /// ros : {2, 1}
    ///     Whose `map_server` says how the picture of a ROS map is read: that of ROS 2 (nav2 since 2025: the
    ///     luma of colours, thresholds that count, pixels that are not opaque unknown) or that of ROS 1 (the
    ///     mean of the channels).
    /// free, blocked : str or None
    ///     Of MovingAI maps, the characters of free and of blocked cells, as in `from_rows`.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     With its place in the `world`, if it is a ROS map.
    ///
    /// Raises
    /// ------
    /// MissingFileError
    ///     For a file that does not exist. It is a FileNotFoundError, too.
    /// FileError
    ///     For a file that cannot be read, or is no map.
    ///
    /// Examples
    /// --------
    /// >>> import pathlib, tempfile
    /// >>> import mediant
    /// >>> file = pathlib.Path(tempfile.mkdtemp()) / "room.pgm"
    /// >>> _ = file.write_text("P2 3 2 255  255 0 255  255 255 255")
    /// >>> mediant.Grid.open(file).to_numpy().tolist()
    /// [[False, True, False], [False, False, False]]
    #[staticmethod]
    #[pyo3(
        signature = (path, *, threshold = None, invert = None, unknown = None, ros = None, free = None,
            blocked = None),
        text_signature = "(path, *, threshold=0.5, invert=False, unknown='blocked', ros=2, free=None, \
                          blocked=None)"
    )]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn open(
        py: Python<'_>,
        path: &Bound<'_, PyAny>,
        threshold: Option<&Bound<'_, PyAny>>,
        invert: Option<&Bound<'_, PyAny>>,
        unknown: Option<&Bound<'_, PyAny>>,
        ros: Option<&Bound<'_, PyAny>>,
        free: Option<&Bound<'_, PyAny>>,
        blocked: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let path = file("path", path)?;
        let mut options = MapOptions::default();
        if let Some(threshold) = threshold {
            options.threshold = fraction(threshold)?;
        }
        options.invert = invert.map_or(Ok(false), |invert| flag("invert", invert))?;
        if let Some(unknown) = unknown {
            options.unknown = word("unknown", unknown)?;
        }
        if let Some(ros) = ros {
            options.ros = match integer("ros", ros, 1)? {
                1 => RosVersion::Ros1,
                2 => RosVersion::Ros2,
                found => return Err(argument("ros", &format!("expected 1 or 2, found {found}"))),
            };
        }
        options.tiles = tiles(free, blocked)?;
        let read = move |limits: &Limits| Map::open_within(path, &options, limits);
        let (map, world) = detached(py, u64::MAX, Limits::new(), read)?.map_err(raised)?;
        Ok(Self::new(map, world))
    }

    /// The grid with these rows of text: ``.``, ``G`` and ``S`` are free cells, ``#``, ``@``, ``O``, ``T``
    /// and ``W`` blocked ones, small letters as capitals.
    ///
    /// Parameters
    /// ----------
    /// rows : iterable of str
    ///     From top to bottom, all of the same length.
    /// free, blocked : str or None
    ///     The characters of free and of blocked cells. With one of them all others are of the other kind;
    ///     with both, others are an error.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     The map.
    ///
    /// Raises
    /// ------
    /// MapError
    ///     For no rows, rows of different lengths, or a character that is neither free nor blocked.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["..#", "..."]).shape
    /// (2, 3)
    /// >>> mediant.Grid.from_rows(["#   #"], free=" ").to_numpy().tolist()
    /// [[True, False, False, False, True]]
    #[staticmethod]
    #[pyo3(signature = (rows, *, free = None, blocked = None))]
    fn from_rows(
        rows: &Bound<'_, PyAny>,
        free: Option<&Bound<'_, PyAny>>,
        blocked: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let expected = "several rows of text";
        if rows.is_instance_of::<PyString>() {
            return Err(wrong_type("rows", expected, rows));
        }
        let wrong = |cause| instead(rows.py(), cause, wrong_type("rows", expected, rows));
        let items = rows.try_iter().map_err(wrong)?;
        let items: Vec<String> = items
            .map(|row| {
                let row = row?;
                text("rows", expected, &row)
            })
            .collect::<PyResult<_>>()?;
        let map = Map::from_rows_with(items, &tiles(free, blocked)?);
        Ok(Self::new(map.map_err(|error| raised_for("rows", error))?, None))
    }

    /// The number of rows and columns.
    #[getter]
    fn shape(&self) -> (u32, u32) {
        (self.map().height(), self.map().width())
    }

    /// Where the map is in the world; None if it was not said.
    #[getter]
    fn world(&self) -> Option<World> {
        self.shared.world.map(|frame| World { frame })
    }

    /// A name of the content: the same for grids with the same cells, and costs or elevations.
    #[getter]
    fn id(&self) -> String {
        let identity =
            Identity { map: Some(self.map_id()), rules: Rules::Center(CornerRule::Never), k: None };
        // The size and the digest.
        identity.to_bytes()[..24].iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// The cells as an array.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     Shape (rows, columns), bool: True where a cell is blocked. A new array each time.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows([".#"]).to_numpy().tolist()
    /// [[False, True]]
    fn to_numpy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        cells_of(py, self.map())
    }

    /// The cells for NumPy's functions.
    #[pyo3(signature = (dtype = None, copy = None))]
    fn __array__<'py>(
        &self,
        py: Python<'py>,
        dtype: Option<&Bound<'py, PyAny>>,
        copy: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        if copy == Some(false) {
            return Err(argument("copy", "a grid has no array of its own: it can only be copied"));
        }
        let array = self.to_numpy(py)?;
        dtype.map_or(Ok(array.clone()), |dtype| array.call_method1("astype", (dtype,)))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| self == other.get())
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.map_id().hash(&mut hasher);
        hasher.finish()
    }

    /// By the bits of the cells, row by row in whole bytes, and the place in the world, for pickle; costs by
    /// four bytes a cell, and what these stand for; elevations by arrays.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, grid) = (slf.py(), slf.get());
        let (rows, columns) = grid.shape();
        let world = grid.shared.world.map(|frame| (frame.resolution(), frame.origin()));
        if let Ground::Costs(costs) = grid.ground() {
            let CostUnits { bounds, step, cell_size } = costs.units();
            let steps = PyBytes::new(py, &py.detach(|| costs::steps_of(costs)));
            let state = (steps, rows, columns, world, (bounds, step, cell_size)).into_pyobject(py)?;
            return Ok((slf.get_type().getattr("_of_costs")?, state));
        }
        if let Ground::Walking(walking) = grid.ground() {
            let state = state_of(py, walking, grid.shared.world)?;
            return Ok((slf.get_type().getattr("_of_walking")?, state));
        }
        let bits = PyBytes::new(py, &py.detach(|| bits_of(grid.map())));
        Ok((slf.get_type().getattr("_of_state")?, (bits, rows, columns, world).into_pyobject(py)?))
    }

    /// The grid of a state that `__reduce__` gave.
    #[staticmethod]
    fn _of_state(
        bits: &Bound<'_, PyBytes>,
        rows: u32,
        columns: u32,
        world: Option<(f64, [f64; 3])>,
    ) -> PyResult<Self> {
        let expected = u64::from(rows) * u64::from(columns.div_ceil(8));
        if bits.as_bytes().len() as u64 != expected {
            return Err(argument("bits", &format!("expected {expected} bytes")));
        }
        let map = map_of_bits(bits.as_bytes(), rows, columns, &Limits::new()).map_err(raised)?;
        Ok(Self::new(map, frame_of(world, rows, columns)?))
    }

    /// The grid with costs of a state that `__reduce__` gave.
    #[staticmethod]
    fn _of_costs(
        steps: &Bound<'_, PyBytes>,
        rows: u32,
        columns: u32,
        world: Option<(f64, [f64; 3])>,
        units: ((f64, f64), f64, (f64, f64)),
    ) -> PyResult<Self> {
        let (bounds, step, cell_size) = units;
        let (bytes, units) = (steps.as_bytes(), CostUnits { bounds, step, cell_size });
        let expected = 4 * u64::from(rows) * u64::from(columns);
        if bytes.len() as u64 != expected {
            return Err(argument("steps", &format!("expected {expected} bytes")));
        }
        let read = || costs::costs_of_steps(bytes, (rows, columns), units, &Limits::new());
        let costs = steps.py().detach(read).map_err(costs::raised_for_costs)?;
        Ok(Self::new(costs, frame_of(world, rows, columns)?))
    }

    /// The map as a picture, for notebooks; costs and elevations by their colors.
    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let picture = Picture::new(self.map().grid(), PlacementKind::Center);
        match self.ground() {
            Ground::Map(_) => png_of(py, picture),
            Ground::Costs(costs) => png_of(py, picture.field(|at| costs.cost(at))),
            Ground::Walking(walking) => png_of(py, picture.field(|at| walking.elevation(at))),
        }
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let map = self.map();
        let (height, width, blocked) = (map.height(), map.width(), self.cells() - map.grid().free_cells());
        let more = match self.ground() {
            Ground::Map(_) => String::new(),
            Ground::Costs(costs) => costs::in_words(py, costs)?,
            Ground::Walking(walking) => walking::in_words(py, walking)?,
        };
        Ok(format!("<mediant.Grid of {height} × {width} cells, {blocked} blocked{more}>"))
    }
}

impl Grid {
    /// The identity of the map, of its costs or of its elevations.
    fn map_id(&self) -> MapId {
        match self.ground() {
            Ground::Map(map) => map.id(),
            Ground::Costs(costs) => costs.id(),
            Ground::Walking(walking) => walking.id(),
        }
    }
}

/// The place in the world of a state.
pub(super) fn frame_of(
    world: Option<(f64, [f64; 3])>,
    rows: u32,
    columns: u32,
) -> PyResult<Option<WorldFrame>> {
    let frame = world.map(|(resolution, origin)| WorldFrame::new(resolution, origin, columns, rows));
    frame.transpose().map_err(|error| argument("world", &error.to_string()))
}

/// The characters of free and of blocked cells.
fn tiles(free: Option<&Bound<'_, PyAny>>, blocked: Option<&Bound<'_, PyAny>>) -> PyResult<Tiles> {
    let read = |name, value: Option<&Bound<'_, PyAny>>| {
        value.map(|value| text(name, "a text of characters", value)).transpose()
    };
    let (free, blocked) = (read("free", free)?, read("blocked", blocked)?);
    let name = if free.is_some() { "free" } else { "blocked" };
    Tiles::new(free.as_deref(), blocked.as_deref()).map_err(|error| argument(name, &error.to_string()))
}

/// The threshold of a picture.
fn fraction(value: &Bound<'_, PyAny>) -> PyResult<Fraction> {
    let read = match value.cast::<PyString>() {
        Ok(text) => text.to_string().parse(),
        Err(_) => Fraction::try_from(number("threshold", value)?),
    };
    read.map_err(|error| argument("threshold", &error.to_string()))
}
