//! Costs from arrays, and arrays from costs.

use std::convert::identity;

use mediant::{CostUnits, Costs, Error, Limits, Map, errors::CostsError};
use numpy::{
    PyArrayDescrMethods, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods, ndarray::ArrayView2,
};
use pyo3::{exceptions::PyTypeError, prelude::*, types::PyFloat};

use crate::{
    arguments::{is_whole, number, numpy_function},
    arrays::{plane, rows_array},
    background::Interruption,
    errors::{argument, exception, instead, raised, wrong_type},
};

/// The height and the width of a cell: one number for both, or a pair.
pub(crate) fn cell_size(value: Option<&Bound<'_, PyAny>>) -> PyResult<(f64, f64)> {
    let name = "cell_size";
    let Some(value) = value.filter(|value| !value.is_none()) else { return Ok((1.0, 1.0)) };
    let (height, width) = match value.extract::<f64>() {
        Ok(side) => (side, side),
        Err(cause) => {
            let expected = "a number, or (height, width) of a cell";
            let wrong = |cause| instead(value.py(), cause, wrong_type(name, expected, value));
            let Ok(items) = value.try_iter() else { return Err(wrong(cause)) };
            let mut sides = Vec::new();
            for item in items.take(3) {
                sides.push(number(name, &item.map_err(wrong)?)?);
            }
            let &[height, width] = &sides[..] else {
                return Err(argument(name, &format!("expected {expected}, found another number of items")));
            };
            (height, width)
        }
    };
    let is_side = |side: f64| (1e-120..=1e120).contains(&side);
    if is_side(height) && is_side(width) && height.max(width) / height.min(width) <= 65_536.0 {
        return Ok((height, width));
    }
    // In few digits, however large or small they are.
    let wrong = format!(
        "cells of {height:?} × {width:?}: height and width must be positive numbers, from 1e-120 to 1e120, and \
         neither more than 65,536 times the other"
    );
    Err(argument(name, &wrong))
}

/// The costs of the free cells of a map, which are read where they are, with the GIL released.
pub(crate) fn costs_of(value: &Bound<'_, PyAny>, map: &Map, (height, width): (f64, f64)) -> PyResult<Costs> {
    let array = plane("costs", value)?;
    let (rows, columns) = (map.height() as usize, map.width() as usize);
    if array.shape() != [rows, columns] {
        let wrong = format!("expected one for each of {rows} × {columns} cells, found {:?}", array.shape());
        return Err(argument("costs", &wrong));
    }
    let dtype = array.dtype();
    if !matches!(dtype.kind(), b'i' | b'u' | b'f') {
        let hint = if dtype.kind() == b'b' { ": an array of bool says which cells are blocked" } else { "" };
        return Err(PyTypeError::new_err(format!("costs: expected numbers, found {dtype}{hint}")));
    }
    let array = if is_whole(&array)? { array } else { array.call_method0("copy")?.cast_into()? };
    let of = |cost: &(dyn Fn(u32, u32) -> f64 + Sync)| {
        watched(array.py(), |limits| map.costs_by((width, height), limits, cost))?.map_err(raised_for_costs)
    };
    macro_rules! of_types {
        ($number:expr; $($type:ty),*) => {$(
            if let Ok(numbers) = array.extract::<PyReadonlyArray2<'_, $type>>() {
                let numbers: ArrayView2<'_, $type> = numbers.as_array();
                return of(&|x, y| $number(numbers[[y as usize, x as usize]]));
            }
        )*};
    }
    of_types!(identity; f64);
    of_types!(f64::from; f32, u8, u16, i16, i32, u32, i8);
    of_types!(|number| number as f64; i64, u64);
    // Numbers of other machines, and of 16 or 128 bits.
    let wide = array.call_method1("astype", ("float64",))?;
    let numbers = wide.extract::<PyReadonlyArray2<'_, f64>>()?;
    let numbers = numbers.as_array();
    of(&|x, y| numbers[[y as usize, x as usize]])
}

/// Reads numbers with the GIL released; Ctrl-C ends it.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(Limits) -> Result<T, Error> + Send,
) -> PyResult<Result<T, Error>> {
    let interruption = Interruption::default();
    let limits = interruption.watch(Limits::new(), None);
    let made = py.detach(|| work(limits));
    interruption.take().map_or(Ok(made), Err)
}

/// The exception for costs that cannot be.
pub(crate) fn raised_for_costs(error: Error) -> PyErr {
    let wrong = |text: &str| exception("MapError", &format!("costs: {text}"), error.code().name());
    match error {
        Error::Costs(CostsError::Cost { x, y, cost }) => wrong(&format!(
            "the cost of cell ({y}, {x}) is {}: it must be a positive number, from 1e-120 to 1e120; \
             a wall has no cost: it is a blocked cell of Grid(array, costs=…) and Grid.edit_cells, and for \
             Grid.from_costs one that is masked or nodata=",
            if cost.is_nan() { "nan".to_owned() } else { cost.to_string() }
        )),
        Error::Costs(error @ CostsError::Range { .. }) => wrong(&error.to_string()),
        error => raised(error),
    }
}

/// One cost for each of so many cells, or one for all.
pub(crate) fn each(name: &str, value: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<f64>> {
    let py = value.py();
    let expected = "a number, or one for each cell";
    let wrong = |cause| instead(py, cause, wrong_type(name, expected, value));
    let row = numpy_function(py, "atleast_2d")?.call1((value,)).map_err(wrong)?;
    let array = row.cast_into::<PyUntypedArray>().map_err(|_| wrong_type(name, expected, value))?;
    if !matches!(array.dtype().kind(), b'i' | b'u' | b'f') && !array.is_empty() {
        return Err(wrong_type(name, expected, value));
    }
    let numbers = array.call_method1("astype", ("float64",)).map_err(wrong)?;
    let numbers = numbers.extract::<PyReadonlyArray2<'_, f64>>().map_err(wrong)?;
    let numbers: Vec<f64> = numbers.as_array().iter().copied().collect();
    match (array.shape(), &numbers[..]) {
        (&[1, found], _) if found == count => Ok(numbers),
        (&[1, 1], &[only]) => Ok(vec![only; count]),
        _ => Err(argument(name, &format!("expected one value for each of {count} cells, or one for all"))),
    }
}

/// The costs as an array; no number where a cell is blocked.
pub(crate) fn array_of<'py>(py: Python<'py>, costs: &Costs) -> PyResult<Bound<'py, PyAny>> {
    let (width, height) = (costs.map().width() as i32, costs.map().height() as i32);
    let flat: Vec<f64> = py.detach(|| {
        let cells = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        cells.map(|at| costs.cost(at).unwrap_or(f64::NAN)).collect()
    });
    rows_array(py, flat, width as usize)
}

/// The costs as bytes: four a cell, row by row, each a multiple of the unit in which they are kept, the
/// lowest byte first; 0 where a cell is blocked.
pub(crate) fn steps_of(costs: &Costs) -> Vec<u8> {
    let (width, height) = (costs.map().width() as i32, costs.map().height() as i32);
    let step = costs.units().step;
    let cells = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    cells.flat_map(|at| ((costs.cost(at).unwrap_or(0.0) / step) as u32).to_le_bytes()).collect()
}

/// The map and the costs of such bytes.
pub(crate) fn costs_of_steps(
    bytes: &[u8],
    (rows, columns): (u32, u32),
    units: CostUnits,
    limits: &Limits,
) -> Result<Costs, Error> {
    let step = |x: u32, y: u32| {
        let first = 4 * (y as usize * columns as usize + x as usize);
        bytes.get(first..first + 4).and_then(|bytes| bytes.try_into().ok()).map_or(0, u32::from_le_bytes)
    };
    let map = Map::from_fn(columns, rows, |x, y| step(x, y) == 0)?;
    map.costs_in(units, limits, |x, y| f64::from(step(x, y)) * units.step)
}

/// The costs in a few words, with numbers of six digits.
pub(crate) fn in_words(py: Python<'_>, costs: &Costs) -> PyResult<String> {
    let short = |number: f64| PyFloat::new(py, number).call_method1("__format__", (".6g",));
    let ((least, greatest), size) = (costs.bounds(), cells_in_words(py, costs.cell_size())?);
    Ok(format!(", costs {} to {}{size}", short(least)?, short(greatest)?))
}

/// The size of cells in a few words, if it is another one than 1 × 1.
pub(crate) fn cells_in_words(py: Python<'_>, (width, height): (f64, f64)) -> PyResult<String> {
    let short = |number: f64| PyFloat::new(py, number).call_method1("__format__", (".6g",));
    Ok(match (width, height) {
        (1.0, 1.0) => String::new(),
        _ => format!(", cells of {} × {}", short(height)?, short(width)?),
    })
}
