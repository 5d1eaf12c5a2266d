//! Where the project and its benchmark sets lie.

use std::{
    env,
    path::{Path, PathBuf},
};

use crate::Manifest;

/// The folder of the workspace.
///
/// Under cargo, the workspace of the package that cargo runs: two clones that share a target folder also
/// share the compiled program, so the folder where it was compiled may be another clone's. Without cargo,
/// that folder.
#[must_use]
pub fn root() -> PathBuf {
    let package =
        env::var_os("CARGO_MANIFEST_DIR").map_or_else(|| env!("CARGO_MANIFEST_DIR").into(), PathBuf::from);
    let root = package.ancestors().find(|folder| Manifest::path(folder).is_file());
    root.unwrap_or(&package).to_owned()
}

/// The folder of the downloaded sets in the project at `root`: it holds `SET/*.map`, `SET/*.map.scen`, and
/// the archives in `zips/`.
#[must_use]
pub fn cache(root: &Path) -> PathBuf {
    root.join("benchdata").join("cache")
}
