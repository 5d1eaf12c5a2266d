//! The outcomes of all mutants, told, and as a record.

use std::{collections::HashMap, fs};

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

/// Why mutants of a file survive.
#[derive(Debug, Deserialize)]
pub(super) struct Explained {
    file: String,
    /// Changes, in the words of cargo-mutants; all mutants with these words.
    #[serde(default)]
    changes: Vec<String>,
    /// Functions, all of whose mutants are meant.
    #[serde(default)]
    functions: Vec<String>,
    #[expect(dead_code, reason = "for readers")]
    why: String,
}

impl Explained {
    pub(super) fn holds(&self, mutant: &Mutant) -> bool {
        let Mutant { file, change, .. } = mutant;
        let is_in = |function: &String| {
            let rest = change.strip_prefix("replace ").and_then(|rest| rest.strip_prefix(&**function));
            change.ends_with(&format!(" in {function}"))
                || rest.is_some_and(|rest| rest.starts_with(" -> ") || rest.starts_with(" with "))
        };
        *file == self.file && (self.changes.contains(change) || self.functions.iter().any(is_in))
    }
}

/// The counts of a group.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    all: usize,
    unviable: usize,
    unreached: usize,
    killed: usize,
    late: usize,
    /// All their tests pass.
    survived: usize,
    /// The tests pass for which there was time.
    unsettled: usize,
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
                Some(Outcome::Survived(_, by_all)) => {
                    *(if *by_all { &mut counts.survived } else { &mut counts.unsettled }) += 1;
                    let is_explained = explained.iter().any(|explained| explained.holds(mutant));
                    counts.explained += usize::from(is_explained);
                }
            }
        }
        survivors += counts.survived + counts.unsettled - counts.explained;
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

/// The reasons of survivors.
///
/// # Errors
/// [`Error::Step`] if their file cannot be read.
pub(super) fn explained() -> Result<Vec<Explained>, Error> {
    serde_json::from_str(EXPLAINED)
        .map_err(|error| Error::Step { command: format!("reading mutants/explained.json: {error}") })
}

fn row(group: &str, counts: Counts) -> Row {
    let columns = [
        ("mutants", counts.all),
        ("not compiled", counts.unviable),
        ("not reached", counts.unreached),
        ("killed", counts.killed),
        ("late", counts.late),
        ("survived", counts.survived),
        ("unsettled", counts.unsettled),
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
            of("unsettled", "changes that no test notices for which there was time"),
            of("explained", "those of both with a reason: they change no answer"),
        ],
        rows,
    }
}

#[cfg(test)]
mod tests {
    use super::{super::list::Genre, *};

    #[test]
    fn mutants_are_explained_by_their_words_or_their_function() {
        let mutant = |change: &str| Mutant {
            id: 1,
            file: "a.rs".to_owned(),
            line: 1,
            column: 1,
            genre: Genre::Binary,
            replacement: String::new(),
            change: change.to_owned(),
            group: "bounds",
        };
        let explained: Vec<Explained> = serde_json::from_str(
            r#"[{"file": "a.rs", "changes": ["replace + with - in f"], "functions": ["S::g"], "why": "…"}]"#,
        )
        .expect("a list");
        let holds = |change: &str| explained[0].holds(&mutant(change));
        let held = ["replace + with - in f", "delete ! in S::g", "replace S::g -> bool with true"];
        assert!(held.into_iter().all(holds));
        assert!(
            !["replace + with * in f", "delete ! in S::gg", "replace S::gg -> bool with true"]
                .into_iter()
                .any(holds)
        );
        assert!(super::explained().is_ok());
    }
}
