//! The files of the project, with their contents.

use std::{
    fs,
    path::{Path, PathBuf},
};

use crate::{Error, project};

/// The files of the project with their contents.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    files: Vec<(PathBuf, Vec<u8>)>,
}

impl Tree {
    /// A tree of these files, paths from the root.
    #[must_use]
    pub fn new(files: Vec<(PathBuf, Vec<u8>)>) -> Self {
        Self { files }
    }

    /// Reads the files that git tracks or would add.
    ///
    /// # Errors
    /// [`Error::Io`] for one that cannot be read.
    pub fn read(root: &Path) -> Result<Self, Error> {
        let read = |path: PathBuf| match fs::read(root.join(&path)) {
            Ok(bytes) => Ok((path, bytes)),
            Err(source) => Err(Error::Io { path, source }),
        };
        project::files(root)?.into_iter().map(read).collect::<Result<_, _>>().map(Self::new)
    }

    /// All files.
    pub(crate) fn files(&self) -> impl Iterator<Item = (&Path, &[u8])> {
        self.files.iter().map(|(path, bytes)| (&**path, &**bytes))
    }

    /// The files with these extensions that are text.
    pub(crate) fn texts(&self, extensions: &[&str]) -> impl Iterator<Item = (&Path, &str)> {
        let named = self.files().filter(|(path, _)| {
            path.extension().is_some_and(|found| extensions.iter().any(|extension| found == *extension))
        });
        named.filter_map(|(path, bytes)| Some((path, std::str::from_utf8(bytes).ok()?)))
    }

    /// The contents of one file.
    pub(crate) fn bytes(&self, path: &Path) -> Option<&[u8]> {
        self.files().find(|(file, _)| *file == path).map(|(_, bytes)| bytes)
    }

    /// Whether there is a file of this path, or one below it.
    pub(crate) fn holds(&self, path: &Path) -> bool {
        self.files.iter().any(|(file, _)| file.starts_with(path))
    }
}
