//! Why an index is refused.

use mediant_grid::{Interrupted, Mismatch};

use super::layout::{FORMAT_VERSION, NAME_FORM};

/// Why an index is refused: the bytes are none, or the index was built for something else.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum IndexError {
    /// The bytes do not begin like an index.
    #[error("expected a saved index, found {found} at its start; is this the file that you meant?")]
    NotAnIndex {
        /// The first bytes, quoted.
        found: String,
    },
    /// The file has another version of the format.
    #[error("expected an index of format version {FORMAT_VERSION}, found version {found}; {PREPARE_AGAIN}")]
    Format {
        /// The version.
        found: u32,
    },
    /// The file has fewer or more bytes than its header states.
    #[error("expected an index of {expected} bytes, found {found}; copy the file again, or {PREPARE_AGAIN}")]
    Length {
        /// The length that the header states, or that of an empty index if the header is cut short.
        expected: u64,
        /// The number of bytes.
        found: u64,
    },
    /// Reading was stopped.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
    /// The checksum is wrong: the bytes are not those that were saved.
    #[error(
        "expected the checksum that was saved with the index, found another: the file is damaged; copy it \
         again, or {PREPARE_AGAIN}"
    )]
    Damaged,
    /// The checksum is right, but a field of the header has a value that it cannot have.
    #[error("expected {expected}, found {found}: another program wrote this index; {PREPARE_AGAIN}")]
    Field {
        /// The values that the field can have.
        expected: &'static str,
        /// Its value, quoted.
        found: String,
    },
    /// An engine's name that cannot be saved.
    #[error("expected {NAME_FORM}, found {found}; give the engine a shorter or plainer name")]
    EngineName {
        /// The name.
        found: String,
    },
    /// The index was built by another engine.
    #[error(
        "expected an index of the engine {expected}, found one of {found}; choose that engine, or \
         {PREPARE_AGAIN}"
    )]
    Engine {
        /// The engine that is to use the index.
        expected: String,
        /// The engine that built it.
        found: String,
    },
    /// The index was built by another version of the engine.
    #[error("expected version {expected} of the {engine} index, found version {found}; {PREPARE_AGAIN}")]
    EngineVersion {
        /// The engine.
        engine: String,
        /// The version that it reads.
        expected: u32,
        /// The version of the index.
        found: u32,
    },
    /// The index was built for another map, other rules of motion or another k.
    #[error(transparent)]
    Mismatch(#[from] Mismatch),
}

const PREPARE_AGAIN: &str = "prepare it again";
