//! Why a text is not a scenario of a map that changes, or not a file of patches.

use mediant_grid::Rectangle;

use crate::map::MapError;

/// A text that is no scenario of a map that changes.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DynamicError {
    /// A line of the header is missing, or something else stands in its place.
    #[error(
        "line {line}, column 1: expected {expected}, found {found}; a scenario of a map that changes begins \
         with the lines `version 2`, `height N`, `width N`, `cost N NAMES`, `patch FILE` and `commands`"
    )]
    Header {
        /// The line, from 1.
        line: usize,
        /// The lines that the header could have there.
        expected: String,
        /// The text found there.
        found: String,
    },
    /// A line is no command.
    #[error(
        "line {line}, column 1: expected `P bucket patch x y` or `Q bucket x y x y` with {costs} after it, \
         found {found}; mend or remove the line"
    )]
    Command {
        /// The line, from 1.
        line: usize,
        /// The number of costs of a query, in words.
        costs: String,
        /// The text found there.
        found: String,
    },
    /// A word has a value that it cannot have.
    #[error(
        "line {line}, column {column}: expected {expected} as {field}, found {found}; mend or remove the line"
    )]
    Field {
        /// The line, from 1.
        line: usize,
        /// The column, in bytes from 1.
        column: usize,
        /// The name of the value.
        field: &'static str,
        /// The values that it can have.
        expected: &'static str,
        /// The text found there.
        found: String,
    },
    /// A patch that the file of patches does not have.
    #[error(
        "line {line}, column {column}: expected a patch below {patches}, found {found}; is this the file of \
         patches that was made for the scenario?"
    )]
    NoPatch {
        /// The line, from 1.
        line: usize,
        /// The column, in bytes from 1.
        column: usize,
        /// The number of the patch, from 0.
        found: usize,
        /// The number of patches in the file.
        patches: usize,
    },
    /// A patch reaches beyond the map.
    #[error(
        "line {line}, column {column}: expected a place on the map of {} × {} cells, found {at}; is this the \
         file of patches that was made for the scenario?", size.0, size.1
    )]
    OutsideMap {
        /// The line, from 1.
        line: usize,
        /// The column of the place, in bytes from 1.
        column: usize,
        /// The cells of the patch.
        at: Rectangle,
        /// The width and height of the map.
        size: (u32, u32),
    },
}

/// A text that is no file of patches.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PatchError {
    /// A line is missing, or something else stands in its place.
    #[error(
        "line {line}, column 1: expected {expected}, found {found}; a file of patches begins with the lines \
         `type patch` and `patches N`, and each patch, counted from 0, with `patch I`, `height N`, `width N` \
         and `map`, its rows below"
    )]
    Line {
        /// The line, from 1.
        line: usize,
        /// The text that could stand there.
        expected: String,
        /// The text found there.
        found: String,
    },
    /// The side or a row of a patch is wrong.
    #[error(transparent)]
    Map(MapError),
}

impl From<MapError> for PatchError {
    fn from(error: MapError) -> Self {
        match error {
            MapError::Header { line, expected, found } => {
                Self::Line { line, expected: expected.into(), found }
            }
            error => Self::Map(error),
        }
    }
}
