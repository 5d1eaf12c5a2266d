//! The options of engines: what is known of each, and what values they take.

pub(crate) mod description;
mod levels;
mod memory;
pub(crate) mod slot;
mod value;

pub use description::EngineOption;
pub use levels::{Levels, UnknownLevels};
pub use memory::{Memory, UnknownMemory};
pub use value::{HeuristicName, OptionValue, ValueKind, Variant};
