//! Engines with their options, and the table of engines.

#[cfg(feature = "publications")]
pub use crate::option::Variant;
pub use crate::{
    capabilities::{Capabilities, Promise},
    configured::ConfiguredEngine,
    engine_name::EngineName,
    engines::{
        CanonicalOptions, ChpaOptions, GuidedOptions, HpaOptions, JpsPlusOptions, JumpOptions,
        LandmarkOptions, SubgoalOptions, SubgoalThetaOptions,
    },
    option::{
        EngineOption, HeuristicName, Levels, Memory, OptionValue, UnknownLevels, UnknownMemory, ValueKind,
    },
};
