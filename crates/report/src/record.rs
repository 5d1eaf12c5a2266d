//! What a run of an experiment found.

use std::{collections::BTreeMap, fmt};

use serde::{Deserialize, Serialize};

/// What a run of an experiment found: a table of numbers with what is to be known of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The experiment, a word that names files too.
    pub id: String,
    /// What was measured, in a line.
    pub title: String,
    /// Where, when and on what.
    pub provenance: Provenance,
    /// What the rows hold.
    pub columns: Vec<Column>,
    /// The figures.
    pub rows: Vec<Row>,
}

/// Where a record's figures come from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// What git calls the sources, `-dirty` if they differ from it.
    pub revision: String,
    /// The machine; it matters to times alone.
    pub machine: Machine,
    /// The sets of maps.
    pub sets: Vec<String>,
    /// How many maps.
    pub maps: usize,
    /// How many queries (or other cases) the figures are over.
    pub instances: u64,
    /// How they were chosen, in words.
    pub drawn: String,
    /// The seed of what was drawn at random.
    pub seed: Option<u64>,
    /// Whether this is an even sample of the whole experiment.
    pub quick: bool,
    /// Whether the maps are those that come with the project, since the sets were not there.
    pub bundled: bool,
    /// Over how many timed passes a time is the median; none if nothing was timed.
    pub passes: Option<u32>,
}

/// A machine.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Its operating system.
    pub os: String,
    /// Its architecture.
    pub arch: String,
    /// What its processor calls itself.
    pub cpu: Option<String>,
    /// How many threads it runs at once.
    pub threads: Option<usize>,
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Text that says what the row is about.
    Key,
    /// A number that is the same on every run and machine.
    Count,
    /// A number that is not.
    Time,
}

/// A column of a record.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// Its name, by which rows are asked for it.
    pub name: String,
    /// What it holds.
    pub kind: Kind,
    /// Its unit; none of text and pure numbers.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub unit: String,
    /// What it means.
    pub about: String,
}

impl Column {
    /// Text that says what the row is about.
    #[must_use]
    pub fn key(name: &str, about: &str) -> Self {
        Self { name: name.to_owned(), kind: Kind::Key, unit: String::new(), about: about.to_owned() }
    }

    /// A number that is the same on every run and machine.
    #[must_use]
    pub fn count(name: &str, unit: &str, about: &str) -> Self {
        Self { name: name.to_owned(), kind: Kind::Count, unit: unit.to_owned(), about: about.to_owned() }
    }

    /// A number that is not.
    #[must_use]
    pub fn time(name: &str, unit: &str, about: &str) -> Self {
        Self { name: name.to_owned(), kind: Kind::Time, unit: unit.to_owned(), about: about.to_owned() }
    }
}

/// A text or a number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// Of a number column. Whole numbers are written without a point.
    #[serde(serialize_with = "plain")]
    Number(f64),
    /// Of a key column.
    Text(String),
}

fn plain<S: serde::Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    // Up to 2^53, beyond which not every whole number is one of these anyway.
    if number.fract() == 0.0 && number.abs() < 9e15 {
        serializer.serialize_i64(*number as i64)
    } else {
        serializer.serialize_f64(*number)
    }
}

/// One row: a value for each column that has one. What could not be measured is left out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Row(BTreeMap<String, Value>);

impl Row {
    /// A row without values.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// With the text of a key column.
    #[must_use]
    pub fn key(mut self, column: &str, text: impl fmt::Display) -> Self {
        self.0.insert(column.to_owned(), Value::Text(text.to_string()));
        self
    }

    /// With a number; one that is not finite is left out.
    #[must_use]
    pub fn with(mut self, column: &str, number: impl Into<Option<f64>>) -> Self {
        if let Some(number) = number.into().filter(|number| number.is_finite()) {
            self.0.insert(column.to_owned(), Value::Number(number));
        }
        self
    }

    /// The text in a column; empty where there is none.
    #[must_use]
    pub fn text(&self, column: &str) -> &str {
        match self.0.get(column) {
            Some(Value::Text(text)) => text,
            _ => "",
        }
    }

    /// The number in a column.
    #[must_use]
    pub fn number(&self, column: &str) -> Option<f64> {
        match self.0.get(column) {
            Some(Value::Number(number)) => Some(*number),
            _ => None,
        }
    }

    /// Whether these key columns hold these texts.
    #[must_use]
    pub fn is(&self, keys: &[(&str, &str)]) -> bool {
        keys.iter().all(|(column, text)| self.text(column) == *text)
    }

    /// The values with the names of their columns.
    pub fn values(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.0.iter().map(|(column, value)| (column.as_str(), value))
    }
}

/// A text that is no record.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// Not JSON, or not of this form.
    #[error("no record of results: {0}")]
    Form(#[from] serde_json::Error),
    /// A value that its column does not allow, or of no column.
    #[error("record `{id}`, row {row}: column `{column}` does not hold {value:?}")]
    Value {
        /// The record.
        id: String,
        /// The row, from 0.
        row: usize,
        /// The column.
        column: String,
        /// The value.
        value: Value,
    },
}

/// A place at which two records differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference(String);

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl Record {
    /// The record of a JSON text.
    ///
    /// # Errors
    /// [`RecordError`] says what is wrong with it.
    pub fn parse(text: &str) -> Result<Self, RecordError> {
        let record: Self = serde_json::from_str(text)?;
        record.check()?;
        Ok(record)
    }

    /// Whether each value fits its column.
    ///
    /// # Errors
    /// [`RecordError::Value`] for the first that does not.
    pub fn check(&self) -> Result<(), RecordError> {
        for (at, row) in self.rows.iter().enumerate() {
            for (name, value) in row.values() {
                let column = self.columns.iter().find(|column| column.name == name);
                let fits = column
                    .is_some_and(|column| (column.kind == Kind::Key) == matches!(value, Value::Text(_)));
                if !fits {
                    let (id, column, value) = (self.id.clone(), name.to_owned(), value.clone());
                    return Err(RecordError::Value { id, row: at, column, value });
                }
            }
        }
        Ok(())
    }

    /// As JSON: a row a line, so that a change of one figure is a change of one line.
    #[must_use]
    pub fn json(&self) -> String {
        // Text, finite numbers, lists and maps by text only: none of this can fail.
        let text = |value: serde_json::Result<String>| value.unwrap_or_default();
        let lines = |rows: Vec<String>| {
            if rows.is_empty() { "[]".to_owned() } else { format!("[\n    {}\n  ]", rows.join(",\n    ")) }
        };
        format!(
            "{{\n  \"id\": {},\n  \"title\": {},\n  \"provenance\": {},\n  \"columns\": {},\n  \"rows\": {}\n}}\n",
            text(serde_json::to_string(&self.id)),
            text(serde_json::to_string(&self.title)),
            text(serde_json::to_string(&self.provenance)),
            lines(self.columns.iter().map(|column| text(serde_json::to_string(column))).collect()),
            lines(self.rows.iter().map(|row| text(serde_json::to_string(row))).collect()),
        )
    }

    /// The rows whose key columns hold these texts, in their order.
    pub fn select<'a>(&'a self, keys: &'a [(&str, &str)]) -> impl Iterator<Item = &'a Row> {
        self.rows.iter().filter(move |row| row.is(keys))
    }

    /// The number in a column of the first row whose key columns hold these texts.
    #[must_use]
    pub fn number(&self, keys: &[(&str, &str)], column: &str) -> Option<f64> {
        self.rows.iter().find(|row| row.is(keys))?.number(column)
    }

    /// The texts that a key column holds, each once, in the order of the rows.
    #[must_use]
    pub fn distinct(&self, column: &str) -> Vec<&str> {
        let mut texts: Vec<&str> = Vec::new();
        for row in &self.rows {
            let text = row.text(column);
            if !text.is_empty() && !texts.contains(&text) {
                texts.push(text);
            }
        }
        texts
    }

    /// Without times, and without what depends on the machine and the revision: the same on every run of the same sources.
    #[must_use]
    pub fn counts(&self) -> Self {
        let is_time =
            |name: &str| self.columns.iter().any(|column| column.kind == Kind::Time && column.name == name);
        let keep = |row: &Row| {
            let kept = row.values().filter(|(name, _)| !is_time(name));
            Row(kept.map(|(name, value)| (name.to_owned(), value.clone())).collect())
        };
        Self {
            provenance: Provenance {
                revision: String::new(),
                machine: Machine::default(),
                passes: None,
                ..self.provenance.clone()
            },
            columns: self.columns.iter().filter(|column| column.kind != Kind::Time).cloned().collect(),
            rows: self.rows.iter().map(keep).collect(),
            ..self.clone()
        }
    }

    /// Where the counts of two records differ by more than `tolerance` of the larger number; times are not compared.
    #[must_use]
    pub fn differences(&self, other: &Self, tolerance: f64) -> Vec<Difference> {
        let (ours, theirs) = (self.counts(), other.counts());
        let mut found = Vec::new();
        let mut differ = |what: String| found.push(Difference(format!("{}: {what}", self.id)));
        if ours.provenance != theirs.provenance {
            differ(format!("made of {:?}, not of {:?}", ours.provenance, theirs.provenance));
        }
        if ours.columns != theirs.columns {
            differ("the columns are others".to_owned());
        }
        if ours.rows.len() != theirs.rows.len() {
            differ(format!("{} rows, not {}", ours.rows.len(), theirs.rows.len()));
        }
        for (at, (ours, theirs)) in ours.rows.iter().zip(&theirs.rows).enumerate() {
            let columns = ours.0.keys().chain(theirs.0.keys().filter(|name| !ours.0.contains_key(*name)));
            for name in columns {
                let (our, their) = (ours.0.get(name), theirs.0.get(name));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn record() -> Record {
        let row = |k, cost: f64, micros| Row::new().key("k", k).with("cost", cost).with("micros", micros);
        Record {
            id: "sample".to_owned(),
            title: "A sample \"quoted\"".to_owned(),
            provenance: Provenance { revision: "abc".to_owned(), instances: 2, ..Provenance::default() },
            columns: vec![
                Column::key("k", "the neighborhood"),
                Column::count("cost", "cells", "mean length"),
                Column::time("micros", "µs", "mean time"),
            ],
            rows: vec![row(2, 804.25, Some(1.5)), row(3, 668.0, None), row(3, f64::NAN, Some(3.0))],
        }
    }

    #[test]
    fn json_comes_back() {
        let record = record();
        let text = record.json();
        assert_eq!(Record::parse(&text).unwrap(), record);
        assert!(text.contains("{\"cost\":668,\"k\":\"3\"}") && text.contains("804.25"), "{text}");
        assert_eq!(record.rows[2].number("cost"), None);
        assert!(matches!(Record::parse("{"), Err(RecordError::Form(_))));
        let misplaced = text.replace("\"cost\":668", "\"cost\":\"668\"");
        let error = Record::parse(&misplaced).unwrap_err().to_string();
        assert!(error.contains("row 1: column `cost`"), "{error}");
        assert!(Record::parse(&text.replace("\"cost\":668", "\"price\":668")).is_err());
    }

    #[test]
    fn rows_are_found_by_their_keys() {
        let record = record();
        assert_eq!(record.number(&[("k", "3")], "cost"), Some(668.0));
        assert_eq!(record.number(&[("k", "4")], "cost"), None);
        assert_eq!(record.select(&[("k", "3")]).count(), 2);
        assert_eq!(record.distinct("k"), ["2", "3"]);
    }

    #[test]
    fn counts_differ_and_times_do_not() {
        let (ours, mut theirs) = (record(), record());
        theirs.rows[0] = Row::new().key("k", 2).with("cost", 804.25).with("micros", 99.0);
        theirs.provenance.revision = "def".to_owned();
        theirs.provenance.machine.cpu = Some("another".to_owned());
        assert_eq!(ours.differences(&theirs, 0.0), []);
        theirs.rows[0] = Row::new().key("k", 2).with("cost", 804.26);
        let found = ours.differences(&theirs, 1e-9);
        assert_eq!(found.len(), 1);
        assert!(found[0].to_string().contains("row 0, cost"), "{}", found[0]);
        assert_eq!(ours.differences(&theirs, 1e-3), []);
        theirs.rows[1] = Row::new().key("k", 3);
        assert_eq!(ours.differences(&theirs, 1e-3).len(), 1);
        theirs.rows.pop();
        theirs.provenance.instances = 3;
        assert_eq!(ours.differences(&theirs, 1e-3).len(), 3);
    }
}
