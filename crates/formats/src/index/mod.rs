//! The container in which a preprocessed index is saved.
//!
//! All numbers are little endian.
//!
//! | bytes | content |
//! |---|---|
//! | 8 | `\x89MEDIDX\n` |
//! | 4 | the version of this format |
//! | 16 | the engine's name, ASCII, filled up with zeros |
//! | 4 | the version of the engine's payload |
//! | 1, 1 | placement (0 center, 1 corner); its rule (0 never, 1 one, 2 always; 0 open, 1 closed) |
//! | 1, 1 | 1 for any-angle, else 0; zero |
//! | 4 | k; 0 for any-angle |
//! | 4, 4 | width and height of the map, in cells |
//! | 32 | digest of the map, see [`MapDigest`] |
//! | 8 | length of the payload |
//! | … | the payload |
//! | 32 | SHA-256 of all that precedes |

mod error;
mod header;
mod key;

use std::{
    fmt, fs,
    io::{self, Write},
    path::Path,
};

use sha2::{Digest, Sha256};
use tempfile::NamedTempFile;

pub use error::{IndexError, WriteError};
pub use key::{IndexKey, MapDigest};

use crate::{MAX_FILE_BYTES, ReadError, read::read_regular};
use header::HEADER_BYTES;

const DIGEST_BYTES: usize = 32;

/// A saved index: what it was built for, and what only its engine understands.
///
/// ```
/// use mediant_formats::{IndexFile, IndexKey};
/// use mediant_grid::{AsciiMap, CornerRule, Rules};
/// let grid = AsciiMap::parse("..#\n...")?.grid;
/// let key = IndexKey::new("jps-plus", 1, Rules::Center(CornerRule::Never), Some(3), &grid)?;
/// let saved = IndexFile::new(key.clone(), vec![1, 2, 3]).to_bytes();
/// let index = IndexFile::from_bytes(saved)?;
/// index.check(&key)?;
/// assert_eq!(index.payload(), [1, 2, 3]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct IndexFile {
    key: IndexKey,
    payload: Vec<u8>,
}

/// Without the bytes of the payload.
impl fmt::Debug for IndexFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("IndexFile").field("key", &self.key).field("bytes", &self.payload.len()).finish()
    }
}

impl IndexFile {
    /// The index with this payload.
    #[must_use]
    pub const fn new(key: IndexKey, payload: Vec<u8>) -> Self {
        Self { key, payload }
    }

    /// What the index was built for.
    #[must_use]
    pub const fn key(&self) -> &IndexKey {
        &self.key
    }

    /// The engine's part.
    #[must_use]
    pub fn payload(&self) -> &[u8] {
        &self.payload
    }

    /// The engine's part, given away.
    #[must_use]
    pub fn into_payload(self) -> Vec<u8> {
        self.payload
    }

    /// The bytes of the file.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = header::encode(&self.key, self.payload.len());
        bytes.reserve_exact(self.payload.len() + DIGEST_BYTES);
        bytes.extend_from_slice(&self.payload);
        let digest = Sha256::digest(&bytes);
        bytes.extend_from_slice(&digest);
        bytes
    }

    /// Parses the bytes of a file, and keeps the payload without a copy. Nothing is allocated for what the bytes claim.
    ///
    /// # Errors
    /// [`IndexError`] for bytes that are no index of this format version, or not all of one, or not as they were written.
    pub fn from_bytes(mut bytes: Vec<u8>) -> Result<Self, IndexError> {
        let (key, payload) = header::decode(&bytes)?;
        bytes.truncate(payload.end);
        bytes.drain(..payload.start);
        Ok(Self { key, payload: bytes })
    }

    /// Saves the index. It is written beside its place and then moved there, so that there is never half an index at `path`, and an
    /// old one stays until the new one is whole.
    ///
    /// # Errors
    /// [`WriteError`] when the system refuses, or when `path` is there and no regular file.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), WriteError> {
        let path = path.as_ref();
        let own = || path.to_owned();
        if fs::metadata(path).is_ok_and(|about| !about.is_file()) {
            return Err(WriteError::NotRegular { path: own() });
        }
        let found = (HEADER_BYTES + self.payload.len() + DIGEST_BYTES) as u64;
        if found > MAX_FILE_BYTES {
            return Err(WriteError::TooLarge { path: own(), found });
        }
        self.replace(path).map_err(|source| WriteError::Unwritable { path: own(), source })
    }

    fn replace(&self, path: &Path) -> io::Result<()> {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let mut file = temporary_in(folder.unwrap_or(Path::new(".")))?;
        let header = header::encode(&self.key, self.payload.len());
        let digest = Sha256::new().chain_update(&header).chain_update(&self.payload).finalize();
        for part in [&header[..], &self.payload, &digest] {
            file.write_all(part)?;
        }
        // A rename may reach the disk before the bytes do.
        file.as_file().sync_all()?;
        file.persist(path)?;
        Ok(())
    }

    /// Reads and parses a file.
    ///
    /// # Errors
    /// [`ReadError`] for a file that is missing, cannot be read, or is no whole index.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        Self::from_bytes(read_regular(path)?)
            .map_err(|source| ReadError::Index { path: path.to_owned(), source })
    }

    /// Whether the index was built for what it is now to be used for.
    ///
    /// # Errors
    /// The [`IndexError`] of the first difference: engine, its version, rules, k, map.
    pub fn check(&self, expected: &IndexKey) -> Result<(), IndexError> {
        let found = &self.key;
        if found.engine != expected.engine {
            let (expected, found) = (expected.engine.clone(), found.engine.clone());
            return Err(IndexError::Engine { expected, found });
        }
        if found.version != expected.version {
            let engine = expected.engine.clone();
            return Err(IndexError::EngineVersion {
                engine,
                expected: expected.version,
                found: found.version,
            });
        }
        if found.rules != expected.rules {
            return Err(IndexError::Rules { expected: expected.rules, found: found.rules });
        }
        if found.k != expected.k {
            return Err(IndexError::K { expected: expected.k, found: found.k });
        }
        if found.map != expected.map {
            return Err(IndexError::Map { expected: expected.map, found: found.map });
        }
        Ok(())
    }
}

/// A file with a name of its own and the usual permissions; tempfile's default keeps other users from reading it.
fn temporary_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".mediant-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Less what the process's mask takes away.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
