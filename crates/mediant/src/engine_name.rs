//! The names of engines, and `auto`.

use std::{fmt, str::FromStr};

use mediant_grid::names::{UnknownName, means};

use crate::engine::Engine;

/// The name of an engine, or `auto`, which is the best one for what is asked
/// ([`Space::engine_for`](crate::Space::engine_for)).
///
/// ```
/// use mediant::{Engine, options::EngineName};
/// assert_eq!("auto".parse(), Ok(EngineName::Auto));
/// assert_eq!("JPS+".parse(), Ok(EngineName::Engine(Engine::JpsPlus)));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum EngineName {
    /// `auto`.
    #[default]
    Auto,
    /// An engine.
    Engine(Engine),
}

impl EngineName {
    /// Both kinds of names: `auto`, then all engines.
    #[must_use]
    pub fn all() -> Vec<Self> {
        [Self::Auto].into_iter().chain(Engine::ALL.map(Self::Engine)).collect()
    }

    /// The name, as people and scripts write it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Engine(engine) => engine.name(),
        }
    }

    /// The engine; `None` for `auto`.
    #[must_use]
    pub const fn engine(self) -> Option<Engine> {
        match self {
            Self::Auto => None,
            Self::Engine(engine) => Some(engine),
        }
    }
}

impl fmt::Display for EngineName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for EngineName {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        if means(text, Self::Auto.name()) {
            return Ok(Self::Auto);
        }
        text.parse().map(Self::Engine).map_err(|UnknownName { found, known }| UnknownName {
            found,
            known: format!("{}, {known}", Self::Auto),
        })
    }
}
