//! Why an index is refused, or not saved.

use std::{io, path::PathBuf};

use mediant_grid::Rules;

use crate::MAX_FILE_BYTES;

use super::{
    MapDigest,
    header::{FORMAT_VERSION, NAME_FORM},
};

/// Bytes that are no index, or an index for something else.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum IndexError {
    /// The bytes do not begin as an index does.
    #[error(
        "expected an index as `mediant build` makes it, found {found} at its start; is this the file that you meant?"
    )]
    NotAnIndex {
        /// Its first bytes.
        found: String,
    },
    /// The container has another version.
    #[error("expected an index of format version {FORMAT_VERSION}, found version {found}; {BUILD_AGAIN}")]
    Format {
        /// The version.
        found: u32,
    },
    /// There are fewer or more bytes than the header says.
    #[error("expected an index of {expected} bytes, found {found}; copy the file again, or {BUILD_AGAIN}")]
    Length {
        /// The length by the header; at least that of an empty index.
        expected: u64,
        /// The number of bytes.
        found: u64,
    },
    /// The bytes are not those that were saved.
    #[error(
        "expected the checksum that was saved with the index, found another: the file is damaged; copy it again, or {BUILD_AGAIN}"
    )]
    Damaged,
    /// The checksum is right, but a field of the header has a value that it never has.
    #[error("expected {expected}, found {found}: another program wrote this index; {BUILD_AGAIN}")]
    Field {
        /// What the field may hold.
        expected: &'static str,
        /// What it holds.
        found: String,
    },
    /// An engine's name that cannot be saved.
    #[error("expected {NAME_FORM}, found {found}; give the engine a shorter or plainer name")]
    EngineName {
        /// The name.
        found: String,
    },
    /// The index of another engine.
    #[error(
        "expected an index of the engine {expected}, found one of {found}; choose that engine, or {BUILD_AGAIN}"
    )]
    Engine {
        /// The engine that is to use the index.
        expected: String,
        /// The engine that made it.
        found: String,
    },
    /// The same engine made it in another version.
    #[error("expected version {expected} of the {engine} index, found version {found}; {BUILD_AGAIN}")]
    EngineVersion {
        /// The engine.
        engine: String,
        /// The version that it reads.
        expected: u32,
        /// The version of the index.
        found: u32,
    },
    /// The index was built under other rules of motion.
    #[error(
        "expected an index for the rules `{expected}`, found one for `{found}`; choose those rules, or {BUILD_AGAIN}"
    )]
    Rules {
        /// The rules in use.
        expected: Rules,
        /// The rules of the index.
        found: Rules,
    },
    /// The index was built for another neighborhood.
    #[error(
        "expected an index for k = {}, found one for k = {}; choose that k, or {BUILD_AGAIN}",
        k_name(*expected),
        k_name(*found)
    )]
    K {
        /// The k in use.
        expected: Option<u32>,
        /// The k of the index.
        found: Option<u32>,
    },
    /// The index was built for another map.
    #[error(
        "expected an index for this map ({expected}), found one for another ({found}); name that map, or {BUILD_AGAIN}"
    )]
    Map {
        /// The map in use.
        expected: MapDigest,
        /// The map of the index.
        found: MapDigest,
    },
}

/// An index that cannot be saved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The path names something that is no regular file, which must not be replaced by one.
    #[error("{}: expected a regular file or none, found a directory or device; name a file to be made", path.display())]
    NotRegular {
        /// The file that was asked for.
        path: PathBuf,
    },
    /// The index is longer than what can be read.
    #[error("{}: expected an index of at most {MAX_FILE_BYTES} bytes, found {found}; split the map", path.display())]
    TooLarge {
        /// The file that was asked for.
        path: PathBuf,
        /// The number of bytes.
        found: u64,
    },
    /// The system refuses to write the file.
    #[error("{}: cannot be written: {source}", path.display())]
    Unwritable {
        /// The file that was asked for.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

const BUILD_AGAIN: &str = "build it again with `mediant build`";

/// The k as the program's option has it.
fn k_name(k: Option<u32>) -> String {
    k.map_or_else(|| "any".to_owned(), |k| k.to_string())
}
