//! The crates and files of the project.

use std::{
    collections::BTreeMap,
    env, fs, io,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use mediant_sets::root;
use serde::Deserialize;
use serde_json::Value;

use crate::Error;

/// The published libraries, each after those that it depends on.
pub const LIBRARIES: [&str; 8] = [
    "mediant-moves",
    "mediant-grid",
    "mediant-formats",
    "mediant-search",
    "mediant-subgoal",
    "mediant-hierarchy",
    "mediant-costs",
    "mediant",
];

/// The published program.
pub const PROGRAM: &str = "mediant-cli";

/// All crates that are published, in an order in which they can be.
pub fn published() -> impl Iterator<Item = &'static str> {
    LIBRARIES.into_iter().chain([PROGRAM])
}

/// A crate of the workspace, from `cargo metadata`.
#[derive(Clone, Debug, Default, Deserialize)]
pub struct Package {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Its `Cargo.toml`, from the root.
    pub manifest_path: PathBuf,
    /// The oldest Rust that it promises to compile with.
    pub rust_version: Option<String>,
    /// Its dependencies, with those of tests.
    pub dependencies: Vec<Dependency>,
    /// The registries that take it: none for `publish = false`, any where the line is missing.
    pub publish: Option<Vec<String>>,
    /// Its description, in a line.
    pub description: Option<String>,
    /// Its README, from its folder.
    pub readme: Option<PathBuf>,
    /// Its features.
    pub features: BTreeMap<String, Vec<String>>,
    /// Settings of other programs than cargo, docs.rs among them.
    #[serde(default)]
    pub metadata: Value,
}

/// One line of a `Cargo.toml`.
#[derive(Clone, Debug, Deserialize)]
pub struct Dependency {
    /// The other crate.
    pub name: String,
    /// The kind; `None` for the crate itself.
    pub kind: Option<Kind>,
    /// Whether it is compiled only for a feature.
    pub optional: bool,
}

/// The use of a dependency, if not by the crate itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Its build script.
    Build,
    /// Its tests, benches and examples.
    Dev,
}

/// The cargo that runs this, or the one on the path.
#[must_use]
pub fn cargo() -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root());
    command
}

/// The output of a cargo command.
///
/// # Errors
/// [`Error::Step`] if it fails; its messages went to stderr.
pub fn run_cargo(arguments: &[&str]) -> Result<String, Error> {
    let output = cargo().args(arguments).stderr(Stdio::inherit()).output();
    let output = output.ok().filter(|output| output.status.success());
    let failed = || Error::Step { command: format!("cargo {}", arguments.join(" ")) };
    output.and_then(|output| String::from_utf8(output.stdout).ok()).ok_or_else(failed)
}

/// The crates of the workspace.
///
/// # Errors
/// [`Error::Step`] if cargo fails.
pub fn packages() -> Result<Vec<Package>, Error> {
    #[derive(Deserialize)]
    struct Metadata {
        packages: Vec<Package>,
        workspace_root: PathBuf,
    }
    let arguments = ["metadata", "--no-deps", "--format-version", "1"];
    let metadata = serde_json::from_str::<Metadata>(&run_cargo(&arguments)?);
    let mut metadata = metadata
        .map_err(|error| Error::Step { command: format!("cargo {}: {error}", arguments.join(" ")) })?;
    for package in &mut metadata.packages {
        if let Ok(path) = package.manifest_path.strip_prefix(&metadata.workspace_root) {
            package.manifest_path = path.to_owned();
        }
    }
    Ok(metadata.packages)
}

/// The files that git tracks or would add, as paths from `root`, sorted. Where git does not answer (an
/// unpacked archive, or a checkout of another user), all files but those of `.gitignore`'s folders.
///
/// # Errors
/// [`Error::Io`] for a folder that cannot be listed.
pub fn files(root: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut git = Command::new("git");
    git.args(["ls-files", "--cached", "--others", "--exclude-standard", "-z"]).current_dir(root);
    let mut files = Vec::new();
    match git.output() {
        Ok(output) if output.status.success() => {
            let names = String::from_utf8_lossy(&output.stdout).into_owned();
            // A file that was deleted but not yet committed is still listed.
            files.extend(
                names.split_terminator('\0').map(PathBuf::from).filter(|file| root.join(file).is_file()),
            );
        }
        _ => walk(root, Path::new(""), &mut files)?,
    }
    files.sort();
    files.dedup();
    Ok(files)
}

fn walk(root: &Path, folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Error> {
    const IGNORED: [&str; 3] = [".git", "target", "benchdata/cache"];
    let at = root.join(folder);
    let entries: io::Result<Vec<_>> = fs::read_dir(&at).and_then(Iterator::collect);
    for entry in entries.map_err(Error::at(&at))? {
        let path = folder.join(entry.file_name());
        let kind = entry.file_type().map_err(Error::at(&at))?;
        if kind.is_file() {
            files.push(path);
        } else if kind.is_dir() && !IGNORED.iter().any(|ignored| path == Path::new(ignored)) {
            walk(root, &path, files)?;
        }
    }
    Ok(())
}
