//! Points and numbers, as a call was given them. Each mistake names its argument.

use std::{path::PathBuf, str::FromStr};

use mediant::{Point, Vertex, errors::UnknownName};
use numpy::{PyArrayDescrMethods, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::{
    exceptions::{PyOverflowError, PyTypeError},
    prelude::*,
    types::{PyBool, PyBytes, PyFloat, PyInt, PyMemoryView, PyString, PyTuple},
};

use crate::errors::{argument, far_outside, instead, raised_for, wrong_type};

/// The form of a point, for errors.
const POINT: &str = "a point (row, column) of two numbers";
/// The form of one or several points, for errors.
const POINTS: &str = "a point (row, column), or an array of points with shape (n, 2)";
/// The form of vertices, for errors.
const WHOLE: &str = "whole numbers: points between vertices are for paths at any angle";

/// One point, or several.
pub(crate) enum Points {
    One(Point),
    Several(Vec<Point>),
}

impl Points {
    /// The points of an argument.
    pub(crate) fn read(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Some(at) = pair(name, value)? {
            return Ok(Self::One(at));
        }
        let array = as_array(name, value)?;
        match array.shape() {
            [2] => Ok(Self::One(rows_of(name, &reshaped(&array)?)?[0])),
            [_, 2] => Ok(Self::Several(rows_of(name, &array)?)),
            [0] => Ok(Self::Several(Vec::new())),
            shape => Err(argument(name, &format!("expected {POINTS}, found an array of shape {shape:?}"))),
        }
    }

    pub(crate) fn as_slice(&self) -> &[Point] {
        match self {
            Self::One(at) => std::slice::from_ref(at),
            Self::Several(all) => all,
        }
    }

    pub(crate) fn into_vec(self) -> Vec<Point> {
        match self {
            Self::One(at) => vec![at],
            Self::Several(all) => all,
        }
    }

    /// The points, where they are vertices.
    pub(crate) fn into_vertices(self, name: &str) -> PyResult<Vec<Vertex>> {
        self.into_vec().into_iter().map(|at| whole(name, at)).collect()
    }
}

/// The point as a vertex.
fn whole(name: &str, at: Point) -> PyResult<Vertex> {
    let wrong = || argument(name, &format!("expected {WHOLE}; found ({}, {})", at.y(), at.x()));
    at.vertex().ok_or_else(wrong)
}

/// The one vertex of an argument.
pub(crate) fn vertex(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vertex> {
    whole(name, point(name, value)?)
}

/// The one point of an argument.
pub(crate) fn point(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Point> {
    if let Some(at) = pair(name, value)? {
        return Ok(at);
    }
    let array = as_array(name, value)?;
    match array.shape() {
        [2] => Ok(rows_of(name, &reshaped(&array)?)?[0]),
        shape => Err(argument(name, &format!("expected {POINT}, found an array of shape {shape:?}"))),
    }
}

/// The points of an argument with shape (n, 2), as a path is.
pub(crate) fn path_points(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<Point>> {
    let array = as_array(name, value)?;
    match array.shape() {
        [_, 2] => rows_of(name, &array),
        shape => {
            let wrong = format!("expected an array of points with shape (n, 2), found shape {shape:?}");
            Err(argument(name, &wrong))
        }
    }
}

/// The point of a tuple of two numbers, by far the most frequent form; `None` for any other form.
fn pair(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Option<Point>> {
    let Ok(tuple) = value.cast::<PyTuple>() else { return Ok(None) };
    if tuple.len() != 2 {
        return Ok(None);
    }
    let (row, column) = (tuple.get_borrowed_item(0)?, tuple.get_borrowed_item(1)?);
    if row.is_exact_instance_of::<PyInt>() && column.is_exact_instance_of::<PyInt>() {
        let far = |_| far_outside(name);
        let (row, column) = (row.extract::<i32>().map_err(far)?, column.extract::<i32>().map_err(far)?);
        return Ok(Some(Vertex::new(column, row).into()));
    }
    let is_number = |item: &Bound<'_, PyAny>| {
        item.is_exact_instance_of::<PyFloat>() || item.is_exact_instance_of::<PyInt>()
    };
    if !(is_number(&row) && is_number(&column)) {
        return Ok(None);
    }
    let far = |_| far_outside(name);
    nearest(name, row.extract().map_err(far)?, column.extract().map_err(far)?).map(Some)
}

/// The point at a row and a column.
fn nearest(name: &str, row: f64, column: f64) -> PyResult<Point> {
    if row.is_nan() || column.is_nan() {
        return Err(argument(name, "a row or column is no number"));
    }
    Point::nearest(column, row).ok_or_else(|| far_outside(name))
}

/// The argument as an array of numbers.
fn as_array<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyUntypedArray>> {
    if value.is_none() || value.is_instance_of::<PyString>() {
        return Err(wrong_type(name, POINTS, value));
    }
    let wrong =
        |cause| instead(value.py(), cause, argument(name, &format!("expected {POINTS}, found no array")));
    let array = numpy_function(value.py(), "asarray")?.call1((value,)).map_err(wrong)?;
    let array = array.cast_into::<PyUntypedArray>().map_err(|_| wrong_type(name, POINTS, value))?;
    let is_number = matches!(array.dtype().kind(), b'i' | b'u' | b'f');
    if !is_number && !array.is_empty() {
        // Python's own numbers that are too large for NumPy's become objects.
        if array.dtype().kind() == b'O' && is_all_integers(&array)? {
            return Err(far_outside(name));
        }
        let dtype = array.dtype().to_string();
        return Err(PyTypeError::new_err(format!("{name}: expected {POINTS}, found numbers of {dtype}")));
    }
    if is_whole(&array)? {
        return Ok(array);
    }
    // The items of a packed record: only a copy can be read as numbers.
    Ok(numpy_function(value.py(), "array")?.call1((array,))?.cast_into()?)
}

/// Whether the numbers of an array lie where numbers of their size may, and whole numbers apart.
pub(crate) fn is_whole(array: &Bound<'_, PyUntypedArray>) -> PyResult<bool> {
    let size = array.dtype().itemsize().max(1) as isize;
    let is_apart = array.strides().iter().all(|stride| stride % size == 0);
    Ok(is_apart && array.getattr("flags")?.getattr("aligned")?.is_truthy()?)
}

/// Whether all objects of an array are Python's integers.
fn is_all_integers(array: &Bound<'_, PyUntypedArray>) -> PyResult<bool> {
    for item in array.getattr("flat")?.try_iter()? {
        if !item?.is_instance_of::<PyInt>() {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The array of one point as one of several.
fn reshaped<'py>(array: &Bound<'py, PyUntypedArray>) -> PyResult<Bound<'py, PyUntypedArray>> {
    Ok(array.call_method1("reshape", ((1, 2),))?.cast_into()?)
}

/// The points of an array of shape (n, 2). Integers of 32 and 64 bits are read where they are.
fn rows_of(name: &str, array: &Bound<'_, PyUntypedArray>) -> PyResult<Vec<Point>> {
    if array.is_empty() {
        return Ok(Vec::new());
    }
    if let Ok(array) = array.extract::<PyReadonlyArray2<'_, i32>>() {
        return Ok(array.as_array().rows().into_iter().map(|at| Vertex::new(at[1], at[0]).into()).collect());
    }
    if array.dtype().kind() == b'f' {
        let doubles = array.call_method1("astype", ("float64",))?;
        let doubles = doubles.extract::<PyReadonlyArray2<'_, f64>>()?;
        return doubles.as_array().rows().into_iter().map(|at| nearest(name, at[0], at[1])).collect();
    }
    let wide;
    let array = match array.extract::<PyReadonlyArray2<'_, i64>>() {
        Ok(array) => array,
        Err(_) => {
            // Unsigned 64 bits may not fit; all other integers do.
            if array.dtype().kind() == b'u' && array.call_method0("max")?.extract::<i64>().is_err() {
                return Err(far_outside(name));
            }
            wide = array.call_method1("astype", ("int64",))?;
            wide.extract::<PyReadonlyArray2<'_, i64>>()?
        }
    };
    let narrow = |number: i64| i32::try_from(number).map_err(|_| far_outside(name));
    let rows = array.as_array();
    rows.rows().into_iter().map(|at| Ok(Vertex::new(narrow(at[1])?, narrow(at[0])?).into())).collect()
}

/// A function of NumPy.
pub(crate) fn numpy_function<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("numpy")?.getattr(name)
}

/// A number.
pub(crate) fn number(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let py = value.py();
    value.extract().map_err(|cause: PyErr| {
        let is_large = cause.is_instance_of::<PyOverflowError>(py);
        let error = if is_large { argument(name, TOO_LARGE) } else { wrong_type(name, "a number", value) };
        instead(py, cause, error)
    })
}

/// The error of a number that has no room.
const TOO_LARGE: &str = "the number is too large";

/// A number that is not negative, nor none.
pub(crate) fn positive(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let found = number(name, value)?;
    if found >= 0.0 {
        return Ok(found);
    }
    Err(argument(name, &format!("expected a number of 0 or more, found {found}")))
}

/// A whole number of at least `least`.
pub(crate) fn integer(name: &str, value: &Bound<'_, PyAny>, least: u64) -> PyResult<u64> {
    let py = value.py();
    if value.is_instance_of::<PyBool>() {
        return Err(wrong_type(name, "an integer", value));
    }
    let expected = format!("expected an integer of {least} or more");
    match value.extract::<i64>() {
        Ok(found) => {
            let fits = u64::try_from(found).ok().filter(|&found| found >= least);
            fits.ok_or_else(|| argument(name, &format!("{expected}, found {found}")))
        }
        Err(cause) if cause.is_instance_of::<PyOverflowError>(py) => {
            Err(argument(name, &format!("{expected}, and below 2^63")))
        }
        Err(cause) => Err(instead(py, cause, wrong_type(name, "an integer", value))),
    }
}

/// True or false.
pub(crate) fn flag(name: &str, value: &Bound<'_, PyAny>) -> PyResult<bool> {
    let wrong = |cause: PyErr| instead(value.py(), cause, wrong_type(name, "True or False", value));
    value.extract().map_err(wrong)
}

/// A text.
pub(crate) fn text(name: &str, expected: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
    let wrong = |cause: PyErr| instead(value.py(), cause, wrong_type(name, expected, value));
    value.extract().map_err(wrong)
}

/// The path of a file.
pub(crate) fn file(name: &str, value: &Bound<'_, PyAny>) -> PyResult<PathBuf> {
    let wrong = |cause: PyErr| instead(value.py(), cause, wrong_type(name, "the path of a file", value));
    value.extract().map_err(wrong)
}

/// Bytes, or what has a buffer of bytes.
pub(crate) fn bytes(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<u8>> {
    let wrong = |cause: PyErr| instead(value.py(), cause, wrong_type(name, "bytes", value));
    let view = PyMemoryView::from(value).map_err(wrong)?;
    let bytes = view.call_method0("tobytes").map_err(wrong)?;
    Ok(bytes.cast::<PyBytes>()?.as_bytes().to_vec())
}

/// One of the names of an enum.
pub(crate) fn word<T: FromStr<Err = UnknownName>>(name: &str, value: &Bound<'_, PyAny>) -> PyResult<T> {
    let known = || "".parse::<T>().err().map_or(String::new(), |error| error.known);
    text(name, &format!("one of {}", known()), value)?.parse().map_err(|error| raised_for(name, error))
}
