//! The catalog of engines: the one list of them, from which the program, the benches, the chores and the test suites take theirs.
//!
//! A [`Setup`] names an [`Engine`], what it searches (k, placement, rule) and its [`Options`], and is refused with a
//! [`SetupError`] where the two do not fit. [`with_planner`] makes the planner and hands it to a [`Visit`], [`with_planner_on`] does so
//! on a [`Ground`] that several planners share.
//!
//! **The key decision: a closed enum outside, types inside.** A visitor is compiled for each planner, so that a search is free
//! of dynamic calls. Who must hold several planners at once takes [`Solver`]s: one dynamic call a query, none within it.
//!
//! To add an engine: a variant of [`Engine`] with what is to be known of it (`engine.rs`), the line that makes its planner
//! (`planner.rs`, or `subgoal.rs` on a subgoal graph, `squares.rs` on a graph of clusters or segments), and whether it uses the pruning rule (`rule.rs`).
//!
//! What is not here: files. An index comes and goes as bytes.

mod distances;
mod engine;
mod error;
mod ground;
mod levels;
mod names;
mod planner;
mod rule;
mod setup;
mod solver;
mod squares;
mod subgoal;
mod text;

pub use distances::distances;
pub use engine::{About, Engine};
pub use error::{EngineError, SetupError};
pub use ground::Ground;
pub use levels::{Levels, UnknownLevels, hierarchy_name};
pub use mediant_subgoal::{Hierarchy, Progress, Stage};
pub use names::{HeuristicName, UnknownName, Variant};
pub use planner::{
    Prebuilt, Preprocessing, Visit, build, build_with_progress, with_planner, with_planner_on,
};
pub use rule::{SharedRule, SharedRules};
pub use setup::{Options, Setup};
pub use solver::Solver;
pub use text::TextError;
