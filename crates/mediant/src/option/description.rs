//! One description of each option, for every place that writes or reads it.

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

impl EngineOption {
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
