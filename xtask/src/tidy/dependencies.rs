//! What each crate may depend on.

use super::Finding;
use crate::{
    Error,
    project::{Dependency, Kind, Package, run_cargo},
};

/// The crates of the workspace that a crate itself may use.
enum Allowed {
    Nothing,
    Only(&'static [&'static str]),
    All,
}

/// The layers, lowest first.
const LAYERS: [(&str, Allowed, &str); 12] = [
    ("mediant-moves", Allowed::Nothing, "who wants the mathematics alone compiles nothing else"),
    ("mediant-grid", Allowed::Only(&["mediant-moves"]), "maps know nothing of files or searches"),
    ("mediant-formats", Allowed::Only(&["mediant-grid"]), "reading a file needs no search"),
    ("mediant-search", Allowed::Only(&["mediant-grid", "mediant-moves"]), LOW),
    ("mediant-subgoal", Allowed::Only(&["mediant-search", "mediant-grid", "mediant-moves"]), LOW),
    ("mediant-hierarchy", Allowed::Only(&["mediant-search", "mediant-grid", "mediant-moves"]), LOW),
    ("mediant-oracle", Allowed::Only(&["mediant-grid", "mediant-moves"]), INDEPENDENT),
    (
        "mediant-report",
        Allowed::Only(&["mediant-formats", "mediant-grid", "mediant-moves"]),
        "results can be looked at without the engines that made them",
    ),
    (
        "mediant-engines",
        Allowed::Only(&[
            "mediant-search",
            "mediant-subgoal",
            "mediant-hierarchy",
            "mediant-grid",
            "mediant-moves",
        ]),
        "the catalog serves tests of engines, and knows no files and no reports",
    ),
    ("mediant", Allowed::All, ""),
    ("mediant-bench", Allowed::All, ""),
    ("xtask", Allowed::All, ""),
];

const LOW: &str = "an engine stands on the layers below it, and serves programs of any kind";
const INDEPENDENT: &str = "a reference that shares code with what it checks shares its errors";
const ENGINES: [&str; 4] = ["mediant-search", "mediant-subgoal", "mediant-hierarchy", "mediant-engines"];
const SEARCH: &str = "mediant-search";

/// Compares what the crates say that they need with the layers.
#[must_use]
pub fn check_packages(packages: &[Package]) -> Vec<Finding> {
    let mut findings = Vec::new();
    for package in packages {
        let mut find = |message: String| {
            findings.push(Finding { file: package.name.clone().into(), line: 0, message });
        };
        let Some((_, allowed, reason)) = LAYERS.iter().find(|(name, ..)| *name == package.name) else {
            find(
                "has no place among the layers: add it to them, so that its dependencies are a decision"
                    .to_owned(),
            );
            continue;
        };
        for Dependency { name, kind } in &package.dependencies {
            let ours = packages.iter().any(|package| package.name == *name);
            let fits = match allowed {
                _ if *kind == Some(Kind::Dev) => {
                    package.name != "mediant-oracle" || !ENGINES.contains(&&**name)
                }
                Allowed::Nothing => false,
                Allowed::Only(layers) => !ours || layers.contains(&&**name),
                Allowed::All => true,
            };
            if !fits {
                find(format!("depends on {name}: {reason}"));
            }
        }
    }
    findings
}

/// Looks through what `cargo tree` lists for the search crate.
#[must_use]
pub fn check_tree(tree: &str) -> Vec<Finding> {
    let names = tree.lines().filter_map(|line| line.split(' ').next());
    let heavy = names.filter(|name| matches!(name.split(['-', '_']).next(), Some("serde" | "rayon")));
    let message = |name| {
        format!("compiles {name}: a game or a robot that searches needs no serialization and no thread pool")
    };
    heavy.map(|name| Finding { file: SEARCH.into(), line: 0, message: message(name) }).collect()
}

/// All that a user of the search crate compiles.
pub(super) fn search_tree() -> Result<String, Error> {
    run_cargo(&["tree", "-p", SEARCH, "-e", "normal", "--prefix", "none"])
}
