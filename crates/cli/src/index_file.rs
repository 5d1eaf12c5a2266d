//! Files of saved indexes: read and written with the key that says what they are for.

use std::path::Path;

use mediant::Setup;
use mediant_formats::{IndexError, IndexFile, IndexKey};
use mediant_grid::{Grid, Identity};

use crate::failure::Failure;

/// Writes the bytes of an index for this setup and map to a file.
pub(crate) fn save(path: &Path, setup: Setup, grid: &Grid, bytes: Vec<u8>) -> Result<(), Failure> {
    let key = key(setup, setup.index_version()?, grid).map_err(refused(path))?;
    Ok(IndexFile::new(key, bytes).write(path)?)
}

/// The bytes of the index in a file, if it is for this setup and map.
pub(crate) fn load(path: &Path, setup: Setup, grid: &Grid) -> Result<Vec<u8>, Failure> {
    let version = setup.index_version()?;
    let file = IndexFile::read(path)?;
    let expected = key(setup, version, grid).map_err(refused(path))?;
    file.check(&expected).map_err(refused(path))?;
    Ok(file.into_payload())
}

/// What an index file is for: engine, version, and map, rules and k.
fn key(setup: Setup, version: u32, grid: &Grid) -> Result<IndexKey, IndexError> {
    let identity = Identity { map: Some(grid.id()), rules: setup.rules, k: Some(setup.k) };
    IndexKey::new(setup.engine.kind().name(), version, identity)
}

/// Adds the path of the file to an error.
fn refused(path: &Path) -> impl FnOnce(IndexError) -> Failure {
    move |source| Failure::Index { path: path.to_owned(), source: source.into() }
}
