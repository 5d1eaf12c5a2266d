//! The outcomes of all rounds, kept while the conditions are the same.

use std::{
    collections::BTreeMap,
    fs::{self, File, OpenOptions},
    io::Write,
    path::{Path, PathBuf},
};

use mediant_formats::scenario_tolerance;
use mediant_report::stats::median;
use serde::{Deserialize, Serialize};

use super::{super::CompareError, report::Report};

/// One run of a program.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Key {
    every: u32,
    map: String,
    program: String,
    round: u32,
}

impl Key {
    pub(super) fn new(every: u32, map: &str, program: &str, round: u32) -> Self {
        Self { every, map: map.to_owned(), program: program.to_owned(), round }
    }
}

/// Its outcome.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Outcome {
    Measured(Figures),
    /// Why there is nothing.
    Refused(String),
}

/// The figures of one run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Figures {
    /// The mean time of a query in microseconds: the median of the passes after the first.
    pub(super) query: f64,
    /// The same in the first pass.
    pub(super) first: f64,
    /// The seconds of the preparation.
    pub(super) prepared: Option<f64>,
    /// Its bytes.
    pub(super) bytes: Option<f64>,
    /// The paths that are not as long as the shortest.
    pub(super) differ: u32,
}

impl Outcome {
    /// The figures of a report; the lengths are compared with those of the shortest paths.
    pub(super) fn of(report: &Report, shortest: &[f64]) -> Self {
        let each = |micros: f64| micros / shortest.len().max(1) as f64;
        let (first, warm) =
            report.passes.split_first().map_or((0.0, &[][..]), |(first, warm)| (*first, warm));
        let pairs = report.costs.iter().zip(shortest);
        let differ = pairs.filter(|(cost, shortest)| !is_as_long(**cost, **shortest)).count();
        Self::Measured(Figures {
            query: each(median(warm).unwrap_or_default()),
            first: each(first),
            prepared: report.prepared.map(|(seconds, _)| seconds),
            bytes: report.prepared.and_then(|(_, bytes)| bytes),
            differ: u32::try_from(differ).unwrap_or(u32::MAX),
        })
    }
}

/// As scenarios round: other programs add in single precision, too.
fn is_as_long(cost: f64, shortest: f64) -> bool {
    (cost - shortest).abs() <= scenario_tolerance(shortest)
}

/// All outcomes, and the file that keeps them.
pub(super) struct Rounds {
    conditions: String,
    path: PathBuf,
    file: File,
    outcomes: BTreeMap<Key, Outcome>,
}

/// A line of the file.
#[derive(Serialize, Deserialize)]
struct Line {
    conditions: String,
    key: Key,
    outcome: Outcome,
}

impl Rounds {
    /// The figures under these conditions so far, if they may be `kept`. Programs that failed may do better.
    ///
    /// # Errors
    /// [`CompareError::Write`] for a file that cannot be written.
    pub(super) fn open(path: &Path, conditions: &str, kept: bool) -> Result<Self, CompareError> {
        let text = fs::read_to_string(path).unwrap_or_default();
        let lines = text.lines().filter_map(|line| serde_json::from_str::<Line>(line).ok());
        let is_measured = |line: &Line| matches!(line.outcome, Outcome::Measured(_));
        let own = lines.filter(|line| kept && line.conditions == conditions && is_measured(line));
        let outcomes = own.map(|line| (line.key, line.outcome)).collect();
        let folder = path.parent().unwrap_or(path);
        fs::create_dir_all(folder).map_err(CompareError::at_write(folder))?;
        let file = OpenOptions::new().append(true).create(true).open(path);
        let file = file.map_err(CompareError::at_write(path))?;
        Ok(Self { conditions: conditions.to_owned(), path: path.to_owned(), file, outcomes })
    }

    pub(super) fn has(&self, key: &Key) -> bool {
        self.outcomes.contains_key(key)
    }

    /// # Errors
    /// [`CompareError::Write`] if it cannot be kept.
    pub(super) fn add(&mut self, key: Key, outcome: Outcome) -> Result<(), CompareError> {
        let line = Line { conditions: self.conditions.clone(), key, outcome };
        let text = serde_json::to_string(&line).unwrap_or_default() + "\n";
        self.file.write_all(text.as_bytes()).map_err(CompareError::at_write(&self.path))?;
        self.outcomes.insert(line.key, line.outcome);
        Ok(())
    }

    /// The figures of a program on a list of a map, one of each round.
    pub(super) fn figures(&self, every: u32, map: &str, program: &str) -> Vec<Figures> {
        let is_asked = |key: &Key| key.every == every && key.map == map && key.program == program;
        let own = self.outcomes.iter().filter(|(key, _)| is_asked(key));
        own.filter_map(|(_, outcome)| match outcome {
            Outcome::Measured(figures) => Some(*figures),
            Outcome::Refused(_) => None,
        })
        .collect()
    }

    /// A sentence for each run that came to nothing.
    pub(super) fn refusals(&self) -> Vec<String> {
        let refused = self.outcomes.iter().filter_map(|(key, outcome)| match outcome {
            Outcome::Measured(_) => None,
            Outcome::Refused(reason) => Some(format!("{} on {}: {reason}", key.program, key.map)),
        });
        let mut sentences: Vec<String> = refused.collect();
        sentences.sort();
        sentences.dedup();
        sentences
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_medians_of_warm_passes_for_each_query() {
        let report: Report =
            "prepared 2 30\npass 40\npass 8\npass 6\npass 20\ncost 5\ncost 7.1\n".parse().unwrap();
        let Outcome::Measured(figures) = Outcome::of(&report, &[5.001, 7.0]) else { panic!("measured") };
        assert_eq!((figures.query, figures.first, figures.differ), (4.0, 20.0, 1));
        assert_eq!((figures.prepared, figures.bytes), (Some(2.0), Some(30.0)));
    }

    #[test]
    fn figures_are_kept_under_their_conditions() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("target/peers.jsonl");
        let open = |conditions, kept| Rounds::open(&path, conditions, kept).unwrap();
        let [measured, refused] = ["jps2", "jps2+"].map(|name| Key::new(20, "arena2", name, 0));
        let mut rounds = open("a", true);
        rounds.add(measured.clone(), Outcome::of(&Report::default(), &[])).unwrap();
        rounds.add(refused.clone(), Outcome::Refused("no map".to_owned())).unwrap();
        assert_eq!(rounds.refusals(), ["jps2+ on arena2: no map"]);
        let again = open("a", true);
        assert!(again.has(&measured) && again.figures(20, "arena2", "jps2").len() == 1);
        // It may be there now.
        assert!(!again.has(&refused));
        assert!(!open("b", true).has(&measured) && !open("a", false).has(&measured));
    }
}
