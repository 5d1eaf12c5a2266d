//! The catalog of engines: the one list of them, from which the program, the benches, the chores and the test suites take theirs.
//!
//! A [`Setup`] says which [`Engine`] searches, over which k, under which rules of motion, and how its paths are smoothed; it is
//! refused with a [`SetupError`] where these do not fit. A [`SearchSpace`] is the map for one k and one rule, an [`Index`] what the
//! engine prepares of it, a [`BoxedPlanner`] what answers queries on the index.
//!
//! **The key decision: closed enums outside, types inside.** Each search is compiled for its placement, its heuristic and its
//! kind of successors, so that nothing in it is dynamic. A query is one dynamic call: what a program holds has no type
//! parameter.
//!
//! To add an engine: a variant of [`EngineKind`] and of [`Engine`], its [`Capabilities`], what it prepares (`index`), and the
//! line that makes its planner (`make.rs`). To add an option: its description (`engine/option.rs`), its field
//! (`engine/options.rs`), and its use in `make.rs` or `index`. Setups as text, the program's flags, help, records and tables, and the
//! suites follow.
//!
//! What is not here: files and clocks. An index comes and goes as bytes; who wants to know how long it took, measures.

mod distances;
mod engine;
mod error;
mod heuristic;
mod index;
mod levels;
mod make;
mod names;
mod planner;
mod rules;
mod setup;
mod space;
mod text;

pub use distances::distances;
pub use engine::{
    CanonicalOptions, Capabilities, ChpaOptions, Engine, EngineKind, EngineOption, GuidedOptions, HpaOptions,
    JpsPlusOptions, JumpOptions, OptionValue, SubgoalOptions, ValueKind,
};
pub use error::{EngineError, SetupError};
pub use index::Index;
pub use levels::{Levels, UnknownLevels};
pub use mediant_subgoal::{Progress, Stage};
pub use names::{HeuristicName, UnknownName, Variant};
pub use planner::BoxedPlanner;
pub use rules::SharedRules;
pub use setup::Setup;
pub use space::SearchSpace;
pub use text::TextError;
