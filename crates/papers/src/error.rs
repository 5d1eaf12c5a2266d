//! Errors of a reproduction, whose messages are one line each.

use std::{
    io,
    path::{Path, PathBuf},
};

/// A reproduction that failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A table that could not be reproduced.
    #[error("{0}")]
    Reproduce(String),
    /// A benchmark set that cannot be provided.
    #[error(transparent)]
    Set(#[from] mediant_sets::Error),
    /// A map or scenario that cannot be read.
    #[error(transparent)]
    Read(#[from] mediant_formats::ReadError),
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
