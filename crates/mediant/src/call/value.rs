//! Values as a language has them, and what a parameter makes of one.

use std::{borrow::Cow, fmt, str::FromStr};

use mediant_grid::names::UnknownName;
use mediant_moves::{FiniteK, K};

use super::wrong::Wrong;
use crate::{
    engine::Engine,
    engine_name::EngineName,
    option::{EngineOption, OptionValue, ValueKind},
};

/// A value of another language.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Value<'a> {
    /// None was given.
    Absent,
    /// True or false.
    Flag(bool),
    /// A whole number; one that has no room is the largest, or the smallest.
    Integer(i64),
    /// A number.
    Number(f64),
    /// A text.
    Text(Cow<'a, str>),
    /// Something else, in the words of the language: `a list`.
    Other(String),
}

impl<'a> From<&'a str> for Value<'a> {
    fn from(text: &'a str) -> Self {
        Self::Text(text.into())
    }
}

impl From<i64> for Value<'_> {
    fn from(number: i64) -> Self {
        Self::Integer(number)
    }
}

impl From<bool> for Value<'_> {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

/// In an error, as found.
impl fmt::Display for Value<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Absent => f.write_str("none"),
            Self::Flag(flag) => flag.fmt(f),
            Self::Integer(i64::MAX) => f.write_str("one that is too large"),
            Self::Integer(number) => number.fmt(f),
            Self::Number(number) => number.fmt(f),
            Self::Text(text) => {
                let start: String = text.chars().take(20).collect();
                write!(f, "the text '{start}'")
            }
            Self::Other(kind) => f.write_str(kind),
        }
    }
}

/// The form of a k, for errors.
const A_K: &str = "an integer of 2 or more, or 'any'";

impl Value<'_> {
    fn of_another_type(&self, expected: impl Into<String>) -> Wrong {
        Wrong::Type { expected: expected.into(), found: self.to_string() }
    }

    pub(super) fn flag(&self) -> Result<bool, Wrong> {
        match self {
            Self::Flag(flag) => Ok(*flag),
            other => Err(other.of_another_type("true or false")),
        }
    }

    /// A number of 0 or more, which may be infinite.
    pub(super) fn length(&self) -> Result<f64, Wrong> {
        let number = match self {
            Self::Integer(number) => *number as f64,
            Self::Number(number) => *number,
            other => return Err(other.of_another_type("a number")),
        };
        if number >= 0.0 {
            return Ok(number);
        }
        Err(Wrong::Value(format!("expected a number of 0 or more, found {number}")))
    }

    /// A whole number of at least `least`.
    fn integer(&self, least: u32) -> Result<u64, Wrong> {
        let number = match *self {
            Self::Integer(number) => i128::from(number),
            // All numbers of JavaScript are such.
            Self::Number(number) if number.fract() == 0.0 => number as i128,
            Self::Number(number) => {
                let wrong = format!("expected an integer of {least} or more, found {number}");
                return Err(Wrong::Value(wrong));
            }
            _ => return Err(self.of_another_type("an integer")),
        };
        match u64::try_from(number) {
            Ok(number) if number >= u64::from(least) => Ok(number),
            _ => Err(Wrong::Value(format!("expected an integer of {least} or more, found {number}"))),
        }
    }

    /// A whole number of 0 or more; `None` for infinity, which limits nothing.
    pub(super) fn count(&self) -> Result<Option<u64>, Wrong> {
        if *self == Self::Number(f64::INFINITY) { Ok(None) } else { self.integer(0).map(Some) }
    }

    /// One of the names of an enum.
    pub(super) fn name<T: FromStr<Err = UnknownName>>(&self) -> Result<T, Wrong> {
        match self {
            Self::Text(text) => Ok(text.parse()?),
            other => {
                let known = "".parse::<T>().err().map_or(String::new(), |error| error.known);
                Err(other.of_another_type(format!("one of {known}")))
            }
        }
    }

    pub(super) fn engine(&self) -> Result<Option<Engine>, Wrong> {
        match self {
            Self::Text(text) => Ok(text.parse::<EngineName>()?.engine()),
            other => Err(other.of_another_type("the name of an engine")),
        }
    }

    /// k: a number, `"any"` (or another name of infinity), or infinity.
    pub(super) fn k(&self) -> Result<K, Wrong> {
        match self {
            Self::Text(text) if text.parse() == Ok(K::ANY) => Ok(K::ANY),
            Self::Number(f64::INFINITY) => Ok(K::ANY),
            Self::Integer(_) | Self::Number(_) => match self.integer(0) {
                Ok(number) => Ok(K::Finite(FiniteK::new(u32::try_from(number).unwrap_or(u32::MAX))?)),
                Err(_) => Err(Wrong::Value(format!("expected {A_K}, found {self}"))),
            },
            other => Err(other.of_another_type(A_K)),
        }
    }

    pub(super) fn neighbors(&self) -> Result<K, Wrong> {
        Ok(K::from_neighbors(self.integer(0)?)?)
    }

    /// The value of an engine's option; `None` for a flag that is false.
    pub(super) fn option(&self, option: &EngineOption) -> Result<Option<OptionValue>, Wrong> {
        let text = match option.kind {
            ValueKind::Flag => return Ok(self.flag()?.then_some(OptionValue::Flag)),
            ValueKind::Heuristic => return Ok(Some(OptionValue::Heuristic(self.name()?))),
            #[cfg(feature = "publications")]
            ValueKind::Variant => return Ok(Some(OptionValue::Variant(self.name()?))),
            ValueKind::Number => self.integer(1)?.to_string(),
            ValueKind::Levels | ValueKind::Memory => match self {
                Self::Text(text) => text.to_string(),
                Self::Integer(number) => number.to_string(),
                Self::Number(number) => number.to_string(),
                other => return Err(other.of_another_type("a number or a text")),
            },
        };
        option.parse(&text).map(Some).map_err(Wrong::Value)
    }
}
