//! The record of fuzzing, to which each turn is added.

use std::{cmp::Ordering, fmt, fs};

use mediant_report::{Column, Machine, Provenance, Record, Row, number, revision, thousands};
use mediant_sets::root;

use crate::Error;

/// The file, from the root.
const FILE: &str = "docs/proof/fuzzing.json";

/// A target's turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    pub(super) executions: u64,
    pub(super) hours: f64,
    /// Edges of the code that some input reaches.
    pub(super) edges: u64,
    /// Edges, and how often each is passed.
    pub(super) features: u64,
    /// Inputs that reach something that no other does.
    pub(super) inputs: u64,
    /// The time at the end without a new edge.
    pub(super) quiet_minutes: f64,
    /// Inputs that are treated wrongly.
    pub(super) found: u64,
}

impl fmt::Display for Turn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} executions in {} hours, {} a second; {} edges, {} minutes without a new one; {} inputs, {} wrong",
            thousands(self.executions as f64),
            number(self.hours),
            thousands(self.executions as f64 / (3600.0 * self.hours)),
            thousands(self.edges as f64),
            number(self.quiet_minutes),
            thousands(self.inputs as f64),
            self.found
        )
    }
}

impl Turn {
    /// A turn of before, and this one. Where both reach the same edges their silence counts together; a
    /// turn that reaches fewer, as one that begins anew elsewhere, never came to where the silence began.
    fn after(&self, row: Option<&Row>) -> Self {
        let of = |column: &str| row.and_then(|row| row.number(column)).unwrap_or(0.0);
        Self {
            executions: self.executions + of("executions") as u64,
            hours: self.hours + of("time"),
            edges: self.edges.max(of("edges") as u64),
            features: self.features.max(of("features") as u64),
            inputs: self.inputs,
            quiet_minutes: match self.edges.cmp(&(of("edges") as u64)) {
                Ordering::Greater => self.quiet_minutes,
                Ordering::Equal => self.quiet_minutes + of("quiet"),
                Ordering::Less => of("quiet"),
            },
            found: self.found + of("wrong") as u64,
        }
    }

    fn row(&self, name: &str) -> Row {
        let tenths = |number: f64| (number * 10.0).round() / 10.0;
        Row::new()
            .key("target", name)
            .with("executions", self.executions as f64)
            .with("time", (self.hours * 1000.0).round() / 1000.0)
            .with("edges", self.edges as f64)
            .with("features", self.features as f64)
            .with("inputs", self.inputs as f64)
            .with("quiet", tenths(self.quiet_minutes))
            .with("wrong", self.found as f64)
    }
}

/// Adds a turn to the record.
pub(super) fn add(name: &str, turn: &Turn) -> Result<(), Error> {
    let path = root().join(FILE);
    let known = fs::read_to_string(&path).ok().and_then(|text| Record::parse(&text).ok());
    let record = added(known, name, turn);
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(|source| Error::Io { path: folder.to_owned(), source })?;
    }
    fs::write(&path, record.json()).map_err(|source| Error::Io { path, source })
}

fn added(known: Option<Record>, name: &str, turn: &Turn) -> Record {
    let mut rows = known.map(|record| record.rows).unwrap_or_default();
    let at = rows.iter().position(|row| row.text("target") == name);
    let row = turn.after(at.map(|at| &rows[at])).row(name);
    match at {
        Some(at) => rows[at] = row,
        None => rows.push(row),
    }
    let executions = rows.iter().filter_map(|row| row.number("executions")).sum::<f64>();
    // A record's counts are the same on each run; these are not.
    let varying = |name: &str, unit: &str, about: &str| Column::time(name, unit, about);
    Record {
        id: "fuzzing".to_owned(),
        title: "Fuzzing".to_owned(),
        provenance: Provenance {
            revision: revision(&root()),
            machine: Machine::here(),
            instances: executions as u64,
            drawn:
                "executions of all runs together, by libFuzzer from kept inputs; the rest of the last run."
                    .to_owned(),
            ..Provenance::default()
        },
        columns: vec![
            Column::key("target", "the name of the target"),
            varying("executions", "", "inputs that were run"),
            varying("time", "hours", "processor time, about"),
            varying("edges", "", "edges of the code that some input reaches"),
            varying("features", "", "edges, by how often they are passed"),
            varying("inputs", "", "inputs that each reach something else"),
            varying("quiet", "minutes", "time since the last new edge"),
            varying("wrong", "", "inputs that were treated wrongly, since mended"),
        ],
        rows,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_add_up() {
        let turn = |executions, edges, quiet_minutes| Turn {
            executions,
            hours: 0.5,
            edges,
            features: 2 * edges,
            inputs: 7,
            quiet_minutes,
            found: 1,
        };
        let record = added(None, "map", &turn(100, 10, 2.0));
        let record = added(Some(record), "words", &turn(1, 1, 0.0));
        // Nothing new: the silence goes on. Then something new.
        let record = added(Some(record), "map", &turn(50, 10, 30.0));
        let number = |record: &Record, column: &str| record.number(&[("target", "map")], column);
        assert_eq!(
            ["executions", "time", "quiet"].map(|of| number(&record, of)),
            [150.0, 1.0, 32.0].map(Some)
        );
        // Fewer edges: it begins anew.
        let record = added(Some(record), "map", &turn(0, 9, 500.0));
        assert_eq!(["time", "edges", "quiet"].map(|of| number(&record, of)), [1.5, 10.0, 32.0].map(Some));
        let record = added(Some(record), "map", &turn(50, 11, 3.0));
        assert_eq!(["edges", "quiet", "wrong"].map(|of| number(&record, of)), [11.0, 3.0, 4.0].map(Some));
        assert_eq!((record.rows.len(), record.provenance.instances), (2, 201));
        assert!(record.check().is_ok());
    }
}
