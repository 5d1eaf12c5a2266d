//! Why a text is not a record.

use super::row::Value;

/// Why a text is not a record, or a record is not consistent.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The text is not JSON, or not that of a record.
    #[error("no record of results: {0}")]
    Form(#[from] serde_json::Error),
    /// A row has a value without a column, text where its column holds numbers, or a number where it holds
    /// text.
    #[error("record `{id}`, row {row}: column `{column}` does not hold {value:?}")]
    Value {
        /// The name of the record.
        id: String,
        /// The row, from 0.
        row: usize,
        /// The column.
        column: String,
        /// The value.
        value: Value,
    },
}
