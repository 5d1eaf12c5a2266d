//! `cargo xtask release --dry-run`: all that would be published, as files, each tried.
//!
//! **The key decision: what is tried is the file, not the sources.** In a folder that is otherwise empty each
//! file is installed as a user installs it, and the first example of its page of the guide is run with it.
//! So a file that is missing in a package, or an example that needs the repository, is found here.
//!
//! Nothing is published: that is for people, and the last lines say by which commands.

mod page;
mod worlds;

use std::{
    fs::{self, DirEntry},
    io,
    path::{Path, PathBuf},
};

use clap::{Args, ValueEnum};
use mediant_sets::root;
use sha2::{Digest, Sha256};

use crate::{
    Error,
    project::{self, Package},
};

/// The folder for the files, which is emptied first.
const FOLDER: &str = "target/dist";
/// The list of the files' digests, as `sha256sum --check` reads it.
const DIGESTS: &str = "SHA256SUMS";

/// The options of `cargo xtask release`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Publish nothing: all that this chore does
    #[arg(long, required = true)]
    pub dry_run: bool,
    /// Only these
    #[arg(long, value_name = "WORLD", num_args = 1..)]
    pub only: Vec<World>,
}

/// A world that users come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum World {
    /// The crates.
    Rust,
    /// The program, from its crate.
    Shell,
    /// The wheel.
    Python,
    /// The npm package.
    Web,
    /// The library for C.
    C,
}

impl World {
    /// The commands by which people publish the files, from the folder that holds them or from the root.
    fn publishing(self) -> &'static str {
        match self {
            Self::Rust => "cargo publish --workspace",
            // It is one of the crates.
            Self::Shell => "",
            Self::Python => "twine upload mediant-*.whl",
            Self::Web => "npm publish mediant-*.tgz",
            Self::C => "gh release create TAG libmediant-*.tar.gz SHA256SUMS",
        }
    }
}

/// Makes the files of all worlds, tries each, and lists them.
///
/// # Errors
/// [`Error::Lacking`] if a tool is not here or the changelog has no such version, [`Error::Step`] for a
/// command that failed, [`Error::Said`] for an example that says something else, [`Error::Io`] for a file.
pub fn run(options: &Options) -> Result<(), Error> {
    let version = version()?;
    in_changelog(&version)?;
    let into = root().join(FOLDER);
    if into.exists() {
        fs::remove_dir_all(&into).map_err(Error::at(&into))?;
    }
    fs::create_dir_all(&into).map_err(Error::at(&into))?;
    let is_asked = |world: &&World| options.only.is_empty() || options.only.contains(world);
    let worlds: Vec<World> = World::value_variants().iter().filter(is_asked).copied().collect();
    for world in &worlds {
        worlds::make(*world, &into, &version)?;
    }
    for world in &worlds {
        let folder = tempfile::tempdir().map_err(Error::at(&std::env::temp_dir()))?;
        println!("\n{world:?}: installed in an empty folder");
        let said = worlds::first_example(*world, &into, folder.path(), &version)?;
        println!("{}", said.trim_end());
    }
    list(&into)?;
    println!("\nNothing was published. By hand, when all agree:");
    let commands = worlds.iter().map(|world| world.publishing()).filter(|command| !command.is_empty());
    commands.for_each(|command| println!("  {command}"));
    Ok(())
}

/// The version of all published crates.
fn version() -> Result<String, Error> {
    let packages = project::packages()?;
    let is_published = |package: &&Package| project::published().any(|name| name == package.name);
    let mut versions = packages.iter().filter(is_published).map(|package| &package.version);
    let first = versions.next().cloned().unwrap_or_default();
    if versions.all(|version| *version == first) {
        Ok(first)
    } else {
        Err(Error::Lacking {
            what: "the published crates have several versions".to_owned(),
            mend: "write `version.workspace = true` in each".to_owned(),
        })
    }
}

fn in_changelog(version: &str) -> Result<(), Error> {
    let path = root().join("CHANGELOG.md");
    let text = fs::read_to_string(&path).map_err(Error::at(&path))?;
    let is_heading =
        |line: &str| line.strip_prefix("## ").and_then(|rest| rest.split(' ').next()) == Some(version);
    if text.lines().any(is_heading) {
        Ok(())
    } else {
        Err(Error::Lacking {
            what: format!("CHANGELOG.md has no heading `## {version}`"),
            mend: "say there what changed for users".to_owned(),
        })
    }
}

/// Prints the files with their sizes, and writes their digests.
fn list(into: &Path) -> Result<(), Error> {
    let entries: io::Result<Vec<DirEntry>> = fs::read_dir(into).and_then(Iterator::collect);
    let mut paths: Vec<PathBuf> = entries.map_err(Error::at(into))?.iter().map(DirEntry::path).collect();
    paths.sort();
    let mut digests = String::new();
    println!("\n{:>9}  file", "kB");
    for path in &paths {
        let bytes = fs::read(path).map_err(Error::at(path))?;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        println!("{:>9}  {name}", bytes.len().div_ceil(1000));
        let digest: String = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        digests += &format!("{digest}  {name}\n");
    }
    let file = into.join(DIGESTS);
    fs::write(&file, digests).map_err(Error::at(&file))?;
    println!("in {}", into.display());
    Ok(())
}
