//! Fuzzing targets: functions of bytes that panic when something is wrong.
//!
//! **The key decision: a target states what must hold, not only that nothing panics.** What is read is
//! written and read again, and is equal; two ways to read one file agree; a loaded index answers, and its
//! paths are legal by the oracle's definition. So a fuzzer, which knows nothing of paths, finds wrong
//! answers as well.
//!
//! The targets know no fuzzer. `src/bin/targets.rs` hands them to libFuzzer, which counts the edges of the
//! code that an input reaches and keeps inputs that reach new ones; `tests/replay.rs` runs the kept inputs,
//! and changed ones by seed, with stable Rust. `cargo xtask fuzz` runs all targets and keeps the record in
//! `docs/proof/fuzzing.json`.
//!
//! Few targets, and each broad: a first byte often chooses what the rest is. Each target is fuzzed until
//! half an hour passes without a new edge, so that many would take days.

mod bytes;
mod costmaps;
mod costs;
mod indexes;
mod maps;
mod numbers;
mod pictures;
mod rasters;
mod scenarios;
mod seeds;
mod sequence;
mod serialized;
mod target;
mod walk;
mod words;

pub use seeds::{kept, seeds};
pub use target::{TARGETS, Target};
