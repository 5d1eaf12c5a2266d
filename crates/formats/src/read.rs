//! Files from disk.

use std::{
    fs::{self, File},
    io::{self, Read},
    path::{Path, PathBuf},
};

use crate::{IndexError, MapError, ScenarioError};

/// The largest file that is read, in bytes: twice what a map of the greatest size needs.
pub const MAX_FILE_BYTES: u64 = 2 << 30;

/// A file that cannot be read or parsed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// There is no such file.
    #[error("{}: no such file; check the path and the folder that you are in", path.display())]
    Missing {
        /// The file that was asked for.
        path: PathBuf,
    },
    /// The path names a directory.
    #[error("{}: expected a file, found a directory; name a file in it", path.display())]
    Directory {
        /// The path that was asked for.
        path: PathBuf,
    },
    /// The path names a device, a pipe or a socket.
    #[error("{}: expected a regular file, found a device or pipe; save its content to a file first", path.display())]
    NotRegular {
        /// The path that was asked for.
        path: PathBuf,
    },
    /// The file is longer than [`MAX_FILE_BYTES`].
    #[error("{}: expected at most {MAX_FILE_BYTES} bytes, found more; is this the file that you meant?", path.display())]
    TooLarge {
        /// The file that was asked for.
        path: PathBuf,
    },
    /// The system refuses to read the file.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file that was asked for.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file is no map.
    #[error("{}: {source}", path.display())]
    Map {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: MapError,
    },
    /// The file is no scenario.
    #[error("{}: {source}", path.display())]
    Scenario {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: ScenarioError,
    },
    /// The file is no index.
    #[error("{}: {source}", path.display())]
    Index {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: IndexError,
    },
}

/// The bytes of a regular file. A device or pipe is refused before it is opened, since opening a pipe can wait for ever.
pub(crate) fn read_regular(path: &Path) -> Result<Vec<u8>, ReadError> {
    let own = || path.to_owned();
    let unreadable = |source: io::Error| match source.kind() {
        io::ErrorKind::NotFound => ReadError::Missing { path: own() },
        _ => ReadError::Unreadable { path: own(), source },
    };
    let about = fs::metadata(path).map_err(unreadable)?;
    if about.is_dir() {
        return Err(ReadError::Directory { path: own() });
    }
    if !about.is_file() {
        return Err(ReadError::NotRegular { path: own() });
    }
    if about.len() > MAX_FILE_BYTES {
        return Err(ReadError::TooLarge { path: own() });
    }
    let mut bytes = Vec::new();
    // One byte more than its length, should the file grow meanwhile.
    let file = File::open(path).map_err(unreadable)?;
    bytes.try_reserve_exact(about.len() as usize + 1).map_err(|error| unreadable(error.into()))?;
    file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(ReadError::TooLarge { path: own() });
    }
    Ok(bytes)
}
