//! Maps from arrays, and arrays from paths.

use mediant::{Limits, Map, Path, PlacementKind, Rules, Vertex, grid::Grid, names};
use mediant_formats::Picture;
use numpy::{
    PyArray1, PyArray2, PyArrayDescrMethods, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods,
    ToPyArray, ndarray::ArrayView2,
};
use pyo3::{
    exceptions::PyTypeError,
    prelude::*,
    types::{PyBytes, PyDict, PyFloat, PyInt, PyList},
};

use crate::{
    arguments::{number, numpy_function, word},
    background::detached,
    errors::{argument, exception, instead, raised_for, wrong_type},
};

/// By what the cells of an array are blocked.
pub(crate) struct Criteria<'py> {
    pub(crate) above: Option<Bound<'py, PyAny>>,
    pub(crate) below: Option<Bound<'py, PyAny>>,
    pub(crate) values: Option<Bound<'py, PyAny>>,
}

/// The map of an array.
pub(crate) fn map_of<'py>(array: &Bound<'py, PyAny>, criteria: &Criteria<'py>) -> PyResult<Map> {
    let array = plane("array", array)?;
    let kind = array.dtype().kind();
    let Criteria { above, below, values } = criteria;
    let has_criteria = above.is_some() || below.is_some() || values.is_some();
    match kind {
        b'b' if has_criteria => Err(PyTypeError::new_err(
            "array: a bool array is True where a cell is blocked: leave out above, below and values",
        )),
        b'b' => map_of_bools("array", &array),
        b'i' | b'u' | b'f' if has_criteria => {
            let blocked = blocked(&array, criteria)?;
            map_of_bools("array", &blocked)
        }
        b'i' | b'u' | b'f' => Err(PyTypeError::new_err(format!(
            "array: expected dtype bool (True is blocked), found {}; if these are costs of cells, give them as \
             costs=, or alone to Grid.from_costs; else say which values are blocked, by above=, below= or \
             values=, or make an array of bool, for instance array > limit",
            array.dtype()
        ))),
        _ => Err(PyTypeError::new_err(format!("array: expected numbers or bool, found {}", array.dtype()))),
    }
}

/// The argument as an array of two dimensions.
pub(crate) fn plane<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyUntypedArray>> {
    let py = value.py();
    let ma = py.import("numpy.ma")?;
    let is_masked = value.is_instance(&ma.getattr("MaskedArray")?)?;
    if is_masked && ma.getattr("is_masked")?.call1((value,))?.is_truthy()? {
        return Err(argument(name, "it is masked: fill it first, for instance by array.filled()"));
    }
    let wrong =
        |cause| instead(py, cause, argument(name, "expected rows of the same length, found no array"));
    let array = numpy_function(py, "asarray")?.call1((value,)).map_err(wrong)?;
    let array = array.cast_into::<PyUntypedArray>().map_err(|_| wrong_type(name, "an array", value))?;
    if array.ndim() != 2 {
        let wrong = format!("expected an array of rows and columns, found one of shape {:?}", array.shape());
        return Err(argument(name, &wrong));
    }
    Ok(array)
}

/// The cells that meet one of the criteria, as an array of bool.
fn blocked<'py>(
    array: &Bound<'py, PyUntypedArray>,
    criteria: &Criteria<'py>,
) -> PyResult<Bound<'py, PyUntypedArray>> {
    let py = array.py();
    let mut parts = Vec::new();
    let mut has_nan_value = false;
    for (name, method, limit) in [("above", "__gt__", &criteria.above), ("below", "__lt__", &criteria.below)]
    {
        let Some(limit) = limit else { continue };
        let limit = comparable(name, limit, array, name == "above")?;
        parts.push(array.call_method1(method, (limit,))?);
    }
    if let Some(values) = &criteria.values {
        let wrong = |cause| instead(py, cause, wrong_type("values", "several numbers", values));
        let mut items = Vec::new();
        for item in values.try_iter().map_err(wrong)? {
            let item = item?;
            has_nan_value |= number("values", &item)?.is_nan();
            items.extend(value_in(&item, array)?);
        }
        let items = numpy_function(py, "array")?.call1((PyList::new(py, items)?, array.dtype()))?;
        parts.push(numpy_function(py, "isin")?.call1((array, items))?);
    }
    if array.dtype().kind() == b'f' {
        let is_nan = numpy_function(py, "isnan")?.call1((array,))?;
        if has_nan_value {
            parts.push(is_nan);
        } else if is_nan.call_method0("any")?.is_truthy()? {
            let wrong = "it has values that are no number (nan): name nan among values to have them blocked, or \
                         fill them";
            return Err(argument("array", wrong));
        }
    }
    let mut parts = parts.into_iter();
    let first = parts.next().ok_or_else(|| argument("values", "expected at least one"))?;
    let all = parts.try_fold(first, |all, part| all.call_method1("__or__", (part,)))?;
    Ok(all.cast_into()?)
}

/// A limit in a form that compares exactly with the values of an array: with integers an integer, of which
/// those above (or below) it are those above (or below) the limit.
fn comparable<'py>(
    name: &str,
    limit: &Bound<'py, PyAny>,
    array: &Bound<'py, PyUntypedArray>,
    is_above: bool,
) -> PyResult<Bound<'py, PyAny>> {
    let py = limit.py();
    if array.dtype().kind() != b'f' && limit.is_instance_of::<PyInt>() {
        return Ok(limit.clone());
    }
    let number = number(name, limit)?;
    if number.is_nan() {
        return Err(argument(name, "expected a number, found nan"));
    }
    if array.dtype().kind() == b'f' || number.is_infinite() {
        // An array of one, since NumPy would round a single number to the type of a smaller float.
        return numpy_function(py, "array")?.call1((PyList::new(py, [number])?, "float64"));
    }
    let whole = if is_above { number.floor() } else { number.ceil() };
    PyFloat::new(py, whole).call_method0("__int__")
}

/// A value in the type of an array, rounded to it (0.1 of 32 bits is not 0.1 of 64); `None` for one that no
/// item of the array can have.
fn value_in<'py>(
    value: &Bound<'py, PyAny>,
    array: &Bound<'py, PyUntypedArray>,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let (py, dtype) = (value.py(), array.dtype());
    let float = number("values", value)?;
    if dtype.kind() == b'f' {
        let most = numpy_function(py, "finfo")?.call1((dtype,))?.getattr("max")?;
        let fits = float.is_infinite() || float.abs() <= number("values", &most)?;
        return Ok(fits.then(|| PyFloat::new(py, float).into_any()));
    }
    let whole = match value.cast::<PyInt>() {
        Ok(whole) => whole.clone().into_any(),
        Err(_) if float.fract() != 0.0 || !float.is_finite() => return Ok(None),
        Err(_) => PyFloat::new(py, float).call_method0("__int__")?,
    };
    let range = numpy_function(py, "iinfo")?.call1((dtype,))?;
    let fits = whole.ge(range.getattr("min")?)? && whole.le(range.getattr("max")?)?;
    Ok(fits.then_some(whole))
}

/// The map of an array of bool. NumPy packs eight cells into a byte; whatever is not 0 is true, since a view
/// of other bytes as bool may have any.
pub(crate) fn map_of_bools(name: &str, array: &Bound<'_, PyUntypedArray>) -> PyResult<Map> {
    let side = |axis: usize| u32::try_from(array.shape()[axis]).unwrap_or(u32::MAX);
    let (rows, columns) = (side(0), side(1));
    let wrong = |error: mediant::Error| raised_for(name, error);
    Grid::check_size(u64::from(columns), u64::from(rows)).map_err(|error| wrong(error.into()))?;
    let (bits, cells) = (packed(array)?, u64::from(rows) * u64::from(columns));
    let work = move |limits: &Limits| map_of_bits(&bits, rows, columns, limits);
    detached(array.py(), cells, Limits::new(), work)?.map_err(wrong)
}

/// The rows of an array of bool in whole bytes each, the first cell in the lowest bit.
fn packed(array: &Bound<'_, PyUntypedArray>) -> PyResult<Vec<u8>> {
    let py = array.py();
    let options = PyDict::new(py);
    options.set_item("axis", 1)?;
    options.set_item("bitorder", "little")?;
    let bits = numpy_function(py, "packbits")?.call((array,), Some(&options))?.call_method0("tobytes")?;
    Ok(bits.cast::<PyBytes>()?.as_bytes().to_vec())
}

/// The map of rows of whole bytes, the first cell in the lowest bit.
pub(crate) fn map_of_bits(
    bits: &[u8],
    rows: u32,
    columns: u32,
    limits: &Limits,
) -> Result<Map, mediant::Error> {
    let bytes_a_row = columns.div_ceil(8) as usize;
    let word = |x: u32, y: u32| {
        let (first, end) = (y as usize * bytes_a_row + x as usize / 8, (y as usize + 1) * bytes_a_row);
        let bytes = bits.get(first..end.min(first + 8)).unwrap_or_default();
        bytes.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte))
    };
    Ok(Grid::from_words_interruptible(columns, rows, &limits.interrupt(), word)?.into())
}

/// The bits of a map, as [`map_of_bits`] takes them.
pub(crate) fn bits_of(map: &Map) -> Vec<u8> {
    let bytes_a_row = map.width().div_ceil(8) as usize;
    let mut bits = Vec::with_capacity(bytes_a_row * map.height() as usize);
    for y in 0..map.height() as i32 {
        let row = map.grid().rows().row(y);
        let words = (0..map.width() as i32).step_by(64).map(|x| row.word(x).to_le_bytes());
        bits.extend(words.flatten().take(bytes_a_row));
    }
    bits
}

/// The bool cells of an array that replace a part of a map, row by row, and its number of rows and columns.
pub(crate) fn patch(name: &str, value: &Bound<'_, PyAny>) -> PyResult<(Vec<bool>, usize, usize)> {
    let array = plane(name, value)?;
    if array.dtype().kind() != b'b' {
        return Err(PyTypeError::new_err(format!(
            "{name}: expected dtype bool (True is blocked), found {}: costs of cells are changed by \
             Grid.edit_costs; make an array of bool, for instance array > limit",
            array.dtype()
        )));
    }
    let bytes = array.call_method1("view", ("uint8",))?;
    let bytes = bytes.extract::<PyReadonlyArray2<'_, u8>>()?;
    let cells = bytes.as_array();
    let (rows, columns) = cells.dim();
    Ok((cells.iter().map(|&cell| cell != 0).collect(), rows, columns))
}

/// The points of a path that an array has.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum PathPoints {
    Waypoints,
    Vertices,
    Touched,
}

names!(PathPoints: Waypoints => "waypoints", Vertices => "vertices", Touched => "touched");

impl PathPoints {
    pub(crate) fn read(value: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        value.map_or(Ok(Self::Waypoints), |value| word("points", value))
    }

    /// Adds the points of a path, if they are whole, to a flat list of rows and columns.
    pub(crate) fn add(self, path: &Path, rules: Rules, to: &mut Vec<i32>) {
        match (self, rules) {
            (Self::Waypoints, _) => add(path.waypoints().iter().copied(), to),
            (Self::Vertices, _) => add(path.vertices(), to),
            (Self::Touched, Rules::CenterGap(_)) => {
                let cells = path.at_corners().touched_cells(PlacementKind::Corner).collect::<Vec<_>>();
                add(cells.into_iter().map(Vertex::from), to);
            }
            (Self::Touched, _) => add(path.touched_cells(rules.placement()).map(Vertex::from), to),
        }
    }

    /// Whether the points of a path are whole: all but those of one that leads through points that are no
    /// vertices.
    pub(crate) fn are_whole(self, path: &Path) -> bool {
        self == Self::Touched || path.waypoints().len() == path.len()
    }

    /// The points of a path as an array of shape (n, 2).
    pub(crate) fn array<'py>(
        self,
        py: Python<'py>,
        path: &Path,
        rules: Rules,
    ) -> PyResult<Bound<'py, PyAny>> {
        if !self.are_whole(path) {
            return rows_array(py, path.points().flat_map(|at| [at.y(), at.x()]).collect(), 2);
        }
        let mut flat = Vec::with_capacity(2 * path.len());
        self.add(path, rules, &mut flat);
        Ok(points_array(py, &flat)?.into_any())
    }
}

fn add(points: impl Iterator<Item = Vertex>, to: &mut Vec<i32>) {
    points.for_each(|at| to.extend([at.y, at.x]));
}

/// A flat list of rows and columns as an array of shape (n, 2).
pub(crate) fn points_array<'py>(py: Python<'py>, flat: &[i32]) -> PyResult<Bound<'py, PyArray2<i32>>> {
    let rows = flat.len() / 2;
    let view = ArrayView2::from_shape((rows, 2), &flat[..2 * rows]);
    Ok(view.map_err(|error| exception("MediantError", &error.to_string(), "other"))?.to_pyarray(py))
}

/// A flat list as an array of rows, which owns it.
pub(crate) fn rows_array<'py, T: numpy::Element>(
    py: Python<'py>,
    flat: Vec<T>,
    columns: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let rows = flat.len() / columns.max(1);
    PyArray1::from_vec(py, flat).call_method1("reshape", ((rows, columns),))
}

/// A picture of bounded size as PNG, for notebooks.
pub(crate) fn png_of<'py>(py: Python<'py>, picture: Picture<'_>) -> PyResult<Bound<'py, PyBytes>> {
    let mut bytes = Vec::new();
    py.detach(|| picture.largest_side(1024).write_png(&mut bytes))?;
    Ok(PyBytes::new(py, &bytes))
}

/// The cells of a map as an array of bool.
pub(crate) fn cells_of<'py>(py: Python<'py>, map: &Map) -> PyResult<Bound<'py, PyAny>> {
    let (rows, columns) = (map.height() as usize, map.width() as usize);
    let bits = PyArray1::from_vec(py, py.detach(|| bits_of(map)));
    let bits = bits.call_method1("reshape", ((rows, columns.div_ceil(8)),))?;
    let options = PyDict::new(py);
    options.set_item("axis", 1)?;
    options.set_item("count", columns)?;
    options.set_item("bitorder", "little")?;
    numpy_function(py, "unpackbits")?.call((bits,), Some(&options))?.call_method1("view", ("bool",))
}
