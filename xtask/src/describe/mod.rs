//! `cargo xtask describe`: writes what every language says of calls and engines.
//!
//! The library describes itself in `docs/description.json`, which a test of `mediant` holds to the code. From
//! that file follow the keywords of Python's stub, the interfaces of TypeScript, and tables in Markdown: the
//! regions between a line with `described: NAME` and one with `described: end`. So do the tables of
//! `docs/proof.md` from the records in `docs/proof`, and the tables of speed beside other programs. `tidy`
//! compares them.

mod markdown;
mod peers;
mod python;
mod records;
mod typescript;

use std::{
    fs,
    path::{Path, PathBuf},
};

use mediant_sets::root;
use serde::Deserialize;

use crate::{Error, tree::Tree};

/// The file of the description, from the root.
pub const FILE: &str = "docs/description.json";

/// The library's description of itself.
#[derive(Clone, Debug, Deserialize)]
pub struct Description {
    parameters: Vec<Parameter>,
    engines: Vec<Engine>,
    statuses: Vec<String>,
    limits: Vec<String>,
    stages: Vec<String>,
    origins: Vec<String>,
}

/// A parameter of calls: `mediant::call::Parameter`.
#[derive(Clone, Debug, Deserialize)]
struct Parameter {
    name: String,
    group: String,
    kind: String,
    unit: Option<String>,
    default: Option<String>,
    names: Vec<String>,
    /// Whether it is there only with the feature `publications`, which the program has.
    published: bool,
    /// The names among its values that are there only with that feature.
    published_names: Vec<String>,
    help: String,
}

/// A row of the table of engines.
#[derive(Clone, Debug, Deserialize)]
struct Engine {
    name: String,
    title: String,
    how: String,
    placements: Vec<String>,
    max_k: u32,
    any: bool,
    /// Its paths turn at any angle, whatever the k.
    any_angle: bool,
    /// Between centers it takes k = 2 and 3 alone.
    few_k_at_centers: bool,
    promise: String,
    papers: String,
}

impl Description {
    /// The description of the library without the feature `publications`, as Python and JavaScript have it.
    fn without_publications(&self) -> Self {
        let mut own = self.clone();
        own.parameters.retain(|parameter| !parameter.published);
        for parameter in &mut own.parameters {
            parameter.names.retain(|name| !parameter.published_names.contains(name));
        }
        own
    }

    /// The parameters of a group.
    fn of<'d>(&'d self, group: &'d str) -> impl Iterator<Item = &'d Parameter> {
        self.parameters.iter().filter(move |parameter| parameter.group == group)
    }
}

impl Parameter {
    /// `max_cost` for `max-cost`.
    fn snake(&self) -> String {
        self.name.replace('-', "_")
    }

    /// `maxCost` for `max-cost`.
    fn camel(&self) -> String {
        let mut parts = self.name.split('-');
        let first = parts.next().unwrap_or_default().to_owned();
        parts.fold(first, |camel, part| format!("{camel}{}{}", part[..1].to_uppercase(), &part[1..]))
    }
}

/// A part of a file that is written from the description, or from a record.
struct Region {
    file: &'static str,
    name: String,
    text: String,
}

/// All regions.
fn regions(description: &Description) -> Vec<Region> {
    let region = |file, name: &str, text| Region { file, name: name.to_owned(), text };
    let packages = &description.without_publications();
    vec![
        region("crates/python/python/mediant/_mediant.pyi", "calls", python::keywords(packages)),
        region("crates/web/src/types.rs", "calls", typescript::interfaces(packages)),
        region("crates/web/page/src/model/described.js", "page", typescript::page(packages)),
        region("docs/guide/src/engines/engines.md", "engines", markdown::engines(description)),
        region("docs/calls.md", "parameters", markdown::parameters(description)),
    ]
}

/// A file with a region in its place; `None` if it has no such region.
fn replaced(file: &str, region: &Region) -> Option<String> {
    let mark = format!("described: {}", region.name);
    let is_whole = |at: &usize| file[at + mark.len()..].starts_with(char::is_whitespace);
    let begin = file.match_indices(&mark).map(|(at, _)| at).find(is_whole)?;
    let begin = begin + file[begin..].find('\n')? + 1;
    let end = begin + file[begin..].find("described: end")?;
    // The line of the mark stays whole.
    let end = file[..end].rfind('\n')? + 1;
    Some(format!("{}{}{}", &file[..begin], region.text, &file[end..]))
}

/// The files of a tree that differ from the description, as they should be; a text in place of a file says
/// why it cannot be known.
///
/// # Errors
/// In words, the fault of the description or of the marks.
pub fn outdated(tree: &Tree) -> Result<Vec<(PathBuf, String)>, String> {
    let text = |file: &str| {
        let bytes = tree.bytes(file.as_ref()).ok_or_else(|| format!("there is no {file}"))?;
        std::str::from_utf8(bytes).map_err(|_| format!("{file} is no text"))
    };
    let description: Description =
        serde_json::from_str(text(FILE)?).map_err(|error| format!("{FILE}: {error}"))?;
    let mut changed: Vec<(PathBuf, String)> = Vec::new();
    for region in
        regions(&description).into_iter().chain(records::regions(tree)?).chain(peers::regions(tree)?)
    {
        // A file has several regions.
        let at = changed.iter().position(|(path, _)| path == Path::new(region.file));
        let known = at.map_or_else(|| text(region.file), |at| Ok(changed[at].1.as_str()))?;
        let written = replaced(known, &region).ok_or_else(|| {
            format!("{} has no lines `described: {}` and `described: end`", region.file, region.name)
        })?;
        match at {
            Some(at) => changed[at].1 = written,
            None if written != known => changed.push((region.file.into(), written)),
            None => {}
        }
    }
    changed.extend(python::signatures(&description.without_publications(), tree)?);
    Ok(changed)
}

/// Writes all that differs.
///
/// # Errors
/// [`Error::Io`] for a file that cannot be read or written, [`Error::Described`] for marks that are missing.
pub fn run() -> Result<(), Error> {
    let root = root();
    let tree = Tree::read(&root)?;
    for (path, text) in outdated(&tree).map_err(|wrong| Error::Described { wrong })? {
        fs::write(root.join(&path), text).map_err(|source| Error::Io { path: path.clone(), source })?;
        println!("wrote {}", path.display());
    }
    Ok(())
}

/// The words of a text in lines of at most this width.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
