//! The options of engines: what is known of each, and what values they take.

mod description;
mod levels;
mod value;

pub use description::EngineOption;
pub(crate) use description::{
    DETOUR, HEURISTIC, JUMP_LIMIT, KEEP_INTERMEDIATE, LEVELS, SECOND, SIDE, STEP, UNSTRAIGHTENED, VARIANT,
};
pub use levels::{Levels, UnknownLevels};
pub use value::{HeuristicName, OptionValue, ValueKind, Variant};
