//! Replaces a file as a whole.

use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;

use crate::read::MAX_FILE_BYTES;

/// Why an index cannot be saved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The path names a directory or a device, which must not be replaced by a file.
    #[error("{}: expected a regular file or none, found a directory or device; name a file to be made", path.display())]
    NotRegular {
        /// The file that was asked for.
        path: PathBuf,
    },
    /// The file would be longer than the longest that can be read, [`MAX_FILE_BYTES`].
    #[error("{}: expected an index of at most {MAX_FILE_BYTES} bytes, found {found}; split the map", path.display())]
    TooLarge {
        /// The file that was asked for.
        path: PathBuf,
        /// The number of bytes that it would have.
        found: u64,
    },
    /// The operating system refuses to write the file.
    #[error("{}: cannot be written: {source}", path.display())]
    Unwritable {
        /// The file that was asked for.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
}

/// Writes a file of these parts to `path`, in the place of an older file.
pub(super) fn replace(path: &Path, parts: &[&[u8]]) -> Result<(), WriteError> {
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        return Err(WriteError::NotRegular { path: path.to_owned() });
    }
    let found = parts.iter().map(|part| part.len() as u64).sum();
    if found > MAX_FILE_BYTES {
        return Err(WriteError::TooLarge { path: path.to_owned(), found });
    }
    write_and_rename(path, parts).map_err(|source| WriteError::Unwritable { path: path.to_owned(), source })
}

fn write_and_rename(path: &Path, parts: &[&[u8]]) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut file = temporary_in(folder.unwrap_or(Path::new(".")))?;
    for part in parts {
        file.write_all(part)?;
    }
    // Else the rename may reach the disk before the bytes do.
    file.as_file().sync_all()?;
    file.persist(path)?;
    Ok(())
}

/// A new file of a unique name with the usual permissions. By default, tempfile keeps other users from
/// reading it.
fn temporary_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".mediant-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The system removes the bits of the process's umask.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
