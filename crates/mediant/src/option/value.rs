//! The values that options take.

use std::{
    fmt,
    num::{IntErrorKind, NonZeroU32, ParseIntError},
};

use super::{
    if_published,
    levels::{Levels, UnknownLevels},
    memory::{Memory, UnknownMemory},
};
use mediant_grid::{names, names::UnknownName};

/// The heuristic that guides a search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum HeuristicName {
    /// h_k: the cost on an empty grid.
    #[default]
    Hk,
    /// The straight-line distance.
    Euclidean,
    /// 0 everywhere: no guidance.
    Zero,
    /// The square of the straight-line distance, which overestimates. Only with the feature `publications`.
    #[cfg(feature = "publications")]
    SquaredEuclidean,
}

names!(
    HeuristicName: Hk => "hk", Euclidean => "euclidean", Zero => "zero",
    #[cfg(feature = "publications")]
    SquaredEuclidean => "squared"
);

impl HeuristicName {
    /// Whether it overestimates: paths may then be longer.
    #[must_use]
    pub const fn overestimates(self) -> bool {
        if_published!(matches!(self, Self::SquaredEuclidean), else false)
    }
}

/// The variants of an engine that was published with a flaw: repaired or as published.
#[cfg(feature = "publications")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Variant {
    /// The repaired pruning rule of canonical A*, which is optimal.
    Exact,
    /// The repaired CHPA*, which finds a path whenever there is one.
    Complete,
    /// As published.
    Paper,
}

#[cfg(feature = "publications")]
names!(Variant: Exact => "exact", Complete => "complete", Paper => "paper");

/// The kinds of value that options take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueKind {
    /// None: the option is given or not.
    Flag,
    /// A whole number from 1 up.
    Number,
    /// The name of a heuristic.
    Heuristic,
    /// The name of a variant. Only with the feature `publications`.
    #[cfg(feature = "publications")]
    Variant,
    /// A number of levels, `all`, `contracted` or `labels`.
    Levels,
    /// An amount of memory.
    Memory,
}

/// The value of an option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OptionValue {
    /// The flag is given.
    Flag,
    /// A whole number.
    Number(NonZeroU32),
    /// A heuristic.
    Heuristic(HeuristicName),
    /// A variant. Only with the feature `publications`.
    #[cfg(feature = "publications")]
    Variant(Variant),
    /// Levels.
    Levels(Levels),
    /// An amount of memory.
    Memory(Memory),
}

impl ValueKind {
    /// Reads a value of this kind; the error says what was expected.
    pub(super) fn parse(self, text: &str) -> Result<OptionValue, String> {
        match self {
            Self::Flag if text.is_empty() => Ok(OptionValue::Flag),
            Self::Flag => Err("expected no value".to_owned()),
            Self::Number => number(text).map(OptionValue::Number),
            Self::Heuristic => {
                text.parse().map(OptionValue::Heuristic).map_err(|wrong: UnknownName| wrong.to_string())
            }
            #[cfg(feature = "publications")]
            Self::Variant => {
                text.parse().map(OptionValue::Variant).map_err(|wrong: UnknownName| wrong.to_string())
            }
            Self::Levels => {
                text.parse().map(OptionValue::Levels).map_err(|wrong: UnknownLevels| wrong.to_string())
            }
            Self::Memory => {
                text.parse().map(OptionValue::Memory).map_err(|wrong: UnknownMemory| wrong.to_string())
            }
        }
    }

    /// The names among the values of this kind.
    pub(super) fn names(self) -> Vec<&'static str> {
        match self {
            Self::Heuristic => HeuristicName::ALL.map(HeuristicName::name).to_vec(),
            #[cfg(feature = "publications")]
            Self::Variant => Variant::ALL.map(Variant::name).to_vec(),
            Self::Levels => vec!["all", "contracted", "labels"],
            Self::Flag | Self::Number | Self::Memory => Vec::new(),
        }
    }
}

impl OptionValue {
    pub(crate) const fn number(self) -> Option<NonZeroU32> {
        if let Self::Number(number) = self { Some(number) } else { None }
    }

    pub(crate) const fn heuristic(self) -> Option<HeuristicName> {
        if let Self::Heuristic(name) = self { Some(name) } else { None }
    }

    #[cfg(feature = "publications")]
    pub(crate) const fn variant(self) -> Option<Variant> {
        if let Self::Variant(variant) = self { Some(variant) } else { None }
    }

    pub(crate) const fn levels(self) -> Option<Levels> {
        if let Self::Levels(levels) = self { Some(levels) } else { None }
    }
}

/// As [`EngineOption::parse`](super::EngineOption::parse) reads it.
impl fmt::Display for OptionValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flag => Ok(()),
            Self::Number(number) => number.fmt(f),
            Self::Heuristic(name) => name.fmt(f),
            #[cfg(feature = "publications")]
            Self::Variant(variant) => variant.fmt(f),
            Self::Levels(levels) => levels.fmt(f),
            Self::Memory(memory) => memory.fmt(f),
        }
    }
}

fn number(text: &str) -> Result<NonZeroU32, String> {
    text.parse().map_err(|error: ParseIntError| match error.kind() {
        IntErrorKind::PosOverflow => format!("expected a whole number from 1 to {}", u32::MAX),
        _ => "expected a whole number from 1 up".to_owned(),
    })
}
