//! The engines: their names, their options, and what is to be known of each.

mod capabilities;
mod kind;
mod option;
mod options;

pub use capabilities::Capabilities;
pub use kind::EngineKind;
pub use option::{EngineOption, OptionValue, ValueKind};
pub(crate) use option::{LEVELS, SIDE};
pub use options::{
    CanonicalOptions, ChpaOptions, Engine, GuidedOptions, HpaOptions, JpsPlusOptions, JumpOptions,
    SubgoalOptions,
};
