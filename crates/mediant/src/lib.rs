//! Pathfinding on uniform-cost grids over the 2^k neighborhoods: every engine of Mediant behind one door.
//!
//! - A [`Map`] says which cells are blocked.
//! - With a [`Motion`] (k, the placement of vertices, the rule of motion) it is a [`Space`].
//! - An [`Index`] is what an [`Engine`] prepares in a space.
//! - A [`Planner`] answers one [`Query`] after another on an index: one for each thread.
//!
//! ```
//! use mediant::{Engine, K, Map, Motion, Query};
//!
//! let map = Map::from_fn(9, 9, |x, y| x == 4 && y != 8)?;
//! // At once, over eight directions between the centers of cells:
//! let path = map.path((0, 0), (8, 0))?.expect("there is a way");
//! // Prepared, at any angle between the corners of cells:
//! let index = map.space(Motion::corners(K::ANY))?.prepare(Engine::Subgoal)?;
//! let answer = index.planner().find(Query::new((0, 0), (9, 0)))?;
//! assert!(answer.path().is_some_and(|shortest| shortest.cost() < 19.0));
//! # assert!(path.cost() > 16.0);
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! [`Space::engine_for`] says which engine we would take for how many paths: what people write as `auto`
//! ([`EngineName`]), which is not an engine itself, since it has no guarantee and no index before it is
//! known what is asked.
//!
//! A query can have wishes ([`Request`]): several ends, a tolerance, the nearest reachable vertex, limits. A
//! search can go on [in steps](Planner#a-search-in-steps). [`Planner::distance`] measures without the path,
//! [`Planner::distances`] and [`Planner::nearest`] to many [`Goals`]. A [`Field`] has the distances of all
//! vertices, a [`Table`] those from many to many; a [`Map`] can be that of a disc or a square, which a
//! [`Disc`] keeps right among obstacles that change; [`Exceptions`] are cells that count otherwise for one
//! query; a [`Path`] says whether it still holds ([`Space::check`]).
//!
//! Whatever can take long can be stopped by a flag or a deadline: a search by its [`Limits`], all else by
//! the same call of [`Within`], such as `space.within(&limits).prepare(engine)`. The answer says what it was
//! doing ([`Error::Stopped`]).
//!
//! Handles own what they need: no lifetime and no type parameter reaches the user. Maps, spaces and indexes
//! never change, their clones share them, and all threads may use them. Every error has a stable
//! [code](Error::code), and nothing panics on bad input.
//!
//! # The key decision: closed enums outside, types inside
//!
//! A program chooses its engine at run time, but a search is fast only if it is compiled for its placement,
//! its heuristic and its kind of successors. So outside, an engine is a value of a closed enum, and planners
//! of all engines have one type; a query is one dynamic call. Inside, each search has its types, and nothing
//! in its loop is dynamic, except an observer if there is one. `make.rs` leads from the one to the other,
//! with a line for each engine. A closed enum also lets the compiler find every place that a new engine must
//! fill in. The typed crates stay for those who want them: `mediant-search`, `mediant-subgoal`,
//! `mediant-hierarchy`.
//!
//! # What belongs together
//!
//! Maps, spaces and indexes carry their [`Identity`]: a digest of the map's cells, the rules, the k. Whatever
//! joins two of them compares these in constant time, and answers with [`Error::Mismatch`], which names both.
//!
//! # Adding an engine or an option
//!
//! An engine is a variant of [`Engine`] with its [`Capabilities`], a variant of [`ConfiguredEngine`], what it
//! prepares (`index/`), and the line that makes its search (`make.rs`).
//!
//! An option, with a value of a [`ValueKind`] that exists, touches three files:
//! 1. `option/description.rs`: its name, texts and samples, and its place in [`EngineOption::ALL`];
//! 2. `configured.rs`: its field, its line in `ConfiguredEngine::slots`, and in `ConfiguredEngine::value` its
//!    default if it has one;
//! 3. its use, in `make.rs` if it changes the search, or in `index/` if it changes what is prepared.
//!
//! The text of setups, [`Setup::all`] of the test suites, and the flags, help, records and tables of the
//! program follow. Only tests that pin numbers of setups, lists of options or snapshots change with it. An
//! option that rules out another one also needs a [`SetupError`].
//!
//! # What is not here
//!
//! Clocks, threads (but for the feature `parallel`, which prepares subgoal graphs on all cores), and output.

mod absent;
mod agent;
mod capabilities;
mod choice;
mod code;
mod configured;
mod demand;
mod engine;
mod erased;
mod error;
pub mod errors;
mod exceptions;
mod field;
pub mod files;
mod goals;
mod heuristic;
mod index;
mod make;
mod map;
mod motion;
mod names;
mod option;
mod path_check;
mod planner;
mod planners;
#[cfg(doctest)]
mod readme;
mod scratch;
#[cfg(feature = "serde")]
mod serialized;
mod setup;
mod setup_error;
mod shared_rules;
mod space;
mod suite;
mod table;
mod text;
#[cfg(feature = "trace")]
mod trace;
mod within;

pub use agent::{Disc, WidestPath};
pub use capabilities::Capabilities;
pub use choice::Choice;
pub use code::ErrorCode;
pub use configured::{
    CanonicalOptions, ChpaOptions, ConfiguredEngine, GuidedOptions, HpaOptions, JpsPlusOptions, JumpOptions,
    SubgoalOptions, SubgoalThetaOptions,
};
pub use demand::{Demand, EngineName};
pub use engine::Engine;
pub use error::Error;
pub use exceptions::{ExceptedAnswer, Exceptions};
pub use field::{Field, Fields};
pub use goals::Goals;
pub use index::{Index, Origin};
pub use map::Map;
pub use mediant_grid::{
    Clearance, CornerRule, DiagonalGap, Fit, Grid, Identity, MapId, Mismatch, Obstruction, Outside,
    PlacementKind, Rectangle, Rules, Vertex,
};
pub use mediant_moves::{Cost, FiniteK, K, Vector};
pub use mediant_search::{
    BrokenPath, Counters, End, Guarantee, Limit, Limits, NodeEvent, Observer, Outcome, Path, Query,
    QueryError, Request, Smoothing, Stopped, Turn,
};
pub use mediant_subgoal::{Progress, Stage};
pub use motion::{IntoK, Motion};
pub use names::UnknownName;
pub use option::{
    EngineOption, HeuristicName, Levels, Memory, OptionValue, UnknownLevels, UnknownMemory, ValueKind,
    Variant,
};
pub use planner::Planner;
pub use planners::{BatchProgress, Planners};
pub use setup::Setup;
pub use setup_error::SetupError;
pub use space::Space;
pub use table::Table;
pub use text::TextError;
#[cfg(feature = "trace")]
pub use trace::Tracer;
pub use within::Within;
