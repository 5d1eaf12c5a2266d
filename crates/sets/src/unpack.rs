//! Zip archives, unpacked into one folder.

use std::{
    fs::{self, File},
    io::{self, Read},
    path::Path,
};

use mediant_formats::MAX_FILE_BYTES;
use zip::{ZipArchive, result::ZipError};

use crate::Error;

/// Writes the archive's files whose names end in `ending` into `folder`, without the archive's own folders.
/// Files that a system or an editor left in it (`__MACOSX`, names that begin with a dot) are passed over.
///
/// Refuses names that lead out of the folder, two files of one name with different content, an archive
/// without any such file, and a damaged archive.
pub(crate) fn extract(zip: &Path, folder: &Path, ending: &str) -> Result<(), Error> {
    let name = zip.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let broken = |why: String| Error::Zip { name: name.clone(), why };
    let refused = |why: String| Error::Archive { name: name.clone(), why };
    let file = File::open(zip).map_err(Error::at(zip))?;
    let mut archive = ZipArchive::new(io::BufReader::new(file)).map_err(|error| broken(reason(error)))?;
    let mut written = 0;
    for index in 0..archive.len() {
        let entry = archive.by_index(index).map_err(|error| broken(reason(error)))?;
        let path = entry.name().map_err(|error| broken(reason(error)))?.into_owned();
        if leads_elsewhere(&path) {
            return Err(refused(format!("the name `{}` leads out of the folder", path.escape_debug())));
        }
        let Some(file_name) = wanted(&path, ending).filter(|_| entry.is_file()) else { continue };
        let mut bytes = Vec::new();
        // Read to the end, where the checksum is compared.
        entry
            .take(MAX_FILE_BYTES + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| broken(format!("{path}: {error}")))?;
        if bytes.len() as u64 > MAX_FILE_BYTES {
            return Err(refused(format!("`{path}` is longer than any map")));
        }
        let target = folder.join(file_name);
        if !target.exists() {
            fs::write(&target, bytes).map_err(Error::at(&target))?;
            written += 1;
        } else if fs::read(&target).map_err(Error::at(&target))? != bytes {
            return Err(refused(format!("two different files of the name `{file_name}`")));
        }
    }
    if written == 0 { Err(refused(format!("it holds no `*{ending}` file"))) } else { Ok(()) }
}

/// Whether a path is absolute or has `..`, on this system or another.
fn leads_elsewhere(path: &str) -> bool {
    path.starts_with(['/', '\\'])
        || path.contains([':', '\0'])
        || path.split(['/', '\\']).any(|part| part == "..")
}

/// The file name of an entry that is to be unpacked.
fn wanted<'a>(path: &'a str, ending: &str) -> Option<&'a str> {
    let file_name = path.rsplit(['/', '\\']).next()?;
    let foreign = path.split(['/', '\\']).any(|part| part == "__MACOSX") || file_name.starts_with('.');
    (file_name.ends_with(ending) && !foreign).then_some(file_name)
}

fn reason(error: ZipError) -> String {
    match error {
        ZipError::Io(error) => error.to_string(),
        other => other.to_string(),
    }
}
