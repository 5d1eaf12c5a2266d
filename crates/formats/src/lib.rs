//! MovingAI maps and scenarios, read and written without loss; search traces; saved indexes.
//!
//! **The key decision: a parsed file keeps its bytes.** [`MapFile`] and [`Scenario`] hold the text that they were parsed
//! from beside what was found in it, so that writing gives back every byte (line ends, the order of the header, separators, the
//! digits of a length), and no list of remembered details can be incomplete. What is made in the program has its text made
//! with it, in the plainest form.
//!
//! Nothing is believed before it is seen: memory grows with the bytes that a file has, never with the sizes that it claims.
//! Each error names line and column (in bytes, both from 1), what was expected, what was found, and how to mend it.
//!
//! The formats of maps and scenarios are those of Sturtevant, *Benchmarks for Grid-Based Pathfinding* (2012). [`TraceWriter`]
//! streams a search for the Posthoc visualizer, [`IndexFile`] keeps what an engine preprocessed together with what it is good
//! for. Neither knows a search or an engine: they take plain values and bytes.
//!
//! What is not here: whether a start or a goal can be entered. That depends on placement, and is a question to the grid.

mod index;
mod map;
mod read;
mod scenario;
mod text;
mod trace;

pub use index::{IndexError, IndexFile, IndexKey, MapDigest, WriteError};
pub use map::{MapError, MapFile};
pub use read::{MAX_FILE_BYTES, ReadError};
pub use scenario::{Instance, Scenario, ScenarioError, ScenarioForOtherMap, scenario_tolerance};
pub use trace::{TraceEvent, TraceEventKind, TraceHeader, TraceWriter};
