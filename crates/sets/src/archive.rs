//! One map or scenario of a set, unpacked or zipped.

use std::{
    fs::{self, File},
    io::{self, Read},
    path::{Path, PathBuf},
};

use mediant_formats::MAX_FILE_BYTES;

/// Folders that hold benchmark sets, unpacked or as the archives that the sets are published in.
///
/// In each folder, a file of the set SET is looked for in the folder `SET` and those in it, then in
/// `SET-map.zip` or `SET-scen.zip`, wherever it lies in there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Archive {
    folders: Vec<PathBuf>,
}

/// A file of a set that is there, but cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{}: {source}", path.display())]
pub struct ArchiveError {
    path: PathBuf,
    source: io::Error,
}

impl Archive {
    /// Looks for each file in these folders, in their order. None of the folders has to exist.
    #[must_use]
    pub fn new(folders: impl IntoIterator<Item = PathBuf>) -> Self {
        Self { folders: folders.into_iter().collect() }
    }

    /// The text of map NAME of a set, `NAME.map`; `None` where no folder has it.
    ///
    /// # Errors
    /// [`ArchiveError`] when a folder or file cannot be read.
    pub fn map(&self, set: &str, name: &str) -> Result<Option<Vec<u8>>, ArchiveError> {
        self.find(set, "map", &format!("{name}.map"))
    }

    /// The text of that map's scenario, `NAME.map.scen`.
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

/// The file of this name in a folder or those in it; `None` also when there is no such folder.
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

/// The content of the file of this name in a zip archive, in any folder of the archive.
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
