//! One description of each option, for every place that writes or reads it.

#[cfg(feature = "publications")]
use super::published::{DETOUR, JUMP_LIMIT, KEEP_INTERMEDIATE, SECOND, STEP, UNSTRAIGHTENED, VARIANT};
use super::value::{OptionValue, ValueKind};

/// An option that some engines take: its name, its texts and the kind of its value.
///
/// [`ConfiguredEngine::options`](crate::options::ConfiguredEngine::options) lists the options of an engine.
///
/// ```
/// use mediant::{Engine, Setup, options::{ConfiguredEngine, EngineOption}};
///
/// let side = EngineOption::ALL.into_iter().find(|option| option.name == "side");
/// let side = side.ok_or("no such option")?;
/// let mut engine = ConfiguredEngine::from(Engine::Hpa);
/// engine.set(side, side.parse("16")?)?;
/// assert_eq!("hpa,side=16".parse::<Setup>()?.engine, engine);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EngineOption {
    /// Its name: that of the program's flag, as `jump-limit`, and with `_` for `-` of the key in its records.
    pub name: &'static str,
    /// Its noun in errors: `jps-plus takes no side`.
    pub(super) noun: &'static str,
    /// The kind of its value.
    pub kind: ValueKind,
    /// Its key in the text of a [`Setup`](crate::Setup), written `KEY=VALUE`, or just `KEY` for a flag.
    /// `None` if the value is written without a key.
    pub(super) key: Option<&'static str>,
    /// Whether it decides what an index holds.
    pub is_index_option: bool,
    /// Whether it only reproduces a publication. Such options are there with the feature `publications`.
    pub is_published: bool,
    /// Its effect, in a sentence.
    pub help: &'static str,
    /// Its phrase in reports, with `{}` in place of the value.
    pub(super) phrase: &'static str,
    /// Values that the test suites try, as text.
    pub(super) samples: &'static [&'static str],
}

/// The heuristic of the search.
pub(crate) static HEURISTIC: EngineOption = EngineOption {
    name: "heuristic",
    noun: "heuristic",
    kind: ValueKind::Heuristic,
    key: None,
    is_index_option: false,
    is_published: false,
    help: "The heuristic of the search: hk, the cost on an empty grid (the default), euclidean, the \
           straight-line distance, or zero",
    phrase: "heuristic {}",
    samples: if cfg!(feature = "publications") {
        &["euclidean", "zero", "squared"]
    } else {
        &["euclidean", "zero"]
    },
};

/// The levels of a subgoal graph or of clusters, or hub labels.
pub(crate) static LEVELS: EngineOption = EngineOption {
    name: "levels",
    noun: "levels",
    kind: ValueKind::Levels,
    key: Some("levels"),
    is_index_option: true,
    is_published: false,
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
    is_published: false,
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
    is_published: false,
    help: "Cut the map into clusters (on the lowest level) or segments of N × N cells. 10 by default for \
           hpa, 3 for chpa; with --index, those of the index",
    phrase: "side {}",
    samples: &["2", "5"],
};

impl EngineOption {
    /// All options, in the order of the program's help and reports.
    ///
    /// | in the text of a setup | flag of the program | meaning |
    /// |---|---|---|
    /// | `hk`, `euclidean`, `zero` | `--heuristic` | the heuristic of the search |
    /// | `levels=N`, `levels=all`, `levels=contracted`, `levels=labels` | `--levels` | the levels of a subgoal graph or of clusters, or hub labels |
    /// | `memory=8MB` | `--memory` | the memory that hub labels may take |
    /// | `side=N` | `--side` | the side of a cluster or segment, in cells |
    ///
    /// The feature `publications` adds those that only reproduce publications:
    ///
    /// | in the text of a setup | flag of the program | meaning |
    /// |---|---|---|
    /// | `squared` | `--heuristic` | a heuristic that overestimates |
    /// | `exact`, `complete`, `paper` | `--variant` | the repaired or the published variant |
    /// | `limit=N` | `--jump-limit` | jumps of at most N steps |
    /// | `intermediate` | `--keep-intermediate` | intermediate jump points are kept |
    /// | `unstraightened` | `--unstraightened` | paths through clusters are not straightened |
    /// | `second=NAME` | `--second` | the heuristic of the second phase |
    /// | `step=N` | `--step` | a checkpoint every N segments |
    /// | `detour=N` | `--detour` | how many times h_k the path to a checkpoint may cost |
    pub const ALL: [&'static Self; if cfg!(feature = "publications") { 11 } else { 4 }] = [
        &HEURISTIC,
        #[cfg(feature = "publications")]
        &VARIANT,
        #[cfg(feature = "publications")]
        &JUMP_LIMIT,
        #[cfg(feature = "publications")]
        &KEEP_INTERMEDIATE,
        &LEVELS,
        &MEMORY,
        &SIDE,
        #[cfg(feature = "publications")]
        &UNSTRAIGHTENED,
        #[cfg(feature = "publications")]
        &SECOND,
        #[cfg(feature = "publications")]
        &STEP,
        #[cfg(feature = "publications")]
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
            (Some(key), _) => {
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
