//! The keywords of calls, as the library's parameters.

use std::time::Instant;

use mediant::{
    Guarantee, Limits, Motion, Query,
    call::{Call, CallError, Group, Kind, Parameter, Spelling, Value},
    errors::{NO_COSTS, absent},
    moves::Neighborhood,
};
use numpy::PyArray2;
use pyo3::{
    exceptions::{PyOverflowError, PyTypeError},
    prelude::*,
    types::{PyBool, PyDict, PyFloat, PyString},
};

use crate::{
    arguments::Points,
    arrays::points_array,
    background::Interruption,
    errors::{argument, class_name, instead, raised},
};

/// The groups of keywords that a call takes.
pub(crate) type Takes = &'static [Group];

pub(crate) const ALL: Takes = &Group::ALL;
pub(crate) const MOTION: Takes = &[Group::Motion];
pub(crate) const WISHES: Takes = &[Group::Wishes];
pub(crate) const OPTIONS: Takes = &[Group::Options];
pub(crate) const PREPARATION: Takes = &[Group::Motion, Group::Options];

/// The keywords of a function, for an error: first those that it has beside the parameters.
fn known(function: &str, takes: Takes) -> String {
    let own: &[&str] = match function {
        "path" => &["points"],
        "find" => &["points", "counters"],
        "find_except" => &["blocked", "free", "free_ends", "points", "counters"],
        "search" => &["points", "trace"],
        "disc" => &["meters"],
        "prepare" => &["threads", "progress"],
        "paths" => &["points", "threads", "progress", "invalid"],
        "distances" if takes == WISHES => &["threads", "progress", "invalid"],
        "field" | "distances" => &["limit", "heading", "progress"],
        "flow" => &["limit", "heading"],
        "reach" => &["heading"],
        "for_disc" => &["meters", "fit", "outside"],
        "widest_path" => &["surplus", "points"],
        _ => &[],
    };
    let own = own.iter().map(|&name| name.to_owned());
    own.chain(Parameter::names(takes, Spelling::Snake)).collect::<Vec<_>>().join(", ")
}

/// The parameters of a call, and when it began.
#[derive(Clone, Debug)]
pub(crate) struct Keywords {
    pub(crate) call: Call,
    begin: Instant,
}

impl Default for Keywords {
    fn default() -> Self {
        Self { call: Call::default(), begin: Instant::now() }
    }
}

impl Keywords {
    /// Reads the keywords of a call; `function` is its name, for errors.
    pub(crate) fn read(function: &str, given: Option<&Bound<'_, PyDict>>, takes: Takes) -> PyResult<Self> {
        let mut keywords = Self::default();
        for (name, value) in given.into_iter().flat_map(|given| given.iter()) {
            let unknown = |name: &str| unknown_keyword(function, name, &known(function, takes));
            let wrong = |cause| instead(value.py(), cause, unknown(&name.to_string()));
            let name = name.extract::<String>().map_err(wrong)?;
            let parameter = Parameter::find(&name, Spelling::Snake, takes).ok_or_else(|| unknown(&name))?;
            keywords.set(parameter, &value)?;
        }
        Ok(keywords)
    }

    /// Reads a parameter that a function has as an argument of its own.
    pub(crate) fn with(mut self, name: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        if let (Some(parameter), Some(value)) = (Parameter::find(name, Spelling::Snake, ALL), value) {
            self.set(parameter, value)?;
        }
        Ok(self)
    }

    fn set(&mut self, parameter: &'static Parameter, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let (given, cause) = value_of(parameter.kind, value);
        self.call.set(parameter, given).map_err(|error| {
            let error = call_error(error);
            match cause {
                Some(cause) => instead(value.py(), cause, error),
                None => error,
            }
        })
    }

    /// The motion that the keywords give.
    pub(crate) fn motion(&self) -> PyResult<Motion> {
        self.call.motion().map_err(call_error)
    }

    /// The query for a path between points. With an interruption it is watched.
    pub(crate) fn query(&self, start: &Points, goal: &Points, watch: Option<&Interruption>) -> Query {
        let limits = self.call.wishes().limits();
        let limits = match watch {
            Some(interruption) => interruption.watch(limits, self.timeout()),
            None => limits,
        };
        self.call.wishes().query(start.as_slice(), goal.as_slice(), limits)
    }

    /// The query for a path between points, whose time limit runs from the call on, whatever comes between.
    pub(crate) fn timed_request(&self, start: &Points, goal: &Points) -> Query {
        let limits = self.call.wishes().limits();
        let limits = match self.timeout() {
            Some((begin, most)) => limits.deadline(move || begin.elapsed().as_secs_f64() >= most),
            None => limits,
        };
        self.call.wishes().query(start.as_slice(), goal.as_slice(), limits)
    }

    /// When the call began, and the most seconds that it may take.
    pub(crate) fn timeout(&self) -> Option<(Instant, f64)> {
        self.call.wishes().timeout.map(|seconds| (self.begin, seconds))
    }

    /// The limits of what comes before a search: the time limit, which is that of the whole call.
    pub(crate) fn preparation(&self) -> Limits {
        match self.timeout() {
            Some((begin, most)) => Limits::new().deadline(move || begin.elapsed().as_secs_f64() >= most),
            None => Limits::new(),
        }
    }
}

/// A value of Python as the library's, for a parameter that takes this; and the exception that it raised when
/// it was asked for its value.
fn value_of(kind: Kind, value: &Bound<'_, PyAny>) -> (Value<'static>, Option<PyErr>) {
    let other = || Value::Other(class_name(value));
    if value.is_none() {
        return (Value::Absent, None);
    }
    if value.is_instance_of::<PyBool>() && kind != Kind::Flag {
        return (other(), None);
    }
    if value.is_instance_of::<PyString>() {
        return match value.extract::<String>() {
            Ok(text) => (Value::Text(text.into()), None),
            Err(cause) => (other(), Some(cause)),
        };
    }
    let read = match kind {
        Kind::Flag => value.extract::<bool>().map(Value::Flag),
        Kind::Length => value.extract::<f64>().map(Value::Number),
        Kind::Name => return (other(), None),
        // Python tells integers from numbers; infinity alone stands for one.
        _ => match value.cast::<PyFloat>() {
            Ok(number) if number.value() == f64::INFINITY => Ok(Value::Number(f64::INFINITY)),
            Ok(_) => return (other(), None),
            Err(_) => value.extract::<i64>().map(Value::Integer),
        },
    };
    match read {
        Ok(value) => (value, None),
        Err(cause) if cause.is_instance_of::<PyOverflowError>(value.py()) => {
            let is_negative = value.lt(0).unwrap_or(false);
            (Value::Integer(if is_negative { i64::MIN } else { i64::MAX }), None)
        }
        Err(cause) => (other(), Some(cause)),
    }
}

/// The exception for an error of the library about the parameters of a call.
pub(crate) fn call_error(error: CallError) -> PyErr {
    match error {
        CallError::Type { .. } => PyTypeError::new_err(error.text(Spelling::Snake)),
        error => raised(error),
    }
}

/// The answer to costs of cells that a query is given.
const COSTS: &str = "costs of cells are those of a grid: Grid(array, costs=…) or Grid.from_costs";

/// The exception for a keyword that a function does not have; `known` are those that it has.
pub(crate) fn unknown_keyword(function: &str, name: &str, known: &str) -> PyErr {
    let why = absent(name).map(|why| if why == NO_COSTS { COSTS } else { why });
    let why = why.map_or(String::new(), |why| format!(" ({why})"));
    PyTypeError::new_err(format!(
        "{function}() got an unexpected keyword argument '{name}'{why}; the keywords are {known}"
    ))
}

/// The moves of N(k), as (row, column) differences in angular order.
///
/// Parameters
/// ----------
/// k : int
///     The neighborhood has 2**k moves. From 2 to 12.
///
/// Returns
/// -------
/// numpy.ndarray
///     Shape (2**k, 2), int32.
///
/// Raises
/// ------
/// OptionError
///     For a k below 2 or above 12.
///
/// Examples
/// --------
/// >>> import mediant
/// >>> mediant.moves(2).tolist()
/// [[1, 0], [0, 1], [-1, 0], [0, -1]]
/// >>> len(mediant.moves(mediant.N16))
/// 16
#[pyfunction]
pub(crate) fn moves<'py>(k: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<i32>>> {
    let finite =
        Keywords::default().with("k", Some(k))?.motion()?.k.finite().filter(|k| k.get() <= Motion::MAX_K);
    let finite = finite.ok_or_else(|| argument("k", "expected an integer from 2 to 12"))?;
    let neighborhood = Neighborhood::new(finite).map_err(raised)?;
    let flat: Vec<i32> = (0..neighborhood.len())
        .filter_map(|index| neighborhood.get(index))
        .flat_map(|step| [step.y, step.x])
        .collect();
    points_array(k.py(), &flat)
}

/// An upper bound on the length of a shortest path over N(k), as a multiple of the shortest at any angle.
///
/// Parameters
/// ----------
/// k : int or "any"
///     The neighborhood.
/// **motion
///     ``placement``, ``corners`` and ``gap``, as in `Grid.find`.
///
/// Returns
/// -------
/// float or None
///     The bound as a factor: 1.0824 is 8.24 %. None where none is proven.
///
/// Raises
/// ------
/// OptionError
///     For a k below 2.
///
/// Examples
/// --------
/// >>> import mediant
/// >>> [round(mediant.bound(k, placement="corner"), 4) for k in (2, 3, 4)]
/// [1.4142, 1.0824, 1.0275]
#[pyfunction]
#[pyo3(
        signature = (k, **motion),
        text_signature = "(k, *, neighbors=None, placement=None, corners=None, gap=None)"
    )]
pub(crate) fn bound(k: &Bound<'_, PyAny>, motion: Option<&Bound<'_, PyDict>>) -> PyResult<Option<f64>> {
    let Motion { k, rules, .. } = Keywords::read("bound", motion, MOTION)?.with("k", Some(k))?.motion()?;
    let guarantee = k.finite().map_or(Guarantee::OptimalAnyAngle, Guarantee::Optimal);
    Ok(guarantee.bound(rules))
}
