//! Indexes as bytes and files. Both begin with a key: the engine, the version of its format, and the map,
//! rules and k that the index is for. They end with a checksum.

use std::path::Path as FilePath;

use mediant_formats::{IndexError, IndexFile, IndexKey};

use mediant_grid::{Corners, Identity};
use mediant_moves::K;
use mediant_subgoal::PreparedSubgoals;

use super::{Index, source::Source};
use crate::{
    configured::ConfiguredEngine, engine::Engine, error::Error, map::Map, motion::Motion,
    setup_error::SetupError, space::Space,
};

impl Index {
    /// Writes the index to a file, for [`Space::load`]. An older file there is replaced as a whole.
    ///
    /// # Errors
    /// [`Error::Setup`] for an engine whose index is not saved, [`Error::Write`] if the operating system
    /// refuses.
    pub fn save(&self, path: impl AsRef<FilePath>) -> Result<(), Error> {
        Ok(self.file()?.write(path)?)
    }

    /// The index as bytes, those of its file, for [`Space::index_from_bytes`].
    ///
    /// # Errors
    /// [`Error::Setup`] for an engine whose index is not saved.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        Ok(self.file()?.to_bytes())
    }

    fn file(&self) -> Result<IndexFile, Error> {
        let engine = self.setup.engine.kind();
        let payload = match self.substitute {
            // The placement makes no difference.
            Some(_) => Some(PreparedSubgoals::<Corners>::Nothing(self.identity()).to_bytes()),
            None => self.prepared.to_bytes(),
        };
        let payload = payload.ok_or_else(|| SetupError::without_index(engine))?;
        Ok(IndexFile::new(key(engine, &self.space)?, payload))
    }
}

impl Map {
    /// Reads an index that [`Index::save`] wrote for the same map, and makes its space: the file says which
    /// rules and k it is for.
    ///
    /// # Errors
    /// Those of [`Space::load`].
    pub fn load(&self, path: impl AsRef<FilePath>) -> Result<Index, Error> {
        let path = path.as_ref();
        self.index(&IndexFile::read(path)?).map_err(|error| error.in_file(path))
    }

    /// The index that [`Index::to_bytes`] wrote for the same map, as [`load`](Self::load) reads it from a
    /// file.
    ///
    /// # Errors
    /// Those of [`Space::index_from_bytes`].
    pub fn index_from_bytes(&self, bytes: Vec<u8>) -> Result<Index, Error> {
        self.index(&IndexFile::from_bytes(bytes)?)
    }

    fn index(&self, file: &IndexFile) -> Result<Index, Error> {
        let Identity { rules, k, .. } = file.key().identity();
        // No engine saves an index for every k: whichever k is taken, the space refuses such a file.
        self.space(Motion { k: k.unwrap_or(K::N8), rules })?.index(file, None)
    }
}

impl Space {
    /// Reads an index that [`Index::save`] wrote for the same map, rules and k. Its engine has the default
    /// options; [`Index::with_options`] chooses others.
    ///
    /// # Errors
    /// [`Error::Read`] for a file that is missing, cannot be read, or is no whole index; [`Error::InFile`]
    /// with an [`Error::Mismatch`] for an index of another map, rule or k, or with what else is wrong.
    pub fn load(&self, path: impl AsRef<FilePath>) -> Result<Index, Error> {
        let path = path.as_ref();
        self.index(&IndexFile::read(path)?, None).map_err(|error| error.in_file(path))
    }

    /// [`load`](Self::load) for an engine with options.
    ///
    /// # Errors
    /// Those of [`load`](Self::load) and of [`Index::with_options`]; also for the index of another engine.
    pub fn load_for(
        &self,
        engine: impl Into<ConfiguredEngine>,
        path: impl AsRef<FilePath>,
    ) -> Result<Index, Error> {
        let path = path.as_ref();
        self.index(&IndexFile::read(path)?, Some(engine.into())).map_err(|error| error.in_file(path))
    }

    /// The index that [`Index::to_bytes`] wrote for the same map, rules and k, as [`load`](Self::load) reads
    /// it from a file.
    ///
    /// # Errors
    /// [`Error::IndexFile`] for bytes that are no whole index, or one of another version; [`Error::Mismatch`]
    /// for an index of another map, rule or k; the engine's error for bytes that another program wrote.
    pub fn index_from_bytes(&self, bytes: Vec<u8>) -> Result<Index, Error> {
        self.index(&IndexFile::from_bytes(bytes)?, None)
    }

    /// The index of a file, for an engine with options, or the file's engine with none.
    fn index(&self, file: &IndexFile, engine: Option<ConfiguredEngine>) -> Result<Index, Error> {
        let engine = match engine {
            Some(engine) => engine,
            None => {
                let found = file.key().engine();
                let unknown =
                    |_| IndexError::Engine { expected: names_of_indexed(), found: found.to_owned() };
                found.parse::<Engine>().map_err(unknown)?.into()
            }
        };
        file.check(&key(engine.kind(), self)?)?;
        Index::from_source(self, engine, Source { bytes: Some(file.payload()), ..Source::new(&|_| {}) })
    }
}

/// The names of the engines whose indexes are saved.
fn names_of_indexed() -> String {
    Engine::names_where(|engine| engine.capabilities().index.is_some())
}

/// What the index of an engine in a space is for.
fn key(engine: Engine, space: &Space) -> Result<IndexKey, Error> {
    let version = engine.capabilities().index.ok_or_else(|| SetupError::without_index(engine))?;
    Ok(IndexKey::new(engine.name(), version, space.identity())?)
}
