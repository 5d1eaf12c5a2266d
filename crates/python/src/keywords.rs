//! The keywords of calls: motion, wishes, the engine and its options.

use std::time::Instant;

use mediant::{
    ConfiguredEngine, CornerRule, DiagonalGap, Engine, EngineName, EngineOption, FiniteK, Guarantee, K,
    Limits, Motion, OptionValue, PlacementKind, Query, Request, Rules, Smoothing, ValueKind, errors::absent,
};
use mediant_moves::Neighborhood;
use numpy::PyArray2;
use pyo3::{
    exceptions::PyTypeError,
    prelude::*,
    types::{PyBool, PyDict, PyFloat, PyString},
};

use crate::{
    arguments::{Points, flag, integer, positive, text, word},
    arrays::points_array,
    background::Interruption,
    errors::{argument, instead, raised, raised_for, wrong_type},
};

const PLACEMENTS: [(&str, PlacementKind); 2] =
    [("center", PlacementKind::Center), ("corner", PlacementKind::Corner)];
const CORNERS: [(&str, CornerRule); 3] =
    [("never", CornerRule::Never), ("one", CornerRule::One), ("always", CornerRule::Always)];
const GAPS: [(&str, DiagonalGap); 2] = [("open", DiagonalGap::Open), ("closed", DiagonalGap::Closed)];

const MOTION_KEYWORDS: [&str; 5] = ["k", "neighbors", "placement", "corners", "gap"];
const WISH_KEYWORDS: [&str; 6] = ["nearest", "tolerance", "snap", "max_cost", "max_expansions", "timeout"];

/// Which keywords a call takes.
#[derive(Clone, Copy)]
pub(crate) struct Takes {
    motion: bool,
    wishes: bool,
    engine: bool,
    options: bool,
}

impl Takes {
    pub(crate) const NONE: Self = Self { motion: false, wishes: false, engine: false, options: false };
    pub(crate) const MOTION: Self = Self { motion: true, ..Self::NONE };
    pub(crate) const WISHES: Self = Self { wishes: true, ..Self::NONE };
    pub(crate) const OPTIONS: Self = Self { options: true, ..Self::NONE };
    pub(crate) const PREPARATION: Self = Self { motion: true, ..Self::OPTIONS };
    pub(crate) const ALL: Self = Self { motion: true, wishes: true, engine: true, options: true };

    /// The keywords of a function, for an error: first those that it has beside these.
    fn known(self, function: &str) -> String {
        let own: &[&str] = match function {
            "path" => &["points"],
            "find" => &["points", "counters"],
            "prepare" => &["threads", "progress"],
            "paths" => &["points", "threads", "progress", "invalid"],
            "distances" if self.wishes => &["threads", "progress", "invalid"],
            "field" | "distances" | "flow" => &["limit"],
            "for_disc" => &["meters", "fit", "outside"],
            "widest_path" => &["surplus", "points"],
            _ => &[],
        };
        let mut known: Vec<String> = own.iter().map(|&name| name.to_owned()).collect();
        let parts: [(bool, &[&str]); 3] =
            [(self.motion, &MOTION_KEYWORDS), (self.wishes, &WISH_KEYWORDS), (self.engine, &["engine"])];
        for (_, names) in parts.into_iter().filter(|(takes, _)| *takes) {
            known.extend(names.iter().map(|&name| name.to_owned()));
        }
        if self.options {
            known.extend(EngineOption::ALL.map(keyword));
            known.push("smooth".to_owned());
        }
        known.join(", ")
    }
}

/// The keyword of an engine's option.
fn keyword(option: &EngineOption) -> String {
    option.name.replace('-', "_")
}

/// What the keywords of a call say.
#[derive(Clone, Debug, Default)]
pub(crate) struct Keywords {
    k: Option<K>,
    neighbors: Option<K>,
    placement: Option<PlacementKind>,
    corners: Option<CornerRule>,
    gap: Option<DiagonalGap>,
    pub(crate) engine: Option<Engine>,
    options: Vec<(&'static EngineOption, OptionValue)>,
    pub(crate) smoothing: Option<Smoothing>,
    nearest: bool,
    tolerance: Option<f64>,
    snap: bool,
    max_cost: Option<f64>,
    max_expansions: Option<u64>,
    /// When the call began, and the most seconds that it may take.
    timeout: Option<(Instant, f64)>,
}

impl Keywords {
    /// Reads the keywords of a call; `function` is its name, for errors.
    pub(crate) fn read(function: &str, given: Option<&Bound<'_, PyDict>>, takes: Takes) -> PyResult<Self> {
        let mut keywords = Self::default();
        for (name, value) in given.into_iter().flat_map(|given| given.iter()) {
            let unknown = |name: &str| unknown_keyword(function, name, &takes.known(function));
            let wrong = |cause| instead(value.py(), cause, unknown(&name.to_string()));
            let name = name.extract::<String>().map_err(wrong)?;
            let is_known = takes.motion && keywords.read_motion(&name, &value)?
                || takes.wishes && keywords.read_wish(&name, &value)?
                || takes.engine && keywords.read_engine(&name, &value)?
                || takes.options && keywords.read_option(&name, &value)?;
            if !is_known {
                return Err(unknown(&name));
            }
        }
        Ok(keywords)
    }

    fn read_motion(&mut self, name: &str, value: &Bound<'_, PyAny>) -> PyResult<bool> {
        let is_left_out = value.is_none();
        match name {
            "k" => self.k = Some(read_k(value)?),
            "neighbors" if is_left_out => {}
            "neighbors" => self.neighbors = Some(read_neighbors(value)?),
            "placement" | "corners" | "gap" if is_left_out => {}
            "placement" => self.placement = Some(placement(value)?),
            "corners" => self.corners = Some(word(name, value, &CORNERS)?),
            "gap" => self.gap = Some(word(name, value, &GAPS)?),
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn read_wish(&mut self, name: &str, value: &Bound<'_, PyAny>) -> PyResult<bool> {
        let is_left_out = value.is_none();
        match name {
            "nearest" => self.nearest = flag(name, value)?,
            "snap" => self.snap = flag(name, value)?,
            "tolerance" => {
                self.tolerance = Some(positive(name, value)?).filter(|&tolerance| tolerance > 0.0);
            }
            "max_cost" | "max_expansions" | "timeout" if is_left_out => {}
            "max_cost" => self.max_cost = Some(positive(name, value)?),
            "max_expansions" => self.max_expansions = Some(integer(name, value, 0)?),
            "timeout" => self.timeout = Some((Instant::now(), positive(name, value)?)),
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn read_engine(&mut self, name: &str, value: &Bound<'_, PyAny>) -> PyResult<bool> {
        if name != "engine" {
            return Ok(false);
        }
        self.engine = read_engine(Some(value))?;
        Ok(true)
    }

    fn read_option(&mut self, name: &str, value: &Bound<'_, PyAny>) -> PyResult<bool> {
        if name == "smooth" {
            let words = [("linear", Smoothing::Linear), ("taut", Smoothing::Taut)];
            self.smoothing = if value.is_none() { None } else { Some(word(name, value, &words)?) };
            return Ok(true);
        }
        let Some(option) = EngineOption::ALL.into_iter().find(|option| keyword(option) == name) else {
            return Ok(false);
        };
        if value.is_none() {
            return Ok(true);
        }
        let given = match option.kind {
            ValueKind::Flag if flag(name, value)? => String::new(),
            ValueKind::Flag => return Ok(true),
            _ if value.is_instance_of::<PyBool>() => {
                return Err(wrong_type(name, "a number or a name", value));
            }
            ValueKind::Number => integer(name, value, 1)?.to_string(),
            _ if value.is_instance_of::<PyString>() => text(name, "a name", value)?,
            ValueKind::Levels | ValueKind::Memory => integer(name, value, 1)?.to_string(),
            ValueKind::Heuristic | ValueKind::Variant => return Err(wrong_type(name, "a name", value)),
        };
        let value = option.parse(&given).map_err(|wrong| argument(name, &wrong))?;
        self.options.push((option, value));
        Ok(true)
    }

    /// How the agent moves. What was left out, the engine decides, if it takes only that.
    pub(crate) fn motion(&self) -> PyResult<Motion> {
        let capabilities = self.engine.unwrap_or_default().capabilities();
        let k = match (self.k, self.neighbors) {
            (Some(_), Some(_)) => {
                return Err(argument("neighbors", "it names the neighborhood, as k does: give one"));
            }
            (k, neighbors) => k.or(neighbors).unwrap_or(capabilities.default_k),
        };
        let rules = match (self.placement, self.corners, self.gap) {
            (_, Some(_), Some(_)) | (Some(PlacementKind::Center), None, Some(_)) => {
                return Err(argument("gap", "it is for placement='corner'; at centers there is corners="));
            }
            (Some(PlacementKind::Corner), Some(_), None) => {
                return Err(argument("corners", "it is for placement='center'; at corners there is gap="));
            }
            (_, Some(corners), None) => Rules::Center(corners),
            (_, None, Some(gap)) => Rules::Corner(gap),
            (Some(PlacementKind::Center), ..) => Rules::Center(CornerRule::default()),
            (Some(PlacementKind::Corner), ..) => Rules::Corner(DiagonalGap::default()),
            (None, None, None) => capabilities.default_rules(k),
        };
        Ok(Motion::new(k, rules))
    }

    /// An engine with the options that were given.
    pub(crate) fn configured(&self, engine: Engine) -> PyResult<ConfiguredEngine> {
        let mut configured = ConfiguredEngine::from(engine);
        for &(option, value) in &self.options {
            configured.set(option, value).map_err(raised)?;
        }
        Ok(configured)
    }

    /// Whether options were given.
    pub(crate) fn has_options(&self) -> bool {
        !self.options.is_empty() || self.smoothing.is_some()
    }

    /// Whether no more is asked than a path from one vertex to another.
    pub(crate) fn has_no_wishes(&self) -> bool {
        let Self { nearest, snap, tolerance, .. } = self;
        !nearest && !snap && tolerance.is_none() && !self.has_limits()
    }

    fn has_limits(&self) -> bool {
        self.max_cost.is_some() || self.max_expansions.is_some() || self.timeout.is_some()
    }

    /// The request for a path between points. With an interruption it is watched.
    pub(crate) fn request(&self, start: &Points, goal: &Points, watch: Option<&Interruption>) -> Request {
        if let (Points::One(start), Points::One(goal), None, true) =
            (start, goal, watch, self.has_no_wishes())
        {
            return Query::new(*start, *goal).into();
        }
        let between = Request::between(start.as_slice().iter().copied(), goal.as_slice().iter().copied());
        let mut limits = self.limits();
        if let Some(interruption) = watch {
            limits = interruption.watch(limits, self.timeout);
        }
        self.wish(between, limits)
    }

    /// The limits on cost and expansions.
    pub(crate) fn limits(&self) -> Limits {
        let limits = self.max_cost.map_or(Limits::new(), |cost| Limits::new().cost(cost));
        self.max_expansions.map_or(limits.clone(), |most| limits.expansions(most))
    }

    /// The time limit, in seconds.
    pub(crate) fn timeout(&self) -> Option<f64> {
        self.timeout.map(|(_, seconds)| seconds)
    }

    /// The limits of what comes before a search: the time limit, which is that of the whole call.
    pub(crate) fn preparation(&self) -> Limits {
        match self.timeout {
            Some((begin, most)) => Limits::new().deadline(move || begin.elapsed().as_secs_f64() >= most),
            None => Limits::new(),
        }
    }

    /// The request with all wishes.
    pub(crate) fn wish(&self, request: Request, limits: Limits) -> Request {
        let request = request.within(limits).tolerance(self.tolerance.unwrap_or(0.0));
        let request = if self.nearest { request.nearest() } else { request };
        if self.snap { request.snap() } else { request }
    }
}

/// The exception for a keyword that a function does not have; `known` are those that it has.
pub(crate) fn unknown_keyword(function: &str, name: &str, known: &str) -> PyErr {
    let why = absent(name).map_or(String::new(), |why| format!(" ({why})"));
    PyTypeError::new_err(format!(
        "{function}() got an unexpected keyword argument '{name}'{why}; the keywords are {known}"
    ))
}

/// An engine's name; `None` for `None` and `"auto"`.
pub(crate) fn read_engine(value: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Engine>> {
    let Some(value) = value.filter(|value| !value.is_none()) else { return Ok(None) };
    let name = text("engine", "the name of an engine", value)?;
    let name = name.parse().map_err(|error: mediant::UnknownName| raised_for("engine", error))?;
    Ok(EngineName::engine(name))
}

/// Where the vertices are.
pub(crate) fn placement(value: &Bound<'_, PyAny>) -> PyResult<PlacementKind> {
    word("placement", value, &PLACEMENTS)
}

/// k: a number, or `"any"` (or another name of infinity), or infinity.
fn read_k(value: &Bound<'_, PyAny>) -> PyResult<K> {
    let named = value.extract::<String>().ok().and_then(|text| text.parse().ok());
    if named == Some(K::ANY) {
        return Ok(K::ANY);
    }
    if value.cast::<PyFloat>().is_ok_and(|number| number.value() == f64::INFINITY) {
        return Ok(K::ANY);
    }
    if value.is_instance_of::<PyBool>() || value.is_instance_of::<PyString>() {
        return Err(wrong_type("k", "an integer of 2 or more, or 'any'", value));
    }
    let number = u32::try_from(integer("k", value, 2)?).unwrap_or(u32::MAX);
    Ok(K::Finite(FiniteK::new(number).map_err(raised)?))
}

/// The neighborhood by its number of moves.
fn read_neighbors(value: &Bound<'_, PyAny>) -> PyResult<K> {
    K::from_neighbors(integer("neighbors", value, 0)?).map_err(|error| raised_for("neighbors", error))
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
    let finite = read_k(k)?.finite().filter(|k| k.get() <= 12);
    let finite = finite.ok_or_else(|| argument("k", "expected an integer from 2 to 12"))?;
    let neighborhood = Neighborhood::new(finite).map_err(raised)?;
    let flat: Vec<i32> = (0..neighborhood.len())
        .filter_map(|index| neighborhood.get(index))
        .flat_map(|step| [step.y, step.x])
        .collect();
    points_array(k.py(), &flat)
}

/// How much longer than the shortest path at any angle a shortest path over N(k) can be.
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
#[pyo3(signature = (k, **motion))]
pub(crate) fn bound(k: &Bound<'_, PyAny>, motion: Option<&Bound<'_, PyDict>>) -> PyResult<Option<f64>> {
    let mut keywords = Keywords::read("bound", motion, Takes::MOTION)?;
    // A second name of the neighborhood stays an error.
    keywords.k = Some(read_k(k)?);
    let Motion { k, rules, .. } = keywords.motion()?;
    let guarantee = k.finite().map_or(Guarantee::OptimalAnyAngle, Guarantee::Optimal);
    Ok(guarantee.bound(rules))
}
