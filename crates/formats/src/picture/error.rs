//! Why a picture was not written.

use std::path::PathBuf;

use crate::save::WriteError;

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
    #[error(transparent)]
    Write(#[from] WriteError),
}
