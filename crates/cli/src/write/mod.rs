//! Files that the program writes: each is whole, or what was there before ([`NewFile`]).

pub(crate) mod input;
pub(crate) mod npy;

use std::{
    io,
    path::{Path, PathBuf},
};

use mediant_formats::NewFile;

use crate::{failure::Failure, write::input::check_inputs};

/// Checks, before anything is computed, that files can be written, as far as this can be known, and that the
/// map is read from none of them, nor are other inputs.
pub(crate) fn check_outputs<'i>(
    map: &Path,
    others: impl IntoIterator<Item = &'i PathBuf>,
    written: &[&Path],
) -> Result<(), Failure> {
    written.iter().try_for_each(NewFile::check)?;
    check_inputs(map, written)?;
    others.into_iter().try_for_each(|other| check_inputs(other, written))
}

/// The end of a file's name after the last point, in small letters; empty without one.
pub(crate) fn extension(path: &Path) -> String {
    path.extension().map_or_else(String::new, |end| end.to_string_lossy().to_ascii_lowercase())
}

/// Writes a file, which it replaces when it is whole.
pub(crate) fn write_file(
    path: &Path,
    write: impl FnOnce(&mut NewFile) -> io::Result<()>,
) -> Result<(), Failure> {
    Ok(NewFile::write_with(path, write)?)
}
