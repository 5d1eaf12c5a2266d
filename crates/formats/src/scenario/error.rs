//! Why a text is not a scenario, or a query cannot be written.

/// A text that is not a MovingAI scenario, or a query that cannot be written as a line of one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ScenarioError {
    /// The file is empty.
    #[error(
        "line 1, column 1: expected a MovingAI scenario, found an empty file; is this the file that you \
         meant?"
    )]
    Empty,
    /// The first line is not `version 1` or `version 1.0`.
    #[error(
        "line 1, column 1: expected `version 1` or `version 1.0`, found {found}; \
         a MovingAI scenario begins with its version, followed by one line per query"
    )]
    Version {
        /// The text found there.
        found: String,
    },
    /// The first line is `version 2`.
    #[error(
        "line 1, column 1: expected `version 1` or `version 1.0`, found `version 2`; this is a scenario of a \
         map that changes, which has its map with it: give it in place of a map"
    )]
    Dynamic,
    /// A line has too few or too many fields.
    #[error(
        "line {line}, column {column}: expected nine fields (bucket, map, width, height, start x, start y, \
         goal x, goal y, optimal length), found {found}; separate them by tabs if the map's name has spaces"
    )]
    Fields {
        /// The line, from 1.
        line: usize,
        /// Where the tenth field begins, or the line ends, in bytes from 1.
        column: usize,
        /// The number of fields.
        found: usize,
    },
    /// A field has a value that it cannot have.
    #[error(
        "line {line}, column {column}: expected {expected} as {field}, found {found}; mend or remove the line"
    )]
    Field {
        /// The line, from 1.
        line: usize,
        /// The column, in bytes from 1.
        column: usize,
        /// The name of the field.
        field: &'static str,
        /// The values that the field can have.
        expected: &'static str,
        /// The text found there.
        found: String,
    },
    /// A query that a scenario file cannot hold.
    #[error(
        "instance {index}: expected {expected} as {field}, found {found}; change it before it is written"
    )]
    Unwritable {
        /// The query, from 0.
        index: usize,
        /// The name of the field.
        field: &'static str,
        /// The values that can be written.
        expected: &'static str,
        /// The value.
        found: String,
    },
}
