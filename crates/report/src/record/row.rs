//! Rows of values.

use std::{collections::BTreeMap, fmt};

use serde::{Deserialize, Serialize};

/// A value of a row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// In a column of counts or times. Whole numbers are written without a decimal point.
    #[serde(serialize_with = "shortest")]
    Number(f64),
    /// In a key column.
    Text(String),
}

fn shortest<S: serde::Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    // Below 2^53 ≈ 9.007e15: all these whole numbers are exact.
    if number.fract() == 0.0 && number.abs() < 9e15 {
        serializer.serialize_i64(*number as i64)
    } else {
        serializer.serialize_f64(*number)
    }
}

/// One row of a [`Record`](super::Record): the values by the names of their columns. A value that could not
/// be measured is absent.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Row(BTreeMap<String, Value>);

impl Row {
    /// A row without values.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The same row with a text in a key column.
    #[must_use]
    pub fn key(mut self, column: &str, text: impl fmt::Display) -> Self {
        self.0.insert(column.to_owned(), Value::Text(text.to_string()));
        self
    }

    /// The same row with a number in a column; `None` and numbers that are not finite are left out.
    #[must_use]
    pub fn with(mut self, column: &str, number: impl Into<Option<f64>>) -> Self {
        if let Some(number) = number.into().filter(|number| number.is_finite()) {
            self.0.insert(column.to_owned(), Value::Number(number));
        }
        self
    }

    /// The text in a column; empty if there is none.
    #[must_use]
    pub fn text(&self, column: &str) -> &str {
        match self.0.get(column) {
            Some(Value::Text(text)) => text,
            _ => "",
        }
    }

    /// The number in a column, if there is one.
    #[must_use]
    pub fn number(&self, column: &str) -> Option<f64> {
        match self.0.get(column) {
            Some(Value::Number(number)) => Some(*number),
            _ => None,
        }
    }

    /// Whether the row has these texts in these key columns. Each pair is a column's name and its text.
    #[must_use]
    pub fn is(&self, keys: &[(&str, &str)]) -> bool {
        keys.iter().all(|(column, text)| self.text(column) == *text)
    }

    /// The values with the names of their columns, sorted by name.
    pub fn values(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.0.iter().map(|(column, value)| (column.as_str(), value))
    }

    /// The value in a column.
    pub(super) fn value(&self, column: &str) -> Option<&Value> {
        self.0.get(column)
    }

    /// The row with only the values of the columns for whose name `keep` holds.
    pub(super) fn filtered(&self, keep: impl Fn(&str) -> bool) -> Self {
        let kept = self.0.iter().filter(|(column, _)| keep(column));
        Self(kept.map(|(column, value)| (column.clone(), value.clone())).collect())
    }
}
