//! The outcomes of all mutants, told, and as a record.

use std::{
    collections::{HashMap, HashSet},
    fs,
};

use mediant_report::{Column, Machine, Provenance, Record, Row, revision};
use mediant_sets::root;
use serde::Deserialize;

use super::{
    list::{Mutant, groups},
    trial::Outcome,
};
use crate::Error;

/// The file, from the root.
const FILE: &str = "docs/proof/mutants.json";
/// The mutants that survive for a reason.
const EXPLAINED: &str = include_str!("explained.json");

/// Why mutants survive.
#[derive(Debug, Deserialize)]
struct Explained {
    file: String,
    /// The change, in the words of cargo-mutants; of all mutants of a file with these words.
    changes: Vec<String>,
    #[expect(dead_code, reason = "for readers")]
    why: String,
}

/// The counts of a group.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    all: usize,
    unviable: usize,
    unreached: usize,
    killed: usize,
    late: usize,
    survived: usize,
    explained: usize,
}

/// Tells the outcomes, and writes the record where it is wanted.
///
/// # Errors
/// [`Error::Survivors`] for mutants that survive, and are not explained.
pub(super) fn tell(
    mutants: &[Mutant],
    outcomes: &HashMap<String, Outcome>,
    is_recorded: bool,
) -> Result<(), Error> {
    let explained = explained()?;
    let (mut rows, mut survivors, mut open) = (Vec::new(), 0, 0);
    for group in groups() {
        let mut counts = Counts::default();
        for mutant in mutants.iter().filter(|mutant| mutant.group == group) {
            counts.all += 1;
            match outcomes.get(&mutant.key()) {
                None => open += 1,
                Some(Outcome::Unviable) => counts.unviable += 1,
                Some(Outcome::Unreached) => counts.unreached += 1,
                Some(Outcome::Killed(_)) => counts.killed += 1,
                Some(Outcome::Late(_)) => counts.late += 1,
                Some(Outcome::Survived(..)) => {
                    counts.survived += 1;
                    let is_explained = explained.contains(&(mutant.file.clone(), mutant.change.clone()));
                    counts.explained += usize::from(is_explained);
                }
            }
        }
        survivors += counts.survived - counts.explained;
        println!("{group}: {counts:?}");
        rows.push(row(group, counts));
    }
    println!("{open} mutants were not tried");
    if is_recorded {
        let path = root().join(FILE);
        fs::write(&path, record(rows, mutants.len(), open).json()).map_err(Error::at(&path))?;
    }
    if survivors == 0 { Ok(()) } else { Err(Error::Survivors { count: survivors }) }
}

fn explained() -> Result<HashSet<(String, String)>, Error> {
    let read: Vec<Explained> = serde_json::from_str(EXPLAINED)
        .map_err(|error| Error::Step { command: format!("reading mutants/explained.json: {error}") })?;
    let pairs = |explained: Explained| {
        let Explained { file, changes, .. } = explained;
        changes.into_iter().map(move |change| (file.clone(), change))
    };
    Ok(read.into_iter().flat_map(pairs).collect())
}

fn row(group: &str, counts: Counts) -> Row {
    let columns = [
        ("mutants", counts.all),
        ("not compiled", counts.unviable),
        ("not reached", counts.unreached),
        ("killed", counts.killed),
        ("late", counts.late),
        ("survived", counts.survived),
        ("explained", counts.explained),
    ];
    let row = Row::new().key("group", group);
    columns.into_iter().fold(row, |row, (name, count)| row.with(name, count as f64))
}

fn record(rows: Vec<Row>, all: usize, open: usize) -> Record {
    let of = |name: &str, about: &str| Column::count(name, "", about);
    Record {
        id: "mutants".to_owned(),
        title: "Mutants".to_owned(),
        provenance: Provenance {
            revision: revision(&root()),
            machine: Machine::here(),
            instances: all as u64,
            drawn: format!(
                "the mutants of cargo-mutants against the tests of the libraries; {open} not tried."
            ),
            ..Provenance::default()
        },
        columns: vec![
            Column::key("group", "files"),
            of("mutants", "small changes of the code"),
            of("not compiled", "changes that the compiler refuses"),
            of("not reached", "changes to which no test comes: most are computed by the compiler"),
            of("killed", "changes for which a test fails"),
            of("late", "changes for which a test does not end"),
            of("survived", "changes that no test notices"),
            of("explained", "survivors with a reason: they change no answer"),
        ],
        rows,
    }
}
