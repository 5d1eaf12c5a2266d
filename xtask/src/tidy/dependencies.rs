//! The dependencies that each crate may have.

use std::collections::BTreeSet;

use super::finding::Finding;
use crate::{
    Error,
    project::{Dependency, Kind, Package, run_cargo},
};

/// A crate, what it may use of the workspace, and why no more. Tests, benches and examples may use more.
struct Layer {
    package: &'static str,
    uses: &'static [&'static str],
    /// Whether crates from elsewhere are allowed, other than for a feature.
    foreign: bool,
    reason: &'static str,
}

const fn layer(package: &'static str, uses: &'static [&'static str], reason: &'static str) -> Layer {
    Layer { package, uses, foreign: true, reason }
}

/// The layers, lowest first, in four groups.
const LAYERS: [Layer; 20] = [
    // The mathematics and the map.
    Layer {
        foreign: false,
        ..layer(MOVES, &[], "a user who wants the mathematics alone compiles nothing else")
    },
    layer(GRID, &[MOVES], "maps know nothing of files or searches"),
    // The engines.
    layer(SEARCH, &[MOVES, GRID], LOW),
    layer(SUBGOAL, &[MOVES, GRID, SEARCH], LOW),
    layer(HIERARCHY, &[MOVES, GRID, SEARCH], LOW),
    layer(COSTS, &[MOVES, GRID, SEARCH], LOW),
    // The crates that people depend on.
    layer(FORMATS, &[GRID], "reading a file needs no search"),
    layer(
        LIBRARY,
        &[MOVES, GRID, SEARCH, SUBGOAL, HIERARCHY, COSTS, FORMATS],
        "the library serves programs and bindings of all kinds, and knows none of them",
    ),
    layer(
        "mediant-cli",
        &[LIBRARY, FORMATS],
        "the program is thin: it shows what the library and the files hold, and says it in the library's words",
    ),
    layer(
        "mediant-python",
        &[LIBRARY, FORMATS],
        "the package is thin: names, conversions and words on top of the library",
    ),
    layer(
        "mediant-web",
        &[LIBRARY, FORMATS],
        "the package is thin: names, conversions and words on top of the library",
    ),
    layer(
        "mediant-c",
        &[LIBRARY],
        "the library of C is thin: handles, arrays and words on top of the library",
    ),
    layer("mediant-gppc", &[LIBRARY], "an entry of the competition converts what its harness hands over"),
    // Tests and measurements.
    layer(ORACLE, &[MOVES, GRID], "a reference that shares code with what it checks shares its errors"),
    layer(REPORT, &[MOVES, GRID], "results can be looked at without the engines that made them"),
    layer(SETS, &[GRID, FORMATS], "a set is downloaded and verified without an engine"),
    layer(
        BENCH,
        &[MOVES, GRID, SEARCH, SUBGOAL, LIBRARY, FORMATS, ORACLE, REPORT, SETS],
        "measurements take engines as users have them",
    ),
    layer(
        "mediant-papers",
        &[MOVES, GRID, SEARCH, SUBGOAL, LIBRARY, FORMATS, ORACLE, REPORT, SETS, BENCH],
        "the papers are reproduced by the library, not by the program",
    ),
    layer("mediant-guide", &[LIBRARY, REPORT, SETS], "the guide shows what a user of the library can do"),
    layer("xtask", &[REPORT, SETS], "chores that run engines are programs of other crates"),
];

const MOVES: &str = "mediant-moves";
const GRID: &str = "mediant-grid";
const SEARCH: &str = "mediant-search";
const SUBGOAL: &str = "mediant-subgoal";
const HIERARCHY: &str = "mediant-hierarchy";
const COSTS: &str = "mediant-costs";
const LIBRARY: &str = "mediant";
const FORMATS: &str = "mediant-formats";
const ORACLE: &str = "mediant-oracle";
const REPORT: &str = "mediant-report";
const SETS: &str = "mediant-sets";
const BENCH: &str = "mediant-bench";
const LOW: &str = "an engine stands on the layers below it, and serves programs of any kind";

/// Compares the dependencies of the crates with the layers.
#[must_use]
pub fn check_packages(packages: &[Package]) -> Vec<Finding> {
    let mut findings = Vec::new();
    for package in packages {
        let mut find = |message: String| {
            findings.push(Finding { file: package.name.clone().into(), line: 0, message });
        };
        let Some(layer) = LAYERS.iter().find(|layer| layer.package == package.name) else {
            find(
                "has no place among the layers: add it to them, so that its dependencies are a decision"
                    .to_owned(),
            );
            continue;
        };
        for Dependency { name, kind, optional } in &package.dependencies {
            let ours = packages.iter().any(|package| package.name == *name);
            let fits = match kind {
                Some(Kind::Dev) => {
                    let engine = [SEARCH, SUBGOAL, HIERARCHY, COSTS, LIBRARY].contains(&&**name);
                    package.name != ORACLE || !engine
                }
                _ if ours => layer.uses.contains(&&**name),
                _ => layer.foreign || *optional,
            };
            if !fits {
                find(format!("depends on {name}: {}", layer.reason));
            }
        }
    }
    findings
}

/// The crates that a crate must not compile, by itself or by its dependencies.
#[derive(Clone, Copy, Debug)]
pub struct Compiled {
    /// The crate.
    pub package: &'static str,
    /// Further options of `cargo tree`.
    options: &'static [&'static str],
    /// The crates; those whose names go on after `-` or `_` are meant too.
    never: &'static [&'static str],
    reason: &'static str,
}

/// The crates that must stay light.
pub const COMPILED: [Compiled; 4] = [
    Compiled {
        package: SEARCH,
        options: &[],
        never: &["serde", "rayon"],
        reason: "a game or a robot that searches needs no serialization and no thread pool",
    },
    Compiled {
        package: LIBRARY,
        options: &[],
        never: &["serde", "rayon", "clap"],
        reason: "who embeds the library decides on serialization and threads, and has a command line of their own",
    },
    Compiled {
        package: FORMATS,
        options: &["--no-default-features"],
        never: &["png", "serde", "sha2", "tiff"],
        reason: "a reader of `.map` files needs no JSON, no hashes and no pictures",
    },
    Compiled {
        package: "xtask",
        options: &[],
        // The library compiles all three, and its name begins those of all our crates.
        never: &[SEARCH, SUBGOAL, HIERARCHY, COSTS],
        reason: "`cargo xtask tidy` answers within seconds, and an engine takes minutes",
    },
];

impl Compiled {
    /// All that a user of the crate compiles, as `cargo tree` lists it.
    pub(super) fn tree(&self) -> Result<String, Error> {
        let tree = ["tree", "-p", self.package, "-e", "normal", "--prefix", "none"];
        run_cargo(&[&tree[..], self.options].concat())
    }
}

/// Looks for forbidden crates in the list of `cargo tree`.
#[must_use]
pub fn check_compiled(rule: &Compiled, tree: &str) -> Vec<Finding> {
    let is = |name: &str, never: &&str| {
        name.strip_prefix(never).is_some_and(|rest| rest.is_empty() || rest.starts_with(['-', '_']))
    };
    // A crate is listed once for each that depends on it.
    let mut seen = BTreeSet::new();
    let names = tree.lines().filter_map(|line| line.split(' ').next()).filter(|name| seen.insert(*name));
    let heavy = names.filter(|name| rule.never.iter().any(|never| is(name, never)));
    let message = |name: &str| format!("compiles {name}: {}", rule.reason);
    heavy.map(|name| Finding { file: rule.package.into(), line: 0, message: message(name) }).collect()
}
