//! x
use pyo3::prelude::*;

/// The engines of the package `mediant`.
#[pymodule(gil_used = false)]
mod _mediant {}
