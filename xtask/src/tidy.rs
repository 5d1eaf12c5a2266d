//! `cargo xtask tidy`: the rules of the project that the compiler does not know.
//!
//! Each finding states the reason of its rule. The same check is a test of this crate, so that `cargo test`
//! holds it too.

mod clauses;
mod dependencies;
mod figures;
mod finding;
mod links;
mod modules;
mod published;
mod source;
mod text;
mod width;

use std::path::Path;

use mediant_sets::root;

use crate::{Error, describe, project, tree::Tree};

pub use clauses::MOST_CLAUSES;
pub use dependencies::{COMPILED, Compiled, check_compiled, check_packages};
pub use finding::{Exception, Finding};
pub use published::check_published;

/// All exceptions of the project. One that is not needed any more is itself a finding, so that the list only
/// shrinks.
pub const EXCEPTIONS: &[Exception] = &[];

/// The findings of the rules about files, sorted.
#[must_use]
pub fn check_files(tree: &Tree, exceptions: &[Exception]) -> Vec<Finding> {
    let mut findings = Vec::new();
    text::check(tree, &mut findings);
    source::check(tree, exceptions, &mut findings);
    modules::check(tree, &mut findings);
    links::check(tree, &mut findings);
    width::check(tree, &mut findings);
    clauses::check(tree, &mut findings);
    figures::check(tree, &mut findings);
    described(tree, &mut findings);
    findings.sort();
    findings
}

/// Every language says what the library says of itself.
fn described(tree: &Tree, findings: &mut Vec<Finding>) {
    // A tree without the description is a test's.
    if !tree.holds(Path::new(describe::FILE)) {
        return;
    }
    let mut find = |file: &Path, message: String| {
        findings.push(Finding { file: file.to_owned(), line: 0, message });
    };
    match describe::outdated(tree) {
        Ok(files) => files.iter().for_each(|(file, _)| {
            find(file, format!("it differs from {}: run `cargo xtask describe`", describe::FILE));
        }),
        Err(wrong) => find(Path::new(describe::FILE), wrong),
    }
}

/// All findings in the project: the files, what its crates depend on, and what is published.
///
/// # Errors
/// [`Error::Io`] for a file that cannot be read, [`Error::Step`] if cargo fails.
pub fn check(root: &Path) -> Result<Vec<Finding>, Error> {
    let (tree, packages) = (Tree::read(root)?, project::packages()?);
    let mut findings = check_files(&tree, EXCEPTIONS);
    findings.extend(check_packages(&packages));
    findings.extend(check_published(&packages, &tree));
    for rule in &COMPILED {
        findings.extend(check_compiled(rule, &rule.tree()?));
    }
    Ok(findings)
}

/// Prints all findings.
///
/// # Errors
/// As for [`check`], and [`Error::Tidy`] if there is a finding.
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
