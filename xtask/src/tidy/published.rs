//! Requirements of published crates, and a check that no other is published.

use std::path::Path;

use super::{finding::Finding, links};
use crate::{
    project::{Package, published},
    tree::Tree,
};

/// Checks the manifests of the crates, and the files that travel with their packages.
#[must_use]
pub fn check_published(packages: &[Package], tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    for package in packages {
        let mut find = |file: &Path, line, message: &str| {
            findings.push(Finding { file: file.to_owned(), line, message: message.to_owned() });
        };
        let kept_back = package.publish.as_ref().is_some_and(Vec::is_empty);
        if published().any(|name| name == package.name) {
            if kept_back {
                let message = "`publish = false` in a crate that is published: others depend on it";
                find(&package.manifest_path, 0, message);
            }
            describes_itself(package, &mut find);
            travels(package, tree, &mut find);
        } else if !kept_back {
            let message = "`publish = false` is missing: nobody should depend on this crate by accident";
            find(&package.manifest_path, 0, message);
        }
    }
    findings
}

/// Checks description and docs.rs settings in its `Cargo.toml`.
fn describes_itself(package: &Package, find: &mut impl FnMut(&Path, usize, &str)) {
    let manifest = &package.manifest_path;
    if package.description.as_ref().is_none_or(String::is_empty) {
        find(manifest, 0, "no `description`: a registry refuses such a crate");
    }
    if !package.features.is_empty() && package.metadata["docs"]["rs"]["all-features"] != true {
        let message = "no `all-features = true` for docs.rs: what a feature adds would be missing there";
        find(manifest, 0, message);
    }
}

/// Checks the license and README beside it.
fn travels(package: &Package, tree: &Tree, find: &mut impl FnMut(&Path, usize, &str)) {
    let folder = package.manifest_path.parent().unwrap_or(Path::new(""));
    let license = folder.join("LICENSE");
    match (tree.bytes(&license), tree.bytes(Path::new("LICENSE"))) {
        (None, _) => find(&license, 0, "no such file: the license asks to travel with every copy"),
        (Some(copy), Some(original)) if copy != original => {
            find(&license, 0, "differs from the LICENSE at the top: there is one license");
        }
        _ => {}
    }
    let readme = package.readme.as_ref().map(|readme| folder.join(readme));
    let text = readme.as_ref().and_then(|path| tree.bytes(path)).map(String::from_utf8_lossy);
    let (Some(readme), Some(text)) = (readme, text) else {
        let message = "no README, or one that is not there: it is the crate's page in a registry";
        return find(&package.manifest_path, 0, message);
    };
    for (line, target) in links::targets(&text) {
        let message = format!("a link to `{target}`: a registry's page has no other file to lead to");
        find(&readme, line, &message);
    }
}
