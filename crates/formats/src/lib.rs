//! Reads and writes MovingAI maps and scenarios without loss. Features add saved indexes and search traces.
//!
//! **The key decision: a parsed file keeps its bytes.** [`MapFile`] and [`Scenario`] hold the text from which
//! they were parsed beside what the parser found in it. So writing gives back every byte: line ends, the
//! order of the header, separators, the digits of a length. A parser that kept these as properties could
//! forget one. A map made from a grid, or a scenario made from a list of queries, gets its text at once, in
//! the plainest form.
//!
//! Input is not trusted: memory grows with the bytes that a file has, never with the sizes that it states.
//! Each error names the line and the column (in bytes, both from 1), what was expected, what was found, and
//! how to mend it.
//!
//! The formats of maps and scenarios are those of Sturtevant, *Benchmarks for Grid-Based Pathfinding* (2012).
//!
//! | feature | adds | compiles in addition |
//! |---|---|---|
//! | none | [`MapFile`], [`Scenario`] | `mediant-grid`, `thiserror` |
//! | `index` | `IndexFile`: what an engine preprocessed, saved for later runs | `sha2`, `tempfile` |
//! | `trace` | `TraceWriter`: a search, for the Posthoc visualizer | `serde`, `serde_json` |
//!
//! No feature is on by default, and none changes what is there without it.
//!
//! What is not here: searches and engines. Indexes and traces are made of names, numbers and bytes. It is not
//! checked whether a query's start or goal is free, since that depends on where the vertices are.

#[cfg(feature = "index")]
mod index;
mod map;
mod read;
#[cfg(doctest)]
mod readme;
mod scenario;
mod text;
#[cfg(feature = "trace")]
mod trace;

#[cfg(feature = "index")]
pub use index::{IndexError, IndexFile, IndexKey, WriteError};
pub use map::{MapError, MapFile};
pub use read::{MAX_FILE_BYTES, ReadError};
pub use scenario::{Instance, MapMismatch, Scenario, ScenarioError, scenario_tolerance};
#[cfg(feature = "trace")]
pub use trace::{TraceEvent, TraceEventKind, TraceHeader, TraceWriter};
