//! The files of a folder.

use std::{
    fs,
    path::{Path, PathBuf},
};

use crate::Error;

/// The files of a folder whose names end in `ending`, sorted.
///
/// # Errors
/// [`Error::Io`] for a folder that cannot be listed.
pub fn files(folder: &Path, ending: &str) -> Result<Vec<PathBuf>, Error> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(Error::at(folder))? {
        let path = entry.map_err(Error::at(folder))?.path();
        if path.to_string_lossy().ends_with(ending) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}
