//! The sources on which a result depends: those of the libraries, and of the comparisons.

use std::{
    fs,
    path::{Path, PathBuf},
};

use sha2::{Digest, Sha256};

use super::{Pace, ProveError};

/// The sources that decide what a family finds, and those that also decide what a law finds. Folders stand
/// for all files in them.
const OF_FAMILIES: [&str; 10] = [
    "crates/moves/src",
    "crates/grid/src",
    "crates/search/src",
    "crates/subgoal/src",
    "crates/formats/src",
    "crates/mediant/src",
    "crates/bench/src/grounds.rs",
    "crates/bench/src/prove/families.rs",
    "crates/bench/src/prove/outcome.rs",
    "crates/bench/src/prove/terrain.rs",
];
const OF_LAWS: [&str; 4] =
    ["crates/hierarchy/src", "crates/costs/src", "crates/oracle/src", "crates/bench/src/prove/laws"];

/// The digests of the sources by which results are known.
#[derive(Clone, Debug)]
pub(super) struct Sources {
    families: String,
    laws: String,
}

impl Sources {
    /// Reads the sources below `root`. How much the slow engines are asked belongs to what a family finds.
    pub(super) fn read(root: &Path, pace: Pace) -> Result<Self, ProveError> {
        let mut digest = Sha256::new();
        add_all(root, &OF_FAMILIES, &mut digest)?;
        let mut of_laws = digest.clone();
        digest.update(pace.slow.to_le_bytes());
        digest.update(pace.at_large_k.to_le_bytes());
        add_all(root, &OF_LAWS, &mut of_laws)?;
        Ok(Self { families: text(digest), laws: text(of_laws) })
    }

    /// The digest on which a family's, or a law's, results depend: twelve digits.
    pub(super) fn of(&self, is_law: bool) -> &str {
        if is_law { &self.laws } else { &self.families }
    }
}

fn text(digest: Sha256) -> String {
    digest.finalize().iter().take(6).map(|byte| format!("{byte:02x}")).collect()
}

fn add_all(root: &Path, places: &[&str], digest: &mut Sha256) -> Result<(), ProveError> {
    let mut files = Vec::new();
    for place in places {
        add(&root.join(place), &mut files)?;
    }
    files.sort();
    for file in files {
        let name = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        digest.update(format!("{name}\n"));
        let source = fs::read_to_string(&file).map_err(ProveError::at(&file))?;
        // Comments decide nothing.
        for line in source.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//")) {
            digest.update(format!("{line}\n"));
        }
    }
    Ok(())
}

/// Adds a file, or the Rust files of a folder and of those in it.
fn add(place: &Path, files: &mut Vec<PathBuf>) -> Result<(), ProveError> {
    if !place.is_dir() {
        files.push(place.to_owned());
        return Ok(());
    }
    for entry in fs::read_dir(place).map_err(ProveError::at(place))? {
        let path = entry.map_err(ProveError::at(place))?.path();
        if path.is_dir() || path.extension().is_some_and(|ending| ending == "rs") {
            add(&path, files)?;
        }
    }
    Ok(())
}
