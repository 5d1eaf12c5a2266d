//! Maps from arrays, and arrays from paths.

use mediant::{Map, Path, PlacementKind, Vertex};
use numpy::{
    PyArray1, PyArray2, PyArrayDescrMethods, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods,
    ToPyArray, ndarray::ArrayView2,
};
use pyo3::{exceptions::PyTypeError, prelude::*, types::PyList};

use crate::{
    arguments::{number, numpy_function, word},
    errors::{argument, raised, wrong_type},
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
            "array: expected dtype bool (True is blocked), found {}: say which values are blocked, by above=, below= or values=",
            array.dtype()
        ))),
        _ => Err(PyTypeError::new_err(format!("array: expected numbers or bool, found {}", array.dtype()))),
    }
}

/// The argument as an array of two dimensions.
pub(crate) fn plane<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyUntypedArray>> {
    let py = value.py();
    let masked = py.import("numpy.ma")?.getattr("is_masked")?.call1((value,))?.is_truthy()?;
    if masked {
        return Err(argument(name, "it is masked: fill it first, for instance by array.filled()"));
    }
    let array = numpy_function(py, "asarray")?.call1((value,));
    let array = array.map_err(|_| argument(name, "expected rows of the same length, found no array"))?;
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
        if number(name, limit)?.is_nan() {
            return Err(argument(name, "expected a number, found nan"));
        }
        let limit = numpy_function(py, "float64")?.call1((limit,))?;
        parts.push(array.call_method1(method, (limit,))?);
    }
    if let Some(values) = &criteria.values {
        let items: Vec<Bound<'_, PyAny>> = values
            .try_iter()
            .map_err(|_| wrong_type("values", "several numbers", values))?
            .collect::<PyResult<_>>()?;
        for item in &items {
            has_nan_value |= number("values", item)?.is_nan();
        }
        parts.push(numpy_function(py, "isin")?.call1((array, PyList::new(py, items)?))?);
    }
    if array.dtype().kind() == b'f' {
        let is_nan = numpy_function(py, "isnan")?.call1((array,))?;
        if has_nan_value {
            parts.push(is_nan);
        } else if is_nan.call_method0("any")?.is_truthy()? {
            return Err(argument(
                "array",
                "it has values that are no number (nan): name nan among values to have them blocked, or fill them",
            ));
        }
    }
    let mut parts = parts.into_iter();
    let first = parts.next().ok_or_else(|| argument("values", "expected at least one"))?;
    let all = parts.try_fold(first, |all, part| all.call_method1("__or__", (part,)))?;
    Ok(all.cast_into()?)
}

/// The map of an array of bool. Its bytes are read as numbers: a view of other bytes as bool may have any.
fn map_of_bools(name: &str, array: &Bound<'_, PyUntypedArray>) -> PyResult<Map> {
    let bytes = array.call_method1("view", ("uint8",))?;
    let bytes = bytes.extract::<PyReadonlyArray2<'_, u8>>()?;
    let cells = bytes.as_array();
    let (rows, columns) = cells.dim();
    let size = |side: usize| u32::try_from(side).unwrap_or(u32::MAX);
    let wrong = |error: mediant::Error| {
        let text = format!("{name}: {error}");
        crate::errors::exception("MapError", &text, error.code().name())
    };
    Map::from_fn(size(columns), size(rows), |x, y| cells[(y as usize, x as usize)] != 0).map_err(wrong)
}

/// The bool cells of an array that replace a part of a map, row by row, and its number of rows and columns.
pub(crate) fn patch(name: &str, value: &Bound<'_, PyAny>) -> PyResult<(Vec<bool>, usize, usize)> {
    let array = plane(name, value)?;
    if array.dtype().kind() != b'b' {
        let wrong = format!("{name}: expected dtype bool (True is blocked), found {}", array.dtype());
        return Err(PyTypeError::new_err(wrong));
    }
    let bytes = array.call_method1("view", ("uint8",))?;
    let bytes = bytes.extract::<PyReadonlyArray2<'_, u8>>()?;
    let cells = bytes.as_array();
    let (rows, columns) = cells.dim();
    Ok((cells.iter().map(|&cell| cell != 0).collect(), rows, columns))
}

/// Which points of a path an array has.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum PathPoints {
    Waypoints,
    Vertices,
    Cells,
}

impl PathPoints {
    pub(crate) fn read(value: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let words = [("waypoints", Self::Waypoints), ("vertices", Self::Vertices), ("cells", Self::Cells)];
        value.map_or(Ok(Self::Waypoints), |value| word("points", value, &words))
    }

    /// Adds the points of a path to a flat list of rows and columns.
    pub(crate) fn add(self, path: &Path, placement: PlacementKind, to: &mut Vec<i32>) {
        match self {
            Self::Waypoints => add(path.waypoints().iter().copied(), to),
            Self::Vertices => add(path.vertices(), to),
            Self::Cells => add(path.cells(placement).map(Vertex::from), to),
        }
    }

    /// The points of a path as an array of shape (n, 2).
    pub(crate) fn array<'py>(
        self,
        py: Python<'py>,
        path: &Path,
        placement: PlacementKind,
    ) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let mut flat = Vec::with_capacity(2 * path.waypoints().len());
        self.add(path, placement, &mut flat);
        points_array(py, &flat)
    }
}

fn add(points: impl Iterator<Item = Vertex>, to: &mut Vec<i32>) {
    points.for_each(|at| to.extend([at.y, at.x]));
}

/// A flat list of rows and columns as an array of shape (n, 2).
pub(crate) fn points_array<'py>(py: Python<'py>, flat: &[i32]) -> PyResult<Bound<'py, PyArray2<i32>>> {
    let view = ArrayView2::from_shape((flat.len() / 2, 2), flat);
    Ok(view.map_err(|error| raised_shape(&error))?.to_pyarray(py))
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

fn raised_shape(error: &numpy::ndarray::ShapeError) -> PyErr {
    raised_text(&error.to_string())
}

fn raised_text(text: &str) -> PyErr {
    crate::errors::exception("MediantError", text, "other")
}

/// The cells of a map, row by row.
pub(crate) fn cells_of(map: &Map) -> Vec<bool> {
    let (width, height) = (map.width() as i32, map.height() as i32);
    (0..height).flat_map(|y| (0..width).map(move |x| map.is_blocked(x, y))).collect()
}

/// The map of bits, 8 cells a byte, row after row without padding, as `numpy.packbits` has them.
pub(crate) fn map_of_bits(bits: &[u8], rows: u32, columns: u32) -> PyResult<Map> {
    let cells = u64::from(rows) * u64::from(columns);
    if bits.len() as u64 != cells.div_ceil(8) {
        return Err(argument("bits", &format!("expected {} bytes, found {}", cells.div_ceil(8), bits.len())));
    }
    let bit = |x: u32, y: u32| {
        let index = y as usize * columns as usize + x as usize;
        bits[index / 8] >> (7 - index % 8) & 1 == 1
    };
    Map::from_fn(columns, rows, bit).map_err(raised)
}
