//! `cargo xtask compare --changes`: the study of maps that change, on which
//! [`Demand::Changing`](mediant::Demand::Changing) rests.
//!
//! It writes `docs/results/data/changes.json`, and from that record alone the page `docs/results/changes.md`
//! with its figures.

mod contestant;
mod door;
mod frames;
mod maps;
mod page;
mod sizes;
mod timelines;

use std::{fs, path::Path};

use indicatif::ProgressBar;
use mediant::{Engine, Map, Motion, Setup};
use mediant_report::{Column, Machine, Provenance, Record, Row, revision};
use mediant_sets::Archive;

use self::maps::Kind;
use super::CompareError;

pub use maps::rooms;
pub use page::{Case, MOST, PATHS, cases, drawn};

const SEED: u64 = 7;
/// The edits of a pass: so many follow one another before subgoals are finished.
const EDITS: usize = 40;
/// The timed passes. Another comes before them.
const PASSES: u32 = 3;

/// A part of the study.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Timelines,
    Sizes,
    Frames,
    Door,
}

impl Part {
    const fn name(self) -> &'static str {
        match self {
            Self::Timelines => "timelines",
            Self::Sizes => "sizes",
            Self::Frames => "frames",
            Self::Door => "door",
        }
    }

    /// A row of this part.
    fn row(self, name: &str, map: &Map) -> Row {
        let row = Row::new().key("part", self.name()).key("map", name);
        row.with("width", f64::from(map.width())).with("height", f64::from(map.height()))
    }
}

/// The motion as setups write it.
fn text(motion: Motion) -> String {
    Setup::new(Engine::AStar, motion).to_string().replacen("astar:", "", 1)
}

fn columns() -> Vec<Column> {
    vec![
        Column::key("part", "the part of the study: timelines, sizes, frames, door"),
        Column::key("map", "the map"),
        Column::key("motion", "k and the rule of motion"),
        Column::key("engine", "our engine, or another crate"),
        Column::key("size", "sizes: the cells of the change; door: whether it opens or closes"),
        Column::key("way", "frames: whether what was prepared follows the map, or is made anew each frame"),
        Column::count("width", "cells", "the width of the map"),
        Column::count("height", "cells", "its height"),
        Column::count(
            "corners",
            "",
            "timelines: the convex corners of blocked cells, by the cells of the map",
        ),
        Column::count(
            "lines",
            "",
            "timelines: of the free cells, those from which a line to 16 columns and 5 rows beyond is free",
        ),
        Column::time("edit", "µs", "edit, space, index and planner; timelines and frames: mean, else median"),
        Column::time("query", "µs", "timelines: mean time of a path; frames: of all paths of a frame"),
        Column::time("finish", "µs", "timelines: labels made anew, after 40 edits"),
        Column::time("prepared", "µs", "space, index and planner made anew"),
        Column::time("proven", "%", "answers that labels of the map before have proven"),
        Column::time("frame", "µs", "mean time of a frame"),
        Column::time("median", "µs", "median time of a frame"),
        Column::time("worst", "µs", "the longest time"),
        Column::time("asked", "", "frames: mean number of agents that a path was searched for"),
    ]
}

/// Measures, and writes the record, the page and its figures into the project at `root`.
pub(super) fn run(root: &Path, archive: &Archive) -> Result<(), CompareError> {
    // The sources may change while minutes pass.
    let revision = revision(root);
    let mut maps = Vec::new();
    for (kind, side) in Kind::ALL.into_iter().flat_map(|kind| [(kind, 512), (kind, 2_048)]) {
        maps.push((kind.name(side), kind.map(side)?));
    }
    maps.extend(maps::benchmarks(archive)?);
    let bar = ProgressBar::new(maps.len() as u64 + 3);
    let mut rows = Vec::new();
    for (name, map) in &maps {
        bar.set_message(name.clone());
        rows.extend(timelines::measure(name, map)?);
        bar.inc(1);
    }
    for part in [sizes::measure, frames::measure, door::measure] {
        rows.extend(part()?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let provenance = Provenance {
        revision,
        machine: Machine::here(),
        sets: maps::sets().into_iter().map(str::to_owned).collect(),
        maps: maps.len(),
        instances: u64::from(PASSES) * EDITS as u64,
        drawn:
            "edits of single random cells on each map and motion, with random ends between which there is \
                a path"
                .to_owned(),
        seed: Some(SEED),
        passes: Some(PASSES),
        ..Provenance::default()
    };
    let (id, title) =
        ("changes".to_owned(), "Maps that change: engines by how often they are asked".to_owned());
    let record = Record { id, title, provenance, columns: columns(), rows };
    page::write(root, &record)
}

/// Draws the page again.
pub(super) fn render(root: &Path) -> Result<(), CompareError> {
    let path = root.join(page::RECORD);
    let text = fs::read_to_string(&path).map_err(|source| CompareError::Read { path, source })?;
    page::write(root, &Record::parse(&text)?)
}
