//! The objects of options: motion, wishes, the engine and its options.

use js_sys::Reflect;
use mediant::{
    ConfiguredEngine, CornerRule, DiagonalGap, Engine, EngineName, EngineOption, FiniteK, K, Limits, Motion,
    OptionValue, PlacementKind, Query, Request, Rules, SetupError, Smoothing, ValueKind, errors::absent,
};
use wasm_bindgen::prelude::*;

use crate::{
    arguments::{Points, flag, integer, positive, text, word},
    clock::Deadline,
    errors::{argument, coded, raised, raised_for, wrong_type},
};

pub(crate) const PLACEMENTS: [(&str, PlacementKind); 2] =
    [("center", PlacementKind::Center), ("corner", PlacementKind::Corner)];
const CORNERS: [(&str, CornerRule); 3] =
    [("never", CornerRule::Never), ("one", CornerRule::One), ("always", CornerRule::Always)];
const GAPS: [(&str, DiagonalGap); 2] = [("open", DiagonalGap::Open), ("closed", DiagonalGap::Closed)];

const MOTION_KEYS: [&str; 5] = ["k", "neighbors", "placement", "corners", "gap"];
const WISH_KEYS: [&str; 6] = ["nearest", "snap", "tolerance", "maxCost", "maxExpansions", "timeout"];

/// Which keys an object may have.
#[derive(Clone, Copy)]
pub(crate) struct Takes {
    motion: bool,
    wishes: bool,
    engine: bool,
    options: bool,
}

impl Takes {
    const NONE: Self = Self { motion: false, wishes: false, engine: false, options: false };
    pub(crate) const MOTION: Self = Self { motion: true, ..Self::NONE };
    pub(crate) const WISHES: Self = Self { wishes: true, ..Self::NONE };
    pub(crate) const OPTIONS: Self = Self { options: true, ..Self::NONE };
    pub(crate) const ALL: Self = Self { motion: true, wishes: true, engine: true, options: true };

    /// The keys, for an error.
    fn known(self) -> String {
        let of = |takes: bool, keys: &[&str]| {
            if takes { keys.iter().map(|&key| key.to_owned()).collect() } else { vec![] }
        };
        let mut keys: Vec<String> = of(self.motion, &MOTION_KEYS);
        keys.extend(of(self.wishes, &WISH_KEYS));
        keys.extend(of(self.engine, &["engine"]));
        if self.options {
            keys.extend(EngineOption::ALL.map(key));
        }
        keys.extend(of(self.options, &["smooth"]));
        keys.join(", ")
    }
}

/// The key of an engine's option: `jumpLimit` for `jump-limit`.
pub(crate) fn key(option: &EngineOption) -> String {
    let mut parts = option.name.split('-');
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |mut key, part| {
        let mut letters = part.chars();
        key.extend(letters.next().map(|letter| letter.to_ascii_uppercase()));
        key.push_str(letters.as_str());
        key
    })
}

/// What an object of options says.
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
    timeout: Option<f64>,
}

impl Keywords {
    /// Reads an object; undefined and null are one without keys, and a key that is undefined is none.
    /// `name` is that of the argument, for errors.
    pub(crate) fn read(name: &str, given: &JsValue, takes: Takes) -> Result<Self, JsValue> {
        let mut keywords = Self::default();
        for (key, value) in entries(name, given)? {
            if value.is_undefined() {
                // Yet a key that is misspelt is a mistake.
                if takes.known().split(", ").any(|known| known == key) {
                    continue;
                }
            }
            let is_known = takes.motion && keywords.read_motion(&key, &value)?
                || takes.wishes && keywords.read_wish(&key, &value)?
                || takes.engine && keywords.read_engine(&key, &value)?
                || takes.options && keywords.read_option(&key, &value)?;
            if !is_known {
                return Err(unknown_key(name, &key, &takes.known()));
            }
        }
        Ok(keywords)
    }

    fn read_motion(&mut self, name: &str, value: &JsValue) -> Result<bool, JsValue> {
        match name {
            "k" => self.k = Some(read_k(value)?),
            "neighbors" => self.neighbors = Some(read_neighbors(value)?),
            "placement" => self.placement = Some(word(name, value, &PLACEMENTS)?),
            "corners" => self.corners = Some(word(name, value, &CORNERS)?),
            "gap" => self.gap = Some(word(name, value, &GAPS)?),
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn read_wish(&mut self, name: &str, value: &JsValue) -> Result<bool, JsValue> {
        match name {
            "nearest" => self.nearest = flag(name, value)?,
            "snap" => self.snap = flag(name, value)?,
            "tolerance" => {
                self.tolerance = Some(positive(name, value)?).filter(|&tolerance| tolerance > 0.0);
            }
            "maxCost" => self.max_cost = Some(positive(name, value)?),
            // Infinity is no limit.
            "maxExpansions" if value.as_f64() == Some(f64::INFINITY) => self.max_expansions = None,
            "maxExpansions" => self.max_expansions = Some(integer(name, value, 0)?),
            "timeout" => self.timeout = Some(positive(name, value)?),
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn read_engine(&mut self, name: &str, value: &JsValue) -> Result<bool, JsValue> {
        if name != "engine" {
            return Ok(false);
        }
        self.engine = read_engine(value)?;
        Ok(true)
    }

    fn read_option(&mut self, name: &str, value: &JsValue) -> Result<bool, JsValue> {
        if name == "smooth" {
            let words = [("linear", Smoothing::Linear), ("taut", Smoothing::Taut)];
            self.smoothing = Some(word(name, value, &words)?);
            return Ok(true);
        }
        let Some(option) = EngineOption::ALL.into_iter().find(|option| key(option) == name) else {
            return Ok(false);
        };
        let given = match option.kind {
            ValueKind::Flag if flag(name, value)? => String::new(),
            ValueKind::Flag => return Ok(true),
            ValueKind::Number => integer(name, value, 1)?.to_string(),
            _ if value.is_string() => text(name, "a name", value)?,
            ValueKind::Levels | ValueKind::Memory => integer(name, value, 1)?.to_string(),
            ValueKind::Heuristic | ValueKind::Variant => return Err(wrong_type(name, "a name", value)),
        };
        let value = option.parse(&given).map_err(|wrong| argument(name, &wrong))?;
        self.options.push((option, value));
        Ok(true)
    }

    /// How the agent moves. What was left out, the engine decides, if it takes only that.
    pub(crate) fn motion(&self) -> Result<Motion, JsValue> {
        let capabilities = self.engine.unwrap_or_default().capabilities();
        let k = match (self.k, self.neighbors) {
            (Some(_), Some(_)) => {
                return Err(argument("neighbors", "it names the neighborhood, as k does: give one"));
            }
            (k, neighbors) => k.or(neighbors).unwrap_or(capabilities.default_k),
        };
        let rules = match (self.placement, self.corners, self.gap) {
            (_, Some(_), Some(_)) | (Some(PlacementKind::Center), None, Some(_)) => {
                return Err(argument("gap", "it is for placement 'corner'; at centers there is corners"));
            }
            (Some(PlacementKind::Corner), Some(_), None) => {
                return Err(argument("corners", "it is for placement 'center'; at corners there is gap"));
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
    pub(crate) fn configured(&self, engine: Engine) -> Result<ConfiguredEngine, JsValue> {
        self.try_configured(engine).map_err(raised)
    }

    /// The same; the error is the library's.
    pub(crate) fn try_configured(&self, engine: Engine) -> Result<ConfiguredEngine, SetupError> {
        let mut configured = ConfiguredEngine::from(engine);
        self.options.iter().try_for_each(|&(option, value)| configured.set(option, value))?;
        Ok(configured)
    }

    /// Whether options were given.
    pub(crate) fn has_options(&self) -> bool {
        !self.options.is_empty() || self.smoothing.is_some()
    }

    /// Whether no more is asked than a path from one vertex to another.
    fn has_no_wishes(&self) -> bool {
        let has_limits = self.max_cost.is_some() || self.max_expansions.is_some() || self.timeout.is_some();
        !self.nearest && !self.snap && self.tolerance.is_none() && !has_limits
    }

    /// The request for a path between points. Its time begins now.
    pub(crate) fn request(&self, start: &Points, goal: &Points) -> Request {
        if let (&Points::One(start), &Points::One(goal), true) = (start, goal, self.has_no_wishes()) {
            return Query::new(start, goal).into();
        }
        let mut limits = self.max_cost.map_or(Limits::new(), |cost| Limits::new().cost(cost));
        if let Some(most) = self.max_expansions {
            limits = limits.expansions(most);
        }
        if let Some(milliseconds) = self.timeout {
            let deadline = Deadline::after(milliseconds);
            limits = limits.deadline(move || deadline.is_over());
        }
        let between = Request::between(start.as_slice().iter().copied(), goal.as_slice().iter().copied());
        let request = between.within(limits).tolerance(self.tolerance.unwrap_or(0.0));
        let request = if self.nearest { request.nearest() } else { request };
        if self.snap { request.snap() } else { request }
    }
}

/// The keys of an object with their values; none of undefined and null.
pub(crate) fn entries(name: &str, given: &JsValue) -> Result<Vec<(String, JsValue)>, JsValue> {
    if given.is_undefined() || given.is_null() {
        return Ok(Vec::new());
    }
    if !given.is_object() || js_sys::Array::is_array(given) {
        return Err(wrong_type(name, "an object of options", given));
    }
    let mut entries = Vec::new();
    for key in Reflect::own_keys(given)?.iter() {
        // Symbols are no options, and nobody misspells one.
        if let Some(text) = key.as_string() {
            entries.push((text, Reflect::get(given, &key)?));
        }
    }
    Ok(entries)
}

/// The error for a key that an object cannot have.
pub(crate) fn unknown_key(name: &str, key: &str, known: &str) -> JsValue {
    let why = absent(key).map_or(String::new(), |why| format!(" ({why})"));
    coded("argument", &format!("{name}: no key '{key}' is known{why}; the keys are {known}"))
}

/// An engine's name; `None` for undefined and `"auto"`.
pub(crate) fn read_engine(value: &JsValue) -> Result<Option<Engine>, JsValue> {
    if value.is_undefined() || value.is_null() {
        return Ok(None);
    }
    let name = text("engine", "the name of an engine", value)?;
    let name = name.parse().map_err(|error: mediant::UnknownName| raised_for("engine", error))?;
    Ok(EngineName::engine(name))
}

/// The neighborhood by its number of moves.
fn read_neighbors(value: &JsValue) -> Result<K, JsValue> {
    K::from_neighbors(integer("neighbors", value, 0)?).map_err(raised)
}

/// k: a number, or `"any"` (or another name of infinity), or infinity.
pub(crate) fn read_k(value: &JsValue) -> Result<K, JsValue> {
    let named = value.as_string().and_then(|text| text.parse().ok());
    if named == Some(K::ANY) || value.as_f64() == Some(f64::INFINITY) {
        return Ok(K::ANY);
    }
    if value.as_f64().is_none() {
        return Err(wrong_type("k", "an integer of 2 or more, or 'any'", value));
    }
    let number = u32::try_from(integer("k", value, 0)?).unwrap_or(u32::MAX);
    Ok(K::Finite(FiniteK::new(number).map_err(raised)?))
}
