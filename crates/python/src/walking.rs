//! Elevations from arrays, and arrays from elevations.

use mediant::{Error, ErrorCode, Pace, Vertex, Walking, WalkingBounds, errors::WalkingError};
use numpy::{PyArrayDescrMethods, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::{
    prelude::*,
    types::{PyFloat, PyString},
};

use crate::{
    arguments::{numpy_function, word},
    arrays::{map_of_bools, rows_array},
    costs::{cells_in_words, watched},
    errors::{argument, exception, instead, raised, wrong_type},
};

/// The pace of an argument: a name, or a table of slopes with their times.
pub(crate) fn pace_of(value: &Bound<'_, PyAny>) -> PyResult<Pace> {
    if value.is_instance_of::<PyString>() {
        return word("pace", value);
    }
    let names = Pace::NAMES.join(", ");
    let expected = format!("one of {names}, or an array of slopes and times with shape (n, 2)");
    let wrong = |cause| instead(value.py(), cause, wrong_type("pace", &expected, value));
    let array = numpy_function(value.py(), "asarray")?.call1((value,)).map_err(wrong)?;
    let array = array.cast_into::<PyUntypedArray>().map_err(|_| wrong_type("pace", &expected, value))?;
    if !matches!(array.dtype().kind(), b'i' | b'u' | b'f') {
        return Err(wrong_type("pace", &expected, value));
    }
    if !matches!(array.shape(), [_, 2]) {
        return Err(argument("pace", &format!("expected {expected}, found shape {:?}", array.shape())));
    }
    let table = array.call_method1("astype", ("float64",))?;
    let table = table.extract::<PyReadonlyArray2<'_, f64>>()?;
    Ok(Pace::Table(table.as_array().rows().into_iter().map(|row| (row[0], row[1])).collect()))
}

/// The name of a pace, or its table.
pub(crate) fn pace_in_python<'py>(py: Python<'py>, pace: &Pace) -> PyResult<Bound<'py, PyAny>> {
    match pace {
        Pace::Table(knots) => {
            rows_array(py, knots.iter().flat_map(|&(slope, time)| [slope, time]).collect(), 2)
        }
        named => Ok(named.name().into_pyobject(py)?.into_any()),
    }
}

/// The map to walk on of elevations and frictions, arrays of float64 of the same shape, which are read with
/// the GIL released. Cells whose elevation is no number are blocked. With bounds it is a copy.
pub(crate) fn walking_of(
    (elevation, friction): (&Bound<'_, PyAny>, Option<&Bound<'_, PyAny>>),
    (height, width): (f64, f64),
    pace: &Pace,
    bounds: Option<WalkingBounds>,
) -> PyResult<Walking> {
    let py = elevation.py();
    let elevations = elevation.extract::<PyReadonlyArray2<'_, f64>>()?;
    let blocked = numpy_function(py, "isnan")?.call1((elevation,))?;
    let map = map_of_bools("elevation", blocked.cast()?)?;
    let frictions = friction.map(|friction| friction.extract::<PyReadonlyArray2<'_, f64>>()).transpose()?;
    let (elevations, frictions) = (elevations.as_array(), frictions.as_ref().map(|of| of.as_array()));
    if frictions.is_some_and(|frictions| frictions.dim() != elevations.dim()) {
        let wrong = format!("expected the shape of the elevations, {:?}", elevations.dim());
        return Err(argument("friction", &wrong));
    }
    let size = (width, height);
    let ground = |x: u32, y: u32| {
        let at = [y as usize, x as usize];
        (elevations[at], frictions.as_ref().map_or(0.0, |frictions| frictions[at]))
    };
    let made = watched(py, |limits| match bounds {
        Some(bounds) => map.walking_in(bounds, size, pace, limits, ground),
        None => map.walking_by(size, pace, limits, ground),
    })?;
    made.map_err(raised_for_walking)
}

/// The exception for elevations that cannot be.
fn raised_for_walking(error: Error) -> PyErr {
    let Error::Walking(error) = error else { return raised(error) };
    let wrong = |text: &str| exception("MapError", text, ErrorCode::Cost.name());
    let blocked = "a cell that is blocked is masked, nan or nodata=";
    match error {
        WalkingError::Elevation { x, y, elevation } => wrong(&format!(
            "elevation: that of cell ({y}, {x}) is {elevation}: it must be a number; {blocked}"
        )),
        WalkingError::Friction { x, y, friction } => wrong(&format!(
            "friction: that of cell ({y}, {x}) is {friction}: it must be a number from 0 on; {blocked}"
        )),
        error @ WalkingError::Table => argument("pace", &error.to_string()),
        error @ WalkingError::Pace { .. } => {
            argument("pace", &format!("with this elevation and cell_size {error}"))
        }
        error @ WalkingError::Range { .. } => {
            wrong(&format!("elevation: with this cell_size, pace and friction {error}"))
        }
        error => raised(Error::from(error)),
    }
}

/// The elevations, or the frictions, as an array; no number where a cell is blocked.
pub(crate) fn array_of<'py>(
    py: Python<'py>,
    walking: &Walking,
    number: impl Fn(Vertex) -> Option<f64> + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let (width, height) = (walking.map().width() as i32, walking.map().height() as i32);
    let flat: Vec<f64> = py.detach(|| {
        let cells = (0..height).flat_map(|y| (0..width).map(move |x| Vertex::new(x, y)));
        cells.map(|at| number(at).unwrap_or(f64::NAN)).collect()
    });
    rows_array(py, flat, width as usize)
}

/// The frictions as an array; `None` where there is none.
pub(crate) fn friction_of<'py>(py: Python<'py>, walking: &Walking) -> PyResult<Option<Bound<'py, PyAny>>> {
    let has_friction = walking.ground_bounds().friction.1 > 0.0;
    has_friction.then(|| array_of(py, walking, |at| walking.friction(at))).transpose()
}

/// The elevations in a few words, with numbers of six digits.
pub(crate) fn in_words(py: Python<'_>, walking: &Walking) -> PyResult<String> {
    let short = |number: f64| PyFloat::new(py, number).call_method1("__format__", (".6g",));
    let (lowest, highest) = walking.ground_bounds().elevation;
    let size = cells_in_words(py, walking.cell_size())?;
    Ok(format!(", elevations {} to {}{size}", short(lowest)?, short(highest)?))
}
