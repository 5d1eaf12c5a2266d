//! `cargo xtask tidy`: the rules of the project that the compiler does not know.
//!
//! Each finding states the reason of its rule. The same check is a test of this crate, so that `cargo test` holds it too.

mod dependencies;
mod links;
mod modules;
mod source;
mod text;

use std::{
    fmt, fs,
    path::{Path, PathBuf},
};

use mediant_sets::root;

use crate::{Error, project};

pub use dependencies::{check_packages, check_tree};

/// A place that may be longer than the rule says.
#[derive(Clone, Copy, Debug)]
pub struct Exception {
    /// The file, from the root.
    pub file: &'static str,
    /// The function; the whole file where there is none.
    pub function: Option<&'static str>,
    /// How many lines it may have.
    pub lines: usize,
    /// Why it is not made shorter.
    pub reason: &'static str,
}

/// All exceptions of the project. One that is not needed any more is itself a finding, so that the list only shrinks.
pub const EXCEPTIONS: &[Exception] = &[];

/// A rule that is broken.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Finding {
    /// From the root.
    pub file: PathBuf,
    /// From 1; 0 for the whole file.
    pub line: usize,
    /// What is wrong, and why that matters.
    pub message: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, message } = self;
        match line {
            0 => write!(f, "{}: {message}", file.display()),
            _ => write!(f, "{}:{line}: {message}", file.display()),
        }
    }
}

/// The files of the project with their contents.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    files: Vec<(PathBuf, Vec<u8>)>,
}

impl Tree {
    /// A tree of these files, paths from the root.
    #[must_use]
    pub fn new(files: Vec<(PathBuf, Vec<u8>)>) -> Self {
        Self { files }
    }

    /// Reads the files that git tracks or would add.
    ///
    /// # Errors
    /// [`Error::Io`] for one that cannot be read.
    pub fn read(root: &Path) -> Result<Self, Error> {
        let read = |path: PathBuf| match fs::read(root.join(&path)) {
            Ok(bytes) => Ok((path, bytes)),
            Err(source) => Err(Error::Io { path, source }),
        };
        project::files(root)?.into_iter().map(read).collect::<Result<_, _>>().map(Self::new)
    }

    /// All files.
    fn files(&self) -> impl Iterator<Item = (&Path, &[u8])> {
        self.files.iter().map(|(path, bytes)| (&**path, &**bytes))
    }

    /// The files with these extensions that are text.
    fn texts(&self, extensions: &[&str]) -> impl Iterator<Item = (&Path, &str)> {
        let named = self.files().filter(|(path, _)| {
            path.extension().is_some_and(|found| extensions.iter().any(|extension| found == *extension))
        });
        named.filter_map(|(path, bytes)| Some((path, std::str::from_utf8(bytes).ok()?)))
    }

    /// Whether there is a file of this path, or one below it.
    fn holds(&self, path: &Path) -> bool {
        self.files.iter().any(|(file, _)| file.starts_with(path))
    }
}

/// What the rules about the files find, sorted.
#[must_use]
pub fn check_files(tree: &Tree, exceptions: &[Exception]) -> Vec<Finding> {
    let mut findings = Vec::new();
    text::check(tree, &mut findings);
    source::check(tree, exceptions, &mut findings);
    modules::check(tree, &mut findings);
    links::check(tree, &mut findings);
    findings.sort();
    findings
}

/// All findings in the project: the files, and what its crates depend on.
///
/// # Errors
/// [`Error::Io`] for a file that cannot be read, [`Error::Step`] if cargo fails.
pub fn check(root: &Path) -> Result<Vec<Finding>, Error> {
    let mut findings = check_files(&Tree::read(root)?, EXCEPTIONS);
    findings.extend(check_packages(&project::packages()?));
    findings.extend(check_tree(&dependencies::search_tree()?));
    Ok(findings)
}

/// Prints all findings.
///
/// # Errors
/// Those of [`check`], and [`Error::Tidy`] if there is a finding.
pub fn run() -> Result<(), Error> {
    let findings = check(&root())?;
    for finding in &findings {
        println!("{finding}");
    }
    match findings.len() {
        0 => Ok(()),
        count => Err(Error::Tidy { count }),
    }
}
