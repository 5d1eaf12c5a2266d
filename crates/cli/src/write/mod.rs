//! Files that the program writes.

pub(crate) mod input;
pub(crate) mod npy;

use std::{
    fs::File,
    io::{self, BufWriter, Write},
    path::Path,
};

use crate::failure::Failure;

/// Checks, before anything is computed, that the folder of a file exists.
pub(crate) fn check_folder(path: &Path) -> Result<(), Failure> {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            Err(Failure::NoFolder { path: path.to_owned(), folder: folder.to_owned() })
        }
        _ => Ok(()),
    }
}

/// The end of a file's name after the last point, in small letters; empty without one.
pub(crate) fn extension(path: &Path) -> String {
    path.extension().map_or_else(String::new, |end| end.to_string_lossy().to_ascii_lowercase())
}

/// Writes a file, which it replaces, through a buffer.
pub(crate) fn write_file(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), Failure> {
    let written = File::create(path).map(BufWriter::new).and_then(|mut file| {
        write(&mut file)?;
        file.flush()
    });
    written.map_err(Failure::writing(path))
}
