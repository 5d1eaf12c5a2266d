//! Finding the files of the benchmark sets.

use std::{
    fs::{self, File},
    io::{self, Read},
    path::{Path, PathBuf},
};

use mediant_formats::MAX_FILE_BYTES;

/// Folders that hold benchmark sets, unpacked or as the zip archives in which the sets are published.
///
/// In each of them, a file of the set SET is looked for in the folder `SET` and all folders below it, then
/// anywhere in `SET-map.zip` or `SET-scen.zip`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Archive {
    folders: Vec<PathBuf>,
}

/// A file or folder of a set that exists, but cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{}: {source}", path.display())]
pub struct ArchiveError {
    path: PathBuf,
    source: io::Error,
}

impl Archive {
    /// An archive of these folders, which need not exist. A file is taken from the first that has it.
    #[must_use]
    pub fn new(folders: impl IntoIterator<Item = PathBuf>) -> Self {
        Self { folders: folders.into_iter().collect() }
    }

    /// The content of `NAME.map`, a map of a set; `None` if no folder has it.
    ///
    /// # Errors
    /// [`ArchiveError`] when a folder or file cannot be read.
    pub fn map(&self, set: &str, name: &str) -> Result<Option<Vec<u8>>, ArchiveError> {
        self.find(set, "map", &format!("{name}.map"))
    }

    /// The content of `NAME.map.scen`, a map's scenario; `None` if no folder has it.
    ///
    /// # Errors
    /// [`ArchiveError`] when a folder or file cannot be read.
    pub fn scenario(&self, set: &str, name: &str) -> Result<Option<Vec<u8>>, ArchiveError> {
        self.find(set, "scen", &format!("{name}.map.scen"))
    }

    fn find(&self, set: &str, kind: &str, file: &str) -> Result<Option<Vec<u8>>, ArchiveError> {
        for folder in &self.folders {
            let unpacked = folder.join(set);
            if let Some(path) =
                find_below(&unpacked, file).map_err(|source| ArchiveError { path: unpacked, source })?
            {
                return fs::read(&path).map(Some).map_err(|source| ArchiveError { path, source });
            }
            let path = folder.join(format!("{set}-{kind}.zip"));
            if path.is_file() {
                let found = find_zipped(&path, file).map_err(|source| ArchiveError { path, source })?;
                if found.is_some() {
                    return Ok(found);
                }
            }
        }
        Ok(None)
    }
}

/// The path of the file of this name in a folder or below it; `None` also if there is no such folder.
fn find_below(folder: &Path, file: &str) -> io::Result<Option<PathBuf>> {
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        if !folder.is_dir() {
            continue;
        }
        let direct = folder.join(file);
        if direct.is_file() {
            return Ok(Some(direct));
        }
        for entry in fs::read_dir(&folder)? {
            let entry = entry?;
            // Links are not followed, so that the walk ends.
            if entry.file_type()?.is_dir() {
                folders.push(entry.path());
            }
        }
    }
    Ok(None)
}

/// The content of the file of this name anywhere in a zip archive.
fn find_zipped(path: &Path, file: &str) -> io::Result<Option<Vec<u8>>> {
    let mut archive = zip::ZipArchive::new(io::BufReader::new(File::open(path)?))?;
    let is_it = |entry: &str| entry.rsplit('/').next() == Some(file);
    let entry = archive.file_names().flatten().find(|entry| is_it(entry)).map(String::from);
    let Some(entry) = entry else { return Ok(None) };
    let mut text = Vec::new();
    archive.by_name(&entry)?.take(MAX_FILE_BYTES + 1).read_to_end(&mut text)?;
    if text.len() as u64 > MAX_FILE_BYTES {
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, format!("`{entry}` is too large")));
    }
    Ok(Some(text))
}
