//! The catalog of engines: programs, benchmarks and test suites take all engines from this one list.
//!
//! - A [`Setup`] is an [`ConfiguredEngine`] with its options, a k, rules of motion and a smoothing. It is refused with
//!   a [`SetupError`] if these do not fit together.
//! - A [`Space`] is a map prepared for one k and one rule of motion.
//! - An [`Index`] is what the engine prepares in that space.
//! - A [`Planner`] answers queries on an index.
//!
//! ```
//! use std::sync::Arc;
//! use mediant::{Planner, SharedRules};
//! use mediant_grid::Grid;
//! use mediant_search::Query;
//!
//! let grid = Arc::new(Grid::from_fn(9, 9, |x, y| x == 4 && y != 8)?);
//! let mut planner = Planner::new("jps:3:never,limit=16".parse()?, &grid, &SharedRules::new())?;
//! let outcome = planner.solve(Query::new((0, 0), (8, 0)))?;
//! assert!(outcome.path().is_some());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The key decision: closed enums outside, types inside
//!
//! A program chooses its engine at run time, but a search is fast only if it is compiled for its placement,
//! its heuristic and its kind of successors. So outside, an engine is a value of a closed enum, and planners
//! of all engines have one type; a query is one dynamic call. Inside, each search has its types, and nothing
//! in its loop is dynamic, except an observer if there is one. `make.rs` leads from the one to the other,
//! with a line for each engine. A closed enum also lets the compiler find every place that a new engine must
//! fill in.
//!
//! # Adding to the catalog
//!
//! An engine is a variant of [`Engine`] with its [`Capabilities`], a variant of [`ConfiguredEngine`], what it
//! prepares (`index/`), and the line that makes its planner (`make.rs`).
//!
//! An option, with a value of a [`ValueKind`] that exists, touches three files:
//! 1. `option/description.rs`: its name, texts and samples, and its place in [`EngineOption::ALL`];
//! 2. `engine.rs`: its field, its line in `ConfiguredEngine::slots`, and in `ConfiguredEngine::value` its default if it has one;
//! 3. its use, in `make.rs` if it changes the search, or in `index/` if it changes what is prepared.
//!
//! The text of setups, [`Setup::all`] of the test suites, and the flags, help, records and tables of the
//! program follow. Only tests that pin numbers of setups, lists of options or snapshots change with it. An
//! option that rules out another one also needs a [`SetupError`].
//!
//! # What is not here
//!
//! Files and clocks. An index is written to bytes and read from them; whoever wants to know how long that
//! takes, measures.

mod capabilities;
mod configured;
mod distances;
mod engine;
mod error;
mod heuristic;
mod index;
mod make;
mod names;
mod option;
mod planner;
mod setup;
mod shared_rules;
mod space;
mod suite;
mod text;

pub use capabilities::Capabilities;
pub use configured::{
    CanonicalOptions, ChpaOptions, ConfiguredEngine, GuidedOptions, HpaOptions, JpsPlusOptions, JumpOptions,
    SubgoalOptions,
};
pub use distances::distances;
pub use engine::Engine;
pub use error::{EngineError, SetupError};
pub use index::Index;
pub use mediant_subgoal::{Progress, Stage};
pub use names::UnknownName;
pub use option::{EngineOption, HeuristicName, Levels, OptionValue, UnknownLevels, ValueKind, Variant};
pub use planner::Planner;
pub use setup::Setup;
pub use shared_rules::SharedRules;
pub use space::Space;
pub use text::TextError;
