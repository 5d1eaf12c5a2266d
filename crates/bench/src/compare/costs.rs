//! `cargo xtask compare --costs`: the study of cost surfaces.
//!
//! It writes `docs/results/data/costs.json`, and from that record the page `docs/results/costs.md` with its
//! charts; the pictures of paths are drawn from the surfaces, which follow from the seed.

mod fields;
mod page;
mod paths;
mod pictures;
mod surfaces;
mod worth;

use std::{fs, path::Path};

use indicatif::ProgressBar;
use mediant_report::{Column, Machine, Provenance, Record, Row, revision};
use mediant_sets::Archive;

use self::surfaces::surfaces;
use super::CompareError;

pub use page::drawn;

const SEED: u64 = 7;

/// A part of the study.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    /// The worth of k.
    Worth,
    /// Times of fields.
    Fields,
    /// Times of paths, with landmarks and without.
    Paths,
}

impl Part {
    const fn name(self) -> &'static str {
        match self {
            Self::Worth => "worth",
            Self::Fields => "fields",
            Self::Paths => "paths",
        }
    }

    /// A row of this part.
    fn row(self, surface: &str, side: u32, k: u32) -> Row {
        let row = Row::new().key("part", self.name()).key("surface", surface).key("k", k);
        row.key("side", side)
    }
}

fn columns() -> Vec<Column> {
    vec![
        Column::key("part", "the part of the study: worth, fields, paths"),
        Column::key("surface", "the kind of surface"),
        Column::key("k", "the k of the neighborhood"),
        Column::key("side", "the cells of a side"),
        Column::count("pairs", "", "worth: the pairs of a source and a cell"),
        Column::count("mean", "%", "worth: the mean surplus of the cost over that for k = 12"),
        Column::count("most", "%", "worth: the surplus that 95 % of the pairs do not exceed"),
        Column::count("worst", "%", "worth: the greatest surplus"),
        Column::time("cell", "ns", "fields: the time of a cell on one thread, median"),
        Column::time("two", "ns", "fields: the same on two threads"),
        Column::count("expanded", "", "paths: the vertices that a search expands, mean"),
        Column::time("query", "ms", "paths: A* on the space alone, mean"),
        Column::time("prepared", "s", "paths: the making of 8 landmarks"),
        Column::count("guided", "", "paths: the vertices that a search with landmarks expands, mean"),
        Column::time("landmarks", "ms", "paths: A* with 8 landmarks, mean"),
    ]
}

/// Measures, and writes the record, the page and its figures into the project at `root`.
pub(super) fn run(root: &Path, archive: &Archive) -> Result<(), CompareError> {
    // The sources may change while minutes pass.
    let revision = revision(root);
    let bar = ProgressBar::new(3);
    let mut rows = Vec::new();
    let surfaces = surfaces(archive)?;
    for measure in [worth::measure, paths::measure] {
        rows.extend(measure(&surfaces)?);
        bar.inc(1);
    }
    rows.extend(fields::measure()?);
    bar.finish_and_clear();
    let provenance = Provenance {
        revision,
        machine: Machine::here(),
        sets: vec![surfaces::TERRAIN.0.to_owned()],
        maps: surfaces.len(),
        instances: paths::QUERIES as u64,
        drawn: "surfaces, sources and queries at random".to_owned(),
        seed: Some(SEED),
        passes: Some(fields::PASSES as u32),
        ..Provenance::default()
    };
    let (id, title) = ("costs".to_owned(), "Cost surfaces: what k is worth, fields and paths".to_owned());
    let record = Record { id, title, provenance, columns: columns(), rows };
    page::write(root, &record)?;
    pictures::write(root, &surfaces)
}

/// Draws the page again.
pub(super) fn render(root: &Path, archive: &Archive) -> Result<(), CompareError> {
    let path = root.join(page::RECORD);
    let text = fs::read_to_string(&path).map_err(|source| CompareError::Read { path, source })?;
    page::write(root, &Record::parse(&text)?)?;
    pictures::write(root, &surfaces(archive)?)
}
