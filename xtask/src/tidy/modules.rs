//! Rust files that no `mod` line reaches.

use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
};

use syn::Item;

use super::finding::Finding;
use crate::tree::Tree;

pub(super) fn check(tree: &Tree, findings: &mut Vec<Finding>) {
    let sources: Vec<(&Path, &str)> = tree.texts(&["rs"]).collect();
    let packages: Vec<&Path> =
        tree.files().filter_map(|(path, _)| path.parent().filter(|_| path.ends_with("Cargo.toml"))).collect();
    let mut reached = BTreeSet::new();
    let mut pending: Vec<(&Path, &str, PathBuf)> = Vec::new();
    for &(path, text) in &sources {
        if packages.iter().any(|package| path.strip_prefix(package).is_ok_and(is_target)) {
            pending.push((path, text, path.parent().unwrap_or(Path::new("")).to_owned()));
        }
    }
    while let Some((path, text, folder)) = pending.pop() {
        reached.insert(path);
        let Ok(file) = syn::parse_file(text) else { continue };
        let mut modules = Vec::new();
        declared(&file.items, &folder, &mut modules);
        for (module, name) in modules {
            let candidates = [module.join(format!("{name}.rs")), module.join(&name).join("mod.rs")];
            let found =
                sources.iter().filter(|(path, _)| candidates.iter().any(|candidate| candidate == path));
            pending.extend(
                found
                    .filter(|(path, _)| !reached.contains(path))
                    .map(|&(path, text)| (path, text, module.join(&name))),
            );
        }
    }
    for (path, _) in sources.iter().filter(|(path, _)| !reached.contains(path)) {
        let message = "no `mod` line declares this file: code that is not compiled rots unseen".to_owned();
        findings.push(Finding { file: path.to_path_buf(), line: 0, message });
    }
}

/// Whether cargo takes this file of a package for the root of a crate.
fn is_target(path: &Path) -> bool {
    let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy()).collect();
    matches!(
        &parts.iter().map(|part| &**part).collect::<Vec<_>>()[..],
        ["build.rs"]
            | ["src", "lib.rs" | "main.rs"]
            | ["src", "bin", _]
            | ["src", "bin", _, "main.rs"]
            | ["tests" | "benches" | "examples", _]
            | ["tests" | "benches" | "examples", _, "main.rs"]
    )
}

/// The folder and name of each module that has a file of its own.
fn declared(items: &[Item], folder: &Path, modules: &mut Vec<(PathBuf, String)>) {
    for item in items {
        let Item::Mod(module) = item else { continue };
        let name = module.ident.to_string();
        match &module.content {
            None => modules.push((folder.to_owned(), name)),
            Some((_, items)) => declared(items, &folder.join(name), modules),
        }
    }
}
