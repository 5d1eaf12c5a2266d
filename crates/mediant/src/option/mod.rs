//! The options of engines: what is known of each, and what values they take.

pub(crate) mod description;
mod levels;
mod memory;
#[cfg(feature = "publications")]
pub(crate) mod published;
pub(crate) mod slot;
pub(crate) mod table;
mod value;

pub use description::EngineOption;
pub use levels::{Levels, UnknownLevels};
pub use memory::{Memory, UnknownMemory};
#[cfg(feature = "publications")]
pub use value::Variant;
pub use value::{HeuristicName, OptionValue, ValueKind};

/// A value with the feature `publications`, and one without.
macro_rules! if_published {
    ($with:expr, else $without:expr) => {{
        #[cfg(feature = "publications")]
        {
            $with
        }
        #[cfg(not(feature = "publications"))]
        {
            $without
        }
    }};
}

pub(crate) use if_published;
