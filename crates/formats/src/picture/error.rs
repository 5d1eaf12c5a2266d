//! Why a picture was not written.

use std::{io, path::PathBuf};

/// A picture that was not written.
///
/// Needs the feature `picture`.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The name of the file does not tell the format.
    #[error("{}: expected a name that ends in .png or .svg", path.display())]
    Extension {
        /// The file.
        path: PathBuf,
    },
    /// The file cannot be written.
    #[error("{}: the picture cannot be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
}
