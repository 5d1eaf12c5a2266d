//! Why a parameter cannot have a value.

use mediant_grid::names::UnknownName;
use mediant_moves::KError;

use super::{Parameter, Spelling, wrong::Wrong};
use crate::setup_error::SetupError;

/// The error for the parameters of a call. `Display` writes names in kebab-case, [`text`](Self::text) as
/// another language does.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CallError {
    /// A value of another type.
    #[error("{}: expected {expected}, found {found}", parameter.name)]
    Type {
        /// The parameter.
        parameter: &'static Parameter,
        /// In words, what it takes.
        expected: String,
        /// In words, what was given.
        found: String,
    },
    /// A value of the right type that it cannot have.
    #[error("{}: {wrong}", parameter.name)]
    Value {
        /// The parameter.
        parameter: &'static Parameter,
        /// In words, what was expected and found.
        wrong: String,
    },
    /// A name that does not exist.
    #[error("{}: {error}", parameter.name)]
    Name {
        /// The parameter.
        parameter: &'static Parameter,
        /// The names that exist.
        error: UnknownName,
    },
    /// A number that is no k.
    #[error("{}", of_k(parameter, error))]
    K {
        /// The parameter.
        parameter: &'static Parameter,
        /// Why not.
        error: KError,
    },
    /// A parameter that does not go with another one.
    #[error("{}: {why}", parameter.name)]
    Together {
        /// The parameter.
        parameter: &'static Parameter,
        /// Why not.
        why: &'static str,
    },
    /// An engine that does not take the motion or the options.
    #[error(transparent)]
    Setup(#[from] SetupError),
}

/// The text of an error of k, which names k itself.
fn of_k(parameter: &Parameter, error: &KError) -> String {
    match error {
        KError::Neighbors { .. } => format!("{}: {error}", parameter.name),
        _ => error.to_string(),
    }
}

impl CallError {
    /// The parameter, if the error is that of a single one.
    #[must_use]
    pub const fn parameter(&self) -> Option<&'static Parameter> {
        match self {
            Self::Type { parameter, .. }
            | Self::Value { parameter, .. }
            | Self::Name { parameter, .. }
            | Self::K { parameter, .. }
            | Self::Together { parameter, .. } => Some(parameter),
            Self::Setup(_) => None,
        }
    }

    /// The text of the error without the parameter's name.
    #[must_use]
    pub fn wrong(&self) -> String {
        let text = self.to_string();
        let named =
            self.parameter().and_then(|parameter| text.strip_prefix(parameter.name)?.strip_prefix(": "));
        named.map_or(text.clone(), str::to_owned)
    }

    /// The text of the error, with the parameter's name as a language spells it.
    #[must_use]
    pub fn text(&self, spelling: Spelling) -> String {
        let text = self.to_string();
        let Some(parameter) = self.parameter() else { return text };
        match text.strip_prefix(parameter.name) {
            Some(rest) => format!("{}{rest}", parameter.spelled(spelling)),
            None => text,
        }
    }
}

impl CallError {
    /// The error of a parameter with this mistake.
    pub(super) fn of(parameter: &'static Parameter, wrong: Wrong) -> Self {
        match wrong {
            Wrong::Type { expected, found } => Self::Type { parameter, expected, found },
            Wrong::Value(wrong) => Self::Value { parameter, wrong },
            Wrong::Name(error) => Self::Name { parameter, error },
            Wrong::K(error) => Self::K { parameter, error },
        }
    }
}
