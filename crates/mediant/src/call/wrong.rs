//! The mistake in a value, before it is known which parameter has it.

use mediant_grid::names::UnknownName;
use mediant_moves::KError;

/// The error of a value, before its parameter is known.
#[derive(Debug)]
pub(super) enum Wrong {
    Type { expected: String, found: String },
    Value(String),
    Name(UnknownName),
    K(KError),
}

impl From<UnknownName> for Wrong {
    fn from(error: UnknownName) -> Self {
        Self::Name(error)
    }
}

impl From<KError> for Wrong {
    fn from(error: KError) -> Self {
        Self::K(error)
    }
}
