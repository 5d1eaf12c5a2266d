//! An index file: its key, its payload and its checksum.

use std::{fmt, fs, io::Write, path::Path};

use mediant_grid::{Interrupt, Interrupted, room_for, uninterrupted};

use super::{error::IndexError, header, key::IndexKey, layout::DIGEST_BYTES};
use crate::{
    read::{MAX_FILE_BYTES, PIECE, ReadError, read_regular_interruptible},
    save::{NewFile, WriteError, unwritable},
};

/// A saved index: the key that says what it was built for, and a payload that only its engine understands.
///
/// Needs the feature `index`.
///
/// ```
/// use mediant_formats::{IndexFile, IndexKey};
/// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph};
/// use mediant_moves::FiniteK;
/// let grid = AsciiMap::parse("..#\n...")?.grid;
/// let graph = GridGraph::<Centers>::new(grid.into(), FiniteK::N8, CornerRule::Never)?;
/// let key = IndexKey::new("jps-plus", 1, graph.identity())?;
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

    /// The key of the index.
    #[must_use]
    pub const fn key(&self) -> &IndexKey {
        &self.key
    }

    /// The bytes that the engine saved.
    #[must_use]
    pub fn payload(&self) -> &[u8] {
        &self.payload
    }

    /// The bytes that the engine saved, without a copy.
    #[must_use]
    pub fn into_payload(self) -> Vec<u8> {
        self.payload
    }

    /// The bytes of the file.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        uninterrupted(|never| self.to_bytes_interruptible(never))
    }

    /// [`to_bytes`](Self::to_bytes), which an interrupt can stop.
    ///
    /// # Errors
    /// [`Interrupted`], with nothing kept.
    pub fn to_bytes_interruptible(&self, interrupt: &Interrupt) -> Result<Vec<u8>, Interrupted> {
        let mut bytes = header::encode(&self.key, self.payload.len());
        let more = self.payload.len() + DIGEST_BYTES;
        room_for::<u8>(bytes.len() + more, Interrupted::WRITING)?;
        bytes.reserve_exact(more);
        bytes.extend_from_slice(&self.payload);
        let digest = header::digest_of(&[&bytes], interrupt, Interrupted::WRITING)?;
        bytes.extend_from_slice(&digest);
        Ok(bytes)
    }

    /// Parses the bytes of a file, and keeps the payload in the same allocation. The length that the header
    /// states allocates nothing.
    ///
    /// # Errors
    /// [`IndexError`] for bytes that are not an index of this format version, are cut short, or are damaged.
    pub fn from_bytes(bytes: Vec<u8>) -> Result<Self, IndexError> {
        Self::from_bytes_interruptible(bytes, &Interrupt::NEVER)
    }

    /// [`from_bytes`](Self::from_bytes), which an interrupt can stop; it asks for each mebibyte.
    ///
    /// # Errors
    /// As for [`from_bytes`](Self::from_bytes), and [`IndexError::Interrupted`].
    pub fn from_bytes_interruptible(mut bytes: Vec<u8>, interrupt: &Interrupt) -> Result<Self, IndexError> {
        let (key, payload) = header::decode(&bytes, interrupt)?;
        bytes.truncate(payload.end);
        bytes.drain(..payload.start);
        Ok(Self { key, payload: bytes })
    }

    /// Saves the index at `path`. An older file there is replaced as a whole: the index is written to another
    /// file in the same folder, which is then renamed. So there is never half an index at `path`.
    ///
    /// # Errors
    /// [`WriteError`] if the operating system refuses, or if there is something at `path` that is no regular
    /// file.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), WriteError> {
        self.write_interruptible(path, &Interrupt::NEVER)
    }

    /// [`write`](Self::write), which an interrupt can stop; it asks for each mebibyte. An older file stays
    /// then.
    ///
    /// # Errors
    /// As for [`write`](Self::write), and [`WriteError::Interrupted`].
    pub fn write_interruptible(
        &self,
        path: impl AsRef<Path>,
        interrupt: &Interrupt,
    ) -> Result<(), WriteError> {
        let header = header::encode(&self.key, self.payload.len());
        let digest = header::digest_of(&[&header, &self.payload], interrupt, Interrupted::WRITING)?;
        replace(path.as_ref(), &[&header, &self.payload, &digest], interrupt)
    }

    /// Reads and parses a file.
    ///
    /// # Errors
    /// [`ReadError`] for a file that is missing, cannot be read, or is no whole index.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        Self::read_interruptible(path, &Interrupt::NEVER)
    }

    /// [`read`](Self::read), which an interrupt can stop.
    ///
    /// # Errors
    /// As for [`read`](Self::read), and [`ReadError::Interrupted`].
    pub fn read_interruptible(path: impl AsRef<Path>, interrupt: &Interrupt) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let bytes = read_regular_interruptible(path, interrupt)?;
        Self::from_bytes_interruptible(bytes, interrupt).map_err(|error| match error {
            IndexError::Interrupted(interrupted) => interrupted.into(),
            source => ReadError::Index { path: path.to_owned(), source: source.into() },
        })
    }

    /// Checks that the index was built for this engine, version and identity: for the same map, rules of
    /// motion and k.
    ///
    /// # Errors
    /// The [`IndexError`] of the first difference, in this order; [`IndexError::Mismatch`] for the identity.
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
        found.identity.check_equal("the saved index", ("the space", expected.identity))?;
        Ok(())
    }
}

/// Writes a file of these parts to `path`, in the place of an older file.
fn replace(path: &Path, parts: &[&[u8]], interrupt: &Interrupt) -> Result<(), WriteError> {
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        return Err(WriteError::NotRegular { path: path.to_owned() });
    }
    let found = parts.iter().map(|part| part.len() as u64).sum();
    if found > MAX_FILE_BYTES {
        return Err(WriteError::TooLarge { path: path.to_owned(), found });
    }
    let mut file = NewFile::create(path)?;
    for piece in parts.iter().flat_map(|part| part.chunks(PIECE)) {
        interrupt.check(Interrupted::WRITING)?;
        file.write_all(piece).map_err(unwritable(path))?;
    }
    file.replace()
}
