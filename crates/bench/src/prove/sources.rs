//! What a result depends on: the sources of the libraries, and of this program.

use std::{
    fs,
    path::{Path, PathBuf},
};

use sha2::{Digest, Sha256};

use super::{Pace, ProveError};

/// The folders whose sources decide what is found.
const FOLDERS: [&str; 10] = [
    "crates/moves/src",
    "crates/grid/src",
    "crates/search/src",
    "crates/subgoal/src",
    "crates/hierarchy/src",
    "crates/costs/src",
    "crates/formats/src",
    "crates/mediant/src",
    "crates/oracle/src",
    "crates/bench/src/prove",
];

/// The first twelve digits of the digest of all sources below `root`, and of how much the slow engines are
/// asked: results of other sources are none of these.
pub(super) fn digest(root: &Path, pace: Pace) -> Result<String, ProveError> {
    let mut files = Vec::new();
    for folder in FOLDERS {
        add(&root.join(folder), &mut files)?;
    }
    files.sort();
    let mut digest = Sha256::new();
    digest.update(pace.slow.to_le_bytes());
    for file in files {
        let text = fs::read(&file).map_err(ProveError::at(&file))?;
        let name = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        digest.update(format!("{name} {}\n", text.len()));
        digest.update(text);
    }
    Ok(digest.finalize().iter().take(6).map(|byte| format!("{byte:02x}")).collect())
}

/// Adds the Rust files of a folder and of those in it.
fn add(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), ProveError> {
    for entry in fs::read_dir(folder).map_err(ProveError::at(folder))? {
        let path = entry.map_err(ProveError::at(folder))?.path();
        if path.is_dir() {
            add(&path, files)?;
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
    Ok(())
}
