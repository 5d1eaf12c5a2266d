//! The library for C with the programs of calls that its own test draws, for a fuzzing target.
//!
//! **The key decision: the sources of `crates/c` are compiled again, as modules of this package.** That
//! library is made for C alone and no Rust program links it; its programs of calls are test code, and need
//! the oracle.

#[path = "../../../c/src/about.rs"]
pub mod about;
#[path = "../../../c/src/answer.rs"]
pub mod answer;
#[path = "../../../c/src/batch.rs"]
pub mod batch;
#[path = "../../../c/src/bytes.rs"]
pub mod bytes;
#[path = "../../../c/src/code.rs"]
pub mod code;
#[path = "../../../c/src/failure.rs"]
pub mod failure;
#[path = "../../../c/src/field.rs"]
pub mod field;
#[path = "../../../c/src/find.rs"]
pub mod find;
#[path = "../../../c/src/goals.rs"]
pub mod goals;
#[path = "../../../c/src/handles.rs"]
pub mod handles;
#[path = "../../../c/src/index.rs"]
pub mod index;
#[path = "../../../c/src/map.rs"]
pub mod map;
#[path = "../../../c/src/memory.rs"]
pub mod memory;
#[path = "../../../c/src/paths.rs"]
pub mod paths;
#[path = "../../../c/src/planner.rs"]
pub mod planner;
#[path = "../../../c/src/points.rs"]
pub mod points;
#[path = "../../../c/src/space.rs"]
pub mod space;
#[path = "../../../c/src/watch.rs"]
pub mod watch;
#[path = "../../../c/src/words.rs"]
pub mod words;

// Parts of it serve the test of seeds.
#[allow(dead_code, unused_imports, reason = "programs of seeds are run by the test in crates/c")]
#[path = "../../../c/src/mistakes/mod.rs"]
mod mistakes;
mod run;

pub use run::run;
