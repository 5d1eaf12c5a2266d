//! The files from which a map is read, which nothing may overwrite.

use std::{
    fs,
    path::{Path, PathBuf},
};

use mediant_formats::{MapFormat, RosSettings};

use crate::{builtin::is_builtin, failure::Failure};

/// Checks that none of the files to write is one from which the map is read.
pub(super) fn check_inputs(map: &Path, written: &[&Path]) -> Result<(), Failure> {
    if written.is_empty() {
        return Ok(());
    }
    let read = files_read(map);
    match written.iter().find(|path| read.iter().any(|read| is_same_file(path, read))) {
        None => Ok(()),
        Some(same) => Err(Failure::SameFile { path: same.to_path_buf() }),
    }
}

/// The files from which a map is read: its own, and the picture of a ROS map.
fn files_read(path: &Path) -> Vec<PathBuf> {
    if is_builtin(path) {
        return Vec::new();
    }
    // The map was read before, so that nothing here can be wrong.
    let bytes = fs::read(path).unwrap_or_default();
    let settings = (MapFormat::of(&bytes, path) == Some(MapFormat::Ros)).then(|| RosSettings::parse(&bytes));
    let image = settings.and_then(Result::ok).map(|settings| {
        let folder = path.parent().unwrap_or(Path::new(""));
        folder.join(settings.image)
    });
    [path.to_owned()].into_iter().chain(image).collect()
}

/// Whether two paths lead to one file that exists.
fn is_same_file(a: &Path, b: &Path) -> bool {
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}
