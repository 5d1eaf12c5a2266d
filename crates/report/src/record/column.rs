//! Columns of a record: name, kind, unit, meaning.

use serde::{Deserialize, Serialize};

/// The kind of a column's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ColumnKind {
    /// Text that says what the row is about.
    Key,
    /// A number that is the same on every run and machine.
    Count,
    /// A number that differs from run to run and from machine to machine: a time, or computed from times.
    Time,
}

/// A column of a record.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// The name, by which rows find their values.
    pub name: String,
    /// The kind of its values.
    pub kind: ColumnKind,
    /// The unit; empty for text and for numbers without one.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub unit: String,
    /// Its meaning, in words.
    pub about: String,
}

impl Column {
    /// A column of texts that say what the row is about.
    #[must_use]
    pub fn key(name: &str, about: &str) -> Self {
        Self { name: name.to_owned(), kind: ColumnKind::Key, unit: String::new(), about: about.to_owned() }
    }

    /// A column of numbers that are the same on every run and machine.
    #[must_use]
    pub fn count(name: &str, unit: &str, about: &str) -> Self {
        Self {
            name: name.to_owned(),
            kind: ColumnKind::Count,
            unit: unit.to_owned(),
            about: about.to_owned(),
        }
    }

    /// A column of times, or of numbers that were computed from times.
    #[must_use]
    pub fn time(name: &str, unit: &str, about: &str) -> Self {
        Self { name: name.to_owned(), kind: ColumnKind::Time, unit: unit.to_owned(), about: about.to_owned() }
    }
}
