//! What is to be known of an option, wherever it is written or read.

use std::{
    fmt,
    num::{IntErrorKind, NonZeroU32, ParseIntError},
};

use super::{Engine, EngineKind};
use crate::{HeuristicName, Levels, SetupError, Variant};

/// An option that some engines take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EngineOption {
    /// Its name, as a flag of a program: `jump-limit`.
    pub name: &'static str,
    /// What it is called where it is refused.
    what: &'static str,
    /// What its value is.
    pub kind: ValueKind,
    /// Its key in the text of a [`Setup`](crate::Setup): `KEY=VALUE`, of a flag `KEY`; `None` where the value is written alone.
    pub key: Option<&'static str>,
    /// Whether it decides what an index holds.
    pub is_of_index: bool,
    /// The sentence that tells what it does.
    pub help: &'static str,
    /// What a report says of its value: `{}` stands for it.
    phrase: &'static str,
    /// Values that the suites try, as text.
    samples: &'static [&'static str],
}

/// What the value of an option is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueKind {
    /// The option is there or not.
    Flag,
    /// A whole number from 1 up.
    Number,
    /// The name of a heuristic.
    Heuristic,
    /// The name of a variant.
    Variant,
    /// A number of levels, `all` or `contracted`.
    Levels,
}

/// The value of an option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OptionValue {
    /// The option is there.
    Flag,
    /// A whole number.
    Number(NonZeroU32),
    /// A heuristic.
    Heuristic(HeuristicName),
    /// A variant.
    Variant(Variant),
    /// Levels.
    Levels(Levels),
}

/// The field of an engine that holds an option.
#[derive(Debug)]
pub(super) enum Slot<'e> {
    Flag(&'e mut bool),
    Number(&'e mut Option<NonZeroU32>),
    Heuristic(&'e mut Option<HeuristicName>),
    Variant(&'e mut Option<Variant>),
    Levels(&'e mut Option<Levels>),
}

impl Slot<'_> {
    /// The value, if it was chosen.
    pub(super) fn get(&self) -> Option<OptionValue> {
        match self {
            Self::Flag(there) => there.then_some(OptionValue::Flag),
            Self::Number(number) => number.map(OptionValue::Number),
            Self::Heuristic(name) => name.map(OptionValue::Heuristic),
            Self::Variant(variant) => variant.map(OptionValue::Variant),
            Self::Levels(levels) => levels.map(OptionValue::Levels),
        }
    }

    /// Chooses a value. False for one of another kind.
    pub(super) fn set(self, value: OptionValue) -> bool {
        match (self, value) {
            (Self::Flag(there), OptionValue::Flag) => *there = true,
            (Self::Number(slot), OptionValue::Number(number)) => *slot = Some(number),
            (Self::Heuristic(slot), OptionValue::Heuristic(name)) => *slot = Some(name),
            (Self::Variant(slot), OptionValue::Variant(variant)) => *slot = Some(variant),
            (Self::Levels(slot), OptionValue::Levels(levels)) => *slot = Some(levels),
            _ => return false,
        }
        true
    }
}

/// The heuristic of the search.
pub(super) static HEURISTIC: EngineOption = EngineOption {
    name: "heuristic",
    what: "heuristic",
    kind: ValueKind::Heuristic,
    key: None,
    is_of_index: false,
    help: "The heuristic of the search: the cost on an empty grid (the default), the straight-line distance, zero, or \
           the distance squared, which overestimates",
    phrase: "heuristic {}",
    samples: &["euclidean", "zero", "squared"],
};

/// Which of the variants of an engine.
pub(super) static VARIANT: EngineOption = EngineOption {
    name: "variant",
    what: "variant",
    kind: ValueKind::Variant,
    key: None,
    is_of_index: false,
    help: "For an engine that was published with a flaw: the optimal or complete variant (the default), or the published \
           one",
    phrase: "variant {}",
    samples: &["paper"],
};

/// The largest number of steps of a jump.
pub(super) static JUMP_LIMIT: EngineOption = EngineOption {
    name: "jump-limit",
    what: "jump limit",
    kind: ValueKind::Number,
    key: Some("limit"),
    is_of_index: false,
    help: "Limit each jump to N steps",
    phrase: "jumps up to {}",
    samples: &["2"],
};

/// Whether to keep intermediate jump points.
pub(super) static KEEP_INTERMEDIATE: EngineOption = EngineOption {
    name: "keep-intermediate",
    what: "intermediate jump points",
    kind: ValueKind::Flag,
    key: Some("intermediate"),
    is_of_index: false,
    help: "Keep intermediate jump points, at which a path only turns on its way to another jump point",
    phrase: "intermediate jump points kept",
    samples: &[""],
};

/// The levels of a subgoal graph or of clusters.
pub(crate) static LEVELS: EngineOption = EngineOption {
    name: "levels",
    what: "levels",
    kind: ValueKind::Levels,
    key: Some("levels"),
    is_of_index: true,
    help: "The number of levels of the subgoal graph (1 is the graph without a hierarchy) or of the clusters, or all. \
           A contraction hierarchy by default, 2 levels for subgoal-theta, 3 levels for hpa; with --index, those of the \
           index",
    phrase: "{}",
    samples: &["1", "2", "all"],
};

/// The side of clusters or segments.
pub(crate) static SIDE: EngineOption = EngineOption {
    name: "side",
    what: "side",
    kind: ValueKind::Number,
    key: Some("side"),
    is_of_index: true,
    help: "Cut the map into clusters (on the lowest level) or segments of N × N cells. 10 by default for hpa, 3 for chpa; \
           with --index, those of the index",
    phrase: "side {}",
    samples: &["2", "5"],
};

/// Whether HPA* leaves its paths as they are refined.
pub(super) static UNSTRAIGHTENED: EngineOption = EngineOption {
    name: "unstraightened",
    what: "option unstraightened",
    kind: ValueKind::Flag,
    key: Some("unstraightened"),
    is_of_index: false,
    help: "Do not straighten the paths that lead through clusters",
    phrase: "paths not straightened",
    samples: &[""],
};

/// The heuristic of the second phase.
pub(super) static SECOND: EngineOption = EngineOption {
    name: "second",
    what: "second heuristic",
    kind: ValueKind::Heuristic,
    key: Some("second"),
    is_of_index: false,
    help: "The heuristic of the second phase, from checkpoint to checkpoint. That of the first phase by default",
    phrase: "second heuristic {}",
    samples: &["squared"],
};

/// Every how many segments there is a checkpoint.
pub(super) static STEP: EngineOption = EngineOption {
    name: "step",
    what: "step",
    kind: ValueKind::Number,
    key: Some("step"),
    is_of_index: false,
    help: "Plan a checkpoint every N segments. 2 by default",
    phrase: "step {}",
    samples: &["1"],
};

/// How long the way to a checkpoint may be.
pub(super) static DETOUR: EngineOption = EngineOption {
    name: "detour",
    what: "detour",
    kind: ValueKind::Number,
    key: Some("detour"),
    is_of_index: false,
    help: "Skip a checkpoint to which the path costs more than N times what it would cost on an empty grid. 3 by default",
    phrase: "detours up to {}",
    samples: &["1"],
};

impl EngineOption {
    /// All options, in the order of help and records.
    pub const ALL: [&'static Self; 10] = [
        &HEURISTIC,
        &VARIANT,
        &JUMP_LIMIT,
        &KEEP_INTERMEDIATE,
        &LEVELS,
        &SIDE,
        &UNSTRAIGHTENED,
        &SECOND,
        &STEP,
        &DETOUR,
    ];

    /// Reads a value; the text of a flag's is empty.
    ///
    /// # Errors
    /// What was expected, in words.
    pub fn parse(&self, text: &str) -> Result<OptionValue, String> {
        match self.kind {
            ValueKind::Flag if text.is_empty() => Ok(OptionValue::Flag),
            ValueKind::Flag => Err("expected no value".to_owned()),
            ValueKind::Number => number(text).map(OptionValue::Number),
            ValueKind::Heuristic => text
                .parse()
                .map(OptionValue::Heuristic)
                .map_err(|wrong: crate::UnknownName| wrong.to_string()),
            ValueKind::Variant => {
                text.parse().map(OptionValue::Variant).map_err(|wrong: crate::UnknownName| wrong.to_string())
            }
            ValueKind::Levels => {
                text.parse().map(OptionValue::Levels).map_err(|wrong: crate::UnknownLevels| wrong.to_string())
            }
        }
    }

    /// The names that its value may have; empty unless it is one of few.
    #[must_use]
    pub fn names(&self) -> Vec<&'static str> {
        match self.kind {
            ValueKind::Heuristic => HeuristicName::ALL.map(HeuristicName::name).to_vec(),
            ValueKind::Variant => Variant::ALL.map(Variant::name).to_vec(),
            ValueKind::Flag | ValueKind::Number | ValueKind::Levels => Vec::new(),
        }
    }

    /// How it is written in the text of a setup.
    pub(crate) fn text(&self, value: OptionValue) -> String {
        match (self.key, value) {
            (None, value) => value.to_string(),
            (Some(key), OptionValue::Flag) => key.to_owned(),
            (Some(key), value) => format!("{key}={value}"),
        }
    }

    /// The ways in which it is written in the text of a setup.
    pub(crate) fn forms(&self) -> String {
        match (self.key, self.kind) {
            (None, _) => self.names().join(", "),
            (Some(key), ValueKind::Flag) => key.to_owned(),
            (Some(key), ValueKind::Number) => format!("{key}=N"),
            (Some(key), ValueKind::Levels) => format!("{key}=N, {key}=all"),
            (Some(key), ValueKind::Heuristic | ValueKind::Variant) => {
                format!("{key}={}", self.what.split(' ').next_back().unwrap_or_default().to_uppercase())
            }
        }
    }

    /// The value in the text of a setup, if the text is about this option.
    pub(crate) fn read(&self, text: &str) -> Option<OptionValue> {
        match self.key {
            None => self.parse(text).ok(),
            Some(key) if self.kind == ValueKind::Flag => self.parse(text.strip_prefix(key)?).ok(),
            Some(key) => self.parse(text.strip_prefix(key)?.strip_prefix('=')?).ok(),
        }
    }

    /// What a report says of a value: `jumps up to 16`, `2 levels`.
    #[must_use]
    pub fn describe(&self, value: OptionValue) -> String {
        let value = match value {
            OptionValue::Levels(levels) => levels.in_words(),
            value => value.to_string(),
        };
        self.phrase.replace("{}", &value)
    }

    /// Values that the suites try on an engine.
    pub(crate) fn samples(&self) -> impl Iterator<Item = OptionValue> {
        self.samples.iter().filter_map(|text| self.parse(text).ok())
    }

    /// The names of the engines that take it, of those of which something else holds, too.
    pub(crate) fn takers(&self, also: impl Fn(EngineKind) -> bool) -> String {
        let takes = |kind| Engine::from(kind).options().iter().any(|option| option.name == self.name);
        EngineKind::names_of(|kind| takes(kind) && also(kind))
    }

    /// The error of an engine that does not take it.
    pub(crate) fn refused_by(&self, engine: EngineKind) -> SetupError {
        SetupError::Option { engine, option: self.what, others: self.takers(|_| true) }
    }
}

impl fmt::Display for OptionValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flag => Ok(()),
            Self::Number(number) => number.fmt(f),
            Self::Heuristic(name) => name.fmt(f),
            Self::Variant(variant) => variant.fmt(f),
            Self::Levels(levels) => levels.fmt(f),
        }
    }
}

fn number(text: &str) -> Result<NonZeroU32, String> {
    text.parse().map_err(|error: ParseIntError| match error.kind() {
        IntErrorKind::PosOverflow => format!("expected a whole number from 1 to {}", u32::MAX),
        _ => "expected a whole number from 1 up".to_owned(),
    })
}
