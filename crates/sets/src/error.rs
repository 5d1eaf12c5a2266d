//! Errors of a benchmark set, whose messages are one line each.

use std::{
    io,
    path::{Path, PathBuf},
};

/// A benchmark set that cannot be provided or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A set that the manifest does not list.
    #[error("unknown set `{name}`: the manifest lists {known}")]
    UnknownSet {
        /// The name that was asked for.
        name: String,
        /// All names.
        known: String,
    },
    /// No answer from the server.
    #[error(
        "{url}: {source}; check the network, or name a folder or site that holds the same files by --mirror"
    )]
    Network {
        /// The address.
        url: String,
        /// Why there was no answer.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The server or the mirror folder does not hold the file.
    #[error("{place}: not there; check --mirror, or leave the set out by --set")]
    Absent {
        /// The address or path.
        place: String,
    },
    /// The server refuses.
    #[error("{url}: expected the file, found HTTP status {status}; try again later or use --mirror")]
    Status {
        /// The address.
        url: String,
        /// The code of the answer.
        status: u16,
    },
    /// The connection ended before the file did.
    #[error("{url}: cut off after {found} of {expected} bytes; run again to resume")]
    Cut {
        /// The address.
        url: String,
        /// The bytes that are on disk.
        found: u64,
        /// The length that the server announced, or `?`.
        expected: String,
    },
    /// A file that is no whole zip archive.
    #[error("{name}: not a whole zip archive: {why}")]
    Zip {
        /// The archive.
        name: String,
        /// The reader's message.
        why: String,
    },
    /// An error in archives that were downloaded.
    #[error("{0}; the download is discarded, run again to fetch it anew")]
    Discarded(Box<Error>),
    /// An archive that should not be unpacked.
    #[error("{name}: {why}; do not use this archive")]
    Archive {
        /// The archive.
        name: String,
        /// The fault.
        why: String,
    },
    /// Files that are not those of the manifest.
    #[error("set {set}: {why}; the files differ from the manifest: fetch them from another place")]
    Differs {
        /// The set.
        set: String,
        /// The first difference.
        why: String,
    },
    /// A map or scenario that cannot be read.
    #[error(transparent)]
    Format(#[from] mediant_formats::ReadError),
    /// A scenario beside a map that it was not made for.
    #[error("{file}: {source}")]
    OtherMap {
        /// The scenario.
        file: String,
        /// How they differ.
        source: mediant_formats::MapMismatch,
    },
    /// A manifest that cannot be read.
    #[error("{}: {source}; write it anew by `cargo xtask download --write-manifest`", path.display())]
    Manifest {
        /// The manifest.
        path: PathBuf,
        /// The fault.
        source: serde_json::Error,
    },
    /// A file or folder that the system refuses.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
}

impl Error {
    /// Names the file or folder that an error of the system is about.
    pub fn at(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Io { path: path.to_owned(), source }
    }
}
