//! The mutants, as cargo-mutants lists them, and those that are tried.

use std::process::Command;

use mediant_sets::root;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::Error;

/// The kind of a mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
pub(super) enum Genre {
    /// Another value of a function.
    #[serde(rename = "FnValue")]
    Value,
    /// Another binary operator.
    #[serde(rename = "BinaryOperator")]
    Binary,
    /// No unary operator.
    #[serde(rename = "UnaryOperator")]
    Unary,
    /// No such arm of a match.
    #[serde(rename = "MatchArm")]
    Arm,
    /// Another condition of an arm.
    #[serde(rename = "MatchArmGuard")]
    Guard,
    /// No such field of a structure, which has it from others.
    #[serde(rename = "StructField")]
    Field,
}

/// A small change of the code.
#[derive(Clone, Debug)]
pub(super) struct Mutant {
    /// A number from 1.
    pub(super) id: u32,
    pub(super) file: String,
    /// Both from 1.
    pub(super) line: usize,
    pub(super) column: usize,
    pub(super) genre: Genre,
    pub(super) replacement: String,
    /// In words, what is changed, and in what function.
    pub(super) change: String,
    /// The row of the record in which it counts.
    pub(super) group: &'static str,
}

impl Mutant {
    /// A name that is unique.
    pub(super) fn key(&self) -> String {
        format!("{}:{}:{}: {}", self.file, self.line, self.column, self.change)
    }
}

/// The words of cargo-mutants for one.
#[derive(Debug, Deserialize)]
struct Listed {
    file: String,
    genre: Genre,
    name: String,
    replacement: String,
    span: Span,
}

#[derive(Debug, Deserialize)]
struct Span {
    start: Place,
}

#[derive(Debug, Deserialize)]
struct Place {
    line: usize,
    column: usize,
}

/// The groups of which all mutants are tried, with the beginnings of their files; the first that fits takes a
/// file.
const WHOLE: [(&str, &[&str]); 9] = [
    ("repair", &["/repair"]),
    ("bounds", &["crates/moves/src/bounds"]),
    ("components", &["crates/grid/src/components"]),
    ("placement", &["crates/grid/src/placement", "crates/subgoal/src/placement"]),
    ("sight", &["crates/grid/src/sight", "crates/search/src/field/sight", "crates/search/src/theta/sight"]),
    ("canonical", &["crates/search/src/canonical"]),
    ("anya", &["crates/search/src/anya"]),
    ("labels", &["crates/subgoal/src/labels"]),
    ("costs", &["crates/costs/src"]),
];

/// The crates of whose other files every tenth mutant is tried.
const TENTH: [(&str, &str); 4] = [
    ("grid, a tenth", "crates/grid/src"),
    ("search, a tenth", "crates/search/src"),
    ("subgoal, a tenth", "crates/subgoal/src"),
    ("hierarchy, a tenth", "crates/hierarchy/src"),
];

/// The names of all groups.
pub(super) fn groups() -> impl Iterator<Item = &'static str> {
    WHOLE.into_iter().map(|(name, _)| name).chain(TENTH.map(|(name, _)| name))
}

/// The mutants of the groups.
///
/// # Errors
/// [`Error::Lacking`] without cargo-mutants; [`Error::Step`] where its answer cannot be read.
pub(super) fn mutants() -> Result<Vec<Mutant>, Error> {
    let mut command = Command::new("cargo");
    command.current_dir(root()).args(["mutants", "--list", "--json"]);
    for folder in ["moves", "grid", "search", "subgoal", "hierarchy", "costs"] {
        command.arg("-f").arg(format!("crates/{folder}/src/**"));
    }
    let step = || Error::Step { command: "cargo mutants --list".to_owned() };
    let output = command.output().map_err(|_| step())?;
    if !output.status.success() {
        return Err(Error::Lacking {
            what: "cargo-mutants does not answer".to_owned(),
            mend: "cargo install cargo-mutants --locked".to_owned(),
        });
    }
    let listed: Vec<Listed> = serde_json::from_slice(&output.stdout).map_err(|_| step())?;
    let chosen = listed.into_iter().filter_map(|listed| Some((group(&listed)?, listed)));
    Ok(chosen.zip(1..).map(|((group, listed), id)| mutant(group, &listed, id)).collect())
}

fn mutant(group: &'static str, listed: &Listed, id: u32) -> Mutant {
    let Listed { file, genre, replacement, span, .. } = listed;
    Mutant {
        id,
        file: file.clone(),
        line: span.start.line,
        column: span.start.column,
        genre: *genre,
        replacement: replacement.clone(),
        change: change(&listed.name).to_owned(),
        group,
    }
}

/// The name without its place.
fn change(name: &str) -> &str {
    name.splitn(4, ':').nth(3).unwrap_or(name).trim_start()
}

/// The group of a mutant that is tried.
fn group(listed: &Listed) -> Option<&'static str> {
    let file = &listed.file;
    let is_repair = |pattern: &str| pattern.starts_with('/') && file.contains(pattern);
    let whole = WHOLE.iter().find(|(_, of)| of.iter().any(|part| file.starts_with(part) || is_repair(part)));
    if let Some((name, _)) = whole {
        return Some(name);
    }
    let (name, _) = TENTH.iter().find(|(_, folder)| file.starts_with(folder))?;
    // By its words, so that lines that are added above it choose no other.
    let digest = Sha256::digest(format!("{file} {}", change(&listed.name)));
    (digest[0] % 10 == 0).then_some(name)
}
