//! The record of one run of an experiment.

use serde::{Deserialize, Serialize};

use super::{
    column::{Column, ColumnKind},
    error::RecordError,
    provenance::Provenance,
    row::{Row, Value},
};

/// The results of one run of an experiment: a table whose columns say what they hold, and where the numbers
/// come from.
///
/// ```
/// use mediant_report::{Column, Provenance, Record, Row};
/// let record = Record {
///     id: "lengths".to_owned(),
///     title: "Mean path length".to_owned(),
///     provenance: Provenance::default(),
///     columns: vec![Column::key("k", "the neighborhood"), Column::count("cost", "cells", "mean length")],
///     rows: vec![Row::new().key("k", 2).with("cost", 804.25), Row::new().key("k", 3).with("cost", 668.0)],
/// };
/// assert_eq!(record.number(&[("k", "3")], "cost"), Some(668.0));
/// assert_eq!(Record::parse(&record.json())?, record);
/// # Ok::<(), mediant_report::RecordError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The name of the experiment, one word. Its files are called after it.
    pub id: String,
    /// The measured quantity, in one line.
    pub title: String,
    /// Where the numbers come from.
    pub provenance: Provenance,
    /// The columns of the rows.
    pub columns: Vec<Column>,
    /// The results.
    pub rows: Vec<Row>,
}

impl Record {
    /// Checks that each value has a column, and is text in a key column and a number in any other.
    ///
    /// # Errors
    /// [`RecordError::Value`] for the first value of which this is not true.
    pub fn check(&self) -> Result<(), RecordError> {
        for (at, row) in self.rows.iter().enumerate() {
            for (name, value) in row.values() {
                let column = self.columns.iter().find(|column| column.name == name);
                let fits = column.is_some_and(|column| {
                    (column.kind == ColumnKind::Key) == matches!(value, Value::Text(_))
                });
                if !fits {
                    let (id, column, value) = (self.id.clone(), name.to_owned(), value.clone());
                    return Err(RecordError::Value { id, row: at, column, value });
                }
            }
        }
        Ok(())
    }

    /// The rows with these texts in these key columns, in their order. Each pair is a column's name and its
    /// text.
    pub fn select<'a>(&'a self, keys: &'a [(&str, &str)]) -> impl Iterator<Item = &'a Row> {
        self.rows.iter().filter(move |row| row.is(keys))
    }

    /// The number in `column` of the first row with these texts in these key columns; `None` if there is no
    /// such row or number.
    #[must_use]
    pub fn number(&self, keys: &[(&str, &str)], column: &str) -> Option<f64> {
        self.rows.iter().find(|row| row.is(keys))?.number(column)
    }

    /// The different texts of a key column, in the order of their first rows.
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
}
