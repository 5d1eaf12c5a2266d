//! Compares two records by their counts.

use std::fmt;

use super::{
    column::ColumnKind,
    document::Record,
    provenance::{Machine, Provenance},
    row::Value,
};

/// A difference between two records, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference(String);

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl Record {
    /// The record without the columns of times, and without revision, machine and passes: what is the same on
    /// every run of the experiment.
    #[must_use]
    pub fn counts(&self) -> Self {
        let is_time = |name: &str| {
            self.columns.iter().any(|column| column.kind == ColumnKind::Time && column.name == name)
        };
        Self {
            provenance: Provenance {
                revision: String::new(),
                machine: Machine::default(),
                passes: None,
                ..self.provenance.clone()
            },
            columns: self.columns.iter().filter(|column| column.kind != ColumnKind::Time).cloned().collect(),
            rows: self.rows.iter().map(|row| row.filtered(|name| !is_time(name))).collect(),
            ..self.clone()
        }
    }

    /// Where the [`counts`](Self::counts) of two records differ. Numbers may differ by `tolerance`, a
    /// fraction of the larger one.
    #[must_use]
    pub fn differences(&self, other: &Self, tolerance: f64) -> Vec<Difference> {
        let (ours, theirs) = (self.counts(), other.counts());
        let mut found = Vec::new();
        let mut differ = |what: String| found.push(Difference(format!("{}: {what}", self.id)));
        if ours.provenance != theirs.provenance {
            differ(format!("the provenance is {:?}, not {:?}", ours.provenance, theirs.provenance));
        }
        if ours.columns != theirs.columns {
            differ("the columns differ".to_owned());
        }
        if ours.rows.len() != theirs.rows.len() {
            differ(format!("{} rows, not {}", ours.rows.len(), theirs.rows.len()));
        }
        for (at, (ours, theirs)) in ours.rows.iter().zip(&theirs.rows).enumerate() {
            let added = theirs.values().filter(|(name, _)| ours.value(name).is_none());
            for (name, _) in ours.values().chain(added) {
                let (our, their) = (ours.value(name), theirs.value(name));
                let agree = match (our, their) {
                    (Some(Value::Number(a)), Some(Value::Number(b))) => {
                        (a - b).abs() <= tolerance * a.abs().max(b.abs())
                    }
                    (our, their) => our == their,
                };
                if !agree {
                    differ(format!("row {at}, {name}: {our:?}, not {their:?}"));
                }
            }
        }
        found
    }
}
