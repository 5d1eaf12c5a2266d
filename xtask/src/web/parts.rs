//! Files of the folders that are put together.

use std::{collections::BTreeSet, fs, path::Path};

use serde_json::Value;

use crate::Error;

/// A file of a folder.
pub(super) struct File {
    /// From the folder, with `/` on every system.
    pub(super) path: String,
    pub(super) bytes: Vec<u8>,
}

impl File {
    /// Reads a file that gets this path.
    pub(super) fn read(at: &Path, path: &str) -> Result<Self, Error> {
        Ok(Self { path: path.to_owned(), bytes: fs::read(at).map_err(Error::at(at))? })
    }
}

/// The paths of all files of a folder and of those in it, sorted; hidden ones are left out.
pub(super) fn list(folder: &Path) -> Result<Vec<String>, Error> {
    let mut paths = Vec::new();
    walk(folder, "", &mut paths)?;
    paths.sort();
    Ok(paths)
}

fn walk(folder: &Path, prefix: &str, paths: &mut Vec<String>) -> Result<(), Error> {
    for entry in fs::read_dir(folder).map_err(Error::at(folder))? {
        let entry = entry.map_err(Error::at(folder))?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if name.starts_with('.') {
            continue;
        }
        let at = entry.path();
        if at.is_dir() {
            walk(&at, &format!("{prefix}{name}/"), paths)?;
        } else {
            paths.push(format!("{prefix}{name}"));
        }
    }
    Ok(())
}

/// Makes a folder hold these files and no others. Files that are the same stay untouched.
pub(super) fn write_folder(folder: &Path, files: &[File]) -> Result<(), Error> {
    fs::create_dir_all(folder).map_err(Error::at(folder))?;
    let wanted: BTreeSet<&str> = files.iter().map(|file| &*file.path).collect();
    for path in list(folder)?.iter().filter(|path| !wanted.contains(&***path)) {
        let old = folder.join(path);
        fs::remove_file(&old).map_err(Error::at(&old))?;
        // Its folder, if nothing else is in it, and so on.
        for emptied in old.ancestors().skip(1).take_while(|path| *path != folder) {
            let _ = fs::remove_dir(emptied);
        }
    }
    for file in files {
        let at = folder.join(&file.path);
        if fs::read(&at).is_ok_and(|bytes| bytes == file.bytes) {
            continue;
        }
        if let Some(parent) = at.parent() {
            fs::create_dir_all(parent).map_err(Error::at(parent))?;
        }
        fs::write(&at, &file.bytes).map_err(Error::at(&at))?;
    }
    Ok(())
}

/// JSON for people, with a line break at its end.
pub(super) fn pretty(value: &Value) -> Vec<u8> {
    format!("{value:#}\n").into_bytes()
}

#[cfg(test)]
mod tests {
    use super::{File, list, write_folder};

    #[test]
    fn a_folder_holds_what_it_is_told_and_no_more() {
        let folder = tempfile::tempdir().unwrap();
        let file = |path: &str, text: &str| File { path: path.to_owned(), bytes: text.into() };
        write_folder(folder.path(), &[file("a/b.js", "1"), file("c.js", "2")]).unwrap();
        write_folder(folder.path(), &[file("a/b.js", "3"), file("d.js", "2")]).unwrap();
        assert_eq!(list(folder.path()).unwrap(), ["a/b.js", "d.js"]);
        write_folder(folder.path(), &[file("d.js", "2")]).unwrap();
        assert!(!folder.path().join("a").exists());
        write_folder(folder.path(), &[file("a/b.js", "3"), file("d.js", "2")]).unwrap();
        assert_eq!(std::fs::read_to_string(folder.path().join("a/b.js")).unwrap(), "3");
    }
}
