//! The options of each engine: their descriptions, fields and values.

use std::num::NonZeroU32;

use super::{
    description::EngineOption,
    levels::Levels,
    memory::Memory,
    table::HEURISTIC,
    value::{HeuristicName, OptionValue},
};
#[cfg(feature = "publications")]
use super::{published::VARIANT, value::Variant};
use crate::{engine::Engine, setup_error::SetupError};

/// The options of an engine. Setups as text, the program's flags and its records know them from this list
/// alone.
pub(crate) trait Options {
    /// The options, in the order of a setup's text.
    fn slots(&mut self) -> Vec<Slot<'_>>;

    /// Checks that they fit together.
    fn check(&self, _engine: Engine) -> Result<(), SetupError> {
        Ok(())
    }
}

/// An option, the field that holds it, and the value that it has.
pub(crate) struct Slot<'e> {
    pub(crate) option: &'static EngineOption,
    pub(crate) field: Field<'e>,
    /// Chosen or by default; `None` if the default is no value.
    pub(crate) value: Option<OptionValue>,
}

impl<'e> Slot<'e> {
    /// An option without a default.
    pub(crate) fn new(option: &'static EngineOption, field: Field<'e>) -> Self {
        let value = field.get();
        Self { option, field, value }
    }

    /// The heuristic of a search, by default h_k.
    pub(crate) fn heuristic(field: &'e mut Option<HeuristicName>) -> Self {
        let value = OptionValue::Heuristic(field.unwrap_or_default());
        Self::new(&HEURISTIC, Field::Heuristic(field)).with_value(Some(value))
    }

    /// The variant of an engine.
    #[cfg(feature = "publications")]
    pub(crate) fn variant(field: &'e mut Option<Variant>, default: Variant) -> Self {
        let value = OptionValue::Variant(field.unwrap_or(default));
        Self::new(&VARIANT, Field::Variant(field)).with_value(Some(value))
    }

    /// The option with the value that it has, chosen or not.
    pub(crate) fn with_value(self, value: Option<OptionValue>) -> Self {
        Self { value, ..self }
    }
}

/// The field of an engine's options that holds the value of an option.
#[cfg_attr(not(feature = "publications"), expect(dead_code, reason = "no option of users is a flag"))]
pub(crate) enum Field<'e> {
    Flag(&'e mut bool),
    Number(&'e mut Option<NonZeroU32>),
    Heuristic(&'e mut Option<HeuristicName>),
    #[cfg(feature = "publications")]
    Variant(&'e mut Option<Variant>),
    Levels(&'e mut Option<Levels>),
    Memory(&'e mut Option<Memory>),
}

impl Field<'_> {
    /// The value, if it was chosen.
    pub(crate) fn get(&self) -> Option<OptionValue> {
        match self {
            Self::Flag(is_set) => is_set.then_some(OptionValue::Flag),
            Self::Number(number) => number.map(OptionValue::Number),
            Self::Heuristic(name) => name.map(OptionValue::Heuristic),
            #[cfg(feature = "publications")]
            Self::Variant(variant) => variant.map(OptionValue::Variant),
            Self::Levels(levels) => levels.map(OptionValue::Levels),
            Self::Memory(memory) => memory.map(OptionValue::Memory),
        }
    }

    /// Chooses a value. Returns false if it is of another kind than the field.
    pub(crate) fn set(self, value: OptionValue) -> bool {
        match (self, value) {
            (Self::Flag(slot), OptionValue::Flag) => *slot = true,
            (Self::Number(slot), OptionValue::Number(number)) => *slot = Some(number),
            (Self::Heuristic(slot), OptionValue::Heuristic(name)) => *slot = Some(name),
            #[cfg(feature = "publications")]
            (Self::Variant(slot), OptionValue::Variant(variant)) => *slot = Some(variant),
            (Self::Levels(slot), OptionValue::Levels(levels)) => *slot = Some(levels),
            (Self::Memory(slot), OptionValue::Memory(memory)) => *slot = Some(memory),
            _ => return false,
        }
        true
    }
}
