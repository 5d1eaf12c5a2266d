//! Indexes as bytes and files. Both begin with a key: the engine, the version of its format, and the map,
//! rules and k that the index is for. They end with a checksum.

use std::path::Path as FilePath;

use mediant_formats::{IndexError, IndexFile, IndexKey};

use mediant_grid::{Identity, Interrupt};
use mediant_moves::K;

use super::Index;
#[cfg(feature = "costs")]
use crate::costs::Costs;
use crate::{
    configured::ConfiguredEngine, engine::Engine, engines::Source, error::Error, map::Map, motion::Motion,
    never::NEVER, setup_error::SetupError, space::Space,
};

impl Index {
    /// Writes the index to a file, for [`Space::load`]. An older file there is replaced as a whole. One that
    /// is not finished is [finished](Self::finish) first.
    ///
    /// # Errors
    /// [`Error::Setup`] for an engine whose index is not saved, those of [`finish`](Self::finish),
    /// [`Error::Write`] if the operating system
    /// refuses.
    pub fn save(&self, path: impl AsRef<FilePath>) -> Result<(), Error> {
        self.write(path.as_ref(), &NEVER)
    }

    pub(crate) fn write(&self, path: &FilePath, interrupt: &Interrupt) -> Result<(), Error> {
        Ok(self.file(interrupt)?.write_interruptible(path, interrupt)?)
    }

    /// The index as bytes, those of its file, for [`Space::index_from_bytes`]. One that is not finished is
    /// [finished](Self::finish) first.
    ///
    /// # Errors
    /// [`Error::Setup`] for an engine whose index is not saved, and those of [`finish`](Self::finish).
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        self.bytes(&NEVER)
    }

    pub(crate) fn bytes(&self, interrupt: &Interrupt) -> Result<Vec<u8>, Error> {
        Ok(self.file(interrupt)?.to_bytes_interruptible(interrupt)?)
    }

    fn file(&self, interrupt: &Interrupt) -> Result<IndexFile, Error> {
        if !self.is_finished() {
            return self.finished(interrupt)?.file(interrupt);
        }
        let engine = self.setup.engine.kind();
        let payload = self.prepared.to_bytes(interrupt)?;
        let payload = payload.ok_or_else(|| match self.space.has_costs() {
            true => SetupError::without_index_on_costs(engine),
            false => SetupError::without_index(engine),
        })?;
        Ok(IndexFile::new(key(engine, &self.space)?, payload))
    }
}

/// Defines how a map, and costs of its cells, read an index, of whose motion this makes the space.
macro_rules! reads_indexes {
    ($space:expr) => {
        /// Reads an index that [`Index::save`] wrote for an equal one, and makes its space: the file says
        /// which rules and k it is for.
        ///
        /// # Errors
        /// As for [`Space::load`].
        pub fn load(&self, path: impl AsRef<FilePath>) -> Result<Index, Error> {
            self.load_index(path.as_ref(), &NEVER)
        }

        pub(crate) fn load_index(&self, path: &FilePath, interrupt: &Interrupt) -> Result<Index, Error> {
            let file = IndexFile::read_interruptible(path, interrupt)?;
            self.index(&file, interrupt).map_err(|error| error.in_file(path))
        }

        /// The index that [`Index::to_bytes`] wrote for an equal one, as [`load`](Self::load) reads it from a
        /// file.
        ///
        /// # Errors
        /// As for [`Space::index_from_bytes`].
        pub fn index_from_bytes(&self, bytes: Vec<u8>) -> Result<Index, Error> {
            self.read_index(bytes, &NEVER)
        }

        pub(crate) fn read_index(&self, bytes: Vec<u8>, interrupt: &Interrupt) -> Result<Index, Error> {
            self.index(&IndexFile::from_bytes_interruptible(bytes, interrupt)?, interrupt)
        }

        fn index(&self, file: &IndexFile, interrupt: &Interrupt) -> Result<Index, Error> {
            $space(self, motion_of(file), interrupt)?.index(file, None, interrupt)
        }
    };
}

impl Map {
    reads_indexes!(Space::new);
}

#[cfg(feature = "costs")]
impl Costs {
    reads_indexes!(Space::of_costs);
}

/// The motion that a file's index is for. No engine saves an index for every k: whichever k is taken then,
/// the space refuses the file.
fn motion_of(file: &IndexFile) -> Motion {
    let Identity { rules, k, .. } = file.key().identity();
    Motion::of(k.unwrap_or(K::N8), rules)
}

impl Space {
    /// Reads an index that [`Index::save`] wrote for the same map, rules and k. Its engine has the default
    /// options; [`Index::with_options`] chooses others.
    ///
    /// # Errors
    /// [`Error::Read`] for a file that is missing, cannot be read, or is no whole index; [`Error::InFile`]
    /// with an [`Error::Mismatch`] for an index of another map, rule or k, or with what else is wrong.
    pub fn load(&self, path: impl AsRef<FilePath>) -> Result<Index, Error> {
        self.load_index(path.as_ref(), None, &NEVER)
    }

    pub(crate) fn load_index(
        &self,
        path: &FilePath,
        engine: Option<ConfiguredEngine>,
        interrupt: &Interrupt,
    ) -> Result<Index, Error> {
        let file = IndexFile::read_interruptible(path, interrupt)?;
        self.index(&file, engine, interrupt).map_err(|error| error.in_file(path))
    }

    /// [`load`](Self::load) for an engine with options.
    ///
    /// # Errors
    /// As for [`load`](Self::load) and [`Index::with_options`]; also for the index of another engine.
    pub fn load_for(
        &self,
        engine: impl Into<ConfiguredEngine>,
        path: impl AsRef<FilePath>,
    ) -> Result<Index, Error> {
        self.load_index(path.as_ref(), Some(engine.into()), &NEVER)
    }

    /// The index that [`Index::to_bytes`] wrote for the same map, rules and k, as [`load`](Self::load) reads
    /// it from a file.
    ///
    /// # Errors
    /// [`Error::IndexFile`] for bytes that are no whole index, or one of another version; [`Error::Mismatch`]
    /// for an index of another map, rule or k; the engine's error for bytes that another program wrote.
    pub fn index_from_bytes(&self, bytes: Vec<u8>) -> Result<Index, Error> {
        self.read_index(bytes, &NEVER)
    }

    pub(crate) fn read_index(&self, bytes: Vec<u8>, interrupt: &Interrupt) -> Result<Index, Error> {
        self.index(&IndexFile::from_bytes_interruptible(bytes, interrupt)?, None, interrupt)
    }

    /// The index of a file, for an engine with options, or the file's engine with none.
    fn index(
        &self,
        file: &IndexFile,
        engine: Option<ConfiguredEngine>,
        interrupt: &Interrupt,
    ) -> Result<Index, Error> {
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
        let source = Source { bytes: Some(file.payload()), interrupt, ..Source::new(&|_| {}) };
        Index::from_source(self, engine, source)
    }
}

/// The names of the engines whose indexes are saved.
fn names_of_indexed() -> String {
    Engine::names_where(|engine| engine.capabilities().index.is_some())
}

/// The key of an engine's saved index: engine, version, map, rules and k.
fn key(engine: Engine, space: &Space) -> Result<IndexKey, Error> {
    let version = engine.capabilities().index.ok_or_else(|| SetupError::without_index(engine))?;
    Ok(IndexKey::new(engine.name(), version, space.identity())?)
}
