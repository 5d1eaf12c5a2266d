//! The failures of drawing and building the guide.

use std::{io, path::PathBuf};

/// A failure to draw or build the guide.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GuideError {
    /// A figure whose search fails.
    #[error("a figure: {0}")]
    Figure(#[from] mediant::Error),
    /// A file or folder that cannot be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// The fault.
        source: io::Error,
    },
    /// Figures that are not those of today's engines.
    #[error("not as they are drawn today: {0}; cargo xtask guide draws them")]
    Old(String),
    /// Links that lead nowhere, and pages that the table of contents does not have.
    #[error("{0}")]
    Links(String),
    /// mdBook is not there.
    #[error("mdBook is not here: cargo install mdbook --locked")]
    NoMdbook,
    /// mdBook refuses the book.
    #[error("mdbook build failed")]
    Mdbook,
}

impl GuideError {
    pub(crate) fn at(path: impl Into<PathBuf>) -> impl FnOnce(io::Error) -> Self {
        let path = path.into();
        |source| Self::Io { path, source }
    }
}
