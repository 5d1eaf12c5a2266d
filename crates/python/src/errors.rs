//! The library's errors as the exceptions of `mediant.errors`.

use mediant::{
    Error, ErrorCode, Point, Vertex,
    call::Spelling,
    errors::{BrokenPath, QueryError},
};
use pyo3::{
    call::PyCallArgs,
    exceptions::{PyException, PyMemoryError, PyTypeError},
    prelude::*,
    types::PyType,
};

/// The class of the exception for a kind of mistake.
const fn class(code: ErrorCode) -> &'static str {
    match code {
        ErrorCode::MapSize
        | ErrorCode::MapRagged
        | ErrorCode::MapTile
        | ErrorCode::EditOutside
        | ErrorCode::Cost => "MapError",
        ErrorCode::K
        | ErrorCode::Motion
        | ErrorCode::UnknownName
        | ErrorCode::SetupText
        | ErrorCode::EngineOption
        | ErrorCode::EngineK
        | ErrorCode::EngineRules
        | ErrorCode::EngineWithout
        | ErrorCode::IndexRange
        | ErrorCode::IndexOptions => "OptionError",
        ErrorCode::Mismatch => "MismatchError",
        ErrorCode::StartBlocked
        | ErrorCode::GoalBlocked
        | ErrorCode::StartOutside
        | ErrorCode::GoalOutside
        | ErrorCode::GaveUp
        | ErrorCode::NoEnd
        | ErrorCode::Between
        | ErrorCode::Number
        | ErrorCode::NotBegun => "QueryError",
        ErrorCode::IndexDamaged | ErrorCode::IndexEngine => "IndexFileError",
        ErrorCode::Argument => "ArgumentError",
        ErrorCode::BrokenPath => "BrokenPathError",
        ErrorCode::FileMissing => "MissingFileError",
        ErrorCode::FileUnreadable
        | ErrorCode::FileUnwritable
        | ErrorCode::MapFormat
        | ErrorCode::ScenarioFormat => "FileError",
        _ => "MediantError",
    }
}

/// The exception for an error of the library.
pub(crate) fn raised(error: impl Into<Error>) -> PyErr {
    let error = match error.into() {
        Error::Query(error) => Error::Query(in_rows(error)),
        error => error,
    };
    let code = error.code();
    if code == ErrorCode::Memory {
        return PyMemoryError::new_err(error.to_string());
    }
    let text = match &error {
        Error::Call(error) => error.text(Spelling::Snake),
        Error::Freed { cell } => format!(
            "cell ({}, {}) is freed, and has no cost: give it one by Grid.edit_costs, which frees it",
            cell.y, cell.x
        ),
        error => error.to_string(),
    };
    exception(class(code), &text, code.name())
}

/// The exception for an argument that has a value which it cannot have.
pub(crate) fn argument(name: &str, wrong: &str) -> PyErr {
    exception("ArgumentError", &format!("{name}: {wrong}"), ErrorCode::Argument.name())
}

/// The exception for an argument of another type.
pub(crate) fn wrong_type(name: &str, expected: &str, found: &Bound<'_, PyAny>) -> PyErr {
    PyTypeError::new_err(format!("{name}: expected {expected}, found {}", class_name(found)))
}

/// The name of a value's class.
pub(crate) fn class_name(value: &Bound<'_, PyAny>) -> String {
    value.get_type().name().map_or_else(|_| "another type".to_owned(), |name| name.to_string())
}

/// The exception that stands for another one, which it names as its cause. An exception that is no mistake of
/// an argument (Ctrl-C, an exit, no memory) stays as it is.
pub(crate) fn instead(py: Python<'_>, cause: PyErr, error: PyErr) -> PyErr {
    if !cause.is_instance_of::<PyException>(py) || cause.is_instance_of::<PyMemoryError>(py) {
        return cause;
    }
    error.set_cause(py, Some(cause));
    error
}

/// The exception for an error of the library about an argument that has another name than its own.
pub(crate) fn raised_for(name: &str, error: impl Into<Error>) -> PyErr {
    let error = error.into();
    let (class, code) = (class(error.code()), error.code().name());
    let text = match error {
        // A field has sources, where the library speaks of starts.
        Error::Query(error) => in_rows(error).to_string().replacen("the start", &format!("the {name}"), 1),
        error => format!("{name}: {error}"),
    };
    exception(class, &text, code)
}

/// The exception for an end whose numbers are larger than those of any map.
pub(crate) fn far_outside(name: &str) -> PyErr {
    let code = match name {
        "start" | "starts" => ErrorCode::StartOutside,
        "goal" | "goals" => ErrorCode::GoalOutside,
        _ => ErrorCode::Argument,
    };
    exception("QueryError", &format!("{name}: a row or column beyond that of any map"), code.name())
}

/// An exception of `mediant.errors`.
pub(crate) fn exception(class: &str, message: &str, code: &str) -> PyErr {
    Python::attach(|py| made(py, class, (message, code)))
}

/// The exception for a path that does not hold.
pub(crate) fn broken(error: BrokenPath) -> PyErr {
    let (message, holds_up_to) = (broken_in_rows(error).to_string(), error.holds_up_to());
    Python::attach(|py| made(py, "BrokenPathError", (message, ErrorCode::BrokenPath.name(), holds_up_to)))
}

/// The exception of this class, or the one that prevents it.
pub(crate) fn made<'py>(py: Python<'py>, class: &str, arguments: impl PyCallArgs<'py>) -> PyErr {
    let make = || -> PyResult<PyErr> {
        let class = py.import("mediant.errors")?.getattr(class)?.cast_into::<PyType>()?;
        Ok(PyErr::from_value(class.call1(arguments)?))
    };
    make().unwrap_or_else(|error| error)
}

/// (row, column) where the library writes (x, y).
const fn swapped(at: Point) -> Point {
    let (x, y) = at.parts();
    Point::from_parts(y, x)
}

/// The error, with its points as (row, column).
const fn in_rows(error: QueryError) -> QueryError {
    match error {
        QueryError::Outside { end, at, last } => {
            QueryError::Outside { end, at: swapped(at), last: Vertex::new(last.y, last.x) }
        }
        QueryError::Blocked { end, at } => QueryError::Blocked { end, at: swapped(at) },
        QueryError::Between { end, at } => QueryError::Between { end, at: swapped(at) },
        QueryError::NothingFree { end, at } => QueryError::NothingFree { end, at: swapped(at) },
        error => error,
    }
}

/// The error, with its points as (row, column).
fn broken_in_rows(error: BrokenPath) -> BrokenPath {
    use mediant::grid::Obstruction;
    match error {
        BrokenPath::Outside { index, at, holds } => BrokenPath::Outside { index, at: swapped(at), holds },
        BrokenPath::Between { index, at, holds } => BrokenPath::Between { index, at: swapped(at), holds },
        BrokenPath::Blocked { end, at, holds } => BrokenPath::Blocked { end, at: swapped(at), holds },
        BrokenPath::Segment { index, from, to, by } => {
            let by = match by {
                Obstruction::End { at } => Obstruction::End { at: swapped(at) },
                Obstruction::Cell { x, y } => Obstruction::Cell { x: y, y: x },
                Obstruction::Between { cells } => Obstruction::Between { cells: cells.map(|(x, y)| (y, x)) },
                by => by,
            };
            BrokenPath::Segment { index, from: swapped(from), to: swapped(to), by }
        }
        BrokenPath::Gap { index, at, before, after } => {
            BrokenPath::Gap { index, at: swapped(at), before: before.map(swapped), after: after.map(swapped) }
        }
        error => error,
    }
}
