//! One description of each option, for every place that writes or reads it.

use super::value::{OptionValue, ValueKind};

/// An option that some engines take: its name, its texts and the kind of its value.
///
/// [`ConfiguredEngine::options`](crate::options::ConfiguredEngine::options) lists the options of an engine.
///
/// ```
/// use mediant::{Engine, Setup, options::{ConfiguredEngine, EngineOption}};
///
/// let limit = EngineOption::ALL.into_iter().find(|option| option.name == "jump-limit");
/// let limit = limit.ok_or("no such option")?;
/// let mut engine = ConfiguredEngine::from(Engine::Jps);
/// engine.set(limit, limit.parse("16")?)?;
/// assert_eq!("jps,limit=16".parse::<Setup>()?.engine, engine);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EngineOption {
    /// Its name: that of the program's flag, as `jump-limit`, and with `_` for `-` of the key in its records.
    pub name: &'static str,
    /// Its noun in errors: `jps-plus takes no jump limit`.
    noun: &'static str,
    /// The kind of its value.
    pub kind: ValueKind,
    /// Its key in the text of a [`Setup`](crate::Setup), written `KEY=VALUE`, or just `KEY` for a flag.
    /// `None` if the value is written without a key.
    key: Option<&'static str>,
    /// Whether it decides what an index holds.
    pub is_index_option: bool,
    /// Its effect, in a sentence.
    pub help: &'static str,
    /// Its phrase in reports, with `{}` in place of the value.
    phrase: &'static str,
    /// Values that the test suites try, as text.
    samples: &'static [&'static str],
}

/// The heuristic of the search.
pub(crate) static HEURISTIC: EngineOption = EngineOption {
    name: "heuristic",
    noun: "heuristic",
    kind: ValueKind::Heuristic,
    key: None,
    is_index_option: false,
    help: "The heuristic of the search: the cost on an empty grid (the default), the straight-line distance, \
           zero, or the distance squared, which overestimates",
    phrase: "heuristic {}",
    samples: &["euclidean", "zero", "squared"],
};

/// The variant of an engine.
pub(crate) static VARIANT: EngineOption = EngineOption {
    name: "variant",
    noun: "variant",
    kind: ValueKind::Variant,
    key: None,
    is_index_option: false,
    help: "For an engine that was published with a flaw: the repaired variant (the default; exact for \
           canonical, complete for chpa), or paper, the published one",
    phrase: "variant {}",
    samples: &["paper"],
};

/// The most steps that a jump may take.
pub(crate) static JUMP_LIMIT: EngineOption = EngineOption {
    name: "jump-limit",
    noun: "jump limit",
    kind: ValueKind::Number,
    key: Some("limit"),
    is_index_option: false,
    help: "Limit each jump to N steps",
    phrase: "jumps up to {}",
    samples: &["2"],
};

/// Whether to keep intermediate jump points.
pub(crate) static KEEP_INTERMEDIATE: EngineOption = EngineOption {
    name: "keep-intermediate",
    noun: "intermediate jump points",
    kind: ValueKind::Flag,
    key: Some("intermediate"),
    is_index_option: false,
    help: "Keep intermediate jump points, at which a path only turns on its way to another jump point",
    phrase: "intermediate jump points kept",
    samples: &[""],
};

/// The levels of a subgoal graph or of clusters, or hub labels.
pub(crate) static LEVELS: EngineOption = EngineOption {
    name: "levels",
    noun: "levels",
    kind: ValueKind::Levels,
    key: Some("levels"),
    is_index_option: true,
    help: "The number of levels of the subgoal graph (1 is the graph without a hierarchy) or of the \
           clusters, or all; for subgoal also labels (hub labels) or contracted (a contraction hierarchy). By \
           default hub labels for subgoal if they fit in --memory, else a contraction hierarchy; 2 levels for \
           subgoal-theta, 3 for hpa; with --index, those of the index",
    phrase: "{}",
    samples: &["1", "2", "all", "contracted", "labels"],
};

/// The memory that hub labels may take.
pub(crate) static MEMORY: EngineOption = EngineOption {
    name: "memory",
    noun: "memory for hub labels",
    kind: ValueKind::Memory,
    key: Some("memory"),
    is_index_option: true,
    help: "The memory that the hub labels of subgoal may take, as 8MB. 48 bytes a cell by default, but at \
           least 32MB and at most 1GB. A map whose labels take more has a contraction hierarchy, and the \
           same paths",
    phrase: "at most {} for labels",
    samples: &["1kB"],
};

/// The side of clusters or segments.
pub(crate) static SIDE: EngineOption = EngineOption {
    name: "side",
    noun: "side",
    kind: ValueKind::Number,
    key: Some("side"),
    is_index_option: true,
    help: "Cut the map into clusters (on the lowest level) or segments of N × N cells. 10 by default for \
           hpa, 3 for chpa; with --index, those of the index",
    phrase: "side {}",
    samples: &["2", "5"],
};

/// Whether HPA* leaves out its straightening.
pub(crate) static UNSTRAIGHTENED: EngineOption = EngineOption {
    name: "unstraightened",
    noun: "option unstraightened",
    kind: ValueKind::Flag,
    key: Some("unstraightened"),
    is_index_option: false,
    help: "Leave out the straightening of hpa, which shortens each path after the search",
    phrase: "paths not straightened",
    samples: &[""],
};

/// The heuristic of the second phase.
pub(crate) static SECOND: EngineOption = EngineOption {
    name: "second",
    noun: "second heuristic",
    kind: ValueKind::Heuristic,
    key: Some("second"),
    is_index_option: false,
    help: "The heuristic of chpa's second phase, from checkpoint to checkpoint. That of the first phase by \
           default",
    phrase: "second heuristic {}",
    samples: &["squared"],
};

/// Every how many segments there is a checkpoint.
pub(crate) static STEP: EngineOption = EngineOption {
    name: "step",
    noun: "step",
    kind: ValueKind::Number,
    key: Some("step"),
    is_index_option: false,
    help: "Plan a checkpoint every N segments. 2 by default",
    phrase: "step {}",
    samples: &["1"],
};

/// How long the path to a checkpoint may be.
pub(crate) static DETOUR: EngineOption = EngineOption {
    name: "detour",
    noun: "detour",
    kind: ValueKind::Number,
    key: Some("detour"),
    is_index_option: false,
    help: "Skip a checkpoint to which the path costs more than N times what it would cost on an empty grid. \
           3 by default",
    phrase: "detours up to {}",
    samples: &["1"],
};

impl EngineOption {
    /// All options, in the order of the program's help and reports.
    ///
    /// | in the text of a setup | flag of the program | meaning |
    /// |---|---|---|
    /// | `hk`, `euclidean`, `zero`, `squared` | `--heuristic` | the heuristic of the search |
    /// | `exact`, `complete`, `paper` | `--variant` | the repaired or the published variant |
    /// | `limit=N` | `--jump-limit` | jumps of at most N steps |
    /// | `intermediate` | `--keep-intermediate` | intermediate jump points are kept |
    /// | `levels=N`, `levels=all`, `levels=contracted`, `levels=labels` | `--levels` | the levels of a subgoal graph or of clusters, or hub labels |
    /// | `memory=8MB` | `--memory` | the memory that hub labels may take |
    /// | `side=N` | `--side` | the side of a cluster or segment, in cells |
    /// | `unstraightened` | `--unstraightened` | paths through clusters are not straightened |
    /// | `second=NAME` | `--second` | the heuristic of the second phase |
    /// | `step=N` | `--step` | a checkpoint every N segments |
    /// | `detour=N` | `--detour` | how many times h_k the path to a checkpoint may cost |
    pub const ALL: [&'static Self; 11] = [
        &HEURISTIC,
        &VARIANT,
        &JUMP_LIMIT,
        &KEEP_INTERMEDIATE,
        &LEVELS,
        &MEMORY,
        &SIDE,
        &UNSTRAIGHTENED,
        &SECOND,
        &STEP,
        &DETOUR,
    ];

    /// Reads a value. That of a flag is the empty text.
    ///
    /// # Errors
    /// The expected value, in words.
    pub fn parse(&self, text: &str) -> Result<OptionValue, String> {
        self.kind.parse(text)
    }

    /// The names that its value may have; empty if its value is not a name.
    #[must_use]
    pub fn names(&self) -> Vec<&'static str> {
        self.kind.names()
    }

    /// The option with a value, in the text of a setup.
    pub(crate) fn text(&self, value: OptionValue) -> String {
        match (self.key, value) {
            (None, value) => value.to_string(),
            (Some(key), OptionValue::Flag) => key.to_owned(),
            (Some(key), value) => format!("{key}={value}"),
        }
    }

    /// Its forms in the text of a setup: `limit=N`, `levels=N, levels=all`.
    pub(crate) fn forms(&self) -> String {
        match (self.key, self.kind) {
            (None, _) => self.names().join(", "),
            (Some(key), ValueKind::Flag) => key.to_owned(),
            (Some(key), ValueKind::Number) => format!("{key}=N"),
            (Some(key), ValueKind::Levels) => {
                ["N", "all", "contracted", "labels"].map(|value| format!("{key}={value}")).join(", ")
            }
            (Some(key), ValueKind::Memory) => format!("{key}=BYTES"),
            (Some(key), ValueKind::Heuristic | ValueKind::Variant) => {
                format!("{key}={}", self.noun.split(' ').next_back().unwrap_or_default().to_uppercase())
            }
        }
    }

    /// The value that a part of a setup's text gives to this option; `None` if that part is no valid text of
    /// it.
    pub(crate) fn read(&self, text: &str) -> Option<OptionValue> {
        match self.key {
            None => self.parse(text).ok(),
            Some(key) if self.kind == ValueKind::Flag => self.parse(text.strip_prefix(key)?).ok(),
            Some(key) => self.parse(text.strip_prefix(key)?.strip_prefix('=')?).ok(),
        }
    }

    /// The option with a value, in reports: `jumps up to 16`, `2 levels`.
    #[must_use]
    pub fn describe(&self, value: OptionValue) -> String {
        let value = match value {
            OptionValue::Levels(levels) => levels.in_words(),
            value => value.to_string(),
        };
        self.phrase.replace("{}", &value)
    }

    /// Values that the test suites try.
    pub(crate) fn samples(&self) -> impl Iterator<Item = OptionValue> {
        self.samples.iter().filter_map(|text| self.parse(text).ok())
    }

    /// Its noun in errors.
    pub(crate) const fn noun(&self) -> &'static str {
        self.noun
    }
}
